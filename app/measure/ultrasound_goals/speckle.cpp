#include "app/measure/ultrasound_goals/speckle.h"

#include <algorithm>
#include <array>

#include "app/measure/ultrasound_goals/polar_levels.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::measure {

using imaging::BeamWidth;
using imaging::PolarPicture;
using imaging::UltrasoundView;

namespace {

// At 128 beams one would measure their spacing.
constexpr int kManyBeams = 512;

const TissueBlock& liver() {
  static const TissueBlock kLiver = block_of(volume::TissueClass::liver);
  return kLiver;
}

BeamWidth width_at(const UltrasoundView& view, double depth_mm) {
  return imaging::beam_width(view.probe, working_mhz(view), view.focus_mm, depth_mm);
}

SpeckleStatistics statistics_of(std::vector<double>& envelope) {
  double s1 = 0, s2 = 0, s4 = 0;
  for (const double v : envelope) s1 += v, s2 += v * v, s4 += v * v * v * v;
  const double n = static_cast<double>(envelope.size()), mean = s1 / n, square = s2 / n;
  SpeckleStatistics found{};
  found.snr = mean / std::sqrt(square - mean * mean);
  found.nakagami_m = square * square / (s4 / n - square * square);
  found.mean_square = square;
  std::sort(envelope.begin(), envelope.end());
  for (std::size_t i = 0; i < envelope.size(); ++i)
    found.ks = farther(found.ks, std::abs((static_cast<double>(i) + 0.5) / n -
                                          (1.0 - std::exp(-envelope[i] * envelope[i] / square))));
  return found;
}

// exp(−lag²/2σ²) through the correlation at one lag → FWHM. 0 where nothing is alike.
double fwhm_from(double lag_mm, double r) {
  return r > 0.0 ? shaders::kUsFwhmPerSigma * lag_mm / std::sqrt(-2.0 * std::log(std::min(r, 1.0))) : 0.0;
}

// Around a depth, `beams_off` further on; envelope or intensity.
std::vector<double> window(const PolarPicture& picture, int middle, int half, int beams_off, bool squared) {
  std::vector<double> values;
  for (int b = 20; b < picture.beams - 20; ++b)
    for (int k = std::max(0, middle - half); k < std::min(picture.samples, middle + half); ++k) {
      const double v = at(picture, b + beams_off, k);
      values.push_back(squared ? v * v : v);
    }
  return values;
}

// The same tissue seen from `beams` further along the face.
UltrasoundView moved_along(UltrasoundView view, double beams) {
  const imaging::Fan fan = imaging::fan_of(view);
  const double middle = 0.5 * (view.beams - 1);
  view.origin_lps_mm = fan.start_lps_mm(middle + beams);
  if (fan.curved) {
    view.axial = fan.direction(middle + beams);
    view.lateral = glm::cross(view.axial, -fan.elevation);
  }
  return view;
}

}  // namespace

