// The guidance's picture alone, to be kept as a file: with its scale, its marks and how the machine stood. Nothing
// of patient, case or person.
#pragma once

#include <string>
#include <vector>

#include "app/replay/canvas.h"
#include "app/window/hands/calipers.h"
#include "session/monitor/monitor.h"

namespace seldinger::app {

// Where a point of the picture lies below the middle of its upper edge (the face's centre), mm: x across, flipped
// as the picture is, y down; and back. CHECKs that the picture has a scale.
glm::dvec2 mm_of(const session::ShownPicture& shown, bool flip, const glm::dvec2& pixel);
glm::dvec2 pixel_of(const session::ShownPicture& shown, bool flip, const glm::dvec2& at_mm);

// Depths to be marked, mm, one a centimetre, from the face down to the lower edge of the picture.
std::vector<double> depth_marks_mm(const session::ShownPicture& shown);

// Every how many of these marks has its number beside it, so that numbers stay apart; the others are short.
int numbered_every(double px_per_cm);

// `words`: ASCII, a line each, below the picture. The picture must have pixels (CHECKed).
Canvas console_picture(const session::ShownPicture& shown, bool flip, const Calipers& calipers,
                       const std::vector<std::string>& words);

}  // namespace seldinger::app
