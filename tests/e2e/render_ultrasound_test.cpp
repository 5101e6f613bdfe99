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

const std::string kProgram = SELDINGER_PROGRAM;
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

TEST(RenderUltrasound, DisplayIsAPictureAndTheRestIsRefused) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_display");
  Json scene = ball();
  scene["view"]["output"] = "display";
  const auto ran = render(scene, scratch, "p.png");
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(Json::parse(ran.out).at("size_px"), Json({800, 700}));
  EXPECT_EQ(fixtures::whole_file(scratch / "p.png").substr(1, 3), "PNG");
  for (const char* method : {"lattice", "thesis"}) {
    scene["view"]["method"] = method;
    const auto refused = render(scene, scratch, "q.png");
    EXPECT_EQ(refused.exit_code, 3);
    EXPECT_EQ(refused.err.rfind("error: unsupported_view: ", 0), 0U) << refused.err;
  }
  scene = ball();
  scene["view"]["depth_mm"] = -1;
  EXPECT_EQ(render(scene, scratch, "q.png").err.rfind("error: bad_scene: ", 0), 0U);
  EXPECT_FALSE(std::filesystem::exists(scratch / "q.png"));
}

// One grey, on all but a thousandth of the pixels (contracts.md's cross-backend promise).
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

}  // namespace
}  // namespace seldinger
