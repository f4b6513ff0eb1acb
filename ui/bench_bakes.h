#pragma once
// How soon a bake shows something, and how soon it lets go: a part of `prt-studio --bench`.

#include <nlohmann/json_fwd.hpp>

namespace prt::ui {

class BenchHand;

/// Bakes the open scene anew for each of a list of moments, and cancels by the button in the jobs dock when
/// the moment has come: soon after the first preview, while rays are traced, while a checkpoint is written,
/// while the finished product is. Two objects, `bake_diffuse` and `bake_glossy` (matrices):
/// `first_preview_ms`, from the edit that starts the bake to the frame that shows its first preview, the
/// worst; `cancels`, how many; of these the worst `cancel_answered_ms`, to the painted "stopping", and
/// `cancel_done_ms`, to the end of the job, and the median `cancel_done_median_ms`.
nlohmann::json measureBakes(BenchHand& hand);

}  // namespace prt::ui
