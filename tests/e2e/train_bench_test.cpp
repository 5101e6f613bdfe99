// The mentor's bench as a mentor uses it, in a real window: a draft is opened, lesion and entry are clicked, its
// checks go red and green, it is tried, published, and a trainee finds it. Where things are is the window's at 1280
// × 800.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

const std::string kProgram = SELDINGER_PROGRAM;
constexpr const char* kPassword = "a password";

// Of the axial plane at z = 0, where the cursor begins: air, the liver, skin on the right side.
constexpr std::pair<int, int> kOutside{30, 100}, kLiver{115, 225}, kFlank{45, 235};

class TrainBenchTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fixtures::fresh_folder("train_bench");
    library_ = (folder_ / "library").string();
    const auto made = run(kProgram + " demo --no-serve --json --library " + library_, folder_);
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const std::string demo = Json::parse(made.out)["case_id"];
    for (const char* user : {"mona --role mentor", "tina --role trainee"}) done("user add " + std::string(user));
    case_id_ = ask("case version " + demo + " --by mona")["case_id"];  // the demo's has attempts
    done("case lesion " + case_id_ + " --remove " + shown()["lesions"][0]["lesion_id"].get<std::string>());
    done("case setting " + case_id_ + " --title 'From the bench' --pass 'hit >= 1'");
    mentor_ = std::make_unique<fixtures::Trainee>(kProgram, library_, folder_);
  }
  void done(const std::string& words) {
    const auto ran =
        run(std::string("printf '") + kPassword + "\\n' | " + kProgram + " " + words + " --library " + library_,
            folder_);
    ASSERT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
  }
  Json ask(const std::string& words) {
    const auto ran = run(kProgram + " " + words + " --json --library " + library_, folder_);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  }
  Json shown() { return ask("case show " + case_id_); }
  Json bench() const { return mentor_->now().value("bench", Json::object()); }
  // Once what was done last is checked.
  bool check_is(const std::string& list, const std::string& name) {
    return fixtures::until(
        [&] {
          const Json now = bench();
          return !now.value("checking", true) && now.contains(list) &&
                 std::find(now[list].begin(), now[list].end(), name) != now[list].end();
        },
        60.0);
  }
  void click_axial(int x, int y) const { mentor_->screen().click(x, y); }

  std::filesystem::path folder_;
  std::string library_, case_id_;
  std::unique_ptr<fixtures::Trainee> mentor_;
};

TEST_F(TrainBenchTest, AMentorPlacesChecksAndPublishesAndATraineeFindsIt) {
  ASSERT_FALSE(HasFailure());
  const fixtures::Screen& screen = mentor_->screen();
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("mona", kPassword));
  screen.click(fixtures::kSecondDraft.first, fixtures::kSecondDraft.second);
  ASSERT_TRUE(mentor_->reaches("bench", 20.0));
  ASSERT_TRUE(check_is("failing", "lesion_present")) << mentor_->now();
  mentor_->keep_picture();
  screen.press("l");
  click_axial(kOutside.first, kOutside.second);
  ASSERT_TRUE(check_is("failing", "lesion_inside_body")) << mentor_->now();
  mentor_->keep_picture();
  click_axial(kLiver.first, kLiver.second);
  ASSERT_TRUE(check_is("holding", "lesion_inside_body")) << mentor_->now();
  EXPECT_EQ(bench()["lesions"], 1);
  const double before_mm = shown()["lesions"][0]["radius_mm"];
  const double grip_px = before_mm / bench()["mm_per_pixel"].get<double>();
  screen.drag(kLiver.first + static_cast<int>(std::lround(grip_px)), kLiver.second, kLiver.first + 22,
              kLiver.second, 1, 0.8);
  ASSERT_TRUE(
      fixtures::until([&] { return shown()["lesions"][0]["radius_mm"].get<double>() > before_mm + 1.0; }, 10.0))
      << "the rim was dragged";
  screen.press("e");
  click_axial(kFlank.first, kFlank.second);
  ASSERT_TRUE(check_is("holding", "entry_on_skin")) << mentor_->now();
  screen.press("ctrl+z");
  ASSERT_TRUE(fixtures::until([&] { return !bench().value("entry", true); }, 10.0)) << "taken back";
  click_axial(kFlank.first, kFlank.second);
  ASSERT_TRUE(
      fixtures::until([&] { return bench().value("entry", false) && !bench().value("checking", true); }, 60.0));
  ASSERT_TRUE(bench()["failing"].empty()) << bench();
  mentor_->keep_picture();
  const auto checked = run(kProgram + " case check " + case_id_ + " --library " + library_, folder_);
  EXPECT_EQ(checked.exit_code, 0) << "the command line says the same\n" << checked.out;

  screen.click(972, 695);  // try it
  ASSERT_TRUE(mentor_->reaches("ready", 60.0)) << mentor_->now();
  ASSERT_NO_FATAL_FAILURE(mentor_->enter_room());
  screen.press("y");
  screen.press("F9");
  ASSERT_TRUE(mentor_->reaches("debrief", 30.0));
  screen.press("Escape");
  ASSERT_TRUE(mentor_->reaches("bench", 10.0));
  const Json attempts = ask("attempt list");
  for (const Json& attempt : attempts["attempts"])
    EXPECT_TRUE(attempt["synthetic"].get<bool>()) << "it was only tried";
  EXPECT_TRUE(attempts["running"].empty());

  screen.click(972, 727);  // publish to my cohort
  ASSERT_TRUE(fixtures::until([&] { return bench().value("state", "") == "published"; }, 60.0)) << mentor_->now();
  mentor_->keep_picture();
  EXPECT_EQ(shown()["state"], "published");
  screen.click(972, 727);  // cases
  ASSERT_TRUE(mentor_->reaches("choose", 10.0));
  screen.click(1200, 23);
  ASSERT_TRUE(mentor_->reaches("log_in", 10.0));
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("tina", kPassword));
  mentor_->keep_picture();
  ASSERT_NO_FATAL_FAILURE(mentor_->open_first_case());
}

}  // namespace
}  // namespace seldinger
