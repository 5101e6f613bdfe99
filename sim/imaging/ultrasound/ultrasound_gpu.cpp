#include "sim/imaging/ultrasound/ultrasound_gpu.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <string_view>

#include "shaders/shared/ultrasound.glsl.h"
#include "shaders/shared/ultrasound_passes.glsl.h"
#include "sim/base/check.h"
#include "sim/base/embedded.h"
#include "sim/gpu/buffer.h"
#include "sim/gpu/program.h"
#include "sim/gpu/texture.h"
#include "sim/imaging/ultrasound/echogenicity.h"
#include "sim/imaging/ultrasound/lattice.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/phase.h"
#include "sim/imaging/ultrasound/pulse.h"
#include "sim/imaging/ultrasound/scatterers.h"
#include "sim/imaging/ultrasound/view.h"
#include "sim/imaging/xray/noise.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> ultrasound_shaders();
}

namespace seldinger::imaging {
namespace {

using shaders::kUsOutputs;
using shaders::UsGreyParameters;
using shaders::UsLatticeDepth;
using shaders::UsLatticeParameters;
using shaders::UsPulseParameters;
using shaders::UsScatterParameters;
using shaders::UsTile;
using shaders::UsTissue;
static_assert(sizeof(UsTissue) == 800 && sizeof(UsScatterParameters) == 64 && sizeof(UsTile) == 304);
static_assert(sizeof(UsLatticeParameters) == 128 && sizeof(UsLatticeDepth) == 48);
static_assert(sizeof(UsPulseParameters) == 64 && sizeof(UsGreyParameters) == 64);
static_assert(shaders::kUsLinesPerBeam == LatticeField::kLinesPerBeam);
static_assert(shaders::kUsMaxLesions == kMaxLesions && shaders::kUsPhases == kPhases);
static_assert(volume::kTissueClasses <= 16);

constexpr int kGroup = 64;  // local_size of the shaders but of the screen's
constexpr int kGroupPx = 16;
constexpr int kTilesAcross = 16;

std::string_view shader(std::string_view name) {
  const auto files = embedded::ultrasound_shaders();
  const auto found = std::find_if(files.begin(), files.end(), [&](const auto& file) { return file.name == name; });
  CHECK(found != files.end());
  return found->content;
}

int groups(int count, int group) {
  return (count + group - 1) / group;
}

glm::vec4 vec4_from(const glm::dvec3& xyz, double w = 0.0) {
  return glm::vec4(glm::dvec4(xyz, w));
}

// A buffer in storage that grows to what is asked of it.
class Storage {
 public:
  explicit Storage(gpu::Context& context) : buffer_(context, gpu::BufferUse::storage, 16) {}
  void need(std::size_t bytes) {
    if (buffer_.size() < bytes) buffer_.resize(bytes);
  }
  template <typename T>
  void write(const std::vector<T>& values) {
    need(values.size() * sizeof(T));
    buffer_.write(std::as_bytes(std::span(values)));
  }
  gpu::Buffer& buffer() noexcept { return buffer_; }

 private:
  gpu::Buffer buffer_;
};

// Class and level of the echo in one number.
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
    t.lesion_amplitude[t.lesion_count].x = amplitude[static_cast<std::size_t>(tissue_of_lesion(lesion.hu))];
    ++t.lesion_count;
  }
  t.size_x = tissue.volume->size_voxels.x;
  t.size_y = tissue.volume->size_voxels.y;
  t.size_z = tissue.volume->size_voxels.z;
  t.no_offset = kNoEchoOffset;
  t.log_of_a_step = static_cast<float>(kEchoStepDb * std::log(10.0) / 20.0);
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

// Each scatterer belongs to one tile; those at the sides of the fan reach beams inside it.
std::vector<UsTile> tiles_of(const UltrasoundView& view, const ScattererField& field,
                             const glm::dmat4& voxel_from_lps) {
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
      tiles.push_back(t);
    }
  }
  return tiles;
}

// What lies along all beams.
struct Lines {
  std::vector<float> through;   // a sample: 10^(−dB/20), in what sums are counted in; 0 without contact
  std::vector<float> shift_mm;  // a sample; empty: nowhere
  std::vector<std::int32_t> echo_counts;
  std::vector<glm::vec4> echoes;  // most_echoes a beam: depth in mm, amplitude at that depth's phase
  int most_echoes = 1;
};

