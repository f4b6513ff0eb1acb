#pragma once
// The charts of the scene as they are worked on by hand: cuts drawn on the surface, flat maps that follow
// behind the interface, places in the atlas. What is set goes into the recipe, one named step of undo per
// gesture; what follows from it is made anew here, the newest recipe first, as the stages "charts" and
// "atlas" would.

#include "libprt/core/hash.h"
#include "libprt/shade/pick.h"
#include "ui/model/chart_maps.h"
#include "ui/model/cut_path.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>

#include <map>
#include <memory>
#include <optional>
#include <set>

namespace prt::ui {

class Session;

/// What is shown of the charts on the surface and in their view.
enum class ChartShade { Off, Charts, Checker, Stretch, Density };
QString nameOf(ChartShade shade);

/// One chart as it is now.
struct ChartItem {
  ChartSettings settings;                   ///< `face` names the chart
  QString fault;                            ///< why it is no disk; empty for one
  QString error;                            ///< why it could not be laid flat
  FlatMapPtr map;                           ///< null until there is one
  std::optional<ChartPlacement> placement;  ///< where it lies; none until it is packed
  std::vector<std::uint32_t> suggestion;    ///< edges whose cutting makes it a disk
  bool overlaps = false;                    ///< it lies over another one, or outside of the square

  bool bad() const { return !fault.isEmpty() || !error.isEmpty(); }
};

struct ChartNumbers {
  int charts = 0, notDisks = 0, overlaps = 0;
  double l2 = 1, lInf = 1;
  double seam = 0;     ///< relative to the root of the area
  double filled = -1;  ///< negative: not known
  int stretched = -1;  ///< the chart that adds most where all together stretch more than charts.stretch
  bool final = false;  ///< nothing is being worked on
};

class ChartEditor : public QObject {
  Q_OBJECT
 public:
  explicit ChartEditor(Session& session, QObject* parent = nullptr);
  ~ChartEditor() override;

  /// Work is done while somebody looks: the dock, or the cut tool.
  void setWatched(const QObject* who, bool watched);
  bool watched() const { return !watchers_.empty(); }

  /// The surface; null until the scene was read and somebody looks.
  const std::shared_ptr<const CutSurface>& on() const { return on_; }
  bool ready() const { return on_ != nullptr; }
  /// Nothing is being worked on: what is shown is what the recipe says.
  bool settled() const { return job_ == 0 && !needsSurface_ && !pending_ && !autoCutting(); }
  const Seams& seams() const { return seams_; }
  const Charts& charts() const { return *charts_; }
  const std::vector<ChartItem>& items() const { return items_; }
  /// Of a triangle of the scene; -1 when there are no charts.
  int chartAt(std::uint32_t triangle) const;
  ChartNumbers numbers() const;
  /// Overlaps and the like of imported coordinates, in words.
  const QStringList& problems() const { return problems_; }
  /// Triangles of those.
  const std::set<std::uint32_t>& problemTriangles() const { return problemTriangles_; }
  /// Why there is nothing to see, or why it could not be packed; empty when all is well.
  const QString& error() const { return error_; }
  /// The atlas, once all charts lie in it.
  const std::shared_ptr<const Atlas>& atlas() const { return atlas_; }
  /// The job that lays charts flat and packs them, or cuts automatically; 0: none.
  quint64 job() const { return autoJob_ ? autoJob_ : job_; }

  int selected() const;  ///< -1: none
  void select(int chart);
  ChartShade shade() const { return shade_; }
  void setShade(ChartShade shade);
  /// Colours of the scene's triangles under the shade; empty when there are no charts.
  std::vector<Rgb> colors() const;

  // ---- cutting ----
  bool cutting() const { return cutting_; }
  void setCutting(bool on);
  bool followCreases() const { return followCreases_; }
  void setFollowCreases(bool on);
  const CutPath* path() const { return path_ ? &*path_ : nullptr; }
  /// The vertex of the surface nearest to a hit.
  std::optional<std::uint32_t> vertexAt(const SurfaceHit& hit) const;
  /// The cut edge nearest to a point of a triangle's neighbourhood; none when none is near.
  std::optional<std::uint32_t> cutEdgeAt(const SurfaceHit& hit) const;
  bool onSeamOrBorder(std::uint32_t vertex) const;
  /// The way that a click would cut.
  std::vector<std::uint32_t> preview(std::uint32_t vertex);
  /// Begins a path, or cuts from its last place to there. Ends it where it meets a seam, a border or its own
  /// beginning.
  void click(std::uint32_t vertex);
  /// The next click begins anew.
  void endPath();
  /// Undoes the last leg of the path.
  void takeBack();
  /// Takes away the cut at an edge up to where it ends or forks, or the edge alone.
  void erase(std::uint32_t edge, bool alone);
  void removeAllCuts();
  /// Cuts as suggested: one chart, or all that are no disks.
  void applySuggestion(int chart);
  void applyAllSuggestions();
  void autoCut();
  void cancelJob();
  bool autoCutting() const { return autoJob_ != 0; }
  /// The meshes' own coordinates as charts, whether or not they are injective: problems() tells.
  void useImported();
  bool hasCoordinates() const;

