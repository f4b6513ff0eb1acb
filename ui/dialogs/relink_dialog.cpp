#include "ui/dialogs/relink_dialog.h"

#include "ui/model/project_keeper.h"
#include "ui/widgets/theme.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QVBoxLayout>

namespace prt::ui {

namespace {

QString text(const std::string& s) {
  return QString::fromStdString(s);
}

}  // namespace

RelinkDialog::RelinkDialog(ProjectKeeper& project, QWidget* parent)
    : QDialog(parent),
      project_(project),
      files_(new QTreeWidget),
      result_(new QLabel),
      locate_(new QPushButton(icon(QStringLiteral("document-open")), tr("&Locate\u2026"))),
      relink_(new QPushButton(tr("&Relink"))) {
  setObjectName(QStringLiteral("relinkDialog"));
  setWindowTitle(tr("Files of the project"));
  auto* head = new QLabel(
      tr("The project names files that are not there any more, or not as they were. What was baked "
         "from them is still in it."));
  head->setWordWrap(true);
  files_->setHeaderLabels({tr("File"), tr("Used by"), tr("State")});
  files_->setRootIsDecorated(false);
  files_->header()->setSectionResizeMode(0, QHeaderView::Stretch);
  files_->header()->setSectionResizeMode(1, QHeaderView::ResizeToContents);
  files_->header()->setSectionResizeMode(2, QHeaderView::ResizeToContents);
  files_->header()->setStretchLastSection(false);
  result_->setWordWrap(true);
  result_->setObjectName(QStringLiteral("relinkResult"));
  setRole(result_, "muted");
  locate_->setObjectName(QStringLiteral("locate"));
  locate_->setToolTip(
      tr("Choose a folder: it and everything in it is searched for files of the same names."));
  relink_->setObjectName(QStringLiteral("relink"));
  relink_->setProperty("primary", true);
  auto* close = new QPushButton(tr("Close"));
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(2 * kGrid);
  buttons->addWidget(locate_);
  buttons->addStretch(1);
  buttons->addWidget(close);
  buttons->addWidget(relink_);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(4 * kGrid, 4 * kGrid, 4 * kGrid, 3 * kGrid);
  all->setSpacing(3 * kGrid);
  all->addWidget(head);
  all->addWidget(files_, 1);
  all->addWidget(result_);
  all->addLayout(buttons);
  resize(680, 320);

  connect(close, &QPushButton::clicked, this, &QDialog::close);
  connect(relink_, &QPushButton::clicked, this, &RelinkDialog::apply);
  connect(locate_, &QPushButton::clicked, this, [this] {
    const QString folder = QFileDialog::getExistingDirectory(this, tr("Where to search"));
    if (!folder.isEmpty()) search(folder);
  });
  connect(&project_, &ProjectKeeper::linksFound, this, &RelinkDialog::take);
  connect(&project_, &ProjectKeeper::linksChanged, this, &RelinkDialog::refresh);
  refresh();
}

void RelinkDialog::search(const QString& folder) {
  result_->setText(tr("Searching %1\u2026").arg(folder));
  locate_->setEnabled(false);
  project_.searchLinks(folder);
}

void RelinkDialog::refresh() {
  files_->clear();
  bool missing = false;
  for (const LinkedFile& link : project_.brokenLinks()) {
    const auto found = found_.find(link.path);
    const bool gone = link.state == LinkState::Missing;
    missing = missing || gone;
    QString state = gone ? tr("missing") : tr("has changed since it was saved");
    if (found != found_.end())
      state = found->second.sameContents ? tr("found, same contents") : tr("found, other contents");
    auto* item = new QTreeWidgetItem({text(link.path), text(link.places.front()).section(u'.', 0, 0), state});
    item->setToolTip(0, text(link.file.string()));
    if (found != found_.end()) item->setToolTip(2, text(found->second.file.string()));
    const Theme& t = theme();
    item->setForeground(2, found == found_.end() ? (gone ? t.failed : t.stale)
                                                 : (found->second.sameContents ? t.done : t.stale));
    if (found != found_.end())
      item->setCheckState(0, found->second.sameContents ? Qt::Checked : Qt::Unchecked);
    item->setData(0, Qt::UserRole, text(link.path));
    files_->addTopLevelItem(item);
  }
  locate_->setEnabled(missing);
  relink_->setEnabled(!found_.empty());
}

void RelinkDialog::take(const std::map<std::string, FoundFile>& found) {
  found_ = found;
  refresh();
  int same = 0;
  for (const auto& [path, file] : found_) same += file.sameContents;
  const int other = int(found_.size()) - same;
  QString said =
      found_.empty() ? tr("Nothing of these names is in there.") : tr("%1 found.").arg(found_.size());
  if (other > 0)
    said +=
        u' ' +
        tr("%1 with other contents than when the project was saved: tick to take it anyway; what was baked "
           "from it is baked again.")
            .arg(other);
  result_->setText(said);
}

void RelinkDialog::apply() {
  std::map<std::string, std::filesystem::path> chosen;
  for (int i = 0; i < files_->topLevelItemCount(); ++i) {
    const QTreeWidgetItem* item = files_->topLevelItem(i);
    const auto found = found_.find(item->data(0, Qt::UserRole).toString().toStdString());
    if (found != found_.end() && item->checkState(0) == Qt::Checked)
      chosen[found->first] = found->second.file;
  }
  if (chosen.empty()) return;
  found_.clear();
  project_.relink(chosen);
  if (project_.brokenLinks().empty()) close();
}

}  // namespace prt::ui