std::vector<SpeckleStatistics> speckle_statistics(const Setting& setting) {
  constexpr int kDepths = 5;
  UltrasoundView view = setting.lossless_view();
  std::array<std::vector<double>, kDepths> envelope;
  std::array<double, kDepths> cells_a_frame;
  const double window_mm = 80.0 / 1024.0 * view.depth_mm;
  for (std::size_t d = 0; d < kDepths; ++d) {
    const double depth_mm = (0.1 + 0.2 * static_cast<double>(d)) * view.depth_mm;
    const BeamWidth width = width_at(view, depth_mm);
    // A cell is √(2π)·σ long and wide; of beams no more than there are.
    const double across =
        std::min(1.0, imaging::fan_of(view).beam_spacing_mm(depth_mm) / (2.5066 * width.lateral_sigma_mm)) *
        view.beams;
    cells_a_frame[d] = across * window_mm / (2.5066 * width.axial_sigma_mm);
  }
  const double fewest = *std::min_element(cells_a_frame.begin(), cells_a_frame.end());
  const int frames = std::max(setting.frames(8), static_cast<int>(std::ceil(kLeastCells / fewest)));
  for (int frame = 1; frame <= frames; ++frame) {
    view.seed = static_cast<std::uint64_t>(frame);
    const PolarPicture picture = setting.picture(liver(), view);
    for (std::size_t d = 0; d < kDepths; ++d) {
      const double depth_mm = (0.1 + 0.2 * static_cast<double>(d)) * view.depth_mm;
      for (int b = 0; b < view.beams; ++b)
        for (int k = sample_at(view, depth_mm - 0.5 * window_mm); k < sample_at(view, depth_mm + 0.5 * window_mm);
             ++k)
          envelope[d].push_back(at(picture, b, k));
    }
  }
  std::vector<SpeckleStatistics> found;
  for (std::size_t d = 0; d < kDepths; ++d) {
    found.push_back(statistics_of(envelope[d]));
    found.back().depth_mm = (0.1 + 0.2 * static_cast<double>(d)) * view.depth_mm;
    found.back().cells = frames * cells_a_frame[d];
  }
  return found;
}

void measure_statistics(const Setting& setting, Readings& readings) {
  read_statistics(setting, speckle_statistics(setting), readings);
}

void read_statistics(const Setting& setting, std::span<const SpeckleStatistics> at_depths, Readings& readings) {
  double snr = 0.0, ks = 0.0, m = 0.0;
  for (const SpeckleStatistics& found : at_depths) {
    snr = farther(snr, std::abs(found.snr - kRayleighSnr));
    ks = farther(ks, found.ks);
    m = farther(m, std::abs(found.nakagami_m - 1.0));
  }
  const std::string probe(setting.probe.name);
  readings.push_back({6, "SNR of the envelope, 5 depths", probe, snr, "", 0.06, 0.03});
  readings.push_back({6, "distance to Rayleigh (KS)", probe, ks, "", 0.03, 0.015});
  readings.push_back({6, "Nakagami's m off 1", probe, m, "", 0.1, 0.1});
}

WidthRatios speckle_widths(const Setting& setting, double share_of_depth) {
  UltrasoundView view = setting.lossless_view();
  view.beams = std::max(view.beams, kManyBeams);
  const imaging::Fan fan = imaging::fan_of(view);
  const double depth_mm = share_of_depth * view.depth_mm;
  const BeamWidth width = width_at(view, depth_mm);
  const int middle = sample_at(view, depth_mm), half = 60 * view.samples / 1024 + 1;
  // Lags of about one σ.
  const int down = std::max(1, static_cast<int>(std::lround(width.axial_sigma_mm / fan.sample_mm)));
  const int across =
      std::max(1, static_cast<int>(std::lround(width.lateral_sigma_mm / fan.beam_spacing_mm(depth_mm))));
  const double out_mm = width.elevation_sigma_mm;
  std::vector<double> here, below, beside, away;
  const int frames = std::max(3, setting.frames(3));
  for (int frame = 1; frame <= frames; ++frame) {
    view.seed = static_cast<std::uint64_t>(frame);
    view.origin_lps_mm = {0, 0, 0};
    const PolarPicture picture = setting.picture(liver(), view);
    view.origin_lps_mm = {0, 0, out_mm};
    const PolarPicture other = setting.picture(liver(), view);
    const auto squared = [](float v) { return double{v} * v; };
    for (int b = 0; b + across < view.beams; ++b)
      for (int k = middle - half; k < middle + half && k + down < view.samples; ++k) {
        here.push_back(squared(at(picture, b, k)));
        below.push_back(squared(at(picture, b, k + down)));
        beside.push_back(squared(at(picture, b + across, k)));
        away.push_back(squared(at(other, b, k)));
      }
  }
  const double per_sigma = shaders::kUsFwhmPerSigma;
  return {fwhm_from(down * fan.sample_mm, correlation(here, below)) / (per_sigma * width.axial_sigma_mm),
          fwhm_from(across * fan.beam_spacing_mm(depth_mm), correlation(here, beside)) /
              (per_sigma * width.lateral_sigma_mm),
          fwhm_from(out_mm, correlation(here, away)) / (per_sigma * width.elevation_sigma_mm)};
}

