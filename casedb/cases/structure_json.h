// The geometry of a drawn structure as JSON: {"kind": "sphere", "center_mm": [..], "radius_mm": r}, {"kind":
// "ellipsoid", "center_mm", "radii_mm"}, {"kind": "tube", "points_mm": [[..], ..], "radius_mm"}.
#pragma once

#include <string>

#include "sim/base/result.h"
#include "sim/case/form/shape.h"

namespace seldinger::casedb {

std::string json_of_shape(const cases::Shape& shape);  // CHECKs that it is a drawn one

// `bad_geometry`: not such a text, not finite, a radius not from 0.1 to 500 mm, no point or over 1000.
base::Result<cases::Shape> shape_from_json(const std::string& text);
base::Result<void> check_drawn(const cases::Shape& shape);

}  // namespace seldinger::casedb
