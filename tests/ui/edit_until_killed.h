#pragma once
// What a process does that a test kills: edits, is autosaved, bakes and saves without end.

class QString;

namespace prt::test {

/// Opens the project and writes "kept N" and "saved N" to RECOVERYROOT.log once the edit that turned the
/// environment to N hundredths of a degree is where a kill cannot reach it. Never returns unless something
/// fails.
int editUntilKilled(const QString& project, const QString& recoveryRoot);

}  // namespace prt::test
