#include "ui/window/keys_overlay.h"

#include "ui/widgets/theme.h"

#include <QFrame>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QScrollArea>
#include <QVBoxLayout>

namespace prt::ui {

namespace {

constexpr int kColumnWidth = 440, kMargin = 32, kKeysWidth = 200;

// "Ctrl+Shift+Z" and "Shift + drag" alike as caps, with words between them.
QWidget* keyCaps(const QString& keys) {
  auto* row = new QWidget;
  auto* layout = new QHBoxLayout(row);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(kGrid);
  const QString spaced = QString(keys).replace(QStringLiteral("+"), QStringLiteral(" + "));
  for (const QString& way : spaced.split(QStringLiteral(" or "))) {
    if (layout->count() > 0) {
      auto* between = new QLabel(QObject::tr("or"));
      setRole(between, "muted");
      layout->addWidget(between);
    }
    // Typing "+" itself is a key of its own.
    const QStringList caps =
        way.trimmed() == u"+" ? QStringList{QStringLiteral("+")} : way.split(u'+', Qt::SkipEmptyParts);
    for (const QString& cap : caps) {
      auto* label = new QLabel(cap.trimmed());
      setRole(label, "key");
      label->setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
      layout->addWidget(label);
    }
  }
  layout->addStretch(1);
  return row;
}

QWidget* groupBlock(const BindingGroup& group) {
  auto* block = new QWidget;
  auto* grid = new QGridLayout(block);
  grid->setContentsMargins(0, 0, 0, 3 * kGrid);
  grid->setHorizontalSpacing(3 * kGrid);
  grid->setVerticalSpacing(kGrid);
  grid->setColumnMinimumWidth(0, kKeysWidth);
  grid->setColumnStretch(1, 1);
  auto* title = new QLabel(group.title);
  setRole(title, "heading");
  grid->addWidget(title, 0, 0, 1, 2);
  int row = 1;
  for (const Binding& binding : group.bindings) {
    grid->addWidget(keyCaps(binding.keys), row, 0, Qt::AlignTop);
    auto* what = new QLabel(binding.what);
    what->setContentsMargins(0, 2, 0, 2);
    what->setWordWrap(true);
    grid->addWidget(what, row++, 1);
  }
  return block;
}

void collect(const QMenu& menu, QList<Binding>& bindings) {
  for (const QAction* action : menu.actions()) {
    if (action->menu()) {
      collect(*action->menu(), bindings);
      continue;
    }
    QStringList ways;
    for (const QKeySequence& keys : action->shortcuts()) ways << keys.toString(QKeySequence::NativeText);
    if (ways.isEmpty() || !action->isVisible()) continue;
    bindings << Binding{ways.join(QObject::tr(" or ")), plainText(*action)};
  }
}

}  // namespace

QString plainText(const QAction& action) {
  QString text = action.text();
  text.replace(QStringLiteral("&&"), QStringLiteral("\1"));
  text.remove(u'&');
  text.replace(u'\1', u'&');
  return text;
}

QList<BindingGroup> menuBindings(const QMenuBar& menus) {
  QList<BindingGroup> groups;
  for (const QAction* action : menus.actions()) {
    if (!action->menu()) continue;
    BindingGroup group{plainText(*action), {}};
    collect(*action->menu(), group.bindings);
    if (!group.bindings.isEmpty()) groups << group;
  }
  return groups;
}

KeysOverlay::KeysOverlay(QWidget* window, std::function<QList<BindingGroup>()> groups)
    : Sheet(window, new QFrame), groups_(std::move(groups)) {
  setObjectName(QStringLiteral("keysOverlay"));
  setFocusPolicy(Qt::StrongFocus);
  auto* all = new QVBoxLayout(panel());
  all->setContentsMargins(6 * kGrid, 4 * kGrid, 6 * kGrid, 4 * kGrid);
  all->setSpacing(3 * kGrid);
  auto* head = new QHBoxLayout;
  auto* title = new QLabel(tr("Keys and mouse"));
  setRole(title, "title");
  auto* hint = new QLabel(tr("Ctrl+K finds every command by name \u00b7 Esc closes"));
  setRole(hint, "muted");
  head->addWidget(title);
  head->addStretch(1);
  head->addWidget(hint);
  all->addLayout(head);
  content_ = new QWidget;
  new QHBoxLayout(content_);
  auto* scroll = new QScrollArea;
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(content_);
  scroll->setFocusPolicy(Qt::NoFocus);
  all->addWidget(scroll, 1);
}

// The groups in two columns of about the same height, in their order.
void KeysOverlay::fill(const QList<BindingGroup>& groups) {
  auto* row = static_cast<QHBoxLayout*>(content_->layout());
  while (QLayoutItem* item = row->takeAt(0)) {
    delete item->widget();
    delete item;
  }
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(8 * kGrid);
  int lines = 0, before = 0;
  for (const BindingGroup& group : groups) lines += int(group.bindings.size()) + 2;
  QVBoxLayout* column = nullptr;
  for (const BindingGroup& group : groups) {
    const int size = int(group.bindings.size()) + 2;
    if (!column || (row->count() == 1 && 2 * before + size > lines)) {
      if (column) column->addStretch(1);
      auto* holder = new QWidget;
      column = new QVBoxLayout(holder);
      column->setContentsMargins(0, 0, 0, 0);
      column->setSpacing(0);
      row->addWidget(holder, 1);
    }
    column->addWidget(groupBlock(group));
    before += size;
  }
  if (column) column->addStretch(1);
}

QRect KeysOverlay::panelPlace(const QSize& window) const {
  const int width = std::min(2 * kColumnWidth + 20 * kGrid, window.width() - 2 * kMargin);
  const QLayout& columns = *content_->layout();  // wraps its text
  const int tall =
      columns.hasHeightForWidth() ? columns.heightForWidth(width - 12 * kGrid) : columns.sizeHint().height();
  const int wanted = tall + 24 * kGrid;
  const int height = std::min(wanted, window.height() - 2 * kMargin);
  return {(window.width() - width) / 2, (window.height() - height) / 2, width, height};
}

QWidget* KeysOverlay::aboutToOpen() {
  fill(groups_());
  return this;
}

void KeysOverlay::keyPressEvent(QKeyEvent* event) {
  if (event->text() == u"?" || event->key() == Qt::Key_Return || event->key() == Qt::Key_Space)
    return close();
  Sheet::keyPressEvent(event);
}

}  // namespace prt::ui
