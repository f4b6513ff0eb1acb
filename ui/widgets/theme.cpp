#include "ui/widgets/theme.h"

#include <QApplication>
#include <QBuffer>
#include <QFile>
#include <QFont>
#include <QImageReader>
#include <QPalette>
#include <QPixmap>
#include <QStyle>
#include <QStyleFactory>
#include <QWidget>

namespace prt::ui {

namespace {

Theme current = darkTheme();

QPalette paletteOf(const Theme& t) {
  QPalette p;
  p.setColor(QPalette::Window, t.panel);
  p.setColor(QPalette::WindowText, t.text);
  p.setColor(QPalette::Base, t.field);
  p.setColor(QPalette::AlternateBase, t.panel);
  p.setColor(QPalette::Text, t.text);
  p.setColor(QPalette::Button, t.field);
  p.setColor(QPalette::ButtonText, t.text);
  p.setColor(QPalette::BrightText, t.failed);
  p.setColor(QPalette::PlaceholderText, t.muted);
  p.setColor(QPalette::Highlight, t.accent);
  p.setColor(QPalette::HighlightedText, t.onAccent);
  p.setColor(QPalette::Link, t.accent);
  p.setColor(QPalette::ToolTipBase, t.field);
  p.setColor(QPalette::ToolTipText, t.text);
  p.setColor(QPalette::Light, t.line);
  p.setColor(QPalette::Midlight, t.line);
  p.setColor(QPalette::Mid, t.line);
  p.setColor(QPalette::Dark, t.window);
  p.setColor(QPalette::Shadow, t.window);
  for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText})
    p.setColor(QPalette::Disabled, role, t.muted);
  return p;
}

// The style sheet names colours "@panel"; the longest names are replaced first.
QString styleSheetOf(const Theme& t) {
  QFile file(QStringLiteral(":/theme/studio.qss"));
  if (!file.open(QIODevice::ReadOnly)) return {};
  QString sheet = QString::fromUtf8(file.readAll());
  const std::pair<const char*, QColor> colors[] = {
      {"@fieldHover", t.fieldHover}, {"@onAccent", t.onAccent}, {"@window", t.window}, {"@accent", t.accent},
      {"@failed", t.failed},         {"@panel", t.panel},       {"@field", t.field},   {"@muted", t.muted},
      {"@stale", t.stale},           {"@line", t.line},         {"@text", t.text},     {"@done", t.done}};
  for (const auto& [name, color] : colors) sheet.replace(QLatin1String(name), color.name());
  return sheet;
}

QPixmap render(QByteArray svg, const QColor& color, int pixels) {
  svg.replace("#232629", color.name().toLatin1());
  QBuffer buffer(&svg);
  QImageReader reader(&buffer, "svg");
  reader.setScaledSize(QSize(pixels, pixels));
  return QPixmap::fromImage(reader.read());
}

}  // namespace

const Theme& darkTheme() {
  static const Theme dark{.name = QStringLiteral("dark"),
                          .window = QColor(0x1e, 0x1e, 0x1e),
                          .panel = QColor(0x26, 0x26, 0x26),
                          .field = QColor(0x30, 0x30, 0x30),
                          .fieldHover = QColor(0x38, 0x38, 0x38),
                          .line = QColor(0x3a, 0x3a, 0x3a),
                          .text = QColor(0xd6, 0xd6, 0xd6),
                          .muted = QColor(0x9a, 0x9a, 0x9a),
                          .accent = QColor(0xe0, 0xa3, 0x41),
                          .onAccent = QColor(0x1e, 0x1e, 0x1e),
                          .done = QColor(0x6f, 0xb3, 0x72),
                          .stale = QColor(0xd9, 0x9a, 0x3c),
                          .failed = QColor(0xec, 0x7f, 0x75)};
  return dark;
}

const Theme& theme() { return current; }

void applyTheme(QApplication& application, const Theme& t) {
  current = t;
  application.setStyle(QStyleFactory::create(QStringLiteral("Fusion")));
  application.setPalette(paletteOf(t));
  QFont font = application.font();
  font.setPointSizeF(9);
  application.setFont(font);
  application.setStyleSheet(styleSheetOf(t));
}

void setRole(QWidget* widget, const char* role) {
  widget->setProperty("role", QString::fromLatin1(role));
  widget->style()->polish(widget);
}

QIcon icon(const QString& name, const QColor& color) {
  QFile file(QStringLiteral(":/icons/%1.svg").arg(name));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QByteArray svg = file.readAll();
  QIcon result;
  for (const int pixels : {16, 24, 32, 48}) {
    result.addPixmap(render(svg, color.isValid() ? color : current.text, pixels));
    result.addPixmap(render(svg, current.muted.darker(140), pixels), QIcon::Disabled);
  }
  return result;
}

}  // namespace prt::ui
