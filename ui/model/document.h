#pragma once
// The open project as the studio edits it: the current recipe, where it is saved, and the way back.
// The recipe is a plain value, so undo is simply the previous one.

#include "libprt/project/recipe.h"

#include <QObject>
#include <QString>
#include <QStringList>

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

namespace prt::ui {

class Document : public QObject {
  Q_OBJECT
 public:
  /// Steps that undo can go back, and what they may take together; the oldest go first.
  static constexpr int kMaxUndo = 1000;
  static constexpr std::size_t kMaxUndoBytes = std::size_t(64) << 20;

  explicit Document(QObject* parent = nullptr);

  const Recipe& recipe() const { return recipe_; }
  /// The file it was opened from or saved to; empty when there is none yet.
  QString path() const { return path_; }
  /// For titles: the file's name, or while there is none that of the first mesh.
  QString title() const;
  /// Whether the recipe differs from what is saved.
  bool modified() const { return recipe_ != saved_; }

  /// What the recipe's relative paths start from: the project's folder, or "/" while there is none.
  std::filesystem::path folder() const;
  /// The recipe that counts as saved.
  const Recipe& saved() const { return saved_; }

  /// Another project: forgets the history.
  void open(Recipe recipe, const QString& path);
  /// The project is in this file now, as `saved`: a recipe that was current since the last call. File paths
  /// are told from the file's folder from now on, in the history too.
  void markSaved(const QString& path, const Recipe& saved);
  /// What `recipe` becomes when the project moves into this file.
  Recipe movedTo(const QString& path, Recipe recipe) const;

  /// Makes `next` the current recipe. Undo will offer `name`. Nothing happens when nothing differs.
  void edit(const QString& name, const Recipe& next);
  /// Sets one value by its path in the recipe ("material.exponent"). Throws ValueError, and leaves
  /// everything as it was, when the path or the value is not valid.
  /// `title`: what a row calls the value, where that is not its parameterTitle().
  void set(const QString& path, const QString& value, const QString& title = {});

  /// Everything edited between the two is one step of undo (a drag, a scrub). They nest.
  void beginGesture(const QString& name);
  void endGesture();
  /// Ends all gestures and takes back what was edited in them: Esc during a drag.
  void cancelGesture();
  bool inGesture() const { return gestureDepth_ > 0; }

  /// Names of the edits since the last save, oldest first.
  QStringList editsSinceSave() const;
  /// Names of all steps that undo can take back, oldest first; and of those that redo can bring again,
  /// the next one first.
  QStringList undoNames() const;
  QStringList redoNames() const;

  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  QString undoName() const { return canUndo() ? undo_.back().name : QString(); }
  QString redoName() const { return canRedo() ? redo_.back().name : QString(); }
  void undo();
  void redo();
  /// Undoes (steps < 0) or redoes several at once.
  void step(int steps);

 Q_SIGNALS:
  void recipeChanged();
  /// What undo and redo offer, the title or the modified mark changed.
  void stateChanged();
  /// Another project was opened; recipeChanged follows.
  void opened();

 private:
  struct Step {
    QString name;
    Recipe recipe;  // the other side of the step
  };
  void remember(const QString& name, const Recipe& before);
  void swapWith(std::vector<Step>& from, std::vector<Step>& to);

  Recipe recipe_, saved_;
  QString path_;
  std::vector<Step> undo_, redo_;
  int savedDepth_ = 0;  // steps of undo_ when it was saved; negative: they are forgotten
  int gestureDepth_ = 0;
  QString gestureName_;
  std::optional<Recipe> gestureStart_;
};

/// Ends its gesture with the scope.
class Gesture {
 public:
  Gesture(Document& document, const QString& name) : document_(document) { document_.beginGesture(name); }
  ~Gesture() { document_.endGesture(); }
  Gesture(const Gesture&) = delete;
  Gesture& operator=(const Gesture&) = delete;

 private:
  Document& document_;
};

/// A parameter's name for people: "transfer.bands" -> "Bands".
QString parameterTitle(const QString& path);
/// What an edit of it is called, with what it belongs to: "Exponent of vase", "Angle of sun", "Bands".
/// `title` stands for the parameter where it is not empty.
QString editName(const Recipe& recipe, const QString& path, const QString& title = {});
/// Memory that a recipe takes.
std::size_t bytesOf(const Recipe& recipe);

}  // namespace prt::ui
