#include "sim/imaging/ultrasound/ultrasound_gpu.h"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

#include "shaders/shared/ultrasound_passes.glsl.h"
#include "sim/base/check.h"
#include "sim/base/embedded.h"
#include "sim/gpu/buffer.h"
#include "sim/gpu/program.h"
#include "sim/gpu/texture.h"
#include "sim/imaging/ultrasound/mirror.h"
#include "sim/imaging/ultrasound/speckle/phase.h"
#include "sim/imaging/ultrasound/ultrasound_blocks.h"
#include "sim/imaging/ultrasound/view/motion.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::embedded {
std::span<const base::EmbeddedFile> ultrasound_shaders();
}

namespace seldinger::imaging {
namespace {

using shaders::kUsOutputs;
constexpr int kGroup = 64;  // local_size of the shaders

std::string_view shader(std::string_view name) {
  return base::content_of(embedded::ultrasound_shaders(), name);
}

int groups(int count, int group) {
  return (count + group - 1) / group;
}

template <typename Block>
void write_block(gpu::Buffer& buffer, const Block& block) {
  buffer.write(std::as_bytes(std::span(&block, 1)));
}

// A buffer in storage that grows to what is asked of it.
class Storage {
 public:
  explicit Storage(gpu::Context& context) : buffer_(context, gpu::BufferUse::storage, 16) {}
  void need(std::size_t bytes) {
    if (buffer_.size() < bytes) buffer_.resize(bytes);
  }
  template <typename T>
  void write(std::span<const T> values) {
    need(values.size_bytes());
    buffer_.write(std::as_bytes(values));
  }
  template <typename T>
  void write(const std::vector<T>& values) {
    write(std::span<const T>(values));
  }
  void bind(int binding) const { buffer_.bind(binding); }
  gpu::Buffer& buffer() noexcept { return buffer_; }

 private:
  gpu::Buffer buffer_;
};

}  // namespace

// What only tissue that moves asks for.
struct MovedPrograms {
  explicit MovedPrograms(gpu::Context& context)
      : scatter(context, shader("ultrasound_scatter_moved.comp")),
        lattice_noise(context, shader("ultrasound_lattice_noise_moved.comp")),
        walk(context, shader("ultrasound_lines_moved.comp")),
        echo(context, shader("ultrasound_echoes_moved.comp")),
        block(context, gpu::BufferUse::uniform, sizeof(shaders::UsMotion)),
        slab(context),
        paths(context) {}
  gpu::Program scatter, lattice_noise, walk, echo;
  gpu::Buffer block;
  Storage slab, paths;
};

struct UltrasoundGpu::Parts {
  Parts(gpu::Context& context, const TissueVolume& the_tissue, LinesBy by, TissueMoves moves)
      : tissue(the_tissue),
        gpu_walks(by == LinesBy::gpu || (by == LinesBy::machine && !context.software())),
        voxel_from_lps(volume::voxel_from_lps(*the_tissue.volume)),
        voxels(context.handles(), the_tissue.volume->size_voxels, voxels_of(the_tissue)),
        scatter(context, shader("ultrasound_scatter.comp")),
        lattice_noise(context, shader("ultrasound_lattice_noise.comp")),
        lattice_beams(context, shader("ultrasound_lattice_beams.comp")),
        walk(context, shader("ultrasound_lines.comp")),
        echo(context, shader("ultrasound_echoes.comp")),
        shift(context, shader("ultrasound_shift.comp")),
        pulse(context, shader("ultrasound_pulse.comp")),
        pulse_shifted(context, shader("ultrasound_pulse_shifted.comp")),
        mirror(context, shader("ultrasound_mirror.comp")),
        tissue_block(context, gpu::BufferUse::uniform, sizeof(shaders::UsTissue)),
        lattice_parameters(context, gpu::BufferUse::uniform, sizeof(shaders::UsLatticeParameters)),
        scatter_parameters(context, gpu::BufferUse::uniform, sizeof(shaders::UsScatterParameters)),
        line_parameters(context, gpu::BufferUse::uniform, sizeof(shaders::UsLineParameters)),
        pulse_parameters(context, gpu::BufferUse::uniform, sizeof(shaders::UsPulseParameters)),
        mirror_parameters(context, gpu::BufferUse::uniform, sizeof(shaders::UsMirrorParameters)),
        phases(context, gpu::BufferUse::uniform, kPhases * sizeof(glm::vec4)),
        tiles(context),
        depths(context),
        noise(context),
        sums(context),
        beams(context),
        neighbours(context),
        loss_db(context),
        interfaces(context),
        counts(context),
        weights(context),
        through(context),
        shift_mm(context),
        echo_counts(context),
        echoes(context),
        laid(context),
        envelope(context),
        mirrors(context),
        mirrored(context) {
    std::vector<glm::vec4> turns;
    for (const auto& [re, im] : imaging::phases()) turns.emplace_back(re, im, 0.0F, 0.0F);
    phases.write(std::as_bytes(std::span(turns)));
    if (moves == TissueMoves::yes) moved.emplace(context);
  }

