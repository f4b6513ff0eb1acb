// The overlay of keys: made from the actions and bindings that there are.

#include "ui/window/keys_overlay.h"
#include "tests/ui/studio_fixture.h"

#include <QLabel>
#include <QMenu>
#include <QMenuBar>

namespace prt::ui {
namespace {

using test::s;

class KeysTest : public test::StudioTest {
 protected:
  QStringList shown() {
    QStringList texts;
    for (const QLabel* label : window.keys().findChildren<QLabel*>()) texts << label->text();
    return texts;
  }
};

TEST_F(KeysTest, QuestionMarkOpensItAndEscOrAClickBesideItCloses) {
  QTest::keyClick(handle(), Qt::Key_Question);
  EXPECT_TRUE(window.keys().isOpen());
  QTest::keyClick(handle(), Qt::Key_Escape);
  EXPECT_FALSE(window.keys().isOpen());
  QTest::keyClick(handle(), Qt::Key_Question);
  ASSERT_TRUE(window.keys().isOpen());
  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier, QPoint(5, window.height() / 2));
  EXPECT_FALSE(window.keys().isOpen());
}

TEST_F(KeysTest, ShowsEveryShortcutOfTheMenus) {
  window.keys().open();
  const QStringList texts = shown();
  int shortcuts = 0;
  for (const QMenu* menu : window.menuBar()->findChildren<QMenu*>())
    for (const QAction* action : menu->actions()) {
      if (action->shortcut().isEmpty() || !action->isVisible()) continue;
      ++shortcuts;
      EXPECT_TRUE(texts.contains(plainText(*action))) << action->text().toStdString();
    }
  EXPECT_GT(shortcuts, 8);
}

TEST_F(KeysTest, ShowsWhatTheMouseDoesAndWhatIsNewSinceTheLastTime) {
  window.keys().open();
  for (const Binding& binding : window.viewport().bindings())
    EXPECT_TRUE(shown().contains(binding.what)) << binding.what.toStdString();
  window.keys().close();
  auto* menu = window.menuBar()->findChild<QMenu*>();
  menu->addAction(s("Something new"))->setShortcut(QKeySequence(s("Ctrl+Alt+N")));
  window.keys().open();
  EXPECT_TRUE(shown().contains(s("Something new")));
  EXPECT_TRUE(shown().contains(s("Alt"))) << "each key as a cap of its own";
}

TEST_F(KeysTest, NoTwoActionsShareAShortcut) {
  QMap<QString, QString> seen;
  for (const QAction* action : window.findChildren<QAction*>())
    for (const QKeySequence& keys : action->shortcuts()) {
      if (action->shortcutContext() != Qt::WindowShortcut) continue;
      EXPECT_FALSE(seen.contains(keys.toString()))
          << keys.toString().toStdString() << ": " << action->text().toStdString() << " and "
          << seen[keys.toString()].toStdString();
      seen[keys.toString()] = action->text();
    }
}

}  // namespace
}  // namespace prt::ui
