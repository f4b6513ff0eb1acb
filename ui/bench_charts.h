#pragma once
// How soon charts follow the hand: a part of `prt-studio --bench`.

#include <nlohmann/json_fwd.hpp>

namespace prt::ui {

class BenchHand;

/// Cuts the built-in bird by itself, then works on its largest chart: moves a corner, and cuts an edge in
/// from its rim. One object, `charts`: `faces` of that chart; of both gestures the worst of several, in
/// milliseconds from the edit, `..._edit_ms` until the interface is free again (charts and colours are known
/// then), `..._start_ms` until the chart is laid flat on its boundary, `..._step_ms` until the first step
/// towards the minimum is shown.
nlohmann::json measureCharts(BenchHand& hand);

}  // namespace prt::ui
