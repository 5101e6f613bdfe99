#include "sim/imaging/ultrasound/behind_air.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shaders/shared/ultrasound_line.glsl.h"
#include "sim/base/clones.h"
#include "sim/base/rows.h"
#include "sim/imaging/float_math.h"
#include "sim/imaging/noise.h"
#include "sim/imaging/ultrasound/mirror.h"
#include "sim/imaging/ultrasound/speckle/phase.h"
#include "sim/imaging/ultrasound/view/tissue_along.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

// Looks along a beam. Where shadows of gas have a haze, they are so close that what casts a shadow is not missed.
constexpr double kLookMm = 1.0, kCloseLookMm = 0.25;
constexpr int kLookHalvings = 5;
constexpr double kLeastHazeDb = -50.0;  // below liver at that depth: whatever is less drowns in clutter
constexpr int kHazeBesideBeams = 2, kMostTaps = 16;
constexpr std::uint64_t kHazeSeed = 0x6861'7a65;
constexpr std::uint32_t kMostSamples = 32768;  // of a beam, with those beyond its ends
// Neighbouring beams that differ by no more meet one surface; lung's is laid through so many beams on either side.
constexpr int kLineBesideBeams = 4;
constexpr double kMostStepMm = 4.0;

// Mean scatter of what lies before a look, by its class.
double source_db(std::span<const TissueClass> before, double look_mm) {
  static const auto kPowers = [] {
    std::array<double, volume::kTissueClasses> powers{};
    const auto amplitudes = speckle_amplitudes();
    for (std::size_t i = 0; i < powers.size(); ++i) {
      const bool is_matched = shaders::us_is_matched(acoustic_table()[i].impedance_mrayl);
      powers[i] = is_matched ? std::pow(static_cast<double>(amplitudes[i]), 2.0) : 0.0;
    }
    return powers;
  }();
  const auto most = static_cast<std::size_t>(kHazeFromMm / look_mm);
  double sum = 0.0;
  for (const TissueClass one : before.last(std::min(most, before.size())))
    sum += kPowers[static_cast<std::size_t>(one)];
  return 10.0 * std::log10(std::max(sum / static_cast<double>(most), 1e-20));
}

// `tissue`: of the looks.
AirMet air_on(const BeamPath& path, const TissueAt& tissue_at, const UltrasoundView& view, double look_mm,
              std::span<const TissueClass> tissue) {
  static const AcousticTable& plain = acoustic_table();
  const double mhz = working_mhz(view);
  const auto loss_db_mm = [&](TissueClass one) {
    const Acoustics& of = plain[static_cast<std::size_t>(one)];
    const bool told = of.soft && view.attenuation_db_cm_mhz;
    return shaders::us_loss_db_per_mm(told ? *view.attenuation_db_cm_mhz : of.attenuation_db_cm_mhz,
                                      told ? 1.0 : of.exponent, mhz);
  };
  AirMet met;
  double shift_mm = 0.0, loss_db = 0.0, db_mm = 0.0;
  TissueClass last = TissueClass::air;
  bool in_tissue = false;
  for (std::size_t i = 0; i < tissue.size(); ++i) {
    const double z_mm = (static_cast<double>(i) + 0.5) * look_mm;
    const TissueClass here = tissue[i];
    const Acoustics& of = plain[static_cast<std::size_t>(here)];
    if (in_tissue && (here == TissueClass::lung || (here == TissueClass::gas && shows_haze(view)))) {
      double above = z_mm - look_mm, below = z_mm;
      for (int half = 0; half < kLookHalvings; ++half) {
        const double middle = 0.5 * (above + below);
        (tissue_at(path.at(middle)) == here ? below : above) = middle;
      }
      met.tissue = here;
      met.depth_mm = 0.5 * (above + below);
      met.shown_mm = met.depth_mm + (view.range_error ? shift_mm : 0.0);
      met.loss_db = loss_db + db_mm * (met.depth_mm - (z_mm - 0.5 * look_mm));
      if (shows_haze(view)) met.source_db = source_db(tissue.first(i), look_mm);
      return met;
    }
    if (shaders::us_is_matched(of.impedance_mrayl)) {
      if (!in_tissue || here != last) db_mm = loss_db_mm(here);
      last = here;
      in_tissue = true;
      met.mrayl = of.impedance_mrayl;
      shift_mm += look_mm * shaders::us_shift_per_mm(1e-3 * of.speed_m_s);
      loss_db += look_mm * db_mm;
    } else if (in_tissue || z_mm > shaders::kUsGelMm) {
      return {};  // bone, or air, lies before it
    }
  }
  return {};
}

