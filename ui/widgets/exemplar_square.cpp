#include "ui/widgets/exemplar_square.h"

#include "libprt/project/patch_stages.h"
#include "libprt/shade/patch_square.h"
#include "ui/model/session.h"
#include "ui/model/wish_editor.h"
#include "ui/widgets/distances.h"
#include "ui/widgets/image_convert.h"
#include "ui/widgets/theme.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>

namespace prt::ui {

namespace {
constexpr int kRedrawMilliseconds = 200;            // light may be dragged: the picture follows at leisure
constexpr float kKeyStep = 0.02f, kKeySize = 1.1f;  // of the patch's width, and of the part's size
constexpr double kLeastDrag = 4;                    // pixels; less is a click and leaves the size
}  // namespace

ExemplarSquare::ExemplarSquare(Session& session, QWidget* parent)
    : QWidget(parent), session_(session), wishes_(session.wishes()) {
  setObjectName(QStringLiteral("exemplarSquare"));
  setFocusPolicy(Qt::StrongFocus);
  setCursor(Qt::CrossCursor);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setToolTip(
      tr("The patch from above under the light of the scene, and the part of it that the brush paints. Press "
         "on its middle and drag to its size; arrow keys move it, + and \u2212 size it."));
  redraw_.setSingleShot(true);
  redraw_.setInterval(kRedrawMilliseconds);
  connect(&redraw_, &QTimer::timeout, this, &ExemplarSquare::draw);
  connect(&session_.bakes(), &BakeController::productArrived, this,
          [this](const QString& stage, const ProductState& state) {
            if (stage != u"rtt") return;
            const auto product = std::dynamic_pointer_cast<const RttProduct>(state.product);
            rtt_ = product ? product->rtt : nullptr;
            redraw_.start();
          });
  connect(&session_.document(), &Document::opened, this, [this] {
    rtt_.reset();
    redraw_.start();
  });
  connect(&session_.relighter(), &Relighter::changed, this, [this] {
    if (rtt_ && isVisible() && !redraw_.isActive()) redraw_.start();
  });
  connect(&wishes_, &WishEditor::changed, this, qOverload<>(&QWidget::update));
}

void ExemplarSquare::showEvent(QShowEvent*) {
  draw();
}

void ExemplarSquare::draw() {
  picture_ = {};
  if (rtt_)
    picture_ = toQImage(previewImage(*rtt_, Vec3(0, 0, 1), lightOnGround(session_.relighter().light())),
                        session_.view().tone());
  setEnabled(hasPicture());
  update();
}

QRectF ExemplarSquare::square() const {
  const double side = std::min(width(), height());
  return {0.5 * (width() - side), 0.5 * (height() - side), side, side};
}

void ExemplarSquare::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = square();
  if (picture_.isNull()) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(theme().window);
    painter.drawRoundedRect(box, 3, 3);
    painter.setPen(theme().muted);
    painter.drawText(box, Qt::AlignCenter, tr("Nothing baked yet."));
    return;
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(box, picture_);
  painter.setClipRect(box);
  const QPointF middle(box.left() + double(wishes_.place().x) * box.width(),
                       box.bottom() - double(wishes_.place().y) * box.height());
  const double radius = double(wishes_.extent()) * box.width();
  const Rgb c = colorOfPart(wishes_.place());
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx) {
      const QPointF at = middle + QPointF(dx * box.width(), dy * box.height());
      painter.setBrush(QColor::fromRgbF(c.x, c.y, c.z, 0.25f));
      painter.setPen(QPen(QColor(0, 0, 0, 170), 3.5));
      painter.drawEllipse(at, radius, radius);
      painter.setPen(QPen(Qt::white, 1.5));
      painter.drawEllipse(at, radius, radius);
    }
  if (hasFocus()) {
    painter.setPen(QPen(theme().accent, 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(box.adjusted(0.5, 0.5, -0.5, -0.5));
  }
}

void ExemplarSquare::mousePressEvent(QMouseEvent* event) {
  const QRectF box = square();
  if (event->button() != Qt::LeftButton || !box.contains(event->position())) return event->ignore();
  pressedAt_ = event->position();
  wishes_.setPart(Vec2(float((pressedAt_.x() - box.left()) / box.width()),
                       float((box.bottom() - pressedAt_.y()) / box.height())),
                  wishes_.extent());
}

void ExemplarSquare::mouseMoveEvent(QMouseEvent* event) {
  const double away = distance(event->position(), pressedAt_);
  if (event->buttons() & Qt::LeftButton && away >= kLeastDrag)
    wishes_.setPart(wishes_.place(), float(away / square().width()));
}

void ExemplarSquare::keyPressEvent(QKeyEvent* event) {
  const auto move = [this](float x, float y) {
    wishes_.setPart(wishes_.place() + kKeyStep * Vec2(x, y), wishes_.extent());
  };
  switch (event->key()) {
    case Qt::Key_Left:
      return move(-1, 0);
    case Qt::Key_Right:
      return move(1, 0);
    case Qt::Key_Up:
      return move(0, 1);
    case Qt::Key_Down:
      return move(0, -1);
    case Qt::Key_Plus:
      return wishes_.setPart(wishes_.place(), wishes_.extent() * kKeySize);
    case Qt::Key_Minus:
      return wishes_.setPart(wishes_.place(), wishes_.extent() / kKeySize);
    default:
      QWidget::keyPressEvent(event);
  }
}

}  // namespace prt::ui
