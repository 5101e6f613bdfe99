// In windows of every size and letters of every size the picture is the largest part, every button is in sight and
// nothing lies over it. By mouse and keys at the window; pictures of each screen are kept beside the trace.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/window/surface/window_size_json.h"
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/straight_way.h"
#include "tests/fixtures/trainee.h"
#include "tests/fixtures/window_looks.h"

namespace seldinger {
namespace {

using fixtures::area_of;
using fixtures::kPassword;
using fixtures::Place;
using fixtures::WindowLook;
using Json = nlohmann::json;

class TrainLayoutTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    library_.emplace(fixtures::fresh_folder("train_layout"));
    const std::string case_id = fixtures::draft_of_course(*library_);
    library_->done(
        "case setting " + case_id + " --entry-mm " + fixtures::straight_way(*library_, case_id).entry() +
        " --instrument core --throw-mm 22 --difficulty easy --inr 1.1 --platelets 210 --pass 'hit >= 1'");
    library_->done("case publish " + case_id + " --by mona --own-cohort");
  }

  void open(const std::string& name, const std::vector<std::string>& options) {
    folder_ = library_->folder() / name;
    std::filesystem::create_directories(folder_);
    trainee_ = std::make_unique<fixtures::Trainee>(fixtures::kProgram, library_->path(), folder_, options);
  }
  void close() {
    if (!trainee_) return;
    trainee_->program().signal(SIGTERM);
    EXPECT_TRUE(fixtures::until([&] { return trainee_->program().ended(); }));
    trainee_.reset();
  }
  void TearDown() override { close(); }

  void keep(const std::string& name) {
    std::filesystem::copy_file(trainee_->keep_picture(), folder_ / (name + ".png"));
  }
  void expect_in_sight(const WindowLook& look, const std::vector<std::string>& names) {
    fixtures::expect_in_sight(*trainee_, look, names);
  }
  void expect_usable(const WindowLook& look) {
    keep("log_in");
    ASSERT_NO_FATAL_FAILURE(expect_in_sight(look, {"Name", "Password", "Log in"}));
    ASSERT_NO_FATAL_FAILURE(trainee_->log_in("tina", kPassword));
    keep("choose");
    ASSERT_NO_FATAL_FAILURE(expect_in_sight(look, {"Practise", "Hands (F10)", "Log out"}));
    ASSERT_NO_FATAL_FAILURE(trainee_->open_first_case());
    trainee_->click("All checked");
    keep("briefing");
    ASSERT_NO_FATAL_FAILURE(expect_in_sight(look, {"Back", "Enter the room (Enter)"}));
    ASSERT_NO_FATAL_FAILURE(trainee_->enter_room());
    ASSERT_NO_FATAL_FAILURE(expect_in_sight(look, {"room", "picture", "Proceed (Y)", "Defer (N)"}));
    trainee_->press("y");
    std::vector<std::string> buttons = {"room",         "picture",         "F1  Probe checked",
                                        "F3  Aspirate", "F4  Anaesthetic", "F9  Sign out and finish"};
    // With the largest letters in the smallest window these two are keys, and their buttons a scroll away.
    if (look.letters * 800.0 <= look.width)
      buttons.insert(buttons.end(), {"Room larger (Enter)", "F7  Hold your breath"});
    ASSERT_NO_FATAL_FAILURE(trainee_->press_probe_on());
    ASSERT_NO_FATAL_FAILURE(expect_in_sight(look, buttons));
    keep("attempt");
    const Place picture = trainee_->place_of("picture"), room = trainee_->place_of("room");
    EXPECT_GT(area_of(picture), 1.5 * area_of(room));
    std::printf("[ layout     ] %d × %d, letters %.1f: picture %.0f × %.0f, room %.0f × %.0f\n", look.width,
                look.height, look.letters, picture.width_px, picture.height_px, room.width_px, room.height_px);
    const auto room_larger = [&] {
      return area_of(trainee_->place_of("room")) > area_of(trainee_->place_of("picture"));
    };
    trainee_->press("Return");
    EXPECT_TRUE(fixtures::until(room_larger)) << trainee_->now();
    keep("room");
    trainee_->press("Return");
    EXPECT_TRUE(fixtures::until([&] { return !room_larger(); })) << trainee_->now();
    const bool open = trainee_->shows("knob");
    trainee_->press("Home");
    EXPECT_TRUE(fixtures::until([&] { return trainee_->shows("knob") != open; })) << trainee_->now();
    keep(open ? "folded" : "console");
    trainee_->sign_out();
    keep("debrief");
    ASSERT_NO_FATAL_FAILURE(expect_in_sight(look, {"Cases"}));
  }

  static inline std::optional<fixtures::CommandLibrary> library_;
  std::filesystem::path folder_;
  std::unique_ptr<fixtures::Trainee> trainee_;
};

TEST_F(TrainLayoutTest, EveryButtonIsInSightAndThePictureIsLargest) {
  for (const WindowLook& look : fixtures::window_looks()) {
    SCOPED_TRACE(look.name());
    open(look.name(), look.options());
    ASSERT_NO_FATAL_FAILURE(expect_usable(look));
    close();
  }
}

// Kept for the user of the computer, where nobody asks for another.
TEST_F(TrainLayoutTest, ItsSizeIsAsItWasWhenItWasClosed) {
  const std::string state = (library_->folder() / "state").string();
  const char* before = std::getenv("XDG_STATE_HOME");
  const std::optional<std::string> was = before != nullptr ? std::optional<std::string>(before) : std::nullopt;
  setenv("XDG_STATE_HOME", state.c_str(), 1);
  ASSERT_TRUE(app::keep_window_size(app::window_size_file(), {900, 700, false}));
  open("remembered", {"--mute"});
  const auto wide = [&] { return fixtures::read_png(trainee_->keep_picture()).width_px; };
  EXPECT_EQ(wide(), 900);
  trainee_->screen().with_key("alt", [&] { trainee_->press("Return"); });
  EXPECT_EQ(wide(), 1280) << "the whole screen";
  close();
  const auto kept = app::read_window_size(app::window_size_file());
  ASSERT_TRUE(kept);
  EXPECT_EQ(*kept, (app::WindowSize{900, 700, true})) << kept->width << " × " << kept->height;
  open("asked", {"--width", "1000", "--height", "720", "--mute"});
  EXPECT_EQ(wide(), 1000);
  close();
  EXPECT_EQ(app::read_window_size(app::window_size_file()), kept) << "what was asked for once is not kept";
  if (was)
    setenv("XDG_STATE_HOME", was->c_str(), 1);
  else
    unsetenv("XDG_STATE_HOME");
}

}  // namespace
}  // namespace seldinger
