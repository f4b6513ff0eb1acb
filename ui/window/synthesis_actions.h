#pragma once
// The menu of what lays the patch over the surface: strokes that the orientation field follows,
// wishes for parts of the patch.

#include <functional>

class QMenu;

namespace prt::ui {

class Session;

/// `show` brings the Synthesis dock to light.
void fillSynthesisMenu(QMenu& menu, Session& session, const std::function<void()>& show);

}  // namespace prt::ui
