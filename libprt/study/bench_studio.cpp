// The studio's window against what the hand asks of it: runs prt-studio --bench, where the events and the
// frames are real ones. The library itself knows no window.

#include "libprt/core/error.h"
#include "libprt/study/bench_list.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

extern char** environ;

namespace prt {
namespace {

namespace fs = std::filesystem;

/// What must hold on two cores without a graphics card.
constexpr double kDiffuseFps = 30, kGlossyFps = 20;
constexpr double kSliderMs = 50, kGapMs = 50, kWorstGapMs = 150;
constexpr double kPreviewMs = 1000, kAnsweredMs = 100, kCancelledMs = 1000;
/// A rock of 40 962 vertices stands for the 35 000 of the scans that people try first.
constexpr const char* kScene =
    R"({"mesh": {"path": "builtin:rock", "detail": 2}, "material": {"albedo": [0.7, 0.5, 0.4]}})";

/// Beside this program, where an installation and a build put it; $PRT_STUDIO names another.
fs::path studioProgram() {
  if (const char* given = std::getenv("PRT_STUDIO")) return given;
  std::error_code none;
  const fs::path beside = fs::read_symlink("/proc/self/exe", none).parent_path() / "prt-studio";
  if (fs::exists(beside, none)) return beside;
  throw ResourceError("there is no prt-studio beside this program", "bench studio",
                      "build it, or name it in PRT_STUDIO");
}

/// A folder that goes with the scope.
class Folder {
 public:
  Folder() {
    std::string pattern = (fs::temp_directory_path() / "prt-bench-XXXXXX").string();
    if (!::mkdtemp(pattern.data()))
      throw ResourceError("no temporary folder", pattern, "free some disk space");
    path_ = pattern;
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// A program of its own whose output is read; killed when the scope ends before it does.
class Child {
 public:
  Child(const std::vector<std::string>& words, const std::vector<std::string>& settings) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw ResourceError("no pipe", words[0], "close other programs");
    read_ = ends[0];
    posix_spawn_file_actions_t actions;
    ::posix_spawn_file_actions_init(&actions);
    ::posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    std::vector<std::string> environment = settings;
    for (char** each = environ; *each; ++each) environment.emplace_back(*each);
    const int failed = ::posix_spawn(&pid_, words[0].c_str(), &actions, nullptr, pointers(words).data(),
                                     pointers(environment).data());
    ::posix_spawn_file_actions_destroy(&actions);
    ::close(ends[1]);
    if (failed) pid_ = -1;
  }
  ~Child() {
    ::close(read_);
    if (pid_ <= 0) return;
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// Everything it prints, until it ends.
  std::string output(Job& job) {
    std::string text;
    for (;;) {
      job.checkCancelled();
      pollfd waiting{read_, POLLIN, 0};
      if (::poll(&waiting, 1, 20) <= 0) continue;
      char buffer[4096];
      const ssize_t got = ::read(read_, buffer, sizeof buffer);
      if (got <= 0) return text;
      text.append(buffer, std::size_t(got));
    }
  }
  bool succeeded() {
    int status = 0;
    if (pid_ <= 0 || ::waitpid(std::exchange(pid_, -1), &status, 0) < 0) return false;
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

 private:
  static std::vector<char*> pointers(const std::vector<std::string>& words) {
    std::vector<char*> list;
    for (const std::string& word : words) list.push_back(const_cast<char*>(word.c_str()));
    list.push_back(nullptr);
    return list;
  }

  pid_t pid_ = -1;
  int read_ = -1;
};

nlohmann::json measureStudio(Job& job, int frames) {
  const Folder folder;
  const fs::path scene = folder.path() / "scene.json";
  std::ofstream(scene) << kScene;
  // Settings of its own; and without a display a window that nobody sees.
  std::vector<std::string> settings{"XDG_CONFIG_HOME=" + folder.path().string(),
                                    "XDG_DATA_HOME=" + folder.path().string(),
                                    "XDG_CACHE_HOME=" + folder.path().string()};
  if (!std::getenv("DISPLAY") && !std::getenv("WAYLAND_DISPLAY"))
    settings.emplace_back("QT_QPA_PLATFORM=offscreen");
  const fs::path program = studioProgram();
  Child child({program.string(), "--bench", "--frames", std::to_string(frames), scene.string()}, settings);
  const std::string output = child.output(job);
  if (!child.succeeded())
    throw ResourceError("the bench failed", program.string(), "run it by hand with --bench");
  return nlohmann::json::parse(output);
}

}  // namespace

BenchResult benchStudio(Job& job, int repetitions) {
  job.begin("bench studio", 1, "runs");
  job.checkCancelled();
  const nlohmann::json measured = measureStudio(job, repetitions);
  const auto number = [&](const char* part, const char* what) {
    return measured.at(part).at(what).get<double>();
  };

  struct Limit {
    const char *part, *what, *words, *unit;
    double limit;
    bool atLeast;
  };
  const Limit limits[] = {
      {"light_drag", "fps", "light drag, diffuse: frames a second", "1/s", kDiffuseFps, true},
      {"light_drag_glossy", "fps", "light drag, glossy 25x25: frames a second", "1/s", kGlossyFps, true},
      {"exponent_slide", "worst_ms", "exponent slider to new frame, the worst", "ms", kSliderMs, false},
      {"while_baking", "p99_ms", "gaps between frames while baking, 99th percentile", "ms", kGapMs, false},
      {"while_baking", "worst_ms", "worst gap between frames while baking", "ms", kWorstGapMs, false},
      {"bake_diffuse", "first_preview_ms", "diffuse bake to its first preview", "ms", kPreviewMs, false},
      {"bake_glossy", "first_preview_ms", "glossy bake to its first preview", "ms", kPreviewMs, false},
      {"bake_diffuse", "cancel_answered_ms", "diffuse bake: cancel answered", "ms", kAnsweredMs, false},
      {"bake_glossy", "cancel_answered_ms", "glossy bake: cancel answered", "ms", kAnsweredMs, false},
      {"bake_diffuse", "cancel_done_ms", "diffuse bake: cancel done", "ms", kCancelledMs, false},
      {"bake_glossy", "cancel_done_ms", "glossy bake: cancel done", "ms", kCancelledMs, false}};
  // The one that is nearest to its limit, or farthest beyond, counts.
  BenchResult result;
  for (const Limit& l : limits) {
    const double value = number(l.part, l.what), ratio = l.atLeast ? value / l.limit : l.limit / value;
    result.details[std::string(l.part) + "_" + l.what] = value;
    if (result.ratio > 0 && ratio >= result.ratio) continue;
    result.ratio = ratio;
    result.ours = {value, l.unit};
    result.againstWhat = l.words;
    result.against = {l.limit, l.unit};
  }
  result.details["orbit_fps"] = number("orbit", "fps");
  result.details["vertices"] = measured.at("vertices");
  result.details["open_to_first_preview_ms"] = measured.at("open_to_first_preview_ms");
  job.advance(1);
  return result;
}

}  // namespace prt
