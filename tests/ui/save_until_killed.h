#pragma once
// What a process does that the tour kills: it opens a project and saves it without end.

class QString;

namespace prt::test {

/// Touches RECOVERYROOT.saving whenever a save has begun. Never returns unless something fails.
int saveUntilKilled(const QString& project, const QString& recoveryRoot);

}  // namespace prt::test