// A beam that slips by what both beams beside it meet is wider than what it slips through.
void close_gaps(std::span<AirMet> met) {
  for (std::size_t b = 1; b + 1 < met.size(); ++b) {
    const AirMet &one = met[b - 1], &other = met[b + 1];
    const bool both = one.tissue == TissueClass::gas && other.tissue == TissueClass::gas &&
                      std::abs(one.depth_mm - other.depth_mm) < kMostStepMm;
    if (both && met[b].depth_mm > std::max(one.depth_mm, other.depth_mm) + kMostStepMm) met[b] = one;
  }
}

// Of speckle, mean square 1: samples one after the other of one beam.
SELDINGER_FOR_AVX2_TOO
void make_noise(NoiseKey key, std::uint32_t first, std::span<float> re, std::span<float> im) noexcept {
  const std::array<float, 2>* const directions = phases().data();
  const auto count = static_cast<std::uint32_t>(re.size());
  float *const to_re = re.data(), *const to_im = im.data();
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t bits = noise_bits(key, first + i);
    const float u = (static_cast<float>(static_cast<std::int32_t>(bits >> 8)) + 0.5F) * 0x1.0p-24F;
    const float length = std::sqrt(-float_log(u));
    const std::array<float, 2>& direction = directions[4 * (bits & 255U)];
    to_re[i] = length * direction[0];
    to_im[i] = length * direction[1];
  }
}

// Gaussian weights −reach … reach whose squares add up to 1.
std::vector<float> weights(double sigma, int reach) {
  std::vector<float> all;
  double square = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    const double off = i / sigma;
    all.push_back(static_cast<float>(std::exp(-0.5 * off * off)));
    square += std::exp(-off * off);
  }
  for (float& one : all) one /= static_cast<float>(std::sqrt(square));
  return all;
}

SELDINGER_FOR_AVX2_TOO
void add_weighted(float weight, const float* from, std::size_t count, float* to) noexcept {
  for (std::size_t i = 0; i < count; ++i) to[i] += weight * from[i];
}

struct HazeLine {
  std::vector<float> re, im;
};

class HazePainter {
 public:
  HazePainter(const UltrasoundView& view, std::span<const AirMet> met)
      : view_(view),
        met_(met),
        fan_(fan_of(view)),
        sigma_mm_(beam_width(view.probe, working_mhz(view), view.focus_mm, 1.0).axial_sigma_mm),
        key_(noise_key(view.seed ^ kHazeSeed, 0)) {
    const double most_mm = (-kHazeBelowDb - kLeastHazeDb) / kHazeFallDbMm, axial = sigma_mm_ / fan_.sample_mm;
    double nearest_mm = view.depth_mm;
    for (const AirMet& one : met)
      if (has_haze(view, one)) nearest_mm = std::min(nearest_mm, one.shown_mm);
    count_ = static_cast<int>(std::min(most_mm, std::max(0.0, view.depth_mm - nearest_mm)) / fan_.sample_mm) + 1;
    along_ = weights(axial, std::clamp(static_cast<int>(std::ceil(2.5 * axial)), 1, kMostTaps));
    for (int k = 0; k < count_; ++k) {  // the same behind all gas, and all lung
      const double behind_mm = (k + 0.5) * fan_.sample_mm;
      of_gas_.push_back(static_cast<float>(shaders::us_amplitude(haze_db(view, {TissueClass::gas}, behind_mm))));
      of_lung_.push_back(static_cast<float>(shaders::us_amplitude(haze_db(view, {TissueClass::lung}, behind_mm))));
    }
  }

  HazeLine noise_of(int beam) const {
    const auto count = static_cast<std::size_t>(count_);
    const std::size_t padded = count + along_.size() - 1;
    HazeLine raw{std::vector<float>(padded), std::vector<float>(padded)},
        line{std::vector<float>(count, 0.0F), std::vector<float>(count, 0.0F)};
    make_noise(key_, static_cast<std::uint32_t>(beam) * kMostSamples, raw.re, raw.im);
    for (std::size_t i = 0; i < along_.size(); ++i) {
      add_weighted(along_[i], raw.re.data() + i, count, line.re.data());
      add_weighted(along_[i], raw.im.data() + i, count, line.im.data());
    }
    return line;
  }

