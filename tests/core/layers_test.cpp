// Data flows one way through libprt: a file includes only from its own folder and those before it.

#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

namespace prt {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, int> kLayers{{"core", 0},      {"basis", 1}, {"light", 2},     {"material", 2},
                                         {"mesh", 3},      {"atlas", 4}, {"transport", 5}, {"meso", 6},
                                         {"synthesis", 7}, {"shade", 8}, {"project", 9},   {"study", 10},
                                         {"gl", 9}};

/// Each "file -> folder" edge that goes against the flow.
std::vector<std::string> wrongIncludes(const fs::path& libprt) {
  const std::regex include(R"re(^\s*#include "libprt/(\w+)/)re");
  std::vector<std::string> wrong;
  for (const auto& entry : fs::recursive_directory_iterator(libprt)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    const std::string own = fs::relative(entry.path(), libprt).begin()->string();
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string line; std::getline(file, line);) {
      if (!std::regex_search(line, match, include) || match[1] == own) continue;
      if (kLayers.at(match[1]) >= kLayers.at(own))
        wrong.push_back(entry.path().string() + " -> " + match[1].str());
    }
  }
  return wrong;
}

TEST(Layers, IncludesFollowTheFlow) {
  EXPECT_EQ(wrongIncludes(test::sourceFolder() / "libprt"), std::vector<std::string>{});
}

TEST(Layers, LibprtKnowsNothingOfQt) {
  const std::regex qt(R"re(^\s*#include <Q)re");
  for (const auto& entry : fs::recursive_directory_iterator(test::sourceFolder() / "libprt")) {
    if (!entry.is_regular_file()) continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);)
      EXPECT_FALSE(std::regex_search(line, qt)) << entry.path();
  }
}

}  // namespace
}  // namespace prt
