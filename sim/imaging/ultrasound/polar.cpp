// From lines and scatterers to the envelope, a block of beams at a time.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/rows.h"
#include "sim/imaging/float_math.h"
#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/mirror.h"
#include "sim/imaging/ultrasound/speckle/lattice.h"
#include "sim/imaging/ultrasound/speckle/phase.h"
#include "sim/imaging/ultrasound/speckle/pulse.h"
#include "sim/imaging/ultrasound/speckle/scatterers.h"
#include "sim/imaging/ultrasound/thesis.h"
#include "sim/imaging/ultrasound/view/motion.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

// One thread's scratch for a block of beams.
struct Scratch {
  std::vector<std::int32_t> sums;
  Line line;
  std::vector<float> through, re, im;
  std::vector<float> part_re, part_im;  // fine samples, each part on its own, zeros at both ends
};

class PolarPainter {
 public:
  PolarPainter(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
               std::span<const float> depth_below_skin_mm, const PictureMotion* motion, PolarPicture& picture)
      : view_(view),
        fan_(fan_of(view)),
        tissue_at_(tissue, inserted),
        walker_(view, tissue_at_, *tissue.volume, inserted, motion),
        field_(speckle_field(view, tissue_at_, motion)),
        below_skin_mm_(depth_below_skin_mm),
        frequency_mhz_(working_mhz(view)),
        wavelength_mm_(shaders::us_wavelength_mm(frequency_mhz_)),
        sigma_mm_(beam_width(view.probe, frequency_mhz_, view.focus_mm, 1.0).axial_sigma_mm),
        taps_(pulse_taps(sigma_mm_, fan_.sample_mm, field_->fine())),
        picture_(picture) {
    for (const PulseTap& tap : taps_) taps_reach_ = std::max(taps_reach_, std::abs(tap.shift));
  }

  void paint(int first, int end, Scratch& scratch) const {
    field_->add_beams(first, end, scratch.sums);
    for (int beam = first; beam < end; ++beam) {
      walker_.walk(beam, beam_touches(view_, below_skin_mm_, beam), scratch.line);
      const std::size_t samples = static_cast<std::size_t>(view_.samples);
      paint_line(scratch.sums.data() + static_cast<std::size_t>(beam - first) * samples *
                                           static_cast<std::size_t>(field_->fine()) * 2,
                 scratch, picture_.envelope.data() + static_cast<std::size_t>(beam) * samples);
    }
  }

 private:
  void paint_line(const std::int32_t* sums, Scratch& scratch, float* envelope) const {
    const auto samples = static_cast<std::size_t>(view_.samples);
    scratch.re.assign(samples, 0.0F);
    scratch.im.assign(samples, 0.0F);
    if (scratch.line.contact) add_speckle(sums, scratch);
    for (const LineEcho& echo : scratch.line.echoes) add_echo(echo, scratch.re, scratch.im);
    for (const LineEcho& echo : scratch.line.echoes)
      if (echo.parting_per_mm != 0.0) weaken_behind(echo, scratch.re, scratch.im);
    for (std::size_t k = 0; k < samples; ++k)
      envelope[k] = std::sqrt(scratch.re[k] * scratch.re[k] + scratch.im[k] * scratch.im[k]);
  }

  void add_speckle(const std::int32_t* sums, Scratch& scratch) const {
    const auto samples = static_cast<std::size_t>(view_.samples), fine = static_cast<std::size_t>(field_->fine());
    scratch.through.resize(samples);
    // 10^(−dB/20), and what the sums are counted in.
    for (std::size_t k = 0; k < samples; ++k)
      scratch.through[k] = float_exp(-0.115129255F * scratch.line.loss_db[k]) * (1.0F / SpeckleField::kUnit);
    const std::size_t padded = samples + 2 * static_cast<std::size_t>(taps_reach_);
    scratch.part_re.assign(fine * padded, 0.0F);
    scratch.part_im.assign(fine * padded, 0.0F);
    if (scratch.line.shift_mm.empty())
      for (std::size_t part = 0; part < fine; ++part) {
        float* re = scratch.part_re.data() + part * padded + taps_reach_;
        float* im = scratch.part_im.data() + part * padded + taps_reach_;
        for (std::size_t k = 0; k < samples; ++k) {
          re[k] = static_cast<float>(sums[2 * (k * fine + part)]) * scratch.through[k];
          im[k] = static_cast<float>(sums[2 * (k * fine + part) + 1]) * scratch.through[k];
        }
      }
    else
      lay_shifted(sums, padded, scratch);
    for (const PulseTap& tap : taps_) {
      const std::ptrdiff_t from =
          static_cast<std::ptrdiff_t>(static_cast<std::size_t>(tap.part) * padded) + taps_reach_ + tap.shift;
      const float* re = scratch.part_re.data() + from;
      const float* im = scratch.part_im.data() + from;
      float* sum_re = scratch.re.data();
      float* sum_im = scratch.im.data();
      for (std::size_t k = 0; k < samples; ++k) sum_re[k] += tap.weight * re[k];
      for (std::size_t k = 0; k < samples; ++k) sum_im[k] += tap.weight * im[k];
    }
  }

