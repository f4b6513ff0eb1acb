#pragma once
// The lights of the recipe as the studio edits them, by number: panorama, handles in the viewport and list
// all work on this one, and share its selection. Every call that changes something is one named step of undo;
// what is called between beginDrag() and endDrag() is one step together.
//
// Directions are those of the world. Circle and directional lights stay where they are when the environment
// is turned; the sun of the built-in clear sky belongs to its environment and turns with it.

#include "ui/model/document.h"

#include <QObject>
#include <QString>

#include <vector>

namespace prt::ui {

/// A light that stands somewhere in the sky, as it is drawn and grabbed.
struct LightMark {
  int light = -1;  ///< index in the recipe
  QString name;
  Vec3 direction{0, 1, 0};  ///< unit, in the world, towards the light
  float halfAngle = 0;      ///< radians; 0 for the sun and for directional lights
  Rgb color{1};             ///< radiance scaled so that its largest channel is 1
  bool on = true;
  bool selected = false;
  bool sun = false;        ///< of the clear sky
  bool resizable = false;  ///< a circle
};

class LightEditor : public QObject {
  Q_OBJECT
 public:
  /// Degrees across of a light that was just added.
  static constexpr float kNewAngle = 30;

  explicit LightEditor(Document& document, QObject* parent = nullptr);

  Document& document() { return document_; }
  const std::vector<LightRecipe>& lights() const { return document_.recipe().lights; }
  int count() const { return int(lights().size()); }
  /// What there is to draw and grab: circles, directional lights, the sun; in the recipe's order.
  std::vector<LightMark> marks() const;

  /// Index of the selected light; -1: none.
  int selected() const { return selected_; }
  void select(int light);
  /// Index of the environment that lights: the first that is on, or the first; -1 without any.
  int environment() const;

  /// All return the index of the new light, which is then selected.
  int addCircle(const Vec3& direction);
  int duplicate(int light);
  void remove(int light);

  /// Turns the light to stand in this direction of the world: a circle, a directional light or the sun, which
  /// stays at least a degree above the horizon.
  void aim(int light, const Vec3& direction);
  /// Degrees across, kept within what the recipe allows.
  void resize(int light, double degrees);
  void setColor(int light, const Rgb& radiance);
  void setIntensity(int light, double factor);
  void setOn(int light, bool on);
  void rename(int light, const QString& name);
  /// Makes this file or built-in map the environment; adds one where there is none.
  void setEnvironment(const QString& path);

  void beginDrag(const QString& name) { document_.beginGesture(name); }
  void endDrag() { document_.endGesture(); }
  /// Ends the drag as if it had not been.
  void cancelDrag();

 Q_SIGNALS:
  /// The lights changed, or which of them is selected.
  void changed();

 private:
  bool has(int light) const { return light >= 0 && light < count(); }
  template <class Change>
  void edit(int light, const QString& name, Change&& change);
  QString freeName(const QString& wanted) const;
  void follow();

  Document& document_;
  int selected_ = -1;
};

}  // namespace prt::ui
