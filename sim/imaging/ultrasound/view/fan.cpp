#include "sim/imaging/ultrasound/view/fan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"
#include "sim/base/vectors.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"

namespace seldinger::imaging {

glm::dvec3 Fan::direction(double beam) const noexcept {
  if (!curved) return axial;
  const double angle = first_beam + beam * beam_step;
  return base::exact_cos(angle) * axial + base::exact_sin(angle) * lateral;
}

Fan::Way Fan::way(double beam) const noexcept {
  const glm::dvec3 along = direction(beam);
  return {curved ? origin_lps_mm + radius_mm * (along - axial)
                 : origin_lps_mm + (first_beam + beam * beam_step) * lateral,
          along};
}

glm::dvec3 Fan::start_lps_mm(double beam) const noexcept {
  return way(beam).start_lps_mm;
}

double Fan::beam_spacing_mm(double depth_mm) const noexcept {
  return curved ? beam_step * (radius_mm + depth_mm) : beam_step;
}

Fan fan_of(const UltrasoundView& view) noexcept {
  Fan fan{};
  fan.curved = view.probe.radius_mm > 0.0;
  fan.radius_mm = view.probe.radius_mm;
  const double face = view.probe.elements * view.probe.pitch_mm / (fan.curved ? fan.radius_mm : 1.0);
  fan.beam_step = face / view.beams;
  fan.first_beam = -0.5 * (view.beams - 1) * fan.beam_step;
  fan.sample_mm = view.depth_mm / view.samples;
  fan.origin_lps_mm = view.origin_lps_mm;
  fan.axial = view.axial;
  fan.lateral = view.lateral;
  fan.elevation = glm::cross(view.axial, view.lateral);
  return fan;
}

bool is_shown(const cases::Lesion& lesion) noexcept {
  return base::is_finite(lesion.center_lps_mm) && lesion.radius_mm > 0.0 && !lesion.in_volume();
}

bool beam_touches(const UltrasoundView& view, std::span<const float> depth_below_skin_mm, double beam) noexcept {
  if (depth_below_skin_mm.empty()) return true;
  const double last = static_cast<double>(depth_below_skin_mm.size() - 1);
  const auto element =
      static_cast<std::size_t>(std::clamp((beam + 0.5) * view.probe.elements / view.beams, 0.0, last));
  return depth_below_skin_mm[element] >= static_cast<float>(-kContactMm);
}

TissueAt::TissueAt(const TissueVolume& tissue, const Inserted& inserted) {
  CHECK(tissue.volume != nullptr && tissue.classes.size() == tissue.volume->hu.size());
  CHECK(inserted.lesions.size() <= kMaxLesions);
  for (const cases::Lesion& lesion : inserted.lesions)
    if (is_shown(lesion)) {
      const cases::LesionEcho echo = echo_of(lesion);
      const double inner_mm = inner_radius_mm(lesion, echo);
      const Texture texture(lesion, echo);
      const double sharp_mm = std::max(0.0, lesion.radius_mm - echo.margin_mm);
      lesions_.push_back({lesion.center_lps_mm,
                          lesion.radius_mm,
                          lesion.radius_mm * lesion.radius_mm,
                          inner_mm * inner_mm,
                          {echo.inside, speckle_amplitude(echo.inside_db + echo.texture_db),
                           texture.log_sd > 0.0F ? std::optional(texture) : std::nullopt},
                          {echo.rim, speckle_amplitude(echo.rim_db)},
                          sharp_mm * sharp_mm,
                          echo.margin_mm,
                          speckle_amplitude(echo.about_db)});
    }
  const glm::dmat4 m = volume::voxel_from_lps(*tissue.volume);
  a_ = m[0], b_ = m[1], c_ = m[2], d_ = glm::dvec3(m[3]) + 0.5;
  const glm::ivec3 n = tissue.volume->size_voxels;
  nx_ = n.x, ny_ = n.y, nz_ = n.z;
  size_ = glm::vec3(n);
  row_ = n.x;
  slice_ = row_ * n.y;
  classes_ = tissue.classes.data();
  CHECK(tissue.echogenicity.empty() || tissue.echogenicity.size() == tissue.classes.size());
  echogenicity_ = tissue.echogenicity.empty() ? nullptr : tissue.echogenicity.data();
  amplitude_ = speckle_amplitudes();
  offset_ = echo_offset_amplitudes().data();
}

bool TissueAt::has_lesions_near(const glm::dvec3& p_lps_mm, double reach_mm) const noexcept {
  return std::any_of(lesions_.begin(), lesions_.end(), [&](const Sphere& one) {
    return glm::distance(one.center_lps_mm, p_lps_mm) <= one.radius_mm + reach_mm;
  });
}

glm::dvec3 point_of(const UltrasoundView& view, double beam, double depth_mm) noexcept {
  const Fan fan = fan_of(view);
  return fan.start_lps_mm(beam) + depth_mm * fan.direction(beam);
}

double Fan::beam(double x_mm, double z_mm) const noexcept {
  if (!curved) return (x_mm - first_beam) / beam_step;
  return (2.0 * base::exact_atan(shaders::us_half_tangent(x_mm, z_mm, radius_mm)) - first_beam) / beam_step;
}

double Fan::depth_mm(double x_mm, double z_mm) const noexcept {
  return curved ? shaders::us_from_face_mm(x_mm, z_mm, radius_mm) : z_mm;
}

BeamAndDepth beam_and_depth(const UltrasoundView& view, double x_mm, double z_mm) noexcept {
  const Fan fan = fan_of(view);
  return {fan.beam(x_mm, z_mm), fan.depth_mm(x_mm, z_mm)};
}

}  // namespace seldinger::imaging