  // Each fine sample where it shows, its phase with it.
  void lay_shifted(const std::int32_t* sums, std::size_t padded, Scratch& scratch) const {
    const auto fine = static_cast<std::size_t>(field_->fine());
    const auto count = static_cast<std::ptrdiff_t>(static_cast<std::size_t>(view_.samples) * fine);
    const float fine_per_mm = static_cast<float>(static_cast<double>(fine) / fan_.sample_mm);
    const float turns_per_mm = static_cast<float>(2.0 / wavelength_mm_);
    const auto& turn = phases();
    std::size_t from = 0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(view_.samples); ++k) {
      const float shift_mm = scratch.line.shift_mm[k], turns = shift_mm * turns_per_mm;
      const auto& phase = turn[static_cast<std::size_t>((turns - std::floor(turns)) * kPhases) % kPhases];
      const float cosine = phase[0] * scratch.through[k], sine = phase[1] * scratch.through[k];
      const auto shift = static_cast<std::ptrdiff_t>(std::floor(shift_mm * fine_per_mm + 0.5F));
      for (std::size_t part = 0; part < fine; ++part, ++from) {
        const std::ptrdiff_t to = static_cast<std::ptrdiff_t>(from) + shift;
        if (to < 0 || to >= count) continue;
        const auto at = static_cast<std::size_t>(to);
        const std::size_t place = (at % fine) * padded + static_cast<std::size_t>(taps_reach_) + at / fine;
        const float re = static_cast<float>(sums[2 * from]), im = static_cast<float>(sums[2 * from + 1]);
        scratch.part_re[place] += re * cosine - im * sine;
        scratch.part_im[place] += re * sine + im * cosine;
      }
    }
  }

  // The pulse itself, of the echo's amplitude at its peak, exactly where the echo is.
  void add_echo(const LineEcho& echo, std::vector<float>& re, std::vector<float>& im) const {
    const double turns = 2.0 * echo.depth_mm / wavelength_mm_,
                 angle = -2.0 * std::numbers::pi * (turns - std::floor(turns));
    const double cosine = std::cos(angle), sine = std::sin(angle), reach_mm = 4.0 * sigma_mm_;
    const int first = std::max(0, static_cast<int>(std::ceil((echo.depth_mm - reach_mm) / fan_.sample_mm - 0.5))),
              last = std::min(view_.samples - 1,
                              static_cast<int>(std::floor((echo.depth_mm + reach_mm) / fan_.sample_mm - 0.5)));
    for (int k = first; k <= last; ++k) {
      const double off = ((k + 0.5) * fan_.sample_mm - echo.depth_mm) / sigma_mm_;
      const double level = echo.amplitude * std::exp(-0.5 * off * off);
      re[static_cast<std::size_t>(k)] += static_cast<float>(level * cosine);
      im[static_cast<std::size_t>(k)] += static_cast<float>(level * sine);
    }
  }

  void weaken_behind(const LineEcho& echo, std::vector<float>& re, std::vector<float>& im) const {
    for (std::size_t k = 0; k < re.size(); ++k) {
      const double behind_mm = (static_cast<double>(k) + 0.5) * fan_.sample_mm - echo.depth_mm;
      const auto left = static_cast<float>(shaders::us_behind_edge(echo.parting_per_mm, behind_mm));
      re[k] *= left;
      im[k] *= left;
    }
  }

  const UltrasoundView& view_;
  Fan fan_;
  TissueAt tissue_at_;
  LineWalker walker_;
  std::unique_ptr<SpeckleField> field_;
  std::span<const float> below_skin_mm_;
  double frequency_mhz_, wavelength_mm_, sigma_mm_;
  std::vector<PulseTap> taps_;
  int taps_reach_ = 0;
  PolarPicture& picture_;
};

}  // namespace

std::unique_ptr<SpeckleField> speckle_field(const UltrasoundView& view, const TissueAt& tissue_at,
                                            const PictureMotion* motion) {
  switch (view.method) {
    case UltrasoundMethod::scatterers:
      return std::make_unique<ScattererField>(view, tissue_at, motion);
    case UltrasoundMethod::lattice:
      return std::make_unique<LatticeField>(view, tissue_at, motion);
    case UltrasoundMethod::thesis:
      break;
  }
  return nullptr;
}

void ultrasound_polar(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                      std::span<const float> depth_below_skin_mm, PolarPicture& picture,
                      const tissue::Displacement& displacement) {
  check_view(view, depth_below_skin_mm);
  picture.beams = view.beams;
  picture.samples = view.samples;
  picture.envelope.resize(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples));
  const std::optional<PictureMotion> motion = motion_of(view, displacement);
  const PictureMotion* moved = motion ? &*motion : nullptr;
  if (view.method == UltrasoundMethod::thesis) return thesis_polar(tissue, view, inserted, moved, picture);
  const PolarPainter painter(tissue, view, inserted, depth_below_skin_mm, moved, picture);
  // The same blocks for any number of threads. Wide enough that scatterers at their sides, which two blocks see,
  // are few; the arctangent's series wants them narrow.
  const int block = std::clamp(view.beams / 16, 1, 32), blocks = (view.beams + block - 1) / block;
  base::over_rows(
      blocks, view.threads, [] { return Scratch{}; },
      [&](int i, Scratch& scratch) { painter.paint(i * block, std::min(view.beams, (i + 1) * block), scratch); });
  const std::vector<AirMet> met = air_met(view, TissueAt(tissue, inserted), moved, depth_below_skin_mm);
  add_mirrored(view, mirrors_of(view, met), picture);
  add_haze(view, met, picture);
}

float level_db_of(float amplitude) noexcept {
  return 8.6858896F * float_log(std::max(amplitude, 1e-10F));
}

std::vector<float> polar_db(const PolarPicture& picture) {
  std::vector<float> db(picture.envelope.size());
  const auto beams = static_cast<std::size_t>(picture.beams), samples = static_cast<std::size_t>(picture.samples);
  for (std::size_t b = 0; b < beams; ++b)
    for (std::size_t k = 0; k < samples; ++k) db[k * beams + b] = level_db_of(picture.envelope[b * samples + k]);
  return db;
}

}  // namespace seldinger::imaging
