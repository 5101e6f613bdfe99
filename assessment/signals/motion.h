// The tools' way as metrics of movement see it: 100 times a second, low-passed at 10 Hz (our judgement).
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace seldinger::assessment {

struct Signals;

constexpr double kMotionRateHz = 100.0, kMotionCutoffHz = 10.0;
// The trace's points are no nearer to each other: the noise of a tracker (0.05 mm) makes none.
constexpr double kTraceMm = 0.25;

// 1/100 s of the filtered way, less before a gap and at the end.
struct Step {
  double t_s = 0.0, length_s = 0.0;  // when it begins, how long it lasts
  glm::dvec3 from_lps_mm{0.0}, to_lps_mm{0.0};
  glm::dvec3 rest_from_lps_mm{0.0}, rest_to_lps_mm{0.0};  // of the tissue at the tip, in a patient at rest
  glm::dvec3 probe_from_lps_mm{0.0}, probe_to_lps_mm{0.0};
  glm::dvec3 probe_axial_from{0.0}, probe_axial_to{0.0};  // near unit
  glm::dvec3 probe_lateral_from{0.0}, probe_lateral_to{0.0};
  glm::dvec3 needle_direction{0.0};
  double depth_from_mm = 0.0, depth_to_mm = 0.0;  // of the tip below the skin; negative outside
  bool first = false;                             // nothing is known of the time before
};

// A straight piece of the tip's way through the patient at rest. It starts where the one before ended, unless there
// was a gap.
struct TraceSegment {
  glm::dvec3 from_lps_mm{0.0}, to_lps_mm{0.0};
  glm::dvec3 needle_direction{0.0};
  bool in_body = false;  // at its end
  bool thrown = false;   // a fired core needle's throw
  // When the tip had come to its start, and to its end; between the two it may have rested. Of a throw both are the
  // trigger's.
  double from_s = 0.0, to_s = 0.0;
};

// From the poses and passages of `signals`.
std::vector<Step> steps_of(const Signals& signals);
// From its steps; a core needle's throw ends it.
std::vector<TraceSegment> trace_of(const Signals& signals);

// Zero-phase 4th-order Butterworth low-pass: second order run forward and backward, its cut-off corrected so that
// the two passes together lose 3 dB at cutoff_hz (Winter, Biomechanics, 4th ed. 2009, §2.2.4.4). Ends are continued
// by odd reflection, so that a straight motion stays one.
std::vector<glm::dvec3> low_pass(std::span<const glm::dvec3> positions, double rate_hz, double cutoff_hz);

}  // namespace seldinger::assessment
