// What a case's needle feels like: the form of its tip, and by which law forces follow (docs/decisions/0088).
#pragma once

#include "sim/base/names.h"

namespace seldinger::cases {

enum class NeedleTip { bevel, diamond, trocar, core };
inline constexpr auto kNeedleTipNames = base::names<NeedleTip>({{NeedleTip::bevel, "bevel"},
                                                                {NeedleTip::diamond, "diamond"},
                                                                {NeedleTip::trocar, "trocar"},
                                                                {NeedleTip::core, "core"}});

// A case's for good.
enum class TouchLaw {
  steady,  // a Chiba's tip, all forces by the needle's diameter, the same at any speed, kept at rest; a nick is not
           // felt
  by_speed,    // tip and shaft by themselves; what opens fast opens at less, what is held relaxes; a nick is felt
  organs_move  // as by_speed, and an organ that the needle presses gives way as a whole (docs/decisions/0093)
};
inline constexpr auto kTouchLawNames = base::names<TouchLaw>(
    {{TouchLaw::steady, "steady"}, {TouchLaw::by_speed, "by_speed"}, {TouchLaw::organs_move, "organs_move"}});
inline constexpr TouchLaw kNewestTouchLaw = TouchLaw::organs_move;

struct Touch {
  NeedleTip tip = NeedleTip::bevel;  // counts by the newest law
  TouchLaw law = TouchLaw::steady;
};

}  // namespace seldinger::cases
