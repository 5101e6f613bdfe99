// From the envelope to the screen: what the console adds for depth, scan conversion, grey.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/check.h"
#include "sim/base/clones.h"
#include "sim/imaging/float_math.h"
#include "sim/imaging/noise.h"
#include "sim/imaging/ultrasound/speckle/phase.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {

namespace {

// Of mean squares, sample by sample from one on: in one of 256 directions, of a Rayleigh length of 24 bits.
SELDINGER_FOR_AVX2_TOO
void find_noise(NoiseKey key, std::size_t first, std::span<const float> mean_square, float* re,
                float* im) noexcept {
  const std::array<float, 2>* const directions = phases().data();
  const float* const squares = mean_square.data();
  const auto count = static_cast<std::uint32_t>(mean_square.size()), number = static_cast<std::uint32_t>(first);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t bits = noise_bits(key, number + i);
    const float u = (static_cast<float>(static_cast<std::int32_t>(bits >> 8)) + 0.5F) * 0x1.0p-24F;
    const float length = std::sqrt(-squares[i] * float_log(u));
    const std::array<float, 2>& direction = directions[4 * (bits & 255U)];
    re[i] = length * direction[0];
    im[i] = length * direction[1];
  }
}
SELDINGER_FOR_AVX2_TOO
void add_noise(const float* re, const float* im, std::size_t count, float* envelope) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const float sum = envelope[i] + re[i];
    envelope[i] = std::sqrt(sum * sum + im[i] * im[i]);
  }
}

}  // namespace

double display_gain_db(const UltrasoundView& view, const UltrasoundKnobs& knobs, double depth_mm) noexcept {
  const double frequency_mhz = working_mhz(view);
  const double at = std::clamp(7.0 * depth_mm / view.depth_mm, 0.0, 7.0);
  const auto low = static_cast<std::size_t>(at);
  return knobs.gain_db +
         shaders::us_between(knobs.tgc_db[low], knobs.tgc_db[std::min<std::size_t>(low + 1, 7)], at) +
         (view.method == UltrasoundMethod::thesis
              ? 0.0
              : shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, frequency_mhz) * depth_mm);
}

void add_receiver_noise(std::uint64_t seed, std::uint64_t frame, PolarPicture& picture) {
  const NoiseKey key = noise_key(seed, frame);
  const std::vector<float> mean_square(static_cast<std::size_t>(picture.samples),
                                       static_cast<float>(std::pow(10.0, kReceiverNoiseDb / 10.0)));
  std::vector<float> re(mean_square.size()), im(mean_square.size());
  for (std::size_t first = 0; first < picture.envelope.size(); first += mean_square.size()) {
    find_noise(key, first, mean_square, re.data(), im.data());
    add_noise(re.data(), im.data(), re.size(), picture.envelope.data() + first);
  }
}

double clutter_db(const UltrasoundView& view, double depth_mm) noexcept {
  return -kClutterBelowDb -
         (kClutterFallDbMm + shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, working_mhz(view))) *
             depth_mm;
}

void Clutter::add(const UltrasoundView& view, std::span<const float> depth_below_skin_mm, PolarPicture& picture) {
  if (!shows_clutter(view)) return;
  const auto samples = static_cast<std::size_t>(view.samples), beams = static_cast<std::size_t>(view.beams);
  const Of of{view.seed, view.beams, view.samples, view.depth_mm, working_mhz(view)};
  if (of != of_) {
    of_ = of;
    re_.resize(beams * samples);
    im_.resize(beams * samples);
    std::vector<float> mean_square;
    for (int k = 0; k < view.samples; ++k)
      mean_square.push_back(
          static_cast<float>(std::pow(10.0, 0.1 * clutter_db(view, (k + 0.5) * view.depth_mm / view.samples))));
    const NoiseKey key = noise_key(view.seed, 0);  // the receiver's begin with 1
    for (std::size_t first = 0; first < re_.size(); first += samples)
      find_noise(key, first, mean_square, re_.data() + first, im_.data() + first);
  }
  for (std::size_t b = 0; b < beams; ++b)
    if (beam_touches(view, depth_below_skin_mm, static_cast<int>(b)))
      add_noise(re_.data() + b * samples, im_.data() + b * samples, samples, picture.envelope.data() + b * samples);
}

void add_clutter(const UltrasoundView& view, std::span<const float> depth_below_skin_mm, PolarPicture& picture) {
  Clutter().add(view, depth_below_skin_mm, picture);
}

Screen screen_of(const UltrasoundView& view, DisplaySize size) noexcept {
  const Fan fan = fan_of(view);
  // From the outer edge of the first beam to that of the last.
  const double half = 0.5 * view.beams * fan.beam_step;
  const double half_width_mm =
      fan.curved ? (fan.radius_mm + view.depth_mm) * std::sin(std::min(half, 1.5707963)) : half;
  const double top_mm = fan.curved ? -fan.radius_mm * (1.0 - std::cos(half)) : 0.0;
  const double whole_mm = std::max(2.0 * half_width_mm / size.width_px, (view.depth_mm - top_mm) / size.height_px);
  return {size.pixel_mm > 0.0 ? size.pixel_mm : whole_mm, top_mm};
}

