// The tip's way.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "assessment/metrics/metric.h"

namespace seldinger::assessment {

Measured path_tip(const Signals& signals);

// Zero-phase 4th-order Butterworth low-pass: second order run forward and backward, its cut-off corrected so that
// the two passes together lose 3 dB at cutoff_hz (Winter, Biomechanics, 4th ed. 2009, §2.2.4.4). Ends are continued
// by odd reflection, so that a straight motion stays one.
std::vector<glm::dvec3> low_pass(std::span<const glm::dvec3> positions, double rate_hz, double cutoff_hz);

}  // namespace seldinger::assessment
