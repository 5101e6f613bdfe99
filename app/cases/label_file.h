// A label map from a file (NIfTI, NRRD, MetaImage), on the grid of a case.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "casedb/cases/cases.h"

namespace seldinger::app {

struct LabelFile {
  volume::LabelMap labels;  // of the case's voxels
  bool resampled = false;   // its grid was another one: by the nearest voxel
};

bool is_unnamed(const std::string& label_name);  // "label N"

enum class Numbering { own, total_segmentator };

// `names`: of labels, by number; the others are called as the numbering does, "label N" where it has none. Refused
// as import refuses a volume, `bad_labels` (a value not from 0 to 255, none above 0, a name for a label that is not
// there), `labels_elsewhere` (labelled voxels lie outside the case's volume).
base::Result<LabelFile> read_label_file(const std::filesystem::path& file, const casedb::CaseRow& row,
                                        const std::vector<std::pair<int, std::string>>& names,
                                        Numbering numbering = Numbering::own);

}  // namespace seldinger::app
