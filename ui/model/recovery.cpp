#include "ui/model/recovery.h"

#include "libprt/core/error.h"
#include "libprt/core/file.h"

#include <nlohmann/json.hpp>

#include <QStandardPaths>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <random>
#include <system_error>

namespace prt::ui {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kEntry = "recovery.json";
constexpr const char* kThumbnail = "thumbnail.png";

/// An open, locked file, or -1 when another process holds it.
int lockOf(const fs::path& file) {
  const int opened = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
  if (opened >= 0 && ::flock(opened, LOCK_EX | LOCK_NB) != 0) {
    ::close(opened);
    return -1;
  }
  return opened;
}

std::string uniqueName() {
  std::random_device random;
  return std::to_string(::getpid()) + "-" + std::to_string(random());
}

json toJson(const RecoveryEntry& entry) {
  json edits = json::array();
  for (const QString& edit : entry.edits) edits.push_back(edit.toStdString());
  return {{"path", entry.path.toStdString()},
          {"title", entry.title.toStdString()},
          {"time", entry.time.toUTC().toString(Qt::ISODateWithMs).toStdString()},
          {"edits", edits},
          {"saved", recipeToJson(entry.saved)},
          {"recipe", recipeToJson(entry.recipe)}};
}

RecoveryEntry fromJson(const json& kept, const std::string& where) {
  RecoveryEntry entry;
  entry.path = QString::fromStdString(kept.at("path"));
  entry.title = QString::fromStdString(kept.at("title"));
  entry.time =
      QDateTime::fromString(QString::fromStdString(kept.at("time")), Qt::ISODateWithMs).toLocalTime();
  for (const json& edit : kept.at("edits")) entry.edits << QString::fromStdString(edit);
  entry.saved = recipeFromJson(kept.at("saved"), where);
  entry.recipe = recipeFromJson(kept.at("recipe"), where);
  return entry;
}

}  // namespace

fs::path RecoveryPlace::defaultRoot() {
  return fs::path(QStandardPaths::writableLocation(QStandardPaths::AppDataLocation).toStdString()) /
         "recovery";
}

// The lock comes before the folder: whoever sees the folder finds it locked.
std::unique_ptr<RecoveryPlace> RecoveryPlace::create(const fs::path& root) {
  std::error_code error;
  fs::create_directories(root, error);
  const fs::path folder = root / uniqueName();
  const int lock = lockOf(folder.string() + ".lock");
  if (lock < 0 || !fs::create_directory(folder, error) || error) {
    if (lock >= 0) ::close(lock);
    throw FileError("cannot be written: unsaved work will not survive a crash", root.string(),
                    "check the space on the disk and the permissions");
  }
  return std::unique_ptr<RecoveryPlace>(new RecoveryPlace(folder, lock));
}

std::vector<std::shared_ptr<RecoveryPlace>> RecoveryPlace::orphans(const fs::path& root) {
  std::vector<std::pair<QDateTime, std::shared_ptr<RecoveryPlace>>> found;
  std::error_code error;
  std::vector<fs::path> folders;
  for (const auto& each : fs::directory_iterator(root, error))
    if (each.is_directory(error)) folders.push_back(each.path());
  for (const fs::path& folder : folders) {
    const int lock = lockOf(folder.string() + ".lock");
    if (lock < 0) continue;
    std::shared_ptr<RecoveryPlace> place(new RecoveryPlace(folder, lock));
    const auto entry = fs::exists(folder, error) ? place->read() : std::nullopt;
    if (!entry) continue;
    place->wanted_ = true;
    found.emplace_back(entry->time, place);
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::shared_ptr<RecoveryPlace>> places;
  for (auto& each : found) places.push_back(std::move(each.second));
  return places;
}

RecoveryPlace::~RecoveryPlace() {
  if (!wanted_) remove();
  ::close(lock_);
}

void RecoveryPlace::keep(const RecoveryEntry& entry, const QByteArray& thumbnail) const {
  if (!thumbnail.isEmpty())
    writeFile(folder_ / kThumbnail,
              std::as_bytes(std::span(thumbnail.constData(), std::size_t(thumbnail.size()))));
  wanted_ = true;
  writeFile(folder_ / kEntry, toJson(entry).dump(-1, ' ', false, json::error_handler_t::replace));
}

std::optional<RecoveryEntry> RecoveryPlace::read() const {
  const fs::path file = folder_ / kEntry;
  std::error_code error;
  if (!fs::exists(file, error)) return {};
  try {
    const std::vector<std::byte> bytes = readFile(file, std::size_t(64) << 20);
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    RecoveryEntry entry = fromJson(json::parse(text, text + bytes.size()), file.string());
    if (entry.recipe == entry.saved && !entry.path.isEmpty()) return {};
    return entry;
  } catch (const std::exception&) {
    return {};  // of another version, or not ours
  }
}

QString RecoveryPlace::thumbnail() const {
  return QString::fromStdString((folder_ / kThumbnail).string());
}

void RecoveryPlace::forget() const {
  wanted_ = false;
  std::error_code ignored;
  fs::remove(folder_ / kEntry, ignored);
  fs::remove(folder_ / kThumbnail, ignored);
}

void RecoveryPlace::remove() const {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
  fs::remove(lockFile(), ignored);
}

}  // namespace prt::ui
