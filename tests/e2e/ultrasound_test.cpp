// Attempts guided by ultrasound as their user makes them: patients, three operators, scores, replay; poses made
// elsewhere; what a rendered picture is told to show.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::metric;
using fixtures::run;

using fixtures::kData;
using fixtures::kProgram;

struct UltrasoundDemo {
  std::filesystem::path scratch;
  std::string library;
  Json answer;
  UltrasoundDemo(const std::string& name, const std::string& options)
      : scratch(fixtures::fresh_folder("demo_ultrasound_" + name)), library((scratch / "library").string()) {
    answer = fixtures::demo_library("--modality ultrasound" + options, library);
    EXPECT_FALSE(answer.empty());
  }
  Json simulate(const std::string& who) const {
    const auto ran =
        run(kProgram + " simulate --library " + library + " --case " + answer.at("case_id").get<std::string>() +
                " --operator " + who + " --seed 100 --count 10 --json",
            scratch);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out).at("attempts");
  }
  void expect_experts_hit_and_novices_are_worse() const {
    const Json expert = simulate("expert"), novice = simulate("novice");
    struct Mean {
      double hits = 0, miss_mm = 0, seen = 0, advance = 0, near = 0;
    } mean[2];
    for (std::size_t i = 0; i < 10; ++i)
      for (const int who : {0, 1}) {
        const Json& attempt = (who == 0 ? expert : novice)[i];
        mean[who].hits += metric(attempt, "hit").value_or(0.0);
        mean[who].miss_mm += metric(attempt, "tip_target_dist").value_or(std::nan("")) / 10;
        mean[who].seen += metric(attempt, "vis_joint").value_or(std::nan("")) / 10;
        mean[who].advance += metric(attempt, "advance_visible_share").value_or(std::nan("")) / 10;
        mean[who].near += metric(attempt, "vis_joint_5_mm").value_or(std::nan("")) / 10;
      }
    EXPECT_GE(mean[0].hits, 9.0);
    EXPECT_GT(mean[0].hits, mean[1].hits);
    EXPECT_LT(mean[0].miss_mm, mean[1].miss_mm);
    EXPECT_GT(mean[0].seen, mean[1].seen);
    EXPECT_GT(mean[0].advance, mean[1].advance);
    EXPECT_GT(mean[0].near, mean[1].near);
    EXPECT_GT(mean[0].advance, 0.6) << "an expert sees most of the way";
  }
};

UltrasoundDemo& built_in() {
  static UltrasoundDemo made("built_in", "");
  return made;
}

TEST(UltrasoundDemo, ThreeOperatorsAreRecordedScoredAndReplayable) {
  ASSERT_EQ(built_in().answer.at("attempts").size(), 3U);
  EXPECT_EQ(built_in().answer.at("lesion").at("hu"), 5.0) << "a cyst";
  for (const Json& attempt : built_in().answer.at("attempts")) {
    for (const char* id : {"vis_needle", "vis_target", "vis_joint", "vis_joint_2_mm", "vis_joint_5_mm",
                           "visible_needle_length", "advance_visible_share"})
      EXPECT_TRUE(metric(attempt, id).has_value()) << id;
    EXPECT_FALSE(metric(attempt, "dap").has_value()) << "null, not 0";
    const std::string id = attempt.at("attempt_id").get<std::string>(), of = " --library " + built_in().library;
    const auto replay = run(kProgram + " replay " + id + " --verify --json" + of, built_in().scratch);
    EXPECT_EQ(replay.exit_code, 0) << replay.out << replay.err;
    EXPECT_EQ(Json::parse(replay.out).at("verified"), true);
    const auto score = run(kProgram + " score " + id + " --json" + of, built_in().scratch);
    EXPECT_EQ(Json::parse(score.out).at("metrics"), attempt.at("metrics"));
    const auto shown = run(kProgram + " attempt show " + id + " --json" + of, built_in().scratch);
    EXPECT_EQ(Json::parse(shown.out).at("modality"), "ultrasound");
  }
}

TEST(UltrasoundDemo, IsWhatTheDemoDoesUnlessToldOtherwise) {
  const auto plain = run(kProgram + " demo --no-serve --json --library " + built_in().library, built_in().scratch);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_EQ(Json::parse(plain.out).at("attempts"), built_in().answer.at("attempts"));
  const auto slices =
      run(kProgram + " demo --modality mpr --no-serve --json --library " + built_in().library, built_in().scratch);
  ASSERT_EQ(slices.exit_code, 0) << slices.err;
  const Json answer = Json::parse(slices.out);
  EXPECT_NE(answer.at("case_id"), built_in().answer.at("case_id"));
  ASSERT_EQ(answer.at("attempts").size(), 3U);
  for (const Json& attempt : answer.at("attempts")) {
    EXPECT_TRUE(metric(attempt, "vis_joint").has_value());
    EXPECT_FALSE(metric(attempt, "vis_joint_2_mm").has_value()) << "null, not 0";
  }
}

