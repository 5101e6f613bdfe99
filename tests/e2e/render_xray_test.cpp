// render of X-ray views as a user calls it: closed forms through files, every backend and method, and what is
// refused.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

using fixtures::kProgram;
constexpr int kPx = 65;
constexpr double kWaterPerMm = 0.018366;      // 80 keV, with coherent scattering (xraylib)
constexpr double kIronPerMm = 0.5950 / 1.27;  // 80 keV: 1.27 mm of steel are 0.595

// 100 mm of water in every direction, the middle at the origin.
Json water_scene() {
  return {{"volume",
           {{"analytic",
             {{"size_voxels", {60, 60, 60}},
              {"spacing_mm", {2, 2, 2}},
              {"origin_mm", {-59, -59, -59}},
              {"shapes", {{{"kind", "box"}, {"min_mm", {-50, -50, -50}}, {"max_mm", {50, 50, 50}}, {"hu", 0}}}}}}}},
          {"view",
           {{"kind", "xray"},
            {"source_mm", {0, 800, 0}},
            {"detector_center_mm", {0, -400, 0}},
            {"u", {1, 0, 0}},
            {"v", {0, 0, -1}},
            {"pixel_mm", 1},
            {"size_px", {kPx, kPx}},
            {"energy_kev", 80},
            {"method", "exact"},
            {"output", "line_integral"}}}};
}

struct Picture {
  fixtures::Ran ran;
  std::vector<float> values;
  double at(int column, int row) const {
    return static_cast<double>(values[static_cast<std::size_t>(row * kPx + column)]);
  }
};

Picture render(const Json& scene, const std::string& options = "--backend cpu", std::size_t pixels = kPx * kPx) {
  static int count = 0;
  const auto scratch = fixtures::fresh_folder("render_xray_" + std::to_string(count++));
  std::ofstream(scratch / "scene.json") << scene;
  Picture picture;
  picture.ran = run(kProgram + " render " + (scratch / "scene.json").string() + " --out " +
                        (scratch / "p.mha").string() + " --json " + options,
                    scratch);
  const std::string file = fixtures::whole_file(scratch / "p.mha");
  if (picture.ran.exit_code != 0) {
    EXPECT_TRUE(file.empty()) << "a refused scene leaves no picture";
    return picture;
  }
  picture.values.resize(pixels);
  EXPECT_GT(file.size(), pixels * 4);
  if (file.size() > pixels * 4)
    std::memcpy(picture.values.data(), file.data() + file.size() - pixels * 4, pixels * 4);
  return picture;
}

// The chord of the box from the source at (0, 800, 0) to a pixel.
double chord_mm(int column, int row) {
  const double x = column - kPx / 2, z = -(row - kPx / 2);
  return 100.0 * std::sqrt(x * x + 1200.0 * 1200.0 + z * z) / 1200.0;
}

TEST(RenderXray, LineIntegralOfWaterIsTheChordByEveryBackendAndMethod) {
  for (const char* backend : {"cpu", "gpu", "reference"})
    for (const char* method : {"exact", "slab", "trilinear"}) {
      SCOPED_TRACE(std::string(backend) + " " + method);
      Json scene = water_scene();
      scene["view"]["method"] = method;
      const Picture picture = render(scene, std::string("--backend ") + backend);
      ASSERT_EQ(picture.ran.exit_code, 0) << picture.ran.err;
      // The interpolating methods round the box's faces over a voxel, and keep the sum.
      const double tolerance = std::string(method) == "exact" ? 1e-4 : 2e-3;
      for (const int column : {0, 13, 32, 64})
        for (const int row : {0, 7, 32, 64}) {
          const double expected = kWaterPerMm * chord_mm(column, row);
          ASSERT_NEAR(picture.at(column, row), expected, tolerance * expected) << column << ' ' << row;
        }
    }
}

TEST(RenderXray, OutputsAreWhatTheySay) {
  Json scene = water_scene();
  scene["view"]["output"] = "intensity";
  const Picture intensity = render(scene);
  ASSERT_EQ(intensity.ran.exit_code, 0) << intensity.ran.err;
  EXPECT_NEAR(intensity.at(32, 32), std::exp(-kWaterPerMm * 100.0), 1e-5);
  scene["view"]["output"] = "display";
  const Picture display = render(scene);
  ASSERT_EQ(display.ran.exit_code, 0);
  for (const float grey : display.values) ASSERT_TRUE(grey >= 0.0F && grey <= 255.0F);
}

