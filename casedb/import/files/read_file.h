// NIfTI, NRRD and MetaImage through ITK, after the header and the bytes have been counted.
#pragma once

#include <filesystem>

#include "casedb/import/files/source.h"

namespace seldinger::casedb {

enum class FileFormat { nifti, nrrd, metaimage };

// All but `dropped`.
base::Result<Source> read_volume_file(const std::filesystem::path& file, FileFormat format);

}  // namespace seldinger::casedb
