#include "sim/imaging/xray/beam/scatter.h"

#include "sim/base/exact_math.h"

namespace seldinger::imaging {

double scatter_to_primary(const ScatterGeometry& geometry) noexcept {
  if (!(geometry.water_mm > 0.0 && geometry.field_mm > 0.0 && geometry.gap_mm > 0.0)) return 0.0;
  constexpr double kAt200Mm = 0.89, kByThickness = 1.65, kByField = 1.5, kByGap = -1.4;
  const double bare = kAt200Mm * base::exact_exp(kByThickness * base::exact_log(geometry.water_mm / 200.0) +
                                                 kByField * base::exact_log(geometry.field_mm / 200.0) +
                                                 kByGap * base::exact_log(geometry.gap_mm / 315.0));
  return geometry.grid ? bare * kGridScatterShare / kGridPrimaryShare : bare;
}

}  // namespace seldinger::imaging
