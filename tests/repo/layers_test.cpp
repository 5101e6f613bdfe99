// Tests of the repository: every #include keeps the line of dependencies (docs/architecture.md), every folder is
// one CMake target that says what it uses, every third-party package has one door, and no file or folder outgrows
// reading.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "tests/fixtures/places.h"

namespace {

namespace fs = std::filesystem;
const fs::path kRoot = seldinger::fixtures::source_dir();

// A layer, and the layers it may use beside itself. Its sub-folders (shelves) are held to the same row; which shelf
// uses which is what their CMakeLists.txt say.
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
    {"session",
     {"sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/gpu", "sim/imaging", "sim/haptics", "sim/devices",
      "sim/engine", "assessment", "casedb"}},
    {"reports", {"sim/base", "sim/volume", "sim/case", "assessment", "casedb"}},
    {"web", {"sim/base", "sim/volume", "sim/case", "assessment", "casedb", "reports"}},
    {"app",
     {"sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/gpu", "sim/imaging", "sim/haptics", "sim/devices",
      "sim/engine", "assessment", "casedb", "session", "reports", "web"}},
    // A program of its own: nobody but itself and the tests may include it.
    {"app/measure",
     {"shaders/shared", "sim/base", "sim/volume", "sim/case", "sim/tissue", "sim/gpu", "sim/imaging", "sim/haptics",
      "sim/devices", "sim/engine", "assessment", "casedb", "session", "reports", "app"}},
};

// Layers whose shelves do not include one another (docs/architecture.md): what two of them need lies in the layer.
const std::set<std::string> kApart = {"sim/imaging"};

// The namespace of a layer, where it is not called as its folder.
const std::map<std::string, std::string> kNamespace = {{"sim/case", "cases"}};

// A third-party header (by how its include begins) and the only places that may include it (file or folder
// prefixes).
const std::vector<std::pair<std::string, std::vector<std::string>>> kDoors = {
    {"itk", {"casedb/import/", "casedb/export/"}},
    {"gdcm", {"casedb/import/", "casedb/export/"}},
    {"zlib.h", {"casedb/import/"}},
    {"vtk", {"casedb/import/skin/surface"}},
    {"GL/", {"sim/gpu/"}},
    {"EGL/", {"sim/gpu/"}},
    {"GLFW/", {"app/window/surface/window.cpp"}},
    {"imgui", {"app/window/surface/", "app/window/screens/"}},
    {"backends/imgui", {"app/window/surface/window.cpp"}},
    {"sqlite3.h", {"casedb/database/sqlite"}},
    {"httplib.h", {"web/server"}},
    {"sodium.h", {"casedb/database/credentials"}},
    {"png.h", {"app/replay/png"}},
    {"zstd.h", {"sim/base/codec"}},
    {"seccomp.h", {"casedb/import/jail/confine.cpp"}},
    {"xraylib", {"tests/"}},
    {"Eigen/", {"sim/haptics/fit/least_squares.cpp", "assessment/statistics/growth/"}},
    {"boost/math", {"assessment/statistics/distributions.cpp"}},
    {"embree3/", {"app/measure/bench/bench_touch"}},
    {"AL/", {"app/window/sound/speaker.cpp"}},
    {"spnav.h", {"sim/devices/hands/space_mouse.cpp"}},
    {"boost/asio", {"sim/devices/arms/websocket.cpp"}},
    {"boost/beast", {"sim/devices/arms/websocket.cpp"}},
    {"boost/system", {"sim/devices/arms/websocket.cpp"}},
};

constexpr std::size_t kMostFilesOfAFolder = 30;

std::string text_of(const fs::path& file) {
  std::ifstream stream(kRoot / file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string folder_of(const std::string& file) {
  return fs::path(file).parent_path().string();
}

// The longest row of kMayUse that holds a path; empty: none does.
std::string layer_of(const std::string& path) {
  std::string best;
  for (const auto& [layer, uses] : kMayUse)
    if ((path + "/").rfind(layer + "/", 0) == 0 && layer.size() > best.size()) best = layer;
  return best;
}

// sim/imaging/xray/beam → xray; empty: the layer itself.
std::string shelf_of(const std::string& folder, const std::string& layer) {
  return folder == layer ? "" : fs::path(folder.substr(layer.size() + 1)).begin()->string();
}

std::vector<std::string> sources() {
  std::set<std::string> files;
  for (const auto& [layer, uses] : kMayUse)
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / layer)) {
      const std::string extension = entry.path().extension();
      if (entry.is_regular_file() && (extension == ".h" || extension == ".cpp"))
        files.insert(fs::relative(entry.path(), kRoot).string());
    }
  return {files.begin(), files.end()};
}

