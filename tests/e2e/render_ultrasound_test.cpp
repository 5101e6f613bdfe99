// render of ultrasound views as a user calls it: attenuation through files, same bits again, what is refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

using fixtures::kProgram;
constexpr int kBeams = 128, kSamples = 1024;
constexpr double kDepthMm = 100.0;

// A ball of tissue; the probe's middle touches its top.
Json ball() {
  return {{"volume",
           {{"analytic",
             {{"size_voxels", {110, 110, 110}},
              {"spacing_mm", {2, 2, 2}},
              {"origin_mm", {-109, -109, -109}},
              {"shapes",
               {{{"kind", "sphere"},
                 {"center_mm", {0, 0, 0}},
                 {"radius_mm", 100},
                 {"hu", 60},
                 {"class", "liver"}}}}}}}},
          {"view",
           {{"kind", "ultrasound"},
            {"probe", "L11-5v"},
            {"origin_mm", {0, -98, 0}},
            {"axial", {0, 1, 0}},
            {"lateral", {1, 0, 0}},
            {"depth_mm", kDepthMm},
            {"attenuation_db_cm_mhz", 0.5},
            {"output", "polar_db"}}}};
}

fixtures::Ran render(const Json& scene, const std::filesystem::path& scratch, const char* file,
                     const std::string& options = "") {
  std::ofstream(scratch / "scene.json") << scene;
  return run(kProgram + " render " + (scratch / "scene.json").string() + " --out " + (scratch / file).string() +
                 " --json" + options,
             scratch);
}

TEST(RenderUltrasound, SpeckleFallsByTheAttenuationAndIsTheSameAgain) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound");
  ASSERT_EQ(render(ball(), scratch, "a.mha").exit_code, 0);
  ASSERT_EQ(render(ball(), scratch, "b.mha").exit_code, 0);
  const std::string file = fixtures::whole_file(scratch / "a.mha");
  EXPECT_EQ(file, fixtures::whole_file(scratch / "b.mha"));
  std::vector<float> db(kBeams * kSamples);
  ASSERT_GT(file.size(), db.size() * 4);
  std::memcpy(db.data(), file.data() + file.size() - db.size() * 4, db.size() * 4);
  // Mean power of the middle beams, in contact, over 10 mm of depth.
  const auto level_db = [&](double depth_mm) {
    double power = 0.0;
    int count = 0;
    for (int row = 0; row < kSamples; ++row) {
      if (std::abs((row + 0.5) * kDepthMm / kSamples - depth_mm) > 5.0) continue;
      for (int beam = 48; beam < 80; ++beam, ++count)
        power += std::pow(10.0, 0.1 * static_cast<double>(db[static_cast<std::size_t>(row * kBeams + beam)]));
    }
    return 10.0 * std::log10(power / count);
  };
  // Two ways, 7.6 MHz: 7.6 dB a centimetre.
  EXPECT_NEAR(level_db(20.0) - level_db(50.0), 2.0 * 0.5 * 7.6 * 3.0, 1.0);
}

TEST(RenderUltrasound, DisplayIsAPictureByEachMethod) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_display");
  Json scene = ball();
  scene["view"]["output"] = "display";
  const auto ran = render(scene, scratch, "p.png");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(Json::parse(ran.out).at("size_px"), Json({800, 700}));
  EXPECT_EQ(fixtures::whole_file(scratch / "p.png").substr(1, 3), "PNG");
  std::vector<std::string> pictures{fixtures::whole_file(scratch / "p.png")};
  for (const char* method : {"lattice", "thesis"}) {
    scene["view"]["method"] = method;
    ASSERT_EQ(render(scene, scratch, "m.png").exit_code, 0) << method;
    pictures.push_back(fixtures::whole_file(scratch / "m.png"));
  }
  EXPECT_NE(pictures[0], pictures[1]);
  EXPECT_NE(pictures[1], pictures[2]);
  scene = ball();
  scene["view"]["depth_mm"] = -1;
  EXPECT_EQ(render(scene, scratch, "q.png").err.rfind("error: bad_scene: ", 0), 0U);
  EXPECT_FALSE(std::filesystem::exists(scratch / "q.png"));
}

