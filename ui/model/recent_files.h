#pragma once
// The projects and meshes that were opened last, kept in the settings.

#include <QStringList>

namespace prt::ui {

class RecentFiles {
 public:
  static constexpr int kMost = 12;

  /// Absolute paths, the last one first. Some may be gone.
  QStringList files() const;
  void add(const QString& file);
  void remove(const QString& file);
  /// Those that are not there any more.
  void removeMissing();
  void clear();

  static bool exists(const QString& file);
};

}  // namespace prt::ui
