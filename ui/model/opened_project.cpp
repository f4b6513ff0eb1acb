#include "ui/model/opened_project.h"

#include "libprt/core/error.h"
#include "libprt/project/scenes.h"

#include <system_error>
#include <utility>

namespace prt::ui {

namespace {

namespace fs = std::filesystem;

/// A document without a file bakes into its recovery place: nothing of it is lost by a crash.
void keepUntitled(OpenedProject& opened, const OpenRequest& request) {
  try {
    if (!opened.place) opened.place = RecoveryPlace::create(request.recoveryRoot);
    opened.file = openStore(opened.place->project(), opened.place);
  } catch (const Error& error) {
    opened.warning = error.what();
  }
}

void openFile(OpenedProject& opened, const fs::path& file, const OpenRequest& request, Job& job) {
  opened.path = QString::fromStdString(file.string());
  opened.folder = file.parent_path();
  const auto saved = ProjectFile::open(file);
  opened.saved = saved->recipe();
  opened.links = linkedFiles(opened.saved, opened.folder, saved.get(), job);
  std::erase_if(opened.links, [](const LinkedFile& link) { return link.state == LinkState::Present; });
  const bool again = request.current && request.current->file() == file;
  opened.file = again ? request.current : openStore(file);
  opened.resumed = !again && opened.file->resumed();
  try {
    if (!opened.place) opened.place = RecoveryPlace::create(request.recoveryRoot);
  } catch (const Error& error) {
    opened.warning = error.what();
  }
}

void openRecovered(OpenedProject& opened, const OpenRequest& request, Job& job) {
  const auto entry = request.recover->read();
  if (!entry)
    throw FileError("holds nothing to recover", request.recover->folder().string(), "open the project");
  opened.place = request.recover;
  opened.recovered = entry->recipe;
  const fs::path file = entry->path.toStdString();
  std::error_code error;
  if (!file.empty() && fs::exists(file, error)) return openFile(opened, file, request, job);
  opened.saved = entry->saved;
  if (!file.empty())  // the project is gone: its recipe is not
    for (Recipe* recipe : {&opened.saved, &*opened.recovered})
      makePathsRelative(*recipe, file.parent_path(), "/");
  keepUntitled(opened, request);
}

void openSource(OpenedProject& opened, const OpenRequest& request, Job& job) {
  RecipeSource source = openRecipe(request.what.toStdString());
  if (!source.project.empty()) return openFile(opened, source.project, request, job);
  opened.saved = std::move(source.recipe);
  makePathsRelative(opened.saved, source.folder, "/");
  keepUntitled(opened, request);
}

}  // namespace

std::shared_ptr<ProjectFile> openStore(const fs::path& file, std::shared_ptr<const RecoveryPlace> place) {
  // The place is let go after the file in it.
  const auto release = [place = std::move(place)](ProjectFile* store) {
    try {
      if (!store->hasNewWork()) store->discardWork();
    } catch (const Error&) {  // it stays beside the project; the next time sees to it
    }
    delete store;
  };
  return {ProjectFile::openForWork(file).release(), release};
}

OpenedProject openProject(const OpenRequest& request, Job& job) {
  OpenedProject opened;
  request.recover ? openRecovered(opened, request, job) : openSource(opened, request, job);
  opened.baker = std::make_shared<Baker>(opened.file, opened.folder);
  try {
    opened.baker->pipeline.run(opened.recovered.value_or(opened.saved), {"scene"}, job);
  } catch (const FileError& error) {
    if (opened.links.empty()) throw;
    opened.problem = error.what();
  }
  return opened;
}

}  // namespace prt::ui
