#include "ui/model/document.h"

#include "libprt/core/error.h"

#include <gtest/gtest.h>

namespace prt::ui {
namespace {

QString s(const char* text) {
  return QString::fromUtf8(text);
}

TEST(Document, UndoIsThePreviousRecipeUnderItsName) {
  Document document;
  document.open(Recipe{}, {});
  const Recipe first = document.recipe();
  document.set(s("transfer.bands"), s("4"));
  document.set(s("material.exponent"), s("100"));
  EXPECT_EQ(document.undoName(), s("Exponent of object"));
  document.undo();
  EXPECT_EQ(document.undoName(), s("Bands"));
  EXPECT_EQ(document.redoName(), s("Exponent of object"));
  document.undo();
  EXPECT_EQ(document.recipe(), first);
  EXPECT_FALSE(document.canUndo());
  document.redo();
  document.redo();
  EXPECT_EQ(document.recipe().objects[0].material.exponent, 100);
  EXPECT_FALSE(document.canRedo());
}

TEST(Document, ANewEditEndsTheWayForward) {
  Document document;
  document.open(Recipe{}, {});
  document.set(s("transfer.bands"), s("4"));
  document.undo();
  document.set(s("transfer.bands"), s("6"));
  EXPECT_FALSE(document.canRedo());
}

TEST(Document, AGestureIsOneStep) {
  Document document;
  document.open(Recipe{}, {});
  {
    const Gesture drag(document, s("Turn environment"));
    for (int i = 1; i <= 50; ++i) document.set(s("lights[0].rotation"), QString::number(i));
    EXPECT_FALSE(document.canUndo()) << "not before the hand lets go";
  }
  EXPECT_EQ(document.undoName(), s("Turn environment"));
  document.undo();
  EXPECT_EQ(document.recipe(), Recipe{});
  EXPECT_FALSE(document.canUndo());
}

TEST(Document, AGestureThatEndsWhereItBeganIsNoStep) {
  Document document;
  document.open(Recipe{}, {});
  document.beginGesture(s("Drag"));
  document.set(s("lights[0].rotation"), s("30"));
  document.set(s("lights[0].rotation"), s("0"));
  document.endGesture();
  EXPECT_FALSE(document.canUndo());
  EXPECT_FALSE(document.modified());
}

TEST(Document, ABadValueIsRefusedAndChangesNothing) {
  Document document;
  document.open(Recipe{}, {});
  EXPECT_THROW(document.set(s("transfer.bands"), s("99")), ValueError);
  EXPECT_THROW(document.set(s("transfer.bends"), s("5")), ValueError);
  EXPECT_EQ(document.recipe(), Recipe{});
  EXPECT_FALSE(document.canUndo());
}

TEST(Document, ModifiedComparesWithWhatIsSaved) {
  Document document;
  document.open(Recipe{}, s("/somewhere/a.prt"));
  EXPECT_FALSE(document.modified());
  EXPECT_EQ(document.title(), s("a.prt"));
  document.set(s("transfer.bands"), s("4"));
  EXPECT_TRUE(document.modified());
  document.markSaved(s("/somewhere/b.prt"), document.recipe());
  EXPECT_FALSE(document.modified());
  EXPECT_TRUE(document.canUndo()) << "saving does not end undo";
  document.undo();
  EXPECT_TRUE(document.modified());
}

TEST(Document, MemoryOfStepsIsBounded) {
  Document document;
  document.open(Recipe{}, {});
  for (int i = 0; i < 2 * Document::kMaxUndo; ++i)
    document.set(s("lights[0].rotation"), QString::number(i + 1));
  int steps = 0;
  for (; document.canUndo(); ++steps) document.undo();
  EXPECT_EQ(steps, Document::kMaxUndo);
}

TEST(Document, SetSaysWhatChanged) {
  Document document;
  int recipes = 0, states = 0;
  QObject::connect(&document, &Document::recipeChanged, [&] { ++recipes; });
  QObject::connect(&document, &Document::stateChanged, [&] { ++states; });
  document.set(s("transfer.bands"), s("4"));
  EXPECT_EQ(recipes, 1);
  EXPECT_EQ(states, 1);
  document.set(s("transfer.bands"), s("4"));
  EXPECT_EQ(recipes, 1) << "the same value again is no change";
}

TEST(ParameterTitle, IsTheLastPartInWords) {
  EXPECT_EQ(parameterTitle(s("transfer.bands")), s("Bands"));
  EXPECT_EQ(parameterTitle(s("objects[0].material.twoSided")), s("Two sided"));
}

}  // namespace
}  // namespace prt::ui
