// Before the room and after it, in windows and letters of several sizes: the trainee looks at the planning CT and
// plans a way, which is kept and compared with what was done; a drill's attempt is watched slowly, with marks and
// captions, beside an expert's; and one's own attempts follow on each other. Pictures of each screen are kept.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"
#include "tests/fixtures/window_looks.h"

namespace seldinger {
namespace {

using fixtures::kPassword;
using fixtures::Place;
using fixtures::WindowLook;
using Json = nlohmann::json;

class TrainPlanTest : public testing::Test {
 protected:
  void open(const fixtures::CommandLibrary& library, const WindowLook& look) {
    folder_ = library.folder() / look.name();
    std::filesystem::create_directories(folder_);
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library.path(), folder_, look.options());
  }
  void close() {
    if (!trainee_) return;
    trainee_->program().signal(SIGTERM);
    EXPECT_TRUE(fixtures::until([&] { return trainee_->program().ended(); }));
    trainee_.reset();
  }
  void TearDown() override { close(); }

  Json now() const { return trainee_->now(); }
  void keep(const std::string& name) {
    std::filesystem::copy_file(trainee_->keep_picture(), folder_ / (name + ".png"));
  }
  // The first item that begins so; empty: none.
  std::string says(const std::string& begins) const {
    const Json items = now().value("items", Json::object());
    for (const auto& item : items.items())
      if (item.key().starts_with(begins)) return item.key();
    return {};
  }
  bool comes(const std::string& begins) {
    return fixtures::until([&] { return !says(begins).empty(); });
  }
  static double number_in(const std::string& words, const std::string& after) {
    const auto at = words.find(after);
    return at == std::string::npos ? std::nan("") : std::strtod(words.c_str() + at + after.size(), nullptr);
  }
  void enter_and_decide(bool patient) {
    if (patient) trainee_->click("All checked");
    trainee_->click("Enter the room (Enter)");
    ASSERT_TRUE(trainee_->reaches("attempt")) << now();
    ASSERT_TRUE(fixtures::until([&] { return now().value("attempt_s", 0.0) > 0.5; })) << now();
    if (patient) trainee_->press("y");
  }

  void plan(const WindowLook& look) {
    ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tina", kPassword));
    ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
    trainee_->click("Look closer and plan (P)");
    ASSERT_TRUE(comes("No path is planned yet")) << now();
    ASSERT_TRUE(comes("in 3-D")) << now();
    keep("planning");
    ASSERT_NO_FATAL_FAILURE(
        fixtures::expect_in_sight(*trainee_, look,
                                  {"Axial", "Coronal", "Sagittal", "in 3-D", "Entry (1)", "Tip (2)",
                                   "As proposed (3)", "No plan (Backspace)", "Back to the briefing (P)"}));
    trainee_->click("As proposed (3)");
    ASSERT_TRUE(comes("Your path: ")) << now();
    const double proposed_mm = number_in(says("Your path: "), "Your path: ");
    EXPECT_GT(proposed_mm, 10.0);
    // A click beside the axial picture's middle is another tip, further in than the entry's own plane.
    trainee_->press("2");
    trainee_->click("Axial", 0.55, 0.6);
    ASSERT_TRUE(fixtures::until([&] {
      return std::abs(number_in(says("Your path: "), "Your path: ") - proposed_mm) > 1.0;
    })) << now();
    trainee_->press("BackSpace");
    ASSERT_TRUE(comes("No path is planned yet")) << now();
    trainee_->press("3");
    ASSERT_TRUE(fixtures::until([&] { return number_in(says("Your path: "), "Your path: ") == proposed_mm; }))
        << now();
    keep("planned");
    planned_mm_ = proposed_mm;
    trainee_->press("Escape");
    ASSERT_TRUE(comes("Your plan (P)")) << now();
    keep("briefing");
  }

  void do_and_compare(double pushed_mm) {
    ASSERT_NO_FATAL_FAILURE(enter_and_decide(true));
    trainee_->press("F2");
    ASSERT_TRUE(comes("Entry noted, and the needle is planned to go in by ")) << now();
    EXPECT_NEAR(number_in(says("Entry noted"), "planned to go in by "), planned_mm_, 1.01);
    ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(pushed_mm));
    ASSERT_NO_FATAL_FAILURE(trainee_->fire());
    ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
    keep("debrief");
    ASSERT_TRUE(comes("Depth: ")) << now();
    EXPECT_NEAR(number_in(says("Depth: "), "Depth: "), pushed_mm, 3.0) << says("Depth: ");
    EXPECT_NEAR(number_in(says("Depth: "), "planned "), planned_mm_, 1.01) << says("Depth: ");
    EXPECT_LT(number_in(says("Entry: "), "Entry: "), 10.0) << "hands begin over the entry: " << says("Entry: ");
    EXPECT_FALSE(says("Direction: ").empty());
  }

