#include "app/cases/label_file.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/mat4x4.hpp>

#include "casedb/import/import.h"
#include "sim/volume/label_numbering.h"

namespace seldinger::app {
namespace {

constexpr const char* kUnnamed = "label ";
constexpr double kSameGridMm = 1e-3;  // header texts of other programs keep so much

bool same_grid(const volume::Volume& a, const volume::Volume& b) {
  if (a.size_voxels != b.size_voxels) return false;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec4 index(glm::dvec3(corner & 1, (corner >> 1) & 1, corner >> 2) * glm::dvec3(a.size_voxels - 1),
                           1.0);
    const glm::dvec3 off(a.lps_from_voxel * index - b.lps_from_voxel * index);
    for (int axis = 0; axis < 3; ++axis)
      if (!(std::abs(off[axis]) <= kSameGridMm)) return false;
  }
  return true;
}

}  // namespace

bool is_unnamed(const std::string& label_name) {
  return label_name.starts_with(kUnnamed);
}

base::Result<LabelFile> read_label_file(const std::filesystem::path& file, const casedb::CaseRow& row,
                                        const std::vector<std::pair<int, std::string>>& names,
                                        Numbering numbering) {
  std::uint64_t case_voxels = 1;
  for (int axis = 0; axis < 3; ++axis) case_voxels *= static_cast<std::uint64_t>(row.size_voxels[axis]);
  const auto source = casedb::read_source(file, {}, casedb::label_file_limit(case_voxels));
  if (!source) return source.error();
  const volume::Volume& from = source->volume;
  int highest = 0;
  for (const std::int16_t value : from.hu) {
    if (value < 0 || value > 255) return base::Error{"bad_labels", "a label is a whole number from 0 to 255"};
    highest = std::max(highest, int{value});
  }
  if (highest == 0) return base::Error{"bad_labels", "no voxel has a label"};

  LabelFile read;
  read.labels.names.push_back("none");
  for (int label = 1; label <= highest; ++label) {
    const auto known = numbering == Numbering::own ? std::nullopt : volume::total_segmentator_label(label);
    read.labels.names.push_back(known ? known->name : kUnnamed + std::to_string(label));
  }
  for (const auto& [label, name] : names) {
    if (label > highest) return base::Error{"bad_labels", "a named label is not in the file"};
    read.labels.names[static_cast<std::size_t>(label)] = name;
  }
  const volume::Volume grid{row.size_voxels, row.spacing_mm, row.lps_from_voxel, {}};
  const glm::dmat4 case_from_label = volume::voxel_from_lps(grid) * from.lps_from_voxel;
  for (int k = 0; k < from.size_voxels.z; ++k)
    for (int j = 0; j < from.size_voxels.y; ++j)
      for (int i = 0; i < from.size_voxels.x; ++i)
        if (from.at(i, j, k) != 0 &&
            !volume::inside(grid, glm::dvec3(case_from_label * glm::dvec4(i, j, k, 1.0)) * (1.0 - 1e-9)))
          return base::Error{"labels_elsewhere", "labelled voxels lie outside the case's volume"};
  read.labels.label.resize(static_cast<std::size_t>(row.size_voxels.x) *
                           static_cast<std::size_t>(row.size_voxels.y) *
                           static_cast<std::size_t>(row.size_voxels.z));
  read.resampled = !same_grid(grid, from);
  const glm::dmat4 label_from_case = volume::voxel_from_lps(from) * row.lps_from_voxel;
  std::size_t at = 0;
  bool any = false;
  for (int k = 0; k < row.size_voxels.z; ++k)
    for (int j = 0; j < row.size_voxels.y; ++j)
      for (int i = 0; i < row.size_voxels.x; ++i, ++at) {
        const auto value =
            read.resampled
                ? volume::sample_nearest(from, glm::dvec3(label_from_case * glm::dvec4(i, j, k, 1.0))).value_or(0)
                : from.hu[at];
        read.labels.label[at] = static_cast<std::uint8_t>(value);
        any = any || value != 0;
      }
  if (!any) return base::Error{"bad_labels", "no voxel of the case gets a label"};
  return read;
}

}  // namespace seldinger::app
