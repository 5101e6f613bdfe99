// Other hands at the trainer's window: a 3-D mouse behind a daemon of the test's, and a gamepad that answers in
// GLFW's place. What they say goes the whole way: their library, the window, the hands, the recording.
#include <gtest/gtest.h>

#include <cstdlib>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "tests/fixtures/command_library.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/spacenav_daemon.h"
#include "tests/fixtures/trainee.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::kPassword;
using fixtures::kProgram;
using fixtures::until;

glm::dvec3 needle_in(const Json& line) {
  const Json at = line.value("needle_lps_mm", Json::array({0, 0, 0}));
  return {at[0], at[1], at[2]};
}
glm::dvec3 needle(const fixtures::Trainee& trainee) {
  return needle_in(trainee.now());
}

// The needle moves by so much, or the time is over.
bool moves(const fixtures::Trainee& trainee, double mm) {
  const glm::dvec3 from = needle(trainee);
  return until([&] { return glm::length(needle(trainee) - from) > mm; });
}

bool rests(fixtures::Trainee& trainee) {
  return trainee.stands_still([](const Json& line) { return needle_in(line); }, 0.5, 1.5);
}

bool holds(const fixtures::Trainee& trainee, const char* tool) {
  return until([&] { return trainee.now().value("held", "") == tool; });
}

void enter(fixtures::Trainee& trainee) {
  ASSERT_NO_FATAL_FAILURE(trainee.log_in("mona", kPassword));
  ASSERT_NO_FATAL_FAILURE(trainee.open_first_case());
  ASSERT_NO_FATAL_FAILURE(trainee.enter_room());
  trainee.press("y");
  ASSERT_TRUE(holds(trainee, "needle"));
}

TEST(TrainHands, AThreeDMouseLeadsTheNeedleAndRestsWhenItsDaemonIsGone) {
  const auto library = fixtures::library_to_try("train_space_mouse", "mpr");
  fixtures::SpacenavDaemon daemon;
  fixtures::Trainee trainee(kProgram, library.path(), library.folder(), fixtures::in_small_window());
  daemon.ready();
  ASSERT_NO_FATAL_FAILURE(enter(trainee));
  daemon.motion({120, 0, 0}, {});
  EXPECT_TRUE(moves(trainee, 10.0)) << trainee.now();
  daemon.motion({0, 0, 0}, {});
  EXPECT_TRUE(rests(trainee));
  for (const char* tool : {"probe", "needle"}) {
    daemon.button(1, true);
    daemon.button(1, false);
    EXPECT_TRUE(holds(trainee, tool)) << "a short press changes the tool";
  }
  daemon.motion({-120, 0, 0}, {});
  EXPECT_TRUE(moves(trainee, 5.0));
  daemon.hang_up();
  EXPECT_TRUE(rests(trainee)) << "nothing drifts on";
  ASSERT_NO_FATAL_FAILURE(trainee.sign_out());
}

TEST(TrainHands, AGamepadLeadsTheNeedleFiresAndMayBeUnplugged) {
  const auto library = fixtures::library_to_try("train_gamepad", "mpr");
  const auto& scratch = library.folder();
  const auto says = [&](const std::string& words) {
    std::ofstream(scratch / "pad.new") << words;
    std::filesystem::rename(scratch / "pad.new", scratch / "pad");
  };
  const std::string still = "0 0 0 0 -1 -1";
  says(still);
  ::setenv("SELDINGER_FAKE_GAMEPAD", (scratch / "pad").c_str(), 1);
  ::setenv("LD_PRELOAD", fixtures::built_target("fake_gamepad").c_str(), 1);
  fixtures::Trainee trainee(kProgram, library.path(), library.folder(), fixtures::in_small_window());
  ::unsetenv("LD_PRELOAD");
  ::unsetenv("SELDINGER_FAKE_GAMEPAD");
  ASSERT_NO_FATAL_FAILURE(enter(trainee));
  says("0.6 0 0 0 -1 -1");
  EXPECT_TRUE(moves(trainee, 3.0)) << trainee.now();
  says("");
  EXPECT_TRUE(rests(trainee)) << "unplugged with its stick held";
  says("0 0 0 0 -1 1");  // the right trigger pushes
  EXPECT_TRUE(until([&] { return trainee.now().value("inserted_mm", 0.0) > 5.0; })) << trainee.now();
  says(still);
  EXPECT_TRUE(rests(trainee));
  says(still + " 2");
  EXPECT_TRUE(holds(trainee, "probe")) << "X takes the other tool";
  says(still);
  EXPECT_TRUE(trainee.passes(0.5)) << "some frames with no button down";
  says(still + " 0");
  EXPECT_TRUE(until([&] { return trainee.now().value("fired", false); })) << "A fires";
  says(still);
  trainee.keep_picture();
  ASSERT_NO_FATAL_FAILURE(trainee.sign_out());
}

}  // namespace
}  // namespace seldinger