void walk_lines(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                std::span<const float> depth_below_skin_mm, Lines& lines) {
  const TissueAt tissue_at(tissue, inserted);
  const LineWalker walker(view, tissue_at, *tissue.volume, inserted);
  const double wavelength_mm = shaders::us_wavelength_mm(working_mhz(view));
  const auto samples = static_cast<std::size_t>(view.samples), beams = static_cast<std::size_t>(view.beams);
  lines.through.assign(beams * samples, 0.0F);
  lines.shift_mm.assign(view.range_error ? beams * samples : 0, 0.0F);
  lines.echo_counts.assign(beams, 0);
  std::vector<std::vector<LineEcho>> echoes(beams);
  Line line;
  for (std::size_t b = 0; b < beams; ++b) {
    const int beam = static_cast<int>(b);
    walker.walk(beam, touches(view, depth_below_skin_mm, beam), line);
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
                   angle = -6.283185307179586 * (turns - std::floor(turns));
      *to++ = glm::vec4(
          glm::dvec4(echo.depth_mm, echo.amplitude * std::cos(angle), echo.amplitude * std::sin(angle), 0.0));
    }
  }
}

}  // namespace

struct UltrasoundGpu::Parts {
  Parts(gpu::Context& context, const TissueVolume& the_tissue)
      : tissue(the_tissue),
        voxel_from_lps(volume::voxel_from_lps(*the_tissue.volume)),
        voxels(context.handles(), the_tissue.volume->size_voxels, voxels_of(the_tissue)),
        scatter(context, shader("ultrasound_scatter.comp")),
        lattice_noise(context, shader("ultrasound_lattice_noise.comp")),
        lattice_beams(context, shader("ultrasound_lattice_beams.comp")),
        shift(context, shader("ultrasound_shift.comp")),
        pulse(context, shader("ultrasound_pulse.comp")),
        pulse_shifted(context, shader("ultrasound_pulse_shifted.comp")),
        grey(context, shader("ultrasound_grey.comp")),
        tissue_block(context, gpu::BufferUse::uniform, sizeof(UsTissue)),
        lattice_parameters(context, gpu::BufferUse::uniform, sizeof(UsLatticeParameters)),
        scatter_parameters(context, gpu::BufferUse::uniform, sizeof(UsScatterParameters)),
        pulse_parameters(context, gpu::BufferUse::uniform, sizeof(UsPulseParameters)),
        grey_parameters(context, gpu::BufferUse::uniform, sizeof(UsGreyParameters)),
        phases(context, gpu::BufferUse::uniform, kPhases * sizeof(glm::vec4)),
        tiles(context),
        depths(context),
        noise(context),
        sums(context),
        weights(context),
        through(context),
        shift_mm(context),
        echo_counts(context),
        echoes(context),
        laid(context),
        envelope(context),
        gain(context),
        map(context),
        picture(context) {
    std::vector<glm::vec4> turns;
    for (const auto& [re, im] : imaging::phases()) turns.emplace_back(re, im, 0.0F, 0.0F);
    phases.write(std::as_bytes(std::span(turns)));
  }

  void add_scatterers(const UltrasoundView& view, const ScattererField& field);
  void add_lattice(const UltrasoundView& view, const LatticeField& field);
  void make_envelope(const UltrasoundView& view, const Inserted& inserted,
                     std::span<const float> depth_below_skin_mm, const NoiseKey* receiver);

  TissueVolume tissue;
  glm::dmat4 voxel_from_lps;
  gpu::Texture voxels;
  gpu::Program scatter, lattice_noise, lattice_beams, shift, pulse, pulse_shifted, grey;
  gpu::Buffer tissue_block, lattice_parameters, scatter_parameters, pulse_parameters, grey_parameters, phases;
  Storage tiles, depths, noise, sums, weights, through, shift_mm, echo_counts, echoes, laid, envelope, gain, map,
      picture;
  Lines lines;
};

void UltrasoundGpu::Parts::add_scatterers(const UltrasoundView& view, const ScattererField& field) {
  const UsScatterParameters parameters = imaging::scatter_parameters(view, field.fine());
  const std::vector<UsTile> all = tiles_of(view, field, voxel_from_lps);
  int most_rows = 1;
  for (const UsTile& tile : all) most_rows = std::max(most_rows, tile.rows_outer * tile.rows_middle);
  scatter_parameters.write(std::as_bytes(std::span(&parameters, 1)));
  tiles.write(all);
  sums.buffer().clear();
  scatter_parameters.bind(0);
  tiles.buffer().bind(2);
  sums.buffer().bind(3);
  scatter.dispatch(groups(most_rows, kGroup), static_cast<int>(all.size()), 1);
}

