#include "sim/imaging/xray/picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "sim/base/check.h"
#include "sim/base/clones.h"
#include "sim/base/exact_math.h"
#include "sim/base/rows.h"
#include "sim/imaging/float_math.h"
#include "sim/imaging/noise.h"

namespace seldinger::imaging {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr float kLeastQuanta = 0.5F;  // below, the logarithm is cut: less than one quantum is nothing

// Calls work(first, end) on equal parts of `count` rows, none of fewer than 16.
template <class Work>
void over_parts(int count, int threads, const Work& work) {
  const int parts = std::clamp(threads, 1, std::max(1, count / 16));
  base::over_rows(parts, parts, [&](int part) { work(count * part / parts, count * (part + 1) / parts); });
}

SELDINGER_FOR_AVX2_TOO void means_from_logs(float* values, int count, float open_quanta, float scatter) noexcept {
  for (int i = 0; i < count; ++i) values[i] = open_quanta * (float_exp(values[i]) + scatter);
}

// Along a row whose `margin` values either side are set.
SELDINGER_FOR_AVX2_TOO void blur_row(const float* in, int count, const float* weights, int radius,
                                     float* out) noexcept {
  for (int i = 0; i < count; ++i) out[i] = weights[0] * in[i];
  for (int k = 1; k <= radius; ++k)
    for (int i = 0; i < count; ++i) out[i] += weights[k] * (in[i - k] + in[i + k]);
}

SELDINGER_FOR_AVX2_TOO void blur_column_step(const float* above, const float* below, int count, float weight,
                                             float* out) noexcept {
  for (int i = 0; i < count; ++i) out[i] += weight * (above[i] + below[i]);
}

SELDINGER_FOR_AVX2_TOO void logs_of_quanta(float* values, int count, float log_open) noexcept {
  for (int i = 0; i < count; ++i) {
    const float quanta = values[i] < kLeastQuanta ? kLeastQuanta : values[i];
    values[i] = float_log(quanta) - log_open;
  }
}

SELDINGER_FOR_AVX2_TOO void grey_row(const float* log_signal, int count, float low, float scale,
                                     unsigned char* grey) noexcept {
  for (int i = 0; i < count; ++i) {
    const float value = (log_signal[i] - low) * scale + 0.5F;
    const float clamped = value < 0.0F ? 0.0F : (value < 255.0F ? value : 255.0F);  // NaN: 255
    grey[i] = static_cast<unsigned char>(static_cast<int>(clamped));
  }
}

// Each part follows what is seen, the more the longer ago the frame before was. A panel that has shown nothing yet,
// or another field, or something later, holds what it sees.
template <typename OverOpen>
void add_lag(double field_side_mm, double t_s, const OverOpen& over_open, FluoroscopyPicture& picture) {
  std::vector<float>& quanta = picture.log_signal;
  const bool first = picture.lagging[0].size() != quanta.size() || picture.lagging_field_mm != field_side_mm ||
                     t_s < picture.lagging_t_s;
  const double frames = first ? 0.0 : (t_s - picture.lagging_t_s) / kLagFrameS;
  picture.lagging_field_mm = field_side_mm;
  picture.lagging_t_s = t_s;
  std::array<float, kLag.size()> share{}, left{};
  for (std::size_t k = 0; k < kLag.size(); ++k) {
    if (first) picture.lagging[k].assign(quanta.size(), 0.0F);
    share[k] = static_cast<float>(kLag[k].share);
    left[k] = first ? 0.0F : static_cast<float>(base::exact_exp(frames * base::exact_log(kLag[k].left_each_frame)));
    for (float& held : picture.lagging[k]) held *= left[k];  // also where leaves of lead are now
  }
  over_open([&](std::size_t i) {
    const float seen = quanta[i];
    quanta[i] = 0.0F;
    for (std::size_t k = 0; k < kLag.size(); ++k) {
      float& held = picture.lagging[k][i];
      held += (1.0F - left[k]) * seen;
      quanta[i] += share[k] * held;
    }
  });
}

// Of the open field, from quanta to their logarithm. One thread: a sum has one order.
void add_flaws(const PanelFlaws& flaws, double field_side_mm, double t_s, float log_open,
               FluoroscopyPicture& picture) {
  const OpenField& open = picture.open;
  const auto over_open = [&](const auto& each) {
    for (int row = open.first_row; row < open.end_row; ++row) {
      const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width_px);
      for (int column = open.first_column; column < open.end_column; ++column)
        each(first + static_cast<std::size_t>(column));
    }
  };
  std::vector<float>& quanta = picture.log_signal;
  if (flaws.glare_share > 0.0) {
    double sum = 0.0, count = 0.0;
    over_open([&](std::size_t i) {
      sum += static_cast<double>(quanta[i]);
      count += 1.0;
    });
    const auto veil = static_cast<float>(flaws.glare_share * sum / std::max(count, 1.0));
    const auto kept = static_cast<float>(1.0 - flaws.glare_share);
    over_open([&](std::size_t i) { quanta[i] = kept * quanta[i] + veil; });
  }
  if (flaws.lags)
    add_lag(field_side_mm, t_s, over_open, picture);
  else
    for (std::vector<float>& part : picture.lagging) part.clear();
  for (int row = open.first_row; row < open.end_row; ++row)
    logs_of_quanta(quanta.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(picture.width_px) +
                       static_cast<std::size_t>(open.first_column),
                   open.end_column - open.first_column, log_open);
}

}  // namespace