// One grey, on all but a thousandth of the pixels (what every backend promises).
TEST(RenderUltrasound, TheGpuShowsWhatTheCpuShows) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_gpu");
  Json scene = ball();
  scene["view"]["output"] = "display";
  std::vector<std::vector<float>> grey;
  for (const std::string backend : {"cpu", "gpu"}) {
    const std::string file = backend + ".mha";
    const auto ran = render(scene, scratch, file.c_str(), " --backend " + backend);
    ASSERT_EQ(ran.exit_code, 0) << ran.err;
    EXPECT_EQ(Json::parse(ran.out).at("backend"), backend);
    const std::string bytes = fixtures::whole_file(scratch / file);
    grey.emplace_back(800 * 700);
    ASSERT_GT(bytes.size(), grey.back().size() * 4);
    std::memcpy(grey.back().data(), bytes.data() + bytes.size() - grey.back().size() * 4, grey.back().size() * 4);
  }
  int lit = 0, apart = 0;
  for (std::size_t i = 0; i < grey[0].size(); ++i) {
    lit += grey[0][i] > 0.0F;
    apart += !(std::abs(grey[0][i] - grey[1][i]) <= 1.0F);
  }
  EXPECT_GT(lit, 50000);
  EXPECT_LE(apart, lit / 1000);
}

// No GL: asked for it fails loudly, otherwise the CPU takes over. Never an image from nowhere.
TEST(RenderUltrasound, WithoutGlTheGpuFailsAndTheCpuServes) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_no_gl");
  std::ofstream(scratch / "scene.json") << ball();
  const std::string command = "__EGL_VENDOR_LIBRARY_DIRS=/nowhere " + kProgram + " render " +
                              (scratch / "scene.json").string() + " --out " + (scratch / "p.mha").string();
  const auto asked = run(command + " --backend gpu", scratch);
  EXPECT_EQ(asked.exit_code, 4) << asked.err;
  EXPECT_EQ(asked.err.rfind("error: gl: ", 0), 0U) << asked.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "p.mha"));
  EXPECT_EQ(run(command, scratch).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(scratch / "p.mha"));
}

TEST(RenderUltrasound, TheEnvelopeLiesInItsPlace) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_envelope");
  Json scene = ball();
  scene["view"]["output"] = "envelope_db";
  scene["view"]["size_px"] = {60, 40};
  scene["view"]["pixel_mm"] = 0.5;
  const auto ran = render(scene, scratch, "e.mha");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json told = Json::parse(ran.out);
  EXPECT_EQ(told.at("unit"), "dB");
  const std::string file = fixtures::whole_file(scratch / "e.mha");
  EXPECT_NE(file.find("DimSize = 60 40 1"), std::string::npos);
  EXPECT_NE(file.find("ElementSpacing = 0.5 0.5"), std::string::npos);
}

TEST(RenderUltrasound, ProbesOfTheScenesOwnAndPresets) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_probe");
  Json scene = ball();
  const auto png = [&](const Json& probe) {
    scene["view"]["probe"] = probe;
    const auto ran = render(scene, scratch, "p.png");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return fixtures::whole_file(scratch / "p.png");
  };
  const Json linear = {{"frequency_mhz", 7.6},       {"elements", 128},    {"pitch_mm", 0.3}, {"height_mm", 5.0},
                       {"elevation_focus_mm", 18.0}, {"aperture_mm", 19.2}};
  EXPECT_EQ(png(linear), png("L11-5v"));
  EXPECT_NE(png("thesis-linear"), png("L11-5v"));
  scene["view"]["probe"] = {{"radius_mm", 10.0}};
  EXPECT_NE(render(scene, scratch, "q.png").err.find("view.probe.radius_mm"), std::string::npos);
  scene["view"]["probe"] = "unknown";
  EXPECT_NE(render(scene, scratch, "q.png").err.find("view.probe"), std::string::npos);
  scene = ball();
  scene["view"]["preset"] = "vessel";
  EXPECT_EQ(render(scene, scratch, "v.png").exit_code, 0);
  scene["view"]["preset"] = "brain";
  EXPECT_EQ(render(scene, scratch, "q.png").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(scratch / "q.png"));
}

TEST(RenderUltrasound, OfAPatientWhoMoves) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_motion");
  Json scene = ball();
  const auto png = [&](const Json& motion) {
    scene["motion"] = motion;
    const auto ran = render(scene, scratch, "m.png");
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return fixtures::whole_file(scratch / "m.png");
  };
  const auto still = png({{"breath_level", 0.0}});
  scene.erase("motion");
  EXPECT_EQ(render(scene, scratch, "s.png").exit_code, 0);
  EXPECT_EQ(fixtures::whole_file(scratch / "s.png"), still);
  EXPECT_NE(png({{"press_mm", 6.0}}), still);
  scene["motion"] = {{"drag_mm", 1.0}};  // without a needle
  scene.erase("needle");
  EXPECT_NE(render(scene, scratch, "q.png").err.find("motion"), std::string::npos);
  scene["motion"] = {{"press_mm", 6.0}};
  scene["view"] = {{"kind", "xray"}};
  EXPECT_NE(render(scene, scratch, "q.png").err.find("not shown by xray"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(scratch / "q.png"));
}

