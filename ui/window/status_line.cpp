#include "ui/window/status_line.h"

#include "ui/model/session.h"
#include "ui/viewport/viewport.h"

#include <QLabel>
#include <QStatusBar>
#include <QTimer>

#include <fstream>

namespace prt::ui {

namespace {

constexpr int kMemoryMilliseconds = 1000;
constexpr long kPage = 4096;

QString residentMemory() {
  std::ifstream file("/proc/self/statm");
  long total = 0, resident = 0;
  file >> total >> resident;
  return QObject::tr("%1 MB").arg(resident * kPage / 1'000'000);
}

}  // namespace

QString documentName(const Document& document) {
  const QString title = document.title();
  return title.isEmpty() ? QObject::tr("Untitled") : title;
}

StatusLine::StatusLine(Session& session, Viewport& viewport, QStatusBar& bar)
    : QObject(&bar),
      session_(session),
      viewport_(viewport),
      file_(new QLabel),
      size_(new QLabel),
      hint_(new QLabel),
      memory_(new QLabel) {
  bar.setSizeGripEnabled(false);
  bar.addWidget(file_);
  bar.addWidget(size_);
  bar.addWidget(hint_, 1);
  bar.addPermanentWidget(memory_);
  size_->setObjectName(QStringLiteral("sizeLabel"));
  size_->setToolTip(
      tr("Size of the scene, width \u00d7 height \u00d7 depth. One unit of a file counts as one metre."));
  hint_->setObjectName(QStringLiteral("hintLabel"));
  hint_->setAlignment(Qt::AlignCenter);
  hint_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  memory_->setObjectName(QStringLiteral("memoryLabel"));
  memory_->setToolTip(tr("Memory that the studio uses."));
  connect(&viewport_, &Viewport::hintChanged, this, &StatusLine::refreshHint);
  connect(&session_.relighter(), &Relighter::sceneChanged, this, &StatusLine::refreshSize);
  connect(&session_.document(), &Document::stateChanged, this, &StatusLine::refreshFile);
  auto* timer = new QTimer(this);
  connect(timer, &QTimer::timeout, this, &StatusLine::refreshMemory);
  timer->start(kMemoryMilliseconds);
  refreshMemory();
  refreshFile();
  refreshHint();
}

void StatusLine::setTip(const QString& tip) {
  tip_ = tip;
  refreshHint();
}

void StatusLine::setMemoryVisible(bool visible) {
  memory_->setVisible(visible);
}

// What the mouse does where it is: a widget's status tip, else the viewport's.
void StatusLine::refreshHint() {
  hint_->setText(tip_.isEmpty() ? viewport_.hint() : tip_);
}

void StatusLine::refreshFile() {
  const Document& document = session_.document();
  file_->setText(documentName(document) + (document.modified() ? tr(" \u00b7 edited") : QString()));
  file_->setToolTip(document.path());
}

void StatusLine::refreshSize() {
  const Box3 box = session_.bounds();
  const Vec3 size = box.high - box.low;
  const bool any = session_.relighter().scene() && size.x >= 0;
  const auto text = [](float v) { return QString::number(double(v), 'g', 3); };
  size_->setText(any ? tr("%1 \u00d7 %2 \u00d7 %3 m").arg(text(size.x), text(size.y), text(size.z))
                     : QString());
}

void StatusLine::refreshMemory() {
  memory_->setText(residentMemory());
}

}  // namespace prt::ui
