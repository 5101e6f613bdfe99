// The frame a person sees: noise power, blur, window and collimator, the same bits for any number of threads.
#include "sim/imaging/xray/picture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <cstring>
#include <numbers>
#include <vector>

#include "tests/sim/imaging/xray/flat_field.h"

namespace seldinger::imaging {
namespace {

constexpr double kFieldMm = 300.0;

// An abdomen of sorts, with ribs and a needle.
PathLengths patient(int size_px) {
  PathLengths lengths = flat(size_px, 0.0);
  lengths.iron_mm.assign(lengths.water_mm.size(), 0.0F);
  for (int row = 0; row < size_px; ++row)
    for (int column = 0; column < size_px; ++column) {
      const auto i = static_cast<std::size_t>(row * size_px + column);
      const double u = (column + 0.5) / size_px - 0.5, v = (row + 0.5) / size_px - 0.5;
      lengths.water_mm[i] = static_cast<float>(std::max(0.0, 230.0 * std::sqrt(std::max(0.0, 1.0 - 3.0 * u * u))));
      lengths.mineral_mm[i] = static_cast<float>(std::sin(40.0 * v + 5.0 * u) > 0.6 ? 8.0 : 0.0);
      if (std::abs(u - 0.3 * v) < 0.002) lengths.iron_mm[i] = 0.7F;
    }
  return lengths;
}

struct Chain {
  cases::Fluoroscope machine;
  Beams beams{machine};
  Pulse pulse{{75.0, 35.0, 8.0}, 1100.0, 0, {}};
  FluoroscopyPicture picture;

