// In the room every act answers: what is fired, said or asked for shows in words that it is done and what it did.
// By mouse and keys at the window; what is looked for is found by its name in the program's trace.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;

class TrainRoomTest : public testing::Test {
 protected:
  // An easy core biopsy, its entry where straight down leads to the target.
  static void SetUpTestSuite() { open_library("train_room", "--instrument core --throw-mm 22"); }
  static void open_library(const std::string& name, const std::string& instrument, const std::string& target = {}) {
    library_.emplace(fixtures::fresh_folder(name));
    const std::string case_id = fixtures::draft_of_course(*library_);
    way_ = fixtures::straight_way(*library_, case_id);
    if (!target.empty()) {
      const Json was = library_->ask("case show " + case_id)["lesions"][0];
      const std::string lesion = "case lesion " + case_id;
      library_->done(lesion + " --remove " + was["lesion_id"].get<std::string>());
      library_->done(lesion + " --center-mm " + fixtures::place_words(way_.target_lps_mm) + " " + target);
    }
    library_->done("case setting " + case_id + " --entry-mm " + way_.entry() + " " + instrument +
                   " --difficulty easy --inr 1.1 --platelets 210 --pass 'hit >= 1'");
    library_->done("case publish " + case_id + " --by mona --own-cohort");
  }

  void enter(const std::vector<std::string>& options = fixtures::in_small_window()) {
    folder_ = library_->folder() / testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(folder_);
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_->path(), folder_, options);
    ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tina", kPassword));
    ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
    ASSERT_NO_FATAL_FAILURE(trainee_->enter_room());
  }
  // Closed, as by its user: nothing is left that was interrupted.
  void leave() {
    if (!trainee_) return;
    trainee_->program().signal(SIGTERM);
    EXPECT_TRUE(fixtures::until([&] { return trainee_->program().ended(); }));
    trainee_.reset();
  }
  void TearDown() override { leave(); }
  Json now() const { return trainee_->now(); }
  void press(const std::string& key) { trainee_->press(key); }
  // The first item in the newest line whose name has these words in it; empty: none.
  std::string says(const std::string& words) const {
    const Json items = now().value("items", Json::object());
    for (const auto& item : items.items())
      if (item.key().find(words) != std::string::npos) return item.key();
    return {};
  }
  // Since the window opened.
  bool heard(const std::string& sound) const {
    std::ifstream trace(trainee_->trace());
    for (std::string line; std::getline(trace, line);)
      if (line.find('"' + sound + '"') != std::string::npos) return true;
    return false;
  }
  bool comes(const std::string& words) {
    return fixtures::until([&] { return !says(words).empty(); });
  }
  bool goes(const std::string& words) {
    return fixtures::until([&] { return says(words).empty(); });
  }

  static inline std::optional<fixtures::CommandLibrary> library_;
  static inline fixtures::StraightWay way_;
  std::filesystem::path folder_;
  std::unique_ptr<fixtures::Trainee> trainee_;
};

// An open needle into a cyst.
class TrainFlowTest : public TrainRoomTest {
 protected:
  static void SetUpTestSuite() {
    open_library("train_flow", "--instrument access --gauge 18", "--radius-mm 10 --kind cyst");
  }
};

