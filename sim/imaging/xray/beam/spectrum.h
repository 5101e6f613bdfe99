// What a tungsten tube emits, by its voltage (constant potential), anode angle and filters.
//
// Bremsstrahlung and K lines in the form of Tucker, Barnes and Chakraborty, Med. Phys. 18 (1991) 211: electrons
// slow down along the Thomson–Whiddington law, radiate in proportion to a function of E/T, and what they emit in
// the depth is weakened by the tungsten above. Five constants are refitted (spectrum.cpp), since Tucker's own leave
// the half-value layers that PTB measured 2–9 % too low: now all of RQR 2–9 and RQA 2–9 (40–120 kV, 20° anode)
// within 1.5 %, and within 2.5 % of SpekPy's for an angiographic unit (8° anode, 0–0.9 mm copper, 40–100 kV). Not
// modelled: voltage ripple, heel effect across the field, off-focal radiation, photons below 13 keV, which no
// filtered beam holds.
#pragma once

#include <vector>

#include "sim/case/fluoroscope.h"
#include "sim/imaging/xray/beam/coefficients.h"

namespace seldinger::imaging {

constexpr double kMinTubeKv = 40.0, kMaxTubeKv = 150.0;

// Bins of 1 keV; the last ends at the tube voltage. Photons on the axis at 1 m from the focus, in vacuum.
struct Spectrum {
  double kv = 0.0;
  std::vector<double> energy_kev;  // of the bins' middles, ascending
  std::vector<double> photons_per_mas_mm2;
};

// What leaves the anode, unfiltered. kMinTubeKv ≤ kv ≤ kMaxTubeKv, 5° ≤ angle ≤ 45° (CHECK).
Spectrum anode_spectrum(double kv, double anode_angle_deg);

// Puts a sheet into the beam. thickness ≥ 0 (CHECK).
void add_filter(Spectrum& spectrum, Material material, double thickness_mm);

constexpr double kAnodeAngleDeg = 12.0;  // typical of angiographic tubes (8°–12°)
constexpr double kTubeOwnAlMm = 1.5;     // inherent filtration: window, oil and housing, as aluminium

// The beam of a machine: anode, inherent filtration and the machine's filters.
Spectrum fluoroscope_spectrum(const cases::Fluoroscope& fluoroscope, double kv);

// Free in air on the axis at 1 m, mGy per mAs.
double air_kerma_mgy_per_mas(const Spectrum& spectrum);

// Aluminium that leaves `share` of the air kerma: the (first) half-value layer by default. 0 < share ≤ 1 (CHECK).
double aluminium_layer_mm(const Spectrum& spectrum, double share = 0.5);

}  // namespace seldinger::imaging