// 100 mm of water, a field of 65 mm at the panel, 400 mm behind the water's middle: 3.8 % of the mean.
TEST(RenderXray, ScatterIsAPedestalThatAGridAndANarrowFieldTakeAway) {
  Json scene = water_scene();
  scene["view"]["output"] = "intensity";
  const Picture primary = render(scene);
  scene["view"]["scatter"] = "open";
  const Picture open = render(scene);
  ASSERT_EQ(open.ran.exit_code, 0) << open.ran.err;
  const double pedestal = open.at(32, 32) - primary.at(32, 32);
  EXPECT_NEAR(pedestal / primary.at(32, 32), 0.0376, 0.001);
  for (const int column : {0, 13, 64}) EXPECT_NEAR(open.at(column, 5) - primary.at(column, 5), pedestal, 1e-6);
  scene["view"]["scatter"] = "grid";
  EXPECT_NEAR(render(scene).at(32, 32) - primary.at(32, 32), 0.15 / 0.70 * pedestal, 1e-6);
  scene["view"]["scatter"] = "open";
  scene["view"]["pixel_mm"] = 0.5;
  EXPECT_NEAR(render(scene).at(32, 32) - primary.at(32, 32), pedestal / std::sqrt(8.0), 0.01 * pedestal);
  scene["view"]["output"] = "line_integral";
  const Picture refused = render(scene);
  EXPECT_EQ(refused.ran.exit_code, 3);
  EXPECT_NE(refused.ran.err.find("scatter"), std::string::npos) << refused.ran.err;
}

// A twentieth of the mean lies on every pixel, and as much less of its own.
TEST(RenderXray, GlareVeilsWhatIsNoLineIntegral) {
  Json scene = water_scene();
  scene["needle"] = {{"tip_mm", {0, 0, 0}}, {"direction", {1, 0, 0}}, {"length_mm", 30}, {"radius_mm", 5}};
  scene["view"]["output"] = "intensity";
  const Picture clear = render(scene);
  double mean = 0.0;
  for (const float value : clear.values)
    mean += static_cast<double>(value) / static_cast<double>(clear.values.size());
  scene["view"]["glare_percent"] = 5;
  const Picture veiled = render(scene);
  ASSERT_EQ(veiled.ran.exit_code, 0) << veiled.ran.err;
  for (const int column : {0, 13, 32, 64})
    EXPECT_NEAR(veiled.at(column, 32), 0.95 * clear.at(column, 32) + 0.05 * mean, 1e-5) << column;
  scene["view"]["output"] = "line_integral";
  EXPECT_EQ(render(scene).ran.exit_code, 3);
}

TEST(RenderXray, NeedleAndLesionAreTheirChords) {
  Json scene = water_scene();
  scene["needle"] = {{"tip_mm", {0, 0, 0}}, {"direction", {1, 0, 0}}, {"length_mm", 30}, {"radius_mm", 0.635}};
  scene["lesions"] = {{{"center_mm", {20, 0, 0}}, {"radius_mm", 8}, {"hu", -200}}};
  const Picture picture = render(scene);
  ASSERT_EQ(picture.ran.exit_code, 0) << picture.ran.err;
  // The shaft runs from x = −30 to 0; at the isocentre a pixel is 2/3 mm. Row 32 looks along its middle.
  EXPECT_NEAR(picture.at(20, 32), kWaterPerMm * (chord_mm(20, 32) - 1.27) + kIronPerMm * 1.27, 2e-3);
  EXPECT_NEAR(picture.at(62, 32), kWaterPerMm * (chord_mm(62, 32) - 0.2 * 16.0), 1e-3);
  const Json visible = Json::parse(picture.ran.out).at("visible");
  EXPECT_EQ(visible.at("needle_tip"), true);
  // Hollow: what is inside the wall is empty.
  scene["needle"]["inner_radius_mm"] = 0.4;
  const Picture hollow = render(scene);
  EXPECT_NEAR(hollow.at(20, 32), kWaterPerMm * (chord_mm(20, 32) - 1.27) + kIronPerMm * 0.47, 2e-3);
}

TEST(RenderXray, ParallelRaysAndDirection) {
  Json scene = water_scene();
  scene["view"].erase("source_mm");
  scene["view"]["direction"] = {0, -1, 0};
  const Picture picture = render(scene);
  ASSERT_EQ(picture.ran.exit_code, 0) << picture.ran.err;
  for (const int column : {0, 32, 64}) EXPECT_NEAR(picture.at(column, 32), kWaterPerMm * 100.0, 1e-4);
}

TEST(RenderXray, EnergyFollowsTheTables) {
  double last = 1e9;
  for (const double energy_kev : {20.0, 50.0, 80.0, 120.0, 150.0}) {
    Json scene = water_scene();
    scene["view"]["energy_kev"] = energy_kev;
    const Picture picture = render(scene);
    ASSERT_EQ(picture.ran.exit_code, 0) << picture.ran.err;
    EXPECT_LT(picture.at(32, 32), last);
    last = picture.at(32, 32);
    EXPECT_TRUE(energy_kev != 50.0 || std::abs(last - 2.2694) < 1e-3) << last;
  }
}

