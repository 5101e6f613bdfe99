#include "app/measure/ultrasound_goals/element_level.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "app/measure/ultrasound_goals/polar_levels.h"
#include "shaders/shared/ultrasound.glsl.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::measure {
namespace {

// ±3σ of the spectrum, so close that echoes 16 axial σ apart do not fold onto each other.
constexpr std::size_t kFrequencies = 16;
// A Gaussian aperture exp(−x²/2s²) both ways has a two-way amplitude exp(−(2π·s·u/λz)²), u across: its −6 dB is
// 0.89·λ·F at this share of the even aperture. It ends where that does not matter.
constexpr double kGaussianShare = 0.2975, kGaussianReach = 3.0;

}  // namespace

ElementLevel::ElementLevel(const imaging::UltrasoundView& view, Apodisation apodisation)
    : view_(view),
      fan_(imaging::fan_of(view)),
      apodisation_(apodisation),
      frequency_mhz_(working_mhz(view)),
      wavelength_mm_(shaders::us_wavelength_mm(frequency_mhz_)),
      axial_sigma_mm_(imaging::beam_width(view.probe, frequency_mhz_, 0.0, 10.0).axial_sigma_mm) {
  const imaging::Probe& probe = view.probe;
  for (int i = 0; i < probe.elements; ++i) {
    const double along_mm = (i - 0.5 * (probe.elements - 1)) * probe.pitch_mm;
    if (!fan_.curved) {
      elements_.push_back({along_mm, 0.0, 0.0, 1.0, along_mm});
      continue;
    }
    const double angle = along_mm / probe.radius_mm;
    elements_.push_back({probe.radius_mm * std::sin(angle), probe.radius_mm * (std::cos(angle) - 1.0),
                         std::sin(angle), std::cos(angle), along_mm});
  }
  // The pulse exp(−z²/2σ²) of depth z = c·t/2.
  const double sigma_mhz = shaders::kUsSpeedMmPerUs / (4.0 * std::numbers::pi * axial_sigma_mm_);
  double sum = 0.0;
  for (std::size_t n = 0; n < kFrequencies; ++n) {
    const double off = 6.0 * ((static_cast<double>(n) + 0.5) / kFrequencies - 0.5);
    frequencies_mhz_.push_back(frequency_mhz_ + off * sigma_mhz);
    spectrum_.push_back(std::exp(-0.5 * off * off));
    sum += spectrum_.back();
  }
  for (double& part : spectrum_) part /= sum;
}

ElementLevel::Place ElementLevel::place(double beam, double depth_mm) const noexcept {
  const double at = fan_.first_beam + beam * fan_.beam_step;
  if (!fan_.curved) return {at, depth_mm};
  return {(fan_.radius_mm + depth_mm) * std::sin(at), (fan_.radius_mm + depth_mm) * std::cos(at) - fan_.radius_mm};
}

double ElementLevel::lateral_reach_mm(double depth_mm) const noexcept {
  return 8.0 * imaging::beam_width(view_.probe, frequency_mhz_, 0.0, depth_mm).lateral_sigma_mm;
}

double ElementLevel::weight(const Element& element, double beam_along_mm, double depth_mm) const noexcept {
  const double open_mm = std::min(view_.probe.aperture_mm, depth_mm / view_.probe.f_number);
  const double off_mm = std::abs(element.along_mm - beam_along_mm);
  if (apodisation_ == Apodisation::even)
    return std::clamp((0.5 * open_mm - off_mm) / view_.probe.pitch_mm + 0.5, 0.0, 1.0);
  const double u = off_mm / (kGaussianShare * open_mm);
  return u > kGaussianReach ? 0.0 : std::exp(-0.5 * u * u);
}

// A strip as wide as the pitch: sinc(π·w·sinθ/λ)·cosθ (soft baffle).
double ElementLevel::directivity(const Element& element, double x_mm, double z_mm) const noexcept {
  const double dx = x_mm - element.x_mm, dz = z_mm - element.z_mm, r = std::hypot(dx, dz);
  const double cosine = (dx * element.nx + dz * element.nz) / r, sine = (dx * element.nz - dz * element.nx) / r;
  if (cosine <= 0.0) return 0.0;
  const double phase = std::numbers::pi * view_.probe.pitch_mm * sine / wavelength_mm_;
  return cosine * (std::abs(phase) < 1e-6 ? 1.0 : std::sin(phase) / phase);
}

