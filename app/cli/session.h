#pragma once
// What every subcommand shares: the global options, the job that Ctrl-C cancels, and how results are told.

#include "libprt/core/error.h"
#include "libprt/core/job.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace prt::cli {

/// The command line itself is wrong: exit status 2.
class UsageError : public ValueError {
 public:
  using ValueError::ValueError;
};

class Session {
 public:
  bool json = false;
  bool quiet = false;
  int threads = 0;
  std::optional<std::uint64_t> seed;
  std::string logLevel = "warning";

  /// Shows a progress bar on a terminal, is cancelled by Ctrl-C.
  Job& job() { return *job_; }
  void start();

  /// A line for people; not with --quiet or --json.
  void say(const std::string& line) const;
  /// The result for programs; printed with --json only.
  void result(const nlohmann::json& object) const;

 private:
  std::unique_ptr<Job> job_;
};

/// For options: a finite number.
CLI::Validator finite();

/// A subcommand's work, once the command line is understood.
using Action = std::function<void(Session&)>;

// Each adds its subcommand; when it is chosen it sets `action`.
void addBake(CLI::App& app, Action& action);
void addRelight(CLI::App& app, Action& action);
void addReference(CLI::App& app, Action& action);
void addCompare(CLI::App& app, Action& action);
void addInfo(CLI::App& app, Action& action);
void addVerify(CLI::App& app, Action& action);
void addExport(CLI::App& app, Action& action);
void addLight(CLI::App& app, Action& action);
void addRtt(CLI::App& app, Action& action);
void addSynthesis(CLI::App& app, Action& action);
void addFigures(CLI::App& app, Action& action);
void addDemo(CLI::App& app, Action& action);
void addBench(CLI::App& app, Action& action);

}  // namespace prt::cli
