// How smooth a movement is. Both are the nearer to 0, the smoother, and do not depend on how long or how far it
// went.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

namespace seldinger::assessment {

struct Signals;

// Log dimensionless jerk of one movement, −ln(T³/v_peak² ∫‖jerk‖² dt), sampled from its beginning to its end
// (Balasubramanian et al., IEEE Trans. Biomed. Eng. 59, 2012). Nothing of under four samples or where nothing
// moved.
std::optional<double> log_dimensionless_jerk(std::span<const glm::dvec3> positions, double rate_hz);
// The same of the filtered way between two times; nothing where a gap is between them, too.
std::optional<double> log_dimensionless_jerk(const Signals& signals, double from_s, double to_s);

// Spectral arc length of one movement's speed (SPARC: Balasubramanian et al., J. NeuroEng. Rehabil. 12 (2015) 112,
// with its parameters: up to 10 Hz, above 5 % of the largest amplitude, four more powers of two of zeros). Nothing
// of under four samples or where nothing moved.
std::optional<double> spectral_arc_length(std::span<const double> speeds_mm_s, double rate_hz);

}  // namespace seldinger::assessment
