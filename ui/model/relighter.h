#pragma once
// From light to what the surface receives: keeps scene, transfer and light together and applies one to
// the other when a picture is about to be drawn, once per change.

#include "libprt/basis/sh.h"
#include "libprt/core/job.h"
#include "libprt/light/light_rig.h"
#include "libprt/material/material.h"
#include "libprt/project/captured_objects.h"
#include "libprt/project/recipe.h"
#include "libprt/shade/biscale_view.h"
#include "libprt/shade/surface_light.h"
#include "libprt/transport/sample_set.h"
#include "libprt/transport/scene.h"
#include "libprt/transport/transfer.h"

#include <QObject>

#include <memory>
#include <vector>

namespace prt::ui {

/// An environment as it stands behind the model, both lat-long, and as points of light; null: made when they
/// are needed.
struct Backdrop {
  std::shared_ptr<const EnvironmentMap> sharp, blurred;
  std::shared_ptr<const EnvironmentPoints> points = {};
};
/// Resamples maps in other mappings, and blurs: too long for the interface where the map is large.
Backdrop makeBackdrop(const std::shared_ptr<const EnvironmentMap>& map, Job& job);

class Relighter : public QObject {
  Q_OBJECT
 public:
  explicit Relighter(QObject* parent = nullptr) : QObject(parent) {}

  /// A new scene forgets samples and transfer, unless its geometry is the old one's. Null: nothing.
  void setScene(std::shared_ptr<const Scene> scene);
  /// Where transfer is known: its samples on back sides. When transfer() is there and is not of these, both
  /// stay as they are until transfer of these arrives: the two always fit together.
  void setSamples(std::shared_ptr<const SampleSet> samples);
  /// Transfer of the scene's vertices; null until there is any: the scene is then lit without shadows.
  void setTransfer(std::shared_ptr<const Transfer> transfer);
  /// The environment, its coefficients in at least as many bands as any transfer has, and what is seen of it.
  void setEnvironment(std::shared_ptr<const EnvironmentMap> map, ShRgb coefficients, Backdrop backdrop);
  /// All lights but the environment's map, which stays, and the window that keeps them from ringing.
  void setLights(const LightRig& rig, const MethodRecipe& method = {});
  void setMaterials(std::vector<Material> materials);
  /// Objects around the scene, not lit: they light it and are seen with it.
  void setSurroundings(Surroundings surroundings);
  /// The same ones shine otherwise.
  void setEmission(std::vector<Rgb> emission);
  /// The patch on the surface; null: none. It goes with its scene.
  void setPatch(std::shared_ptr<const BiscaleSurface> patch);

  const std::shared_ptr<const Scene>& scene() const { return scene_; }
  const std::shared_ptr<const SampleSet>& samples() const { return samples_; }
  const std::shared_ptr<const Transfer>& transfer() const { return transfer_; }
  const std::shared_ptr<const EnvironmentMap>& environment() const { return rig_.environment; }
  const LightRig& rig() const { return rig_; }
  /// The environment as it stands behind the model: lat-long, sharp or blurred.
  const std::shared_ptr<const EnvironmentMap>& backdrop() const { return backdrop_.sharp; }
  const std::shared_ptr<const EnvironmentMap>& blurredBackdrop() const { return backdrop_.blurred; }
  const std::vector<Material>& materials() const { return materials_; }
  /// Null unless it is there and method() asks for it.
  std::shared_ptr<const BiscaleSurface> shownPatch() const;
  int bands() const { return transfer_ ? transfer_->bands : kUnshadowedBands; }

  /// Coefficients of all lights, and of what stands around, bands() bands.
  const ShRgb& light() { return lit().light; }
  /// What stands around the scene, lit.
  const Surroundings& surroundings() { return lit().surroundings; }
  /// All lights as they are, neither cut to bands() nor windowed: in as many bands as the environment is
  /// known in.
  ShRgb wholeLight() const;
  const MethodRecipe& method() const { return method_; }
  /// The light at the samples of the scene, which must be there.
  const SurfaceLight& surface();

  // Each grows with every change of its part: whoever uploads knows what is new.
  quint64 sceneVersion() const { return sceneVersion_; }
  quint64 lightVersion() const { return lightVersion_; }
  quint64 environmentVersion() const { return environmentVersion_; }
  quint64 materialVersion() const { return materialVersion_; }

 Q_SIGNALS:
  /// A picture drawn now would differ.
  void changed();
  void sceneChanged();
  void environmentChanged();

 private:
  static constexpr int kUnshadowedBands = 5;
  void touchLight();
  const SceneLight& lit();
  bool shadowed() const { return transfer_ && samples_; }

  std::shared_ptr<const Scene> scene_;
  std::shared_ptr<const SampleSet> samples_, nextSamples_;
  std::shared_ptr<const Transfer> transfer_;
  ShRgb environmentCoefficients_;
  LightRig rig_;
  MethodRecipe method_;
  std::vector<Material> materials_;
  std::shared_ptr<const BiscaleSurface> patch_;
  Surroundings surroundings_;
  Vec3 middle_{0};  // of the scene
  SceneLighting lighting_;
  SceneLight light_;
  SurfaceLight surface_;
  quint64 sceneVersion_ = 0, lightVersion_ = 0, environmentVersion_ = 0, materialVersion_ = 0;
  quint64 lightOf_ = 0, surfaceOf_ = 0;  // light versions that light_ and surface_ were made of
  Backdrop backdrop_;
};

}  // namespace prt::ui
