// An attempt on one page: pictures at telling moments, the needle's way in the body, everything over time, and what
// was measured. Self-contained: no file beside it, no script.
#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "reports/charts/course.h"
#include "reports/words/attempt_words.h"

namespace seldinger::reports {

// Small enough that a page with a dozen of them is soon there.
struct SmallPicture {
  std::vector<std::byte> png;
  int width_px = 0, height_px = 0;
};

struct SheetMoment {
  double t_s = 0.0;
  std::string words;           // why it is shown
  std::vector<std::byte> png;  // may be empty: nothing was on the screen
  bool live = true, tip_seen = false, target_seen = false;
  SmallPicture small{};  // of a page whose pictures lie beside it
};

struct SheetSegment {
  glm::dvec2 from_mm, to_mm;  // right of and below the upper left corner
};
struct SheetOutline {
  std::string name, rule;
  std::vector<SheetSegment> segments;
};
// A square plane of the CT; what lies before or behind it is projected onto it.
struct SheetPlane {
  std::string name, left, right, upper, lower;
  double side_mm = 0.0;
  std::vector<std::byte> png;
  std::vector<SheetSegment> skin;
  std::vector<SheetOutline> structures;
  std::vector<glm::dvec2> way;  // one for each of the course's points
  std::optional<glm::dvec2> target_mm, planned_entry_mm, tip_mm, hub_mm;
  double target_radius_mm = 0.0;
};

struct ReplaySheet {
  AttemptView attempt;
  std::string note;  // when the replay could not be held against the recording; else empty
  std::vector<SheetMoment> moments;
  std::vector<SheetMoment> film;  // smaller pictures at even times, for raters; none: no film
  std::vector<SheetPlane> planes;
  Course course;
  bool blinded = false;  // for raters: see blinded_replay.h
};

std::string replay_sheet(const ReplaySheet& sheet);

}  // namespace seldinger::reports
