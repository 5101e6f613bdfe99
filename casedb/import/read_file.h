// NIfTI, NRRD and MetaImage through ITK, after the header and the bytes have been counted.
#pragma once

#include <filesystem>

#include "casedb/import/import.h"

namespace seldinger::casedb {

enum class FileFormat { nifti, nrrd, metaimage };

base::Result<Source> read_volume_file(const std::filesystem::path& file, FileFormat format);

}  // namespace seldinger::casedb
