// How deep the hand has pushed the needle: neither breath that slides past a hand at rest nor a needle that goes
// along with the tissue is any of it.
#pragma once

#include <vector>

namespace seldinger::assessment {

struct Signals;

// One per pose, 0 outside the body: the inserted length, where tissue lies still. Where it moves, the length
// changes by what the tip went along the needle both as the hand held it and in the tissue (the lesser of both,
// where both went the same way), and comes nearer to where both have it as long as they go on.
std::vector<double> pushed_mm_of(const Signals& signals);

// One per pose: by how much `pushed_mm` went beyond where it had been; to and fro by under kJiggleMm is none, nor
// is what was before the first pose or in a gap. Once the tip was outside by kJiggleMm it has been nowhere.
std::vector<double> advances_of(const Signals& signals);

}  // namespace seldinger::assessment
