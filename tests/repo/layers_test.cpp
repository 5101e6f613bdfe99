// Tests of the repository: every #include keeps the line of dependencies (docs/architecture.md), every third-party
// package its one door, and no file grows beyond reading.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fixtures/places.h"

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = seldinger::fixtures::source_dir();

// A folder, and the folders it may include from beside itself.
const std::map<std::string, std::set<std::string>> kMayUse = {
    {"shaders/shared", {}},
    {"sim/base", {}},
    {"sim/volume", {"sim/base"}},
    {"sim/case", {"sim/base", "sim/volume"}},
    {"sim/tissue", {"shaders/shared", "sim/base", "sim/volume", "sim/case"}},
    {"sim/gpu", {"sim/base"}},
    {"sim/imaging", {"shaders/shared", "sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/gpu"}},
    {"sim/haptics", {"shaders/shared", "sim/base", "sim/volume", "sim/case", "sim/tissue"}},
    {"sim/devices", {"sim/base", "sim/volume", "sim/case"}},
    {"sim/engine",
     {"shaders/shared", "sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/haptics", "sim/devices"}},
    {"assessment", {"sim/base", "sim/volume", "sim/case"}},
    {"casedb", {"sim/base", "sim/volume", "sim/case", "assessment"}},
    {"reports", {"sim/base", "sim/volume", "sim/case", "assessment", "casedb"}},
    {"web", {"sim/base", "sim/volume", "sim/case", "assessment", "casedb", "reports"}},
    {"app/device_simulation", {"sim/base", "sim/case", "sim/haptics", "sim/devices"}},
    {"app",
     {"app/device_simulation", "sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/gpu", "sim/imaging",
      "sim/haptics", "sim/devices", "sim/engine", "assessment", "casedb", "reports", "web"}},
    // Nobody outside app/measure and the tests may include it: it is a program of its own.
    {"app/measure/rigs",
     {"shaders/shared", "sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/haptics", "sim/devices",
      "sim/engine"}},
    {"app/measure/ultrasound_goals",
     {"shaders/shared", "sim/base", "sim/volume", "sim/case", "sim/gpu", "sim/imaging"}},
    {"app/measure/stability",
     {"app/measure", "app/measure/rigs", "app", "shaders/shared", "sim/base", "sim/volume", "sim/case",
      "sim/tissue", "sim/haptics"}},
    {"app/measure/goals",
     {"app/measure", "app/measure/rigs", "app/measure/stability", "app/measure/ultrasound_goals", "app", "sim/base",
      "sim/volume", "sim/case", "sim/tissue", "sim/imaging", "sim/haptics", "sim/engine"}},
    {"app/measure/bench",
     {"app/measure", "app/measure/rigs", "app/measure/goals", "app/measure/ultrasound_goals", "app",
      "shaders/shared", "sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/gpu", "sim/imaging", "sim/haptics",
      "sim/devices", "sim/engine", "assessment", "casedb", "reports"}},
    {"app/measure", {"app", "sim/base"}},
};

// A third-party header (by how its include begins) and the only places that may include it (file or folder
// prefixes).
const std::vector<std::pair<std::string, std::vector<std::string>>> kDoors = {
    {"itk", {"casedb/import/", "casedb/export/"}},
    {"gdcm", {"casedb/import/", "casedb/export/"}},
    {"zlib.h", {"casedb/import/"}},
    {"vtk", {"casedb/import/surface"}},
    {"GL/", {"sim/gpu/"}},
    {"EGL/", {"sim/gpu/"}},
    {"GLFW/", {"app/train/window.cpp"}},
    {"imgui", {"app/train/window.cpp", "app/train/panel_"}},
    {"backends/imgui", {"app/train/window.cpp"}},
    {"sqlite3.h", {"casedb/sqlite"}},
    {"httplib.h", {"web/server"}},
    {"sodium.h", {"casedb/credentials"}},
    {"png.h", {"app/png"}},
    {"zstd.h", {"sim/base/codec"}},
    {"xraylib", {"tests/"}},
    {"ceres/", {"sim/haptics/fit.cpp"}},
    {"glog/", {}},
    {"Eigen/", {}},
    {"embree3/", {"app/measure/bench/bench_touch"}},
    {"AL/", {"app/train/speaker.cpp"}},
    {"spnav.h", {"sim/devices/space_mouse.cpp"}},
    {"boost/asio", {"sim/devices/websocket.cpp"}},
    {"boost/beast", {"sim/devices/websocket.cpp"}},
    {"boost/system", {"sim/devices/websocket.cpp"}},
};

