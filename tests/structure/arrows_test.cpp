#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

using Rooms = std::set<std::string>;

/// The rooms and whom each may include. The three formulations may include `arm` alone: that they
/// agree is evidence only while they share nothing else.
const std::map<std::string, Rooms>& allowed_arrows() {
  static const std::map<std::string, Rooms> arrows = [] {
    std::map<std::string, Rooms> map;
    map["arm"] = {};
    map["effects"] = {"arm"};
    map["exact_tf"] = {"arm"};
    map["fem"] = {"arm"};
    map["assumed_modes"] = {"arm"};
    map["measured"] = {"arm"};
    map["response"] = {"arm", "exact_tf", "fem", "assumed_modes"};
    map["experiment"] = {"arm", "measured", "response"};
    map["importing"] = {"arm", "measured", "experiment"};
    map["compare"] = {"arm", "effects", "exact_tf", "fem", "assumed_modes", "response", "measured"};
    map["diagnose"] = {"arm", "effects", "exact_tf", "response", "compare", "measured"};
    map["report"] = {"arm", "effects", "response", "experiment", "compare", "measured", "diagnose"};
    map["export"] = {"arm", "effects", "response", "compare", "measured", "diagnose"};
    map["app"] = {"arm",      "effects",    "exact_tf", "fem",      "assumed_modes", "measured",
                  "response", "experiment", "compare",  "diagnose", "report",        "export",
                  "importing"};
    map["python"] = map["app"];
    return map;
  }();
  return arrows;
}

struct Include {
  std::string file;
  std::string line;
  std::string from_room;
  std::string to_room;
};

/// The room in `#include "ROOM/FILE"`; empty for any other line.
std::string included_room(const std::string& line) {
  std::istringstream words(line);
  std::string directive;
  std::string target;
  words >> directive;
  if (directive == "#") {
    words >> target;
    directive += target;
  }
  words >> target;
  const auto slash = target.find('/');
  if (directive != "#include" || !target.starts_with('"') || slash == std::string::npos) return "";
  return target.substr(1, slash - 1);
}

std::vector<Include> includes_of(const fs::path& root, const std::string& room) {
  std::vector<Include> includes;
  for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
    const auto extension = entry.path().extension();
    if (extension != ".hpp" && extension != ".cpp" && extension != ".in") continue;
    std::ifstream file(entry.path());
    for (std::string line; std::getline(file, line);) {
      const std::string to_room = included_room(line);
      if (!to_room.empty()) includes.push_back({entry.path().string(), line, room, to_room});
    }
  }
  return includes;
}

bool is_allowed(const Include& include) {
  return include.from_room == include.to_room ||
         allowed_arrows().at(include.from_room).contains(include.to_room);
}

TEST(Structure, EveryIncludeFollowsAnAllowedArrow) {
  const fs::path root = FLEXARM_SOURCE_DIR;
  int seen = 0;
  for (const auto& [room, targets] : allowed_arrows()) {
    if (!fs::exists(root / room)) continue;
    for (const auto& include : includes_of(root, room)) {
      ++seen;
      EXPECT_TRUE(is_allowed(include))
          << include.file << ": " << include.line << " is not an arrow of the house";
    }
  }
  EXPECT_GT(seen, 10) << "the include pattern matches nothing";
}

TEST(Structure, IncludesAreReadHoweverTheyAreSpaced) {
  EXPECT_EQ(included_room("#include \"fem/mesh.hpp\""), "fem");
  EXPECT_EQ(included_room("  #  include \"exact_tf/exact_arm.hpp\"  // why"), "exact_tf");
  EXPECT_EQ(included_room("#include <Eigen/Core>"), "");
}

TEST(Structure, OneFormulationIncludingAnotherIsCaught) {
  for (const std::string from : {"fem", "assumed_modes", "exact_tf"}) {
    for (const std::string to : {"fem", "assumed_modes", "exact_tf", "response", "compare"}) {
      EXPECT_EQ(is_allowed({"", "", from, to}), from == to);
    }
  }
}

TEST(Structure, EverySourceFolderIsARoomOfTheHouse) {
  const Rooms not_rooms = {"tests",   "benchmarks", "docs",  "data",
                           "scripts", "cmake",      "build", "out"};
  for (const auto& entry : fs::directory_iterator(FLEXARM_SOURCE_DIR)) {
    const std::string name = entry.path().filename().string();
    if (!entry.is_directory() || name.starts_with(".") || not_rooms.contains(name)) continue;
    EXPECT_TRUE(allowed_arrows().contains(name)) << name << " is no room of the house";
  }
}

/// Boost's functions of distributions throw for NaN.
TEST(Structure, OneFileAsksDistributionsForProbabilities) {
  int asked = 0;
  for (const auto& [room, targets] : allowed_arrows()) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(FLEXARM_SOURCE_DIR) / room)) {
      const auto extension = entry.path().extension();
      if (extension != ".hpp" && extension != ".cpp") continue;
      const bool may_ask = entry.path().filename() == "tail_probability.cpp";
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        for (const char* asks : {"boost::math::cdf", "boost::math::pdf", "boost::math::erfc(",
                                 "boost::math::gamma_q(", "boost/math/statistics"}) {
          if (line.find(asks) == std::string::npos) continue;
          ++asked;
          EXPECT_TRUE(may_ask) << entry.path() << ": " << line
                               << ": use measured/spectra/tail_probability.hpp";
        }
      }
    }
  }
  EXPECT_GT(asked, 0) << "the pattern matches nothing";
}

TEST(Structure, FilesStayReadableInOneSitting) {
  constexpr int kMostLines = 450;
  for (const auto& [room, targets] : allowed_arrows()) {
    const fs::path folder = fs::path(FLEXARM_SOURCE_DIR) / room;
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.path().extension() != ".hpp" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      int lines = 0;
      for (std::string line; std::getline(file, line);) ++lines;
      EXPECT_LE(lines, kMostLines) << entry.path();
    }
  }
}

}  // namespace