  // `motion`: null where tissue lies still.
  void add_scatterers(const UltrasoundView& view, const ScattererField& field, const PictureMotion* motion);
  void add_lattice(const UltrasoundView& view, const LatticeField& field, const PictureMotion* motion);
  int walk_by_gpu(const UltrasoundView& view, const LineWalker& walker, const PictureMotion* motion,
                  std::span<const float> depth_below_skin_mm);
  int walk_by_cpu(const UltrasoundView& view, const LineWalker& walker, std::span<const float> depth_below_skin_mm);
  void make_envelope(const UltrasoundView& view, const Inserted& inserted,
                     std::span<const float> depth_below_skin_mm, const tissue::Displacement& displacement);

  TissueVolume tissue;
  bool gpu_walks;
  glm::dmat4 voxel_from_lps;
  gpu::Texture voxels;
  gpu::Program scatter, lattice_noise, lattice_beams, walk, echo, shift, pulse, pulse_shifted, mirror;
  gpu::Buffer tissue_block, lattice_parameters, scatter_parameters, line_parameters, pulse_parameters,
      mirror_parameters, phases;
  Storage tiles, depths, noise, sums, beams, neighbours, loss_db, interfaces, counts, weights, through, shift_mm,
      echo_counts, echoes, laid, envelope, mirrors, mirrored;
  bool shows_mirrored = false;  // in the last picture
  std::vector<AirMet> met;      // there
  Storage& shown() noexcept { return shows_mirrored ? mirrored : envelope; }
  std::optional<MovedPrograms> moved;
};

void UltrasoundGpu::Parts::add_scatterers(const UltrasoundView& view, const ScattererField& field,
                                          const PictureMotion* motion) {
  const shaders::UsScatterParameters parameters = imaging::scatter_parameters(view, field.fine());
  const std::vector<shaders::UsTile> all = tiles_of(view, field, voxel_from_lps, motion);
  int most_rows = 1;
  for (const shaders::UsTile& tile : all) most_rows = std::max(most_rows, tile.rows_outer * tile.rows_middle);
  write_block(scatter_parameters, parameters);
  tiles.write(all);
  sums.buffer().clear();
  scatter_parameters.bind(0);
  tiles.bind(2);
  sums.bind(3);
  if (motion != nullptr) {
    write_block(moved->block, motion_block(*motion, voxel_from_lps, 0));
    moved->slab.write(motion->slab().nodes());
    moved->block.bind(3);
    moved->slab.bind(4);
  }
  (motion != nullptr ? moved->scatter : scatter)
      .dispatch(groups(most_rows, kGroup), static_cast<int>(all.size()), 1);
}

void UltrasoundGpu::Parts::add_lattice(const UltrasoundView& view, const LatticeField& field,
                                       const PictureMotion* motion) {
  const shaders::UsLatticeParameters parameters = imaging::lattice_parameters(view, field, voxel_from_lps);
  write_block(lattice_parameters, parameters);
  depths.write(lattice_depths(view, field));
  noise.need(static_cast<std::size_t>(parameters.lines) * static_cast<std::size_t>(view.samples) *
             sizeof(glm::vec2));
  lattice_parameters.bind(0);
  depths.bind(2);
  noise.bind(3);
  if (motion != nullptr) {
    std::vector<glm::vec4> list;
    for (int line = 0; line < parameters.lines; ++line)
      motion->append_path(static_cast<double>(line - parameters.lines_before) / LatticeField::kLinesPerBeam, list);
    write_block(moved->block, motion_block(*motion, voxel_from_lps, 0));
    moved->paths.write(list);
    moved->block.bind(3);
    moved->paths.bind(0);
  }
  (motion != nullptr ? moved->lattice_noise : lattice_noise)
      .dispatch(groups(parameters.lines, kGroup), view.samples, 1);
  sums.bind(4);
  lattice_beams.dispatch(groups(view.beams, kGroup), view.samples, 1);
}

// Both fill through, shift_mm, echo_counts and echoes, and answer how many echoes a beam has room for.
int UltrasoundGpu::Parts::walk_by_gpu(const UltrasoundView& view, const LineWalker& walker,
                                      const PictureMotion* motion, std::span<const float> depth_below_skin_mm) {
  const std::size_t count = static_cast<std::size_t>(view.beams),
                    polar = count * static_cast<std::size_t>(view.samples);
  write_block(line_parameters, imaging::line_parameters(tissue, view, walker));
  beams.write(beams_of(view, walker, voxel_from_lps, depth_below_skin_mm));
  std::vector<glm::vec4> list = neighbours_of(walker);
  if (motion != nullptr) {
    write_block(moved->block, motion_block(*motion, voxel_from_lps, list.size()));
    for (int beam = 0; beam < view.beams; ++beam) motion->append_path(beam, list);
    moved->block.bind(3);
  }
  neighbours.write(list);
  for (Storage* values : {&through, &loss_db, &shift_mm}) values->need(polar * sizeof(float));
  interfaces.need(count * shaders::kUsMostInterfaces * sizeof(glm::ivec4));
  counts.need(count * sizeof(glm::ivec2));
  echo_counts.need(count * sizeof(std::int32_t));
  echoes.need(count * shaders::kUsMostEchoes * sizeof(glm::vec4));
  voxels.bind(0);
  line_parameters.bind(0);
  tissue_block.bind(1);
  beams.bind(2);
  through.bind(3);
  loss_db.bind(4);
  shift_mm.bind(5);
  interfaces.bind(6);
  counts.bind(7);
  neighbours.bind(0);
  (motion != nullptr ? moved->walk : walk).dispatch(view.beams, 1, 1);
  counts.bind(1);
  loss_db.bind(3);
  shift_mm.bind(4);
  interfaces.bind(5);
  echo_counts.bind(6);
  echoes.bind(7);
  (motion != nullptr ? moved->echo : echo).dispatch(groups(view.beams, kGroup), shaders::kUsMostInterfaces, 1);
  return shaders::kUsMostEchoes;
}

int UltrasoundGpu::Parts::walk_by_cpu(const UltrasoundView& view, const LineWalker& walker,
                                      std::span<const float> depth_below_skin_mm) {
  const Lines lines = walked_lines(view, walker, depth_below_skin_mm);
  through.write(lines.through);
  if (view.range_error) shift_mm.write(lines.shift_mm);
  echo_counts.write(lines.echo_counts);
  echoes.write(lines.echoes);
  return lines.most_echoes;
}

void UltrasoundGpu::Parts::make_envelope(const UltrasoundView& view, const Inserted& inserted,
                                         std::span<const float> depth_below_skin_mm,
                                         const tissue::Displacement& displacement) {
  check_view(view, depth_below_skin_mm);
  CHECK(view.method != UltrasoundMethod::thesis);
  const std::optional<PictureMotion> moving = motion_of(view, displacement);
  const PictureMotion* motion = moving ? &*moving : nullptr;
  CHECK(motion == nullptr || moved);
  const TissueAt tissue_at(tissue, inserted);
  const std::unique_ptr<SpeckleField> field = speckle_field(view, tissue_at, motion);
  const int fine = field->fine();
  const std::size_t polar = static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples),
                    fine_polar = polar * static_cast<std::size_t>(fine);
  sums.need(fine_polar * sizeof(glm::ivec2));
  write_block(tissue_block, imaging::tissue_block(tissue, view, inserted));
  voxels.bind(0);
  tissue_block.bind(1);
  phases.bind(2);
  if (view.method == UltrasoundMethod::scatterers)
    add_scatterers(view, static_cast<const ScattererField&>(*field), motion);
  else
    add_lattice(view, static_cast<const LatticeField&>(*field), motion);