  void watch_slowly() {
    trainee_->click("Watch it again (W)");
    ASSERT_TRUE(trainee_->reaches("watch")) << now();
    ASSERT_TRUE(comes("marks")) << now();
    trainee_->click("¼ ×");
    const double from_s = now().value("watched_s", 0.0), from_wall_s = now().value("t_s", 0.0);
    ASSERT_TRUE(trainee_->passes(2.0));
    const double gone_s = now().value("watched_s", 0.0) - from_s, wall_s = now().value("t_s", 0.0) - from_wall_s;
    EXPECT_GT(gone_s, 0.0);
    EXPECT_LT(gone_s, 0.5 * wall_s) << "slow motion";
    EXPECT_TRUE(comes("Caption: ")) << now();
    keep("replay");
    trainee_->click("4 ×");
    EXPECT_TRUE(comes("Caption: Over: this is the moment in which it was fired.")) << now();
    keep("replay_over");
    trainee_->press("Escape");
    ASSERT_TRUE(trainee_->reaches("debrief")) << now();
  }

  std::filesystem::path folder_;
  std::unique_ptr<fixtures::Trainee> trainee_;
  double planned_mm_ = 0.0;
};

TEST_F(TrainPlanTest, AWayIsPlannedKeptAndComparedWithWhatWasDone) {
  const fixtures::CommandLibrary library(fixtures::fresh_folder("train_plan"));
  const std::string case_id = fixtures::draft_of_course(library);
  library.done("case setting " + case_id + " --entry-mm " + fixtures::straight_way(library, case_id).entry() +
               " --instrument core --throw-mm 22 --difficulty easy --inr 1.1 --platelets 210 --pass 'hit >= 1'");
  library.done("case publish " + case_id + " --by mona --own-cohort");
  for (const WindowLook& look : fixtures::window_looks()) {
    SCOPED_TRACE(look.name());
    open(library, look);
    ASSERT_NO_FATAL_FAILURE(plan(look));
    ASSERT_NO_FATAL_FAILURE(do_and_compare(20.0));
    if (look.width == 800) {
      ASSERT_NO_FATAL_FAILURE(watch_slowly());
    }
    close();
  }
  const Json kept = library.ask("attempt show " + library.persons_attempt())["conditions"];
  for (const char* condition : {"planned_entry_x_mm", "planned_entry_y_mm", "planned_entry_z_mm",
                                "planned_tip_x_mm", "planned_tip_y_mm", "planned_tip_z_mm"})
    EXPECT_TRUE(kept.contains(condition) && kept[condition].is_number()) << condition << " in " << kept;
}

TEST_F(TrainPlanTest, ADrillIsWatchedBesideAnExpertsAndAttemptsFollowOnEachOther) {
  const fixtures::CommandLibrary library(fixtures::fresh_folder("train_after"));
  library.demo("--drills");
  library.done("user add tina --role trainee");
  for (const WindowLook& look : fixtures::window_looks()) {
    SCOPED_TRACE(look.name());
    open(library, look);
    ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tina", kPassword));
    ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
    ASSERT_NO_FATAL_FAILURE(enter_and_decide(false));
    ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(15.0));
    ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
    ASSERT_NO_FATAL_FAILURE(trainee_->begin_again());
    ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
    EXPECT_TRUE(comes("What is missing")) << now();
    EXPECT_TRUE(comes("For each, oldest first")) << now();
    keep("after");
    trainee_->click("Mine beside the expert’s (B)");
    ASSERT_TRUE(trainee_->reaches("watch")) << now();
    ASSERT_TRUE(comes("marks")) << now();
    ASSERT_NO_FATAL_FAILURE(fixtures::expect_in_sight(
        *trainee_, look,
        {"Yours", "Simulated expert", "picture", "picture#2", "room", "room#2", "time", "Back (Esc)"}));
    EXPECT_TRUE(comes("Simulated expert: ")) << "captions: " << now();
    keep("beside");
    trainee_->press("Escape");
    ASSERT_TRUE(trainee_->reaches("debrief")) << now();
    close();
  }
}

}  // namespace
}  // namespace seldinger