TEST_F(TrainRoomTest, AFireIsHeardSeenAndToldUntilTheNeedleIsOut) {
  ASSERT_NO_FATAL_FAILURE(enter());
  trainee_->prepare();
  ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(25.0));
  press("F4");
  EXPECT_TRUE(comes("about the needle’s tip, which is 2")) << "where it is injected: " << now();
  EXPECT_TRUE(says("fired").empty()) << says("fired");
  press("space");
  EXPECT_TRUE(comes("flash")) << now();
  const double pushed_mm = now().value("inserted_mm", 0.0);
  ASSERT_TRUE(comes("fired, 22 mm; ")) << now();
  const std::string told = says("fired, 22 mm; ");
  EXPECT_NEAR(std::strtod(told.c_str() + std::string("fired, 22 mm; ").size(), nullptr), pushed_mm + 22.0, 2.0)
      << told;
  EXPECT_TRUE(comes("fired, 22 mm at the picture")) << now();
  EXPECT_TRUE(comes("Fired: the tip was thrown 22 mm on.")) << now();
  EXPECT_TRUE(goes("flash")) << "it is over in a moment";
  trainee_->keep_picture();
  EXPECT_TRUE(heard("shot"));
  // The thrown tip comes out last: the hand has drawn 25 mm when 22 mm of it are still in.
  trainee_->screen().wheel(-18, 60);
  ASSERT_TRUE(fixtures::until([&] { return now().value("inserted_mm", 99.0) < 12.0; })) << now();
  EXPECT_TRUE(comes("of the needle is in")) << "still in: " << now();
  EXPECT_TRUE(comes("fired, 22 mm at the picture")) << now();
  trainee_->screen().hold("Prior", 2.0);
  EXPECT_TRUE(comes("fired, 22 mm; the needle is outside")) << now();
  EXPECT_TRUE(goes("fired, 22 mm at the picture")) << now();
  trainee_->keep_picture();
}

TEST_F(TrainRoomTest, WhatIsSaidShowsThatItIsDoneAndWhatItDid) {
  ASSERT_NO_FATAL_FAILURE(enter());
  press("F4");
  EXPECT_TRUE(comes("First decide")) << "nothing is said unheard: " << now();
  trainee_->click("Proceed (Y)");
  EXPECT_TRUE(comes("Decided")) << now();
  press("F1");
  EXPECT_TRUE(comes("its marker’s side is the picture’s left")) << now();
  EXPECT_TRUE(comes("✓ F1"));
  trainee_->click("F2  Entry and depth noted");
  EXPECT_TRUE(comes("Not noted: no depth is set")) << now();
  trainee_->plan_depth(0.4);
  EXPECT_TRUE(comes("planned needle depth of ")) << now();
  EXPECT_TRUE(comes("✓ F2  Entry and depth noted"));
  press("F3");
  EXPECT_TRUE(comes("no blood comes")) << now();
  EXPECT_TRUE(says("✓ F4").empty());
  press("F4");
  EXPECT_TRUE(comes("Numb: skin and path, 15 mm about where the needle points (15 mm from its tip)")) << now();
  EXPECT_TRUE(comes("✓ F4"));
  press("F6");
  EXPECT_TRUE(comes("nicked where the needle points")) << now();
  press("slash");
  EXPECT_TRUE(comes("You now hold the introducer with its stylet in. It is wider than the needle.")) << now();
  press("slash");
  EXPECT_TRUE(comes("The introducer is put down.")) << now();
  press("F7");
  EXPECT_TRUE(comes("Now the breath is held")) << now();
  press("F8");
  EXPECT_TRUE(comes("may breathe again")) << now();
  EXPECT_TRUE(goes("breath is held")) << now();
  trainee_->keep_picture();
}

TEST_F(TrainFlowTest, AnOpenNeedleTellsWhatItIsInAndContrastRunsIn) {
  ASSERT_NO_FATAL_FAILURE(enter());
  trainee_->prepare();
  press("slash");
  EXPECT_TRUE(comes("nothing comes out of the open needle")) << "in the air: " << now();
  press("backslash");
  EXPECT_TRUE(comes("the contrast drips away")) << now();
  press("slash");
  EXPECT_TRUE(comes("The stylet is back in.")) << now();
  ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(glm::distance(way_.entry_lps_mm, way_.target_lps_mm)));
  trainee_->keep_picture();
  press("slash");
  EXPECT_TRUE(comes("The stylet is out: watch what comes back.")) << now();
  EXPECT_TRUE(comes("reaction")) << "and over the room: " << now();
  EXPECT_TRUE(comes("fluid drips from the open needle")) << now();
  trainee_->keep_picture();
  press("F3");
  EXPECT_TRUE(comes("Aspirated through the needle: fluid comes.")) << now();
  press("backslash");
  EXPECT_TRUE(comes("Injecting contrast: 2 ml.")) << now();
  EXPECT_TRUE(comes("contrast is running in")) << now();
  EXPECT_TRUE(goes("contrast is running in")) << now();
  press("slash");
  EXPECT_TRUE(comes("The stylet is back in.")) << now();
  EXPECT_TRUE(goes("from the open needle")) << now();
}

