// README's examples on a clean copy: nothing but the repository's own files, as a stranger has them. And what the
// scenes that they draw show.
#include <gtest/gtest.h>

#include <cctype>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/fixtures/places.h"
#include "tests/fixtures/png_picture.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;
const std::string kProgram = seldinger::fixtures::program();
const fs::path kRoot = seldinger::fixtures::source_dir();

// With every run of white space as one space.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool space = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (!space || (!line.empty() && line.back() != ' ')) line += space ? ' ' : c;
  }
  if (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

// Commands of the program that name a file of docs/: in `…`, and the lines of ``` blocks.
std::vector<std::string> examples_in(const std::string& markdown) {
  std::vector<std::string> examples;
  const auto keep = [&](const std::string& text) {
    const std::string line = on_one_line(text);
    if (line.rfind("seldinger ", 0) == 0 && line.find(" docs/") != std::string::npos) examples.push_back(line);
  };
  for (std::size_t at = markdown.find('`'); at != std::string::npos; at = markdown.find('`', at)) {
    const std::string fence = markdown.compare(at, 3, "```") == 0 ? "```" : "`";
    const std::size_t from = at + fence.size(), to = markdown.find(fence, from);
    if (to == std::string::npos) break;
    const std::string inside = markdown.substr(from, to - from);
    for (std::size_t begin = 0; begin < inside.size();) {
      const std::size_t end = fence == "`" ? inside.size() : std::min(inside.find('\n', begin), inside.size());
      keep(inside.substr(begin, end - begin));
      begin = end + 1;
    }
    at = to + fence.size();
  }
  return examples;
}

// A copy of what the examples may name, from which nothing outside the repository can be reached by a relative
// path.
fs::path clean_copy(const std::string& name) {
  const fs::path copy = fixtures::fresh_folder(name) / "a" / "b" / "c" / "d" / "seldinger";
  fs::create_directories(copy / "docs");
  fs::copy(kRoot / "docs" / "scenes", copy / "docs" / "scenes", fs::copy_options::recursive);
  return copy;
}

TEST(ReadmeExamples, AreFoundInTheirText) {
  EXPECT_EQ(
      examples_in("a `seldinger sheet\ndocs/a.json --out b.html` `seldinger help` `x docs/`\n```\nseldinger render "
                  "docs/b.json\n./run\n```\n"),
      (std::vector<std::string>{"seldinger sheet docs/a.json --out b.html", "seldinger render docs/b.json"}));
}

TEST(ReadmeExamples, RunOnACleanCopy) {
  const std::vector<std::string> examples = examples_in(fixtures::whole_file(kRoot / "README.md"));
  EXPECT_GE(examples.size(), 4U);
  const fs::path copy = clean_copy("readme_examples");
  for (const std::string& example : examples) {
    SCOPED_TRACE(example);
    const auto ran = fixtures::run("cd '" + copy.string() + "' && HOME='" + copy.string() + "' '" + kProgram + "'" +
                                       example.substr(std::string("seldinger").size()),
                                   copy.parent_path());
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const std::size_t named = example.find("--out ");
    ASSERT_NE(named, std::string::npos);
    const fs::path out = copy / example.substr(named + 6, example.find(' ', named + 6) - named - 6);
    ASSERT_TRUE(fs::exists(out));
    if (out.extension() == ".png") {
      EXPECT_GT(fixtures::read_png(out).width_px, 0);
      continue;
    }
    // As many pictures on the page as the program says.
    const std::string page = fixtures::whole_file(out);
    int pictures = 0;
    for (std::size_t at = page.find("data:image/png"); at != std::string::npos;
         at = page.find("data:image/png", at + 1))
      ++pictures;
    EXPECT_GT(pictures, 0);
    EXPECT_EQ(ran.out.rfind(std::to_string(pictures) + " pictures", 0), 0U) << ran.out;
  }
}

class Scenes : public testing::Test {
 protected:
  // Draws a scene; `file` is its PNG.
  Json render(const Json& scene, const std::string& file) {
    std::ofstream(folder_ / "scene.json") << scene;
    const auto ran = fixtures::run(kProgram + " render '" + (folder_ / "scene.json").string() + "' --out '" +
                                       (folder_ / file).string() + "' --json",
                                   folder_);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return ran.exit_code == 0 ? Json::parse(ran.out) : Json();
  }
  static Json read(const std::string& name) {
    return Json::parse(fixtures::whole_file(kRoot / "docs" / "scenes" / name));
  }
  double mean_grey(const fixtures::RgbPicture& picture, int left, int right, int top, int bottom) const {
    double sum = 0.0;
    for (int row = top; row < bottom; ++row)
      for (int column = left; column < right; ++column) sum += *picture.at(column, row);
    return sum / ((right - left) * (bottom - top));
  }
  const fs::path folder_ = fixtures::fresh_folder("documented_scenes");
};

TEST_F(Scenes, EveryOneHereIsOfABuiltInPatientAndIsDrawn) {
  int scenes = 0;
  for (const auto& entry : fs::directory_iterator(kRoot / "docs" / "scenes")) {
    const std::string name = entry.path().filename().string();
    if (entry.path().extension() != ".json" || name.find(".sheet.") != std::string::npos) continue;
    SCOPED_TRACE(name);
    const Json scene = read(name);
    EXPECT_TRUE(scene.at("volume").contains("built_in"));
    render(scene, name + ".png");
    const fixtures::RgbPicture picture = fixtures::read_png(folder_ / (name + ".png"));
    int dark = 0, bright = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) (picture.rgb[i] < 64 ? dark : bright) += 1;
    EXPECT_GT(bright, static_cast<int>(picture.rgb.size() / 3 / 20));
    EXPECT_GT(dark, static_cast<int>(picture.rgb.size() / 3 / 200));
    ++scenes;
  }
  EXPECT_GE(scenes, 6);
}

