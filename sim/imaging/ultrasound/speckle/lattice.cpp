#include "sim/imaging/ultrasound/speckle/lattice.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/ultrasound.glsl.h"
#include "shaders/shared/ultrasound_lattice.glsl.h"
#include "sim/base/hash.h"
#include "sim/imaging/float_math.h"
#include "sim/imaging/ultrasound/speckle/pulse.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

constexpr double kReach = 2.5;  // σ of the lateral Gaussian
constexpr std::uint64_t kSalt = 0x1a771ce;

constexpr double kNodeMeanSquare = 1.0 / 3.0;  // of one part, uniform in [−1, 1)
// Interpolated noise is alike over about exp(−d²/2v), v in cells²: the Gaussian whose area is that of the mean
// autocorrelation, 1.5537 cells by integration over places within a cell.
constexpr double kAlikeVariance = 0.3842;

}  // namespace

LatticeField::LatticeField(const UltrasoundView& view, const TissueAt& tissue_at, const PictureMotion* motion)
    : view_(view), tissue_at_(tissue_at), motion_(motion), fan_(fan_of(view)) {
  const double frequency_mhz = working_mhz(view);
  at_sample_.resize(static_cast<std::size_t>(view.samples));
  const std::vector<PulseTap> taps =
      pulse_taps(beam_width(view.probe, frequency_mhz, 0.0, 1.0).axial_sigma_mm, fan_.sample_mm, 1);
  double axial = 0.0, axial_cell_mm = 0.0;
  for (int k = 0; k < view.samples; ++k) {
    const double depth_mm = (k + 0.5) * fan_.sample_mm;
    const double line_mm = fan_.beam_spacing_mm(depth_mm) / kLinesPerBeam;
    const BeamWidth width = beam_width(view.probe, frequency_mhz, view.focus_mm, std::max(depth_mm, 0.01));
    const double level = std::ceil(std::log2(std::max(line_mm, kLeastCellMm)));
    const double cell_mm = std::exp2(level);
    AtSample& at = at_sample_[static_cast<std::size_t>(k)];
    at.per_mm = static_cast<float>(1.0 / cell_mm);
    at.key = static_cast<std::uint32_t>(base::hash_combine(
        base::hash_combine(view.seed, kSalt), static_cast<std::uint64_t>(static_cast<std::int64_t>(level))));
    const double lines = width.lateral_sigma_mm / line_mm;  // σ
    at.lateral_scale = static_cast<float>(0.5 / (lines * lines));
    at.lateral_reach = static_cast<int>(std::floor(kReach * lines));
    most_reach_ = std::max(most_reach_, at.lateral_reach);
    // Across the beams the weights are summed as they are; along them the pulse has unit energy.
    const double variance = kAlikeVariance * cell_mm * cell_mm;
    double lateral = 0.0;
    for (int i = -at.lateral_reach; i <= at.lateral_reach; ++i)
      for (int j = -at.lateral_reach; j <= at.lateral_reach; ++j) {
        const double apart_mm = (i - j) * line_mm;
        lateral += std::exp(-(i * i + j * j) * 0.5 / (lines * lines) - 0.5 * apart_mm * apart_mm / variance);
      }
    if (cell_mm != axial_cell_mm) {
      axial_cell_mm = cell_mm;
      axial = 0.0;
      for (const PulseTap& one : taps)
        for (const PulseTap& other : taps) {
          const double apart_mm = (one.shift - other.shift) * fan_.sample_mm;
          axial += static_cast<double>(one.weight) * static_cast<double>(other.weight) *
                   std::exp(-0.5 * apart_mm * apart_mm / variance);
        }
    }
    at.gain = static_cast<float>(1.0 / std::sqrt(2.0 * kNodeMeanSquare * lateral * axial));
  }
}

void LatticeField::noise_line(double beam, std::vector<float>& re, std::vector<float>& im) const {
  const BeamPath path = path_of(fan_, motion_, beam);
  for (int k = 0; k < view_.samples; ++k) {
    const auto n = static_cast<std::size_t>(k);
    const AtSample& at = at_sample_[n];
    const glm::dvec3 p = path.at((k + 0.5) * fan_.sample_mm);
    const float tissue = tissue_at_.speckle(p);
    re[n] = im[n] = 0.0F;
    if (tissue == 0.0F) continue;
    const glm::dvec3 cell = p * static_cast<double>(at.per_mm), low = glm::floor(cell);
    const glm::vec3 part(cell - low);
    const std::uint32_t seed =
        shaders::us_lattice_seed(at.key, static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(low.z));
    const glm::vec4 noise = shaders::us_lattice_noise(seed, part.x, part.y, part.z);
    const float level = tissue * at.gain / noise.z;
    re[n] = level * noise.x;
    im[n] = level * noise.y;
  }
}

void LatticeField::add_beams(int first, int end, std::vector<std::int32_t>& out) const {
  const auto samples = static_cast<std::size_t>(view_.samples);
  out.assign(static_cast<std::size_t>(end - first) * samples * 2, 0);
  const int from = first * kLinesPerBeam - most_reach_,
            lines = (end - 1 - first) * kLinesPerBeam + 2 * most_reach_ + 1;
  std::vector<std::vector<float>> re(static_cast<std::size_t>(lines), std::vector<float>(samples)), im = re;
  for (int i = 0; i < lines; ++i)
    noise_line(static_cast<double>(from + i) / kLinesPerBeam, re[static_cast<std::size_t>(i)],
               im[static_cast<std::size_t>(i)]);
  for (int beam = first; beam < end; ++beam) {
    std::int32_t* sums = out.data() + static_cast<std::size_t>(beam - first) * samples * 2;
    for (std::size_t k = 0; k < samples; ++k) {
      const AtSample& at = at_sample_[k];
      float sum_re = 0.0F, sum_im = 0.0F;
      for (int off = -at.lateral_reach; off <= at.lateral_reach; ++off) {
        const auto line = static_cast<std::size_t>(beam * kLinesPerBeam + off - from);
        const float weight = float_exp(-static_cast<float>(off * off) * at.lateral_scale);
        sum_re += weight * re[line][k];
        sum_im += weight * im[line][k];
      }
      sums[2 * k] = static_cast<std::int32_t>(std::lrintf(kUnit * sum_re));
      sums[2 * k + 1] = static_cast<std::int32_t>(std::lrintf(kUnit * sum_im));
    }
  }
}

}  // namespace seldinger::imaging
