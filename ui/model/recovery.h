#pragma once
// What is kept of documents between saves, so that a crash loses nothing: one place per open document, a
// folder with the edited recipe in recovery.json, a thumbnail, and for a document that was never saved its
// baked products. A lock that dies with its process tells the places of running studios from orphans.

#include "libprt/project/recipe.h"

#include <QByteArray>
#include <QDateTime>
#include <QString>
#include <QStringList>

#include <atomic>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

namespace prt::ui {

/// The state of a document that was not saved. File paths are seen from the project's folder, or from "/".
struct RecoveryEntry {
  QString path;       ///< of the project; empty when it was never saved
  QString title;      ///< for people
  QDateTime time;     ///< of the state
  QStringList edits;  ///< since the save, oldest first
  Recipe saved;       ///< what counted as saved
  Recipe recipe;
};

class RecoveryPlace {
 public:
  /// $XDG_DATA_HOME/PRT Studio/prt-studio/recovery, or what a test says.
  static std::filesystem::path defaultRoot();

  /// A new place, locked. Throws FileError when the folder cannot be written to.
  static std::unique_ptr<RecoveryPlace> create(const std::filesystem::path& root);
  /// Places that no running process holds, newest first: locked by this one now. What holds nothing worth
  /// recovering is removed on the way.
  static std::vector<std::shared_ptr<RecoveryPlace>> orphans(const std::filesystem::path& root);

  /// Lets the lock go. A place where something is kept stays, every other one is removed.
  ~RecoveryPlace();
  RecoveryPlace(const RecoveryPlace&) = delete;
  RecoveryPlace& operator=(const RecoveryPlace&) = delete;

  /// Replaces what is kept, in one step. Any thread, one at a time. `thumbnail`: a PNG, or empty.
  void keep(const RecoveryEntry& entry, const QByteArray& thumbnail) const;
  /// What is kept, if it is anything.
  std::optional<RecoveryEntry> read() const;
  QString thumbnail() const;
  /// Nothing is to be recovered: it is saved.
  void forget() const;
  /// Nothing here is wanted: it is removed, products too, once nobody uses the place any more. Any thread.
  void dismiss() const { wanted_ = false; }

  /// Where the products of a document without a file are baked to (its working copy, that is).
  std::filesystem::path project() const { return folder_ / "untitled.prt"; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  RecoveryPlace(std::filesystem::path folder, int lock) : folder_(std::move(folder)), lock_(lock) {}
  std::filesystem::path lockFile() const { return folder_.string() + ".lock"; }

  void remove() const;

  std::filesystem::path folder_;
  int lock_;
  mutable std::atomic<bool> wanted_{false};
};

}  // namespace prt::ui