std::vector<std::string> includes_of(const std::string& file) {
  static const std::regex kInclude(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
  std::vector<std::string> includes;
  std::istringstream lines(text_of(file));
  std::smatch match;
  for (std::string line; std::getline(lines, line);)
    if (line.find("include") != std::string::npos && std::regex_search(line, match, kInclude))
      includes.push_back(match[1]);
  return includes;
}

// A folder of sources: its target, and the folders whose headers it says that it includes.
struct Shelf {
  std::string target;
  std::set<std::string> uses;
};

// casedb/import → casedb_import, sim/haptics/needle → haptics_needle
std::string target_of(std::string folder) {
  if (folder.rfind("sim/", 0) == 0) folder.erase(0, 4);
  std::replace(folder.begin(), folder.end(), '/', '_');
  return folder;
}

// What the CMakeLists.txt of every folder with sources say, by folder.
std::map<std::string, Shelf> shelves() {
  std::map<std::string, std::string> folder_by_target;
  std::set<std::string> folders;
  for (const std::string& file : sources()) {
    const std::string folder = folder_of(file);
    if (folder.rfind("shaders/", 0) == 0) continue;
    folders.insert(folder);
    folder_by_target[target_of(folder)] = folder;
  }
  static const std::regex kLayer(R"(seldinger_layer\(\s*(\w+)([^)]*)\))");
  std::map<std::string, Shelf> result;
  for (const std::string& folder : folders) {
    Shelf& shelf = result[folder];
    const std::string text = text_of(folder + "/CMakeLists.txt");
    std::smatch match;
    if (!std::regex_search(text, match, kLayer)) {
      if (fs::exists(kRoot / folder / "main.cpp")) result.erase(folder);  // a program, and no more
      continue;
    }
    shelf.target = match[1];
    std::istringstream words(match[2]);
    bool links = false;
    for (std::string word; words >> word;) {
      if (word == "LINKS" || word == "PRIVATE_LINKS")
        links = word == "LINKS";
      else if (links)
        shelf.uses.insert(folder_by_target.contains(word) ? folder_by_target[word] : word);
    }
  }
  return result;
}

// What is wrong with an include, or nothing.
std::string fault_of(const std::string& file, const std::string& include, const std::map<std::string, Shelf>& all) {
  const std::string folder = folder_of(file), other = folder_of(include);
  const std::string layer = layer_of(folder), other_layer = layer_of(other);
  if (include.find("./") != std::string::npos)  // "../" too
    return file + ": " + include + " is not written from the root";
  if (other_layer.empty() && !other.empty() && fs::exists(kRoot / include))
    return file + ": " + include + " is in no layer";  // tests, say
  if (other_layer.empty() || other == folder) return {};
  if (layer != other_layer && !kMayUse.at(layer).contains(other_layer))
    return file + ": " + layer + " may not use " + other_layer + " (" + include + ")";
  if (layer == other_layer && kApart.contains(layer)) {
    const std::string shelf = shelf_of(folder, layer), other_shelf = shelf_of(other, layer);
    if (shelf != other_shelf && !other_shelf.empty())
      return file + ": " + shelf + " may not use its sibling " + other_shelf + " (" + include + ")";
  }
  if (all.contains(folder) && all.contains(other) && !all.at(folder).uses.contains(other))
    return file + ": " + folder + "/CMakeLists.txt does not link " + target_of(other) + " (" + include + ")";
  return {};
}

// What is left of a graph after all that depends on nothing left has been taken away, again and again.
std::map<std::string, std::set<std::string>> circles_of(std::map<std::string, std::set<std::string>> graph) {
  for (bool removed = true; removed;) {
    removed = false;
    for (auto at = graph.begin(); at != graph.end();) {
      const bool free = std::none_of(at->second.begin(), at->second.end(),
                                     [&](const std::string& use) { return graph.contains(use); });
      removed = removed || free;
      at = free ? graph.erase(at) : std::next(at);
    }
  }
  return graph;
}

std::string names_in(const std::map<std::string, std::set<std::string>>& graph) {
  std::string names;
  for (const auto& [name, uses] : graph) names += " " + name;
  return names;
}

std::string namespace_of(const std::string& layer) {
  return kNamespace.contains(layer) ? kNamespace.at(layer) : fs::path(layer).filename().string();
}

TEST(Layers, EveryIncludeKeepsTheLine) {
  const auto all = shelves();
  const auto files = sources();
  ASSERT_GT(files.size(), 500U);
  for (const std::string& file : files)
    for (const std::string& include : includes_of(file)) EXPECT_EQ(fault_of(file, include, all), "");
}

TEST(Layers, APlantedIncludeIsFoundInEveryFolder) {
  // From each folder a header of each one that it neither is nor links: all are told.
  const auto all = shelves();
  ASSERT_GT(all.size(), 50U);
  for (const auto& [folder, shelf] : all) {
    std::size_t planted = 0;
    for (const auto& [other, unused] : all) {
      if (other == folder || shelf.uses.contains(other)) continue;
      EXPECT_NE(fault_of(folder + "/planted.h", other + "/planted.h", all), "") << folder << " " << other;
      ++planted;
    }
    EXPECT_GT(planted, 0U) << folder;
    for (const char* beside : {"tests/fixtures/places.h", "../base/hash.h", "./planted.h"})
      EXPECT_NE(fault_of(folder + "/planted.h", beside, all), "") << folder << " " << beside;
    EXPECT_EQ(fault_of(folder + "/planted.h", "glm/vec3.hpp", all), "");
  }
}

TEST(Layers, ASiblingIsNotIncludedEvenIfItIsLinked) {
  auto all = shelves();
  all["sim/imaging/room"].uses.insert("sim/imaging/ultrasound/view");
  EXPECT_NE(fault_of("sim/imaging/room/planted.h", "sim/imaging/ultrasound/view/view.h", all), "");
  all["sim/imaging"].uses.insert("sim/imaging/mpr");
  EXPECT_NE(fault_of("sim/imaging/planted.h", "sim/imaging/mpr/mpr.h", all), "");
  EXPECT_EQ(fault_of("sim/imaging/room/planted.h", "sim/imaging/probe.h", all), "");
  EXPECT_EQ(fault_of("sim/imaging/ultrasound/planted.h", "sim/imaging/ultrasound/view/view.h", all), "");
}

// Shaders of one folder do not include those of another; what they share is in shaders/shared.
TEST(Layers, AShaderIncludesItsOwnFolderAndWhatIsShared) {
  const std::set<std::string> kinds = {".glsl", ".comp", ".vert", ".frag"};
  std::size_t includes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(kRoot / "shaders")) {
    if (!entry.is_regular_file() || !kinds.contains(entry.path().extension())) continue;
    const std::string file = fs::relative(entry.path(), kRoot).string();
    for (const std::string& include : includes_of(file)) {
      const std::string from = "shaders/" + folder_of(include);
      EXPECT_TRUE(from == folder_of(file) || from == "shaders/shared") << file << " includes " << include;
      ++includes;
    }
  }
  EXPECT_GT(includes, 20U);
}

