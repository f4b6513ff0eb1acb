#pragma once
// 'Where is this bake wrong?': measures the errors of the finished bake in the background, judges them by the
// light of the moment, and lays them over the surface.

#include "libprt/transport/error_map.h"

#include <QObject>
#include <QTimer>

#include <memory>
#include <optional>

namespace prt::ui {

class Session;

enum class ErrorShown { Off, Total, MonteCarlo, Interpolation, Truncation };
inline constexpr int kErrorsShown = 5;

class ErrorEstimate : public QObject {
  Q_OBJECT
 public:
  explicit ErrorEstimate(Session& session, QObject* parent = nullptr);
  ~ErrorEstimate() override;

  ErrorShown shown() const { return shown_; }
  /// Shows one component, or all together; measures first when it must. Measuring needs a finished bake.
  void show(ErrorShown what);
  /// The next one: off, total, Monte Carlo, interpolation, truncation, off.
  void cycle() { show(ErrorShown((int(shown_) + 1) % kErrorsShown)); }
  /// Judge by all lights that may come instead of the light of the moment.
  bool byPrior() const { return byPrior_; }
  void setByPrior(bool prior);

  void measure();
  void cancel();
  bool measuring() const { return job_ != 0; }
  /// Whether a finished bake is there to be measured.
  bool possible() const;
  /// The errors of the bake that is shown; null while they are not known.
  const ErrorMap* map() const { return known_ ? &map_ : nullptr; }
  /// While false, interpolation is not known yet.
  bool complete() const { return known_ && complete_; }
  /// Whether the map is of the light of the moment; a moved light is judged behind the interface.
  bool upToDate() const;
  /// Relative error at the upper end of the colour scale: a round number that most of the surface stays
  /// below.
  double scaleEnd() const { return scaleEnd_; }

  /// What would help most, when it is clear: one setting, and what it would do.
  struct Suggestion {
    QString text;                                      ///< "More rays: 512 -> 2048"
    QString effect;                                    ///< "about 1.9 % -> 0.8 %"
    QString name;                                      ///< of the step of undo
    std::vector<std::pair<QString, QString>> changes;  ///< paths and values; empty: only advice
  };
  std::optional<Suggestion> suggestion() const;
  void applySuggestion();

 Q_SIGNALS:
  void changed();

 private:
  void follow();
  void received(quint64 job, ErrorProbe probe);
  void judge();
  void layOver();

  Session& session_;
  ErrorShown shown_ = ErrorShown::Off;
  bool byPrior_ = false;
  quint64 job_ = 0;
  std::shared_ptr<const Transfer> measured_;  // what the probe is, or will be, of
  std::shared_ptr<const ErrorProbe> probe_;
  ErrorMap map_;
  bool known_ = false, complete_ = false;  // the map is there; it knows interpolation
  double scaleEnd_ = 0;
  quint64 judgedLight_ = 0;                    // version of the light that the map is for, or will be
  bool judging_ = false, judgeAgain_ = false;  // in a job; the light has moved meanwhile
  QTimer rejudge_;                             // after the light has moved
};

/// "Monte Carlo", "total", ...
QString errorName(ErrorShown what);
/// "1.24 %".
QString percentText(double fraction);
/// The least 1, 2 or 5 times a power of ten that is not below.
double roundScale(double value);

}  // namespace prt::ui
