// Slices of one series in the order of their position, and what speaks against making one volume of them.
#pragma once

#include <glm/mat4x4.hpp>
#include <vector>

#include "casedb/import/dicom_slice.h"
#include "casedb/import/problems.h"

namespace seldinger::casedb {

// Sorts along the normal (row × column) of the first slice and adds every problem found: `mixed_orientation`,
// `mixed_size`, `duplicate_slices`, `uneven_slices`, `gantry_tilt`, and those of the slices themselves.
void order_slices(std::vector<DicomSlice>& slices, Problems& problems);

// Of ordered slices without problems. The third axis is the way from the first to the last slice, so it is right
// for oblique series and always right-handed. One slice is `thickness_mm` thick.
glm::dmat4 lps_from_voxel(const std::vector<DicomSlice>& ordered, double thickness_mm);

}  // namespace seldinger::casedb