TEST(UltrasoundDemo, TheExpertHitsInTheBuiltInTorso) {
  built_in().expect_experts_hit_and_novices_are_worse();
}

TEST(UltrasoundDemo, TheExpertHitsInARealPatientWithoutContrast) {
  SELDINGER_NEEDS_SHARED_DATA();
  const UltrasoundDemo real("pelvis", " --ct " + kData + "/ct-abdomen-pelvis/abdomen_pelvis.nii.gz");
  real.expect_experts_hit_and_novices_are_worse();
}

TEST(UltrasoundImport, KeepsTheModality) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("import_ultrasound");
  const std::string library = (scratch / "library").string();
  const auto ran = run(kProgram + " import " + kData +
                           "/ct-abdomen-contrast-dicom --modality ultrasound --json --library " + library,
                       scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(Json::parse(ran.out).at("modality"), "ultrasound");
}

// A ball of liver with a cyst 30 mm below its top; the linear probe touches the top.
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
          {"needle", {{"tip_mm", {0, -70, 0}}, {"direction", {0.8, 0.6, 0}}}},
          {"lesions", {{{"center_mm", {0, -68, 0}}, {"radius_mm", 5}, {"hu", 5}}}},
          {"view",
           {{"kind", "ultrasound"},
            {"probe", "L11-5v"},
            {"origin_mm", {0, -97, 0}},
            {"axial", {0, 1, 0}},
            {"lateral", {1, 0, 0}},
            {"depth_mm", 50}}}};
}

TEST(RenderUltrasound, TellsWhatThePictureShows) {
  const auto scratch = fixtures::fresh_folder("render_ultrasound_visible");
  const auto told = [&](const Json& scene) {
    std::ofstream(scratch / "scene.json") << scene;
    const auto ran = run(kProgram + " render " + (scratch / "scene.json").string() + " --out " +
                             (scratch / "p.png").string() + " --json",
                         scratch);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out).at("visible");
  };
  const Json in_plane = told(ball());
  EXPECT_EQ(in_plane.at("needle_tip"), true);
  EXPECT_EQ(in_plane.at("target"), true);
  EXPECT_EQ(in_plane.at("joint"), true);
  EXPECT_TRUE(in_plane.at("needle_length_mm").is_number());
  Json beside = ball();
  beside["view"]["origin_mm"] = {0, -97, 3};  // the beam is 1.5 mm thick there
  EXPECT_EQ(told(beside).at("needle_tip"), false);
  Json lifted = ball();
  lifted["view"]["origin_mm"] = {0, -105, 0};
  EXPECT_EQ(told(lifted).at("target"), false) << "in air nothing is seen";
}

TEST(Score, OfAPoseFileInAnUltrasoundView) {
  const auto scratch = fixtures::fresh_folder("score_ultrasound");
  std::ofstream(scratch / "scene.json") << ball();
  // Along (0.8, 0.6, 0) to the cyst at 10 mm/s; the probe slides out of plane by 10 mm half-way.
  std::ostringstream csv;
  csv << "t_s,needle_tip_x_mm,needle_tip_y_mm,needle_tip_z_mm,needle_dir_x,needle_dir_y,needle_dir_z,"
         "probe_origin_x_mm,probe_origin_y_mm,probe_origin_z_mm,probe_axial_x,probe_axial_y,probe_axial_z,"
         "probe_lateral_x,probe_lateral_y,probe_lateral_z,fire\n";
  constexpr int kRows = 600;
  for (int i = 0; i <= kRows; ++i) {
    const double left_mm = 0.1 * (kRows - i);
    csv << 0.01 * i << "," << -0.8 * left_mm << "," << -68.0 - 0.6 * left_mm << ",0,0.8,0.6,0,0,-97,"
        << (i < kRows / 2 ? 10 : 0) << ",0,1,0,1,0,0," << (i == kRows ? 1 : 0) << "\n";
  }
  std::ofstream(scratch / "poses.csv") << csv.str();
  const auto ran = run(kProgram + " score --poses " + (scratch / "poses.csv").string() + " --scene " +
                           (scratch / "scene.json").string() + " --json",
                       scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json score = Json::parse(ran.out);
  EXPECT_EQ(metric(score, "hit"), 1.0);
  const double joint = metric(score, "vis_joint").value_or(std::nan("")),
               near = metric(score, "vis_joint_5_mm").value_or(std::nan("")),
               target = metric(score, "vis_target").value_or(std::nan(""));
  EXPECT_GT(target, 0.3);
  EXPECT_LT(target, 0.9) << "not while the probe is beside";
  EXPECT_GT(joint, 0.1);
  EXPECT_LE(joint, near) << "geometry asks for less";
  EXPECT_LT(near, 0.9);
}

}  // namespace
}  // namespace seldinger
