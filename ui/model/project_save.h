#pragma once
// Saving as a job: beside a bake, into the project's own file or another one.

#include "ui/model/baker.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>

namespace prt::ui {

struct SaveRequest {
  std::filesystem::path file;  ///< where to
  Recipe recipe;               ///< with paths from the file's folder
  int backups = 0;
  std::shared_ptr<Baker> baker;                  ///< what bakes; moves to the file
  std::shared_ptr<ProjectFile> store;            ///< what it bakes into so far; may be null
  std::map<std::string, ProductState> products;  ///< final ones, when there is no store
};

/// Saves, with the products and checkpoints that serve the recipe. Returns what the document bakes into from
/// now on. When it throws, file and store are as before.
std::shared_ptr<ProjectFile> saveProject(const SaveRequest& request, Job& job);

}  // namespace prt::ui
