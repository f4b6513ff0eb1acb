#pragma once
// How fast the studio follows the hand, measured through its real window: what `prt-studio --bench` prints.

#include <QString>

namespace prt::ui {

class MainWindow;
class Session;

struct BenchOptions {
  QString input;        ///< as Session::open() takes it
  int frames = 90;      ///< of each part; the one beside a bake takes four times as many
  bool charts = false;  ///< instead of all else, cut charts and drag their corners
};

/// Opens the input in a viewport of 1280 x 720 pixels and drives it by mouse events: the light is dragged
/// with a diffuse and with a glossy material (25 x 25 matrices), the exponent is slid, the view is turned,
/// and the light is dragged while a bake runs on the same cores; then bakes are started and cancelled
/// (bench_bakes.h). Or, where asked for, charts are cut (bench_charts.h). Prints one JSON object on stdout:
/// `viewport`, `drawing`, `vertices`, `open_to_first_preview_ms`, and for each of `light_drag`,
/// `light_drag_glossy`, `exponent_slide`, `orbit` and `while_baking` the number of `frames`, `fps`, and of
/// the times between frames `median_ms`, `p95_ms`, `p99_ms`, `worst_ms`, `coarse_frames` (how many had fewer
/// pixels than the screen); `edit_ms` and `draw_ms` are the medians of handling the event and of drawing,
/// `cpu_ms` is what a frame costs in processor time, all threads together. Returns the exit status: 1 with a
/// line on stderr when the input cannot be opened or baked.
int runBench(MainWindow& window, Session& session, const BenchOptions& options);

}  // namespace prt::ui
