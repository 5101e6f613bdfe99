// Hints follow what the picture shows and how far hands have come; they fade, and tell of no target that is unseen.
#include "app/window/hands/coach.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/fixtures/meshes.h"

namespace seldinger::app {
namespace {

// A ball 30 mm below the face's middle, the planned entry 30 mm beside it: straight there is 45°.
class CoachTest : public testing::Test {
 protected:
  CoachTest() {
    scene_.subject = cases::Subject::phantom;
    scene_.picture.modality = cases::Modality::ultrasound;
    scene_.lesions = {cases::Lesion{{0.0, 30.0, 0.0}, 6.0, 0.0}};
    scene_.planned_entry_lps_mm = glm::dvec3(30.0, 0.0, 0.0);
    cases::State& state = seen_.moment.state;
    state.probe.axial = {0.0, 1.0, 0.0};
    state.probe.lateral = {1.0, 0.0, 0.0};
    state.needle.tip_lps_mm = {60.0, -20.0, 0.0};
    state.needle.direction = {0.0, 1.0, 0.0};
    cases::FrameTruth frame;
    frame.live = true;
    seen_.frame = frame;
  }
  std::string hint(int help = 2) const { return hint_words(scene_, seen_, help); }
  static bool has(const std::string& words, const char* part) { return words.find(part) != std::string::npos; }

