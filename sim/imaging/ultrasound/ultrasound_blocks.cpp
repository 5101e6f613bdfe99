#include "sim/imaging/ultrasound/ultrasound_blocks.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/check.h"
#include "sim/imaging/float_pair.h"
#include "sim/imaging/ultrasound/mirror.h"
#include "sim/imaging/ultrasound/speckle/phase.h"
#include "sim/imaging/ultrasound/speckle/pulse.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

using shaders::kUsOutputs;
using shaders::UsBeam;
using shaders::UsLatticeDepth;
using shaders::UsLatticeParameters;
using shaders::UsLineParameters;
using shaders::UsPulseParameters;
using shaders::UsScatterParameters;
using shaders::UsTile;
using shaders::UsTissue;
static_assert(sizeof(UsTissue) == 1312 && sizeof(UsScatterParameters) == 64 && sizeof(UsTile) == 320 &&
              sizeof(shaders::UsMotion) == 80);
static_assert(sizeof(UsLatticeParameters) == 128 && sizeof(UsLatticeDepth) == 48);
static_assert(sizeof(UsPulseParameters) == 48);
static_assert(sizeof(shaders::UsMirror) == 32 && sizeof(shaders::UsMirrorParameters) == 32);
static_assert(sizeof(UsLineParameters) == 384 && sizeof(UsBeam) == 272);
static_assert(shaders::kUsLinesPerBeam == LatticeField::kLinesPerBeam);
static_assert(shaders::kUsMaxLesions == kMaxLesions && shaders::kUsPhases == kPhases);
static_assert(shaders::kUsMostNeedleEchoes == kMostNeedleEchoes);
static_assert(volume::kTissueClasses <= 16);
static_assert(shaders::kUsAir == static_cast<std::uint32_t>(volume::TissueClass::air) &&
              shaders::kUsGas == static_cast<std::uint32_t>(volume::TissueClass::gas) &&
              shaders::kUsFluid == static_cast<std::uint32_t>(volume::TissueClass::fluid) &&
              shaders::kUsVessel == static_cast<std::uint32_t>(volume::TissueClass::vessel));

constexpr int kTilesAcross = 16;

glm::vec4 vec4_from(const glm::dvec3& xyz, double w = 0.0) {
  return glm::vec4(glm::dvec4(xyz, w));
}

}  // namespace

std::vector<std::uint16_t> voxels_of(const TissueVolume& tissue) {
  CHECK(tissue.volume != nullptr && tissue.classes.size() == tissue.volume->hu.size());
  CHECK(tissue.echogenicity.empty() || tissue.echogenicity.size() == tissue.classes.size());
  std::vector<std::uint16_t> voxels(tissue.classes.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const unsigned level = tissue.echogenicity.empty() ? kNoEchoOffset : tissue.echogenicity[i];
    voxels[i] = static_cast<std::uint16_t>(static_cast<unsigned>(tissue.classes[i]) | level << 8U);
  }
  return voxels;
}

UsTissue tissue_block(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted) {
  UsTissue t{};
  const auto amplitude = speckle_amplitudes();
  for (std::size_t i = 0; i < amplitude.size(); ++i) t.amplitude[i].x = amplitude[i];
  for (const cases::Lesion& lesion : inserted.lesions) {
    if (!is_shown(lesion)) continue;
    t.lesion_sphere_mm[t.lesion_count] = vec4_from(lesion.center_lps_mm - view.origin_lps_mm, lesion.radius_mm);
    const cases::LesionEcho echo = echo_of(lesion);
    const Texture texture(lesion, echo);
    t.lesion_amplitude[t.lesion_count] = {speckle_amplitude(echo.inside_db + echo.texture_db),
                                          static_cast<float>(echo.inside), texture.log_sd, texture.grains_per_mm};
    t.lesion_rim[t.lesion_count] = {speckle_amplitude(echo.rim_db), static_cast<float>(echo.rim),
                                    static_cast<float>(inner_radius_mm(lesion, echo)),
                                    static_cast<float>(texture.key)};
    const float per_mm = echo.margin_mm > 0.0 ? static_cast<float>(1.0 / echo.margin_mm) : 0.0F;
    t.lesion_margin[t.lesion_count] = {speckle_amplitude(echo.about_db), per_mm, 0.0F, 0.0F};
    ++t.lesion_count;
  }
  t.size_x = tissue.volume->size_voxels.x;
  t.size_y = tissue.volume->size_voxels.y;
  t.size_z = tissue.volume->size_voxels.z;
  t.no_offset = kNoEchoOffset;
  t.log_of_a_step = static_cast<float>(kEchoStepDb * std::log(10.0) / 20.0);
  t.strays = blends_voxels(view) ? 1 : 0;
  return t;
}

