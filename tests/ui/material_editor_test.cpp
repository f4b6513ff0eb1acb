#include "ui/model/material_editor.h"

#include "libprt/material/bsdf.h"
#include "ui/model/lobe.h"

#include <gtest/gtest.h>

#include <set>

namespace prt::ui {
namespace {

class MaterialEditorTest : public testing::Test {
 protected:
  MaterialEditorTest() {
    Recipe recipe;
    recipe.objects.resize(2);
    recipe.objects[1].material.name = "mine";
    recipe.objects[1].material.twoSided = true;
    document.open(recipe, {});
  }
  Document document;
  MaterialEditor editor{document};
};

TEST(MaterialPresets, AreADozenThatKeepEnergyAndDiffer) {
  EXPECT_GE(materialPresets().size(), 12u);
  std::set<QString> names;
  for (const MaterialPreset& preset : materialPresets()) {
    EXPECT_LE(reflectedShare(preset.material), 1) << preset.name.toStdString();
    EXPECT_FALSE(preset.about.isEmpty());
    names.insert(preset.name);
    for (const MaterialPreset& other : materialPresets())
      EXPECT_TRUE(&preset == &other || !(preset.material == other.material));
  }
  EXPECT_EQ(names.size(), materialPresets().size());
}

TEST_F(MaterialEditorTest, APresetChangesTheReflectionAsOneNamedStep) {
  const MaterialPreset& preset = materialPresets().back();
  editor.apply(preset, 1);
  const Material& material = document.recipe().objects[1].material;
  EXPECT_EQ(material.model, preset.material.model);
  EXPECT_EQ(material.albedo, preset.material.albedo);
  EXPECT_EQ(material.specular, preset.material.specular);
  EXPECT_EQ(material.exponent, preset.material.exponent);
  EXPECT_EQ(material.name, "mine");
  EXPECT_TRUE(material.twoSided);
  EXPECT_EQ(editor.presetOf(1), &preset);
  EXPECT_EQ(editor.presetOf(0), nullptr);
  EXPECT_EQ(document.undoName(), QStringLiteral("Preset ") + preset.name);
  document.undo();
  EXPECT_EQ(document.recipe().objects[1].material.albedo, Material{}.albedo);
  EXPECT_FALSE(document.canUndo());
  editor.apply(preset, 7);  // there is no such object
  EXPECT_FALSE(document.canUndo());
}

TEST_F(MaterialEditorTest, OneFactorBringsEnergyBack) {
  document.set(QStringLiteral("objects[1].material.albedo"), QStringLiteral("0.9,0.6,0.3"));
  document.set(QStringLiteral("objects[1].material.specular"), QStringLiteral("0.6,0.6,0.6"));
  EXPECT_FLOAT_EQ(reflectedShare(*editor.material(1)), 0.9f) << "a Lambert surface has no lobe";
  document.set(QStringLiteral("objects[1].material.model"), QStringLiteral("phong"));
  EXPECT_FLOAT_EQ(reflectedShare(*editor.material(1)), 1.5f);
  editor.keepEnergy(1);
  EXPECT_EQ(document.undoName(), QStringLiteral("Keep energy"));
  const Material fixed = *editor.material(1);
  EXPECT_LE(reflectedShare(fixed), 1);
  EXPECT_GT(reflectedShare(fixed), 0.9999f);
  EXPECT_NEAR(fixed.albedo.x / fixed.specular.x, 1.5f, 1e-5f) << "the balance stays";
  EXPECT_NEAR(fixed.albedo.y / fixed.albedo.z, 2, 1e-5f) << "and the hue";
  const Recipe before = document.recipe();
  editor.keepEnergy(1);
  EXPECT_EQ(document.recipe(), before) << "nothing to do";
}

const Material kGloss{
    .model = MaterialModel::Phong, .albedo = Rgb(0.3f), .specular = Rgb(0.4f), .exponent = 200};

TEST(Lobe, IsTheBrdfTimesTheCosine) {
  const Lobe lobe = lobeOf(kGloss, 35);
  const Vec3 in(-std::sin(float(radians(35.0))), 0, std::cos(float(radians(35.0))));
  for (std::size_t i = 0; i < lobe.angles.size(); i += 7) {
    const float a = float(radians(lobe.angles[i]));
    const double expected = double(luminance(evalBrdf(kGloss, in, {std::sin(a), 0, std::cos(a)}))) *
                            std::max(0.0, double(std::cos(a)));
    EXPECT_NEAR(lobe.diffuse[i] + lobe.specular[i], expected, 1e-4 * lobe.highest + 1e-6) << lobe.angles[i];
    EXPECT_NEAR(lobe.diffuse[i], 0.3 / kPi * std::max(0.0, double(std::cos(a))), 1e-6);
  }
}

TEST(Lobe, PeaksInTheMirrorDirectionAndIsHalfThereBesideIt) {
  Material metal = kGloss;
  metal.albedo = Rgb(0);
  for (const float exponent : {2.0f, 200.0f, 10000.0f}) {
    metal.exponent = exponent;
    const Lobe lobe = lobeOf(metal, 0);
    const double top = double(exponent + 2) / (2 * kPi) * 0.4;
    EXPECT_NEAR(lobe.highest, top, 1e-3 * top) << "the mirror direction is among the angles";
    const Vec3 beside(float(std::sin(radians(lobe.halfWidth))), 0, float(std::cos(radians(lobe.halfWidth))));
    EXPECT_NEAR(luminance(evalBrdf(metal, {0, 0, 1}, beside)), 0.5 * top, 0.01 * top);
  }
}

TEST(Lobe, TellsTheAlbedoAtThatAngle) {
  EXPECT_NEAR(lobeOf(kGloss, 0).albedo.x, 0.7, 1e-3);
  EXPECT_LT(lobeOf(kGloss, 80).albedo.x, 0.6);
  Material matte = kGloss;
  matte.model = MaterialModel::Lambert;
  EXPECT_NEAR(lobeOf(matte, 60).albedo.x, 0.3, 1e-6);
  EXPECT_EQ(lobeOf(matte, 60).halfWidth, 0);
}

}  // namespace
}  // namespace prt::ui
