#include "sim/imaging/ultrasound/compound.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/shared/ultrasound.glsl.h"
#include "shaders/shared/ultrasound_mirror.glsl.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"
#include "sim/base/rows.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

double radians(double deg) {
  return deg * std::numbers::pi / 180.0;
}

// How far above the real face a beam of the turned one would begin, along itself.
double above_face_mm(const Fan& real, const Fan& turned, int beam) {
  const glm::dvec3 start = turned.start_lps_mm(beam), direction = turned.direction(beam);
  if (!real.curved) return -glm::dot(start - real.origin_lps_mm, real.axial) / glm::dot(direction, real.axial);
  const glm::dvec3 off = start - (real.origin_lps_mm - real.radius_mm * real.axial);
  const double along = glm::dot(off, direction);
  return std::sqrt(std::max(0.0, along * along - glm::dot(off, off) + real.radius_mm * real.radius_mm)) - along;
}

// Of intensities that a Gaussian beam has made, told between samples so many of its widths apart and evenly
// anywhere between them: the share that is left of their variance, and of what they have in common with one at the
// place itself.
double told_between(double off) {
  return 2.0 / 3.0 + std::exp(-0.5 * off * off) / 3.0;
}
double alike_between(double off) {
  return 2.0 * (std::sqrt(0.5 * std::numbers::pi) / off * std::erf(off / std::numbers::sqrt2) -
                (1.0 - std::exp(-0.5 * off * off)) / (off * off));
}

}  // namespace

UltrasoundView look_of(const UltrasoundView& view, int look) noexcept {
  UltrasoundView one = view;
  one.compound_deg = 0.0;
  if (look == 0 || !(view.compound_deg > 0.0)) return one;
  const double angle = (look == 1 ? 1.0 : -1.0) * radians(view.compound_deg);
  one.axial = base::exact_cos(angle) * view.axial + base::exact_sin(angle) * view.lateral;
  one.lateral = base::exact_cos(angle) * view.lateral - base::exact_sin(angle) * view.axial;
  const Fan real = fan_of(view), turned = fan_of(one);
  const double in_mm = std::max({0.0, above_face_mm(real, turned, 0), above_face_mm(real, turned, view.beams - 1)});
  one.origin_lps_mm += in_mm * one.axial;
  Probe& probe = one.probe;
  if (real.curved) {  // the same fan, cut off deeper
    const double wider = (probe.radius_mm + in_mm) / probe.radius_mm;
    probe.radius_mm += in_mm;
    probe.pitch_mm *= wider;
  }
  // Focused where it was: of a beam that narrows towards its focus only the rest of the way is left.
  const double left = std::max(0.1, 1.0 - in_mm / probe.elevation_focus_mm);
  probe.height_mm *= left;
  probe.elevation_focus_mm *= left;
  if (one.focus_mm > 0.0) one.focus_mm = std::max(1.0, one.focus_mm - in_mm);
  return one;
}

double independent_looks(const UltrasoundView& view, double depth_mm, int looks) noexcept {
  if (!(view.compound_deg > 0.0) || looks < 2) return 1.0;
  const double z_mm = std::max(depth_mm, 0.5), radius_mm = view.probe.radius_mm;
  // The fan's apex is shifted by R·sin θ: seen from a depth it lies at a smaller angle.
  const double steered =
      std::sin(radians(view.compound_deg)) * (radius_mm > 0.0 ? radius_mm / (radius_mm + z_mm) : 1.0);
  const BeamWidth width = beam_width(view.probe, working_mhz(view), view.focus_mm, z_mm);
  const double sigma_mm = width.lateral_sigma_mm;
  const auto alike = [&](double sine) {
    const double turned = 4.0 * std::numbers::pi / shaders::us_wavelength_mm(working_mhz(view)) * sine * sigma_mm;
    return std::exp(-0.5 * turned * turned);
  };
  const double apart = 2.0 * steered * std::sqrt(1.0 - steered * steered);  // from one side to the other
  const Fan fan = fan_of(view);
  const double across = fan.beam_spacing_mm(z_mm) / sigma_mm, down = fan.sample_mm / width.axial_sigma_mm;
  const double own = told_between(across) * told_between(down),
               with_another = alike_between(across) * alike_between(down);
  if (looks == 2) return 4.0 / (1.0 + own + 2.0 * with_another * alike(steered));
  return 9.0 /
         (1.0 + 2.0 * own + 4.0 * with_another * alike(steered) + 2.0 * with_another * with_another * alike(apart));
}