std::vector<float> blur_weights(double sigma_px) {
  CHECK(sigma_px >= 0.0 && sigma_px < 100.0);
  if (sigma_px == 0.0) return {1.0F};
  if (sigma_px <= 1.0) {
    // Least squares of H(f) = w₀ + 2Σwₖcos 2πkf, H(0) = 1, against the Gaussian's MTF, at the middles of kPoints
    // parts.
    constexpr int kRadius = 3, kPoints = 256;
    std::array<double, kRadius + 1> fitted{};
    double missing = 1.0;
    for (std::size_t k = 0; k <= kRadius; ++k) {
      for (int i = 0; i < kPoints; ++i) {
        const double f = 0.5 * (i + 0.5) / kPoints;
        fitted[k] += base::exact_exp(-2.0 * kPi * kPi * sigma_px * sigma_px * f * f) *
                     base::exact_cos(2.0 * kPi * static_cast<double>(k) * f) / kPoints;
      }
      missing -= (k == 0 ? 1.0 : 2.0) * fitted[k];
    }
    std::vector<float> result;
    for (const double weight : fitted) result.push_back(static_cast<float>(weight + missing / (2 * kRadius + 1)));
    return result;
  }
  std::vector<double> weights;
  double sum = 0.0;
  for (int k = 0; k <= static_cast<int>(std::ceil(4.0 * sigma_px)); ++k) {
    weights.push_back(base::exact_exp(-0.5 * k * k / (sigma_px * sigma_px)));
    sum += (k == 0 ? 1.0 : 2.0) * weights.back();
  }
  std::vector<float> normalised;
  for (const double weight : weights) normalised.push_back(static_cast<float>(weight / sum));
  return normalised;
}

LogWindow window_of(const std::vector<float>& log_signal, int width_px, const OpenField& open) {
  constexpr float kFrom = -20.0F, kPerUnit = 64.0F;
  constexpr int kBins = 1408, kNearlyOpen = static_cast<int>((20.0 - 0.7) * 64.0);  // half of the open beam
  std::array<std::array<int, kBins>, 2> counts{};  // two, so that equal neighbours do not wait for each other
  constexpr int kRowStep = 4;                      // a quarter of the rows tells the percentiles well enough
  for (int row = open.first_row; row < open.end_row; row += kRowStep) {
    const float* values = log_signal.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px);
    for (int column = open.first_column; column < open.end_column; ++column) {
      const float at = (values[column] - kFrom) * kPerUnit;
      const float clamped = at > 0.0F ? (at < kBins - 1.0F ? at : kBins - 1.0F) : 0.0F;
      ++counts[static_cast<std::size_t>(column & 1)][static_cast<std::size_t>(clamped)];
    }
  }
  long long all = 0, within = 0;
  for (std::size_t bin = 0; bin < kBins; ++bin) {
    counts[0][bin] += counts[1][bin];
    all += counts[0][bin];
    if (bin < kNearlyOpen) within += counts[0][bin];
  }
  const bool mostly_open = within * 10 < all;
  const long long total = mostly_open ? all : within;
  const auto percentile = [&](double share) {
    long long sum = 0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      sum += counts[0][bin];
      if (static_cast<double>(sum) >= share * static_cast<double>(total) && sum > 0)
        return static_cast<double>(kFrom) + (static_cast<double>(bin) + 0.5) / static_cast<double>(kPerUnit);
    }
    return 0.0;
  };
  // Not much further from the middle than soft tissue and bone go, so that the falling edge of a flank, or metal,
  // does not take the contrast from the rest.
  constexpr double kFarthestBelow = 2.0, kFarthestAbove = 1.5;
  const double middle = percentile(0.5);
  const double low = std::max(percentile(0.01), middle - kFarthestBelow);
  const double high = std::min(percentile(0.99), middle + kFarthestAbove);
  constexpr double kLeastWidth = 0.5;  // so that a flat field is not stretched to noise
  if (mostly_open) {                   // open beam is white
    const double width = std::max(-low, kLeastWidth);
    return {-0.5 * width, width};
  }
  return {0.5 * (low + high), std::max(high - low, kLeastWidth)};
}

void grey_from_log_signal(const float* log_signal, int count, const LogWindow& window,
                          unsigned char* grey) noexcept {
  const double width = std::max(window.width, 1e-6);
  grey_row(log_signal, count, static_cast<float>(window.center - 0.5 * width), static_cast<float>(255.0 / width),
           grey);
}

