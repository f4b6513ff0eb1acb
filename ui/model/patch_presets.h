#pragma once
// Patches to begin with: one for every built-in generator, applied as one step of undo.

#include "libprt/core/image.h"
#include "libprt/core/job.h"
#include "libprt/meso/patch_build.h"
#include "ui/model/document.h"

#include <QString>

#include <vector>

namespace prt::ui {

class LayerEditor;

struct PatchPreset {
  QString name, about;
  PatchOptions options;
};
const std::vector<PatchPreset>& patchPresets();

/// The preset that these options are, reflection apart; -1: none.
int patchPresetOf(const PatchOptions& options);
/// Shape and texture as in the preset, for the patch that is worked on; reflection stays, but where the
/// preset has colours of its own.
void applyPatchPreset(const LayerEditor& layers, Document& document, const PatchPreset& preset);

/// Small pictures of them as patchPicture() makes them; `pixels` a side.
std::vector<Image> patchPictures(int pixels, Job& job);

}  // namespace prt::ui
