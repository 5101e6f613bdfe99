// render of the room as a user calls it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

using fixtures::kProgram;

// A ball of water of 60 mm, the middle at the origin.
Json ball_scene() {
  return {{"volume",
           {{"analytic",
             {{"size_voxels", {50, 50, 50}},
              {"spacing_mm", {3, 3, 3}},
              {"origin_mm", {-73.5, -73.5, -73.5}},
              {"shapes", {{{"kind", "sphere"}, {"center_mm", {0, 0, 0}}, {"radius_mm", 60}, {"hu", 0}}}}}}}},
          {"needle", {{"tip_mm", {0, -60, 0}}, {"direction", {0, 1, 0}}, {"gauge", 18}}},
          {"view", {{"kind", "room"}, {"from", "top"}, {"size_px", {120, 90}}}}};
}

struct Rendered {
  fixtures::Ran ran;
  std::string file;
};

Rendered render(const Json& scene, const std::string& out = "p.png", const std::string& options = "") {
  static int count = 0;
  const auto scratch = fixtures::fresh_folder("render_room_" + std::to_string(count++));
  std::ofstream(scratch / "scene.json") << scene;
  Rendered rendered;
  rendered.ran = run(kProgram + " render " + (scratch / "scene.json").string() + " --out " +
                         (scratch / out).string() + " --json " + options,
                     scratch);
  rendered.file = fixtures::whole_file(scratch / out);
  return rendered;
}

TEST(RenderRoom, WritesAPictureAndTellsWhatDrewIt) {
  const Rendered one = render(ball_scene());
  ASSERT_EQ(one.ran.exit_code, 0) << one.ran.err;
  const Json told = Json::parse(one.ran.out);
  EXPECT_EQ(told.at("size_px"), Json({120, 90}));
  EXPECT_GT(told.at("triangles").get<int>(), 1000);
  EXPECT_FALSE(told.at("renderer").get<std::string>().empty());
  ASSERT_GT(one.file.size(), 1000U);
  EXPECT_EQ(one.file.substr(1, 3), "PNG");
  EXPECT_EQ(render(ball_scene()).file, one.file);
}

TEST(RenderRoom, EveryFieldChangesThePicture) {
  const std::string before = render(ball_scene()).file;
  const Json probe = {
      {"name", "L11-5v"}, {"origin_mm", {30, -52, 0}}, {"axial", {0, 1, 0}}, {"lateral", {1, 0, 0}}};
  Json pressed = probe;
  pressed["press_mm"] = 8;
  const std::vector<std::pair<std::string, Json>> fields = {
      {"from", "operator_side"}, {"orbit_right_deg", 30}, {"zoom", 1.5}, {"stereo", true}, {"mentor", true},
      {"position", "prone"},     {"quality", "fine"},     {"help", 2},   {"probe", probe}, {"probe", pressed},
      {"arm", {{"lao_deg", 30}}}};
  std::vector<std::string> seen = {before};
  for (const auto& [name, value] : fields) {
    Json scene = ball_scene();
    scene["view"]["quality"] = "fast";
    scene["view"][name] = value;
    const Rendered one = render(scene);
    ASSERT_EQ(one.ran.exit_code, 0) << name << one.ran.err;
    EXPECT_EQ(one.ran.err.find("not used"), std::string::npos) << name;
    for (const std::string& other : seen) EXPECT_NE(one.file, other) << name;
    seen.push_back(one.file);
  }
}

TEST(RenderRoom, RefusesWhatItCannotShow) {
  EXPECT_EQ(render(ball_scene(), "p.mha").ran.exit_code, 2);
  EXPECT_EQ(render(ball_scene(), "p.png", "--backend cpu").ran.exit_code, 2);
  Json scene = ball_scene();
  scene["view"]["from"] = "behind";
  scene["view"]["help"] = 4;
  const Rendered bad = render(scene);
  EXPECT_EQ(bad.ran.exit_code, 3);
  EXPECT_NE(bad.ran.err.find("view.from"), std::string::npos);
  EXPECT_NE(bad.ran.err.find("view.help"), std::string::npos);
  EXPECT_TRUE(bad.file.empty());
  scene = ball_scene();
  scene["view"]["probe"] = {{"origin_mm", {0, 0, 0}}, {"axial", {0, 1, 0}}, {"lateral", {1, 0, 0}}};
  scene["view"]["arm"] = Json::object();
  EXPECT_EQ(render(scene).ran.exit_code, 3);
}

// The pictures of docs/scenes/real, of real patients.
TEST(RenderRoom, DocumentedScenes) {
  SELDINGER_NEEDS_SHARED_DATA();
  const std::filesystem::path folder = fixtures::source_dir() / "docs" / "scenes" / "real";
  for (const std::string name : {"room_abdomen.json", "room_c_arm.json"}) {
    std::ifstream stream(folder / name);
    Json scene = Json::parse(stream);
    scene["volume"] = (folder / scene.at("volume").get<std::string>()).lexically_normal().string();
    const Rendered one = render(scene);
    ASSERT_EQ(one.ran.exit_code, 0) << one.ran.err;
    EXPECT_GT(one.file.size(), 50'000U) << name;
  }
}

}  // namespace
}  // namespace seldinger
