// Reads DICOM series, NIfTI, NRRD and MetaImage into the library's own volume: int16 HU in LPS and an allow-list of
// attributes, nothing else of the source. It is read in a jail (jail/jail.h): whatever a file does to its reader,
// it does there. The door of ITK (with GDCM) is this folder and casedb/export.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "casedb/import/files/source.h"
#include "casedb/import/jail/unpacking.h"
#include "sim/base/result.h"
#include "sim/case/form/mesh.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {

// `series`: a series instance UID or its number in the list that `several_series` shows (1-based). Padding (also
// DICOM's Pixel Padding Value) and everything below −1024 HU become −1024. All problems are reported at once.
// Error texts name no file, path, UID or attribute value (a series is named by number, modality and slice count).
// `limit` is that of one file that is no DICOM. Refused: what the readers refuse, and `reader_died`. Throws
// base::Failure("no_reader").
base::Result<Source> read_source(const std::filesystem::path& source, const std::optional<std::string>& series = {},
                                 const UnpackingLimit& limit = kCtFile);

// The same without the jail, to measure what that costs. Never for a file from outside.
base::Result<Source> read_source_here(const std::filesystem::path& source);

}  // namespace seldinger::casedb
