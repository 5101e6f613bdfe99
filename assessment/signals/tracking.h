// Where tracking jumped: the tip went from one pose to the next as no hand leads it. Poses that only for themselves
// are far from their neighbours are put back between them; what is left is not bridged.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/case/event.h"
#include "sim/case/record/recording.h"

namespace seldinger::assessment {

// What is between a pose and the next: nothing, more than kGapSeconds, a jump, or a move of the program's own (a
// needle guide taken up, hands changed, an attempt taken up again).
enum class Gap : std::uint8_t { none, silence, jump, snap };

// Told over 10 ms, or from pose to pose where they are further apart. A quick reach of 0.4 m in 0.5 s peaks at
// 1.5 m/s and 9.2 m/s² (minimum jerk: Flash and Hogan, J. Neurosci. 5 (1985) 1688); a needle is led more slowly.
constexpr double kJumpMmS = 2000.0, kJumpMmS2 = 100'000.0;
constexpr double kJumpBase_s = 0.01;
// What follows another so soon is the same jump: there and back, however often.
constexpr double kSameJump_s = 0.1;

// From one time to another, both in the attempt.
struct TimeSpan {
  double from_s = 0.0, to_s = 0.0;
};

struct Tracking {
  int jumps = 0;             // before anything was repaired; not those of the program's
  int left = 0;              // of these, after
  std::size_t repaired = 0;  // poses
};

// When the program itself may have moved the needle: at the first pose, and by what happened. `events` by rising
// time.
std::vector<TimeSpan> program_moves(std::span<const cases::PoseSample> poses, std::span<const cases::Event> events);

// Repairs poses and says what is between each and the next. A pose is repaired, by interpolation between those
// around it, where it is part of a jump and a Hampel filter (seven poses, three times 1.4826 the median absolute
// deviation; Pearson, IEEE Trans. Control Syst. Technol. 10 (2002) 55) finds it far from the others: at most three
// in a row, and never the first or last before a silence. Poses are at most 200 a second.
Tracking mend(std::span<const TimeSpan> by_program, std::vector<cases::PoseSample>& poses, std::vector<Gap>& gaps);

}  // namespace seldinger::assessment
