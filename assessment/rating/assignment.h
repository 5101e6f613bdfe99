// Who rates which replays, in which order: a pure function of a seed and of how many there are, so that neither
// persons nor groups nor times can have a part in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace seldinger::assessment::rating {

enum class Part { calibration, rated, repeated };

struct Assigned {
  std::size_t view = 0;  // of the calibration set, or of the replays that are rated: each counts from 0
  Part part = Part::rated;
  bool operator==(const Assigned&) const = default;
};

struct Design {
  std::size_t replays = 0, calibration = 0;
  std::size_t raters = 2, each = 2;  // each replay is rated by so many, at most `raters`
  std::size_t repeats = 0;           // so many a rater rates twice: at most a third of theirs
  std::uint64_t seed = 0;
};
inline constexpr std::size_t kMostRaters = 12;

// What each rater rates, in their order: the calibration set, then the replays, each order of its own. What is
// rated twice comes from a rater's first third and again in their last. Raters' loads differ by one at most, and
// pairs of raters meet as evenly as one replay after the other allows (a balanced incomplete design where there is
// one).
std::vector<std::vector<Assigned>> assigned(const Design& design);

}  // namespace seldinger::assessment::rating