  // `noise`: of the beams from `first` on, this one among them.
  void add_noise(int beam, int first, std::span<const HazeLine> noise, std::span<float> envelope) const {
    const AirMet& met = met_[static_cast<std::size_t>(beam)];
    const double across =
        beam_width(view_.probe, working_mhz(view_), view_.focus_mm, std::max(met.shown_mm, 1.0)).lateral_sigma_mm /
        fan_.beam_spacing_mm(met.shown_mm);
    const std::vector<float> weight = weights(across, kHazeBesideBeams);
    const auto count = static_cast<std::size_t>(count_);
    HazeLine sum{std::vector<float>(count, 0.0F), std::vector<float>(count, 0.0F)};
    double square = 0.0;
    for (std::size_t i = 0; i < noise.size(); ++i) {
      const float one = weight[static_cast<std::size_t>(first + static_cast<int>(i) - beam + kHazeBesideBeams)];
      square += static_cast<double>(one) * static_cast<double>(one);
      add_weighted(one, noise[i].re.data(), count, sum.re.data());
      add_weighted(one, noise[i].im.data(), count, sum.im.data());
    }
    const std::vector<float>& level = met.tissue == TissueClass::gas ? of_gas_ : of_lung_;
    const auto down = static_cast<float>(shaders::us_amplitude(met.source_db - met.loss_db) / std::sqrt(square));
    const auto from = static_cast<std::size_t>(std::max(0.0, std::ceil(met.shown_mm / fan_.sample_mm - 0.5)));
    for (std::size_t k = 0; k < count && from + k < envelope.size(); ++k) {
      const float re = envelope[from + k] + down * level[k] * sum.re[k], im = down * level[k] * sum.im[k];
      envelope[from + k] = std::sqrt(re * re + im * im);
    }
  }

  void add_lines(int beam, std::span<float> envelope) const {
    const AirMet& met = met_[static_cast<std::size_t>(beam)];
    // A straight line through how deep beams beside it meet lung.
    double n = 0.0, x = 0.0, z = 0.0, xx = 0.0, xz = 0.0;
    for (int i = -kLineBesideBeams; i <= kLineBesideBeams; ++i) {
      if (beam + i < 0 || beam + i >= view_.beams) continue;
      const AirMet& other = met_[static_cast<std::size_t>(beam + i)];
      if (other.tissue != TissueClass::lung || std::abs(other.shown_mm - met.shown_mm) > kMostStepMm) continue;
      n += 1.0, x += i, z += other.shown_mm, xx += i * i, xz += i * other.shown_mm;
    }
    const double spread = xx - x * x / n;
    if (!(spread > 0.0)) return;
    const double slope = (xz - x * z / n) / spread, depth_mm = (z - slope * x) / n;
    const double tilt = std::atan(slope / fan_.beam_spacing_mm(depth_mm));
    const double lung = acoustic_table()[static_cast<std::size_t>(TissueClass::lung)].impedance_mrayl;
    const double face = std::abs(shaders::us_reflection(met.mrayl, lung)) *
                        shaders::us_mirror(tilt, shaders::kUsInterfaceConeRad) *
                        shaders::us_amplitude(shaders::kUsInterfaceDb - met.loss_db);
    for (int again = 2; again <= shaders::kUsMostAgain && again * depth_mm < view_.depth_mm; ++again)
      add_pulse(again * depth_mm, face * shaders::us_repeat(again, met.loss_db), envelope);
  }

 private:
  void add_pulse(double depth_mm, double amplitude, std::span<float> envelope) const {
    const int reach = static_cast<int>(4.0 * sigma_mm_ / fan_.sample_mm) + 1,
              middle = static_cast<int>(depth_mm / fan_.sample_mm);
    for (int k = std::max(0, middle - reach); k <= std::min(view_.samples - 1, middle + reach); ++k) {
      const double off = ((k + 0.5) * fan_.sample_mm - depth_mm) / sigma_mm_;
      float& here = envelope[static_cast<std::size_t>(k)];
      here = static_cast<float>(std::hypot(static_cast<double>(here), amplitude * std::exp(-0.5 * off * off)));
    }
  }

