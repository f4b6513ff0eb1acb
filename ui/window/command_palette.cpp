#include "ui/window/command_palette.h"

#include "ui/widgets/theme.h"

#include <QAbstractListModel>
#include <QFrame>
#include <QKeyEvent>
#include <QLineEdit>
#include <QListView>
#include <QPainter>
#include <QSettings>
#include <QStyledItemDelegate>
#include <QTimer>
#include <QVBoxLayout>

#include <algorithm>

namespace prt::ui {

namespace {

constexpr int kWidth = 560, kTop = 72, kLineHeight = 28, kLinesShown = 12, kRemembered = 12;
const char* const kRecentKey = "palette/recent";

QStringList recentCommands() {
  return QSettings().value(QLatin1String(kRecentKey)).toStringList();
}

void rememberCommand(const QString& id) {
  QStringList recent = recentCommands();
  recent.removeAll(id);
  recent.prepend(id);
  QSettings().setValue(QLatin1String(kRecentKey), QStringList(recent.mid(0, kRemembered)));
}

}  // namespace

/// The commands that match the line, best first.
class CommandListModel : public QAbstractListModel {
 public:
  using QAbstractListModel::QAbstractListModel;

  void setCommands(std::vector<Command> commands) { commands_ = std::move(commands); }
  void search(const QString& line, const std::optional<Command>& spoken) {
    beginResetModel();
    shown_.clear();
    if (spoken) shown_.push_back({*spoken, {}});
    for (RankedCommand& ranked : rankCommands(commands_, line, recentCommands()))
      shown_.push_back({commands_[std::size_t(ranked.index)], std::move(ranked.positions)});
    endResetModel();
  }
  struct Line {
    Command command;
    std::vector<int> positions;
  };
  const Line& line(int row) const { return shown_[std::size_t(row)]; }
  int rowCount(const QModelIndex& = {}) const override { return int(shown_.size()); }
  QVariant data(const QModelIndex& index, int role) const override {
    const Command& command = line(index.row()).command;
    if (role == Qt::DisplayRole || role == Qt::AccessibleTextRole) return command.title;
    if (role == Qt::ToolTipRole) return command.tip;
    return {};
  }

 private:
  std::vector<Command> commands_;
  std::vector<Line> shown_;
};

namespace {

/// Title with its matched letters bold, where it is, and at the right its value and keys.
class CommandDelegate : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override {
    return {kWidth, kLineHeight};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const auto& line = static_cast<const CommandListModel*>(index.model())->line(index.row());
    const Command& command = line.command;
    const Theme& t = theme();
    if (option.state & (QStyle::State_Selected | QStyle::State_MouseOver))
      painter->fillRect(option.rect, option.state & QStyle::State_Selected ? t.line : t.field);
    if (option.state & QStyle::State_Selected)
      painter->fillRect(QRect(option.rect.topLeft(), QSize(2, option.rect.height())), t.accent);
    QRect area = option.rect.adjusted(3 * kGrid, 0, -3 * kGrid, 0);
    painter->setFont(option.font);
    area.setRight(paintEnd(*painter, area, command));
    const int x = paintTitle(*painter, area, line, command.enabled ? t.text : t.muted);
    painter->setPen(t.muted);
    const QRect rest(x + 3 * kGrid, area.top(), area.right() - x - 3 * kGrid, area.height());
    if (rest.width() > 24)
      painter->drawText(rest, Qt::AlignVCenter,
                        painter->fontMetrics().elidedText(command.group, Qt::ElideRight, rest.width()));
  }

 private:
  // Returns where it begins.
  static int paintEnd(QPainter& painter, const QRect& area, const Command& command) {
    int right = area.right();
    const auto put = [&](const QString& text, const QColor& color, bool cap) {
      if (text.isEmpty()) return;
      const QString shown = painter.fontMetrics().elidedText(text, Qt::ElideRight, area.width() / 2);
      const int width = painter.fontMetrics().horizontalAdvance(shown) + (cap ? 2 * kGrid : 0);
      const QRect box(right - width + 1, area.top(), width, area.height());
      if (cap) {
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(theme().muted);
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF(box).adjusted(0.5, 5.5, -0.5, -5.5), 3, 3);
      }
      painter.setPen(color);
      painter.drawText(box, Qt::AlignCenter, shown);
      right -= width + 2 * kGrid;
    };
    put(command.shortcut, theme().text, true);
    put(command.detail, theme().text, false);
    return right;
  }
  // Returns where it ends.
  static int paintTitle(QPainter& painter, const QRect& area, const CommandListModel::Line& line,
                        const QColor& color) {
    QFont plain = painter.font(), bold = plain;
    bold.setWeight(QFont::Bold);
    painter.setPen(color);
    int x = area.left();
    const QString& title = line.command.title;
    for (int i = 0; i < int(title.size()) && x < area.right();) {
      const auto matched = [&](int at) {
        return std::binary_search(line.positions.begin(), line.positions.end(), at);
      };
      const bool hit = matched(i);
      int end = i + 1;
      while (end < int(title.size()) && matched(end) == hit) ++end;
      const QString part = title.mid(i, end - i);
      painter.setFont(hit ? bold : plain);
      const int width = painter.fontMetrics().horizontalAdvance(part);
      painter.drawText(QRect(x, area.top(), area.right() - x + 1, area.height()), Qt::AlignVCenter, part);
      x += width;
      i = end;
    }
    painter.setFont(plain);
    return x;
  }
};

}  // namespace

