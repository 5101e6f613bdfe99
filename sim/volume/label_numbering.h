// What the numbers of another program's label maps mean.
#pragma once

#include <optional>
#include <string_view>

#include "sim/volume/classes.h"

namespace seldinger::volume {

struct NumberedLabel {
  const char* name;  // as that program writes it: "vertebrae_L1"
  TissueClass tissue;
};

// TotalSegmentator, task "total", version 2: 1 to 117 (Wasserthal et al., Radiology: Artificial Intelligence
// 2023;5:e230024; totalsegmentator/map_to_binary.py, class_map["total"]). Nothing for other numbers.
std::optional<NumberedLabel> total_segmentator_label(int number) noexcept;
std::optional<TissueClass> tissue_of_total_segmentator(std::string_view name) noexcept;

}  // namespace seldinger::volume
