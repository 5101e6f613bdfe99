// A minute at the trainer's window, by a script, in a build that looks for races (preset `thread`): ultrasound and
// fluoroscopy, begun, frozen, begun again, signed out, watched, and closed in the middle.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/trainee.h"
#include "tests/race/ball_library.h"

namespace seldinger {
namespace {

using fixtures::until;

class WindowRace : public testing::Test {
 protected:
  void SetUp() override {
    scratch_ = fixtures::fresh_folder("window_race");
    fixtures::make_ball_library(scratch_ / "library", {cases::Modality::ultrasound, cases::Modality::xray});
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::program(), (scratch_ / "library").string(), scratch_);
  }
  const fixtures::Screen& screen() const { return trainee_->screen(); }
  // What is pressed next is seen in the window's next frame; these are slow here.
  void wait(double seconds) {
    const double from_s = trainee_->now().value("t_s", 0.0);
    EXPECT_TRUE(until([&] { return trainee_->now().value("t_s", 0.0) > from_s + seconds; }, 60.0));
  }
  void begin(int line) {
    trainee_->open_case(line);
    trainee_->enter_room();
    trainee_->press("y");
    wait(1.0);
    trainee_->press("F4");
    trainee_->point_at_room();
  }
  void begin_again() {
    ASSERT_NO_FATAL_FAILURE(trainee_->begin_again());
    trainee_->press("y");
  }
  void sign_out_and_watch() {
    trainee_->press("F9");
    ASSERT_TRUE(trainee_->reaches("debrief", 120.0)) << trainee_->now();
    trainee_->press("w");
    ASSERT_TRUE(trainee_->reaches("watch", 60.0)) << trainee_->now();
    wait(4.0);
    trainee_->press("Escape");
    ASSERT_TRUE(trainee_->reaches("debrief", 60.0)) << trainee_->now();
  }

  std::filesystem::path scratch_;
  std::unique_ptr<fixtures::Trainee> trainee_;
};

TEST_F(WindowRace, AMinuteByUltrasoundAndFluoroscopyHasNone) {
  ASSERT_FALSE(HasFailure());
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in("mona", fixtures::kBallPassword));
  ASSERT_NO_FATAL_FAILURE(begin(0));
  screen().wheel(6, 100);  // the needle, pushed
  wait(2.0);
  trainee_->press("Tab");
  screen().wheel(12, 50);
  const auto [x, y] = trainee_->place_of("room").at(0.5, 0.5);
  screen().drag(x, y, x + 30, y + 20);
  trainee_->press("f");  // frozen; knobs, and live again
  wait(2.0);
  const auto knob = trainee_->place_of("knob");
  screen().drag(knob.at(0.3, 0.5).first, knob.at(0.3, 0.5).second, knob.at(0.7, 0.5).first,
                knob.at(0.7, 0.5).second);
  trainee_->press("f");
  trainee_->press("m");
  wait(2.0);
  ASSERT_NO_FATAL_FAILURE(begin_again());
  trainee_->point_at_room();
  screen().wheel(10, 100);
  trainee_->press("Escape");  // a pause
  wait(2.0);
  trainee_->press("Escape");
  wait(8.0);
  trainee_->press("space");
  wait(5.0);
  ASSERT_NO_FATAL_FAILURE(sign_out_and_watch());
  ASSERT_NO_FATAL_FAILURE(trainee_->leave_debrief());
  ASSERT_NO_FATAL_FAILURE(begin(1));
  screen().hold("p", 4.0);
  screen().hold("Left", 3.0);
  screen().hold("p", 6.0);
  screen().wheel(8, 100);
  wait(4.0);
  ASSERT_NO_FATAL_FAILURE(begin_again());
  screen().hold("p", 5.0);
  ASSERT_NO_FATAL_FAILURE(sign_out_and_watch());
  trainee_->press("F5");
  ASSERT_TRUE(trainee_->reaches("attempt", 60.0)) << trainee_->now();
  wait(4.0);
  EXPECT_GT(trainee_->now().value("t_s", 0.0), 60.0);
  trainee_->program().signal(SIGTERM);
  ASSERT_TRUE(until([&] { return trainee_->program().ended(); }, 60.0));
  const std::string said = fixtures::whole_file(scratch_ / "train.txt");
  EXPECT_EQ(trainee_->program().exit_code(), 0) << said;
  EXPECT_EQ(said.find("ThreadSanitizer"), std::string::npos) << said;
}

}  // namespace
}  // namespace seldinger
