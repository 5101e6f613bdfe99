// Formulas of ultrasound: widths of the beam, loss along it, the lattice of scatterers, and what a level shows as.
// Compiled as GLSL in float and as C++ in double. Amplitudes are of the displayed two-way echo.
#ifndef SELDINGER_SHADERS_SHARED_ULTRASOUND
#define SELDINGER_SHADERS_SHARED_ULTRASOUND

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

SHARED_CONSTANT real kUsSpeedMmPerUs = 1.54;  // what every scanner assumes for its depth scale

// FWHM of a Gaussian = this · σ: 2·√(2·ln 2).
SHARED_CONSTANT real kUsFwhmPerSigma = 2.354820045;

SHARED real us_wavelength_mm(real frequency_mhz) {
  return kUsSpeedMmPerUs / frequency_mhz;
}

// Of the envelope of a Gaussian pulse whose −6 dB bandwidth is this fraction of its frequency: (c/2)·0.8825/(b·f),
// 0.8825 = 4·ln 2/π.
SHARED real us_axial_fwhm_mm(real frequency_mhz, real bandwidth) {
  return real(0.5) * kUsSpeedMmPerUs * real(0.8825) / (bandwidth * frequency_mhz);
}

// Two-way −6 dB width of a focused rectangular aperture, 0.89·λ·F: sinc² falls to a half at 0.443. The F-number is
// held at f_number until the aperture is exhausted. focus_mm > 0: the transmitted beam keeps one focus and widens
// away from it by its geometry, the received one is always in focus; the product of two Gaussians, which at the
// focus is the same.
SHARED real us_lateral_fwhm_mm(real depth_mm, real wavelength_mm, real f_number, real aperture_mm, real focus_mm) {
  real f = max(f_number, depth_mm / aperture_mm);
  real both = real(0.89) * wavelength_mm * f;
  real one_way_2 = real(2.0) * both * both;
  real open_mm = focus_mm > real(0.0) ? min(aperture_mm, focus_mm / f_number) : real(0.0);
  real spread = focus_mm > real(0.0) ? real(0.6) * open_mm * abs(real(1.0) - depth_mm / focus_mm) : real(0.0);
  real transmitted_2 = one_way_2 + spread * spread;
  return sqrt(one_way_2 * transmitted_2 / (one_way_2 + transmitted_2));
}

// √((λz/h)² + (0.6·h·|1 − z/F|)²): diffraction and the geometry of a lens of fixed focus.
SHARED real us_elevation_fwhm_mm(real depth_mm, real wavelength_mm, real height_mm, real focus_mm) {
  real diffraction = wavelength_mm * depth_mm / height_mm;
  real geometry = real(0.6) * height_mm * abs(real(1.0) - depth_mm / focus_mm);
  return sqrt(diffraction * diffraction + geometry * geometry);
}

// Two-way, per mm of depth: 2·α·fⁿ, α in dB/cm/MHzⁿ.
SHARED real us_loss_db_per_mm(real attenuation_db_cm_mhz, real exponent, real frequency_mhz) {
  return real(0.2) * attenuation_db_cm_mhz * pow(frequency_mhz, exponent);
}

// How much deeper than it lies a piece of tissue shows, per mm above it.
SHARED real us_shift_per_mm(real speed_mm_per_us) {
  return kUsSpeedMmPerUs / speed_mm_per_us - real(1.0);
}

// Amplitude that a step of impedance sends back, of either sign.
SHARED real us_reflection(real from_mrayl, real to_mrayl) {
  return (to_mrayl - from_mrayl) / (to_mrayl + from_mrayl);
}

// Two-way amplitude through the step is (1 + R)(1 − R); in dB, not less than a mirror's 120.
SHARED real us_step_loss_db(real reflection) {
  real through = max(real(1.0) - reflection * reflection, real(1e-6));
  return real(-8.685889638) * log(through);
}

// 32 bits out of 32, both ways round (Wellons' hash-prospector, "lowbias32").
SHARED uint us_mix(uint x) {
  x = (x ^ (x >> 16u)) * 0x7feb352du;
  x = (x ^ (x >> 15u)) * 0x846ca68bu;
  return x ^ (x >> 16u);
}

// The lattice: one scatterer in each cube of side s, anywhere in it: 11 + 10 + 11 bits of where. Along any axis the
// seed of the next cube is the last one's plus a constant. (Primes of Collet's xxHash, only for being odd and
// unrelated.)
SHARED_CONSTANT uint kUsStepI = 0x9e3779b1u, kUsStepJ = 0x85ebca77u, kUsStepK = 0xc2b2ae3du;
SHARED uint us_lattice_seed(uint key, int i, int j, int k) {
  return key + uint(i) * kUsStepI + uint(j) * kUsStepJ + uint(k) * kUsStepK;
}
SHARED uint us_lattice_bits(uint seed) {
  return us_mix(seed);
}

// Whether a scatterer's echo is turned over (0 or 1), by the last bit of where it is, which is far below a wavelength:
// so no step of scatterers sends back an echo beside the one that its impedance makes.
SHARED uint us_lattice_turned(uint bits) {
  return bits & 1u;
}

// Noise on a node of a lattice, both parts uniform in [−1, 1).
SHARED real us_node_re(uint bits) {
  return (real(int(bits >> 16u)) + real(0.5)) * real(1.0 / 32768.0) - real(1.0);
}
SHARED real us_node_im(uint bits) {
  return (real(int(bits & 65535u)) + real(0.5)) * real(1.0 / 32768.0) - real(1.0);
}

// What a person sees of a level: black at top − range, white at top.
SHARED real us_grey(real level_db, real top_db, real range_db) {
  return clamp(real(255.0) * (level_db - top_db + range_db) / range_db, real(0.0), real(255.0));
}

// Eight sliders, the first at the face, the last at the depth; linear between. `at` is slider number in [0, 7].
SHARED real us_between(real low, real high, real at) {
  return low + (at - floor(at)) * (high - low);
}

// How far off the normal a mirror at a depth still sends sound back into the aperture, of half width a: ½·atan(a/z).
SHARED real us_cone_rad(real depth_mm, real aperture_mm, real f_number) {
  real z = max(depth_mm, real(1.0));
  return real(0.5) * atan(real(0.5) * min(aperture_mm, z / f_number) / z);
}

// Share of a mirror's echo that comes back when the beam meets it `tilt` (radians) off its normal.
SHARED real us_mirror(real tilt_rad, real cone_rad) {
  real t = tilt_rad / cone_rad;
  return exp(-t * t);
}

SHARED_END

#endif
