// The guidance's picture alone, to be kept as a file: with its scale, its marks and how the machine stood. Nothing
// of patient, case or person.
#pragma once

#include <string>
#include <vector>

#include "app/canvas.h"
#include "app/train/calipers.h"
#include "app/train/monitor.h"

namespace seldinger::app {

// Where a point of the picture lies below the middle of its upper edge (the face's centre), mm: x across, flipped
// as the picture is, y down; and back. CHECKs that the picture has a scale.
glm::dvec2 mm_of(const ShownPicture& shown, bool flip, const glm::dvec2& pixel);
glm::dvec2 pixel_of(const ShownPicture& shown, bool flip, const glm::dvec2& at_mm);

// Depths to be marked, mm, one a centimetre, from the face down to the lower edge of the picture.
std::vector<double> depth_marks_mm(const ShownPicture& shown);

// `words`: ASCII, a line each, below the picture. The picture must have pixels (CHECKed).
Canvas console_picture(const ShownPicture& shown, bool flip, const Calipers& calipers,
                       const std::vector<std::string>& words);

}  // namespace seldinger::app