void measure_widths(const Setting& setting, Readings& readings) {
  WidthRatios worst{};
  for (const double share : {0.2, 0.5, 0.85}) {
    const WidthRatios found = speckle_widths(setting, share);
    worst.axial = farther(worst.axial, 100.0 * std::abs(found.axial - 1.0));
    worst.lateral = farther(worst.lateral, 100.0 * std::abs(found.lateral - 1.0));
    worst.elevation = farther(worst.elevation, 100.0 * std::abs(found.elevation - 1.0));
  }
  const std::string probe(setting.probe.name);
  readings.push_back({7, "length of speckle", probe, worst.axial, "%", 10.0, 3.0});
  readings.push_back({7, "width of speckle", probe, worst.lateral, "%", 10.0, 3.0});
  readings.push_back({7, "thickness of speckle", probe, worst.elevation, "%", 10.0, 3.0});
}

void measure_motion(const Setting& setting, Readings& readings) {
  UltrasoundView view = setting.lossless_view();
  view.beams = std::max(view.beams, kManyBeams);
  const int half = 60 * view.samples / 1024 + 1;
  double across = 0.0, out = 0.0;
  {
    const PolarPicture still = setting.picture(liver(), view);
    for (const int beams : setting.quick ? std::vector<int>{2} : std::vector<int>{1, 2, 3}) {
      const PolarPicture moved = setting.picture(liver(), moved_along(view, beams));
      for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        const int middle = sample_at(view, share * view.depth_mm);
        across = farther(across, 1.0 - correlation(window(still, middle, half, beams, false),
                                                   window(moved, middle, half, 0, false)));
      }
    }
  }
  // So far out of the plane, in σ at 0.4 of the depth; each seen at three depths, where σ is another.
  constexpr std::array<double, 3> kShares = {0.15, 0.4, 0.8};
  const std::vector<double> sigmas =
      setting.quick ? std::vector<double>{0.5, 1.0} : std::vector<double>{0.25, 0.5, 1.0, 2.0};
  const double unit_mm = width_at(view, 0.4 * view.depth_mm).elevation_sigma_mm;
  std::vector<double> r(kShares.size() * sigmas.size(), 0.0);
  const int frames = setting.frames(2);
  for (int frame = 1; frame <= frames; ++frame) {
    view.seed = static_cast<std::uint64_t>(frame);
    view.origin_lps_mm = {0, 0, 0};
    const PolarPicture still = setting.picture(liver(), view);
    for (std::size_t i = 0; i < sigmas.size(); ++i) {
      view.origin_lps_mm = {0, 0, sigmas[i] * unit_mm};
      const PolarPicture moved = setting.picture(liver(), view);
      for (std::size_t d = 0; d < kShares.size(); ++d) {
        const int middle = sample_at(view, kShares[d] * view.depth_mm);
        r[i * kShares.size() + d] +=
            correlation(window(still, middle, half, 0, true), window(moved, middle, half, 0, true)) / frames;
      }
    }
  }
  for (std::size_t i = 0; i < r.size(); ++i) {
    const double sigma_mm = width_at(view, kShares[i % kShares.size()] * view.depth_mm).elevation_sigma_mm,
                 s = sigmas[i / kShares.size()] * unit_mm / sigma_mm;
    out = farther(out, std::abs(r[i] - std::exp(-0.5 * s * s)));
  }
  const std::string probe(setting.probe.name);
  readings.push_back({8, "1 - r, moved by less than a beam", probe, across, "", 0.02, 0.005});
  readings.push_back({8, "r out of the plane off exp(-d^2/2s^2)", probe, out, "", 0.10, 0.03});
}

}  // namespace seldinger::measure
