// The way of the tip as metrics of path count it: in steps of kTraceMm and more, however slowly, so that what
// trembles on one spot goes nowhere, and no breath that moves tissue under a hand at rest.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace seldinger::assessment {

struct Signals;

// A tip that comes no further than kTraceMm in this time rests: what is slower than 0.5 mm/s for longer.
constexpr double kRestSeconds = 0.5;
// A movement of less is none.
constexpr double kLeastMovementMm = 1.0;

// Where the tip had come by kTraceMm, both as the hand held it and in the tissue. From the one before on it went as
// the tissue saw it; where it had rested in between, as far as the hand or the tissue moved, whichever moved less.
struct WayPoint {
  double t_s = 0.0;
  glm::dvec3 lps_mm{0.0};  // the tissue's at rest, where it never breathed past a resting hand
  glm::dvec3 needle_direction{0.0};
  double depth_mm = 0.0;  // below the skin; negative outside
  bool first = false;     // nothing is known of the time before
  bool rest = false;      // the last of its stretch, by less than kTraceMm
};

// From the steps of `signals`, in rising time.
std::vector<WayPoint> way_of(const Signals& signals);

// What lies between two rests: from a quarter of a second before the tip had come by kTraceMm to as long after.
struct Movement {
  double from_s = 0.0, to_s = 0.0;
};
std::vector<Movement> movements_of(const Signals& signals);

// Length of the line through points some kTraceMm apart: the mean of those through every second one, ends and turns
// of over 60° kept, which the noise of a tracker lengthens by a quarter of what it adds to the line itself. Never
// shorter than from end to end.
double length_mm(std::span<const glm::dvec3> points_mm);

// A part of the way without a gap, and on one side of the skin: the points that make it, the first and last of them
// on the skin where it goes on beyond.
struct Stretch {
  std::vector<glm::dvec3> points_mm;
  std::vector<glm::dvec3> needle_directions;  // one per point
  bool in_tissue = false;
};
std::vector<Stretch> stretches_of(std::span<const WayPoint> way);

}  // namespace seldinger::assessment