UsScatterParameters scatter_parameters(const UltrasoundView& view, int fine) {
  UsScatterParameters p{};
  const Fan fan = fan_of(view);
  p.beams = view.beams;
  p.fine = fine;
  p.fine_samples = view.samples * fine;
  p.curved = fan.curved ? 1 : 0;
  p.radius_mm = static_cast<float>(fan.radius_mm);
  p.beam_step = static_cast<float>(fan.beam_step);
  p.sample_mm = static_cast<float>(fan.sample_mm);
  p.fine_per_mm = static_cast<float>(fine / fan.sample_mm);
  const double wavelength_mm = shaders::us_wavelength_mm(working_mhz(view));
  p.phases_per_mm = static_cast<float>(2.0 / wavelength_mm * kPhases);
  p.unit = SpeckleField::kUnit;
  p.wavelength_mm = static_cast<float>(wavelength_mm);
  p.f_number = static_cast<float>(view.probe.f_number);
  p.aperture_mm = static_cast<float>(view.probe.aperture_mm);
  p.focus_mm = static_cast<float>(view.focus_mm);
  p.height_mm = static_cast<float>(view.probe.height_mm);
  p.elevation_focus_mm = static_cast<float>(view.probe.elevation_focus_mm);
  return p;
}

UsLatticeParameters lattice_parameters(const UltrasoundView& view, const LatticeField& field,
                                       const glm::dmat4& voxel_from_lps) {
  UsLatticeParameters p{};
  const Fan fan = fan_of(view);
  const glm::dmat3 turn(voxel_from_lps);
  p.lateral = vec4_from(fan.lateral);
  p.axial = vec4_from(fan.axial);
  p.index = vec4_from(glm::dvec3(voxel_from_lps * glm::dvec4(view.origin_lps_mm, 1.0)) + 0.5);
  p.index_lateral = vec4_from(turn * fan.lateral);
  p.index_axial = vec4_from(turn * fan.axial);
  p.beams = view.beams;
  p.samples = view.samples;
  for (int k = 0; k < view.samples; ++k)
    p.lines_before = std::max(p.lines_before, field.at_sample(k).lateral_reach);
  p.lines = (view.beams - 1) * LatticeField::kLinesPerBeam + 2 * p.lines_before + 1;
  p.curved = fan.curved ? 1 : 0;
  p.radius_mm = static_cast<float>(fan.radius_mm);
  p.first_beam = static_cast<float>(fan.first_beam);
  p.beam_step = static_cast<float>(fan.beam_step);
  p.sample_mm = static_cast<float>(fan.sample_mm);
  p.unit = SpeckleField::kUnit;
  return p;
}

std::vector<UsLatticeDepth> lattice_depths(const UltrasoundView& view, const LatticeField& field) {
  std::vector<UsLatticeDepth> depths(static_cast<std::size_t>(view.samples));
  for (int k = 0; k < view.samples; ++k) {
    const LatticeField::AtSample& at = field.at_sample(k);
    const glm::dvec3 cell = view.origin_lps_mm * static_cast<double>(at.per_mm), low = glm::floor(cell);
    UsLatticeDepth& depth = depths[static_cast<std::size_t>(k)];
    depth.part = vec4_from(cell - low, static_cast<double>(at.per_mm));
    depth.cell_x = static_cast<int>(low.x);
    depth.cell_y = static_cast<int>(low.y);
    depth.cell_z = static_cast<int>(low.z);
    depth.key = at.key;
    depth.gain = at.gain;
    depth.lateral_scale = at.lateral_scale;
    depth.lateral_reach = at.lateral_reach;
  }
  return depths;
}