// Vertebral bodies absorb, discs less, the flank least; ribs cross the shadow of the lung's base.
TEST_F(Scenes, TheRadiographShowsSpineAndRibs) {
  render(read("xray_ap.json"), "ap.png");
  const fixtures::RgbPicture picture = fixtures::read_png(folder_ / "ap.png");
  ASSERT_EQ(picture.width_px, 512);
  const double flank = mean_grey(picture, 430, 480, 320, 420), spine = mean_grey(picture, 226, 290, 320, 420);
  EXPECT_LT(spine + 60.0, flank);
  // Down a line through the lateral part of the diaphragm's dome, a rib is a dip and the gap after it a rise.
  int turns = 0;
  double low = 255.0, high = 0.0;
  bool falling = true;
  for (int row = 120; row < 250; ++row) {
    const double here = mean_grey(picture, 60, 66, row, row + 3);
    if (falling) {
      low = std::min(low, here);
      if (here > low + 8.0) falling = false, high = here, ++turns;
    } else {
      high = std::max(high, here);
      if (here < high - 8.0) falling = true, low = here, ++turns;
    }
  }
  EXPECT_GE(turns, 4);
}

// Where a sheet says that a needle lies in the picture, its tip is seen; beside the plane it is not.
TEST_F(Scenes, NeedlesAreWhereTheSheetsSay) {
  int rows = 0;
  for (const char* name : {"us_breath.sheet.json", "us_jiggle.sheet.json"}) {
    const Json sheet = read(name);
    for (const Json& row : sheet.at("rows")) {
      SCOPED_TRACE(row.at("name"));
      Json scene = read(row.at("scene"));
      scene.merge_patch(row.at("set"));
      const bool beside = row.at("name").get<std::string>().find("beside") != std::string::npos;
      EXPECT_EQ(render(scene, "needle.png").at("visible").at("needle_tip"), !beside);
      ++rows;
    }
  }
  EXPECT_EQ(rows, 6);
}

}  // namespace
}  // namespace seldinger
