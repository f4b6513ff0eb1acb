// Saving while a bake goes on, and taking over what another project holds. Both copy rows as they are:
// nothing is decompressed, and every checksum stays.

#include "libprt/project/backups.h"
#include "libprt/project/project_disk.h"
#include "libprt/project/project_file.h"
#include "libprt/project/project_schema.h"

#include <nlohmann/json.hpp>

#include <system_error>
#include <utility>

namespace prt {
namespace {

namespace fs = std::filesystem;

/// A file that is removed again unless it was put in its place.
class FreshFile {
 public:
  explicit FreshFile(fs::path path) : path_(std::move(path)) { remove(); }
  ~FreshFile() { remove(); }
  FreshFile(const FreshFile&) = delete;
  FreshFile& operator=(const FreshFile&) = delete;
  const fs::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  fs::path path_;
};

void copyChunks(Database& from, std::int64_t array, Database& to, std::int64_t newArray, Job& job) {
  Statement chunks(from, "SELECT number, bytes, checksum, data FROM chunk WHERE array = ? ORDER BY number");
  chunks.bind(array);
  Statement insert(to, "INSERT INTO chunk(array, number, bytes, checksum, data) VALUES(?, ?, ?, ?, ?)");
  while (chunks.step()) {
    job.checkCancelled();
    insert.bind(newArray).bind(chunks.integer(0)).bind(chunks.integer(1)).bind(chunks.text(2));
    insert.bind(chunks.blob(3)).run();
  }
}

/// Copies a product with its arrays and chunks; inside a transaction of `to`.
void copyProduct(Database& from, std::int64_t id, Database& to, Job& job) {
  const std::int64_t newId = nextProductId(to);
  Statement arrays(from, "SELECT id, name, dtype, shape, checksum FROM array WHERE product = ?");
  arrays.bind(id);
  while (arrays.step()) {
    const std::int64_t newArray = nextArrayId(to);
    copyChunks(from, arrays.integer(0), to, newArray, job);
    Statement insert(to,
                     "INSERT INTO array(id, product, name, dtype, shape, checksum) VALUES(?, ?, ?, ?, ?, ?)");
    insert.bind(newArray).bind(newId).bind(arrays.text(1)).bind(arrays.text(2)).bind(arrays.text(3));
    insert.bind(arrays.text(4)).run();
  }
  Statement product(from, "SELECT stage, key, role, level, levels, meta, checksum FROM product WHERE id = ?");
  product.bind(id);
  if (!product.step())
    throw DamagedFile("is damaged: a product is missing", from.file().string(), "bake again");
  Statement insert(to,
                   "INSERT INTO product(id, stage, key, role, level, levels, meta, checksum) "
                   "VALUES(?, ?, ?, ?, ?, ?, ?, ?)");
  insert.bind(newId).bind(product.text(0)).bind(product.text(1)).bind(product.text(2));
  insert.bind(product.integer(3)).bind(product.integer(4)).bind(product.text(5)).bind(product.text(6)).run();
}

const ProductRow* findRow(const std::vector<ProductRow>& rows, const ProductRow& like) {
  for (const ProductRow& row : rows)
    if (row.info.stage == like.info.stage && row.info.key == like.info.key && row.role == like.role)
      return &row;
  return nullptr;
}

}  // namespace

void ProjectFile::importFrom(ProjectFile& other) {
  const std::scoped_lock lock(mutex_, other.mutex_);
  Job job;
  const std::vector<ProductRow> here = readProductRows(work());
  for (const ProductRow& row : readProductRows(other.current())) {
    const ProductRow* there = findRow(here, row);
    const bool checkpoint = row.role == kCheckpoint;  // has no level: the other's is the newer one
    if (there && (checkpoint ? productChecksum(there->info, row.role) == productChecksum(row.info, row.role)
                             : there->info.level >= row.info.level))
      continue;
    Transaction transaction(work());
    copyProduct(other.current(), row.id, work(), job);
    if (there) deleteProduct(work(), there->id);
    writeProject();
    transaction.commit();
    written_ = true;
  }
  for (const auto& [path, hash] : other.sources_)
    putSourceHash(rebasedPath(path, folderOf(other.file_), folderOf(file_)), hash);
}

/// A complete project of its own in a new file. Returns its checksum.
std::string ProjectFile::writeCopy(const fs::path& to, const SaveOptions& options, Job& job) {
  Database copy(to, Database::Mode::Create);
  prepareEmpty(copy);
  copy.execute("PRAGMA journal_mode = OFF");  // it is thrown away when anything fails
  copy.execute("PRAGMA synchronous = OFF");   // and flushed as a whole
  Transaction transaction(copy);
  createSchema(copy);
  for (const ProductRow& row : readProductRows(work())) {
    job.checkCancelled();
    if (!options.keys || options.keys->contains(row.info.key)) copyProduct(work(), row.id, copy, job);
  }
  writeProjectRow(copy, {{}, recipeToJson(recipe_).dump(2), nlohmann::json(sources_).dump(), base_, {}});
  transaction.commit();
  return checksumIn(copy);
}

void ProjectFile::saveKeepingWork(const Recipe& recipe, const SaveOptions& options, Job& job) {
  const FreshFile fresh(savingFile(file_));
  std::string checksum;
  bool hadWork = false;
  try {
    {
      std::lock_guard lock(mutex_);
      hadWork = std::exchange(written_, false);
      setRecipe(recipe);
      checksum = writeCopy(fresh.path(), options, job);
      // Whichever of the two a process that dies leaves under the file's name: the working copy began from
      // it.
      base_ = (saved_ ? checksumIn(*saved_) : "") + " " + checksum;
      rewriteProject();
    }
    syncFile(fresh.path());
    verify(fresh.path(), job);  // a sound project is never replaced by one that is not
    keepBackup(file_, options.backups);
    replaceFile(fresh.path(), file_);
  } catch (...) {
    std::lock_guard lock(mutex_);
    written_ = written_ || hadWork;
    throw;
  }
  std::lock_guard lock(mutex_);
  saved_ = openChecked(file_, Database::Mode::ReadOnly);
  base_ = checksum;
  rewriteProject();
  resumed_ = false;
  syncFolderOf(file_);
}

/// The project's row alone, as a commit of its own.
void ProjectFile::rewriteProject() {
  Transaction transaction(work());
  writeProject();
  transaction.commit();
}

}  // namespace prt
