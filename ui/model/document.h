#pragma once
// The open project as the studio edits it: the current recipe, where it is saved, and the way back.
// The recipe is a plain value, so undo is simply the previous one.

#include "libprt/project/recipe.h"

#include <QObject>
#include <QString>

#include <optional>
#include <vector>

namespace prt::ui {

class Document : public QObject {
  Q_OBJECT
 public:
  /// Steps that undo can go back.
  static constexpr int kMaxUndo = 256;

  explicit Document(QObject* parent = nullptr);

  const Recipe& recipe() const { return recipe_; }
  /// The file it was opened from or saved to; empty when there is none yet.
  QString path() const { return path_; }
  /// For titles: the file's name, or while there is none that of the first mesh.
  QString title() const;
  /// Whether the recipe differs from what is saved.
  bool modified() const { return recipe_ != saved_; }

  /// Another project: forgets the history.
  void open(Recipe recipe, const QString& path);
  /// What is in the file now: the recipe with its file paths told from the file's folder. When paths had
  /// to change, there is no undo past this point.
  void markSaved(const QString& path, const Recipe& saved);

  /// Makes `next` the current recipe. Undo will offer `name`. Nothing happens when nothing differs.
  void edit(const QString& name, const Recipe& next);
  /// Sets one value by its path in the recipe ("material.exponent"). Throws ValueError, and leaves
  /// everything as it was, when the path or the value is not valid.
  void set(const QString& path, const QString& value);

  /// Everything edited between the two is one step of undo (a drag, a scrub). They nest.
  void beginGesture(const QString& name);
  void endGesture();
  /// Ends all gestures and takes back what was edited in them: Esc during a drag.
  void cancelGesture();
  bool inGesture() const { return gestureDepth_ > 0; }

  bool canUndo() const { return !undo_.empty(); }
  bool canRedo() const { return !redo_.empty(); }
  QString undoName() const { return canUndo() ? undo_.back().name : QString(); }
  QString redoName() const { return canRedo() ? redo_.back().name : QString(); }
  void undo();
  void redo();

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

  Recipe recipe_, saved_;
  QString path_;
  std::vector<Step> undo_, redo_;
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

}  // namespace prt::ui
