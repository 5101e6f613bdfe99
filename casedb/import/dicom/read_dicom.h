// A CT series of DICOM files into one volume: grouped, ordered and checked by geometry, never by names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "casedb/import/files/source.h"

namespace seldinger::casedb {

base::Result<Source> read_dicom_folder(const std::filesystem::path& folder,
                                       const std::optional<std::string>& series);
base::Result<Source> read_dicom_slice(const std::filesystem::path& file, const std::optional<std::string>& series);

}  // namespace seldinger::casedb