CommandPalette::CommandPalette(QWidget* window, Collect collect, Interpret interpret)
    : Sheet(window, new QFrame),
      collect_(std::move(collect)),
      interpret_(std::move(interpret)),
      model_(new CommandListModel(this)),
      line_(new QLineEdit),
      list_(new QListView) {
  setObjectName(QStringLiteral("commandPalette"));
  line_->setPlaceholderText(tr("Find a command or a parameter, or set one: transfer.bands = 6"));
  line_->setObjectName(QStringLiteral("paletteLine"));
  line_->installEventFilter(this);
  list_->setObjectName(QStringLiteral("paletteList"));
  list_->setModel(model_);
  list_->setItemDelegate(new CommandDelegate(list_));
  list_->setUniformItemSizes(true);
  list_->setFocusPolicy(Qt::NoFocus);
  list_->setMouseTracking(true);
  list_->setFrameShape(QFrame::NoFrame);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* all = new QVBoxLayout(panel());
  all->setContentsMargins(1, 1, 1, 2 * kGrid);
  all->setSpacing(kGrid);
  all->addWidget(line_);
  all->addWidget(list_, 1);
  connect(line_, &QLineEdit::textChanged, this, &CommandPalette::refresh);
  connect(list_, &QListView::clicked, this, &CommandPalette::runCurrent);
}

CommandPalette::~CommandPalette() = default;

void CommandPalette::openWith(const QString& line) {
  typed_ = line;
  open();
}

QStringList CommandPalette::titles() const {
  QStringList list;
  for (int row = 0; row < model_->rowCount(); ++row) list << model_->line(row).command.title;
  return list;
}

QRect CommandPalette::panelPlace(const QSize& window) const {
  const int width = std::min(kWidth, window.width() - 32);
  const int wanted = 52 + kLineHeight * std::clamp(model_->rowCount(), 1, kLinesShown);
  return {(window.width() - width) / 2, kTop, width, std::min(wanted, window.height() - kTop - 32)};
}

QWidget* CommandPalette::aboutToOpen() {
  model_->setCommands(collect_());
  line_->setText(std::exchange(typed_, QString()));
  refresh();
  return line_;
}

void CommandPalette::refresh() {
  model_->search(line_->text(), interpret_(line_->text()));
  list_->setCurrentIndex(model_->index(0));
  if (isVisible()) place();
}

void CommandPalette::move(int by) {
  const int rows = model_->rowCount();
  if (rows == 0) return;
  const int row = list_->currentIndex().row() + by;
  // One step past an end comes in at the other; a page stops there.
  const int next = std::abs(by) == 1 ? (row + rows) % rows : std::clamp(row, 0, rows - 1);
  list_->setCurrentIndex(model_->index(next));
}

void CommandPalette::runCurrent() {
  if (!list_->currentIndex().isValid()) return;
  const Command command = model_->line(list_->currentIndex().row()).command;
  if (!command.enabled || !command.run) return;
  close();
  rememberCommand(command.id);
  command.run();
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (watched == line_ && event->type() == QEvent::KeyPress) {
    switch (static_cast<QKeyEvent*>(event)->key()) {
      case Qt::Key_Down:
        move(1);
        return true;
      case Qt::Key_Up:
        move(-1);
        return true;
      case Qt::Key_PageDown:
        move(kLinesShown);
        return true;
      case Qt::Key_PageUp:
        move(-kLinesShown);
        return true;
      case Qt::Key_Return:
      case Qt::Key_Enter:
        runCurrent();
        return true;
      case Qt::Key_Escape:
        close();
        return true;
      default:
        break;
    }
  }
  return Sheet::eventFilter(watched, event);
}

}  // namespace prt::ui