  const FluoroscopyPicture& of(const PathLengths& lengths, const PictureSettings& settings = {}) {
    render_picture(beams.at(pulse.technique.kv), beams.detector(), kFieldMm, pulse, lengths, settings, picture);
    return picture;
  }
};

double frequency_response(const std::vector<float>& weights, double cycles_per_px) {
  double h = static_cast<double>(weights[0]);
  for (std::size_t k = 1; k < weights.size(); ++k)
    h += 2.0 * static_cast<double>(weights[k]) *
         std::cos(2.0 * std::numbers::pi * cycles_per_px * static_cast<double>(k));
  return h;
}

// Asked for nothing it is the picture to the bit; glare lays its share of the mean under the rest; lag leaves what
// is published of what was there, by time.
TEST(Picture, GlareAndLagAreTheSharesThatAreAskedFor) {
  constexpr int kPx = 64;
  PathLengths open = flat(kPx, 100.0), shut = open;
  for (int i = 0; i < kPx * kPx / 4; ++i)
    shut.iron_mm.push_back(40.0F);  // a quarter behind what lets nothing through
  shut.iron_mm.resize(static_cast<std::size_t>(kPx * kPx), 0.0F);
  const auto signal = [](const FluoroscopyPicture& picture, int row) {
    return std::exp(static_cast<double>(picture.log_signal[static_cast<std::size_t>(row * kPx + kPx / 2)]));
  };
  Chain chain;
  PictureSettings settings;
  const std::vector<unsigned char> plain = chain.of(patient(kPx), settings).grey;
  settings.flaws = flaws_of(Panel::ideal);
  EXPECT_EQ(chain.of(patient(kPx), settings).grey, plain);
  settings.noise = false;
  const double clear = signal(chain.of(open, settings), kPx - 8);

  settings.flaws = {.glare_share = 0.05};
  Chain veiled;
  veiled.of(shut, settings);
  EXPECT_NEAR(signal(veiled.picture, 4), 0.05 * 0.75 * clear, 0.002 * clear) << "in the shadow";
  EXPECT_NEAR(signal(veiled.picture, kPx - 8), (0.95 + 0.05 * 0.75) * clear, 0.002 * clear) << "beside it";

  settings.flaws = {.lags = true};
  Chain lagging;
  EXPECT_NEAR(signal(lagging.of(open, settings), 4), clear, 1e-4 * clear) << "nothing was before the first";
  // Of what the panel no longer sees, in the four frames after: Siewerdsen and Jaffray 1999 (the first: 2 to 10 %).
  for (const double left : {0.047, 0.007, 0.004, 0.003}) {
    settings.t_s += kLagFrameS;
    EXPECT_NEAR(signal(lagging.of(shut, settings), 4), left * clear, 0.0003 * clear) << settings.t_s;
  }
  // By the time that has passed, not by how many pictures there were.
  Chain paused;
  settings.t_s = 0.0;
  paused.of(open, settings);
  settings.t_s = 3.0 * kLagFrameS;
  EXPECT_NEAR(signal(paused.of(shut, settings), 4), 0.004 * clear, 0.0003 * clear);
  EXPECT_NEAR(signal(paused.of(shut, settings), 4), 0.004 * clear, 0.0003 * clear) << "of the same pulse again";
  const auto again = paused.of(open, settings);
  EXPECT_NEAR(signal(again, kPx - 8), clear, 1e-4 * clear) << "where nothing changed nothing does";
  Chain fresh;
  paused.of(open, settings);
  settings.t_s += 60.0;
  EXPECT_EQ(paused.of(shut, settings).grey, fresh.of(shut, settings).grey) << "after a minute nothing is left";
  settings.t_s = 0.0;
  EXPECT_EQ(paused.of(open, settings).grey, Chain{}.of(open, settings).grey) << "who goes back begins anew";
  settings.flaws = {};
  fresh.of(shut, settings);
  EXPECT_EQ(lagging.of(shut, settings).grey, fresh.picture.grey) << "it is put off";
  for (const Panel panel : {Panel::flat_panel, Panel::intensifier}) {
    EXPECT_LE(flaws_of(panel).glare_share, 1.0 / 15.0);
  }
}

TEST(Picture, BlurHasTheMtfOfItsGaussian) {
  for (const double sigma_px : {0.0, 0.1, 0.27, 0.41, 0.55, 0.8, 1.0, 1.5, 3.0}) {
    const std::vector<float> weights = blur_weights(sigma_px);
    EXPECT_NEAR(frequency_response(weights, 0.0), 1.0, 1e-6) << sigma_px;
    for (double f = 0.0; f <= 0.5; f += 0.01) {
      const double gaussian = std::exp(-2.0 * std::pow(std::numbers::pi * sigma_px * f, 2.0));
      EXPECT_NEAR(frequency_response(weights, f), gaussian, f <= 0.4 ? 0.02 : 0.045) << sigma_px << ' ' << f;
    }
  }
}

// A grid of 1 and of 0.5 line pairs per mm keeps the panel's modulation: 0.6 at 1 lp/mm by its own description.
TEST(Picture, KeepsTheDetectorsModulation) {
  Chain chain;
  for (const double lp_per_mm : {0.25, 0.5}) {
    PathLengths lengths = flat(512, 150.0);
    const double pixel_mm = kFieldMm / 512;
    for (std::size_t i = 0; i < lengths.water_mm.size(); ++i)
      lengths.water_mm[i] += 0.5F * static_cast<float>(std::cos(2.0 * std::numbers::pi * lp_per_mm * pixel_mm *
                                                                static_cast<double>(i % 512)));
    PictureSettings settings;
    settings.noise = false;
    const auto amplitude = [&](const float* values) {
      std::complex<double> sum = 0.0;
      for (int i = 6; i < 506; ++i)
        sum += static_cast<double>(values[i]) * std::polar(1.0, -2.0 * std::numbers::pi * lp_per_mm * pixel_mm * i);
      return std::abs(sum);
    };
    const FluoroscopyPicture& picture = chain.of(lengths, settings);
    std::vector<float> sharp(512);
    const BeamSignal& beam = chain.beams.at(75.0);
    beam.log_shares(lengths.water_mm.data(), nullptr, nullptr, nullptr, 512, sharp.data());
    double mean = 0.0, mean_out = 0.0;
    for (int i = 0; i < 512; ++i) {
      mean += static_cast<double>(sharp[static_cast<std::size_t>(i)]) / 512.0;
      mean_out += static_cast<double>(picture.log_signal[static_cast<std::size_t>(256 * 512 + i)]) / 512.0;
    }
    std::vector<float> out(picture.log_signal.begin() + 256 * 512, picture.log_signal.begin() + 257 * 512);
    for (float& value : sharp) value -= static_cast<float>(mean);
    for (float& value : out) value -= static_cast<float>(mean_out);
    const double sigma_mm = chain.beams.detector().blur_sigma_mm;
    EXPECT_NEAR(amplitude(out.data()) / amplitude(sharp.data()),
                std::exp(-2.0 * std::pow(std::numbers::pi * sigma_mm * lp_per_mm, 2.0)), 0.02)
        << lp_per_mm;
  }
}

// A square of mineral in 250 mm of water: what it takes of the signal over the noise beside it, as a picture has
// them.
double contrast_to_noise(Chain& chain, double open, bool scatters) {
  constexpr int kSize = 256, kFrames = 12;
  PathLengths lengths = flat(kSize, 250.0);
  const auto from_middle = [](std::size_t i) {
    const int row = static_cast<int>(i) / kSize, column = static_cast<int>(i) % kSize;
    return std::max(std::abs(row - kSize / 2), std::abs(column - kSize / 2));
  };
  constexpr int kSquarePx = 16, kBesidePx = 40;
  for (std::size_t i = 0; i < lengths.water_mm.size(); ++i)
    if (from_middle(i) <= kSquarePx) lengths.mineral_mm[i] = 2.0F;
  chain.pulse.collimator = {open, open};
  chain.pulse.scatter.reset();
  if (scatters) chain.pulse.scatter = scatter_share(chain.beams, chain.pulse, flat(64, 250.0));
  double sum[2] = {}, squares = 0.0, count[2] = {};
  for (int frame = 0; frame < kFrames; ++frame) {
    PictureSettings settings;
    settings.frame = static_cast<std::uint64_t>(frame);
    const FluoroscopyPicture& picture = chain.of(lengths, settings);
    for (std::size_t i = 0; i < lengths.water_mm.size(); ++i) {
      const int away = from_middle(i);
      if (away > kBesidePx || (away > kSquarePx - 4 && away < kSquarePx + 4)) continue;
      const double signal = std::exp(static_cast<double>(picture.log_signal[i]));
      const std::size_t beside = away > kSquarePx ? 1 : 0;
      sum[beside] += signal;
      count[beside] += 1.0;
      if (beside == 1) squares += signal * signal;
    }
  }
  const double mean = sum[1] / count[1];
  return (mean - sum[0] / count[0]) / std::sqrt(squares / count[1] - mean * mean);
}

TEST(Picture, ContrastToNoiseRisesWhenCollimated) {
  Chain chain;
  chain.pulse.technique.ma = 200.0;
  const auto total_of_primary = [&] {
    return 1.0 + *chain.pulse.scatter / std::exp(chain.beams.at(75.0).log_share(250.0, 0.0));
  };
  const double open = contrast_to_noise(chain, 1.0, true), of_open = total_of_primary();
  const double closed = contrast_to_noise(chain, 0.4, true), of_closed = total_of_primary();
  EXPECT_GT(closed, 1.1 * open);
  EXPECT_NEAR(closed / open, std::sqrt(of_open / of_closed), 0.03) << "noise is that of all that arrives";
  const double primary = contrast_to_noise(chain, 1.0, false);
  EXPECT_NEAR(contrast_to_noise(chain, 0.4, false) / primary, 1.0, 0.02) << "nothing scatters: no field matters";
  EXPECT_NEAR(open / primary, std::sqrt(kGridPrimaryShare / of_open), 0.03);
}

// The noise of a flat field has the power of its quanta, shaped by the square of the blur's response.
TEST(Picture, NoisePowerHasTheShapeOfTheBlur) {
  Chain chain;
  constexpr int kSize = 256, kFrames = 64;
  const double pixel_mm = kFieldMm / kSize;
  Detector detector;
  detector.electronic_quanta = 0.0;
  detector.blur_sigma_mm = 0.6 * pixel_mm;
  const BeamSignal& beam = chain.beams.at(75.0);
  const PathLengths lengths = flat(kSize, 150.0);
  const double expected = beam.log_share(150.0, 0.0);
  const double quanta = std::exp(expected) * beam.open_quanta_per_mas_mm2() * chain.pulse.mas() * pixel_mm *
                        pixel_mm * 1e6 / (1100.0 * 1100.0);
  const std::vector<float> weights = blur_weights(0.6);
  // Power along rows (mean over rows and frames) at frequency k/kSize; the blur across rows takes a factor of all.
  double across = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k)
    across += (k == 0 ? 1.0 : 2.0) * static_cast<double>(weights[k]) * static_cast<double>(weights[k]);
  const std::vector<int> ks = {4, 16, 32, 48, 64, 96, 120};
  std::vector<double> power(ks.size(), 0.0);
  std::vector<std::complex<double>> phases;
  for (int i = 0; i < kSize; ++i) phases.push_back(std::polar(1.0, -2.0 * std::numbers::pi * i / kSize));
  for (int frame = 0; frame < kFrames; ++frame) {
    PictureSettings settings;
    settings.frame = static_cast<std::uint64_t>(frame);
    render_picture(beam, detector, kFieldMm, chain.pulse, lengths, settings, chain.picture);
    for (int row = 4; row < kSize - 4; row += 4) {  // rows four apart are nearly independent
      std::vector<double> values;
      for (int column = 0; column < kSize; ++column)
        values.push_back(
            std::exp(static_cast<double>(chain.picture.log_signal[static_cast<std::size_t>(row * kSize + column)]) -
                     expected));
      for (std::size_t k = 0; k < ks.size(); ++k) {
        std::complex<double> sum = 0.0;
        for (int column = 0; column < kSize; ++column)
          sum +=
              values[static_cast<std::size_t>(column)] * phases[static_cast<std::size_t>(ks[k] * column % kSize)];
        power[k] += std::norm(sum);
      }
    }
  }
  // About 4000 independent powers of exponential distribution: 3 σ is 5 %.
  for (std::size_t k = 0; k < ks.size(); ++k) {
    const double h = frequency_response(weights, static_cast<double>(ks[k]) / kSize);
    EXPECT_NEAR(power[k] / (kFrames * 62.0 * kSize) / (h * h * across / quanta), 1.0, 0.05) << ks[k];
  }
}

TEST(Picture, SameBitsForAnyNumberOfThreads) {
  Chain chain;
  const PathLengths lengths = patient(203);
  chain.pulse.collimator = {0.83, 0.61};
  PictureSettings settings;
  chain.of(lengths, settings);
  const FluoroscopyPicture one = chain.picture;
  for (const int threads : {2, 3, 7, 64}) {
    settings.threads = threads;
    chain.picture = {};
    chain.of(lengths, settings);
    EXPECT_EQ(chain.picture.grey, one.grey) << threads;
    EXPECT_EQ(
        std::memcmp(chain.picture.log_signal.data(), one.log_signal.data(), one.log_signal.size() * sizeof(float)),
        0);
  }
  settings.frame = 2;
  EXPECT_NE(chain.of(lengths, settings).grey, one.grey);
}

TEST(Picture, BonesAndNeedlesAreDark) {
  Chain chain;
  PathLengths lengths = flat(128, 200.0);
  lengths.iron_mm.assign(lengths.water_mm.size(), 0.0F);
  for (std::size_t i = 0; i < lengths.water_mm.size(); ++i) {
    if (i % 128 >= 64) lengths.mineral_mm[i] = 15.0F;
    if (i % 128 >= 20 && i % 128 < 30) lengths.iron_mm[i] = 0.7F;
  }
  PictureSettings settings;
  settings.noise = false;
  const FluoroscopyPicture& picture = chain.of(lengths, settings);
  const auto grey = [&](int column) {
    return static_cast<int>(picture.grey[static_cast<std::size_t>(64 * 128 + column)]);
  };
  EXPECT_LT(grey(100), grey(50) - 50);  // bone beside soft tissue
  EXPECT_LT(grey(25), grey(50) - 50);   // needle
  EXPECT_GT(grey(50), 200);
}

TEST(Picture, BehindTheLeavesItIsBlackAndDoesNotCount) {
  Chain chain;
  chain.pulse.collimator = {0.5, 0.75};
  PathLengths lengths = patient(256);
  const FluoroscopyPicture first = chain.of(lengths);
  const OpenField open = first.open;
  EXPECT_EQ(open.first_column, 64);
  EXPECT_EQ(open.end_row, 224);
  const auto inside = [&](int row, int column) {
    return row >= open.first_row && row < open.end_row && column >= open.first_column && column < open.end_column;
  };
  // Whatever lies behind the leaves changes nothing.
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column)
      if (!inside(row, column)) lengths.water_mm[static_cast<std::size_t>(row * 256 + column)] = NAN;
  chain.picture.grey.assign(chain.picture.grey.size(), 99);
  chain.picture.width_px = 0;  // as if another size had been drawn before
  const FluoroscopyPicture& second = chain.of(lengths);
  EXPECT_EQ(first.grey, second.grey);
  for (int row = 0; row < 256; ++row)
    for (int column = 0; column < 256; ++column)
      if (!inside(row, column)) {
        ASSERT_EQ(second.grey[static_cast<std::size_t>(row * 256 + column)], 0);
      }
  // Noise belongs to the pixel: opening the leaves changes it nowhere but at the border.
  PictureSettings settings;
  settings.window = first.window;
  chain.of(patient(256), settings);
  const std::vector<float> narrow = chain.picture.log_signal;
  chain.pulse.collimator = {};
  chain.of(patient(256), settings);
  for (int row = open.first_row + 3; row < open.end_row - 3; ++row)
    for (int column = open.first_column + 3; column < open.end_column - 3; ++column) {
      const auto i = static_cast<std::size_t>(row * 256 + column);
      ASSERT_EQ(narrow[i], chain.picture.log_signal[i]) << row << ' ' << column;
    }
}

