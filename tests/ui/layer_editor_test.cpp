// Layers of patches: chosen, painted with the mouse, edited in the Patch dock.

#include "ui/model/layer_editor.h"

#include "tests/ui/brush_fixture.h"
#include "tests/ui/pointer.h"
#include "ui/widgets/property_row.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QToolButton>

namespace prt::ui {
namespace {

using test::difference;
using test::pass;
using test::Pointer;
using test::s;
using test::waitFor;

class LayerEditorTest : public test::BrushTest {
 protected:
  void openWith(const Recipe& recipe) { openWithDocks(recipe, {s("patch")}); }
  void takeBrush() {
    BrushTest::takeBrush(Qt::Key_P, Brush::Layers);
    ASSERT_TRUE(waitFor([this] { return layers.settled(); }));
  }
  const std::vector<LayerRecipe>& recipes() { return session.document().recipe().layers; }

  LayerEditor& layers = session.patchLayers();
};

TEST_F(LayerEditorTest, ALayerIsAddedPaintedErasedAndUndone) {
  openWith(quickPatch());
  auto* list = find<QListWidget>("layerList");
  EXPECT_EQ(list->count(), 1) << "the patch alone";
  EXPECT_FALSE(find<QPushButton>("paintLayer")->isEnabled()) << "there is nothing to paint with";
  QTest::mouseClick(find<QToolButton>("addLayer"), Qt::LeftButton);
  ASSERT_EQ(recipes().size(), 1u);
  EXPECT_EQ(undoName(), s("Add layer"));
  EXPECT_EQ(recipes()[0].patch.model, PatchModel::Weave) << "something else than what is below";
  EXPECT_EQ(list->count(), 2);
  EXPECT_EQ(list->currentRow(), 0) << "the uppermost comes first";
  takeBrush();
  const QImage before = shot();
  Pointer hand(&window.viewport());
  hand.press(at(0, 50));
  hand.move(at(0, -50));
  EXPECT_GT(difference(before, shot()), 0.005) << "shown while it is painted";
  EXPECT_TRUE(recipes()[0].spots.empty());
  hand.release(at(0, -50));
  EXPECT_EQ(undoName(), s("Paint layer 1"));
  const std::size_t painted = layers.spotsOf(0).size();
  EXPECT_GT(painted, 1u);
  for (const LayerSpot& spot : layers.spotsOf(0)) {
    EXPECT_NEAR(spot.radius, layers.radius(), 1e-6f);
    EXPECT_EQ(spot.strength, 1);
  }
  hand.drag(at(0, 55), at(0, 45), Qt::ControlModifier);
  EXPECT_LT(layers.spotsOf(0).size(), painted);
  EXPECT_EQ(undoName(), s("Erase layer 1"));
  session.document().undo();
  EXPECT_EQ(layers.spotsOf(0).size(), painted);
  QTest::mouseClick(find<QPushButton>("uncoverLayer"), Qt::LeftButton);
  EXPECT_TRUE(recipes()[0].spots.empty());
  EXPECT_TRUE(find<QLabel>("layersState")->text().contains(s("Shows nothing yet")));
  session.document().undo();
  session.document().undo();
  session.document().undo();
  EXPECT_TRUE(recipes().empty());
  EXPECT_EQ(layers.selected(), LayerEditor::kPatch);
  EXPECT_EQ(list->count(), 1);
}

TEST_F(LayerEditorTest, ThePatchDockEditsTheSelectedLayer) {
  openWith(quickPatch());
  ASSERT_TRUE(window.bringToFront(s("patch")));
  auto* which = find<QComboBox>("patchLayer");
  EXPECT_FALSE(which->isVisible()) << "there is no choice";
  const auto row = [this](const char* path) -> PropertyRow* {
    for (PropertyRow* each : window.findChildren<PropertyRow*>())
      if (each->path() == QLatin1String(path)) return each;
    return nullptr;
  };
  ASSERT_TRUE(row("patch.depth"));
  layers.add();
  pass(20);
  EXPECT_TRUE(which->isVisible());
  EXPECT_EQ(which->currentIndex(), 1);
  EXPECT_FALSE(row("patch.depth"));
  ASSERT_TRUE(row("layers[0].patch.yarns"));
  EXPECT_TRUE(row("layers[0].patch.yarns")->isVisible());
  EXPECT_FALSE(row("layers[0].patch.heightmap")->isVisible()) << "a weave has none";
  row("layers[0].patch.yarns")->apply(s("4"));
  EXPECT_EQ(recipes()[0].patch.yarns, 4);
  EXPECT_EQ(session.document().recipe().patch.model, PatchModel::HeightField);
  layers.select(LayerEditor::kPatch);
  pass(20);
  EXPECT_TRUE(row("patch.depth"));
  // The one that is worked on goes: its rows with it.
  layers.select(0);
  layers.remove(0);
  pass(20);
  EXPECT_TRUE(recipes().empty());
  EXPECT_TRUE(row("patch.depth"));
  EXPECT_FALSE(which->isVisible());
  session.document().undo();
  EXPECT_EQ(recipes().size(), 1u);
}

TEST_F(LayerEditorTest, ThreeAtMostAndNoneWithoutAPatch) {
  openWith(test::smallScene());
  EXPECT_FALSE(layers.canAdd());
  EXPECT_FALSE(find<QListWidget>("layerList")->isVisible());
  session.document().set(s("patch.model"), s("weave"));
  for (int i = 0; i < 3; ++i) {
    EXPECT_TRUE(layers.canAdd());
    layers.add();
  }
  EXPECT_EQ(recipes()[0].patch.model, PatchModel::HeightField);
  EXPECT_FALSE(layers.canAdd());
  EXPECT_FALSE(find<QToolButton>("addLayer")->isEnabled());
  layers.rename(1, s("  moss "));
  EXPECT_EQ(recipes()[1].name, "moss");
  EXPECT_EQ(find<QListWidget>("layerList")->item(1)->text(), s("moss"));
  while (session.document().canUndo()) session.document().undo();
}

TEST_F(LayerEditorTest, LayersOfAFileAreBakedAndShown) {
  Recipe recipe = quickPatch();
  recipe.method.name = "biscale";
  recipe.atlas.size = 256, recipe.idmap.size = 256, recipe.synthesis.vertices = 4000;
  LayerRecipe& layer = recipe.layers.emplace_back();
  layer.patch.model = PatchModel::Flat, layer.patch.albedo = Rgb(0.9f, 0.05f, 0.05f);
  layer.spots = "9,0,0 30 1;-9,0,0 30 1;0,9,0 30 1;0,-9,0 30 1;0,0,9 30 1;0,0,-9 30 1";  // every side
  openWith(recipe);
  EXPECT_TRUE(waitFor([this] {
    const QImage picture = shot();
    const QColor middle = picture.pixelColor(picture.width() / 2, picture.height() / 2);
    return middle.red() > 3 * middle.green();
  })) << "the layer covers all of it";
}

}  // namespace
}  // namespace prt::ui
