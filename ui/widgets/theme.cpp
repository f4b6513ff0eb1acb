#include "ui/widgets/theme.h"

#include <QApplication>
#include <QFile>
#include <QFont>
#include <QPalette>
#include <QStyle>
#include <QStyleFactory>
#include <QWidget>

#include <algorithm>
#include <cmath>

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
  sheet.replace(QStringLiteral("@theme"), t.name);  // of pictures
  for (const auto& [name, color] : colors) sheet.replace(QLatin1String(name), color.name());
  return sheet;
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
                          .muted = QColor(0xa4, 0xa4, 0xa4),
                          .accent = QColor(0xe0, 0xa3, 0x41),
                          .onAccent = QColor(0x1e, 0x1e, 0x1e),
                          .done = QColor(0x6f, 0xb3, 0x72),
                          .stale = QColor(0xd9, 0x9a, 0x3c),
                          .failed = QColor(0xf0, 0x8b, 0x82)};
  return dark;
}

// Greys as far from white as the dark ones are from black; text, accent and states darkened until they read.
const Theme& lightTheme() {
  static const Theme light{.name = QStringLiteral("light"),
                           .window = QColor(0xdc, 0xdc, 0xdc),
                           .panel = QColor(0xec, 0xec, 0xec),
                           .field = QColor(0xfa, 0xfa, 0xfa),
                           .fieldHover = QColor(0xff, 0xff, 0xff),
                           .line = QColor(0xc6, 0xc6, 0xc6),
                           .text = QColor(0x24, 0x24, 0x24),
                           .muted = QColor(0x50, 0x50, 0x50),
                           .accent = QColor(0x87, 0x54, 0x00),
                           .onAccent = QColor(0xff, 0xff, 0xff),
                           .done = QColor(0x2a, 0x6b, 0x30),
                           .stale = QColor(0x87, 0x54, 0x00),
                           .failed = QColor(0xb0, 0x2a, 0x20)};
  return light;
}

const Theme* themeNamed(const QString& name) {
  for (const Theme* t : {&darkTheme(), &lightTheme()})
    if (t->name == name) return t;
  return nullptr;
}

const Theme& theme() {
  return current;
}

QColor Theme::*roleOf(const QColor& color) {
  if (!color.isValid()) return nullptr;
  for (QColor Theme::*role : {&Theme::text, &Theme::muted, &Theme::accent, &Theme::onAccent, &Theme::done,
                              &Theme::stale, &Theme::failed, &Theme::line})
    if (current.*role == color) return role;
  return nullptr;
}

QColor mixed(const QColor& a, const QColor& b, double share) {
  const auto mix = [share](float x, float y) { return float(x + (y - x) * share); };
  return QColor::fromRgbF(mix(a.redF(), b.redF()), mix(a.greenF(), b.greenF()), mix(a.blueF(), b.blueF()));
}

double contrast(const QColor& a, const QColor& b) {
  const auto luminanceOf = [](const QColor& c) {
    const auto linear = [](double v) {
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
  };
  const double x = luminanceOf(a), y = luminanceOf(b);
  return (std::max(x, y) + 0.05) / (std::min(x, y) + 0.05);
}

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

}  // namespace prt::ui
