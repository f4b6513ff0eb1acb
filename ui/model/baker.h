#pragma once
// A pipeline with the file that keeps its products. The file can be exchanged while a bake writes to it:
// saving under another name moves the store, and the bake goes on in the new one.

#include "libprt/project/pipeline.h"
#include "libprt/project/project_file.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>

namespace prt::ui {

/// Passes everything on to a project file, or keeps nothing while there is none. Thread-safe.
class BakeStore : public ProductStore {
 public:
  explicit BakeStore(std::shared_ptr<ProjectFile> file) : file_(std::move(file)) {}

  std::shared_ptr<ProjectFile> file() const;
  /// From now on `next` is the store. It takes over what this one holds and it lacks.
  void moveTo(std::shared_ptr<ProjectFile> next);

  std::unique_ptr<Stored> find(const std::string& stage, const std::string& key) override;
  void put(const std::string& stage, const std::string& key, const Stored& stored,
           const WriteCheck& check = {}) override;
  std::unique_ptr<ProductData> findCheckpoint(const std::string& stage, const std::string& key) override;
  void putCheckpoint(const std::string& stage, const std::string& key, const ProductData& data,
                     const WriteCheck& check = {}) override;
  void dropCheckpoint(const std::string& stage, const std::string& key) override;
  std::string sourceHash(const std::string& path) override;
  void putSourceHash(const std::string& path, const std::string& hash) override;
  /// ProjectFile::keepRecent() of the file that is the store now.
  void keepRecent(const std::set<std::string>& keys, std::int64_t bytes, Job& job);

 private:
  mutable std::mutex mutex_;  // held while a call is passed on: none lands in a store that was left
  std::shared_ptr<ProjectFile> file_;
};

/// Seconds that a cancelled bake may still write. What does not fit is left: the last checkpoint stays.
inline constexpr double kLastWrites = 0.4;

/// Bytes of products that no longer serve the recipe, kept in the working copy for undo.
inline constexpr std::int64_t kKeptForUndo = std::int64_t(512) << 20;

/// What a document bakes with. One job at a time runs the pipeline; `store` is for everybody.
struct Baker {
  Baker(std::shared_ptr<ProjectFile> file, const std::filesystem::path& folder)
      : store(std::move(file)), pipeline(&store, {.folder = folder, .lastWriteSeconds = kLastWrites}) {}

  BakeStore store;
  Pipeline pipeline;
};

}  // namespace prt::ui
