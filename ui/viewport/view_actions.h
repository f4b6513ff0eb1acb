#pragma once
// What can be done to the view, as actions with names, keys and tooltips: the View menu and the viewport's
// context menu are made of them. Keys that a number field would type (digits, + and -) count while the
// viewport has the focus.

#include <QKeyCombination>
#include <QList>
#include <QObject>
#include <QVariantMap>

#include <functional>

class QAction;
class QActionGroup;
class QMenu;

namespace prt::ui {

class Session;
class Viewport;

class ViewActions : public QObject {
  Q_OBJECT
 public:
  /// With `restored`, the settings of the last time (navigation, drawing, background, what is shown) are
  /// applied. Later changes are kept for the next time.
  ViewActions(Session& session, Viewport& viewport, bool restored, QObject* parent = nullptr);

  /// Everything, with submenus.
  void fillViewMenu(QMenu& menu);
  /// What is wanted where something was clicked.
  void fillContextMenu(QMenu& menu);

 private:
  using Run = std::function<void()>;
  QAction* add(const char* name, const QString& text, const QList<QKeyCombination>& keys, const QString& tip,
               Run run);
  QAction* addSwitch(const char* name, const QString& text, const QList<QKeyCombination>& keys,
                     const QString& tip, std::function<bool()> value, std::function<void(bool)> set);
  /// One of several, by number.
  QActionGroup* addChoice(const char* name, const QStringList& texts, std::function<int()> value,
                          std::function<void(int)> set);
  void addAxis(const char* name, const QString& text, QKeyCombination key, float x, float y, float z);
  void makeCameraActions();
  void makePictureActions();
  void restore();
  void follow();
  QVariantMap settingsNow() const;
  void changeExposure(float stops);
  void copyPicture();
  void addSubmenu(QMenu& menu, const QString& title, const QList<QAction*>& actions);

  Session& session_;
  Viewport& viewport_;
  QList<QAction*> frames_, axes_, exposures_, shown_;
  QAction *perspective_ = nullptr, *copy_ = nullptr;
  QActionGroup *backgrounds_ = nullptr, *curves_ = nullptr, *presets_ = nullptr, *drawings_ = nullptr;
  QList<Run> follow_;  // brings check marks up to date
  QVariantMap kept_;   // what the settings hold
};

}  // namespace prt::ui
