// What a project no longer needs goes, and its space is given back.

#include "libprt/project/project_file.h"
#include "libprt/project/project_schema.h"

#include <algorithm>
#include <utility>

namespace prt {
namespace {

const char* const kVacuumStep = "PRAGMA incremental_vacuum(128)";  // pages of 64 KiB: 8 MB

}  // namespace

void ProjectFile::keepOnly(const std::set<std::string>& keys) {
  std::lock_guard lock(mutex_);
  Database& database = work();
  Transaction transaction(database);
  for (const ProductRow& row : readProductRows(database))
    if (!keys.contains(row.info.key)) deleteProduct(database, row.id);
  writeProject();
  transaction.commit();
  database.execute("PRAGMA incremental_vacuum");
}

void ProjectFile::keepRecent(const std::set<std::string>& keys, std::int64_t bytes, Job& job) {
  std::lock_guard lock(mutex_);
  if (!work_) return;
  struct Other {
    std::int64_t id, bytes;
  };
  std::vector<Other> others;
  std::int64_t total = 0;
  for (const ProductRow& row : readProductRows(*work_)) {
    if (keys.contains(row.info.key)) continue;
    Other& other = others.emplace_back(Other{row.id, 0});
    for (const ArrayInfo& array : row.info.arrays) other.bytes += array.stored;
    total += other.bytes;
  }
  if (total <= bytes) return;
  std::sort(others.begin(), others.end(), [](const Other& a, const Other& b) { return a.id < b.id; });
  for (const Other& other : others) {
    if (total <= bytes) break;
    job.checkCancelled();
    Transaction transaction(*work_);
    deleteProduct(*work_, other.id);
    writeProject();
    transaction.commit();
    total -= other.bytes;
  }
  // In steps: whoever cancels need not wait for all of it. The rest goes with the next clean-up.
  std::int64_t free = work_->integer("PRAGMA freelist_count"), before = free + 1;
  while (free > 0 && free < before) {
    job.checkCancelled();
    work_->execute(kVacuumStep);
    before = std::exchange(free, work_->integer("PRAGMA freelist_count"));
  }
}

}  // namespace prt