void UltrasoundGpu::Parts::add_lattice(const UltrasoundView& view, const LatticeField& field) {
  const UsLatticeParameters parameters = imaging::lattice_parameters(view, field, voxel_from_lps);
  lattice_parameters.write(std::as_bytes(std::span(&parameters, 1)));
  depths.write(lattice_depths(view, field));
  noise.need(static_cast<std::size_t>(parameters.lines) * static_cast<std::size_t>(view.samples) *
             sizeof(glm::vec2));
  lattice_parameters.bind(0);
  depths.buffer().bind(2);
  noise.buffer().bind(3);
  lattice_noise.dispatch(groups(parameters.lines, kGroup), view.samples, 1);
  sums.buffer().bind(4);
  lattice_beams.dispatch(groups(view.beams, kGroup), view.samples, 1);
}

void UltrasoundGpu::Parts::make_envelope(const UltrasoundView& view, const Inserted& inserted,
                                         std::span<const float> depth_below_skin_mm, const NoiseKey* receiver) {
  check_view(view, depth_below_skin_mm);
  CHECK(view.method != UltrasoundMethod::thesis);
  const TissueAt tissue_at(tissue, inserted);
  const std::unique_ptr<SpeckleField> field = speckle_field(view, tissue_at);
  const int fine = field->fine();
  const std::size_t polar = static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples);
  sums.need(polar * static_cast<std::size_t>(fine) * sizeof(glm::ivec2));
  const UsTissue block = imaging::tissue_block(tissue, view, inserted);
  tissue_block.write(std::as_bytes(std::span(&block, 1)));
  voxels.bind(0);
  tissue_block.bind(1);
  phases.bind(2);
  if (view.method == UltrasoundMethod::scatterers)
    add_scatterers(view, static_cast<const ScattererField&>(*field));
  else
    add_lattice(view, static_cast<const LatticeField&>(*field));

  walk_lines(tissue, view, inserted, depth_below_skin_mm, lines);
  const Fan fan = fan_of(view);
  const double mhz = working_mhz(view), sigma_mm = beam_width(view.probe, mhz, view.focus_mm, 1.0).axial_sigma_mm;
  const std::vector<PulseTap> taps = pulse_taps(sigma_mm, fan.sample_mm, fine);
  const auto padding = static_cast<std::size_t>((kUsOutputs - 1) * fine);
  std::vector<float> padded(taps.size() + 2 * padding, 0.0F);
  for (std::size_t i = 0; i < taps.size(); ++i) padded[padding + i] = taps[i].weight;
  UsPulseParameters p{};
  p.beams = view.beams;
  p.samples = view.samples;
  p.fine = fine;
  p.first_tap = taps.front().shift * fine + taps.front().part;
  p.taps = static_cast<int>(taps.size());
  p.most_echoes = lines.most_echoes;
  if (receiver != nullptr) {
    p.noisy = 1;
    p.noise_first = receiver->first;
    p.noise_second = receiver->second;
    p.noise_mean_square = static_cast<float>(std::pow(10.0, kReceiverNoiseDb / 10.0));
  }
  p.sample_mm = static_cast<float>(fan.sample_mm);
  p.sigma_mm = static_cast<float>(sigma_mm);
  p.fine_per_mm = static_cast<float>(fine / fan.sample_mm);
  p.phases_per_mm = static_cast<float>(2.0 / shaders::us_wavelength_mm(mhz) * kPhases);
  pulse_parameters.write(std::as_bytes(std::span(&p, 1)));
  weights.write(padded);
  through.write(lines.through);
  echo_counts.write(lines.echo_counts);
  echoes.write(lines.echoes);
  envelope.need(polar * sizeof(float));
  pulse_parameters.bind(0);
  if (!lines.shift_mm.empty()) {
    shift_mm.write(lines.shift_mm);
    laid.need(polar * static_cast<std::size_t>(fine) * sizeof(glm::vec2));
    shift_mm.buffer().bind(2);
    through.buffer().bind(3);
    sums.buffer().bind(4);
    laid.buffer().bind(5);
    shift.dispatch(groups(view.samples * fine, kGroup), view.beams, 1);
  }
  weights.buffer().bind(2);
  (lines.shift_mm.empty() ? through : laid).buffer().bind(3);
  sums.buffer().bind(4);
  echo_counts.buffer().bind(5);
  echoes.buffer().bind(6);
  envelope.buffer().bind(7);
  (lines.shift_mm.empty() ? pulse : pulse_shifted)
      .dispatch(groups(view.samples, kGroup * kUsOutputs), view.beams, 1);
}

UltrasoundGpu::UltrasoundGpu(gpu::Context& context, const TissueVolume& tissue)
    : parts_(std::make_unique<Parts>(context, tissue)) {}

UltrasoundGpu::~UltrasoundGpu() = default;