std::vector<UsTile> tiles_of(const UltrasoundView& view, const ScattererField& field,
                             const glm::dmat4& voxel_from_lps, const PictureMotion* motion) {
  std::vector<UsTile> tiles;
  const int block = std::clamp(view.beams / kTilesAcross, 1, 32);
  const glm::dmat3 turn(voxel_from_lps);
  for (const ScattererField::Band& band : field.bands()) {
    const double reach = static_cast<double>(field.most_reach(band)), s = band.spacing_mm;
    for (int first = 0; first < view.beams; first += block) {
      const int end = std::min(view.beams, first + block);
      const double from = first == 0 ? -reach : first - 0.5, to = end == view.beams ? end - 1 + reach : end - 0.5;
      const double middle = 0.5 * (from + to);
      const ScattererField::Tile at = field.tile(band, middle, 0.5 * (to - from));
      const auto in_frame = [&](const glm::dvec3& v) {
        return glm::dvec3(glm::dot(v, at.axes[0]), glm::dot(v, at.axes[1]), glm::dot(v, at.axes[2]));
      };
      const int inner = at.inner, outer = (inner + 1) % 3, other = (inner + 2) % 3;
      glm::ivec3 cube(glm::round(at.center_cell));
      const auto first_of = [&](int l) {
        return static_cast<int>(std::ceil(at.center_cell[l] - at.half_cells[l]));
      };
      const auto last_of = [&](int l) {
        return static_cast<int>(std::floor(at.center_cell[l] + at.half_cells[l]));
      };
      cube[outer] = first_of(outer);
      cube[other] = first_of(other);
      glm::dvec3 edge[3];
      for (int l = 0; l < 3; ++l) edge[l] = s * glm::dvec3(at.axes[0][l], at.axes[1][l], at.axes[2][l]);
      constexpr std::uint32_t kSteps[3] = {shaders::kUsStepI, shaders::kUsStepJ, shaders::kUsStepK};
      const glm::dvec3 corner_mm = in_frame(s * glm::dvec3(cube) - at.start_lps_mm);
      UsTile t{};
      t.corner_mm = vec4_from(corner_mm, band.half_thickness_mm);
      t.from_box_mm = vec4_from(in_frame(s * (glm::dvec3(cube) - at.center_cell)), band.from_mm);
      t.half_box_mm = vec4_from(at.half_mm, band.to_mm);
      t.edge_x_mm = vec4_from(edge[0], middle);
      t.edge_y_mm = vec4_from(edge[1], from);
      t.edge_z_mm = vec4_from(edge[2], to);
      t.outer_mm = vec4_from(edge[outer], s);
      t.middle_mm = vec4_from(edge[other]);
      t.inner_mm = vec4_from(edge[inner]);
      t.index = vec4_from(glm::dvec3(voxel_from_lps * glm::dvec4(at.start_lps_mm, 1.0)) + 0.5);
      t.index_x = vec4_from(turn * at.axes[0]);
      t.index_y = vec4_from(turn * at.axes[1]);
      t.index_z = vec4_from(turn * at.axes[2]);
      t.origin_mm = vec4_from(at.start_lps_mm - view.origin_lps_mm);
      t.axis_x = vec4_from(at.axes[0]);
      t.axis_y = vec4_from(at.axes[1]);
      t.axis_z = vec4_from(at.axes[2]);
      t.seed = shaders::us_lattice_seed(band.key, cube.x, cube.y, cube.z);
      t.step_outer = kSteps[outer];
      t.step_middle = kSteps[other];
      t.step_inner = kSteps[inner];
      t.rows_outer = std::max(0, last_of(outer) - cube[outer] + 1);
      t.rows_middle = std::max(1, last_of(other) - cube[other] + 1);
      t.first_fine = band.first_sample * field.fine();
      t.end_fine = band.end_sample * field.fine();
      if (motion != nullptr) {
        const tissue::SlabPart& part = motion->slab().part();
        t.column = vec4_from({((cube[outer] + 0.5) * s - part.low_mm.x) / part.spacing_mm,
                              ((cube[other] + 0.5) * s - part.low_mm.y) / part.spacing_mm, s / part.spacing_mm},
                             s / part.spacing_mm);
      }
      tiles.push_back(t);
    }
  }
  return tiles;
}

