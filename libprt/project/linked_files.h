#pragma once
// The files that a recipe names: which of them are there, finding those that moved, and bringing all of
// them together beside a project. A project remembers the content hash of each (ProductStore::sourceHash),
// so that a file can be told from another one of the same name.

#include "libprt/core/job.h"
#include "libprt/project/product.h"
#include "libprt/project/recipe.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace prt {

/// Tells all file paths of a recipe, relative ones seen from folder `from` and absolute ones, as seen from
/// folder `to`. Built-in ones stay.
void makePathsRelative(Recipe& recipe, const std::filesystem::path& from, const std::filesystem::path& to);

enum class LinkState {
  Present,
  Changed,  ///< there, with other contents than when the project was saved
  Missing
};

/// A file that a recipe names, however often.
struct LinkedFile {
  std::string path;                 ///< as the recipe says it
  std::vector<std::string> places;  ///< where: "objects[0].mesh.path"
  std::filesystem::path file;       ///< where it is, or should be
  LinkState state = LinkState::Present;
  std::string hash;  ///< of its contents when the project was saved; empty when that is not known
};

/// All of them, in the recipe's order. `store` may be null: nothing counts as changed then. Reads the files.
std::vector<LinkedFile> linkedFiles(const Recipe& recipe, const std::filesystem::path& folder,
                                    ProductStore* store, Job& job);

/// Remembers the contents of all files that are there.
void rememberSources(const Recipe& recipe, const std::filesystem::path& folder, ProductStore& store,
                     Job& job);

/// A file that may be one that is missing.
struct FoundFile {
  std::filesystem::path file;
  bool sameContents = false;  ///< as when the project was saved, or nothing is known to compare with
};

/// Looks through a folder and everything in it for files of the same names. Where several have a name, one
/// of the same contents wins, then the one least deep. By LinkedFile::path.
std::map<std::string, FoundFile> findMoved(const std::vector<LinkedFile>& missing,
                                           const std::filesystem::path& folder, Job& job);

/// Every place that says `path` says `other` from now on.
void relink(Recipe& recipe, const std::string& path, const std::string& other);

/// Copies every file that the recipe names, and what these refer to, into the folder `to`, and makes the
/// recipe say them from `project`. Files of one name get numbers. Throws FileError when one is missing or
/// cannot be written; the recipe is unchanged then.
void collectFiles(Recipe& recipe, const std::filesystem::path& folder, const std::filesystem::path& to,
                  const std::filesystem::path& project, Job& job);

}  // namespace prt