Compounder::Compounder(const UltrasoundView& view) : view_(view) {
  UltrasoundView middle = view;
  middle.origin_lps_mm = glm::dvec3(0.0);
  middle.axial = {0.0, 1.0, 0.0};
  middle.lateral = {1.0, 0.0, 0.0};
  const Fan fan = fan_of(middle);
  const double loss_db_mm = shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, working_mhz(view));
  for (int look = 1; look < kLooks; ++look) {
    const UltrasoundView aside = look_of(middle, look);
    std::vector<Source>& sources = sources_[static_cast<std::size_t>(look - 1)];
    sources.reserve(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples));
    for (int b = 0; b < view.beams; ++b)
      for (int k = 0; k < view.samples; ++k) {
        Source& source = sources.emplace_back();
        const double depth_mm = (k + 0.5) * fan.sample_mm;
        const glm::dvec3 off = fan.start_lps_mm(b) + depth_mm * fan.direction(b) - aside.origin_lps_mm;
        const BeamAndDepth at = beam_and_depth(aside, glm::dot(off, aside.lateral), glm::dot(off, aside.axial));
        const double sample = at.depth_mm / fan.sample_mm - 0.5;
        if (!(at.beam >= 0.0 && at.beam <= view.beams - 1.0 && sample >= 0.0 && sample <= view.samples - 1.0))
          continue;
        const int near = std::min(static_cast<int>(at.beam), view.beams - 2),
                  upper = std::min(static_cast<int>(sample), view.samples - 2);
        source.near = static_cast<std::int16_t>(near);
        source.upper = static_cast<std::int16_t>(upper);
        source.beam = static_cast<float>(at.beam - near);
        source.sample = static_cast<float>(sample - upper);
        const double level = shaders::us_later(loss_db_mm, at.depth_mm, depth_mm);
        source.level = static_cast<float>(level * level);
      }
  }
}

bool Compounder::is_of(const UltrasoundView& view) const noexcept {
  return view.compound_deg == view_.compound_deg && view.beams == view_.beams && view.samples == view_.samples &&
         view.depth_mm == view_.depth_mm && view.probe.name == view_.probe.name &&
         working_mhz(view) == working_mhz(view_) && view.method == view_.method;
}

void Compounder::mean(const UltrasoundView& view, std::span<const Look, kLooks> looks,
                      PolarPicture& picture) const {
  CHECK(is_of(view));
  for (const Look& look : looks) CHECK(look.picture.beams == view.beams && look.picture.samples == view.samples);
  const auto samples = static_cast<std::size_t>(view.samples);
  std::array<std::vector<unsigned char>, kLooks> touches;
  for (std::size_t i = 0; i < touches.size(); ++i)
    for (int b = 0; b < view.beams; ++b)
      touches[i].push_back(beam_touches(view, looks[i].depth_below_skin_mm, b) ? 1 : 0);
  picture = looks[0].picture;
  base::over_rows(view.beams, view.threads, [&](int b) {
    if (touches[0][static_cast<std::size_t>(b)] == 0) return;
    float* here = picture.envelope.data() + static_cast<std::size_t>(b) * samples;
    for (std::size_t k = 0; k < samples; ++k) {
      float sum = here[k] * here[k], count = 1.0F;
      for (std::size_t i = 1; i < touches.size(); ++i) {
        const Source& source = sources_[i - 1][static_cast<std::size_t>(b) * samples + k];
        if (source.near < 0) continue;
        const auto near = static_cast<std::size_t>(source.near);
        if ((touches[i][near] & touches[i][near + 1]) == 0) continue;
        // Power, and not amplitude, so that what lies between samples has the same mean.
        const float* first = looks[i].picture.envelope.data() + near * samples + source.upper;
        const float* second = first + samples;
        const float above = first[0] * first[0] + source.beam * (second[0] * second[0] - first[0] * first[0]);
        const float below = first[1] * first[1] + source.beam * (second[1] * second[1] - first[1] * first[1]);
        sum += source.level * (above + source.sample * (below - above));
        count += 1.0F;
      }
      if (count > 1.0F) here[k] = std::sqrt(sum / count);
    }
  });
}

}  // namespace seldinger::imaging
