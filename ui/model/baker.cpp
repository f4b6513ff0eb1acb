#include "ui/model/baker.h"

#include <utility>

namespace prt::ui {

std::shared_ptr<ProjectFile> BakeStore::file() const {
  std::lock_guard lock(mutex_);
  return file_;
}

void BakeStore::moveTo(std::shared_ptr<ProjectFile> next) {
  std::lock_guard lock(mutex_);
  if (file_) next->importFrom(*file_);
  file_ = std::move(next);
}

std::unique_ptr<ProductStore::Stored> BakeStore::find(const std::string& stage, const std::string& key) {
  std::lock_guard lock(mutex_);
  return file_ ? file_->find(stage, key) : nullptr;
}

void BakeStore::put(const std::string& stage, const std::string& key, const Stored& stored,
                    const WriteCheck& check) {
  std::lock_guard lock(mutex_);
  if (file_) file_->put(stage, key, stored, check);
}

std::unique_ptr<ProductData> BakeStore::findCheckpoint(const std::string& stage, const std::string& key) {
  std::lock_guard lock(mutex_);
  return file_ ? file_->findCheckpoint(stage, key) : nullptr;
}

void BakeStore::putCheckpoint(const std::string& stage, const std::string& key, const ProductData& data,
                              const WriteCheck& check) {
  std::lock_guard lock(mutex_);
  if (file_) file_->putCheckpoint(stage, key, data, check);
}

void BakeStore::dropCheckpoint(const std::string& stage, const std::string& key) {
  std::lock_guard lock(mutex_);
  if (file_) file_->dropCheckpoint(stage, key);
}

void BakeStore::keepRecent(const std::set<std::string>& keys, std::int64_t bytes, Job& job) {
  std::lock_guard lock(mutex_);
  if (file_) file_->keepRecent(keys, bytes, job);
}

std::string BakeStore::sourceHash(const std::string& path) {
  std::lock_guard lock(mutex_);
  return file_ ? file_->sourceHash(path) : std::string();
}

void BakeStore::putSourceHash(const std::string& path, const std::string& hash) {
  std::lock_guard lock(mutex_);
  if (file_) file_->putSourceHash(path, hash);
}

}  // namespace prt::ui
