// Writes a volume as a classic CT DICOM series: one file a slice, made-up identity, UIDs from the content.
#pragma once

#include <filesystem>
#include <string>

#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

struct SeriesText {
  std::string description;  // e.g. "Seldinger built-in torso phantom"
};

// Files slice_0001.dcm … into `folder`, which must exist. Refused: `left_handed` (DICOM slices cannot say it).
// Throws base::Failure("disk").
base::Result<int> write_dicom_series(const volume::Volume& volume, const SeriesText& text,
                                     const std::filesystem::path& folder);

}  // namespace seldinger::casedb