TEST_F(TrainRoomTest, TheGuidesLineIsInThePictureAndWordsSayWhenThereIsNone) {
  ASSERT_NO_FATAL_FAILURE(enter());
  press("y");
  ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
  ASSERT_NO_FATAL_FAILURE(trainee_->take("needle"));
  EXPECT_FALSE(trainee_->shows("guide line"));
  press("g");
  EXPECT_TRUE(comes("guide line")) << now();
  EXPECT_TRUE(comes("The needle is in its guide")) << now();
  ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(40.0));
  trainee_->keep_picture();
  press("g");
  EXPECT_TRUE(comes("It is in tissue: withdraw it before G")) << now();
  EXPECT_TRUE(goes("guide line"));
  press("g");  // refused, in the same words
  EXPECT_TRUE(trainee_->passes(0.6));
  EXPECT_FALSE(trainee_->shows("guide line"));
  EXPECT_FALSE(says("It is in tissue").empty());
}

TEST_F(TrainRoomTest, ViewsHaveNamesAndKeepTheirZoom) {
  ASSERT_NO_FATAL_FAILURE(enter({}));  // a small window has no room for the names
  press("y");
  EXPECT_TRUE(trainee_->shows("View: operator’s side (1)")) << now();
  press("6");
  EXPECT_TRUE(comes("View: along the needle (6)"));
  trainee_->keep_picture();
  press("8");
  EXPECT_TRUE(comes("View: along the picture’s plane (8)"));
  trainee_->point_at_room();
  trainee_->screen().with_key("alt", [&] { trainee_->screen().wheel(5, 60); });
  EXPECT_TRUE(comes("View: along the picture’s plane (8), 1.7×")) << now();
  trainee_->keep_picture();
  EXPECT_EQ(now().value("inserted_mm", -1.0), 0.0) << "the camera's wheel pushes nothing";
  trainee_->click("View: along the picture’s plane (8), 1.7×");
  trainee_->click("head end (2)");
  EXPECT_TRUE(comes("View: head end (2), 1.7×")) << now();
  press("2");
  EXPECT_TRUE(fixtures::until([&] { return trainee_->shows("View: head end (2)"); })) << now();
}

TEST_F(TrainRoomTest, DepthsStandBesideThePictureWithTheirNumbersAndTheFocusHasItsMark) {
  ASSERT_NO_FATAL_FAILURE(enter());
  press("y");
  const auto below = trainee_->place_of("depth below the face");
  const double shown_mm = now().value("depth_mm", 0.0);
  const auto y_of = [&](double mm) { return below.y_px + mm / shown_mm * below.height_px; };
  for (const int cm : {1, 5, 8}) {
    const auto mark = trainee_->place_of("depth " + std::to_string(cm));
    EXPECT_NEAR(mark.y_px + 0.5 * mark.height_px, y_of(10.0 * cm), 1.0) << cm;
    EXPECT_GE(mark.x_px, below.x_px + below.width_px) << "beside the picture, not over it";
  }
  EXPECT_FALSE(trainee_->shows("focus mark")) << "at every depth";
  for (int i = 0; i < 3; ++i) press("bracketright");
  ASSERT_TRUE(comes("focus mark")) << now();
  // Of one line: the next may tell of a focus that has gone on.
  EXPECT_TRUE(fixtures::until([&] {
    const Json line = now(), items = line.value("items", Json::object());
    const auto focus = items.find("focus mark");
    return focus != items.end() &&
           std::abs(double{(*focus)[1]} + 0.5 * double{(*focus)[3]} - y_of(line.value("focus_mm", 0.0))) <= 1.0;
  })) << now();
  trainee_->keep_picture();
  for (int i = 0; i < 12; ++i) press("Down");  // deep: numbers stay apart
  ASSERT_TRUE(fixtures::until([&] { return now().value("depth_mm", 0.0) > shown_mm + 50.0; }));
  const Json items = now()["items"];
  double last_px = -1e9;
  for (int cm = 1; cm < 40; ++cm) {
    const auto mark = items.find("depth " + std::to_string(cm));
    if (mark == items.end()) continue;
    const double top_px = (*mark)[1];
    EXPECT_GE(top_px, last_px + 14.0) << cm;
    last_px = top_px;
  }
  EXPECT_GT(last_px, 0.0);
  trainee_->keep_picture();
}

