// prt: everything that the studio can compute, without a display.

#include "app/cli/interrupt.h"
#include "app/cli/session.h"
#include "libprt/project/recipe.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace prt::cli {
namespace {

constexpr int kDone = 0, kFailed = 1, kUsage = 2, kCancelled = 130;

/// In the order of their use; --help lists them so.
constexpr void (*kCommands[])(CLI::App&, Action&) = {
    addBake,  addRelight, addReference, addCompare, addInfo, addVerify, addExport,
    addLight, addRtt,     addSynthesis, addFigures, addDemo, addBench};

void addGlobalOptions(CLI::App& app, Session& session) {
  app.add_flag("--json", session.json, "Print the result as JSON on stdout")->group("Global options");
  app.add_option("--threads", session.threads, "Threads to use; 0 = all. Results do not depend on it")
      ->check(CLI::Range(0, 1024))
      ->group("Global options");
  app.add_option("--seed", session.seed, "Seed of everything random; the same seed gives the same bits")
      ->check(CLI::Range(std::uint64_t(0), std::uint64_t(1) << 53))
      ->group("Global options");
  app.add_flag("-q,--quiet", session.quiet, "No progress, no text; errors only")->group("Global options");
  app.add_option("--log-level", session.logLevel, "debug, info, warning, error or off")
      ->check(CLI::IsMember({"debug", "info", "warning", "error", "off"}))
      ->capture_default_str()
      ->group("Global options");
}

std::string chosenName(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  return chosen.empty() ? "prt" : "prt " + chosen.front()->get_name();
}

/// Option and subcommand names that may stand where an unknown word stood.
std::vector<std::string> knownWords(const CLI::App& app) {
  std::vector<std::string> words;
  const auto chosen = app.get_subcommands();
  for (const CLI::App* a : {&app, chosen.empty() ? &app : static_cast<const CLI::App*>(chosen.front())})
    for (const CLI::Option* option : a->get_options())
      for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  if (chosen.empty())
    for (const CLI::App* sub : app.get_subcommands({})) words.push_back(sub->get_name());
  return words;
}

void complain(const std::string& line) {
  std::string clean = line;
  std::replace(clean.begin(), clean.end(), '\n', ' ');
  fmt::print(stderr, "{}\n", clean);
}

int usageError(const CLI::App& app, const std::string& what) {
  std::string hint = chosenName(app) + " --help shows how";
  if (const auto word = what.rfind(": "); word != std::string::npos)
    if (const std::string nearest = nearestName(what.substr(word + 2), knownWords(app)); !nearest.empty())
      hint = "did you mean " + nearest + "? " + hint;
  complain(chosenName(app) + ": " + what + " (" + hint + ")");
  return kUsage;
}

/// The word that stands where a subcommand should, if it is none.
std::string unknownCommand(const CLI::App& app, int argc, char** argv) {
  if (!app.get_subcommands().empty()) return {};
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--threads" || word == "--seed" || word == "--log-level")
      ++i;
    else if (!word.starts_with("-"))
      return word;
  }
  return {};
}

/// Runs the chosen subcommand and turns exceptions into exit statuses.
int perform(const CLI::App& app, const Action& action, Session& session, Interrupt& interrupt) {
  const std::string name = chosenName(app);
  try {
    session.start();
    interrupt.watch(session.job());
    action(session);
    return kDone;
  } catch (const Cancelled&) {
    complain(name + ": cancelled; what was saved is unchanged");
    return kCancelled;
  } catch (const UsageError& error) {
    complain(name + ": " + error.what());
    return kUsage;
  } catch (const std::bad_alloc&) {
    complain(name + ": not enough memory (use fewer bands or a smaller mesh)");
  } catch (const std::exception& error) {
    complain(name + ": " + error.what());
  }
  return kFailed;
}

int run(int argc, char** argv) {
  Session session;
  Interrupt interrupt;
  Action action;
  CLI::App app{"Precomputed radiance transfer: bake, relight, compare.", "prt"};
  app.set_version_flag("--version", "prt " PRT_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(
      "Example:\n  prt bake bunny.obj -o bunny.prt && prt relight bunny.prt --env sky.hdr -o bunny.png");
  addGlobalOptions(app, session);
  for (const auto& add : kCommands) add(app, action);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == int(CLI::ExitCodes::Success)) return app.exit(error);
    const std::string word = unknownCommand(app, argc, argv);
    return usageError(app, word.empty() ? error.what() : "there is no such command: " + word);
  }
  return perform(app, action, session, interrupt);
}

}  // namespace
}  // namespace prt::cli

int main(int argc, char** argv) {
  return prt::cli::run(argc, argv);
}
