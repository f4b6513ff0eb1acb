#include "ui/window/layouts.h"

#include <QDockWidget>
#include <QMainWindow>
#include <QSettings>

#include <algorithm>

namespace prt::ui {

namespace {
constexpr int kLeftWidth = 232, kRightWidth = 264;

QString s(const char* text) {
  return QString::fromLatin1(text);
}
}  // namespace

std::vector<LayoutPlan> layoutPlans() {
  const QStringList jobsAndLog{s("jobs"), s("log")};
  const QStringList mesoDocks{s("charts"), s("patch"), s("rtt"), s("synthesis")};
  return {
      {.name = s("author"),
       .title = QObject::tr("Author"),
       .tip = QObject::tr("Docks for charts and the fine structure: cut and pack, the patch, how it answers "
                          "to light and how it is laid."),
       .left = {kLeftWidth, {{{s("scene")}, 204}, {{s("light")}, 472}, {jobsAndLog, 172}}},
       .right = {kRightWidth, {{mesoDocks, 848}}},
       .hidden = {s("material"), s("transfer")}},
      {.name = s("bake"),
       .title = QObject::tr("Bake"),
       .tip = QObject::tr("Docks for baking: what is baked and how far, jobs and log."),
       .left = {kLeftWidth, {{{s("scene")}, 420}, {jobsAndLog, 428}}},
       .right = {kRightWidth, {{{s("transfer")}, 480}, {{s("material"), s("light")}, 368}}},
       .hidden = mesoDocks},
      {.name = s("relight"),
       .title = QObject::tr("Relight"),
       .tip = QObject::tr("Docks for looking: light and material at hand."),
       .left = {kLeftWidth, {{{s("scene")}, 204}, {{s("light")}, 472}, {jobsAndLog, 172}}},
       .right = {kRightWidth, {{{s("material")}, 500}, {{s("transfer")}, 348}}},
       .hidden = mesoDocks},
  };
}

Layouts::Layouts(QMainWindow& window, std::vector<LayoutPlan> plans, int version)
    : QObject(&window),
      window_(window),
      plans_(std::move(plans)),
      version_(version),
      current_(plans_.back().name) {}

const LayoutPlan& Layouts::plan(const QString& name) const {
  const auto found =
      std::find_if(plans_.begin(), plans_.end(), [&](const LayoutPlan& p) { return p.name == name; });
  return found == plans_.end() ? plans_.back() : *found;
}

void Layouts::choose(const QString& name) {
  if (name != current_) {
    kept_[current_] = window_.saveState(version_);
    current_ = plan(name).name;
    if (!kept_.contains(current_) || !window_.restoreState(kept_[current_], version_))
      arrange(plan(current_));
  }
  Q_EMIT chosen(current_);
}

void Layouts::chooseFor(const QString& dock) {
  if (!plan(current_).hidden.contains(dock)) return;
  for (const LayoutPlan& each : plans_)
    if (!each.hidden.contains(dock)) return choose(each.name);
}

void Layouts::reset() {
  kept_.remove(current_);
  arrange(plan(current_));
  Q_EMIT chosen(current_);
}

void Layouts::arrange(const LayoutPlan& plan) {
  QStringList rest;
  for (QDockWidget* dock : window_.findChildren<QDockWidget*>()) {
    dock->setFloating(false);
    dock->show();
    rest << dock->objectName();
  }
  stack(Qt::LeftDockWidgetArea, plan.left, rest);
  stack(Qt::RightDockWidgetArea, plan.right, rest);
  for (const QString& name : plan.hidden)
    if (auto* dock = window_.findChild<QDockWidget*>(name)) dock->hide(), rest.removeAll(name);
  // Docks that the plan does not know: behind the last one at the right.
  auto* last = window_.findChild<QDockWidget*>(plan.right.places.back().docks.front());
  for (const QString& name : rest)
    if (last) window_.tabifyDockWidget(last, window_.findChild<QDockWidget*>(name)), last->raise();
}

// One dock below the other, each with its tabs; takes them off `rest`.
void Layouts::stack(Qt::DockWidgetArea area, const DockColumnPlan& column, QStringList& rest) {
  QList<QDockWidget*> docks;
  QList<int> widths, heights;
  for (const DockColumnPlan::Place& place : column.places) {
    QDockWidget* front = nullptr;
    for (const QString& name : place.docks) {
      auto* dock = window_.findChild<QDockWidget*>(name);
      if (!dock) continue;
      rest.removeAll(name);
      window_.addDockWidget(area, dock);
      if (front)
        window_.tabifyDockWidget(front, dock);
      else
        front = dock;
    }
    if (!front) continue;
    front->raise();
    docks << front;
    widths << column.width;
    heights << place.height;
  }
  window_.resizeDocks(docks, widths, Qt::Horizontal);
  window_.resizeDocks(docks, heights, Qt::Vertical);
}

void Layouts::save(QSettings& settings) {
  kept_[current_] = window_.saveState(version_);
  settings.remove(s("window/layout"));
  settings.setValue(s("window/mood"), current_);
  for (auto it = kept_.cbegin(); it != kept_.cend(); ++it)
    settings.setValue(s("window/layout/") + it.key(), it.value());
}

bool Layouts::restore(QSettings& settings) {
  current_ = plan(settings.value(s("window/mood")).toString()).name;
  for (const LayoutPlan& each : plans_) {
    const QByteArray state = settings.value(s("window/layout/") + each.name).toByteArray();
    if (!state.isEmpty()) kept_[each.name] = state;
  }
  arrange(plan(current_));
  const bool restored = kept_.contains(current_) && window_.restoreState(kept_[current_], version_);
  Q_EMIT chosen(current_);
  return restored;
}

}  // namespace prt::ui