// What the law material draws of lesions and portal veins (docs/decisions/0100, 0102), and no other difference.
TEST(RenderUltrasound, AnEarlierLawDrawsNeitherTextureNorPortalWalls) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_laws");
  Json plain = ball();
  plain["view"]["output"] = "display";
  plain["view"]["size_px"] = {160, 120};
  const auto lesion = [](const char* kind) {
    return Json{{{"center_mm", {0, -60, 0}}, {"radius_mm", 12}, {"hu", 45}, {"kind", kind}}};
  };
  const auto changes = [&](Json scene) {
    std::string drawn[2];
    for (const int newest : {0, 1}) {
      scene["view"]["sight_law"] = newest != 0 ? "material" : "clutter";
      const auto ran = render(scene, scratch, "law.png");
      EXPECT_EQ(ran.exit_code, 0) << ran.err;
      drawn[newest] = fixtures::whole_file(scratch / "law.png");
      std::filesystem::remove(scratch / "law.png");
    }
    return drawn[0] != drawn[1];
  };
  Json even = plain, textured = plain, walled = plain;
  even["lesions"] = lesion("node");
  textured["lesions"] = lesion("abscess");
  walled["volume"]["analytic"]["shapes"].push_back(
      {{"kind", "sphere"}, {"center_mm", {0, -60, 0}}, {"radius_mm", 10}, {"hu", 40}, {"class", "portal_vein"}});
  EXPECT_FALSE(changes(plain));
  EXPECT_FALSE(changes(even));
  EXPECT_TRUE(changes(textured));
  EXPECT_TRUE(changes(walled));
}

TEST(Sheet, PutsScenesSideBySide) {
  const auto scratch = fixtures::fresh_folder("sheet");
  Json scene = ball();
  scene["view"]["size_px"] = {64, 48};
  const auto write = [&](const char* name, const Json& json) { std::ofstream(scratch / name) << json.dump(); };
  write("ball.json", scene);
  Json sheet = {
      {"title", "<One & two>"},
      {"columns", {{{"name", "scatterers"}}, {{"name", "lattice"}, {"set", {{"view", {{"method", "lattice"}}}}}}}},
      {"rows", {{{"name", "a ball"}, {"scene", "ball.json"}}}}};
  const auto run = [&](const char* out) {
    write("sheet.json", sheet);
    return fixtures::run(
        kProgram + " sheet " + (scratch / "sheet.json").string() + " --out " + (scratch / out).string(), scratch);
  };
  const auto ran = run("s.html");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const std::string page = fixtures::whole_file(scratch / "s.html");
  EXPECT_NE(page.find("&lt;One &amp; two&gt;"), std::string::npos);
  std::vector<std::string> pictures;
  for (std::size_t at = page.find("base64,"); at != std::string::npos; at = page.find("base64,", at + 1))
    pictures.push_back(page.substr(at + 7, page.find('"', at) - at - 7));
  ASSERT_EQ(pictures.size(), 2U);
  EXPECT_NE(pictures[0], pictures[1]);
  for (const std::string& picture : pictures) {
    EXPECT_EQ(picture.rfind("iVBORw0KGgo", 0), 0U);  // how every PNG begins
    EXPECT_EQ(picture.size() % 4, 0U);
  }
  // A picture less itself is black, and whoever is not moved at all is still.
  sheet["columns"][1] = {{"name", "change"}, {"minus", {{"motion", {{"breath_level", 0.0}}}}}};
  sheet["rows"][0]["minus"] = "none";
  EXPECT_EQ(run("t.html").err.rfind("error: bad_sheet: ", 0), 0U);
  sheet["rows"][0].erase("minus");
  ASSERT_EQ(run("u.html").exit_code, 0);
  sheet["columns"][1]["set"] = {{"motion", {{"press_mm", 5.0}}}};
  sheet["columns"][1]["minus"]["motion"]["press_mm"] = 0.0;
  ASSERT_EQ(run("v.html").exit_code, 0);
  const std::string none = fixtures::whole_file(scratch / "u.html"),
                    some = fixtures::whole_file(scratch / "v.html");
  EXPECT_GT(some.size(), none.size() + 200) << "black packs smaller than change";
  sheet["rows"][0]["scene"] = "none.json";
  EXPECT_EQ(run("t.html").exit_code, 3);
  sheet.erase("columns");
  EXPECT_EQ(run("t.html").err.rfind("error: bad_sheet: ", 0), 0U);
  EXPECT_FALSE(std::filesystem::exists(scratch / "t.html"));
}

}  // namespace
}  // namespace seldinger
