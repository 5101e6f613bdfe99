// Probes: what the transducer is, what it can be set to, and how wide its beam is at a depth. Ultrasound and the
// room share it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

namespace seldinger::imaging {

struct Probe {
  std::string_view name;
  double frequency_mhz;
  int elements;
  double pitch_mm;
  double radius_mm;  // of the face's curve; 0: a straight (linear) one
  double height_mm, elevation_focus_mm;
  double aperture_mm;  // the widest that focuses one line
  double f_number;     // aperture grows with depth at this ratio until it is the widest
  double bandwidth;    // of the pulse, −6 dB, fraction of its frequency
  // What a console offers with it.
  double least_mhz = 0.0, most_mhz = 0.0, least_depth_mm = 0.0, most_depth_mm = 0.0;
};

// Frequency, elements, pitch, radius, height and elevation focus: the Verasonics probes as PyMUST lists them
// (getparam). Aperture, F-number 2 and a pulse of 60 % of the frequency: design (half to all of the elements). The
// band is the one that their names tell, the thesis' two the same share of theirs; the depths: design, from what
// such a probe is taken for to where nothing comes back.
inline constexpr Probe kC52v = {"C5-2v", 3.57, 128, 0.508, 49.57, 13.5, 60.0,
                                32.0,    2.0,  0.6, 2.0,   5.0,   40.0, 300.0};
inline constexpr Probe kL115v = {"L11-5v", 7.6, 128, 0.300, 0.0, 5.0, 18.0, 19.2, 2.0, 0.6, 5.0, 11.0, 20.0, 120.0};
// The two of Vidal's thesis (§4.6.1). It tells one number, the straight face of about 8 cm; with 128 elements a
// real one would have grating lobes (pitch two wavelengths), which are not modelled: for comparison, not to learn
// on. Its curve it measured on a picture; the Ultrasonix C5-2/60 of the PLUS toolkit stands in (60 mm, 56°). The
// rest: design.
inline constexpr Probe kThesisLinear = {
    "thesis-linear", 5.0, 128, 0.625, 0.0, 6.0, 25.0, 40.0, 2.0, 0.6, 3.0, 7.0, 20.0, 200.0};
inline constexpr Probe kThesisCurved = {
    "thesis-curved", 3.5, 128, 0.458, 60.0, 13.5, 60.0, 29.0, 2.0, 0.6, 2.1, 4.9, 40.0, 300.0};

inline constexpr std::array<Probe, 4> kProbes = {kC52v, kL115v, kThesisLinear, kThesisCurved};

// Null when there is no probe of that name.
const Probe* probe_named(std::string_view name) noexcept;

// A setting as the machine takes it: brought to the nearest that is in range; NaN leaves what was.
inline double taken(double wanted, double least, double most, double was) noexcept {
  return std::isnan(wanted) ? was : std::clamp(wanted, least, most);
}
// The depth that a console asks of a probe; what is not above 0 asks for none.
inline double taken_depth_mm(const Probe& probe, double asked_mm, double was_mm) noexcept {
  return asked_mm > 0.0 ? taken(asked_mm, probe.least_depth_mm, probe.most_depth_mm, was_mm) : was_mm;
}

// Of the Gaussian amplitude exp(−x²/2σ²) of the two-way beam.
struct BeamWidth {
  double axial_sigma_mm, lateral_sigma_mm, elevation_sigma_mm;
};
// focus_mm 0: in focus at every depth. depth_mm > 0.
BeamWidth beam_width(const Probe& probe, double frequency_mhz, double focus_mm, double depth_mm) noexcept;

double elevation_fwhm_mm(const Probe& probe, double frequency_mhz, double depth_mm) noexcept;

}  // namespace seldinger::imaging
