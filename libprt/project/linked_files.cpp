#include "libprt/project/linked_files.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"
#include "libprt/project/recipe_table.h"
#include "libprt/project/source_hash.h"

#include <algorithm>
#include <system_error>

namespace prt {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxDepth = 12;               // of a search
constexpr std::size_t kMaxVisits = 200000;  // of a search: a whole disk is not looked through

/// Calls visit for every path of the recipe that means a file.
template <class Visit>
void forEachFile(Recipe& recipe, Visit visit) {
  forEachField(recipe, [&](const FieldPlace& place, const FieldRef& field) {
    if (place.parameter.type != ParameterType::File) return;
    std::string& path = *std::get<std::string*>(field);
    if (!path.empty() && !isBuiltin(path)) visit(place.path(), path);
  });
}

/// Files of a light that is not an environment are never read.
bool isRead(const Recipe& recipe, const std::string& place) {
  for (std::size_t i = 0; i < recipe.lights.size(); ++i)
    if (place.starts_with("lights[" + std::to_string(i) + "]"))
      return recipe.lights[i].kind == LightKind::Environment;
  return true;
}

std::string hashOrNothing(const fs::path& file) {
  try {
    return hashSource(file);
  } catch (const FileError&) {
    return {};  // went away meanwhile, or cannot be read
  }
}

std::string relativeTo(const fs::path& file, const fs::path& folder) {
  const fs::path from = fs::absolute(folder).lexically_normal();
  return file.lexically_normal().lexically_relative(from).generic_string();
}

}  // namespace

void makePathsRelative(Recipe& recipe, const fs::path& from, const fs::path& to) {
  forEachFile(recipe, [&](const std::string&, std::string& path) {
    path = relativeTo(fs::absolute(from) / path, to);
  });
}

std::vector<LinkedFile> linkedFiles(const Recipe& recipe, const fs::path& folder, ProductStore* store,
                                    Job& job) {
  std::vector<LinkedFile> files;
  Recipe copy = recipe;
  forEachFile(copy, [&](const std::string& place, const std::string& path) {
    if (!isRead(recipe, place)) return;
    const auto known =
        std::find_if(files.begin(), files.end(), [&](const LinkedFile& f) { return f.path == path; });
    if (known != files.end()) return known->places.push_back(place);
    files.push_back({path,
                     {place},
                     (fs::absolute(folder) / path).lexically_normal(),
                     LinkState::Present,
                     store ? store->sourceHash(path) : std::string()});
  });
  for (LinkedFile& each : files) {
    job.checkCancelled();
    std::error_code error;
    if (!fs::is_regular_file(each.file, error))
      each.state = LinkState::Missing;
    else if (!each.hash.empty() && hashOrNothing(each.file) != each.hash)
      each.state = LinkState::Changed;
  }
  return files;
}

void rememberSources(const Recipe& recipe, const fs::path& folder, ProductStore& store, Job& job) {
  for (const LinkedFile& each : linkedFiles(recipe, folder, nullptr, job)) {
    if (each.state == LinkState::Missing) continue;
    const std::string hash = hashOrNothing(each.file);
    if (!hash.empty()) store.putSourceHash(each.path, hash);
  }
}

std::map<std::string, FoundFile> findMoved(const std::vector<LinkedFile>& missing, const fs::path& folder,
                                           Job& job) {
  std::map<std::string, FoundFile> found;
  std::map<std::string, int> depths;
  std::error_code error;
  std::size_t visits = 0;
  job.begin("searching", 0, "files");
  auto at = fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied, error);
  for (; !error && at != fs::recursive_directory_iterator() && visits < kMaxVisits;
       at.increment(error), ++visits) {
    job.checkCancelled();
    job.advance(1);
    std::error_code ignored;
    if (at.depth() >= kMaxDepth) at.disable_recursion_pending();
    for (const LinkedFile& wanted : missing) {
      if (at->path().filename() != wanted.file.filename() || !at->is_regular_file(ignored)) continue;
      const bool same = wanted.hash.empty() || hashOrNothing(at->path()) == wanted.hash;
      const auto known = found.find(wanted.path);
      const bool better = known == found.end() || (same && !known->second.sameContents) ||
                          (same == known->second.sameContents && at.depth() < depths[wanted.path]);
      if (!better) continue;
      found[wanted.path] = {at->path(), same};
      depths[wanted.path] = at.depth();
    }
  }
  return found;
}

void relink(Recipe& recipe, const std::string& path, const std::string& other) {
  forEachFile(recipe, [&](const std::string&, std::string& each) {
    if (each == path) each = other;
  });
}

namespace {

/// A name in the folder that no other file has; `NAME-2.obj` when it must be.
fs::path freeName(const fs::path& folder, const fs::path& file, const std::vector<fs::path>& taken) {
  for (int n = 1;; ++n) {
    fs::path name = folder / file.stem();
    if (n > 1) name += '-' + std::to_string(n);
    name += file.extension();
    if (std::find(taken.begin(), taken.end(), name) == taken.end()) return name;
  }
}

void copyTo(const fs::path& from, const fs::path& to) {
  std::error_code error;
  if (fs::equivalent(from, to, error)) return;
  AtomicFile file(to);
  fs::copy_file(from, file.path(), fs::copy_options::overwrite_existing, error);
  if (error) throw FileError("cannot be copied: " + error.message(), from.string(), "check the disk");
  file.commit();
}

}  // namespace

void collectFiles(Recipe& recipe, const fs::path& folder, const fs::path& to, const fs::path& project,
                  Job& job) {
  const std::vector<LinkedFile> files = linkedFiles(recipe, folder, nullptr, job);
  for (const LinkedFile& each : files)
    if (each.state == LinkState::Missing)
      throw FileError("is missing", each.file.string(), "locate it first");
  std::error_code error;
  fs::create_directories(to, error);
  if (error) throw FileError("cannot be made: " + error.message(), to.string(), "check its permissions");
  Recipe collected = recipe;
  std::vector<fs::path> taken;
  job.begin("copying", double(files.size()), "files");
  for (const LinkedFile& each : files) {
    job.checkCancelled();
    const fs::path target = freeName(to, each.file.filename(), taken);
    taken.push_back(target);
    copyTo(each.file, target);
    for (const fs::path& part : filesBeside(each.file)) {
      const fs::path beside = to / part.lexically_relative(each.file.parent_path());
      fs::create_directories(beside.parent_path(), error);
      copyTo(part, beside);
      taken.push_back(beside);
    }
    relink(collected, each.path, relativeTo(fs::absolute(target), project));
    job.advance(1);
  }
  recipe = std::move(collected);
}

}  // namespace prt
