#pragma once
// Keeps the products in step with the recipe: starts bakes by itself when an edit made them stale, hands
// previews on as they arrive, and knows which product is fresh. One bake at a time; a newer recipe
// replaces the older one's bake.

#include "ui/model/baker.h"
#include "ui/model/job_runner.h"

#include <QElapsedTimer>
#include <QObject>
#include <QStringList>

#include <filesystem>
#include <map>
#include <memory>

namespace prt::ui {

enum class ProductStatus { Missing, Baking, Preview, Fresh, Stale, Failed };

/// One line of the transfer dock: a stage and the state of its product.
struct StageInfo {
  QString name;
  QString makes;
  bool stored = true;  ///< kept in projects; others are quickly made and of little interest
  bool wanted = true;  ///< the recipe asks for it; others are not made and count as fresh
  ProductStatus status = ProductStatus::Missing;
  int level = 0, levels = 0;  ///< of a preview
};

class BakeController : public QObject {
  Q_OBJECT
 public:
  explicit BakeController(JobRunner& runner, QObject* parent = nullptr);
  ~BakeController() override;

  /// What bakes from now on: another project whose paths start from `folder`. Cancels what runs; the next
  /// setRecipe() begins anew.
  void setBaker(std::shared_ptr<Baker> baker, const std::filesystem::path& folder = "/");
  /// The same products under other paths: the project moved to another folder. What runs goes on.
  void moveTo(const std::filesystem::path& folder, const Recipe& recipe);
  const std::shared_ptr<Baker>& baker() const { return baker_; }
  /// The recipe whose products are wanted from now on. Begins a bake when that changes a product (or
  /// only marks products stale when automatic baking is off).
  void setRecipe(const Recipe& recipe);
  /// Bakes what is not fresh, whether or not it was cancelled before.
  void bake();
  void cancel();
  /// What one button does: cancels while it bakes, bakes else.
  void bakeOrCancel() { baking() ? cancel() : bake(); }

  bool automatic() const { return automatic_; }
  void setAutomatic(bool automatic);

  bool baking() const { return job_ != 0; }
  quint64 job() const { return job_; }
  /// Seconds that bakes took since setBaker().
  double bakedSeconds() const;
  const std::vector<StageInfo>& stageInfos() const { return infos_; }
  /// Everything fresh?
  bool fresh() const;
  /// The state that matters most among these stages: failed, baking, stale, missing, fresh.
  ProductStatus worstStatus(const QStringList& stages) const;
  /// The last final product of each stage.
  const std::map<std::string, ProductState>& finalProducts() const { return final_; }
  /// The message of the last bake, when it failed.
  const QString& error() const { return error_; }

 Q_SIGNALS:
  /// A product arrived: final, or a preview on the way there. Delivered in the order they were made.
  void productArrived(const QString& stage, const prt::ProductState& state);
  /// What stageInfos(), baking() or error() say has changed.
  void changed();
  void failed(const QString& message);

 private:
  class Listener;
  struct Mailbox;

  void start();
  void goOn(quint64 job);
  void stopClock();
  void begun(quint64 bake, const QString& stage);
  void arrived(quint64 bake, const QString& stage, const ProductState& state);
  void ended(quint64 bake, const JobInfo& job);
  void refreshStale();
  StageInfo* infoOf(const QString& stage);

  JobRunner& runner_;
  std::shared_ptr<Mailbox> mailbox_;  // how the job's thread finds this object, while it lives
  std::shared_ptr<Baker> baker_;
  std::filesystem::path folder_ = "/";
  Recipe recipe_;
  QElapsedTimer clock_;  // valid while it bakes
  double seconds_ = 0;
  // By stage, what it and its inputs read from the recipe: as wanted now; of the final product.
  std::map<std::string, std::string> wanted_, made_;
  std::map<std::string, ProductState> final_;
  quint64 bake_ = 0;  // number of the current bake: results of older ones are dropped
  quint64 job_ = 0;
  quint64 failedJob_ = 0;
  bool automatic_ = true;
  std::vector<StageInfo> infos_;
  QString error_;
};

}  // namespace prt::ui

Q_DECLARE_METATYPE(prt::ProductState)
