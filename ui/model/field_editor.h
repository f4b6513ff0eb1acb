#pragma once
// The orientation field as it is worked on by hand: strokes drawn on the surface, held in the recipe, one
// named step of undo each; and the field that follows from them, made anew behind the interface while it is
// shown, as the stage "field" would.

#include "libprt/project/recipe.h"
#include "ui/model/field_look.h"
#include "ui/model/stroke_path.h"

#include <QObject>
#include <QString>

#include <memory>
#include <optional>
#include <vector>

namespace prt::ui {

class Session;

class FieldEditor : public QObject {
  Q_OBJECT
 public:
  explicit FieldEditor(Session& session, QObject* parent = nullptr);

  /// Of the recipe.
  const std::vector<FieldStroke>& strokes() const { return strokes_; }
  /// Why strokes cannot be read, or no field made; empty when all is well.
  const QString& error() const { return error_; }
  /// In the scene's unit: how far from a stroke the field follows it.
  float width() const;

  // ---- drawing ----
  bool drawing() const { return path_.has_value(); }
  /// Points of the stroke that is being drawn.
  std::vector<Vec3> drawn() const { return path_ ? path_->points() : std::vector<Vec3>(); }
  /// Nothing happens until the surface was read.
  void begin(const SurfaceHit& hit);
  void extend(const SurfaceHit& hit);
  /// It becomes one of the recipe's, and is selected; a stroke too short to have a direction is dropped.
  void end();
  void drop();
  int selected() const { return selected_; }  ///< -1: none
  void select(int stroke);
  void erase(int stroke);
  void eraseAll();

  // ---- the field ----
  bool shown() const { return shown_; }
  void setShown(bool shown);
  /// Null while it is not shown, or not made yet; while it is made anew, the one before.
  const std::shared_ptr<const OrientationField>& field() const { return field_; }
  const std::vector<FieldKnot>& knots() const { return knots_; }
  /// What is shown is what the recipe asks for.
  bool settled() const { return !shown_ || (job_ == 0 && (field_ || !error_.isEmpty())); }

 Q_SIGNALS:
  /// Strokes, what is drawn, or what is shown.
  void changed();

 private:
  struct Made;
  void forget();
  void follow();
  void makeField();
  void take(const Made& made);
  void hideField();
  void write(const QString& name, const std::vector<FieldStroke>& strokes);

  Session& session_;
  std::vector<FieldStroke> strokes_;
  std::optional<StrokePath> path_;
  int selected_ = -1;
  QString error_, strokesError_;
  bool shown_ = false;
  std::shared_ptr<const OrientationField> field_;
  std::vector<FieldKnot> knots_;
  std::shared_ptr<const PaintSurface> madeOn_;  // what field_, or the one on its way, belongs to
  std::optional<FieldRecipe> madeFor_;
  quint64 job_ = 0, run_ = 0;  // results of older runs are dropped
};

}  // namespace prt::ui