shaders::UsMotion motion_block(const PictureMotion& motion, const glm::dmat4& voxel_from_lps,
                               std::size_t first_path) {
  shaders::UsMotion m{};
  m.index_x = vec4_from(glm::dvec3(voxel_from_lps[0]));
  m.index_y = vec4_from(glm::dvec3(voxel_from_lps[1]));
  m.index_z = vec4_from(glm::dvec3(voxel_from_lps[2]));
  const tissue::MovedSlab& slab = motion.slab();
  m.columns = slab.size().x;
  m.rows = slab.size().y;
  m.layers = slab.size().z;
  m.low_mm = static_cast<float>(slab.part().low_mm.z);
  m.layers_per_mm = static_cast<float>(1.0 / slab.part().layer_mm);
  m.nodes_per_mm = static_cast<float>(motion.nodes_per_mm());
  m.path_nodes = motion.path_nodes();
  m.first_path = static_cast<int>(first_path);
  return m;
}

UsLineParameters line_parameters(const TissueVolume& tissue, const UltrasoundView& view, const LineWalker& walker) {
  UsLineParameters p{};
  for (std::size_t i = 0; i < volume::kTissueClasses; ++i) {
    const LineWalker::OfClass of = walker.of_class(i);
    const double shift_mm = of.shift_per_mm * fan_of(view).sample_mm, kept_mm = first_digits(shift_mm);
    p.of_class[i] = vec4_from({of.impedance_mrayl, of.loss_db_mm, kept_mm}, shift_mm - kept_mm);
  }
  for (int axis = 0; axis < 3; ++axis)
    p.mm_per_voxel[axis] = vec4_from(glm::dvec3(tissue.volume->lps_from_voxel[axis]));
  p.beams = view.beams;
  p.samples = view.samples;
  p.around = static_cast<int>(walker.around().size());
  p.close = static_cast<int>(walker.close().size());
  double weight = 0.0;
  for (const LineWalker::Neighbour& n : walker.close()) weight += n.weight;
  p.close_weight = static_cast<float>(weight);
  p.most_shift_mm = static_cast<float>(walker.most_shift_mm());
  p.sample_mm = static_cast<float>(fan_of(view).sample_mm);
  p.depth_mm = static_cast<float>(view.depth_mm);
  p.turns_per_mm = static_cast<float>(2.0 / shaders::us_wavelength_mm(working_mhz(view)));
  p.per_unit = 1.0F / SpeckleField::kUnit;
  p.least_side_mm = static_cast<float>(walker.least_side_mm());
  p.shifts = view.range_error ? 1 : 0;
  p.edges = !shows_artefacts(view) ? 0 : tells_layers(view) ? shaders::kUsEdgesByWidth : shaders::kUsEdgesByOneSide;
  p.wavelength_mm = static_cast<float>(shaders::us_wavelength_mm(working_mhz(view)));
  p.f_number = static_cast<float>(view.probe.f_number);
  p.aperture_mm = static_cast<float>(view.probe.aperture_mm);
  p.focus_mm = static_cast<float>(view.focus_mm);
  const glm::vec3 elevation(fan_of(view).elevation);
  p.elevation_x = elevation.x;
  p.elevation_y = elevation.y;
  p.elevation_z = elevation.z;
  return p;
}

std::vector<UsBeam> beams_of(const UltrasoundView& view, const LineWalker& walker, const glm::dmat4& voxel_from_lps,
                             std::span<const float> depth_below_skin_mm) {
  const Fan fan = fan_of(view);
  std::vector<UsBeam> beams(static_cast<std::size_t>(view.beams));
  for (int b = 0; b < view.beams; ++b) {
    const glm::dvec3 start = fan.start_lps_mm(b), direction = fan.direction(b);
    UsBeam& beam = beams[static_cast<std::size_t>(b)];
    split(glm::dvec3(voxel_from_lps * glm::dvec4(start, 1.0)) + 0.5, beam.index, beam.index_rest);
    split(glm::dmat3(voxel_from_lps) * (fan.sample_mm * direction), beam.index_along, beam.index_along_rest);
    beam.start_mm = vec4_from(start - view.origin_lps_mm);
    beam.direction = vec4_from(direction);
    beam.contact = beam_touches(view, depth_below_skin_mm, b) ? 1 : 0;
    const NeedleLine needle = walker.needle_line(b);
    beam.needle_mm = static_cast<float>(needle.depth_mm);
    beam.needle_shadow_db = static_cast<float>(needle.shadow_db);
    for (const NeedleLine::Echo& echo : needle.echoes)
      beam.needle_echo[beam.needle_echoes++] = vec4_from({echo.depth_mm, echo.amplitude, echo.loss_at_mm});
  }
  return beams;
}

