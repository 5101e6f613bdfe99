// One volume from the slices of a series: duplicates dropped, places judged (slice_stack.h), pixels read.
#pragma once

#include <vector>

#include "casedb/import/dicom/dicom_slice.h"
#include "casedb/import/files/problems.h"
#include "casedb/import/files/source.h"

namespace seldinger::casedb {

// Lossy pictures are read, with a warning, up to 8:1 (`lossy` above): the ratio up to which the German consensus
// found CT other than of the brain unimpaired (Loose et al., RöFo 2009; 181: 32–37).
constexpr double kMostLossyRatio = 8.0;

// `problems` and `warnings` are what was found before. At one place, slices with the same pixels are dropped but
// one, with other pixels refused (`duplicate_slices`): nobody but a person knows which is meant.
base::Result<Source> volume_of(std::vector<DicomSlice> slices, Problems problems,
                               std::vector<base::Problem> warnings);

}  // namespace seldinger::casedb
