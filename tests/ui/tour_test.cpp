// The README's tour, whole, with mouse and keys: a mesh is dropped and previewed, the light turned and added
// to, gloss slid, a bake cancelled, edits undone, the project saved; the next save is killed, and what is
// opened then looks as it was saved.

#include "libprt/mesh/generate.h"
#include "libprt/mesh/mesh_writer.h"
#include "tests/support/run_program.h"
#include "tests/ui/save_until_killed.h"
#include "tests/ui/studio_fixture.h"
#include "ui/docks/jobs_dock.h"
#include "ui/widgets/lat_long.h"
#include "ui/widgets/panorama.h"
#include "ui/widgets/parameter_slider.h"
#include "ui/widgets/preset_grid.h"

#include <QDialogButtonBox>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QScrollArea>
#include <QTimer>
#include <QToolButton>

#include <fstream>
#include <thread>

namespace prt::test {

int saveUntilKilled(const QString& project, const QString& recoveryRoot) {
  ui::Session studio;
  studio.project().setRecoveryRoot(recoveryRoot.toStdString());
  studio.open(project);
  if (!waitFor([&] { return studio.settled() && studio.bakes().fresh(); })) return 1;
  for (int turn = 0; turn < 10000; ++turn) {
    studio.save(project);
    std::ofstream(recoveryRoot.toStdString() + ".saving") << turn;
    if (!waitFor([&] { return !studio.project().saving(); })) return 2;
  }
  return 0;
}

}  // namespace prt::test

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::waitFor;

class TourTest : public test::StudioTest {
 protected:
  /// A place in a widget as the window sees it, scrolled to and on top.
  QPoint placeIn(QWidget* widget, const QPointF& at) {
    for (QWidget* up = widget; up; up = up->parentWidget()) {
      if (auto* scroll = qobject_cast<QScrollArea*>(up))
        scroll->ensureVisible(widget->mapTo(scroll->widget(), at.toPoint()).x(),
                              widget->mapTo(scroll->widget(), at.toPoint()).y());
      if (auto* dock = qobject_cast<QDockWidget*>(up)) dock->raise();
    }
    pass(30);
    return widget->mapTo(&window, at.toPoint());
  }
  void dragIn(QWidget* widget, const QPointF& from, const QPointF& to) {
    const QPoint start = placeIn(widget, from), end = start + (to - from).toPoint();
    QTest::mousePress(handle(), Qt::LeftButton, Qt::NoModifier, start);
    for (int step = 1; step <= 5; ++step) {
      QTest::mouseMove(handle(), start + (end - start) * step / 5);
      pass(15);
    }
    QTest::mouseRelease(handle(), Qt::LeftButton, Qt::NoModifier, end);
    pass(15);
  }
  void settle() {
    ASSERT_TRUE(settled());
    pass(100);
  }
  /// Gives a name to the file dialog that the next call opens. A list of completions may swallow a click, so
  /// it goes on until the dialog is gone.
  static void answerFileDialog(const QString& file) {
    auto* poll = new QTimer(qApp);
    QObject::connect(poll, &QTimer::timeout, qApp, [poll, file, seen = false]() mutable {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (!dialog && seen) return poll->deleteLater();
      if (!dialog || !dialog->isVisible()) return;
      seen = true;
      if (QWidget* popup = QApplication::activePopupWidget()) popup->close();
      auto* name = dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"));
      if (name->text() != file) name->setText(file);
      QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(QDialogButtonBox::Save),
                        Qt::LeftButton);
    });
    poll->start(50);
  }
  std::size_t lights() { return session.document().recipe().lights.size(); }
};