  const LineWalker walker(view, tissue_at, *tissue.volume, inserted, motion);
  const int most_echoes = gpu_walks ? walk_by_gpu(view, walker, motion, depth_below_skin_mm)
                                    : walk_by_cpu(view, walker, depth_below_skin_mm);
  met = air_met(view, tissue_at, motion, depth_below_skin_mm);
  const std::vector<shaders::UsMirror> meets = mirrors_of(view, met);
  shows_mirrored = !meets.empty() && view.beams > 1 && view.samples > 1;
  write_block(pulse_parameters, imaging::pulse_parameters(view, fine, most_echoes));
  weights.write(pulse_weights(view, fine));
  envelope.need(polar * sizeof(float));
  pulse_parameters.bind(0);
  if (view.range_error) {
    laid.need(fine_polar * sizeof(glm::vec2));
    shift_mm.bind(2);
    through.bind(3);
    sums.bind(4);
    laid.bind(5);
    shift.dispatch(groups(view.samples * fine, kGroup), view.beams, 1);
  }
  weights.bind(2);
  (view.range_error ? laid : through).bind(3);
  sums.bind(4);
  echo_counts.bind(5);
  echoes.bind(6);
  envelope.bind(7);
  (view.range_error ? pulse_shifted : pulse).dispatch(groups(view.samples, kGroup * kUsOutputs), view.beams, 1);
  if (!shows_mirrored) return;
  write_block(mirror_parameters, imaging::mirror_parameters(view));
  mirrors.write(meets);
  mirrored.need(polar * sizeof(float));
  mirror_parameters.bind(0);
  mirrors.bind(2);
  envelope.bind(3);
  mirrored.bind(4);
  mirror.dispatch(groups(view.samples, kGroup), view.beams, 1);
}

