// An attempt guided by fluoroscopy as its user makes one: built-in torso, three operators, scores, replay, pages'
// data.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

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

struct XrayDemo {
  std::filesystem::path scratch = fixtures::fresh_folder("demo_xray");
  std::string library = (scratch / "library").string();
  Json answer;
  XrayDemo() { answer = fixtures::demo_library("--modality xray", library); }
  Json simulate(const std::string& who) const {
    const auto ran =
        run(kProgram + " simulate --library " + library + " --case " + answer.at("case_id").get<std::string>() +
                " --operator " + who + " --seed 100 --count 10 --json",
            scratch);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out).at("attempts");
  }
};

XrayDemo& demo() {
  static XrayDemo made;
  return made;
}

TEST(XrayDemo, ThreeOperatorsAreRecordedScoredAndReplayable) {
  ASSERT_EQ(demo().answer.at("attempts").size(), 3U);
  for (const Json& attempt : demo().answer.at("attempts")) {
    EXPECT_GT(metric(attempt, "fluoroscopy_time").value_or(0.0), 0.5);
    EXPECT_GT(metric(attempt, "dap").value_or(0.0), 0.0);
    EXPECT_GE(metric(attempt, "views").value_or(0.0), 1.0);
    const std::string id = attempt.at("attempt_id").get<std::string>();
    const auto replay =
        run(kProgram + " replay " + id + " --verify --json --library " + demo().library, demo().scratch);
    EXPECT_EQ(replay.exit_code, 0) << replay.out << replay.err;
    EXPECT_EQ(Json::parse(replay.out).at("verified"), true);
    const auto score = run(kProgram + " score " + id + " --json --library " + demo().library, demo().scratch);
    EXPECT_EQ(Json::parse(score.out).at("metrics"), attempt.at("metrics"));
    const auto shown =
        run(kProgram + " attempt show " + id + " --json --library " + demo().library, demo().scratch);
    EXPECT_EQ(Json::parse(shown.out).at("modality"), "xray");
  }
}

TEST(XrayDemo, TheExpertHitsTenOfTenAndTheNoviceIsWorseInTheMean) {
  const Json expert = demo().simulate("expert"), novice = demo().simulate("novice");
  struct Mean {
    double hits = 0, miss_mm = 0, beam_s = 0, hand_s = 0, dap = 0, views = 0;
  } mean[2];
  for (std::size_t i = 0; i < 10; ++i)
    for (const int who : {0, 1}) {
      const Json& attempt = (who == 0 ? expert : novice)[i];
      mean[who].hits += metric(attempt, "hit").value_or(0.0);
      mean[who].miss_mm += metric(attempt, "tip_target_dist").value_or(std::nan("")) / 10;
      mean[who].beam_s += metric(attempt, "fluoroscopy_time").value_or(std::nan("")) / 10;
      mean[who].hand_s += metric(attempt, "hand_in_beam").value_or(std::nan("")) / 10;
      mean[who].dap += metric(attempt, "dap").value_or(std::nan("")) / 10;
      mean[who].views += metric(attempt, "views").value_or(std::nan("")) / 10;
      if (who == 0) {
        EXPECT_GE(metric(attempt, "view_angle_max").value_or(0.0), 30.0);
        EXPECT_LE(metric(attempt, "longest_advance_between_exposures").value_or(99.0), 10.0);
      }
    }
  EXPECT_EQ(mean[0].hits, 10.0);
  EXPECT_LT(mean[0].miss_mm, mean[1].miss_mm);
  EXPECT_LT(mean[0].beam_s, mean[1].beam_s);
  EXPECT_LT(mean[0].hand_s, mean[1].hand_s);
  EXPECT_LT(mean[0].dap, mean[1].dap);
  EXPECT_GT(mean[0].views, mean[1].views);
}

TEST(XrayDemo, ExplainsThatItScatters) {
  const auto ran = run(kProgram + " case explain --json --library " + demo().library + " " +
                           demo().answer.at("case_id").get<std::string>(),
                       demo().scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_EQ(Json::parse(ran.out).at("sight_law"), "tilt");
}

TEST(XrayDemo, StandsBesideTheOneUnderAProbe) {
  const auto other = run(kProgram + " demo --no-serve --json --library " + demo().library, demo().scratch);
  ASSERT_EQ(other.exit_code, 0) << other.err;
  const Json answer = Json::parse(other.out);
  EXPECT_NE(answer.at("case_id"), demo().answer.at("case_id"));
  for (const Json& attempt : answer.at("attempts"))
    EXPECT_FALSE(metric(attempt, "dap").has_value()) << "null, not 0";
  const auto again =
      run(kProgram + " demo --modality xray --no-serve --json --library " + demo().library, demo().scratch);
  EXPECT_EQ(Json::parse(again.out).at("attempts"), demo().answer.at("attempts"));
}

TEST(XrayImport, KeepsModalityAndPosition) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto scratch = fixtures::fresh_folder("import_xray");
  const std::string library = (scratch / "library").string();
  const std::string import =
      kProgram + " import " + kData + "/ct-abdomen-contrast-dicom --json --library " + library;
  const auto prone = run(import + " --modality xray --position prone", scratch);
  ASSERT_EQ(prone.exit_code, 0) << prone.err;
  EXPECT_EQ(Json::parse(prone.out).at("modality"), "xray");
  EXPECT_EQ(Json::parse(prone.out).at("patient_position"), "prone");
  for (const char* bad : {" --modality ct", " --position upright"})
    EXPECT_EQ(run(import + bad, scratch).exit_code, 2) << bad;
}

}  // namespace
}  // namespace seldinger