TEST_F(TourTest, FromADroppedMeshToASavedProjectThatSurvivesBeingKilled) {
  // Drop a mesh and watch the preview.
  std::vector<bool> finals;
  QObject::connect(&session.bakes(), &BakeController::productArrived, &window,
                   [&](const QString& stage, const ProductState& state) {
                     if (stage == QStringLiteral("transfer")) finals.push_back(state.final());
                   });
  const QString mesh = folder.filePath(QStringLiteral("rock.obj"));
  Job job;
  writeMesh(mesh.toStdString(), makeBuiltinMesh("rock", 0.4f, 5), {}, job);
  ASSERT_TRUE(drop(window.viewport(), {mesh}));
  settle();
  EXPECT_EQ(session.document().title(), QStringLiteral("rock.obj"));
  ASSERT_FALSE(finals.empty());
  EXPECT_FALSE(finals.front()) << "a preview came first";
  EXPECT_TRUE(finals.back());
  const QImage dropped = picture();

  // Turn the environment in the viewport.
  drag(Qt::LeftButton, Qt::ShiftModifier, QPoint(160, 0));
  EXPECT_NE(session.environmentAngle(), 0);
  const QImage turned = picture();
  EXPECT_GT(difference(dropped, turned), 0.02);
  const Recipe before = session.document().recipe();

  // Add a circle light on the panorama, then drag it.
  auto* panorama = window.findChild<Panorama*>();
  ASSERT_TRUE(panorama);
  const QPointF sky(0.25 * panorama->width(), 0.3 * panorama->height());
  QTest::mouseDClick(handle(), Qt::LeftButton, Qt::NoModifier, placeIn(panorama, sky));
  ASSERT_EQ(lights(), before.lights.size() + 1);
  const Vec3 stood = session.document().recipe().lights.back().direction;
  pass(500);  // or the next press is a third click
  dragIn(panorama, sky, sky + QPointF(0.3 * panorama->width(), 0.1 * panorama->height()));
  EXPECT_LT(dot(normalize(stood), normalize(session.document().recipe().lights.back().direction)), 0.9f);
  EXPECT_GT(difference(turned, picture()), 0.02) << "the light shines";

  // A glossy preset, then its gloss.
  auto* presets = window.findChild<PresetGrid*>(test::s("presetGrid"));
  ASSERT_TRUE(presets);
  int glossy = 0;
  for (; glossy < 64 && !session.document().recipe().objects[0].material.glossy(); ++glossy)
    QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier,
                      placeIn(presets, presets->cell(glossy).center()));
  ASSERT_TRUE(session.document().recipe().objects[0].material.glossy());
  settle();
  const QImage before_gloss = picture();
  auto* slider = window.findChild<ParameterSlider*>();
  ASSERT_TRUE(slider);
  const double y = 0.5 * slider->height();
  const double exponent = slider->value();
  dragIn(slider, QPointF(slider->placeOf(exponent), y), QPointF(slider->placeOf(exponent > 60 ? 4 : 400), y));
  EXPECT_NE(slider->value(), exponent);
  EXPECT_FALSE(session.bakes().baking()) << "gloss is live";
  EXPECT_GT(difference(before_gloss, picture()), 0.005);

  // Cancel a bake in the jobs dock.
  session.document().set(QStringLiteral("transfer.rays"), QStringLiteral("65536"));
  ASSERT_TRUE(waitFor([&] { return session.bakes().baking(); }));
  pass(300);
  QToolButton* cancel = nullptr;
  for (QToolButton* each : window.findChildren<QToolButton*>(QStringLiteral("cancelJob")))
    if (!each->isHidden()) cancel = each;
  ASSERT_TRUE(cancel);
  QTest::mouseClick(handle(), Qt::LeftButton, Qt::NoModifier,
                    placeIn(cancel, QRectF(cancel->rect()).center()));
  ASSERT_TRUE(waitFor([&] { return !session.bakes().baking(); }));
  EXPECT_FALSE(session.bakes().fresh());

  // Undo five times from the keyboard.
  for (int step = 0; step < 5; ++step) {
    ASSERT_TRUE(session.document().canUndo()) << step;
    QTest::keyClick(handle(), Qt::Key_Z, Qt::ControlModifier);
    pass(20);
  }
  while (session.document().recipe() != before && session.document().canUndo())  // several presets were tried
    QTest::keyClick(handle(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(session.document().recipe(), before);
  settle();
  EXPECT_LT(difference(turned, picture()), 0.001);

  // Save under a name.
  const QString project = folder.filePath(QStringLiteral("rock.prt"));
  answerFileDialog(project);
  QTest::keyClick(handle(), Qt::Key_S, Qt::ControlModifier);
  ASSERT_TRUE(waitFor([&] { return session.document().path() == project && !session.project().saving(); }));
  EXPECT_FALSE(session.document().modified());
  settle();
  const QImage saved = picture();
  const Camera camera = session.view().camera();

  session.open(QStringLiteral("scene:default"));  // leaves the project, which one studio at a time may change
  ASSERT_TRUE(waitFor([&] { return session.document().path().isEmpty(); }));
  settle();

  // Another studio opens it and dies in the midst of saving, at several moments.
  for (const int milliseconds : {0, 3, 20}) {
    test::Program other({"/proc/self/exe", "--save-until-killed", project.toStdString(),
                         folder.filePath(QStringLiteral("recovery")).toStdString()});
    const std::string mark = folder.filePath(QStringLiteral("recovery.saving")).toStdString();
    std::error_code error;
    ASSERT_TRUE(waitFor([&] { return std::filesystem::exists(mark, error); }));
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
    other.send(SIGKILL);
    EXPECT_EQ(other.wait().status, 128 + SIGKILL);
    std::filesystem::remove(mark);
    ASSERT_NO_THROW(ProjectFile::verify(project.toStdString(), job));
  }

  // Opened again, it is the same picture.
  session.open(project);
  ASSERT_TRUE(waitFor([&] { return session.document().path() == project; }));
  settle();
  session.view().setCamera(camera);
  EXPECT_EQ(session.document().recipe(), [&] {
    Recipe relative = before;
    rebasePaths(relative, "/", folder.path().toStdString());
    return relative;
  }());
  EXPECT_LT(difference(saved, picture()), 0.0005);
}

}  // namespace
}  // namespace prt::ui
