// NIfTI, NRRD and MetaImage through ITK, after the header and the bytes have been counted.
#pragma once

#include <filesystem>

#include "casedb/import/import.h"

namespace seldinger::casedb {

enum class FileFormat { nifti, nrrd, metaimage };

// Fields of the header, beside shape and place, that hold something; they do not enter a case.
std::vector<Dropped> dropped_fields(const std::filesystem::path& file, FileFormat format);

base::Result<Source> read_volume_file(const std::filesystem::path& file, FileFormat format);

}  // namespace seldinger::casedb