std::vector<fs::path> sources() {
  std::vector<fs::path> files;
  for (const auto& [folder, uses] : kMayUse) {
    if (!fs::exists(kRoot / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cpp"))
        files.push_back(fs::relative(entry.path(), kRoot));
    }
  }
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

std::string folder_of(const std::string& path) {
  std::string best;
  for (const auto& [folder, uses] : kMayUse)
    if (path.rfind(folder + "/", 0) == 0 && folder.size() > best.size()) best = folder;
  return best;
}

std::vector<std::string> includes_of(const fs::path& file) {
  std::vector<std::string> includes;
  std::ifstream stream(kRoot / file);
  for (std::string line; std::getline(stream, line);) {
    const std::size_t hash = line.find_first_not_of(" \t");
    if (hash == std::string::npos || line.compare(hash, 1, "#") != 0) continue;
    const std::size_t word = line.find("include", hash);
    if (word == std::string::npos) continue;
    const std::size_t open = line.find_first_of("<\"", word);
    if (open == std::string::npos) continue;
    const std::size_t close = line.find_first_of(">\"", open + 1);
    includes.push_back(line.substr(open + 1, close - open - 1));
  }
  return includes;
}

TEST(Layers, EveryIncludePointsToTheLeft) {
  const auto files = sources();
  ASSERT_GT(files.size(), 50U);
  for (const fs::path& file : files) {
    const std::string folder = folder_of(file.string());
    for (const std::string& include : includes_of(file)) {
      const std::string other = folder_of(include);
      if (other.empty() || other == folder) continue;
      EXPECT_TRUE(kMayUse.at(folder).contains(other)) << file << " may not include " << include;
    }
  }
}

TEST(Layers, TheLineHasNoCircle) {
  // Each folder's uses must all be removable before it: repeated removal of folders without uses empties the table.
  auto left = kMayUse;
  for (bool removed = true; removed && !left.empty();) {
    removed = false;
    for (auto at = left.begin(); at != left.end();) {
      const bool free =
          std::none_of(at->second.begin(), at->second.end(), [&](const auto& use) { return left.contains(use); });
      removed = removed || free;
      at = free ? left.erase(at) : std::next(at);
    }
  }
  EXPECT_TRUE(left.empty());
}

TEST(Doors, EachThirdPartyPackageHasOne) {
  for (const fs::path& file : sources())
    for (const std::string& include : includes_of(file)) {
      for (const auto& [header, doors] : kDoors) {
        if (include.rfind(header, 0) != 0) continue;
        const bool allowed = std::any_of(
            doors.begin(), doors.end(), [&](const std::string& door) { return file.string().rfind(door, 0) == 0; });
        EXPECT_TRUE(allowed) << file << " includes " << include << " beside its door";
      }
      if (include.rfind("nlohmann/", 0) == 0) {
        const std::string name = file.filename();
        EXPECT_TRUE(name.ends_with("_json.cpp") || name.ends_with("_json.h") || file.string().rfind("web/", 0) == 0)
            << file << " uses JSON";
      }
    }
}

TEST(Files, AreShortAndNamedForWhatTheyHold) {
  const std::set<std::string> vague = {"util",    "utils", "common",  "helper",
                                       "helpers", "misc",  "manager", "context_"};
  for (const fs::path& file : sources()) {
    std::ifstream stream(kRoot / file);
    const auto lines = std::count(std::istreambuf_iterator<char>(stream), {}, '\n');
    EXPECT_LE(lines, 600) << file;
    EXPECT_FALSE(vague.contains(file.stem().string())) << file;
  }
}

TEST(Files, HeadersStartWithWhatTheyAreFor) {
  for (const fs::path& file : sources()) {
    if (file.extension() != ".h") continue;
    std::ifstream stream(kRoot / file);
    std::string line;
    std::getline(stream, line);
    EXPECT_EQ(line.rfind("//", 0), 0U) << file;
  }
}

}  // namespace
