// What a picture shows of needle and target, told in the same words by every modality.
#pragma once

namespace seldinger::imaging {

struct Visible {
  bool needle_tip = false;
  double needle_length_mm = 0.0;  // of the shaft that shows
  bool target = false;
  bool joint = false;  // needle_tip and target
};

}  // namespace seldinger::imaging