TEST(RenderXray, SupersamplingIsTheMeanOverThePixel) {
  Json scene = water_scene();
  scene["view"]["supersampling"] = 3;
  const Picture picture = render(scene);
  ASSERT_EQ(picture.ran.exit_code, 0) << picture.ran.err;
  EXPECT_NEAR(picture.at(32, 32), kWaterPerMm * 100.0, 1e-4);
  scene["view"]["supersampling"] = 2.5;
  EXPECT_EQ(render(scene).ran.exit_code, 3);
}

// No GL: asked for it fails loudly, otherwise the CPU takes over. Never an image from nowhere.
TEST(RenderXray, WithoutGlTheGpuFailsAndTheCpuServes) {
  const auto scratch = fixtures::fresh_folder("render_xray_no_gl");
  std::ofstream(scratch / "scene.json") << water_scene();
  const std::string command = "__EGL_VENDOR_LIBRARY_DIRS=/nowhere " + kProgram + " render " +
                              (scratch / "scene.json").string() + " --out " + (scratch / "p.mha").string();
  const auto asked = run(command + " --backend gpu", scratch);
  EXPECT_EQ(asked.exit_code, 4) << asked.err;
  EXPECT_EQ(asked.err.rfind("error: gl: ", 0), 0U) << asked.err;
  EXPECT_FALSE(std::filesystem::exists(scratch / "p.mha"));
  EXPECT_EQ(run(command, scratch).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(scratch / "p.mha"));
}

// The pictures of docs/scenes/real, made from the real abdomen: what they show is told, and CPU and GPU agree.
TEST(RenderXray, DocumentedScenesOfTheRealAbdomen) {
  SELDINGER_NEEDS_SHARED_DATA();
  const std::filesystem::path folder = fixtures::source_dir() / "docs" / "scenes" / "real";
  int scenes = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().filename().string().rfind("xray_", 0) != 0) continue;
    SCOPED_TRACE(entry.path().filename());
    std::ifstream stream(entry.path());
    Json scene = Json::parse(stream);
    // Made absolute, since the copy lies elsewhere.
    scene["volume"] = (folder / scene.at("volume").get<std::string>()).lexically_normal().string();
    scene["view"]["output"] = "line_integral";
    const Picture cpu = render(scene, "--backend cpu", 512 * 512), gpu = render(scene, "--backend gpu", 512 * 512);
    ASSERT_EQ(cpu.ran.exit_code, 0) << cpu.ran.err;
    ASSERT_EQ(gpu.ran.exit_code, 0) << gpu.ran.err;
    const bool needle = scene.contains("needle");
    EXPECT_EQ(Json::parse(cpu.ran.out).at("visible").at("joint"), needle);
    double worst = 0.0, most = 0.0;
    for (std::size_t i = 0; i < cpu.values.size(); ++i) {
      const double difference = std::abs(static_cast<double>(cpu.values[i]) - static_cast<double>(gpu.values[i]));
      ASSERT_TRUE(difference >= 0.0);
      worst = std::max(worst, difference);
      most = std::max(most, static_cast<double>(cpu.values[i]));
    }
    EXPECT_LE(worst, 2e-4);
    EXPECT_GT(most, 4.0) << "a body absorbs";
    EXPECT_LT(most, 20.0);
    ++scenes;
  }
  EXPECT_EQ(scenes, 3);
}

TEST(RenderXray, DegenerateViewsAreRefused) {
  const auto refused = [](const Json& scene, const char* word) {
    const Picture picture = render(scene);
    EXPECT_EQ(picture.ran.exit_code, 3) << word;
    EXPECT_EQ(picture.ran.err.rfind("error: bad_scene: ", 0), 0U) << picture.ran.err;
    EXPECT_NE(picture.ran.err.find(word), std::string::npos) << picture.ran.err;
  };
  Json scene = water_scene();
  scene["view"]["source_mm"] = {40, -400, 0};
  refused(scene, "detector's plane");
  scene = water_scene();
  scene["view"]["pixel_mm"] = 0;
  refused(scene, "pixel_mm");
  scene = water_scene();
  scene["view"]["source_mm"] = {0, nullptr, 0};
  refused(scene, "source_mm");
  scene = water_scene();
  scene["view"].erase("source_mm");
  refused(scene, "source_mm");
  scene["view"]["direction"] = {1, 0, 0};
  refused(scene, "along the detector");
  scene = water_scene();
  scene["view"]["v"] = {1, 0, 0};
  refused(scene, "view.v");
  scene = water_scene();
  scene["view"]["energy_kev"] = 5;
  refused(scene, "energy_kev");
  scene = water_scene();
  scene["view"]["method"] = "fast";
  refused(scene, "method");
}

}  // namespace
}  // namespace seldinger
