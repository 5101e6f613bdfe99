// The slices of one series judged by where they lie: ordered, and the regular volume they make, as they are or
// resampled. What is resampled is said in a warning with its numbers. The limits, and why:
//
// - Places up to 0.05 mm or 1 % of a gap off are even: positions are written with one or two decimals.
// - Uneven or missing slices are interpolated linearly at the usual (median) gap. Refused (`uneven_slices`) when a
//   hole of missing slices is wider than 10 mm, since a whole target (5 to 20 mm) could have been in it, and when
//   more layers would be invented than there are slices.
// - A tilted gantry shears the stack: its layers are moved back along their plane. Refused (`gantry_tilt`) above
// 30°,
//   more than gantries tilt.
// - A slice that stands off that line by up to half a gap is jitter, and moved back; more is a wrong place
//   (`shifted_slices`).
// - Pictures at 45° or more to the series (a localizer, a reformat) are left out when they are at most a quarter of
//   it; more, or at a smaller angle, where they would be slices of the very stack: refused (`mixed_orientation`).
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "casedb/import/dicom/dicom_slice.h"
#include "casedb/import/files/problems.h"

namespace seldinger::casedb {

constexpr double kSamePlaceMm = 0.01;  // closer slices lie at one place

struct Stack {
  glm::ivec3 size_voxels{0};
  glm::dmat4 lps_from_voxel{1.0};
  bool as_is = true;  // layer k is slice k
  // Otherwise, for each slice: where it lies among the layers (0 to size.z − 1), and where its first pixel lies
  // within a layer.
  std::vector<double> place;
  std::vector<glm::dvec2> shift_px;
};

// Leaves pictures that lie across the others out, gives the rest one orientation, and sorts them along its normal
// (row × column). Adds the
// problems of the slices themselves, `mixed_orientation`, `mixed_size`.
void order_slices(std::vector<DicomSlice>& slices, Problems& problems, std::vector<base::Problem>& warnings);

// Whether two ordered neighbours lie at one height along their normal.
bool at_one_height(const DicomSlice& a, const DicomSlice& b);

// Of ordered slices of different heights. One slice is as thick as it says, else 1 mm.
Stack stack_of(const std::vector<DicomSlice>& ordered, Problems& problems, std::vector<base::Problem>& warnings);

}  // namespace seldinger::casedb
