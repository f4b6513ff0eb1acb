#include "ui/widgets/recovery_bar.h"

#include "ui/model/project_keeper.h"
#include "ui/widgets/theme.h"

#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QLocale>
#include <QPixmap>
#include <QPushButton>
#include <QToolButton>
#include <QVBoxLayout>

namespace prt::ui {

namespace {

constexpr int kThumbWidth = 96, kThumbHeight = 60;

QString when(const QDateTime& time) {
  const bool today = time.date() == QDate::currentDate();
  return today ? QObject::tr("today %1").arg(time.time().toString(QStringLiteral("hh:mm:ss")))
               : QLocale().toString(time, QLocale::ShortFormat);
}

QString edits(const RecoveryEntry& entry) {
  if (entry.edits.isEmpty()) return QObject::tr("baked work that no file holds");
  QStringList last = entry.edits.mid(std::max<qsizetype>(0, entry.edits.size() - 3));
  std::reverse(last.begin(), last.end());
  const QString count = entry.edits.size() == 1 ? QObject::tr("1 unsaved edit")
                                                : QObject::tr("%1 unsaved edits").arg(entry.edits.size());
  return QStringLiteral("%1: %2%3")
      .arg(count, last.join(QStringLiteral(", ")),
           entry.edits.size() > 3 ? QStringLiteral("\u2026") : QString());
}

}  // namespace

RecoveryBar::RecoveryBar(ProjectKeeper& project, QWidget* parent)
    : QFrame(parent), project_(project), rows_(new QVBoxLayout(this)) {
  setObjectName(QStringLiteral("recoveryBar"));
  rows_->setContentsMargins(3 * kGrid, 2 * kGrid, 2 * kGrid, 3 * kGrid);
  rows_->setSpacing(2 * kGrid);
  connect(&project_, &ProjectKeeper::recoveriesChanged, this, &RecoveryBar::refresh);
  hide();
}

void RecoveryBar::offer() {
  refresh();
}

void RecoveryBar::refresh() {
  while (QLayoutItem* item = rows_->takeAt(0)) {
    if (item->widget()) item->widget()->deleteLater();
    delete item;
  }
  const auto& found = project_.recoveries();
  hide();  // shown with its rows: those that are added to what is shown already have no size yet
  if (found.empty()) return;
  auto* head = new QWidget;
  auto* layout = new QHBoxLayout(head);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* title = new QLabel(tr("The studio did not end as it should. This was not saved:"));
  setRole(title, "heading");
  auto* later = new QToolButton;
  later->setIcon(icon(QStringLiteral("window-close")));
  later->setToolTip(tr("Not now: it is offered again at the next start."));
  connect(later, &QToolButton::clicked, this, &QWidget::hide);
  layout->addWidget(title, 1);
  layout->addWidget(later);
  rows_->addWidget(head);
  for (std::size_t i = 0; i < std::min<std::size_t>(found.size(), kShown); ++i)
    rows_->addWidget(makeRow(found[i]));
  if (found.size() > kShown) {
    auto* more = new QLabel(tr("and %1 more, offered once these are dealt with").arg(found.size() - kShown));
    setRole(more, "muted");
    rows_->addWidget(more);
  }
  show();
  Q_EMIT resized();
}

QWidget* RecoveryBar::makeRow(const std::shared_ptr<RecoveryPlace>& place) {
  const RecoveryEntry entry = place->read().value_or(RecoveryEntry{});
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3 * kGrid);
  auto* picture = new QLabel;
  picture->setFixedSize(kThumbWidth, kThumbHeight);
  picture->setAlignment(Qt::AlignCenter);
  picture->setPixmap(QPixmap(place->thumbnail())
                         .scaled(kThumbWidth, kThumbHeight, Qt::KeepAspectRatio, Qt::SmoothTransformation));
  layout->addWidget(picture);

  auto* words = new QVBoxLayout;
  words->setSpacing(2);
  const QFileInfo file(entry.path);
  auto* name =
      new QLabel(tr("%1 \u00b7 %2")
                     .arg(entry.path.isEmpty() ? tr("%1, never saved").arg(entry.title) : file.fileName(),
                          when(entry.time)));
  name->setToolTip(entry.path);
  auto* what = new QLabel(edits(entry));
  setRole(what, "muted");
  what->setWordWrap(true);
  words->addWidget(name);
  words->addWidget(what);
  if (!entry.path.isEmpty() && (!file.exists() || file.lastModified() > entry.time)) {
    auto* note =
        new QLabel(file.exists() ? tr("The file was saved later than this.") : tr("The file is gone."));
    setRole(note, "stale");
    words->addWidget(note);
  }
  words->addStretch(1);
  layout->addLayout(words, 1);

  const auto button = [&](const QString& text, const char* objectName, auto run) {
    auto* made = new QPushButton(text);
    made->setObjectName(QLatin1String(objectName));
    connect(made, &QPushButton::clicked, this, run);
    layout->addWidget(made);
    return made;
  };
  button(tr("&Discard"), "discardRecovery", [this, place] {
    project_.discard(place);
  })->setToolTip(tr("Throws these edits away; the saved project stays."));
  if (file.exists())
    button(tr("&Open saved"), "openSaved", [this, path = entry.path] {
      project_.open(path);
    })->setToolTip(tr("Opens the project without these edits, which stay on offer."));
  button(tr("&Restore"), "restoreRecovery", [this, place] {
    project_.restore(place);
  })->setProperty("primary", true);
  return row;
}

}  // namespace prt::ui