UltrasoundGpu::UltrasoundGpu(gpu::Context& context, const TissueVolume& tissue, LinesBy by, TissueMoves moves)
    : parts_(std::make_unique<Parts>(context, tissue, by, moves)) {}

UltrasoundGpu::~UltrasoundGpu() = default;

void UltrasoundGpu::polar(const UltrasoundView& view, const Inserted& inserted,
                          std::span<const float> depth_below_skin_mm, PolarPicture& picture,
                          const tissue::Displacement& displacement) {
  parts_->make_envelope(view, inserted, depth_below_skin_mm, displacement);
  picture.beams = view.beams;
  picture.samples = view.samples;
  picture.envelope.resize(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples));
  parts_->shown().buffer().read(std::as_writable_bytes(std::span(picture.envelope)));
  add_haze(view, parts_->met, picture);
}

std::size_t UltrasoundGpu::buffer_bytes() const noexcept {
  Parts& p = *parts_;
  std::size_t bytes = 0;
  for (const gpu::Buffer* buffer : {&p.tissue_block, &p.lattice_parameters, &p.scatter_parameters,
                                    &p.line_parameters, &p.pulse_parameters, &p.mirror_parameters, &p.phases})
    bytes += buffer->size();
  for (Storage* storage : {&p.tiles, &p.depths, &p.noise, &p.sums, &p.beams, &p.neighbours, &p.loss_db,
                           &p.interfaces, &p.counts, &p.weights, &p.through, &p.shift_mm, &p.echo_counts, &p.echoes,
                           &p.laid, &p.envelope, &p.mirrors, &p.mirrored})
    bytes += storage->buffer().size();
  if (p.moved) bytes += p.moved->block.size() + p.moved->slab.buffer().size() + p.moved->paths.buffer().size();
  return bytes;
}

std::size_t UltrasoundGpu::tissue_bytes() const noexcept {
  return parts_->tissue.classes.size() * sizeof(std::uint16_t);
}

}  // namespace seldinger::imaging