  // ---- the atlas ----
  /// Whether charts can be moved, and corners: not those of imported coordinates.
  bool movable() const { return read_ && chartsRecipe_.mode != ChartsMode::Imported; }
  /// Of the atlas, as parts of its side: a texel, and the gutter.
  double texel() const { return 1.0 / atlasRecipe_.size; }
  double gutter() const { return atlasRecipe_.gutter * texel(); }
  /// Puts a chart somewhere. Between beginMove() and endMove() it is one step; all others stay where they
  /// are.
  void beginMove(const QString& name);
  void setPlacement(int chart, ChartPlacement placement);
  void endMove();
  void cancelMove();
  void setLocked(int chart, bool locked);
  void setWeight(int chart, double weight);
  /// Packs everything anew that is not locked.
  void packAll();
  /// Lays everything flat anew.
  void flattenAll();

  // ---- corners ----
  /// Lengths of the edges of a disk's boundary.
  std::vector<double> boundaryLengths(int chart) const;
  /// Corners of the polygon of a chart, indices into its boundary; empty: its boundary is free.
  std::vector<std::uint32_t> cornersOf(int chart) const;
  void setCorners(int chart, const std::vector<std::uint32_t>& corners, const QString& name);
  /// Spread by length; 0 = as all charts.
  void setCornerCount(int chart, int count);

  /// The scene's mesh with the atlas as texture coordinates, .obj, .gltf or .glb. Told in the dock when done
  /// or failed.
  void exportCoordinates(const QString& file);

 Q_SIGNALS:
  void changed();
  void selectionChanged();
  /// The cut tool, its path or what it follows.
  void cutChanged();
  void told(const QString& text, bool error);

 private:
  struct Mailbox;
  void follow();
  void readScene();
  void takeSurface(std::shared_ptr<const CutSurface> on);
  void readRecipe();
  void readImported();
  void findCharts();
  void makeItems();
  void place(std::size_t chart);
  void placeAll();
  void findOverlaps();
  void startWork();
  void work(std::shared_ptr<LiveChart> live = {}, std::size_t liveChart = 0);
  void followCorners();
  void stopWork();
  void editSeams(const QString& name, const Seams& seams);
  void editSettings(const QString& name, int chart, const std::function<void(ChartSettings&)>& change);
  std::vector<ChartSettings> allSettings() const;
  void writeSettings(const QString& name, const std::vector<ChartSettings>& settings);
  void takeMap(std::size_t chart, FlatMapPtr map);
  void takePacked(const PackedCharts& packed);
  void touch(bool surface);
  void paint();
  void forget();

  Session& session_;
  std::shared_ptr<Mailbox> mailbox_;  // how jobs find this object while it lives
  std::set<const QObject*> watchers_;
  std::shared_ptr<const Scene> scene_;  // that was read last
  std::shared_ptr<const CutSurface> on_;
  float creases_ = -1;  // of on_
  bool needsSurface_ = false;

  // What was read from the recipe last.
  std::vector<std::string> seamTexts_;
  ChartsRecipe chartsRecipe_;
  AtlasRecipe atlasRecipe_;
  std::vector<ChartSettings> settings_;
  bool read_ = false;

  Seams seams_;
  std::shared_ptr<const Charts> charts_ = std::make_shared<Charts>();
  std::vector<ChartItem> items_;
  std::vector<Hash128> shapes_, keys_;        // [charts] of the chart, and of its flat map
  std::map<Hash128, FlatMapPtr> maps_;        // final ones, by key
  std::map<Hash128, QString> failed_;         // why there is none, by key
  std::map<Hash128, ChartPlacement> packed_;  // where charts were packed last, by shape
  std::shared_ptr<const Atlas> atlas_;
  AtlasFacts facts_;
  QStringList problems_;
  std::set<std::uint32_t> problemTriangles_;
  QString error_;
  double seamLength_ = 0;
  bool overlapsStale_ = false;
  bool chartsStale_ = false;  // of seams_: they are on their way

  std::uint32_t selectedFace_ = kNowhere;
  ChartShade shade_ = ChartShade::Charts;
  bool cutting_ = false, followCreases_ = true;
  std::optional<CutPath> path_;
  quint64 run_ = 0;  // results of older runs are dropped
  quint64 job_ = 0, autoJob_ = 0;
  std::shared_ptr<LiveChart> live_;  // while a corner is dragged
  bool pending_ = false;             // work waits for the end of a gesture
  QTimer touched_, repaint_;
};

}  // namespace prt::ui