TEST(Layers, NeitherLayersNorFoldersNorFilesGoInACircle) {
  EXPECT_EQ(names_in(circles_of(kMayUse)), "");
  std::map<std::string, std::set<std::string>> folders, files;
  for (const auto& [folder, shelf] : shelves()) folders[folder] = shelf.uses;
  EXPECT_EQ(names_in(circles_of(folders)), "");
  for (const std::string& file : sources())
    for (const std::string& include : includes_of(file)) {
      files[file];
      if (!layer_of(folder_of(include)).empty()) files[file].insert(include);
    }
  EXPECT_EQ(names_in(circles_of(files)), "");
  // A circle is seen where there is one.
  files["sim/base/planted.h"] = {"sim/base/planted_too.h"};
  files["sim/base/planted_too.h"] = {"sim/base/planted.h"};
  EXPECT_NE(names_in(circles_of(files)), "");
}

TEST(Layers, AFolderIsATargetOfItsName) {
  const auto all = shelves();
  for (const auto& [folder, shelf] : all) {
    EXPECT_EQ(shelf.target, target_of(folder)) << folder << "/CMakeLists.txt";
    for (const std::string& use : shelf.uses)
      EXPECT_TRUE(all.contains(use)) << folder << " links " << use << ", which is no folder's target";
  }
}

