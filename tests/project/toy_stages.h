#pragma once
// A small pipeline whose products are numbers and whose stages count how often they run.

#include "libprt/core/error.h"
#include "libprt/project/pipeline.h"

#include <nlohmann/json.hpp>

#include <map>
#include <string>

namespace prt::test {

struct Number : Product {
  explicit Number(double v) : value(v) {}
  double value;
  ProductData save() const override {
    return {nlohmann::json{{"value", value}}.dump(),
            {{"value", Array::from<double>(std::span(&value, 1), {1})}}};
  }
  static ProductPtr load(ProductData data) {
    return std::make_shared<Number>(data.array("value", DType::f64, 1).as<double>()[0]);
  }
};

/// mesh -> direct (progressive, in passes of 16 rays) -> bounces; mesh -> frames (not stored).
class ToyStages {
 public:
  ToyStages() {
    table = {
        stage("mesh", {}, {"objects[].mesh"}, [](StageRun&) { return 1.0; }),
        stage("frames", {"mesh"}, {"objects[].transform"}, [](StageRun& r) { return 10 + of(r, "mesh"); }),
        stage("direct", {"mesh"}, {"objects[].transform", "transfer.rays", "transfer.bands"},
              [this](StageRun& r) { return direct(r); }),
        stage("bounces", {"direct"}, {"objects[].material.albedo", "transfer.bounces"},
              [](StageRun& r) { return of(r, "direct") + r.recipe().transfer.bounces; })};
    table[1].stored = false;
    table[2].extends = {"transfer.rays"};
  }

  std::vector<Stage> table;
  std::map<std::string, int> runs;  ///< how often each stage ran, previews included
  int passes = 0;                   ///< of direct
  int cancelAtPass = -1;

 private:
  static double of(StageRun& run, const char* stage) { return run.input<Number>(stage)->value; }

  template <class F>
  Stage stage(const char* name, std::vector<std::string> inputs, std::vector<std::string> reads, F value) {
    Stage s{.name = name,
            .makes = "a number",
            .inputs = std::move(inputs),
            .reads = std::move(reads),
            .load = Number::load};
    s.make = [this, name, value](StageRun& run) -> ProductPtr {
      ++runs[name];
      return std::make_shared<Number>(value(run));
    };
    return s;
  }

  /// Sums 1/(pass number), handing out a preview and a checkpoint after every pass.
  double direct(StageRun& run) {
    const int wanted = run.recipe().transfer.rays / 16;
    double sum = 0;
    int done = 0;
    if (const auto saved = run.checkpoint()) {
      const auto values = saved->array("state", DType::f64, 1).as<double>();
      if (values[0] <= wanted) done = int(values[0]), sum = values[1];
    }
    while (done < wanted) {
      run.job().checkCancelled();
      if (passes == cancelAtPass) {
        run.job().cancel();
        run.job().checkCancelled();
      }
      ++passes;
      sum += 1.0 / ++done;
      if (run.checkpointDue())
        run.keepCheckpoint([&] {
          const double state[2] = {double(done), sum};
          return ProductData{"{}", {{"state", Array::from<double>(state, {2})}}};
        });
      if (done < wanted && run.wantsPreviews()) run.preview(std::make_shared<Number>(sum), done, wanted);
    }
    return sum;
  }
};

/// A store in memory.
class MemoryStore : public ProductStore {
 public:
  std::unique_ptr<Stored> find(const std::string& stage, const std::string& key) override {
    const auto found = products.find(stage + key);
    return found == products.end() ? nullptr : std::make_unique<Stored>(found->second);
  }
  void put(const std::string& stage, const std::string& key, const Stored& stored,
           const WriteCheck& check) override {
    if (check) check();
    products[stage + key] = stored;
  }
  std::unique_ptr<ProductData> findCheckpoint(const std::string& stage, const std::string& key) override {
    const auto found = checkpoints.find(stage + key);
    return found == checkpoints.end() ? nullptr : std::make_unique<ProductData>(found->second);
  }
  void putCheckpoint(const std::string& stage, const std::string& key, const ProductData& data,
                     const WriteCheck& check) override {
    if (check) check();
    checkpoints[stage + key] = data;
  }
  void dropCheckpoint(const std::string& stage, const std::string& key) override {
    checkpoints.erase(stage + key);
  }
  std::string sourceHash(const std::string& path) override { return sources[path]; }
  void putSourceHash(const std::string& path, const std::string& hash) override { sources[path] = hash; }

  std::map<std::string, Stored> products;
  std::map<std::string, ProductData> checkpoints;
  std::map<std::string, std::string> sources;
};

}  // namespace prt::test
