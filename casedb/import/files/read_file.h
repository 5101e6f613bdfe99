// NIfTI, NRRD and MetaImage: voxels read once, straight into HU.
#pragma once

#include <filesystem>

#include "casedb/import/files/source.h"
#include "casedb/import/jail/unpacking.h"

namespace seldinger::casedb {

enum class FileFormat { nifti, nrrd, metaimage };

// All but `dropped`. Refused besides what the layouts refuse: `truncated`, `damaged`, `not_finite`.
base::Result<Source> read_volume_file(const std::filesystem::path& file, FileFormat format,
                                      const UnpackingLimit& limit);

}  // namespace seldinger::casedb
