#include "ui/widgets/icon.h"

#include "ui/widgets/theme.h"

#include <QBuffer>
#include <QFile>
#include <QIconEngine>
#include <QImageReader>
#include <QPainter>
#include <QPixmapCache>

namespace prt::ui {

namespace {

// One colour, whatever Breeze has: red and orange mean states here.
QByteArray recoloured(QByteArray svg, const QColor& color, const QColor& behind) {
  for (const char* of : {"#232629", "#da4453", "#f67400"}) svg.replace(of, color.name().toLatin1());
  return svg.replace("#fff\"", behind.name().toLatin1() + '"');
}

QPixmap render(QByteArray svg, const QSize& size) {
  QBuffer buffer(&svg);
  QImageReader reader(&buffer, "svg");
  reader.setScaledSize(size);
  return QPixmap::fromImage(reader.read());
}

class ThemeIconEngine : public QIconEngine {
 public:
  ThemeIconEngine(const QString& name, QByteArray svg, const QColor& color)
      : name_(name), svg_(std::move(svg)), color_(color), role_(roleOf(color)) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State state) override {
    const qreal ratio = painter->device() ? painter->device()->devicePixelRatioF() : 1;
    painter->drawPixmap(rect, scaledPixmap(rect.size() * ratio, mode, state, ratio));
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State) override {
    const QColor color = colorNow(mode);
    const QString key =
        QStringLiteral("prt-icon-%1-%2-%3x%4").arg(name_, color.name()).arg(size.width()).arg(size.height());
    QPixmap result;
    if (QPixmapCache::find(key, &result)) return result;
    result = render(recoloured(svg_, color, theme().panel), size);
    QPixmapCache::insert(key, result);
    return result;
  }
  QPixmap scaledPixmap(const QSize& size, QIcon::Mode mode, QIcon::State state, qreal) override {
    return pixmap(size, mode, state);
  }
  QSize actualSize(const QSize& size, QIcon::Mode, QIcon::State) override { return size; }
  QIconEngine* clone() const override { return new ThemeIconEngine(*this); }
  QString key() const override { return QStringLiteral("prt"); }
  bool isNull() override { return svg_.isEmpty(); }

 private:
  QColor colorNow(QIcon::Mode mode) const {
    const Theme& t = theme();
    if (mode == QIcon::Disabled) return mixed(t.muted, t.panel, 0.5);
    return role_ ? t.*role_ : color_.isValid() ? color_ : t.text;
  }

  QString name_;
  QByteArray svg_;
  QColor color_;
  QColor Theme::*role_;
};

}  // namespace

QIcon icon(const QString& name, const QColor& color) {
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  if (!file.open(QIODevice::ReadOnly)) return {};
  return QIcon(new ThemeIconEngine(name, file.readAll(), color));
}

QIcon applicationIcon() {
  QFile file(QStringLiteral(":/theme/prt-studio.svg"));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QByteArray svg = file.readAll();
  QIcon result;
  for (const int side : {16, 24, 32, 48, 64, 128, 256}) result.addPixmap(render(svg, QSize(side, side)));
  return result;
}

}  // namespace prt::ui