void render_picture(const BeamSignal& beam, const Detector& detector, double field_side_mm, const Pulse& pulse,
                    const PathLengths& lengths, const PictureSettings& settings, FluoroscopyPicture& picture) {
  const int width = lengths.width_px, height = lengths.height_px;
  CHECK(width > 0 && height > 0 && field_side_mm > 0.0 && pulse.sid_mm > 0.0);
  const auto row_start = [&](int row) { return static_cast<std::size_t>(row) * static_cast<std::size_t>(width); };
  const std::size_t pixels = row_start(height);
  CHECK(lengths.water_mm.size() == pixels);
  // What the collimator leaves open; the rest of the picture stays black, so it is cleared only when that changes.
  const OpenField open = open_field(width, height, pulse.collimator);
  const int columns = open.end_column - open.first_column, rows = open.end_row - open.first_row;
  if (picture.open.first_column != open.first_column || picture.open.first_row != open.first_row ||
      picture.grey.size() != pixels || picture.width_px != width || picture.open.end_row != open.end_row ||
      picture.open.end_column != open.end_column) {
    picture.grey.assign(pixels, 0);
    picture.log_signal.assign(pixels, 0.0F);
  }
  picture.width_px = width;
  picture.height_px = height;
  picture.open = open;

  // Quanta of the open beam in a pixel, the detector's blur, and the noise of this frame.
  const double pixel_mm = field_side_mm / width;
  const float open_quanta = static_cast<float>(pulse.grid_passes() * beam.open_quanta_per_mas_mm2() * pulse.mas() *
                                               pixel_mm * pixel_mm * 1e6 / (pulse.sid_mm * pulse.sid_mm));
  const auto scatter = static_cast<float>(pulse.scatter.value_or(0.0));
  const float log_open = float_log(std::max(open_quanta, 1e-30F));
  const std::vector<float> weights = blur_weights(detector.blur_sigma_mm / pixel_mm);
  const int radius = static_cast<int>(weights.size()) - 1;
  const NoiseKey key = noise_key(settings.seed, settings.frame);
  const auto electronic = static_cast<float>(detector.electronic_quanta);

  // Transmission, noise and blur along the rows, into picture.blurred.
  picture.blurred.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  float* const blurred = picture.blurred.data();
  const auto blurred_row = [&](int row) {
    return blurred + static_cast<std::size_t>(std::clamp(row, 0, rows - 1)) * static_cast<std::size_t>(columns);
  };
  over_parts(rows, settings.threads, [&](int first_row, int end_row) {
    std::vector<float> row_values(static_cast<std::size_t>(columns + 2 * radius)),
        means(static_cast<std::size_t>(columns));
    float* const values = row_values.data() + radius;
    for (int row = first_row; row < end_row; ++row) {
      const std::size_t first = row_start(open.first_row + row) + static_cast<std::size_t>(open.first_column);
      const auto from = [&](const std::vector<float>& mm) { return mm.empty() ? nullptr : mm.data() + first; };
      beam.log_shares(from(lengths.water_mm), from(lengths.mineral_mm), from(lengths.iron_mm),
                      from(lengths.contrast_mm), columns, means.data());
      means_from_logs(means.data(), columns, open_quanta, scatter);
      if (settings.noise)
        noisy_counts(means.data(), columns, key, static_cast<std::uint32_t>(first), electronic, values);
      else
        std::copy(means.begin(), means.end(), values);
      for (int k = 1; k <= radius; ++k) {
        values[-k] = values[0];
        values[columns - 1 + k] = values[columns - 1];
      }
      blur_row(values, columns, weights.data(), radius, blurred_row(row));
    }
  });
  // Blur across the rows, logarithm.
  over_parts(rows, settings.threads, [&](int first_row, int end_row) {
    for (int row = first_row; row < end_row; ++row) {
      float* const out =
          picture.log_signal.data() + row_start(open.first_row + row) + static_cast<std::size_t>(open.first_column);
      const float* const middle = blurred_row(row);
      for (int i = 0; i < columns; ++i) out[i] = weights[0] * middle[i];
      for (int k = 1; k <= radius; ++k)
        blur_column_step(blurred_row(row - k), blurred_row(row + k), columns, weights[static_cast<std::size_t>(k)],
                         out);
      if (!settings.flaws.any()) logs_of_quanta(out, columns, log_open);
    }
  });
  if (settings.flaws.any()) add_flaws(settings.flaws, field_side_mm, settings.t_s, log_open, picture);
  // Grey, by the window asked for or by the picture's own.
  picture.window = settings.window ? *settings.window : window_of(picture.log_signal, width, open);
  over_parts(rows, settings.threads, [&](int first_row, int end_row) {
    for (int row = first_row; row < end_row; ++row) {
      const std::size_t first = row_start(open.first_row + row) + static_cast<std::size_t>(open.first_column);
      grey_from_log_signal(picture.log_signal.data() + first, columns, picture.window, picture.grey.data() + first);
    }
  });
}

}  // namespace seldinger::imaging
