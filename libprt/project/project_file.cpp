#include "libprt/project/project_file.h"

#include "libprt/project/project_schema.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace prt {
namespace {

namespace fs = std::filesystem;

/// Opens a database that is ours, or throws.
std::unique_ptr<Database> openChecked(const fs::path& file, Database::Mode mode) {
  auto database = std::make_unique<Database>(file, mode);
  database->execute("PRAGMA cell_size_check = ON");
  checkSchema(*database);
  return database;
}

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

std::string reason(int error) {
  return std::error_code(error, std::generic_category()).message();
}

void syncPath(const fs::path& path, int flags) {
  const int file = ::open(path.c_str(), flags);
  const int failed = file < 0 || ::fsync(file) != 0 ? errno : 0;
  if (file >= 0) ::close(file);
  if (failed)
    throw FileError("cannot be flushed to disk: " + reason(failed), path.string(), "check the disk");
}

fs::path folderOf(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
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

std::string checksumIn(Database& database) {
  return readProjectRow(database).checksum;
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
    base_ = readProjectRow(*database).base;
    if (base_ == base) {
      readProductRows(*database);
      Transaction transaction(*database);
      deleteOrphans(*database);
      transaction.commit();
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
  if (recipe == recipe_ && work_) return;
  Transaction transaction(work());
  recipe_ = recipe;
  writeProject();
  transaction.commit();
}

std::string ProjectFile::sourceHash(const std::string& path) {
  const auto found = sources_.find(path);
  return found == sources_.end() ? "" : found->second;
}

void ProjectFile::putSourceHash(const std::string& path, const std::string& hash) {
  if (!work_ || sourceHash(path) == hash) return;  // a reader learns nothing new that it must keep
  sources_[path] = hash;
  Transaction transaction(*work_);
  writeProject();
  transaction.commit();
}

std::unique_ptr<ProductStore::Stored> ProjectFile::read(const std::string& stage, const std::string& key,
                                                        const std::string& role) {
  for (const ProductRow& row : readProductRows(current())) {
    if (row.info.stage != stage || row.info.key != key || row.role != role) continue;
    auto stored = std::make_unique<Stored>();
    stored->level = row.info.level;
    stored->levels = row.info.levels;
    stored->data.meta = row.info.meta;
    for (const ArrayInfo& info : row.info.arrays)
      stored->data.arrays[info.name] = readArray(current(), row.id, info);
    return stored;
  }
  return nullptr;
}

void ProjectFile::write(const std::string& stage, const std::string& key, const std::string& role,
                        const Stored& stored) {
  Database& database = work();
  Transaction transaction(database);
  ProductInfo info{stage, key, role == kCheckpoint, stored.level, stored.levels, stored.data.meta, {}};
  const std::int64_t id = 1 + database.integer(
                                  "SELECT max(coalesce((SELECT max(id) FROM product), 0), coalesce((SELECT "
                                  "max(product) FROM array), 0))");
  std::size_t uncommitted = 0;
  for (const auto& [name, array] : stored.data.arrays) {
    info.arrays.push_back(
        {name, array.dtype, array.shape, 0, 0, writeArray(database, id, name, array, uncommitted)});
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
  written_ = true;
}

void ProjectFile::importFrom(ProjectFile& other) {
  for (const ProductRow& row : readProductRows(other.current())) {
    const ProductInfo& info = row.info;
    const auto there = read(info.stage, info.key, row.role);
    if (!there || there->level < info.level)
      write(info.stage, info.key, row.role, *other.read(info.stage, info.key, row.role));
  }
  for (const auto& [path, hash] : other.sources_)
    putSourceHash(rebasedPath(path, folderOf(other.file_), folderOf(file_)), hash);
}

std::unique_ptr<ProductStore::Stored> ProjectFile::find(const std::string& stage, const std::string& key) {
  return read(stage, key, kProduct);
}

void ProjectFile::put(const std::string& stage, const std::string& key, const Stored& stored) {
  write(stage, key, kProduct, stored);
}

std::unique_ptr<ProductData> ProjectFile::findCheckpoint(const std::string& stage, const std::string& key) {
  auto stored = read(stage, key, kCheckpoint);
  return stored ? std::make_unique<ProductData>(std::move(stored->data)) : nullptr;
}

void ProjectFile::putCheckpoint(const std::string& stage, const std::string& key, const ProductData& data) {
  write(stage, key, kCheckpoint, {data, 0, 0});
}

void ProjectFile::dropCheckpoint(const std::string& stage, const std::string& key) {
  Database& database = work();
  Transaction transaction(database);
  for (const ProductRow& row : readProductRows(database))
    if (row.info.stage == stage && row.info.key == key && row.role == kCheckpoint)
      deleteProduct(database, row.id);
  writeProject();
  transaction.commit();
}

std::vector<ProductInfo> ProjectFile::contents() {
  std::vector<ProductInfo> all;
  for (ProductRow& row : readProductRows(current())) all.push_back(std::move(row.info));
  return all;
}

void ProjectFile::keepOnly(const std::set<std::string>& keys) {
  Database& database = work();
  Transaction transaction(database);
  for (const ProductRow& row : readProductRows(database))
    if (!keys.contains(row.info.key)) deleteProduct(database, row.id);
  writeProject();
  transaction.commit();
  database.execute("PRAGMA incremental_vacuum");
}

void ProjectFile::save() {
  if (!work_) return;
  const fs::path from = work_->file();
  work_.reset();  // the last commit is on disk, the journal is gone
  try {
    syncPath(from, O_RDONLY);
    Job job;
    verify(from, job);  // a sound project is never replaced by one that is not
    if (::rename(from.c_str(), file_.c_str()) != 0)
      throw FileError("cannot be replaced: " + reason(errno), file_.string(),
                      "check its permissions and those of its folder");
  } catch (...) {
    resumeWork(from);
    throw;
  }
  saved_ = openChecked(file_, Database::Mode::ReadOnly);
  resumed_ = written_ = false;
  syncPath(folderOf(file_), O_RDONLY | O_DIRECTORY);
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
  if (!work_) return;
  const fs::path file = work_->file();
  work_.reset();
  removeWork(file);
  resumed_ = written_ = false;
  if (saved_) readProject();
}

std::int64_t ProjectFile::bytes() const {
  std::error_code error;
  return std::int64_t(fs::file_size(work_ ? work_->file() : file_, error));
}

ProjectFile::Verified ProjectFile::verify(const fs::path& file, Job& job) {
  checkHeader(file);
  const auto database = openChecked(file, Database::Mode::ReadOnly);
  Statement check(*database, "PRAGMA integrity_check(1)");
  if (!check.step() || check.text(0) != "ok")
    throw DamagedFile("is damaged: " + check.text(0), file.string(), "use a backup or bake again");
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
