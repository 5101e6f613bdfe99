// A picture as MetaImage: float32 in the picture's unit, with its place in the patient.
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

namespace seldinger::app {

// Where a picture lies in the patient. Pixel (0,0) is at center − u·pixel·(w−1)/2 − v·pixel·(h−1)/2.
struct PicturePlane {
  glm::dvec3 center_lps_mm, u, v;  // u, v: unit
  double pixel_mm;
  int width_px, height_px;
};

// One slice, x fastest = along u. The text header is MetaIO's; the third direction is u × v.
std::string meta_image(const std::vector<float>& picture, const PicturePlane& plane);

}  // namespace seldinger::app