void UltrasoundGpu::polar(const UltrasoundView& view, const Inserted& inserted,
                          std::span<const float> depth_below_skin_mm, PolarPicture& picture) {
  parts_->make_envelope(view, inserted, depth_below_skin_mm, nullptr);
  picture.beams = view.beams;
  picture.samples = view.samples;
  picture.envelope.resize(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples));
  parts_->envelope.buffer().read(std::as_writable_bytes(std::span(picture.envelope)));
}

void UltrasoundGpu::grey(const UltrasoundView& view, const Inserted& inserted,
                         std::span<const float> depth_below_skin_mm, const UltrasoundKnobs& knobs, DisplaySize size,
                         std::uint64_t frame, std::vector<unsigned char>& grey) {
  CHECK(size.width_px >= 1 && size.height_px >= 1 && view.beams >= 2 && view.samples >= 2);
  CHECK(knobs.dynamic_range_db > 0.0);
  Parts& parts = *parts_;
  const NoiseKey noise = noise_key(view.seed, frame);
  parts.make_envelope(view, inserted, depth_below_skin_mm, &noise);

  const Fan fan = fan_of(view);
  const Screen screen = screen_of(view, size);
  std::vector<float> gain(static_cast<std::size_t>(view.samples) + 1);
  for (int k = 0; k < view.samples; ++k)
    gain[static_cast<std::size_t>(k)] = static_cast<float>(display_gain_db(view, knobs, (k + 0.5) * fan.sample_mm));
  gain.back() = gain[static_cast<std::size_t>(view.samples) - 1];
  UsGreyParameters p{};
  p.width_px = size.width_px;
  p.height_px = size.height_px;
  p.beams = view.beams;
  p.samples = view.samples;
  p.pixel_mm = static_cast<float>(screen.pixel_mm);
  p.top_mm = static_cast<float>(screen.top_mm);
  p.radius_mm = static_cast<float>(fan.radius_mm);
  p.first_beam = static_cast<float>(fan.first_beam);
  p.beam_step = static_cast<float>(fan.beam_step);
  p.sample_mm = static_cast<float>(fan.sample_mm);
  p.depth_mm = static_cast<float>(view.depth_mm);
  p.black_db = static_cast<float>(kWhiteDb - knobs.dynamic_range_db);
  p.per_db = static_cast<float>(255.0 / knobs.dynamic_range_db);
  p.curved = fan.curved ? 1 : 0;
  p.flipped = knobs.flip ? 1 : 0;
  p.mapped = knobs.grey_map != GreyMap::linear ? 1 : 0;
  const auto map = grey_table(knobs.grey_map);
  parts.map.write(std::vector<std::uint32_t>(map.begin(), map.end()));
  parts.grey_parameters.write(std::as_bytes(std::span(&p, 1)));
  parts.gain.write(gain);
  const int words = groups(size.width_px, shaders::kUsPixels);
  const std::size_t bytes =
      static_cast<std::size_t>(words) * static_cast<std::size_t>(size.height_px) * sizeof(std::uint32_t);
  parts.picture.need(bytes);
  parts.grey_parameters.bind(0);
  parts.envelope.buffer().bind(1);
  parts.gain.buffer().bind(2);
  parts.map.buffer().bind(3);
  parts.picture.buffer().bind(4);
  parts.grey.dispatch(groups(words, kGroupPx), groups(size.height_px, kGroupPx), 1);
  grey.resize(bytes);
  parts.picture.buffer().read(std::as_writable_bytes(std::span(grey)));
  // Rows end with what fills their last number.
  const auto width = static_cast<std::size_t>(size.width_px), row = static_cast<std::size_t>(words) * 4;
  if (row != width)
    for (std::size_t r = 1; r < static_cast<std::size_t>(size.height_px); ++r)
      std::copy_n(grey.begin() + static_cast<std::ptrdiff_t>(r * row), width,
                  grey.begin() + static_cast<std::ptrdiff_t>(r * width));
  grey.resize(width * static_cast<std::size_t>(size.height_px));
}

std::size_t UltrasoundGpu::buffer_bytes() const noexcept {
  Parts& p = *parts_;
  std::size_t bytes = 0;
  for (const gpu::Buffer* buffer : {&p.tissue_block, &p.lattice_parameters, &p.scatter_parameters,
                                    &p.pulse_parameters, &p.grey_parameters, &p.phases})
    bytes += buffer->size();
  for (Storage* storage : {&p.tiles, &p.depths, &p.noise, &p.sums, &p.weights, &p.through, &p.shift_mm,
                           &p.echo_counts, &p.echoes, &p.laid, &p.envelope, &p.gain, &p.map, &p.picture})
    bytes += storage->buffer().size();
  return bytes;
}

}  // namespace seldinger::imaging
