// Tests of the main job as its user runs it: real CT in, graded and recorded attempts out.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::metric;
using fixtures::run;

using fixtures::kData;
using fixtures::kProgram;

// The demo on a real patient, once for all tests here.
struct RealDemo {
  std::filesystem::path scratch = fixtures::fresh_folder("demo_real");
  std::string library = (scratch / "library").string();
  Json answer;
  RealDemo() {
    const auto ran = run(
        kProgram + " demo --no-serve --json --library " + library + " --ct " + kData + "/ct-abdomen-contrast-dicom",
        scratch);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    answer = Json::parse(ran.out, nullptr, false);
    EXPECT_TRUE(answer.is_object()) << ran.out;
  }
};

RealDemo& real_demo() {
  static RealDemo demo;
  return demo;
}

TEST(Demo, TheLesionKeepsItsStatedRuleOnARealPatient) {
  SELDINGER_NEEDS_SHARED_DATA();
  const Json& lesion = real_demo().answer.at("lesion");
  EXPECT_EQ(lesion.at("radius_mm"), 6.0);
  EXPECT_GE(lesion.at("depth_below_skin_mm").get<double>(), 30.0);
  EXPECT_LE(lesion.at("depth_below_skin_mm").get<double>(), 90.0);
  EXPECT_FALSE(lesion.at("rule").get<std::string>().empty());
}

TEST(Demo, ThreeOperatorsAreRecordedScoredAndReplayable) {
  SELDINGER_NEEDS_SHARED_DATA();
  RealDemo& demo = real_demo();
  ASSERT_EQ(demo.answer.at("attempts").size(), 3U);
  for (const Json& attempt : demo.answer.at("attempts")) {
    EXPECT_TRUE(metric(attempt, "hit").has_value());
    EXPECT_GE(metric(attempt, "skin_punctures").value_or(0), 1.0);
    const auto replay = run(kProgram + " replay " + attempt.at("attempt_id").get<std::string>() +
                                " --verify --json --library " + demo.library,
                            demo.scratch);
    EXPECT_EQ(replay.exit_code, 0) << replay.out << replay.err;
    EXPECT_EQ(Json::parse(replay.out).at("verified"), true);
    const auto score = run(
        kProgram + " score " + attempt.at("attempt_id").get<std::string>() + " --json --library " + demo.library,
        demo.scratch);
    EXPECT_EQ(Json::parse(score.out).at("metrics"), attempt.at("metrics"))
        << "the recording gives the stored score";
  }
}

TEST(Demo, ASecondRunUsesWhatIsThere) {
  SELDINGER_NEEDS_SHARED_DATA();
  RealDemo& demo = real_demo();
  const auto again = run(kProgram + " demo --no-serve --json --library " + demo.library + " --ct " + kData +
                             "/ct-abdomen-contrast-dicom",
                         demo.scratch);
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const Json answer = Json::parse(again.out);
  EXPECT_EQ(answer.at("case_id"), demo.answer.at("case_id"));
  EXPECT_EQ(answer.at("attempts"), demo.answer.at("attempts"));
  EXPECT_TRUE(answer.at("accounts").empty()) << "passwords are shown once";
}

TEST(Demo, TheExpertHitsAndTheNoviceIsFartherAway) {
  SELDINGER_NEEDS_SHARED_DATA();
  RealDemo& demo = real_demo();
  const auto simulate = [&](const std::string& who) {
    const auto ran = run(kProgram + " simulate --library " + demo.library + " --case " +
                             demo.answer.at("case_id").get<std::string>() + " --operator " + who +
                             " --seed 100 --count 10 --json",
                         demo.scratch);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    return Json::parse(ran.out).at("attempts");
  };
  const Json expert = simulate("expert"), novice = simulate("novice");
  double hits = 0.0, expert_mm = 0.0, novice_mm = 0.0;
  for (std::size_t i = 0; i < 10; ++i) {
    EXPECT_EQ(expert[i].at("seed"), 100 + i);
    hits += metric(expert[i], "hit").value_or(0.0);
    expert_mm += metric(expert[i], "tip_target_dist").value_or(std::nan("")) / 10.0;
    novice_mm += metric(novice[i], "tip_target_dist").value_or(std::nan("")) / 10.0;
  }
  EXPECT_GE(hits, 9.0);
  EXPECT_LT(expert_mm, novice_mm);
}

TEST(Demo, ATamperedRecordingIsFoundOut) {
  SELDINGER_NEEDS_SHARED_DATA();
  RealDemo& demo = real_demo();
  const auto copy = demo.scratch / "tampered";
  std::filesystem::remove_all(copy);
  std::filesystem::copy(demo.library, copy, std::filesystem::copy_options::recursive);
  const std::string attempt = demo.answer.at("attempts")[0].at("attempt_id").get<std::string>();
  // One byte inside the recording's pages, by a plain search for the chunk's zstd magic number.
  const auto path = copy / "seldinger.sqlite";
  std::string bytes = fixtures::whole_file(path);
  const std::size_t magic = bytes.find(std::string("\x28\xb5\x2f\xfd", 4));
  ASSERT_NE(magic, std::string::npos);
  int refused = 0;
  for (std::size_t at = magic; at != std::string::npos && refused == 0;
       at = bytes.find(std::string("\x28\xb5\x2f\xfd", 4), at + 1)) {
    std::string spoilt = bytes;
    spoilt[at + 64] = static_cast<char>(spoilt[at + 64] ^ 1);
    std::ofstream(path, std::ios::binary) << spoilt;
    const auto replay =
        run(kProgram + " replay " + attempt + " --verify --json --library " + copy.string(), demo.scratch);
    if (replay.exit_code == 1) {
      EXPECT_EQ(Json::parse(replay.out).at("verified"), false);
      ++refused;
    }
  }
  EXPECT_EQ(refused, 1) << "no spoilt chunk belonged to the attempt";
}

TEST(Demo, TheBuiltInCaseNeedsNoData) {
  const auto scratch = fixtures::fresh_folder("demo_built_in");
  const auto ran = run(kProgram + " demo --no-serve --json --library " + (scratch / "library").string(), scratch);
  ASSERT_EQ(ran.exit_code, 0) << ran.err;
  const Json answer = Json::parse(ran.out);
  EXPECT_EQ(answer.at("attempts").size(), 3U);
  EXPECT_EQ(answer.at("accounts").size(), 4U);
  EXPECT_EQ(ran.err.find("error"), std::string::npos);
  const auto dilated = run(
      kProgram + " demo --no-serve --json --calyces dilated --library " + (scratch / "library").string(), scratch);
  ASSERT_EQ(dilated.exit_code, 0) << dilated.err;
  EXPECT_NE(Json::parse(dilated.out).at("case_id"), answer.at("case_id")) << "another kind is another case";
  EXPECT_EQ(Json::parse(dilated.out).at("title"), "Built-in torso, dilated calyces");
}

}  // namespace
}  // namespace seldinger
