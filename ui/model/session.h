#pragma once
// One open studio without its window: the document and everything that follows from it. Widgets show
// what is here and call what is here; nothing here knows a widget.

#include "libprt/project/lights.h"
#include "ui/model/bake_controller.h"
#include "ui/model/document.h"
#include "ui/model/job_runner.h"
#include "ui/model/light_editor.h"
#include "ui/model/log.h"
#include "ui/model/probe_library.h"
#include "ui/model/project_keeper.h"
#include "ui/model/relighter.h"
#include "ui/model/scene_rays.h"
#include "ui/model/surface_layers.h"
#include "ui/model/surface_patch.h"
#include "ui/model/view_state.h"

#include <QObject>

#include <functional>
#include <memory>
#include <optional>

namespace prt {
struct MeshProduct;
}

namespace prt::ui {

class CapturedScene;
class ChartEditor;
class DefectView;
class ErrorEstimate;
class FieldEditor;
class IdView;
class LayerEditor;
class Painting;
class SceneEditor;
class WishEditor;

/// What the picture on screen is made with.
struct PictureStatus {
  QString method;  ///< "Diffuse", "Glossy", "Unshadowed"
  int bands = 0;
  int level = 0, levels = 0;  ///< passes of the transfer that is drawn; level == levels: final
  int rays = 0, raysWanted = 0;
  int bounces = 0;
  std::optional<double> estimatedError;  ///< relative, of irradiance; once it was estimated
};

/// Where a message belongs, so that it appears there.
enum class Place { Viewport, Light, Material, Transfer, Scene };

class Session : public QObject {
  Q_OBJECT
 public:
  explicit Session(QObject* parent = nullptr);
  ~Session() override;

  Document& document() { return document_; }
  LightEditor& lights() { return lights_; }
  ProbeLibrary& probes() { return probes_; }
  const SceneRays& rays() const { return rays_; }
  ViewState& view() { return view_; }
  JobRunner& jobs() { return jobs_; }
  Relighter& relighter() { return relighter_; }
  BakeController& bakes() { return bakes_; }
  Log& log() { return log_; }
  SurfaceLayers& layers() { return layers_; }
  SceneEditor& sceneEditor() { return *sceneEditor_; }
  ChartEditor& charts() { return *charts_; }
  Painting& painting() { return *painting_; }
  FieldEditor& field() { return *field_; }
  IdView& ids() { return *ids_; }
  WishEditor& wishes() { return *wishes_; }
  LayerEditor& patchLayers() { return *patchLayers_; }
  DefectView& defects() { return *defects_; }
  ErrorEstimate& errors() { return *errors_; }
  ProjectKeeper& project() { return project_; }

  /// Opens by kind: an environment (.hdr, .exr, .png) becomes the light, everything else the document
  /// (ProjectKeeper::open).
  void open(const QString& what);
  void openDefaultScene() { open(QStringLiteral("scene:default")); }
  bool opening() const { return project_.opening(); }
  /// Nothing is being read or baked, and there is something to see.
  bool settled() const;
  /// Names for open("scene:NAME").
  QStringList sampleScenes() const;
  void save(const QString& path) { project_.save(path); }

  /// Degrees, counter-clockwise seen from above; of the first environment light.
  double environmentAngle() const;
  void setEnvironmentAngle(double degrees);
  bool hasEnvironment() const { return lights_.environment() >= 0; }
  /// False while the map on screen is a coarse one that follows a dragged sun.
  bool environmentExact() const { return environmentExact_; }
  /// Makes a file or "builtin:NAME" the environment; a file only once it could be read.
  void useEnvironment(const QString& path);
  /// File or built-in name of the environment; empty when there is none.
  QString environmentFile() const;
  /// The same as an absolute path, as ProbeLibrary knows it.
  QString environmentPath() const;

  int selectedObject() const { return selectedObject_; }
  void selectObject(int index);

  PictureStatus status() const;
  /// The meshes as they were last read; null until then.
  const std::shared_ptr<const MeshProduct>& meshes() const { return meshes_; }
  /// What each of them was read from.
  const std::vector<MeshRecipe>& meshRecipes() const { return meshRecipes_; }
  /// What is stored for the surface, in words: form, functions, bytes.
  QString transferSummary() const;
  Box3 bounds() const;
  /// The same with what stands around the model.
  Box3 allBounds() const;
  /// Of one object; empty when there is no such object or nothing was read yet.
  Box3 objectBounds(int object) const;
  void frameAll() { view_.frame(allBounds()); }
  void frameSelected() { view_.frame(objectBounds(selectedObject_)); }

  /// Writes to the log, and for warnings and errors asks for a message at its place.
  void report(Severity severity, const QString& text, Place place = Place::Viewport);

 Q_SIGNALS:
  void statusChanged();
  void selectionChanged(int object);
  void meshesChanged();
  void message(prt::ui::Severity severity, const QString& text, prt::ui::Place place);

 private:
  void forget();
  void openEnvironment(const QString& path);
  QString absolutePath(const LightRecipe& light) const;
  std::string shownKey(LightRecipe light) const;
  void startEnvironment(const LightRecipe& light, std::function<void()> loaded);
  void showQuickSky(const LightRecipe& light);
  void finishSky();
  void follow();
  void applyLights();
  void applyMaterials();
  void take(const QString& stage, const ProductState& state);
  void showFirst();

  Document document_;
  LightEditor lights_{document_};
  ViewState view_;
  Log log_;
  Relighter relighter_;
  JobRunner jobs_;
  BakeController bakes_;
  ProjectKeeper project_;
  ProbeLibrary probes_{jobs_};
  SceneRays rays_{relighter_, jobs_};
  std::shared_ptr<EnvironmentCache> environments_;  // used by one job at a time
  bool frameNext_ = false;                          // the next scene is a new one: show all of it
  int selectedObject_ = 0;
  std::string environmentShown_;  // key of the map that is loaded or on its way
  bool environmentExact_ = true;
  std::string skyJobKey_;  // of the exact sky that is on its way
  std::vector<Box3> objectBounds_;
  std::shared_ptr<const MeshProduct> meshes_;
  std::vector<MeshRecipe> meshRecipes_;
  int level_ = 0, levels_ = 0;
  SurfaceLayers layers_;
  std::unique_ptr<SceneEditor> sceneEditor_;
  std::unique_ptr<CapturedScene> captured_;
  std::unique_ptr<ChartEditor> charts_;
  std::unique_ptr<DefectView> defects_;
  std::unique_ptr<ErrorEstimate> errors_;
  std::unique_ptr<Painting> painting_;
  std::unique_ptr<FieldEditor> field_;
  std::unique_ptr<WishEditor> wishes_;
  std::unique_ptr<LayerEditor> patchLayers_;
  std::unique_ptr<IdView> ids_;
  SurfacePatch patch_{document_, bakes_, relighter_, jobs_};
};

}  // namespace prt::ui
