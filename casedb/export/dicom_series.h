// Writes a volume as a classic CT DICOM series: one file a slice, made-up identity, UIDs from the content.
#pragma once

#include <filesystem>
#include <string>

#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

struct SeriesText {
  std::string description;  // e.g. "Seldinger built-in torso phantom"; at most 64 characters are written
};

// Files slice_0001.dcm … into `folder`, which must exist; the same volume and text give the same bytes. Returns how
// many. Refused: `left_handed` and `sheared` (DICOM slices cannot say it), `too_large` (65535 rows or columns).
// Throws base::Failure("disk"); what it wrote is then removed.
base::Result<int> write_dicom_series(const volume::Volume& volume, const SeriesText& text,
                                     const std::filesystem::path& folder);

}  // namespace seldinger::casedb
