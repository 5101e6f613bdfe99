// The trainer's window as a trainee uses it: a real window on a screen without a monitor, mouse and keys through
// the X server, from logging in to a stored and graded attempt. Pictures of each screen stay in the test's folder.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

// Share of a part of the window for which `holds` is true of red, green, blue.
template <typename Holds>
double share(const fixtures::RgbPicture& picture, const fixtures::Place& part, const Holds& holds) {
  const auto [left, top] = part.at(0.0, 0.0);
  const auto [right, bottom] = part.at(1.0, 1.0);
  int count = 0;
  for (int row = top; row < bottom; ++row)
    for (int column = left; column < right; ++column) {
      const unsigned char* p = picture.at(column, row);
      if (holds(p[0], p[1], p[2])) ++count;
    }
  return count / static_cast<double>((right - left) * (bottom - top));
}

class TrainTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    library_.emplace(fixtures::fresh_folder("train"));
    case_id_ = fixtures::draft_of_course(*library_);
    const fixtures::StraightWay way = fixtures::straight_way(*library_, case_id_);
    target_lps_mm_ = way.target_lps_mm;
    depth_mm_ = glm::distance(way.target_lps_mm, way.entry_lps_mm);
    needle_mm_ = library_->ask("case show " + case_id_)["instrument"]["length_mm"];
    library_->done("case setting " + case_id_ + " --entry-mm " + way.entry() +
                   " --inr 1.1 --platelets 210 --pass 'hit >= 1' --pass 'skin_punctures <= 1'");
    library_->done("case publish " + case_id_ + " --by mona --own-cohort");
  }

  void SetUp() override {
    folder_ = library_->folder() / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_->path(), folder_,
                                                   fixtures::in_small_window());
    ASSERT_FALSE(HasFailure());
  }
  Json now() const { return trainee_->now(); }
  // Before "Imaging seen" is ticked there is imaging to be seen: three planes, with the target's ring on each.
  void see_planning_ct() {
    for (const char* plane : {"Axial", "Coronal", "Sagittal"}) {
      const fixtures::Place place = trainee_->place_of(plane);
      const auto seen = look();
      EXPECT_GT(share(seen, place, [](int r, int g, int b) { return r == g && g == b && r > 60; }), 0.15) << plane;
      EXPECT_GT(share(seen, place, [](int r, int g, int b) { return g > r + 40 && g > b + 40; }), 0.002) << plane;
    }
  }
  // In the debrief: what a number means is one click away, or one key.
  void ask_what_was_measured() {
    const auto shows = [&](const char* name) { return fixtures::until([&] { return trainee_->shows(name); }); };
    trainee_->click("Skin punctures");
    EXPECT_TRUE(shows("Definition of Skin punctures")) << now();
    look();
    trainee_->press("Escape");
    EXPECT_TRUE(fixtures::until([&] { return !trainee_->shows("Definition of Skin punctures"); }));
    EXPECT_EQ(now()["screen"], "debrief") << "Escape closes the definition first";
    trainee_->click("Sentence 1");
    EXPECT_TRUE(shows("Back to the steps (Esc)"));
    trainee_->press("a");
    EXPECT_TRUE(shows("To pass (A)"));
    EXPECT_FALSE(trainee_->shows("Back to the steps (Esc)"));
    look();
    for (std::size_t i = 0; i < 4; ++i) trainee_->press("Down");  // past the sentences
    EXPECT_TRUE(shows("Definition of Target hit")) << now();
    look();
    trainee_->press("Escape");
    trainee_->click("To pass (A)");
    EXPECT_TRUE(shows("All values (A)"));
  }
  // The same of a step, which before opened nothing; and its mark has a legend.
  void ask_what_a_step_is() {
    const auto shows = [&](const char* name) { return fixtures::until([&] { return trainee_->shows(name); }); };
    EXPECT_TRUE(shows("Legend of the steps"));
    trainee_->click("Place the probe on the skin at the entry");
    EXPECT_TRUE(shows("Definition of Place the probe on the skin at the entry")) << now();
    look();
    trainee_->press("Up");
    EXPECT_TRUE(shows("Definition of Choose the probe and check its orientation: move it and look")) << now();
    trainee_->press("Escape");
    EXPECT_TRUE(shows("Legend of the steps"));
    EXPECT_EQ(now()["screen"], "debrief");
    trainee_->press("Up");
    EXPECT_TRUE(shows("Definition of Sign out")) << "the last: " << now();
    trainee_->click("Back to the steps (Esc)");
    EXPECT_TRUE(shows("Legend of the steps"));
  }
  fixtures::RgbPicture look() { return fixtures::read_png(trainee_->keep_picture()); }

  static inline std::optional<fixtures::CommandLibrary> library_;
  static inline std::string case_id_;
  static inline double depth_mm_ = 0.0, needle_mm_ = 0.0;
  static inline glm::dvec3 target_lps_mm_{0.0};
  std::filesystem::path folder_;
  std::unique_ptr<fixtures::Trainee> trainee_;
};

