#include "sim/tissue/rest_plane.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/displacement.glsl.h"
#include "sim/base/check.h"

namespace seldinger::tissue {
namespace {

int cells(double size_mm, double spacing_mm) {
  return std::max(1, static_cast<int>(std::ceil(size_mm / spacing_mm)));
}

// The cell that a place is in, or the nearest; NaN counts as 0.
int cell_of(double nodes, int cells) noexcept {
  return nodes > 0.0 ? static_cast<int>(std::min(nodes, static_cast<double>(cells - 1))) : 0;
}

}  // namespace

InverseSteps picture_steps(const Displacement& displacement) noexcept {
  const double steepest_mm = shaders::kSlipMm / shaders::kSlipOfWay;
  bool far = false;
  for (int i = displacement.vein_end; i < displacement.breath_end; ++i) {
    const shaders::DisplacementSource& breath = displacement.source[i];
    far = far || (breath.along.w > 0.0F && std::abs(static_cast<double>(breath.amount.z)) > steepest_mm);
  }
  return {.fixed_point = 4, .newton = far ? 4 : 1};
}

RestPlane::RestPlane(const Displacement& displacement, const PlanePart& part, double spacing_mm)
    : RestPlane(displacement, part, spacing_mm, picture_steps(displacement)) {}

RestPlane::RestPlane(const Displacement& displacement, const PlanePart& part, double spacing_mm, InverseSteps steps)
    : part_(part),
      per_spacing_(1.0 / spacing_mm),
      columns_(cells(part.size_mm.x, spacing_mm)),
      rows_(cells(part.size_mm.y, spacing_mm)) {
  CHECK(spacing_mm > 0.0);
  moved_mm_.reserve(static_cast<std::size_t>(columns_ + 1) * static_cast<std::size_t>(rows_ + 1));
  for (int row = 0; row <= rows_; ++row)
    for (int column = 0; column <= columns_; ++column) {
      const glm::dvec3 at_lps_mm = part.first_lps_mm + column * spacing_mm * part.u + row * spacing_mm * part.v;
      moved_mm_.push_back(tissue::rest_of(displacement, at_lps_mm, steps) - at_lps_mm);
    }
}

glm::dvec3 RestPlane::rest_of(double a_mm, double b_mm) const noexcept {
  const double a = a_mm * per_spacing_, b = b_mm * per_spacing_;
  const int column = cell_of(a, columns_), row = cell_of(b, rows_);
  const glm::dvec3* low = moved_mm_.data() + static_cast<std::ptrdiff_t>(row) * (columns_ + 1) + column;
  const glm::dvec3* high = low + columns_ + 1;
  const double right = a - column, down = b - row;
  const glm::dvec3 upper = low[0] + right * (low[1] - low[0]), lower = high[0] + right * (high[1] - high[0]);
  return part_.first_lps_mm + a_mm * part_.u + b_mm * part_.v + upper + down * (lower - upper);
}

}  // namespace seldinger::tissue
