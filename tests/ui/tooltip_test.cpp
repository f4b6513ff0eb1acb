// Everything that can be set or pressed says what it is.

#include "tests/ui/studio_fixture.h"
#include "ui/widgets/color_field.h"
#include "ui/widgets/compass.h"
#include "ui/widgets/number_field.h"
#include "ui/widgets/panorama.h"
#include "ui/widgets/property_row.h"

#include <QAbstractButton>
#include <QCheckBox>
#include <QComboBox>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>

namespace prt::ui {
namespace {

using test::s;

// The tip that shows over a widget: its own, or that of what it lies in.
QString tipOver(const QWidget* widget) {
  for (const QWidget* at = widget; at && !qobject_cast<const QDockWidget*>(at); at = at->parentWidget())
    if (!at->toolTip().isEmpty()) return at->toolTip();
  return {};
}

std::string where(const QWidget* widget) {
  QString path;
  for (const QWidget* at = widget; at; at = at->parentWidget())
    path.prepend(u'/' + QString::fromLatin1(at->metaObject()->className()) + u' ' + at->objectName());
  return path.toStdString();
}

using TooltipTest = test::StudioTest;

TEST_F(TooltipTest, EveryRowOfTheRecipeTellsUnitDefaultAndCost) {
  Recipe recipe = test::smallScene();
  recipe.objects[0].material.model = MaterialModel::Phong;
  openAndSettle(recipe);
  int rows = 0;
  for (const PropertyRow* row : window.findChildren<PropertyRow*>()) {
    ++rows;
    const QString path = row->path();
    const Parameter& parameter = parameterAt(path.toStdString());
    EXPECT_EQ(row->toolTip(), parameterTip(parameter)) << path.toStdString();
    for (const std::string& part :
         {parameter.doc, "Default " + parameter.defaultText, "Cost of a change: " + parameter.cost})
      EXPECT_TRUE(row->toolTip().contains(QString::fromStdString(part).toHtmlEscaped()))
          << path.toStdString() << ": " << part;
    EXPECT_FALSE(parameter.cost.empty()) << path.toStdString();
    const std::string unit = parameter.unit.empty() ? "" : "Unit: " + parameter.unit;
    EXPECT_TRUE(row->toolTip().contains(QString::fromStdString(unit))) << path.toStdString();
  }
  EXPECT_GE(rows, 8);
}

TEST_F(TooltipTest, EveryFieldAndButtonOfTheDocksHasOne) {
  openAndSettle();
  int widgets = 0;
  for (const QDockWidget* dock : window.findChildren<QDockWidget*>())
    for (const QWidget* widget : dock->findChildren<QWidget*>()) {
      const auto* button = qobject_cast<const QAbstractButton*>(widget);
      const bool asks = qobject_cast<const NumberField*>(widget) || qobject_cast<const QComboBox*>(widget) ||
                        qobject_cast<const ColorField*>(widget) || qobject_cast<const Panorama*>(widget) ||
                        qobject_cast<const Compass*>(widget) || qobject_cast<const QLineEdit*>(widget) ||
                        button;
      if (!asks || (button && button->objectName() == s("sectionHeader"))) continue;
      if (widget->objectName().startsWith(s("qt_"))) continue;  // inside Qt's own widgets
      ++widgets;
      EXPECT_FALSE(tipOver(widget).isEmpty()) << where(widget);
    }
  EXPECT_GE(widgets, 20);
}

TEST_F(TooltipTest, TheStatusBarTellsWhatTheMouseDoesHere) {
  openAndSettle();
  auto* hint = window.findChild<QLabel*>(s("hintLabel"));
  EXPECT_EQ(hint->text(), window.viewport().hint());
  auto* rays = window.findChild<PropertyRow*>(s("transfer.rays"));
  QTest::mouseMove(handle(), rays->editor()->mapTo(&window, rays->editor()->rect().center()));
  EXPECT_TRUE(test::waitFor([&] { return hint->text() == NumberField::hint(); }, 2000))
      << hint->text().toStdString();
  QTest::mouseMove(handle(), inView());
  EXPECT_TRUE(test::waitFor([&] { return hint->text() == window.viewport().hint(); }, 2000))
      << hint->text().toStdString();
}

TEST_F(TooltipTest, TheStatusBarTellsFileSizeAndMemory) {
  openAndSettle();
  EXPECT_TRUE(window.findChild<QLabel*>(s("sizeLabel"))->text().endsWith(s(" m")));
  EXPECT_TRUE(window.findChild<QLabel*>(s("memoryLabel"))->text().endsWith(s(" MB")));
}

}  // namespace
}  // namespace prt::ui
