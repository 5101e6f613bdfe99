// When the window goes on without a picture that is being made.
#pragma once

#include <optional>

namespace seldinger::app {

// A frame that waits until then still is one of 15 a second and more, with what is left to draw in it.
inline constexpr double kMostFrameS = 0.055;
// A picture may take so much longer than was expected, of the time from the frame's beginning to there.
inline constexpr double kLateShare = 0.25;

// All in seconds of one clock. `expected_s`: when the picture should be there, if one is being made. Then it is
// waited for, and a little longer; one that would be too late for this frame is not waited for at all, since the
// next has it as early. Before began_s: do not wait.
double wait_for_picture_until_s(std::optional<double> expected_s, double began_s) noexcept;

}  // namespace seldinger::app
