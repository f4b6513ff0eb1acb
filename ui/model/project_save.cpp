#include "ui/model/project_save.h"

#include "libprt/core/error.h"
#include "libprt/project/linked_files.h"
#include "ui/model/opened_project.h"

#include <algorithm>
#include <set>

namespace prt::ui {

namespace {

namespace fs = std::filesystem;

/// What serves the recipe; everything when that cannot be told because a file is missing.
ProjectFile::SaveOptions optionsFor(const SaveRequest& request, ProjectFile& store) {
  ProjectFile::SaveOptions options{{}, request.backups};
  try {
    options.keys = Pipeline(&store, {.folder = request.file.parent_path()}).liveKeys(request.recipe);
  } catch (const Error&) {
  }
  return options;
}

void putProducts(const std::map<std::string, ProductState>& products, ProjectFile& store) {
  for (const Stage& stage : stages()) {
    const auto found = products.find(stage.name);
    if (!stage.stored || found == products.end()) continue;
    const ProductState& state = found->second;
    store.put(stage.name, state.key, {state.product->save(), state.level, state.levels});
  }
}

}  // namespace

std::shared_ptr<ProjectFile> saveProject(const SaveRequest& request, Job& job) {
  job.begin("saving", 0);
  const bool same = request.store && request.store->file() == request.file;
  const std::shared_ptr<ProjectFile> store = same ? request.store : openStore(request.file);
  const bool fresh = !same && !store->resumed();
  try {
    if (!same && request.store) store->importFrom(*request.store);
    putProducts(request.products, *store);
    rememberSources(request.recipe, request.file.parent_path(), *store, job);
    store->saveKeepingWork(request.recipe, optionsFor(request, *store), job);
  } catch (...) {
    if (fresh) store->discardWork();  // nothing stays beside a file that was not written
    throw;
  }
  if (!same && request.baker) request.baker->store.moveTo(store);
  return store;
}

}  // namespace prt::ui
