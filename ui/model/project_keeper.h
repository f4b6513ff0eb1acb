#pragma once
// The open document and its files: opening, saving, closing, and what is kept between saves. Saving goes on
// beside a bake; nothing that would be lost is given up without asking.

#include "ui/model/autosave.h"
#include "ui/model/bake_controller.h"
#include "ui/model/document.h"
#include "ui/model/job_runner.h"
#include "ui/model/log.h"
#include "ui/model/opened_project.h"
#include "ui/model/recent_files.h"

#include <QObject>

#include <functional>
#include <memory>
#include <vector>

namespace prt::ui {

/// What would be lost if the document went now.
struct Unsaved {
  QString title;
  QStringList edits;        ///< names, oldest first
  bool edited = false;      ///< the recipe differs from what is saved
  double bakedSeconds = 0;  ///< of baking that no file keeps; 0 when a file does, or when it was little
  bool bakeGoesOn = false;  ///< baked work is not in the project yet, but kept beside it for the next time

  bool any() const { return edited || bakedSeconds > 0; }
};

enum class Leave { Save, Discard, Cancel };
struct LeaveAnswer {
  Leave leave = Leave::Cancel;
  QString path;  ///< where to save
};

class ProjectKeeper : public QObject {
  Q_OBJECT
 public:
  /// Baking for less than this without a file is not asked about: it is soon done again.
  static constexpr double kWorthAsking = 20;

  ProjectKeeper(Document& document, BakeController& bakes, JobRunner& jobs, Log& log,
                QObject* parent = nullptr);
  /// Keeps what is unsaved for the next start, unless it was given up.
  ~ProjectKeeper() override;

  /// A project (.prt), a recipe (.json), a mesh, "scene:NAME" or "builtin:MESH". Asks first when something
  /// would be lost. The document changes only once it has been read; when it cannot be, all stays.
  void open(const QString& what);
  bool opening() const { return opening_; }

  /// Writes the project with everything baked so far that serves it; a bake goes on meanwhile. Under
  /// another name the document and its bake move there.
  void save(const QString& path) { saveThen(path, {}); }
  bool saving() const { return saving_; }
  /// Copies the files that the project names into NAME_files beside it and saves it with them.
  void collect();

  Unsaved unsaved() const;
  /// How to ask before something is lost; without it nothing is asked.
  void setQuestion(std::function<LeaveAnswer(const Unsaved&)> ask) { ask_ = std::move(ask); }
  /// Goes on when nothing would be lost, or once it was saved or given up; not at all when that was
  /// cancelled or saving failed.
  void leaveThen(std::function<void()> go);
  /// What is unsaved now is not wanted: nothing of it is kept when this ends.
  void giveUp() { givenUp_ = true; }

  /// What crashed studios left, newest first. They are this process's until it ends.
  const std::vector<std::shared_ptr<RecoveryPlace>>& recoveries();
  void restore(const std::shared_ptr<RecoveryPlace>& place);
  void discard(const std::shared_ptr<RecoveryPlace>& place);

  /// Files that are missing, or changed since the project was saved.
  const std::vector<LinkedFile>& brokenLinks() const { return links_; }
  /// Looks for those that are missing in a folder and everything in it.
  void searchLinks(const QString& folder);
  /// Takes these files instead (recipe path to file): one edit.
  void relink(const std::map<std::string, std::filesystem::path>& files);

  Autosave& autosave() { return autosave_; }
  RecentFiles& recent() { return recent_; }
  /// Where recovery places are; for tests, before anything is opened.
  void setRecoveryRoot(const std::filesystem::path& root) { recoveryRoot_ = root; }
  /// Earlier saves that are kept (the setting "documents/backups", 3 by default).
  static int backups();
  static void setBackups(int count);
  /// Seconds between an edit and when it is kept (the setting "documents/autosave", 10; 0 = never).
  static int autosaveSeconds();
  void setAutosaveSeconds(int seconds);

 Q_SIGNALS:
  void statusChanged();
  /// Another document is about to take the place of this one.
  void leaving();
  void saved(const QString& path);
  void failed(const QString& message);
  void notice(const QString& message);
  void linksChanged();
  void linksFound(const std::map<std::string, prt::FoundFile>& found);
  void recoveriesChanged();

 private:
  void start(const OpenRequest& request, const QString& title);
  void adopt(const OpenedProject& opened);
  void saveThen(const QString& path, std::function<void(bool)> then);
  void settle(const QString& path, const Recipe& snapshot, std::shared_ptr<ProjectFile> file);
  void dismissPlace();

  Document& document_;
  BakeController& bakes_;
  JobRunner& jobs_;
  Log& log_;
  Autosave autosave_;
  RecentFiles recent_;
  std::filesystem::path recoveryRoot_ = RecoveryPlace::defaultRoot();
  std::shared_ptr<RecoveryPlace> place_;  // of this document
  std::shared_ptr<ProjectFile> file_;     // what it bakes into
  bool titled_ = false;                   // ... is the project's own file
  bool recovered_ = false;                // not saved since
  std::vector<LinkedFile> links_;
  std::optional<std::vector<std::shared_ptr<RecoveryPlace>>> recoveries_;
  std::function<LeaveAnswer(const Unsaved&)> ask_;
  std::function<void()> afterSaving_;
  bool opening_ = false, saving_ = false, givenUp_ = false;
  quint64 documentNumber_ = 0;  // a save that ends after another document was opened is not of this one
};

}  // namespace prt::ui
