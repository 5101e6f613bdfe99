// Goal 16: how alike the picture and the element-level reference are, of the same scatterers.
#pragma once

#include "app/measure/ultrasound_goals/element_level.h"
#include "app/measure/ultrasound_goals/goal.h"

namespace seldinger::measure {

struct ElementWindow {
  double depth_mm, length_mm;
  int lines;  // of 128, in the middle of the picture
};
struct Likeness {
  double ncc;  // correlation of the envelopes, their means taken off
  std::size_t scatterers, points;
};
Likeness likeness_to_elements(const Setting& setting, Apodisation apodisation, double focus_mm,
                              const ElementWindow& window);

}  // namespace seldinger::measure
