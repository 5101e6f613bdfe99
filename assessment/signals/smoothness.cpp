#include "assessment/signals/smoothness.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <complex>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr std::size_t kFewestSamples = 4;
constexpr double kSparcHz = 10.0, kSparcAmplitude = 0.05;
constexpr int kSparcPadding = 4;

// Discrete Fourier transform in place, by the textbook's radix-2 steps; as many as a power of two.
void transform(std::vector<std::complex<double>>& x) {
  const std::size_t count = x.size();
  for (std::size_t i = 1, j = 0; i < count; ++i) {
    std::size_t bit = count >> 1U;
    for (; (j & bit) != 0; bit >>= 1U) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(x[i], x[j]);
  }
  std::vector<std::complex<double>> turns(count / 2);
  for (std::size_t k = 0; k < turns.size(); ++k)
    turns[k] = std::polar(1.0, -2.0 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(count));
  for (std::size_t length = 2; length <= count; length *= 2)
    for (std::size_t begin = 0; begin < count; begin += length)
      for (std::size_t k = 0; k < length / 2; ++k) {
        std::complex<double>&a = x[begin + k], &b = x[begin + k + length / 2];
        const std::complex<double> turned = b * turns[k * (count / length)];
        b = a - turned;
        a += turned;
      }
}

}  // namespace

std::optional<double> log_dimensionless_jerk(std::span<const glm::dvec3> positions, double rate_hz) {
  const std::size_t count = positions.size();
  if (count < kFewestSamples) return std::nullopt;
  double peak_mm_s = 0.0;
  for (std::size_t i = 0; i + 1 < count; ++i)
    peak_mm_s = std::max(peak_mm_s, glm::distance(positions[i], positions[i + 1]) * rate_hz);
  if (!(peak_mm_s > 0.0)) return std::nullopt;
  // Third differences stand between the second and the third of four samples; what is beyond the outermost is like
  // them.
  double jerk2_s = 0.0;
  for (std::size_t i = 0; i + 3 < count; ++i) {
    const glm::dvec3 jerk =
        (positions[i + 3] - 3.0 * positions[i + 2] + 3.0 * positions[i + 1] - positions[i]) * std::pow(rate_hz, 3);
    const double width = 1.0 + (i == 0 ? 1.0 : 0.0) + (i + 4 == count ? 1.0 : 0.0);
    jerk2_s += glm::dot(jerk, jerk) * width / rate_hz;
  }
  if (!(jerk2_s > 0.0)) return std::nullopt;  // no jerk has no logarithm
  const double length_s = static_cast<double>(count - 1) / rate_hz;
  return -std::log(std::pow(length_s, 3) / (peak_mm_s * peak_mm_s) * jerk2_s);
}

std::optional<double> log_dimensionless_jerk(const Signals& signals, double from_s, double to_s) {
  std::vector<glm::dvec3> positions;
  for (const Step& step : signals.steps) {
    if (step.t_s < from_s - kTimeTolerance_s || step.t_s + 1.0 / kMotionRateHz > to_s + kTimeTolerance_s) continue;
    if (positions.empty()) {
      positions.push_back(step.from_lps_mm);
    } else if (step.first) {
      return std::nullopt;
    }
    positions.push_back(step.to_lps_mm);
  }
  return log_dimensionless_jerk(positions, kMotionRateHz);
}

std::optional<double> spectral_arc_length(std::span<const double> speeds_mm_s, double rate_hz) {
  if (speeds_mm_s.size() < kFewestSamples) return std::nullopt;
  std::vector<std::complex<double>> spectrum(std::bit_ceil(speeds_mm_s.size()) << kSparcPadding);
  std::copy(speeds_mm_s.begin(), speeds_mm_s.end(), spectrum.begin());
  transform(spectrum);
  const double step_hz = rate_hz / static_cast<double>(spectrum.size());
  std::vector<double> amplitudes;
  double largest = 0.0;
  for (std::size_t i = 0; i < spectrum.size(); ++i) {
    const double amplitude = std::abs(spectrum[i]);
    largest = std::max(largest, amplitude);
    if (static_cast<double>(i) * step_hz <= kSparcHz) amplitudes.push_back(amplitude);
  }
  if (!(largest > 0.0)) return std::nullopt;
  for (double& amplitude : amplitudes) amplitude /= largest;
  const auto loud = [](double amplitude) { return amplitude >= kSparcAmplitude; };
  const auto first = std::find_if(amplitudes.begin(), amplitudes.end(), loud);
  const auto last = std::find_if(amplitudes.rbegin(), amplitudes.rend(), loud).base();  // one beyond
  if (last - first < 2) return std::nullopt;
  const double width = static_cast<double>(last - first - 1);
  double length = 0.0;
  for (auto at = first; at + 1 != last; ++at) length += std::hypot(1.0 / width, *(at + 1) - *at);
  return -length;
}

}  // namespace seldinger::assessment
