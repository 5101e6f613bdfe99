// How the patient lies on the table.
#pragma once

#include <glm/vec3.hpp>

#include "sim/base/names.h"

namespace seldinger::cases {

// lateral_left: on his left side, so that his right one is up.
enum class PatientPosition { supine, prone, lateral_left, lateral_right };
inline constexpr auto kPatientPositionNames =
    base::names<PatientPosition>({{PatientPosition::supine, "supine"},
                                  {PatientPosition::prone, "prone"},
                                  {PatientPosition::lateral_left, "lateral_left"},
                                  {PatientPosition::lateral_right, "lateral_right"}});

// Away from the table, against gravity (LPS, unit).
inline glm::dvec3 upwards(PatientPosition position) noexcept {
  switch (position) {
    case PatientPosition::prone:
      return {0.0, 1.0, 0.0};
    case PatientPosition::lateral_left:
      return {-1.0, 0.0, 0.0};
    case PatientPosition::lateral_right:
      return {1.0, 0.0, 0.0};
    case PatientPosition::supine:
      break;
  }
  return {0.0, -1.0, 0.0};
}

}  // namespace seldinger::cases
