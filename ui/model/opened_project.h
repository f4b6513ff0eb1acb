#pragma once
// What opening something brings: read on a job's thread, adopted by the document afterwards.

#include "libprt/project/linked_files.h"
#include "ui/model/baker.h"
#include "ui/model/recovery.h"

#include <QString>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace prt::ui {

struct OpenedProject {
  Recipe saved;                        ///< as in the file, or as it begins
  std::optional<Recipe> recovered;     ///< with edits that were never saved
  QString path;                        ///< of a project
  std::filesystem::path folder = "/";  ///< where the recipe's paths start
  std::shared_ptr<ProjectFile> file;   ///< where products are kept; null when there is no such place
  std::shared_ptr<Baker> baker;
  std::shared_ptr<RecoveryPlace> place;
  std::vector<LinkedFile> links;  ///< files that are missing or changed
  std::string problem;            ///< why there is nothing to see yet, when a file is missing
  std::string warning;            ///< why unsaved work would not survive a crash
  bool resumed = false;           ///< baked work of an earlier time is gone on with
};

struct OpenRequest {
  QString what;                          ///< a file, "scene:NAME" or "builtin:MESH"
  std::shared_ptr<ProjectFile> current;  ///< the open project: it is not opened twice
  std::filesystem::path recoveryRoot;
  std::shared_ptr<RecoveryPlace> recover;  ///< rather than `what`: what is kept there
};

/// Reads as far as it takes to know that it can be shown: the scene. What was read stays with the baker, so
/// the bake does not read it again. Throws what reading throws, but opens a project whose files are missing.
OpenedProject openProject(const OpenRequest& request, Job& job);

/// Opens the file that a document bakes into. When the last user lets it go, a working copy that holds
/// nothing new is removed.
std::shared_ptr<ProjectFile> openStore(const std::filesystem::path& file,
                                       std::shared_ptr<const RecoveryPlace> place = {});

}  // namespace prt::ui
