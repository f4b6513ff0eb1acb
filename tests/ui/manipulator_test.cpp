// Manipulators in the viewport: who gets the mouse, and where things are on the screen.

#include "ui/viewport/manipulator.h"
#include "tests/ui/studio_fixture.h"
#include "ui/viewport/light_handles.h"

#include <QPainter>

namespace prt::ui {
namespace {

TEST(ViewGeometry, SightsGoThroughThePointsThatAreSeenThere) {
  Camera camera;
  camera.eye = {1.5f, 2, 3};
  camera.target = {0.2f, 0.4f, -0.1f};
  const ViewGeometry view(camera, {900, 700});
  const CameraRays rays(camera, 900, 700);
  for (const Vec3& point : {Vec3(0), Vec3(0.5f, 1, 0.2f), Vec3(-1, -0.3f, 0.6f)}) {
    const auto at = view.project(point);
    ASSERT_TRUE(at);
    const Sight sight = view.sightAt(*at);
    EXPECT_LT(length(cross(sight.direction, point - sight.origin)), 1e-4f);
    EXPECT_GT(dot(sight.direction, point - sight.origin), 0);
    EXPECT_LT(length(rays.direction(float(at->x()), float(at->y())) - sight.direction), 1e-5f)
        << "as renderers see it";
  }
  EXPECT_FALSE(view.project(camera.eye + (camera.eye - camera.target))) << "behind the eye";
}

// Takes what is within 20 pixels of its place, and writes down what it is told.
class Spot : public Manipulator {
 public:
  explicit Spot(const QPointF& place) : place_(place) {}
  void paint(QPainter& painter, const ViewGeometry&) override {
    ++painted;
    painter.fillRect(QRectF(place_ - QPointF(20, 20), QSizeF(40, 40)), Qt::magenta);
  }
  bool hover(std::optional<QPointF> at, const ViewGeometry&) override { return hovered = at && near(*at); }
  bool press(const QPointF& at, Qt::KeyboardModifiers, const ViewGeometry&) override {
    if (!near(at)) return false;
    said << QStringLiteral("press");
    return true;
  }
  void move(const QPointF& at, Qt::KeyboardModifiers, const ViewGeometry&) override {
    said << QStringLiteral("move %1").arg(at.x() - place_.x());
  }
  void release(const QPointF&, const ViewGeometry&) override { said << QStringLiteral("release"); }
  void cancel() override { said << QStringLiteral("cancel"); }
  QCursor cursor() const override { return Qt::CrossCursor; }
  QString hint() const override { return QStringLiteral("a spot"); }

  QStringList said;
  bool hovered = false;
  int painted = 0;

 private:
  bool near(const QPointF& at) const { return (at - place_).manhattanLength() < 20; }
  QPointF place_;
};

class ManipulatorTest : public test::StudioTest {
 protected:
  ManipulatorTest() {
    window.lightHandles().setEnabled(false);
    Viewport& view = window.viewport();
    place = QPoint(view.width() / 2, view.height() / 2);
    spot = new Spot(place);
    view.addManipulator(spot);
  }
  void moveTo(const QPoint& by, Qt::MouseButtons buttons) {
    const QPointF at(inView(by.x(), by.y()));
    QMouseEvent move(QEvent::MouseMove, at, handle()->mapToGlobal(at), Qt::NoButton, buttons, Qt::NoModifier);
    QCoreApplication::sendEvent(handle(), &move);
  }
  void press(const QPoint& by = {}) {
    QTest::mousePress(handle(), Qt::LeftButton, Qt::NoModifier, inView(by.x(), by.y()));
  }
  void release(const QPoint& by = {}) {
    QTest::mouseRelease(handle(), Qt::LeftButton, Qt::NoModifier, inView(by.x(), by.y()));
  }

  QPoint place;
  Spot* spot;
};

TEST_F(ManipulatorTest, GetsThePressMovesAndReleaseOverItself) {
  openAndSettle();
  const Camera camera = session.view().camera();
  press();
  moveTo({80, 0}, Qt::LeftButton);
  release({80, 0});
  spot->said.removeDuplicates();  // a release may bring a last move to where it is
  EXPECT_EQ(spot->said,
            QStringList({QStringLiteral("press"), QStringLiteral("move 80"), QStringLiteral("release")}));
  EXPECT_EQ(session.view().camera(), camera);
  EXPECT_GT(spot->painted, 0);
}

TEST_F(ManipulatorTest, LeavesEverythingElseToNavigation) {
  openAndSettle();
  const Camera camera = session.view().camera();
  drag(Qt::LeftButton, Qt::AltModifier, QPoint(60, 0));
  drag(Qt::MiddleButton, Qt::NoModifier, QPoint(60, 0));
  press({100, 0});
  release({100, 0});
  EXPECT_TRUE(spot->said.isEmpty());
  EXPECT_NE(session.view().camera(), camera);
  spot->setEnabled(false);
  press();
  release();
  EXPECT_TRUE(spot->said.isEmpty());
}

TEST_F(ManipulatorTest, HoverShowsItsCursorAndHint) {
  openAndSettle();
  moveTo({0, 0}, Qt::NoButton);
  EXPECT_TRUE(spot->hovered);
  EXPECT_EQ(window.viewport().cursor().shape(), Qt::CrossCursor);
  EXPECT_EQ(window.viewport().hint(), QStringLiteral("a spot"));
  moveTo({100, 0}, Qt::NoButton);
  EXPECT_FALSE(spot->hovered);
  EXPECT_NE(window.viewport().cursor().shape(), Qt::CrossCursor);
  EXPECT_NE(window.viewport().hint(), QStringLiteral("a spot"));
}

TEST_F(ManipulatorTest, EscapeTakesItBack) {
  openAndSettle();
  press();
  moveTo({30, 0}, Qt::LeftButton);
  QTest::keyClick(handle(), Qt::Key_Escape);
  moveTo({60, 0}, Qt::LeftButton);
  release({60, 0});
  EXPECT_EQ(spot->said,
            QStringList({QStringLiteral("press"), QStringLiteral("move 30"), QStringLiteral("cancel")}));
}

}  // namespace
}  // namespace prt::ui