// As a recording has it: what the lamps say, the attempt's frames do.
TEST_F(TrainRoomTest, LampsTellWhetherTipAndTargetAreInThePicture) {
  ASSERT_NO_FATAL_FAILURE(enter());
  press("y");
  EXPECT_TRUE(comes("tip not in the picture")) << now();
  ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
  EXPECT_TRUE(fixtures::until([&] { return trainee_->shows("target in the picture"); })) << now();
  ASSERT_NO_FATAL_FAILURE(trainee_->take("needle"));
  press("g");
  ASSERT_TRUE(comes("The needle is in its guide")) << now();
  // In the wall's muscle, which lies from 20 to 40 mm on its way: liver behind it is brighter and hides a tip that
  // the beams meet so aslant (docs/decisions/0106).
  ASSERT_NO_FATAL_FAILURE(trainee_->push_needle_to(30.0));
  EXPECT_TRUE(fixtures::until([&] { return trainee_->shows("tip in the picture"); })) << now();
  trainee_->keep_picture();
  press("f");
  EXPECT_TRUE(comes("the picture is frozen")) << now();
  press("f");
  // Out of the skin again: within, a tip in its guide stays in the picture.
  for (int i = 0; i < 10 && now().value("inserted_mm", 0.0) > 0.0; ++i) {
    trainee_->screen().hold("Prior", 1.0);
    ASSERT_TRUE(trainee_->passes(0.3));
  }
  EXPECT_TRUE(comes("tip not in the picture")) << now();
  ASSERT_NO_FATAL_FAILURE(trainee_->sign_out());
  const Json frames_seen = library_->ask("attempt show " + library_->persons_attempt());
  EXPECT_EQ(frames_seen["conditions"]["help_level"], 2) << "the help is noted";
}

// What comes and goes by itself stands where nothing is pressed or looked at.
TEST_F(TrainRoomTest, NoNoticeCoversThePictureOrAButton) {
  for (const auto& [wide, high] : {std::pair{1280, 800}, std::pair{960, 640}}) {
    ASSERT_NO_FATAL_FAILURE(enter({"--width", std::to_string(wide), "--height", std::to_string(high)}));
    trainee_->prepare();
    press("m");
    press("t");
    Json items;
    ASSERT_TRUE(fixtures::until([&] {
      items = now().value("items", Json::object());
      return items.contains("notice") && items.contains("note");
    })) << now();
    EXPECT_TRUE(items.contains("F9  Sign out and finish")) << "in sight at " << wide << ": " << items;
    for (const char* toast : {"notice", "note"}) {
      const Json& a = items[toast];
      EXPECT_LE(a[0].get<double>() + a[2].get<double>(), wide) << toast << " at " << wide;
      for (const auto& [name, b] : items.items()) {
        if (name == toast) continue;
        const bool apart = a[0].get<double>() + a[2].get<double>() <= b[0].get<double>() ||
                           b[0].get<double>() + b[2].get<double>() <= a[0].get<double>() ||
                           a[1].get<double>() + a[3].get<double>() <= b[1].get<double>() ||
                           b[1].get<double>() + b[3].get<double>() <= a[1].get<double>();
        EXPECT_TRUE(apart) << toast << " over " << name << " at " << wide << ": " << a << " " << b;
      }
    }
    trainee_->keep_picture();
    leave();
  }
}

}  // namespace
}  // namespace seldinger
