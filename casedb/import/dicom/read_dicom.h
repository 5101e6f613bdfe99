// A CT series of DICOM files into one volume: grouped, ordered and checked by geometry, never by names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "casedb/import/files/source.h"

namespace seldinger::casedb {

// The files of a folder with all below it, in name order, so that a folder is read the same way on every machine.
// No file is opened. Links to files are followed, links to folders are not; a file that is reached twice counts
// once. Refused: `not_readable`, `too_many_files`.
base::Result<std::vector<std::filesystem::path>> files_of_folder(const std::filesystem::path& folder);

base::Result<Source> read_dicom_files(const std::vector<std::filesystem::path>& files,
                                      const std::optional<std::string>& series);

}  // namespace seldinger::casedb