TEST(Layers, AFoldersNamespaceIsItsLayers) {
  static const std::regex kOpens(R"(^namespace seldinger::([\w:]+) \{)");
  for (const std::string& file : sources()) {
    const std::string layer = layer_of(folder_of(file));
    if (layer == "shaders/shared") continue;
    std::set<std::string> may_open = {"embedded", namespace_of(layer)};  // of others: to declare what they hold
    for (const std::string& use : kMayUse.at(layer)) may_open.insert(namespace_of(use));
    bool opens_its_own = false, opens_one = false;
    std::istringstream lines(text_of(file));
    std::smatch match;
    for (std::string line; std::getline(lines, line);)
      if (line.rfind("namespace seldinger", 0) == 0 && std::regex_search(line, match, kOpens)) {
        const std::string opened = match[1].str().substr(0, match[1].str().find("::"));
        EXPECT_TRUE(may_open.contains(opened)) << file << " opens " << opened;
        opens_its_own = opens_its_own || opened == namespace_of(layer);
        opens_one = true;
      }
    EXPECT_TRUE(opens_its_own || !opens_one) << file << " is not in " << layer;
  }
}

TEST(Doors, EachThirdPartyPackageHasOne) {
  for (const std::string& file : sources())
    for (const std::string& include : includes_of(file)) {
      for (const auto& [header, doors] : kDoors) {
        if (include.rfind(header, 0) != 0) continue;
        const bool allowed = std::any_of(doors.begin(), doors.end(),
                                         [&](const std::string& door) { return file.rfind(door, 0) == 0; });
        EXPECT_TRUE(allowed) << file << " includes " << include << " beside its door";
      }
      if (include.rfind("nlohmann/", 0) == 0) {
        const std::string name = fs::path(file).filename();
        EXPECT_TRUE(name.ends_with("_json.cpp") || name.ends_with("_json.h") || file.rfind("web/", 0) == 0)
            << file << " uses JSON";
      }
    }
}

TEST(Files, AreShortAndNamedForWhatTheyHold) {
  const std::set<std::string> vague = {"util",    "utils", "common",  "helper",
                                       "helpers", "misc",  "manager", "context_"};
  for (const std::string& file : sources()) {
    const std::string text = text_of(file);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 600) << file;
    EXPECT_FALSE(vague.contains(fs::path(file).stem().string())) << file;
  }
}

TEST(Files, HeadersStartWithWhatTheyAreFor) {
  for (const std::string& file : sources()) {
    if (fs::path(file).extension() != ".h") continue;
    EXPECT_EQ(text_of(file).rfind("//", 0), 0U) << file;
  }
}

TEST(Files, NoFolderHoldsMoreThanOneCanTakeIn) {
  std::map<std::string, std::size_t> count;
  const std::set<std::string> counted = {".h", ".cpp", ".glsl", ".comp", ".vert", ".frag"};
  for (const char* top : {"sim", "assessment", "casedb", "session", "reports", "web", "app", "shaders"})
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / top))
      if (entry.is_regular_file() && counted.contains(entry.path().extension().string()))
        ++count[fs::relative(entry.path().parent_path(), kRoot).string()];
  for (const auto& [folder, files] : count) EXPECT_LE(files, kMostFilesOfAFolder) << folder;
}

// A file that a shell left behind was committed with the rest: `> shown` in place of a pipe.
TEST(Files, TheTopHoldsNoFileThatIsNotNamedHere) {
  const std::set<std::string> named = {
      ".clang-format",     ".clang-tidy",     ".git",    ".gitignore", "CHANGELOG.md", "CMakeLists.txt",
      "CMakePresets.json", "CONTRIBUTING.md", "LICENSE", "README.md",  "SECURITY.md",  "run"};
  for (const fs::directory_entry& one : fs::directory_iterator(kRoot))
    EXPECT_TRUE(!one.is_regular_file() || named.contains(one.path().filename().string())) << one.path();
}

}  // namespace
