// The mentor's bench as a mentor uses it, in a real window: a draft is opened, lesion and entry are clicked, its
// checks go red and green, it is tried, published, and a trainee finds it. Where things are is the window's at 1280
// × 800.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

// Of the axial plane at z = 0, where the cursor begins: air, the liver, skin on the right side.
constexpr std::pair<int, int> kOutside{30, 100}, kLiver{115, 225}, kFlank{45, 235};

class TrainBenchTest : public testing::Test {
 protected:
  void SetUp() override {
    const std::string demo = library_.ask("demo --no-serve")["case_id"];
    for (const char* user : {"mona --role mentor", "tina --role trainee"})
      library_.done(std::string("user add ") + user);
    case_id_ = library_.ask("case version " + demo + " --by mona")["case_id"];  // the demo's has attempts
    library_.done("case lesion " + case_id_ + " --remove " + shown()["lesions"][0]["lesion_id"].get<std::string>());
    library_.done("case setting " + case_id_ + " --title 'From the bench' --pass 'hit >= 1'");
  }
  void sit_down(const std::vector<std::string>& options = {}) {
    mentor_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_.path(), library_.folder(), options);
  }
  Json shown() const { return library_.ask("case show " + case_id_); }
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

  fixtures::CommandLibrary library_{fixtures::fresh_folder("train_bench")};
  std::string case_id_;
  std::unique_ptr<fixtures::Trainee> mentor_;
};

TEST_F(TrainBenchTest, AMentorPlacesChecksAndPublishesAndATraineeFindsIt) {
  sit_down();
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
  const auto checked = library_.call("case check " + case_id_);
  EXPECT_EQ(checked.exit_code, 0) << "the command line says the same\n" << checked.out;

  screen.click(972, 695);  // try it
  ASSERT_TRUE(mentor_->reaches("ready", 60.0)) << mentor_->now();
  ASSERT_NO_FATAL_FAILURE(mentor_->enter_room());
  screen.press("y");
  screen.press("F9");
  ASSERT_TRUE(mentor_->reaches("debrief", 30.0));
  screen.press("Escape");
  ASSERT_TRUE(mentor_->reaches("bench", 10.0));
  const Json attempts = library_.ask("attempt list");
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

// Submitted, returned, submitted again, approved by another, published; and edited afterwards, which is a new
// draft.
TEST_F(TrainBenchTest, TwoMentorsReviewADraftAndEditWhatTheyPublished) {
  const std::string demo = library_.ask("case list")["cases"].at(0)["case_id"];
  const std::string whole = library_.ask("case version " + demo + " --by mona")["case_id"];
  library_.done("case setting " + whole + " --title Reviewed --pass 'hit >= 1' --difficulty easy");
  library_.done("user add rita --role mentor");
  sit_down({"--case", whole});
  ASSERT_FALSE(HasFailure());
  const fixtures::Screen& screen = mentor_->screen();
  const auto state = [&] { return library_.ask("case show " + whole)["state"].get<std::string>(); };
  const auto becomes = [&](const char* wanted) {
    return fixtures::until([&] { return bench().value("state", "") == wanted && !bench().value("checking", true); },
                           60.0) &&
           state() == wanted;
  };
  const auto log_out = [&] {
    screen.click(1115, 727);  // cases, beside it
    ASSERT_TRUE(mentor_->reaches("choose", 10.0)) << mentor_->now();
    screen.click(1200, 23);
    ASSERT_TRUE(mentor_->reaches("log_in", 10.0));
  };
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("mona", kPassword, "bench"));
  ASSERT_TRUE(becomes("draft")) << mentor_->now();
  ASSERT_TRUE(bench()["failing"].empty()) << bench();
  screen.click(1115, 695);  // submit for review
  ASSERT_TRUE(becomes("review")) << mentor_->now();
  mentor_->keep_picture();
  screen.click(1115, 695);  // return to draft
  ASSERT_TRUE(becomes("draft")) << mentor_->now();
  screen.click(1115, 695);
  ASSERT_TRUE(becomes("review")) << mentor_->now();
  screen.click(972, 727);  // approve: not for who made it
  ASSERT_TRUE(fixtures::until([&] { return !bench().value("refusal", "").empty(); }, 10.0)) << mentor_->now();
  ASSERT_NO_FATAL_FAILURE(log_out());
  ASSERT_NO_FATAL_FAILURE(mentor_->log_in("rita", kPassword, "bench"));
  ASSERT_TRUE(becomes("review")) << mentor_->now();
  screen.click(972, 727);  // approve
  std::this_thread::sleep_for(std::chrono::seconds(1));
  screen.click(972, 727);  // publish
  ASSERT_TRUE(becomes("published")) << mentor_->now();
  mentor_->keep_picture();
  screen.click(972, 727);  // cases
  ASSERT_TRUE(mentor_->reaches("choose", 10.0));
  mentor_->keep_picture();
  screen.click(1240, 161);  // edit, of the second one that may be practised
  ASSERT_TRUE(mentor_->reaches("bench", 30.0)) << mentor_->now();
  EXPECT_TRUE(fixtures::until([&] { return bench().value("state", "") == "draft"; }, 10.0)) << mentor_->now();
  EXPECT_EQ(state(), "published") << "trainees keep what they have";
}

}  // namespace
}  // namespace seldinger