TEST(Picture, WindowByHand) {
  const float values[] = {-5.0F, -4.0F, -3.0F, -2.0F, -1.0F, 0.0F, NAN, -INFINITY};
  unsigned char grey[8];
  grey_from_log_signal(values, 8, {-3.0, 2.0}, grey);
  EXPECT_EQ(grey[0], 0);
  EXPECT_EQ(grey[1], 0);
  EXPECT_EQ(grey[2], 128);
  EXPECT_EQ(grey[3], 255);
  EXPECT_EQ(grey[4], 255);
  EXPECT_EQ(grey[5], 255);
  EXPECT_EQ(grey[6], 255);  // NaN is seen
  EXPECT_EQ(grey[7], 0);
}

TEST(Picture, WindowSpansTheContentButNotTheOpenBeam) {
  Chain chain;
  PathLengths lengths = flat(256, 0.0);
  for (std::size_t i = 0; i < lengths.water_mm.size(); ++i)
    if (i % 256 >= 64) lengths.water_mm[i] = 100.0F + static_cast<float>(i % 256) * 0.5F;
  PictureSettings settings;
  settings.noise = false;
  const BeamSignal& beam = chain.beams.at(75.0);
  const LogWindow window = chain.of(lengths, settings).window;
  EXPECT_NEAR(window.center + 0.5 * window.width, beam.log_share(132.0, 0.0), 0.06);
  EXPECT_NEAR(window.center - 0.5 * window.width, beam.log_share(227.0, 0.0), 0.06);
  for (std::size_t i = 0; i < lengths.water_mm.size(); ++i)
    if (i / 256 < 40) lengths.mineral_mm[i] = 300.0F;  // metal takes no contrast from the rest
  const LogWindow metal = chain.of(lengths, settings).window;
  EXPECT_LT(metal.width, 3.5 + 0.01);
  EXPECT_LT(std::abs(metal.center - window.center), 1.0);
  const LogWindow air = chain.of(flat(256, 0.0), settings).window;
  EXPECT_NEAR(air.center + 0.5 * air.width, 0.0, 1e-9) << "open beam is white";
  EXPECT_GE(air.width, 0.5);
}

// Metres of bone, a pulse of almost nothing, NaN: a picture, and no NaN but where one went in.
TEST(Picture, NothingArrives) {
  Chain chain;
  PathLengths lengths = flat(64, 200.0);
  for (std::size_t i = 0; i < lengths.water_mm.size(); ++i)
    if (i % 64 >= 32) lengths.mineral_mm[i] = 3000.0F;
  for (const double ma : {35.0, 1e-9, 0.0}) {
    chain.pulse.technique.ma = ma;
    for (const float value : chain.of(lengths).log_signal) ASSERT_TRUE(std::isfinite(value)) << ma;
  }
  chain.pulse.technique.ma = 35.0;
  lengths.water_mm[64 * 30 + 10] = NAN;
  PictureSettings settings;
  settings.window = LogWindow{-4.0, 4.0};
  EXPECT_EQ(chain.of(lengths, settings).grey[64 * 30 + 10], 255);
  int seen = 0;
  for (const float value : chain.picture.log_signal) seen += std::isnan(value) ? 1 : 0;
  EXPECT_LE(seen, 49);  // no further than the blur carries it
}

}  // namespace
}  // namespace seldinger::imaging