std::complex<double> ElementLevel::sample(double beam, double depth_mm,
                                          std::span<const PlaneScatterer> scatterers) const {
  const Place point = place(beam, depth_mm);
  const double beam_along_mm = (fan_.first_beam + beam * fan_.beam_step) * (fan_.curved ? fan_.radius_mm : 1.0);
  const Place focus = place(beam, view_.focus_mm);
  struct Used {
    double x_mm, z_mm, receive, transmit, receive_mm, transmit_mm;
  };
  std::vector<Used> used;
  double receive_sum = 0.0, transmit_sum = 0.0;
  for (const Element& element : elements_) {
    const double receive = weight(element, beam_along_mm, depth_mm),
                 transmit = view_.focus_mm > 0.0 ? weight(element, beam_along_mm, view_.focus_mm) : receive;
    if (receive == 0.0 && transmit == 0.0) continue;
    const double there = directivity(element, point.x_mm, point.z_mm);
    const double to_point_mm = std::hypot(point.x_mm - element.x_mm, point.z_mm - element.z_mm);
    // Sent so that all arrive at the focus together, as if from the face's point under the beam.
    const double sent_mm = view_.focus_mm > 0.0 ? std::hypot(focus.x_mm - element.x_mm, focus.z_mm - element.z_mm) +
                                                      depth_mm - view_.focus_mm
                                                : to_point_mm;
    used.push_back({element.x_mm, element.z_mm, receive * there, transmit * there, to_point_mm, sent_mm});
    receive_sum += receive * there;
    transmit_sum += transmit * there;
  }
  const double step_mhz = frequencies_mhz_[1] - frequencies_mhz_[0];
  const bool same = view_.focus_mm <= 0.0;
  const double reach_mm = lateral_reach_mm(depth_mm), spacing_mm = fan_.beam_spacing_mm(depth_mm);
  std::complex<double> total = 0.0;
  for (const PlaneScatterer& scatterer : scatterers) {
    if (std::abs(scatterer.depth_mm - depth_mm) > axial_reach_mm() ||
        std::abs(scatterer.beam - beam) * spacing_mm > reach_mm)
      continue;
    std::array<std::complex<double>, kFrequencies> receive{}, transmit{};
    for (const Used& element : used) {
      const double way_mm = std::hypot(scatterer.x_mm - element.x_mm, scatterer.z_mm - element.z_mm);
      const auto add = [&](double late_mm, double weight, std::array<std::complex<double>, kFrequencies>& sums) {
        if (weight == 0.0) return;
        const double per_mhz = -2.0 * std::numbers::pi * late_mm / shaders::kUsSpeedMmPerUs;
        std::complex<double> turn = weight * std::polar(1.0, per_mhz * frequencies_mhz_[0]);
        const std::complex<double> step = std::polar(1.0, per_mhz * step_mhz);
        for (std::complex<double>& sum : sums) {
          sum += turn;
          turn = {turn.real() * step.real() - turn.imag() * step.imag(),
                  turn.real() * step.imag() + turn.imag() * step.real()};
        }
      };
      add(way_mm - element.receive_mm, element.receive, receive);
      if (!same) add(way_mm - element.transmit_mm, element.transmit, transmit);
    }
    const double sigma_y_mm =
        imaging::beam_width(view_.probe, frequency_mhz_, 0.0, scatterer.depth_mm).elevation_sigma_mm;
    const double out = scatterer.y_mm / sigma_y_mm;
    std::complex<double> echo = 0.0;
    for (std::size_t n = 0; n < kFrequencies; ++n) {
      const std::complex<double>&r = receive[n], &t = same ? receive[n] : transmit[n];
      echo += spectrum_[n] * std::complex<double>(r.real() * t.real() - r.imag() * t.imag(),
                                                  r.real() * t.imag() + r.imag() * t.real());
    }
    total += scatterer.amplitude * std::exp(-0.5 * out * out) * echo;
  }
  // Delays turn every scatterer's phase to the point's; back to the carrier's phase over depth.
  return total / (receive_sum * transmit_sum) *
         std::polar(1.0, -4.0 * std::numbers::pi * depth_mm / wavelength_mm_);
}

}  // namespace seldinger::measure