  cases::Case scene_;
  Seen seen_;
};

TEST_F(CoachTest, LeadsFromTheSkinToTheTarget) {
  EXPECT_TRUE(has(hint(), "Press the probe on"));
  seen_.press_mm = 2.0;
  seen_.moment.state.probe.origin_lps_mm.x = -20.0;
  EXPECT_TRUE(has(hint(), "The probe is 50.0 mm from the green entry")) << hint();
  EXPECT_TRUE(has(hint(), "take the probe (Tab)")) << hint();
  seen_.held = devices::HeldTool::probe;
  EXPECT_TRUE(has(hint(), "slide it to the right by 50.0 mm (drag, or D)")) << hint();
  seen_.moment.state.probe.origin_lps_mm.x = 20.0;
  EXPECT_TRUE(has(hint(), "Look for the target"));
  EXPECT_FALSE(has(hint(), " mm ")) << "nothing is told of a target that is not in the picture";
  seen_.frame->target = true;
  cases::State& state = seen_.moment.state;
  state.probe.origin_lps_mm.x = 12.0;
  EXPECT_TRUE(has(hint(), "12.0 mm beside the picture’s middle")) << hint();
  state.probe.origin_lps_mm.x = 0.0;
  state.probe.origin_lps_mm.z = 5.0;
  EXPECT_TRUE(
      has(hint(), "misses the target’s middle by 5.0 mm and the green entry by 5.0 mm: slide it down by 5.0"))
      << hint();
  state.probe.origin_lps_mm.z = 0.0;
  state.probe.lateral = {0.6, 0.0, 0.8};
  EXPECT_TRUE(has(hint(), "by 0.0 mm and the green entry by 24.0 mm: rotate it by 53° (middle drag to the right"))
      << hint();
  state.probe.lateral = {1.0, 0.0, 0.0};
  EXPECT_TRUE(has(hint(), "36.1 mm from the green entry: take the needle (Tab)")) << hint();
  seen_.held = devices::HeldTool::needle;
  EXPECT_TRUE(has(hint(), "move it to the left by 30.0 mm (drag, or A)")) << hint();
  state.needle.tip_lps_mm = {30.0, -2.0, 0.0};
  EXPECT_TRUE(has(hint(), "points 43.2° off the target: turn its hub to the right by 43° (right drag, or"))
      << hint();
  state.needle.direction = glm::normalize(scene_.lesions[0].center_lps_mm - state.needle.tip_lps_mm);
  EXPECT_TRUE(has(hint(), "aimed: advance it")) << hint();
  seen_.inserted = true;
  seen_.inserted_mm = 20.0;
  state.needle.tip_lps_mm = scene_.lesions[0].center_lps_mm - 14.0 * state.needle.direction;
  state.probe.origin_lps_mm.z = 1.5;
  EXPECT_TRUE(has(hint(), "Stop: the picture does not show the tip, which is 1.5 mm off its plane")) << hint();
  state.probe.origin_lps_mm.z = 0.5;
  EXPECT_TRUE(has(hint(), "47° off square")) << hint();
  EXPECT_TRUE(has(hint(), "take the probe (Tab)")) << hint();
  seen_.held = devices::HeldTool::probe;
  EXPECT_TRUE(has(hint(), "rock it by 10° (right drag to the right, or L)")) << hint();
  const double rocked = 18.0 * std::numbers::pi / 180.0;  // its beams come from where the needle does
  state.probe.axial = {std::sin(rocked), std::cos(rocked), 0.0};
  state.probe.lateral = {std::cos(rocked), -std::sin(rocked), 0.0};
  seen_.held = devices::HeldTool::needle;
  EXPECT_TRUE(has(hint(), "advance a little")) << hint();
  scene_.skin_index = cases::MeshIndex(fixtures::box_mesh({-80, 0, -60}, {80, 100, 60}));
  state.probe.origin_lps_mm.y = -5.0;
  EXPECT_TRUE(has(hint(), "has lifted off the skin above the tip: press it on: take the probe (Tab)")) << hint();
  state.probe.origin_lps_mm.y = 5.0;
  EXPECT_TRUE(has(hint(), "advance a little")) << hint();
  state.probe.origin_lps_mm.y = 0.0;
  seen_.frame->needle_tip = true;
  EXPECT_TRUE(has(hint(), "Advance: 14.0 mm to the target’s middle")) << hint();
  state.needle.tip_lps_mm = scene_.lesions[0].center_lps_mm + 4.0 * state.needle.direction;
  EXPECT_TRUE(has(hint(), "Pull back: 4.0 mm too deep")) << hint();
  state.needle.tip_lps_mm = scene_.lesions[0].center_lps_mm + 2.0 * state.needle.direction;
  EXPECT_TRUE(has(hint(), "in the target: say so (Space)")) << hint();
  state.fire.fired = true;
  EXPECT_TRUE(has(hint(), "Finish (F9)")) << hint();
}

TEST_F(CoachTest, SaysThatAWayMissesBeforeItIsTooLate) {
  seen_.press_mm = 2.0;
  seen_.inserted = seen_.frame->target = seen_.frame->needle_tip = true;
  seen_.moment.state.needle.tip_lps_mm = {7.0, 5.0, 0.0};
  EXPECT_TRUE(has(hint(), "misses the target’s middle by 7.0 mm")) << hint();
  // Was: "the tip is in the target", beside it at its depth.
  seen_.moment.state.needle.tip_lps_mm = {7.0, 29.0, 0.0};
  EXPECT_TRUE(has(hint(), "misses the target’s middle by 7.0 mm")) << hint();
}

// Beams of a curved face fan out: at its edge they meet a needle squarely that those of a straight one do not.
TEST_F(CoachTest, TellsHowBeamsOfACurvedFaceMeetTheNeedle) {
  seen_.press_mm = 2.0;
  seen_.inserted = seen_.frame->target = true;
  seen_.inserted_mm = 20.0;
  cases::State& state = seen_.moment.state;
  state.needle.direction = glm::normalize(glm::dvec3(-1.0, 0.8, 0.0));  // 39° to the face
  state.needle.tip_lps_mm = scene_.lesions[0].center_lps_mm - 30.0 * state.needle.direction;
  EXPECT_TRUE(has(hint(), "39° off square")) << hint();
  scene_.picture.probe = "C5-2v";
  EXPECT_TRUE(has(hint(), "advance a little")) << hint();
  EXPECT_FALSE(has(hint(), "off square")) << hint();
}

TEST_F(CoachTest, FadesAndIsForDrillsOnly) {
  seen_.press_mm = 2.0;
  seen_.frame->target = true;
  EXPECT_TRUE(has(hint(2), " mm "));
  EXPECT_FALSE(hint(1).empty());
  EXPECT_FALSE(has(hint(1), " mm ")) << hint(1);
  EXPECT_EQ(hint(0), "");
  scene_.approach = cases::Approach::out_of_plane;
  EXPECT_TRUE(has(hint(), "cross the picture")) << hint();
  scene_.subject = cases::Subject::patient;
  EXPECT_EQ(hint(), "");
  scene_.subject = cases::Subject::phantom;
  scene_.picture.modality = cases::Modality::xray;
  EXPECT_EQ(hint(), "");
}

}  // namespace
}  // namespace seldinger::app
