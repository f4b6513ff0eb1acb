#pragma once
// The project file (.prt): one SQLite database with the recipe as JSON and the products as compressed,
// checksummed chunks. docs/file-format.md describes it for readers in other languages.
//
// Saved state and work. The file under its own name is only ever a complete, saved project. Whatever is
// written goes to a working copy beside it, FILE.work, which save() swaps in atomically. A process that
// dies leaves the saved project as it was; the working copy, brought back to its last commit by SQLite,
// is where the next bake goes on.
//
// Threads. Any thread may call any function: a project can be saved while a bake writes to it.

#include "libprt/core/job.h"
#include "libprt/project/product.h"
#include "libprt/project/recipe.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace prt {

class Database;

/// Version of the schema that this program writes (SQLite's user_version); it reads no newer one.
inline constexpr int kProjectFormat = 1;

struct ArrayInfo {
  std::string name;
  DType dtype = DType::f32;
  std::vector<std::int64_t> shape;
  std::int64_t bytes = 0;   ///< uncompressed
  std::int64_t stored = 0;  ///< compressed
  std::string checksum;     ///< of the stored chunks: equal checksums mean equal contents
};

struct ProductInfo {
  std::string stage;
  std::string key;
  bool checkpoint = false;  ///< unfinished work rather than a product
  int level = 0;
  int levels = 0;
  std::string meta;  ///< JSON
  std::vector<ArrayInfo> arrays;
};

class ProjectFile : public ProductStore {
 public:
  /// Opens a saved project; writing begins a working copy. Throws FileError: missing, a folder, no
  /// project, truncated, newer than this program, damaged.
  static std::unique_ptr<ProjectFile> open(const std::filesystem::path& file);

  /// Opens for baking: the saved project, with work that was left behind by a cancelled or killed bake
  /// of it, or a new one when there is none. Throws FileError also when another process works on it.
  static std::unique_ptr<ProjectFile> openForWork(const std::filesystem::path& file);

  ~ProjectFile() override;

  const std::filesystem::path& file() const { return file_; }
  static std::filesystem::path workFile(const std::filesystem::path& file);
  /// Work of an earlier process was found.
  bool resumed() const;
  /// There is a saved state under the file's own name.
  bool saved() const;
  /// The working copy holds products or checkpoints that the saved project does not.
  bool hasNewWork() const;

  Recipe recipe() const;
  void setRecipe(const Recipe& recipe);

  /// Throws FileError when what is stored is damaged. In a working copy it is removed instead, with a
  /// warning, and counts as not there: whoever bakes makes it anew.
  std::unique_ptr<Stored> find(const std::string& stage, const std::string& key) override;
  void put(const std::string& stage, const std::string& key, const Stored& stored,
           const WriteCheck& check = {}) override;
  std::unique_ptr<ProductData> findCheckpoint(const std::string& stage, const std::string& key) override;
  void putCheckpoint(const std::string& stage, const std::string& key, const ProductData& data,
                     const WriteCheck& check = {}) override;
  void dropCheckpoint(const std::string& stage, const std::string& key) override;
  std::string sourceHash(const std::string& path) override;
  void putSourceHash(const std::string& path, const std::string& hash) override;

  std::vector<ProductInfo> contents();

  /// Takes over what another project has and this one lacks, compressed as it is.
  void importFrom(ProjectFile& other);

  /// Removes every product and checkpoint whose key is not among these (Pipeline::liveKeys), and gives
  /// the space back.
  void keepOnly(const std::set<std::string>& keys);
  /// Bounds what the working copy holds beside the products of these keys (what undo may want again): the
  /// oldest go until the rest of them takes no more than `bytes` in the file. What is saved stays.
  void keepRecent(const std::set<std::string>& keys, std::int64_t bytes, Job& job);

  /// Makes the working copy the saved project: flushed to disk, verified, then renamed over it. When that
  /// fails the saved project and the working copy are as before, and it can be tried again.
  void save();
  struct SaveOptions {
    /// Products and checkpoints to save (Pipeline::liveKeys); absent: all.
    std::optional<std::set<std::string>> keys = {};
    int backups = 0;  ///< see project/backups.h
  };
  /// Saves while work goes on: writes a complete project beside the file, verifies it and renames it over
  /// the file. The working copy stays, with everything in it: whoever bakes waits for the copying of rows at
  /// most. When it fails or is cancelled the saved project is as before.
  void saveKeepingWork(const Recipe& recipe, const SaveOptions& options, Job& job);
  /// Throws the working copy away.
  void discardWork();

  /// Bytes in this file, and of them in products.
  std::int64_t bytes() const;

  struct Verified {
    int products = 0;
    int arrays = 0;
    std::int64_t chunks = 0;
    std::int64_t bytes = 0;  ///< uncompressed
  };
  /// Reads everything and compares every checksum. Throws FileError naming what is damaged.
  static Verified verify(const std::filesystem::path& file, Job& job);

 private:
  explicit ProjectFile(std::filesystem::path file);

  Database& current();
  Database& work();
  bool openLeftover(const std::string& base);
  void beginWork();
  void resumeWork(const std::filesystem::path& file);
  void readProject();
  void writeProject();
  void rewriteProject();
  std::string writeCopy(const std::filesystem::path& to, const SaveOptions& options, Job& job);
  std::unique_ptr<Stored> read(const std::string& stage, const std::string& key, const std::string& role);
  void write(const std::string& stage, const std::string& key, const std::string& role, const Stored& stored,
             const WriteCheck& check);
  void drop(std::int64_t id);

  mutable std::recursive_mutex mutex_;  // guards everything below but file_
  const std::filesystem::path file_;
  std::unique_ptr<Database> saved_, work_;
  Recipe recipe_;
  std::map<std::string, std::string> sources_;
  // Checksum of the saved project that the working copy began from; while it is being saved, of both.
  std::string base_;
  bool resumed_ = false, written_ = false;
  bool orphans_ = false;  // a write was broken off: what it left goes with the next one
};

}  // namespace prt