std::vector<glm::vec4> neighbours_of(const LineWalker& walker) {
  std::vector<glm::vec4> all;
  for (const auto& list : {walker.around(), walker.close()})
    for (const LineWalker::Neighbour& n : list) all.push_back(vec4_from(glm::dvec3(n.offset), n.weight));
  return all;
}

Lines walked_lines(const UltrasoundView& view, const LineWalker& walker,
                   std::span<const float> depth_below_skin_mm) {
  Lines lines;
  const double wavelength_mm = shaders::us_wavelength_mm(working_mhz(view));
  const auto samples = static_cast<std::size_t>(view.samples), beams = static_cast<std::size_t>(view.beams);
  lines.through.assign(beams * samples, 0.0F);
  lines.shift_mm.assign(view.range_error ? beams * samples : 0, 0.0F);
  lines.echo_counts.assign(beams, 0);
  std::vector<std::vector<LineEcho>> echoes(beams);
  Line line;
  for (std::size_t b = 0; b < beams; ++b) {
    const int beam = static_cast<int>(b);
    walker.walk(beam, beam_touches(view, depth_below_skin_mm, beam), line);
    if (line.contact)
      for (std::size_t k = 0; k < samples; ++k)
        lines.through[b * samples + k] = std::exp(-0.115129255F * line.loss_db[k]) * (1.0F / SpeckleField::kUnit);
    std::copy(line.shift_mm.begin(), line.shift_mm.end(),
              lines.shift_mm.begin() + static_cast<std::ptrdiff_t>(b * samples));
    lines.echo_counts[b] = static_cast<std::int32_t>(line.echoes.size());
    lines.most_echoes = std::max(lines.most_echoes, lines.echo_counts[b]);
    echoes[b] = line.echoes;
  }
  lines.echoes.assign(beams * static_cast<std::size_t>(lines.most_echoes), glm::vec4(0.0F));
  for (std::size_t b = 0; b < beams; ++b) {
    auto* to = lines.echoes.data() + b * static_cast<std::size_t>(lines.most_echoes);
    for (const LineEcho& echo : echoes[b]) {
      const double turns = 2.0 * echo.depth_mm / wavelength_mm,
                   angle = -2.0 * std::numbers::pi * (turns - std::floor(turns));
      *to++ = glm::vec4(glm::dvec4(echo.depth_mm, echo.amplitude * std::cos(angle),
                                   echo.amplitude * std::sin(angle), echo.parting_per_mm));
    }
  }
  return lines;
}

namespace {

std::vector<PulseTap> taps_of(const UltrasoundView& view, int fine) {
  const double sigma_mm = beam_width(view.probe, working_mhz(view), view.focus_mm, 1.0).axial_sigma_mm;
  return pulse_taps(sigma_mm, fan_of(view).sample_mm, fine);
}

}  // namespace

UsPulseParameters pulse_parameters(const UltrasoundView& view, int fine, int most_echoes) {
  UsPulseParameters p{};
  const std::vector<PulseTap> taps = taps_of(view, fine);
  const double sample_mm = fan_of(view).sample_mm, mhz = working_mhz(view);
  p.beams = view.beams;
  p.samples = view.samples;
  p.fine = fine;
  p.first_tap = taps.front().shift * fine + taps.front().part;
  p.taps = static_cast<int>(taps.size());
  p.most_echoes = most_echoes;
  p.sample_mm = static_cast<float>(sample_mm);
  p.sigma_mm = static_cast<float>(beam_width(view.probe, mhz, view.focus_mm, 1.0).axial_sigma_mm);
  p.fine_per_mm = static_cast<float>(fine / sample_mm);
  p.phases_per_mm = static_cast<float>(2.0 / shaders::us_wavelength_mm(mhz) * kPhases);
  return p;
}

std::vector<float> pulse_weights(const UltrasoundView& view, int fine) {
  const std::vector<PulseTap> taps = taps_of(view, fine);
  const auto padding = static_cast<std::size_t>((kUsOutputs - 1) * fine);
  std::vector<float> weights(taps.size() + 2 * padding, 0.0F);
  for (std::size_t i = 0; i < taps.size(); ++i) weights[padding + i] = taps[i].weight;
  return weights;
}

}  // namespace seldinger::imaging
