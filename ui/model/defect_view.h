#pragma once
// Which defect of which object is shown on the surface: marks it and turns the view there.

#include "libprt/mesh/defect_list.h"

#include <QObject>

#include <optional>

namespace prt::ui {

class Session;

class DefectView : public QObject {
  Q_OBJECT
 public:
  explicit DefectView(Session& session, QObject* parent = nullptr);

  struct Shown {
    int object = 0;
    DefectKind kind = DefectKind::Holes;
    int element = -1;  ///< one of them, or -1: all that have a place
    bool operator==(const Shown&) const = default;
  };

  const std::optional<Shown>& shown() const { return shown_; }
  /// Marks all places of a class of defects and frames them.
  void show(int object, DefectKind kind);
  /// Of the class that is shown, marks the next (or the previous) element alone; past the ends, all again.
  void step(int by);
  void hide();
  /// Elements with a place of the class that is shown; 0 when nothing is.
  int elements() const;

 Q_SIGNALS:
  void changed();

 private:
  const DefectLine* line() const;
  void apply(bool frame);
  void follow();

  Session& session_;
  std::optional<Shown> shown_;
};

}  // namespace prt::ui
