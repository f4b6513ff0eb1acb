#include "ui/model/error_estimate.h"

#include "libprt/project/errors.h"
#include "ui/model/expression.h"
#include "ui/model/session.h"

#include <algorithm>
#include <cmath>

namespace prt::ui {

namespace {

constexpr int kRejudgeMilliseconds = 40;
constexpr double kMostBelow = 0.98;  // of the surface lies below the end of the scale
constexpr double kSmallestScale = 1e-3;
constexpr double kClear = 0.5;         // share of the mean square from which one cause is the cause
constexpr double kGoodEnough = 0.005;  // nobody sees less
constexpr int kMoreRays = 4, kMoreBands = 3, kMostBands = 10, kMostRays = 1 << 20;
constexpr double kMeshFactor = 1.5, kMostDetail = 16;
constexpr double kNoiseExponent = 0.8;  // error against rays, as measured in docs/transfer.md

float valueOf(const ErrorMap& map, std::size_t vertex, ErrorShown what) {
  if (what == ErrorShown::Total) return map.total(vertex);
  return map.vertices[vertex][int(what) - int(ErrorShown::MonteCarlo)];
}

double quantile(std::vector<float> values, double share) {
  std::erase_if(values, [](float v) { return v < 0; });
  if (values.empty()) return 0;
  const auto nth = values.begin() + std::ptrdiff_t(share * double(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return double(*nth);
}

QString arrow(const QString& from, const QString& to) {
  return from + QStringLiteral(" \u2192 ") + to;
}

}  // namespace

QString errorName(ErrorShown what) {
  switch (what) {
    case ErrorShown::Off:
      return QObject::tr("off");
    case ErrorShown::Total:
      return QObject::tr("total");
    case ErrorShown::MonteCarlo:
      return QObject::tr("Monte Carlo");
    case ErrorShown::Interpolation:
      return QObject::tr("interpolation");
    case ErrorShown::Truncation:
      return QObject::tr("truncation");
  }
  return {};
}

QString percentText(double fraction) {
  const double percent = 100 * fraction;
  return QObject::tr("%1 %").arg(percent, 0, 'f', percent < 9.995 ? 2 : 1);
}

double roundScale(double value) {
  if (!(value > 0)) return 0;
  const double unit = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * unit * 1.0000001) return step * unit;
  return 10 * unit;
}

ErrorEstimate::ErrorEstimate(Session& session, QObject* parent) : QObject(parent), session_(session) {
  rejudge_.setSingleShot(true);
  rejudge_.setInterval(kRejudgeMilliseconds);
  connect(&rejudge_, &QTimer::timeout, this, &ErrorEstimate::judge);
  connect(&session_.relighter(), &Relighter::changed, this, &ErrorEstimate::follow);
  connect(&session_.bakes(), &BakeController::changed, this, &ErrorEstimate::follow);
}

ErrorEstimate::~ErrorEstimate() = default;

bool ErrorEstimate::possible() const {
  const Relighter& lit = session_.relighter();
  return lit.scene() && lit.samples() && !lit.samples()->texels && lit.transfer() &&
         lit.transfer()->final() && session_.bakes().fresh();
}

void ErrorEstimate::show(ErrorShown what) {
  if (what == shown_) return;
  shown_ = what;
  if (shown_ != ErrorShown::Off && !known_ && !measuring()) measure();
  layOver();
  Q_EMIT changed();
}

void ErrorEstimate::setByPrior(bool prior) {
  if (prior == byPrior_) return;
  byPrior_ = prior;
  judge();
}

void ErrorEstimate::measure() {
  if (!possible() || measuring()) return;
  const Relighter& lit = session_.relighter();
  measured_ = lit.transfer();
  probe_.reset();
  known_ = false;
  // The job may not outlive the session: it is waited for before this object goes.
  const auto id = std::make_shared<quint64>(0);
  const auto deliver = [this, id](ErrorProbe probe) {
    QMetaObject::invokeMethod(
        this, [this, id, probe = std::move(probe)] { received(*id, probe); }, Qt::QueuedConnection);
  };
  const auto work = [scene = lit.scene(), samples = lit.samples(), transfer = measured_,
                     recipe = session_.document().recipe(), deliver](Job& job) {
    deliver(probeErrors(*scene, *samples, transfer, recipe, job, deliver));
  };
  const auto finish = [this, id](const JobInfo& info) {
    if (*id != job_) return;
    job_ = 0;
    if (info.state == JobState::Failed) session_.report(Severity::Error, info.error, Place::Transfer);
    if (info.state != JobState::Done && !probe_) shown_ = ErrorShown::Off;  // or it would begin again
    layOver();
    Q_EMIT changed();
  };
  *id = job_ = session_.jobs().start(QStringLiteral("errors"), tr("Estimate errors"), work, finish);
  Q_EMIT changed();
}

void ErrorEstimate::cancel() {
  if (measuring()) session_.jobs().cancel(job_);
}

void ErrorEstimate::received(quint64 job, ErrorProbe probe) {
  if (measured_ != session_.relighter().transfer() || (job_ != 0 && job != job_)) return;
  probe_ = std::make_shared<const ErrorProbe>(std::move(probe));
  judge();
}

// What was measured may no longer be what is shown; the light may have moved.
void ErrorEstimate::follow() {
  const auto& transfer = session_.relighter().transfer();
  if (measured_ && transfer != measured_) {
    cancel();
    job_ = 0;
    measured_.reset();
    probe_.reset();
    known_ = false;
    layOver();
    Q_EMIT changed();
  }
  if (shown_ != ErrorShown::Off && !probe_ && !measuring() && possible()) measure();
  if (probe_ && !byPrior_ && judgedLight_ != session_.relighter().lightVersion() && !rejudge_.isActive())
    rejudge_.start();
}

bool ErrorEstimate::upToDate() const {
  return known_ && !judging_ && !rejudge_.isActive() &&
         (byPrior_ || judgedLight_ == session_.relighter().lightVersion());
}

// In a job: on large meshes it takes longer than a frame. One at a time, and after it at most one more.
void ErrorEstimate::judge() {
  if (!probe_) return;
  judgeAgain_ = judging_;
  if (judging_) return;
  judging_ = true;
  const Relighter& lit = session_.relighter();
  judgedLight_ = lit.lightVersion();
  auto map = std::make_shared<ErrorMap>();
  const auto work = [map, probe = probe_, prior = byPrior_,
                     light = judgedLight(lit.wholeLight(), lit.bands(), lit.method())](Job&) {
    *map = prior ? probe->underPrior() : probe->under(light);
  };
  const auto finish = [this, map, probe = probe_](const JobInfo& info) {
    judging_ = false;
    if (info.state == JobState::Failed) session_.report(Severity::Error, info.error, Place::Transfer);
    if (info.state == JobState::Done && probe == probe_) {
      map_ = std::move(*map);
      known_ = true;
      complete_ = probe->knowsInterpolation();
      layOver();
      Q_EMIT changed();
    }
    if (judgeAgain_) judge();
  };
  session_.jobs().startQuietly(QStringLiteral("judge errors"), tr("Judge errors"), work, finish);
}

void ErrorEstimate::layOver() {
  if (!known_ || shown_ == ErrorShown::Off) {
    session_.layers().setValues({});
    return;
  }
  std::vector<float> values(map_.vertices.size());
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = valueOf(map_, v, shown_);
  scaleEnd_ = roundScale(std::max(kSmallestScale, quantile(values, kMostBelow)));
  for (float& value : values)
    if (value >= 0) value = float(double(value) / scaleEnd_);
  session_.layers().setValues(std::move(values));
}

std::optional<ErrorEstimate::Suggestion> ErrorEstimate::suggestion() const {
  if (!complete() || map_.totalRms() < kGoodEnough) return {};
  const Recipe& recipe = session_.document().recipe();
  const double total = map_.totalRms();
  const auto without = [&](int component, double left) {
    DVec3 rms = map_.rms;
    rms[component] *= left;
    return tr("about %1").arg(arrow(percentText(total), percentText(length(rms))));
  };
  if (map_.share(ErrorMap::MonteCarlo) > kClear) {
    const int rays = std::min(kMoreRays * recipe.transfer.rays, kMostRays);
    if (rays == recipe.transfer.rays) return {};
    return Suggestion{
        tr("More rays: %1").arg(arrow(formatCount(recipe.transfer.rays), formatCount(rays))),
        without(ErrorMap::MonteCarlo, std::pow(double(recipe.transfer.rays) / rays, kNoiseExponent)),
        tr("More rays"),
        {{QStringLiteral("transfer.rays"), QString::number(rays)}}};
  }
  if (map_.share(ErrorMap::Truncation) > kClear) {
    const int bands = std::min(recipe.transfer.bands + kMoreBands, kMostBands);
    if (bands == recipe.transfer.bands)
      return Suggestion{
          tr("The light is sharper than 10 bands"), tr("a softer light, or a window, rings less"), {}, {}};
    return Suggestion{
        tr("More bands: %1").arg(arrow(QString::number(recipe.transfer.bands), QString::number(bands))),
        tr("less blurred shadows; stores %1 times as much")
            .arg(std::pow(double(bands) / recipe.transfer.bands, 2), 0, 'f', 1),
        tr("More bands"),
        {{QStringLiteral("transfer.bands"), QString::number(bands)}}};
  }
  if (map_.share(ErrorMap::Interpolation) <= kClear) return {};
  Suggestion finer{tr("A finer mesh"),
                   without(ErrorMap::Interpolation, 1 / (kMeshFactor * kMeshFactor)),
                   tr("Finer mesh"),
                   {}};
  for (std::size_t i = 0; i < recipe.objects.size(); ++i) {
    const MeshRecipe& mesh = recipe.objects[i].mesh;
    if (!isBuiltin(mesh.path)) continue;
    finer.changes.emplace_back(QStringLiteral("objects[%1].mesh.detail").arg(i),
                               QString::number(std::min(kMeshFactor * double(mesh.detail), kMostDetail)));
  }
  if (finer.changes.empty()) finer.effect = tr("subdivide the file's mesh where the shadows end");
  return finer;
}

void ErrorEstimate::applySuggestion() {
  const auto wanted = suggestion();
  if (!wanted || wanted->changes.empty()) return;
  const Gesture gesture(session_.document(), wanted->name);
  for (const auto& [path, value] : wanted->changes) session_.document().set(path, value);
}

}  // namespace prt::ui