  const UltrasoundView& view_;
  std::span<const AirMet> met_;
  Fan fan_;
  double sigma_mm_;
  NoiseKey key_;
  int count_ = 0;
  std::vector<float> along_, of_gas_, of_lung_;
};

}  // namespace

std::vector<AirMet> air_met(const UltrasoundView& view, const TissueAt& tissue_at, const PictureMotion* motion,
                            std::span<const float> depth_below_skin_mm) {
  if (!shows_artefacts(view)) return {};
  const Fan fan = fan_of(view);
  std::vector<AirMet> met(static_cast<std::size_t>(view.beams));
  const double look_mm = shows_haze(view) ? kCloseLookMm : kLookMm;
  std::vector<double> looks_mm;
  for (double z_mm = 0.5 * look_mm; z_mm < view.depth_mm; z_mm += look_mm) looks_mm.push_back(z_mm);
  std::vector<TissueClass> tissue(looks_mm.size());
  bool any = false;
  for (int b = 0; b < view.beams; ++b) {
    AirMet& one = met[static_cast<std::size_t>(b)];
    // What a beam in air shows is mirrored nowhere.
    one = {TissueClass::air, 0.0, 0.0};
    if (!beam_touches(view, depth_below_skin_mm, b)) continue;
    const BeamPath path = path_of(fan, motion, b);
    tissue_along(path, tissue_at, looks_mm, tissue);
    one = air_on(path, tissue_at, view, look_mm, tissue);
    any = any || one.tissue != TissueClass::air;
  }
  if (!any) met.clear();
  if (shows_haze(view)) close_gaps(met);
  return met;
}

bool has_haze(const UltrasoundView& view, const AirMet& met) noexcept {
  return shows_haze(view) &&
         (met.tissue == TissueClass::gas || (met.tissue == TissueClass::lung && met.depth_mm < kLeastMirrorMm));
}

double haze_db(const UltrasoundView& view, const AirMet& met, double behind_mm) noexcept {
  const auto power = [](double db) { return std::pow(10.0, 0.1 * db); };
  const double ring = met.tissue == TissueClass::gas ? power(kRingDb - kRingFallDbMm * behind_mm) : 0.0;
  return 10.0 * std::log10(power(-kHazeBelowDb - kHazeFallDbMm * behind_mm) + ring) + met.source_db - met.loss_db -
         shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, working_mhz(view)) * behind_mm;
}

void add_haze(const UltrasoundView& view, std::span<const AirMet> met, PolarPicture& picture) {
  std::vector<unsigned char> hazy(static_cast<std::size_t>(view.beams), 0);
  for (std::size_t b = 0; b < met.size(); ++b) hazy[b] = has_haze(view, met[b]) ? 1 : 0;
  if (std::find(hazy.begin(), hazy.end(), 1) == hazy.end()) return;
  const HazePainter painter(view, met);
  std::vector<HazeLine> noise(hazy.size());
  const auto beside = [&](int b) {
    return std::pair(std::max(0, b - kHazeBesideBeams), std::min(view.beams, b + kHazeBesideBeams + 1));
  };
  base::over_rows(view.beams, view.threads, [&](int b) {
    const auto [from, to] = beside(b);
    if (std::find(hazy.begin() + from, hazy.begin() + to, 1) != hazy.begin() + to)
      noise[static_cast<std::size_t>(b)] = painter.noise_of(b);
  });
  base::over_rows(view.beams, view.threads, [&](int b) {
    if (hazy[static_cast<std::size_t>(b)] == 0) return;
    const auto [from, to] = beside(b);
    const std::span<float> envelope =
        std::span(picture.envelope)
            .subspan(static_cast<std::size_t>(b) * static_cast<std::size_t>(view.samples),
                     static_cast<std::size_t>(view.samples));
    painter.add_noise(b, from,
                      std::span(noise).subspan(static_cast<std::size_t>(from), static_cast<std::size_t>(to - from)),
                      envelope);
    if (met[static_cast<std::size_t>(b)].tissue == TissueClass::lung) painter.add_lines(b, envelope);
  });
}

}  // namespace seldinger::imaging
