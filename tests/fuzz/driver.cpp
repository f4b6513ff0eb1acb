// Runs a harness on the cases kept in tests/data/fuzz, on its seeds, and on a fixed number of mutations.
//
//   fuzz_NAME [--runs N] [--seed N] [--write-seeds FOLDER] [FILE...]
//
// With files, only those are run. An input that crashes, throws something other than prt::Error, takes more
// than a minute or more memory than its size can justify is written to ./crash-NAME and the process ends.

#include "tests/fuzz/memory_limit.h"
#include "tests/fuzz/mutate.h"
#include "tests/fuzz/target.h"
#include "tests/support/paths.h"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <typeinfo>

namespace {

namespace fs = std::filesystem;
using prt::fuzz::target;

constexpr unsigned kSecondsPerInput = 60;

const std::string* current = nullptr;
char crashFile[256];

/// Async-signal-safe: keeps the input and dies as the signal would have it.
void keepInput(int signal) {
  if (current) {
    const int file = ::open(crashFile, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file >= 0 && ::write(file, current->data(), current->size()) >= 0) ::close(file);
    const char text[] = "the input was kept in ./crash-*\n";
    if (::write(2, text, sizeof text - 1) < 0) ::_exit(3);
  }
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}

void run(const std::string& input) {
  current = &input;
  ::alarm(kSecondsPerInput);
  prt::fuzz::limitMemory(target.memoryBase + target.memoryPerByte * input.size());
  try {
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
  } catch (const std::exception& error) {
    std::fprintf(stderr, "threw %s: %s\n", typeid(error).name(), error.what());
    std::abort();
  }
  prt::fuzz::limitMemory(~std::size_t{0});
  ::alarm(0);
  current = nullptr;
}

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> keptCases() {
  std::vector<fs::path> cases;
  const fs::path folder = prt::test::sourceFolder() / "tests/data/fuzz" / target.name;
  if (fs::is_directory(folder))
    for (const auto& entry : fs::directory_iterator(folder)) cases.push_back(entry.path());
  std::sort(cases.begin(), cases.end());
  return cases;
}

int writeSeeds(const fs::path& folder) {
  fs::create_directories(folder);
  const std::vector<std::string> seeds = target.seeds();
  for (std::size_t i = 0; i < seeds.size(); ++i)
    std::ofstream(folder / ("seed" + std::to_string(i)), std::ios::binary) << seeds[i];
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::snprintf(crashFile, sizeof crashFile, "crash-%s", target.name);
  for (int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) ::signal(signal, keepInput);
  std::size_t runs = target.runs * (std::getenv("PRT_FULL") ? 50 : 1);
  std::uint64_t seed = 1;
  std::vector<fs::path> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--runs" && i + 1 < argc)
      runs = std::strtoull(argv[++i], nullptr, 10);
    else if (argument == "--seed" && i + 1 < argc)
      seed = std::strtoull(argv[++i], nullptr, 10);
    else if (argument == "--write-seeds" && i + 1 < argc)
      return writeSeeds(argv[++i]);
    else
      files.emplace_back(argument);
  }
  if (!files.empty()) {
    for (const fs::path& file : files) run(contents(file));
    return 0;
  }
  const std::vector<fs::path> cases = keptCases();
  for (const fs::path& file : cases) run(contents(file));
  const std::vector<std::string> seeds = target.seeds();
  for (const std::string& input : seeds) run(input);
  prt::fuzz::Mutator mutator(seeds, target.words, seed);
  for (std::size_t i = 0; i < runs; ++i) run(mutator.next());
  std::printf("%s: %zu cases, %zu seeds, %zu mutations\n", target.name, cases.size(), seeds.size(), runs);
  return 0;
}
