// Speckle by convolution of scatterers (COLE: Gao et al., IEEE TUFFC 56 (2009) 404): equal amplitudes on a jittered
// lattice that hangs on tissue coordinates, each laid into the beams that see it, before the pulse.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sim/imaging/ultrasound/speckle/speckle.h"

namespace seldinger::imaging {

// What holds for a whole picture: per depth sample the beam's widths, per depth band the lattice.
class ScattererField final : public SpeckleField {
 public:
  ScattererField(const UltrasoundView& view, const TissueAt& tissue_at, const PictureMotion* motion = nullptr);

  // Fine samples to a sample: so many that the lattice's own mean, which turns by 2·fine/λ a fine sample, is well
  // below the Nyquist frequency and the pulse takes it away.
  int fine() const noexcept override { return fine_; }

  // The phase is e^(−2πi·2·depth/λ).
  void add_beams(int first, int end, std::vector<std::int32_t>& out) const override;

  // The lattice at a depth: side of its cubes, and the key of their bits.
  struct Lattice {
    double spacing_mm;
    std::uint32_t key;
  };
  Lattice lattice_at(double depth_mm) const noexcept;

  // A layer of depth with one lattice and one thickness.
  struct Band {
    double from_mm, to_mm, half_thickness_mm, spacing_mm;
    std::uint32_t key;
    int first_sample, end_sample;
  };
  std::span<const Band> bands() const noexcept { return bands_; }
  float most_reach(const Band& band) const noexcept;  // beams

  // The part of a band within `beams_half` of beam `middle`: its frame (x across, y elevation, z along its middle
  // beam from the face), a box in that frame around where its tissue lies at rest, and where the lattice's cubes
  // lie that touch the box.
  struct Tile {
    glm::dvec3 start_lps_mm, axes[3];
    glm::dvec3 center_mm, half_mm;                      // of the box, in the frame; around centres of cubes
    glm::dvec3 center_lps_mm, center_cell, half_cells;  // the same in LPS, and in cubes' numbers
    glm::dvec3 lps_mm(const glm::dvec3& in_frame) const noexcept {
      return start_lps_mm + in_frame.x * axes[0] + in_frame.y * axes[1] + in_frame.z * axes[2];
    }
    int inner;  // the lattice's axis most across the picture: its rows are short and few are empty
  };
  Tile tile(const Band& band, double middle, double beams_half) const noexcept;

 private:
  struct AtSample {
    float lateral_scale;    // of (beams off)²: Σ index of the Gaussian's table
    float lateral_reach;    // beams
    float elevation_scale;  // of y²
    float amplitude;        // unit energy · lattice
  };
  class BandWriter;
  void add_band(const Band& band, int first, int end, std::vector<std::int32_t>& out) const;
  void to_rest(const Tile& tile, glm::dvec3& low_mm, glm::dvec3& high_mm) const noexcept;
  std::pair<glm::dvec3, glm::dvec3> box_in_slab(const Tile& tile, const glm::dvec3& low_mm,
                                                const glm::dvec3& high_mm) const noexcept;
  bool lies_still(const Tile& tile) const noexcept;

  const UltrasoundView& view_;
  const TissueAt& tissue_at_;
  const PictureMotion* motion_;
  Fan fan_;
  double wavelength_mm_;
  int fine_;
  std::vector<Band> bands_;
  std::vector<AtSample> at_sample_;
};

}  // namespace seldinger::imaging