bool grey(int red, int green, int blue) {
  return red == green && green == blue && red > 20;
}
bool skin(int red, int green, int blue) {
  return red > green + 15 && green > blue;
}

TEST_F(TrainTest, AWholeAttemptWithMouseAndKeysIsStoredAndGraded) {
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tina", kPassword));
  EXPECT_EQ(look().width_px, 960);
  ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
  ASSERT_NO_FATAL_FAILURE(see_planning_ct());
  ASSERT_NO_FATAL_FAILURE(trainee_->enter_room());
  trainee_->prepare();
  ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
  const auto picture = trainee_->place_of("picture"), room = trainee_->place_of("room");
  trainee_->test_side();
  // Also a click into the picture: Tab, which then takes the needle, would go to a slider's number, and Space with
  // it.
  const Json face = now()["probe_lps_mm"];
  ASSERT_NO_FATAL_FAILURE(
      trainee_->measure_depth(glm::distance(target_lps_mm_, glm::dvec3(face[0], face[1], face[2]))));
  trainee_->plan_depth(depth_mm_ / needle_mm_);
  const auto scanning = look();
  EXPECT_GT(share(scanning, picture, grey), 0.20) << "speckle on the monitor";
  EXPECT_GT(share(scanning, room, skin), 0.10) << "a patient in the room";
  ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(depth_mm_));
  EXPECT_NEAR(now().value("inserted_mm", 0.0), depth_mm_, 2.0);
  look();
  ASSERT_NO_FATAL_FAILURE(trainee_->fire());
  ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
  look();
  EXPECT_TRUE(trainee_->shows("What is missing"));
  EXPECT_TRUE(trainee_->shows("Next: once more (Enter)")) << "the only case there is";
  ASSERT_NO_FATAL_FAILURE(ask_what_was_measured());
  ASSERT_NO_FATAL_FAILURE(ask_what_a_step_is());
  trainee_->press("w");
  ASSERT_TRUE(trainee_->reaches("watch"));
  const auto again = trainee_->place_of("picture");
  EXPECT_TRUE(fixtures::until([&] { return share(look(), again, grey) > 0.05; })) << "the attempt is shown again";
  trainee_->press("Escape");
  ASSERT_TRUE(trainee_->reaches("debrief"));

  const std::string mine = library_->persons_attempt();
  ASSERT_FALSE(mine.empty());
  const Json shown = library_->ask("attempt show " + mine);
  EXPECT_EQ(shown["end"], "fired");
  EXPECT_EQ(fixtures::metric(shown, "hit"), 1.0);
  EXPECT_EQ(fixtures::metric(shown, "skin_punctures"), 1.0);
  EXPECT_EQ(shown["grade"]["verdict"], "passed") << shown["grade"];
  std::map<std::string, Json> how;  // those that were done
  for (const Json& step : shown["steps"])
    if (step["state"] == "done") how[step["id"].get<std::string>()] = step["how"];
  for (const char* step : {"sign_in", "decide", "anaesthetise", "sign_out"}) EXPECT_EQ(how[step], "said") << step;
  // The two of depth by calipers and slider: clicks beside the picture had measured nothing, and they were skipped.
  for (const char* step : {"check_probe", "note_depth", "insert", "insert_to_depth"})
    EXPECT_EQ(how[step], "shown") << step << ": " << shown["steps"];
  EXPECT_EQ(library_->ask("replay " + mine + " --verify")["verified"], true);
}

