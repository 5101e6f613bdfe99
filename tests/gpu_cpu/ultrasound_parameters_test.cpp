// The blocks that the ultrasound shaders read have the offsets that C++ writes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "shaders/shared/ultrasound_passes.glsl.h"
#include "sim/base/embedded.h"
#include "tests/gpu_cpu/shader_offsets.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> ultrasound_shaders();
}

namespace seldinger::imaging {
namespace {

using Offsets = std::map<std::string, std::size_t>;

const base::EmbeddedFile& shader(std::string_view name) {
  const auto files = embedded::ultrasound_shaders();
  return *std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
}

// Of the fields that the shader reads; at least `least` of them, and none that is not ours.
void expect_offsets(const char* name, const char* block, const Offsets& ours, std::size_t least) {
  const Offsets theirs = offsets_from_compiler(shader(name), block);
  EXPECT_GE(theirs.size(), least) << name << ' ' << block;
  for (const auto& [field, offset] : theirs) {
    ASSERT_TRUE(ours.contains(field)) << name << ' ' << field;
    EXPECT_EQ(ours.at(field), offset) << name << ' ' << field;
  }
}

#define FIELD(Struct, field) \
  { #field, offsetof(shaders::Struct, field) }

TEST(UltrasoundParameters, OfTissue) {
  const Offsets ours{
      FIELD(UsTissue, amplitude),  FIELD(UsTissue, lesion_sphere_mm), FIELD(UsTissue, lesion_amplitude),
      FIELD(UsTissue, lesion_rim), FIELD(UsTissue, lesion_margin),    FIELD(UsTissue, lesion_count),
      FIELD(UsTissue, size_x),     FIELD(UsTissue, size_y),           FIELD(UsTissue, size_z),
      FIELD(UsTissue, no_offset),  FIELD(UsTissue, log_of_a_step),    FIELD(UsTissue, strays)};
  expect_offsets("ultrasound_scatter.comp", "tissue", ours, ours.size());
  expect_offsets("ultrasound_lattice_noise.comp", "tissue", ours, ours.size() - 1);
}

TEST(UltrasoundParameters, OfScatterersAndTheirTiles) {
  const Offsets ours{FIELD(UsScatterParameters, beams),         FIELD(UsScatterParameters, fine_samples),
                     FIELD(UsScatterParameters, fine),          FIELD(UsScatterParameters, curved),
                     FIELD(UsScatterParameters, radius_mm),     FIELD(UsScatterParameters, beam_step),
                     FIELD(UsScatterParameters, sample_mm),     FIELD(UsScatterParameters, fine_per_mm),
                     FIELD(UsScatterParameters, phases_per_mm), FIELD(UsScatterParameters, unit),
                     FIELD(UsScatterParameters, wavelength_mm), FIELD(UsScatterParameters, f_number),
                     FIELD(UsScatterParameters, aperture_mm),   FIELD(UsScatterParameters, focus_mm),
                     FIELD(UsScatterParameters, height_mm),     FIELD(UsScatterParameters, elevation_focus_mm)};
  expect_offsets("ultrasound_scatter.comp", "parameters", ours, ours.size());
  const Offsets tiles{
      FIELD(UsTile, corner_mm),  FIELD(UsTile, from_box_mm), FIELD(UsTile, half_box_mm), FIELD(UsTile, edge_x_mm),
      FIELD(UsTile, edge_y_mm),  FIELD(UsTile, edge_z_mm),   FIELD(UsTile, outer_mm),    FIELD(UsTile, middle_mm),
      FIELD(UsTile, inner_mm),   FIELD(UsTile, index),       FIELD(UsTile, index_x),     FIELD(UsTile, index_y),
      FIELD(UsTile, index_z),    FIELD(UsTile, origin_mm),   FIELD(UsTile, axis_x),      FIELD(UsTile, axis_y),
      FIELD(UsTile, axis_z),     FIELD(UsTile, seed),        FIELD(UsTile, step_outer),  FIELD(UsTile, step_middle),
      FIELD(UsTile, step_inner), FIELD(UsTile, rows_outer),  FIELD(UsTile, rows_middle), FIELD(UsTile, first_fine),
      FIELD(UsTile, end_fine),   FIELD(UsTile, column)};
  expect_offsets("ultrasound_scatter.comp", "tiles", tiles, tiles.size());
}

TEST(UltrasoundParameters, OfWhatMoves) {
  const Offsets ours{FIELD(UsMotion, index_x),      FIELD(UsMotion, index_y),       FIELD(UsMotion, index_z),
                     FIELD(UsMotion, columns),      FIELD(UsMotion, rows),          FIELD(UsMotion, layers),
                     FIELD(UsMotion, low_mm),       FIELD(UsMotion, layers_per_mm), FIELD(UsMotion, path_nodes),
                     FIELD(UsMotion, nodes_per_mm), FIELD(UsMotion, first_path)};
  for (const char* name : {"ultrasound_scatter_moved.comp", "ultrasound_lattice_noise_moved.comp",
                           "ultrasound_lines_moved.comp", "ultrasound_echoes_moved.comp"})
    expect_offsets(name, "motion", ours, 5);
}

TEST(UltrasoundParameters, OfTheLattice) {
  const Offsets ours{FIELD(UsLatticeParameters, lateral),      FIELD(UsLatticeParameters, axial),
                     FIELD(UsLatticeParameters, index),        FIELD(UsLatticeParameters, index_lateral),
                     FIELD(UsLatticeParameters, index_axial),  FIELD(UsLatticeParameters, beams),
                     FIELD(UsLatticeParameters, samples),      FIELD(UsLatticeParameters, lines),
                     FIELD(UsLatticeParameters, lines_before), FIELD(UsLatticeParameters, curved),
                     FIELD(UsLatticeParameters, radius_mm),    FIELD(UsLatticeParameters, first_beam),
                     FIELD(UsLatticeParameters, beam_step),    FIELD(UsLatticeParameters, sample_mm),
                     FIELD(UsLatticeParameters, unit)};
  expect_offsets("ultrasound_lattice_noise.comp", "parameters", ours, 12);
  expect_offsets("ultrasound_lattice_beams.comp", "parameters", ours, 5);
  const Offsets depths{
      FIELD(UsLatticeDepth, part),          FIELD(UsLatticeDepth, cell_x),        FIELD(UsLatticeDepth, cell_y),
      FIELD(UsLatticeDepth, cell_z),        FIELD(UsLatticeDepth, key),           FIELD(UsLatticeDepth, gain),
      FIELD(UsLatticeDepth, lateral_scale), FIELD(UsLatticeDepth, lateral_reach), FIELD(UsLatticeDepth, padding)};
  expect_offsets("ultrasound_lattice_noise.comp", "depths", depths, 6);
  expect_offsets("ultrasound_lattice_beams.comp", "depths", depths, 2);
}

TEST(UltrasoundParameters, OfMirrors) {
  const Offsets ours{FIELD(UsMirrorParameters, beams),      FIELD(UsMirrorParameters, samples),
                     FIELD(UsMirrorParameters, curved),     FIELD(UsMirrorParameters, radius_mm),
                     FIELD(UsMirrorParameters, first_beam), FIELD(UsMirrorParameters, beam_step),
                     FIELD(UsMirrorParameters, sample_mm),  FIELD(UsMirrorParameters, loss_db_mm)};
  expect_offsets("ultrasound_mirror.comp", "parameters", ours, ours.size());
  const Offsets mirrors{FIELD(UsMirror, plane), FIELD(UsMirror, met)};
  expect_offsets("ultrasound_mirror.comp", "mirrors", mirrors, mirrors.size());
}

TEST(UltrasoundParameters, OfTheLines) {
  const Offsets ours{FIELD(UsLineParameters, of_class),     FIELD(UsLineParameters, mm_per_voxel),
                     FIELD(UsLineParameters, beams),        FIELD(UsLineParameters, samples),
                     FIELD(UsLineParameters, around),       FIELD(UsLineParameters, close),
                     FIELD(UsLineParameters, close_weight), FIELD(UsLineParameters, most_shift_mm),
                     FIELD(UsLineParameters, sample_mm),    FIELD(UsLineParameters, depth_mm),
                     FIELD(UsLineParameters, turns_per_mm), FIELD(UsLineParameters, per_unit),
                     FIELD(UsLineParameters, shifts),       FIELD(UsLineParameters, least_side_mm),
                     FIELD(UsLineParameters, edges),        FIELD(UsLineParameters, wavelength_mm),
                     FIELD(UsLineParameters, f_number),     FIELD(UsLineParameters, aperture_mm),
                     FIELD(UsLineParameters, focus_mm),     FIELD(UsLineParameters, elevation_x),
                     FIELD(UsLineParameters, elevation_y),  FIELD(UsLineParameters, elevation_z)};
  expect_offsets("ultrasound_lines.comp", "parameters", ours, 6);
  expect_offsets("ultrasound_echoes.comp", "parameters", ours, 18);
  const Offsets beams{FIELD(UsBeam, index),         FIELD(UsBeam, index_rest),
                      FIELD(UsBeam, index_along),   FIELD(UsBeam, index_along_rest),
                      FIELD(UsBeam, start_mm),      FIELD(UsBeam, direction),
                      FIELD(UsBeam, needle_mm),     FIELD(UsBeam, needle_shadow_db),
                      FIELD(UsBeam, needle_echoes), FIELD(UsBeam, contact),
                      FIELD(UsBeam, needle_echo)};
  expect_offsets("ultrasound_lines.comp", "beams", beams, beams.size());
  expect_offsets("ultrasound_echoes.comp", "beams", beams, beams.size());
}

TEST(UltrasoundParameters, OfThePulse) {
  const Offsets ours{FIELD(UsPulseParameters, beams),       FIELD(UsPulseParameters, samples),
                     FIELD(UsPulseParameters, fine),        FIELD(UsPulseParameters, first_tap),
                     FIELD(UsPulseParameters, taps),        FIELD(UsPulseParameters, most_echoes),
                     FIELD(UsPulseParameters, sample_mm),   FIELD(UsPulseParameters, sigma_mm),
                     FIELD(UsPulseParameters, fine_per_mm), FIELD(UsPulseParameters, phases_per_mm)};
  expect_offsets("ultrasound_pulse.comp", "parameters", ours, 7);
  expect_offsets("ultrasound_pulse_shifted.comp", "parameters", ours, 7);
  expect_offsets("ultrasound_shift.comp", "parameters", ours, 4);
}

#undef FIELD

}  // namespace
}  // namespace seldinger::imaging
