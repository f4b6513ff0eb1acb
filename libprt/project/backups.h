#pragma once
// Earlier saves of a project, kept beside it: NAME.backup1.prt is the save before the last, .backup2.prt
// the one before that. They are projects like any other. A saved project is never written to, only
// replaced, so a backup is a second name of the old file: made at once, whatever its size.

#include <filesystem>
#include <vector>

namespace prt {

/// The name of the n-th backup, counted from 1.
std::filesystem::path backupFile(const std::filesystem::path& project, int n);

/// Makes what is saved now the first backup, the first the second, and so on; those beyond `count` are
/// removed. Nothing happens when nothing is saved yet, or when it is the first backup already. Does not throw
/// for a folder that cannot be written to: the save that follows says so.
void keepBackup(const std::filesystem::path& project, int count);

/// The backups that there are, newest first.
std::vector<std::filesystem::path> backupsOf(const std::filesystem::path& project);

}  // namespace prt