ScanConverter::ScanConverter(const UltrasoundView& view, DisplaySize size)
    : size_(size),
      beams_(view.beams),
      samples_(view.samples),
      sample_mm_(fan_of(view).sample_mm),
      screen_(screen_of(view, size)) {
  CHECK(size.width_px >= 1 && size.height_px >= 1 && view.beams >= 2 && view.samples >= 2);
  constexpr int kMost = std::numeric_limits<std::int16_t>::max();
  CHECK(view.beams <= kMost && view.samples <= kMost);
  sources_.resize(static_cast<std::size_t>(size.width_px) * static_cast<std::size_t>(size.height_px));
  std::size_t pixel = 0;
  for (int r = 0; r < size.height_px; ++r)
    for (int c = 0; c < size.width_px; ++c, ++pixel) {
      const double x_mm = (c - 0.5 * (size.width_px - 1)) * pixel_mm(), z_mm = top_mm() + (r + 0.5) * pixel_mm();
      const BeamAndDepth at = beam_and_depth(view, x_mm, z_mm);
      if (at.beam < -0.5 || at.beam > view.beams - 0.5 || at.depth_mm < 0.0 || at.depth_mm > view.depth_mm)
        continue;
      const double beam = std::clamp(at.beam, 0.0, view.beams - 1.0),
                   sample = std::clamp(at.depth_mm / sample_mm_ - 0.5, 0.0, view.samples - 1.0);
      const int b = std::min(static_cast<int>(beam), view.beams - 2),
                k = std::min(static_cast<int>(sample), view.samples - 2);
      const auto share = [](double fraction) {
        return static_cast<std::uint16_t>(std::min(65535.0, std::floor(fraction * 65536.0)));
      };
      sources_[pixel] = {static_cast<std::int16_t>(b), static_cast<std::int16_t>(k), share(beam - b),
                         share(sample - k)};
    }
}

void ScanConverter::grey(const UltrasoundView& view, const UltrasoundKnobs& knobs, const PolarPicture& polar,
                         std::vector<unsigned char>& grey) const {
  CHECK(polar.beams == beams_ && polar.samples == samples_ && knobs.dynamic_range_db > 0.0);
  std::vector<float> gain(static_cast<std::size_t>(samples_) + 1);
  for (int k = 0; k < samples_; ++k)
    gain[static_cast<std::size_t>(k)] =
        static_cast<float>(display_gain_db(view, knobs, (k + 0.5) * view.depth_mm / samples_));
  gain.back() = gain[static_cast<std::size_t>(samples_) - 1];
  grey.assign(sources_.size(), 0);
  const float per_db = static_cast<float>(255.0 / knobs.dynamic_range_db);
  const float black = static_cast<float>(kWhiteDb - knobs.dynamic_range_db);
  const float* envelope = polar.envelope.data();
  const auto map = grey_table(knobs.grey_map);
  for (int r = 0; r < size_.height_px; ++r) {
    const Source* source = sources_.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(size_.width_px);
    unsigned char* row = grey.data() + static_cast<std::size_t>(r) * static_cast<std::size_t>(size_.width_px);
    for (int c = 0; c < size_.width_px; ++c) {
      if (source[c].beam < 0) continue;
      const float down = source[c].down();
      const float level = source[c].level(envelope, samples_);
      const int k = source[c].sample;
      const float db = 8.6858896F * float_log(std::max(level, 1e-10F)) + gain[static_cast<std::size_t>(k)] +
                       down * (gain[static_cast<std::size_t>(k) + 1] - gain[static_cast<std::size_t>(k)]);
      const float value = (db - black) * per_db;
      // NaN fails both comparisons and shows.
      row[c] = value <= 0.0F ? 0 : (value < 255.0F ? static_cast<unsigned char>(value + 0.5F) : 255);
      if (level != level) row[c] = 255;
    }
    if (knobs.grey_map != GreyMap::linear)
      for (int c = 0; c < size_.width_px; ++c) row[c] = map[row[c]];
    if (knobs.flip) std::reverse(row, row + size_.width_px);
  }
}

std::vector<float> ScanConverter::envelope_db(const PolarPicture& polar) const {
  CHECK(polar.beams == beams_ && polar.samples == samples_);
  std::vector<float> db(sources_.size(), kLeastDb);
  for (std::size_t i = 0; i < sources_.size(); ++i)
    if (sources_[i].beam >= 0) db[i] = level_db_of(sources_[i].level(polar.envelope.data(), samples_));
  return db;
}

std::array<unsigned char, 256> grey_table(GreyMap map) noexcept {
  std::array<unsigned char, 256> table;
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double in = static_cast<double>(i) / 255.0;
    double out = in;
    if (map == GreyMap::lifted) out = std::sqrt(in);
    if (map == GreyMap::contrast) out = in * in * (3.0 - 2.0 * in);
    table[i] = static_cast<unsigned char>(std::lround(255.0 * out));
  }
  return table;
}

}  // namespace seldinger::imaging
