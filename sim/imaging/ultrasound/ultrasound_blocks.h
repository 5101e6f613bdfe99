// What the CPU tells the shaders of ultrasound: their blocks and lists, worked out in double.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "shaders/shared/ultrasound_passes.glsl.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/speckle/lattice.h"
#include "sim/imaging/ultrasound/speckle/scatterers.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

// Class and level of the echo in one number.
std::vector<std::uint16_t> voxels_of(const TissueVolume& tissue);
shaders::UsTissue tissue_block(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted);

shaders::UsScatterParameters scatter_parameters(const UltrasoundView& view, int fine);
// Each scatterer belongs to one tile; those at the sides of the fan reach beams inside it. `motion`: as the
// field's.
std::vector<shaders::UsTile> tiles_of(const UltrasoundView& view, const ScattererField& field,
                                      const glm::dmat4& voxel_from_lps, const PictureMotion* motion = nullptr);

// Of tissue that moves; the paths begin `first_path` numbers into their list.
shaders::UsMotion motion_block(const PictureMotion& motion, const glm::dmat4& voxel_from_lps,
                               std::size_t first_path);

shaders::UsLatticeParameters lattice_parameters(const UltrasoundView& view, const LatticeField& field,
                                                const glm::dmat4& voxel_from_lps);
std::vector<shaders::UsLatticeDepth> lattice_depths(const UltrasoundView& view, const LatticeField& field);

// For beams that the GPU walks: what it must know of them, and the neighbours of an interface's voxel (xyz: voxels
// off, w: weight), first those that tell its normal, then those that tell its place.
shaders::UsLineParameters line_parameters(const TissueVolume& tissue, const UltrasoundView& view,
                                          const LineWalker& walker);
std::vector<shaders::UsBeam> beams_of(const UltrasoundView& view, const LineWalker& walker,
                                      const glm::dmat4& voxel_from_lps, std::span<const float> depth_below_skin_mm);
std::vector<glm::vec4> neighbours_of(const LineWalker& walker);

// What lies along all beams, walked by the CPU.
struct Lines {
  std::vector<float> through;   // a sample: 10^(−dB/20), in what sums are counted in; 0 without contact
  std::vector<float> shift_mm;  // a sample; empty: nowhere
  std::vector<std::int32_t> echo_counts;
  // most_echoes a beam: depth in mm, amplitude at that depth's phase, us_parting_per_mm
  std::vector<glm::vec4> echoes;
  int most_echoes = 1;
};
Lines walked_lines(const UltrasoundView& view, const LineWalker& walker,
                   std::span<const float> depth_below_skin_mm);

shaders::UsPulseParameters pulse_parameters(const UltrasoundView& view, int fine, int most_echoes);
// Of the taps, with zeros on either side.
std::vector<float> pulse_weights(const UltrasoundView& view, int fine);

}  // namespace seldinger::imaging
