// Two virtual devices at work on the built-in torso: what `haptics selftest` runs and `bench` replays. A needle
// goes in and out along a plan, a probe presses and slides beside it.
#pragma once

#include <vector>

#include "assessment/operators/plan.h"
#include "sim/base/result.h"
#include "sim/case/case.h"
#include "sim/devices/virtual_arm.h"
#include "sim/haptics/two_hands.h"

namespace seldinger::app {

struct ServoCase {
  cases::Case scene;
  assessment::PuncturePlan plan;
};

// decimate_share: of the skin's triangles, taken away (casedb::SurfaceOptions). Refused as a lesion's site.
base::Result<ServoCase> torso_under_hands(double decimate_share);

// The same body in size³ voxels, each the nearest of before: for time, not for looks.
void refine(cases::Case& scene, int size);

// What the devices say, tick by tick; the same every time.
class HandsAtWork {
 public:
  // `tools`: what does the needle's way, and what the probe's.
  HandsAtWork(const assessment::PuncturePlan& plan, haptics::Handedness handedness,
              std::array<haptics::Tool, 2> tools = {haptics::Tool::needle, haptics::Tool::probe});

  haptics::HandInputs next() noexcept;

 private:
  assessment::PuncturePlan plan_;
  haptics::Handedness handedness_;
  std::array<haptics::Tool, 2> tools_;
  devices::VirtualArm needle_arm_, probe_arm_;
  std::uint64_t tick_ = 0;
};

}  // namespace seldinger::app