// Into skin that is not numb, and beside the target: what went wrong says so, when, and one click plays it.
TEST_F(TrainTest, WhatWentWrongSaysWhenAndPlaysIt) {
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tina", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
  look();
  ASSERT_NO_FATAL_FAILURE(trainee_->enter_room());
  trainee_->press("y");
  ASSERT_TRUE(trainee_->passes(6.0));
  ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(12.0));
  ASSERT_NO_FATAL_FAILURE(trainee_->fire());
  const double fired_s = now().value("attempt_s", 0.0);
  ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
  look();
  EXPECT_TRUE(trainee_->shows("What is missing"));
  EXPECT_FALSE(trainee_->shows("Next: once more (Enter)")) << "it was not passed";
  trainee_->click("Play Target hit");
  ASSERT_TRUE(trainee_->reaches("watch"));
  // It begins shortly before the trigger fell, not at the beginning.
  ASSERT_TRUE(fixtures::until([&] { return now().value("watched_s", 0.0) > 0.0; })) << now();
  EXPECT_GT(now().value("watched_s", 0.0), fired_s - 3.5);
  look();
  trainee_->press("Escape");
  ASSERT_TRUE(trainee_->reaches("debrief"));
  trainee_->click("Play Insert the needle; a patient's skin must be numb");
  ASSERT_TRUE(trainee_->reaches("watch"));
  ASSERT_TRUE(fixtures::until([&] { return now().value("watched_s", 0.0) > 0.0; })) << now();
  trainee_->press("Escape");
  ASSERT_TRUE(trainee_->reaches("debrief"));
  // The same by keys alone: through the sentences to the first criterion, and P.
  for (int i = 0; i < 4; ++i) trainee_->press("Down");
  ASSERT_TRUE(fixtures::until([&] { return trainee_->shows("Definition of Target hit"); })) << now();
  look();
  trainee_->press("p");
  ASSERT_TRUE(trainee_->reaches("watch"));
}

TEST_F(TrainTest, WhoIsNotKnownDoesNotGetIn) {
  trainee_->say_who("tina", "another password");
  EXPECT_TRUE(fixtures::until([&] { return trainee_->shows("refused"); })) << now();
  EXPECT_EQ(now()["screen"], "log_in");
}

// Restart is one key; a pause stops the clock; and a window that is closed in the middle loses nothing.
TEST_F(TrainTest, RestartPauseAndAClosedWindowLoseNothing) {
  const std::size_t before = library_->ask("attempt list")["attempts"].size();
  ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tina", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
  ASSERT_NO_FATAL_FAILURE(trainee_->enter_room());
  ASSERT_TRUE(fixtures::until([&] { return now().value("attempt_s", 0.0) > 1.5; }));
  ASSERT_NO_FATAL_FAILURE(trainee_->begin_again());
  trainee_->press("Escape");
  EXPECT_TRUE(trainee_->stands_still("attempt_s", 0.02, 1.5)) << now();
  look();
  trainee_->program().signal(SIGTERM);
  ASSERT_TRUE(fixtures::until([&] { return trainee_->program().ended(); }));
  EXPECT_EQ(trainee_->program().exit_code(), 0);
  const Json listed = library_->ask("attempt list");
  EXPECT_EQ(listed["attempts"].size(), before + 2);
  EXPECT_TRUE(listed["running"].empty()) << listed["running"];
}

}  // namespace
}  // namespace seldinger
