#include "libprt/project/project_file.h"

#include "libprt/core/log.h"
#include "libprt/project/project_disk.h"
#include "libprt/project/project_schema.h"

#include <nlohmann/json.hpp>

#include <system_error>
#include <utility>

namespace prt {
namespace {

namespace fs = std::filesystem;

/// A working copy belongs to one process at a time and is flushed at every commit.
void claim(Database& database) {
  database.execute("PRAGMA locking_mode = EXCLUSIVE");
  database.execute("PRAGMA journal_mode = DELETE");
  database.execute("PRAGMA synchronous = NORMAL");
  database.execute("BEGIN IMMEDIATE");
  database.execute("COMMIT");
}

/// The journal goes first: left alone it would be played into the next working copy.
void removeWork(const fs::path& work) {
  std::error_code ignored;
  fs::remove(work.string() + "-journal", ignored);
  fs::remove(work, ignored);
}

void copyFile(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::copy_file(from, to, error);
  if (!error) return;
  removeWork(to);
  if (error == std::errc::no_space_on_device)
    throw ResourceError("the disk is full", to.string(),
                        "free some space and run again; what was saved is unchanged");
  throw FileError("cannot be written: " + error.message(), to.string(),
                  "check the space on the disk and the permissions of its folder");
}

/// Whether a working copy began from this saved project: one that was being saved names both.
bool beganFrom(const std::string& bases, const std::string& base) {
  const auto space = bases.find(' ');
  return bases.substr(0, space) == base || (space != std::string::npos && bases.substr(space + 1) == base);
}

}  // namespace

ProjectFile::ProjectFile(fs::path file) : file_(std::move(file)) {}
ProjectFile::~ProjectFile() = default;

fs::path ProjectFile::workFile(const fs::path& file) {
  return file.string() + ".work";
}

std::unique_ptr<ProjectFile> ProjectFile::open(const fs::path& file) {
  checkHeader(file);
  std::unique_ptr<ProjectFile> project(new ProjectFile(file));
  project->saved_ = openChecked(file, Database::Mode::ReadOnly);
  project->readProject();
  return project;
}

std::unique_ptr<ProjectFile> ProjectFile::openForWork(const fs::path& file) {
  std::error_code error;
  std::unique_ptr<ProjectFile> project;
  if (fs::exists(file, error))
    project = open(file);
  else
    project.reset(new ProjectFile(file));
  const std::string base = project->saved_ ? checksumIn(*project->saved_) : "";
  project->resumed_ = project->openLeftover(base);
  if (project->resumed_)
    project->readProject();
  else
    project->beginWork();
  fs::remove(savingFile(file), error);  // of a process that died while it saved
  return project;
}

/// Takes up the working copy of an earlier process, if it is sound and began from this very project.
bool ProjectFile::openLeftover(const std::string& base) {
  const fs::path file = workFile(file_);
  std::error_code error;
  if (!fs::exists(file, error)) return false;
  try {
    auto database = std::make_unique<Database>(file, Database::Mode::ReadWrite);
    claim(*database);  // plays back what an interrupted commit left
    checkHeader(file);
    checkSchema(*database);
    checkPages(*database);
    base_ = readProjectRow(*database).base;
    if (beganFrom(base_, base)) {
      readProductRows(*database);
      Transaction transaction(*database);
      deleteOrphans(*database);
      transaction.commit();
      base_ = base;
      work_ = std::move(database);
      return true;
    }
  } catch (const DamagedFile&) {
    // a copy that was never finished: begin a new one
  }
  removeWork(file);
  return false;
}

void ProjectFile::beginWork() {
  const fs::path file = workFile(file_);
  removeWork(file);
  base_ = saved_ ? checksumIn(*saved_) : "";
  if (saved_) {
    copyFile(file_, file);
    work_ = std::make_unique<Database>(file, Database::Mode::ReadWrite);
  } else {
    work_ = std::make_unique<Database>(file, Database::Mode::Create);
    prepareEmpty(*work_);
  }
  claim(*work_);
  Transaction transaction(*work_);
  if (!saved_) createSchema(*work_);
  writeProject();
  transaction.commit();
}

bool ProjectFile::saved() const {
  std::lock_guard lock(mutex_);
  return saved_ != nullptr;
}

bool ProjectFile::resumed() const {
  std::lock_guard lock(mutex_);
  return resumed_;
}

bool ProjectFile::hasNewWork() const {
  std::lock_guard lock(mutex_);
  return work_ && (resumed_ || written_);
}

Recipe ProjectFile::recipe() const {
  std::lock_guard lock(mutex_);
  return recipe_;
}

Database& ProjectFile::current() {
  if (!work_ && !saved_) throw FileError("can no longer be read", file_.string(), "open it again");
  return work_ ? *work_ : *saved_;
}

Database& ProjectFile::work() {
  if (!work_) beginWork();
  return *work_;
}

void ProjectFile::readProject() {
  const ProjectRow row = readProjectRow(current());
  recipe_ = recipeFromText(row.recipe, file_.string());
  sources_.clear();
  const auto sources = nlohmann::json::parse(row.sources, nullptr, false);
  if (!sources.is_object())
    throw DamagedFile("is damaged: its list of sources", file_.string(), "use a backup or bake again");
  for (const auto& [path, hash] : sources.items())
    if (hash.is_string()) sources_[path] = hash;
}

void ProjectFile::writeProject() {
  writeProjectRow(work(), {{}, recipeToJson(recipe_).dump(2), nlohmann::json(sources_).dump(), base_, {}});
}

void ProjectFile::setRecipe(const Recipe& recipe) {
  std::lock_guard lock(mutex_);
  if (recipe == recipe_ && work_) return;
  Transaction transaction(work());
  recipe_ = recipe;
  writeProject();
  transaction.commit();
}

std::string ProjectFile::sourceHash(const std::string& path) {
  std::lock_guard lock(mutex_);
  const auto found = sources_.find(path);
  return found == sources_.end() ? "" : found->second;
}

void ProjectFile::putSourceHash(const std::string& path, const std::string& hash) {
  std::lock_guard lock(mutex_);
  if (!work_ || sourceHash(path) == hash) return;  // a reader learns nothing new that it must keep
  sources_[path] = hash;
  Transaction transaction(*work_);
  writeProject();
  transaction.commit();
}

std::unique_ptr<ProductStore::Stored> ProjectFile::read(const std::string& stage, const std::string& key,
                                                        const std::string& role) {
  std::lock_guard lock(mutex_);
  for (const ProductRow& row : readProductRows(current())) {
    if (row.info.stage != stage || row.info.key != key || row.role != role) continue;
    try {
      auto stored = std::make_unique<Stored>();
      stored->level = row.info.level;
      stored->levels = row.info.levels;
      stored->data.meta = row.info.meta;
      for (const ArrayInfo& info : row.info.arrays)
        stored->data.arrays[info.name] = readArray(current(), row.id, info);
      return stored;
    } catch (const DamagedFile& error) {
      if (!work_) throw;  // whoever only reads is told
      logWarning(std::string(error.what()) + "; the " + role + " of stage " + stage + " is made anew");
      drop(row.id);
    }
  }
  return nullptr;
}

/// Removes one product or checkpoint from the working copy, in a commit of its own.
void ProjectFile::drop(std::int64_t id) {
  Transaction transaction(work());
  deleteProduct(work(), id);
  writeProject();
  transaction.commit();
  written_ = true;
}

void ProjectFile::write(const std::string& stage, const std::string& key, const std::string& role,
                        const Stored& stored, const WriteCheck& check) {
  std::lock_guard lock(mutex_);
  Database& database = work();
  Transaction transaction(database);
  if (std::exchange(orphans_, true)) deleteOrphans(database);
  ProductInfo info{stage, key, role == kCheckpoint, stored.level, stored.levels, stored.data.meta, {}};
  const std::int64_t id = nextProductId(database);
  std::size_t uncommitted = 0;
  for (const auto& [name, array] : stored.data.arrays) {
    info.arrays.push_back(
        {name, array.dtype, array.shape, 0, 0, writeArray(database, id, name, array, uncommitted, check)});
  }
  // The row that makes it a product comes last, together with the end of the one that it replaces.
  for (const ProductRow& row : readProductRows(database))
    if (row.info.stage == stage && row.role == role && row.info.key == key) deleteProduct(database, row.id);
  Statement insert(database,
                   "INSERT INTO product(id, stage, key, role, level, levels, meta, checksum) VALUES(?, ?, ?, "
                   "?, ?, ?, ?, ?)");
  insert.bind(id)
      .bind(stage)
      .bind(key)
      .bind(role)
      .bind(std::int64_t(info.level))
      .bind(std::int64_t(info.levels));
  insert.bind(info.meta).bind(productChecksum(info, role)).run();
  writeProject();
  transaction.commit();
  orphans_ = false;
  written_ = true;
}

std::unique_ptr<ProductStore::Stored> ProjectFile::find(const std::string& stage, const std::string& key) {
  return read(stage, key, kProduct);
}

void ProjectFile::put(const std::string& stage, const std::string& key, const Stored& stored,
                      const WriteCheck& check) {
  write(stage, key, kProduct, stored, check);
}

std::unique_ptr<ProductData> ProjectFile::findCheckpoint(const std::string& stage, const std::string& key) {
  auto stored = read(stage, key, kCheckpoint);
  return stored ? std::make_unique<ProductData>(std::move(stored->data)) : nullptr;
}

void ProjectFile::putCheckpoint(const std::string& stage, const std::string& key, const ProductData& data,
                                const WriteCheck& check) {
  write(stage, key, kCheckpoint, {data, 0, 0}, check);
}

void ProjectFile::dropCheckpoint(const std::string& stage, const std::string& key) {
  std::lock_guard lock(mutex_);
  Database& database = work();
  Transaction transaction(database);
  for (const ProductRow& row : readProductRows(database))
    if (row.info.stage == stage && row.info.key == key && row.role == kCheckpoint)
      deleteProduct(database, row.id);
  writeProject();
  transaction.commit();
}

std::vector<ProductInfo> ProjectFile::contents() {
  std::lock_guard lock(mutex_);
  std::vector<ProductInfo> all;
  for (ProductRow& row : readProductRows(current())) all.push_back(std::move(row.info));
  return all;
}

void ProjectFile::save() {
  std::lock_guard lock(mutex_);
  if (!work_) return;
  if (orphans_) {
    Transaction transaction(*work_);
    deleteOrphans(*work_);
    transaction.commit();
    orphans_ = false;
  }
  const fs::path from = work_->file();
  work_.reset();  // the last commit is on disk, the journal is gone
  try {
    syncFile(from);
    Job job;
    verify(from, job);  // a sound project is never replaced by one that is not
    replaceFile(from, file_);
  } catch (...) {
    resumeWork(from);
    throw;
  }
  saved_ = openChecked(file_, Database::Mode::ReadOnly);
  resumed_ = written_ = false;
  syncFolderOf(file_);
}

/// After a save that failed: the working copy is as good as before, so that another save can be tried.
void ProjectFile::resumeWork(const fs::path& file) {
  try {
    auto database = std::make_unique<Database>(file, Database::Mode::ReadWrite);
    claim(*database);
    work_ = std::move(database);
  } catch (const Error&) {  // what failed first is what gets told
  }
}

void ProjectFile::discardWork() {
  std::lock_guard lock(mutex_);
  if (!work_) return;
  const fs::path file = work_->file();
  work_.reset();
  removeWork(file);
  resumed_ = written_ = false;
  if (saved_) readProject();
}

std::int64_t ProjectFile::bytes() const {
  std::lock_guard lock(mutex_);
  std::error_code error;
  return std::int64_t(fs::file_size(work_ ? work_->file() : file_, error));
}

ProjectFile::Verified ProjectFile::verify(const fs::path& file, Job& job) {
  checkHeader(file);
  const auto database = openChecked(file, Database::Mode::ReadOnly);
  checkPages(*database);
  recipeFromText(readProjectRow(*database).recipe, file.string());
  const std::vector<ProductRow> rows = readProductRows(*database);
  Verified sum{int(rows.size()), 0, database->integer("SELECT count(*) FROM chunk"), 0};
  double total = 0;
  for (const ProductRow& row : rows)
    for (const ArrayInfo& array : row.info.arrays) total += double(array.bytes);
  job.begin("verifying", total, "bytes");
  for (const ProductRow& row : rows) {
    for (const ArrayInfo& info : row.info.arrays) {
      job.checkCancelled();
      readArray(*database, row.id, info);
      ++sum.arrays;
      sum.bytes += info.bytes;
      job.advance(double(info.bytes));
    }
  }
  return sum;
}

}  // namespace prt
