#pragma once
// Arrangements of the docks for the moods of work. Each keeps what the user made of it: choosing another one
// puts the docks where they were left in that one.

#include <QMap>
#include <QObject>
#include <QString>

#include <vector>

class QDockWidget;
class QMainWindow;
class QSettings;

namespace prt::ui {

/// One column of docks beside the viewport, from top to bottom.
struct DockColumnPlan {
  int width = 0;  ///< pixels
  struct Place {
    QStringList docks;  ///< by object name; more than one: tabs, the first in front
    int height = 0;     ///< in proportion to the others
  };
  std::vector<Place> places;
};

struct LayoutPlan {
  QString name;   ///< "bake"
  QString title;  ///< "Bake"
  QString tip;
  DockColumnPlan left, right;
  QStringList
      hidden;  ///< docks that this mood does not need; all others that are not named become tabs at the right
};

/// The moods that there are, in the order of the work. Authoring joins them in front.
std::vector<LayoutPlan> layoutPlans();

class Layouts : public QObject {
  Q_OBJECT
 public:
  /// `version` is raised when the docks change, so that old arrangements are not restored.
  Layouts(QMainWindow& window, std::vector<LayoutPlan> plans, int version);

  const std::vector<LayoutPlan>& plans() const { return plans_; }
  QString current() const { return current_; }
  /// Keeps the arrangement of now and goes to another mood as it was left, or as it is planned.
  void choose(const QString& name);
  /// Where the current mood does without this dock, goes to the first that needs it.
  void chooseFor(const QString& dock);
  /// The current mood as it is planned.
  void reset();

  /// In place of what was saved before.
  void save(QSettings& settings);
  /// False, and the plan, where nothing that can be used was saved.
  bool restore(QSettings& settings);

 Q_SIGNALS:
  void chosen(const QString& name);

 private:
  const LayoutPlan& plan(const QString& name) const;
  void arrange(const LayoutPlan& plan);
  void stack(Qt::DockWidgetArea area, const DockColumnPlan& column, QStringList& rest);

  QMainWindow& window_;
  std::vector<LayoutPlan> plans_;
  int version_;
  QString current_;
  QMap<QString, QByteArray> kept_;
};

}  // namespace prt::ui
