#include "app/replay/replay_frame.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <sstream>

#include "sim/base/training_only.h"

namespace seldinger::app {
namespace {

constexpr Colour kGround{20, 25, 30}, kPanel{30, 37, 43}, kText{229, 234, 238}, kSoft{150, 162, 172},
    kSeen{79, 195, 247}, kUnseen{255, 138, 80}, kTarget{105, 240, 174}, kSkin{242, 199, 155}, kWhite{255, 255, 255},
    kLine{62, 73, 83}, kCritical{255, 82, 82}, kMajor{255, 159, 104}, kAdvisory{255, 213, 79},
    kOrgan{143, 211, 168};

constexpr Rectangle kScreen{8, 36, 800, 500};
constexpr int kPlaneSide = 246, kPlaneLeft = 820, kReadLeft = 1080;
constexpr std::size_t kReadLetters = 32;  // to the right edge
constexpr int kStripLeft = 84, kStripRight = 1268, kDepthTop = 556, kDepthBottom = 630, kForceTop = 636,
              kForceBottom = 662, kBandTop = 668, kBandHeight = 9, kBandStep = 13;

std::string text(const char* format, double value) {
  char words[64];
  std::snprintf(words, sizeof words, format, value);
  return words;
}

std::vector<std::string> wrapped(const std::string& words, std::size_t letters) {
  std::vector<std::string> lines{""};
  std::istringstream stream(words);
  for (std::string word; stream >> word;) {
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > letters) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
  }
  return lines;
}

Colour colour_of(cases::StructureRule rule) {
  switch (rule) {
    case cases::StructureRule::critical:
      return kCritical;
    case cases::StructureRule::major:
      return kMajor;
    case cases::StructureRule::advisory:
      return kAdvisory;
    default:
      return kOrgan;
  }
}

}  // namespace

glm::dvec2 ReplayFrame::PlacedPlane::px(const glm::dvec3& point_lps_mm) const {
  return glm::dvec2(area.left, area.top) + plane->at(point_lps_mm) * (area.width / plane->side_mm);
}

ReplayFrame::ReplayFrame(const assessment::Signals& signals, const std::vector<BodyPlane>& planes,
                         const reports::Course& course, const std::string& title)
    : signals_(signals), course_(course), ground_(kWidthPx, kHeightPx, kGround) {
  for (const reports::CoursePoint& point : course.points) deepest_mm_ = std::max(deepest_mm_, point.inserted_mm);
  for (const reports::TargetDepth& target : course.targets)
    deepest_mm_ = std::max(deepest_mm_, target.center_mm + target.radius_mm);
  for (const reports::ForcePointInTime& force : course.forces) {
    highest_n_ = std::max(highest_n_, force.axial_n);
    lowest_n_ = std::min(lowest_n_, force.axial_n);
  }
  // The plane that the needle stands across shows least of it.
  const glm::dvec3 along = signals.poses.back().needle_direction;
  const auto across = [&](const BodyPlane& plane) {
    return std::abs(glm::dot(glm::cross(plane.u, plane.v), along));
  };
  const BodyPlane* least = nullptr;
  for (const BodyPlane& plane : planes)
    if (least == nullptr || across(plane) > across(*least)) least = &plane;
  for (const BodyPlane& plane : planes)
    if (&plane != least)
      planes_.push_back(
          {&plane, {kPlaneLeft, 36 + static_cast<int>(planes_.size()) * (kPlaneSide + 8), kPlaneSide, kPlaneSide}});
  ground_.text(kScreen.left, 12, 2, title, kText);
  const std::string_view notice = base::kTrainingOnly;
  ground_.text(kWidthPx - 8 - Canvas::text_width(1, notice), 16, 1, notice, kSoft);
  for (const PlacedPlane& placed : planes_) draw_plane(ground_, placed);
  draw_strip(ground_);
}

void ReplayFrame::draw_plane(Canvas& canvas, const PlacedPlane& placed) const {
  const BodyPlane& plane = *placed.plane;
  canvas.picture(placed.area, plane.ct);
  const double scale = placed.area.width / plane.side_mm;
  const glm::dvec2 corner(placed.area.left, placed.area.top);
  const auto within = [&](const glm::dvec2& at) {
    return at.x >= 0.0 && at.y >= 0.0 && at.x <= plane.side_mm && at.y <= plane.side_mm;
  };
  const auto draw = [&](const std::vector<PlaneSegment>& segments, Colour colour) {
    for (const PlaneSegment& segment : segments)
      if (within(segment.from_mm) && within(segment.to_mm))
        canvas.line(corner + scale * segment.from_mm, corner + scale * segment.to_mm, 1.0, colour);
  };
  draw(plane.skin, kSkin);
  for (const PlaneOutline& outline : plane.structures) draw(outline.segments, colour_of(outline.rule));
  if (signals_.setting.target)
    canvas.circle(placed.px(signals_.setting.target->center_lps_mm), scale * signals_.setting.target->radius_mm,
                  1.2, kTarget);
  const int middle = placed.area.left + placed.area.width / 2, half = placed.area.top + placed.area.height / 2;
  // With a shadow: bone is as white as they are.
  const auto letters = [&](int x, int y, const std::string& words) {
    for (const int dx : {-1, 0, 1})
      for (const int dy : {-1, 0, 1}) canvas.text(x + dx, y + dy, 1, words, {0, 0, 0});
    canvas.text(x, y, 1, words, kText);
  };
  letters(placed.area.left + 3, half, plane.left);
  letters(placed.area.left + placed.area.width - 9, half, plane.right);
  letters(middle, placed.area.top + 3, plane.upper);
  letters(middle, placed.area.top + placed.area.height - 10, plane.lower);
  letters(placed.area.left + 3, placed.area.top + 3, plane.name);
}

double ReplayFrame::x_of(double t_s) const {
  const double length_s = std::max(course_.t1_s - course_.t0_s, 1e-3);
  return kStripLeft + (kStripRight - kStripLeft) * std::clamp((t_s - course_.t0_s) / length_s, 0.0, 1.0);
}
double ReplayFrame::y_of_depth(double mm) const {
  return kDepthTop + (kDepthBottom - kDepthTop) * mm / (1.04 * deepest_mm_);
}
double ReplayFrame::y_of_force(double n) const {
  return kForceTop + (kForceBottom - kForceTop) * (highest_n_ - n) / (highest_n_ - lowest_n_);
}

void ReplayFrame::draw_strip(Canvas& canvas) const {
  canvas.fill({kStripLeft, kDepthTop, kStripRight - kStripLeft, kDepthBottom - kDepthTop}, kPanel);
  const auto rect = [&](double left, double top, double right, double bottom, Colour colour) {
    canvas.fill({static_cast<int>(std::lround(left)), static_cast<int>(std::lround(top)),
                 std::max(1, static_cast<int>(std::lround(right) - std::lround(left))),
                 std::max(1, static_cast<int>(std::lround(bottom) - std::lround(top)))},
                colour);
  };
  for (const reports::TargetDepth& target : course_.targets)
    rect(x_of(target.span.from_s), y_of_depth(std::max(0.0, target.center_mm - target.radius_mm)),
         x_of(target.span.to_s), y_of_depth(target.center_mm + target.radius_mm), {38, 78, 62});
  canvas.line({kStripLeft, y_of_depth(0.0)}, {kStripRight, y_of_depth(0.0)}, 1.0, kSkin);
  canvas.text(8, kDepthTop - 3, 1, "skin", kSoft);
  canvas.text(8, kDepthBottom - 10, 1, text("%.0f mm", deepest_mm_), kSoft);
  for (std::size_t i = 1; i < course_.points.size(); ++i) {
    const auto &a = course_.points[i - 1], &b = course_.points[i];
    canvas.line({x_of(a.t_s), y_of_depth(a.inserted_mm)}, {x_of(b.t_s), y_of_depth(b.inserted_mm)}, 1.6,
                !a.in_body   ? kSoft
                : a.tip_seen ? kSeen
                             : kUnseen);
  }
  if (!course_.forces.empty()) {
    canvas.text(8, kForceTop + 8, 1, text("force %.1f N", highest_n_), kSoft);
    canvas.line({kStripLeft, y_of_force(0.0)}, {kStripRight, y_of_force(0.0)}, 1.0, kLine);
    for (std::size_t i = 1; i < course_.forces.size(); ++i)
      canvas.line({x_of(course_.forces[i - 1].t_s), y_of_force(course_.forces[i - 1].axial_n)},
                  {x_of(course_.forces[i].t_s), y_of_force(course_.forces[i].axial_n)}, 1.0, kText);
  }
  int top = kBandTop;
  for (const reports::Band& band : course_.bands) {
    canvas.text(8, top + 1, 1, band.name, kSoft);
    rect(kStripLeft, top, kStripRight, top + kBandHeight, kPanel);
    for (const reports::Span& span : band.spans)
      if (span.from_s < course_.t1_s) rect(x_of(span.from_s), top, x_of(span.to_s), top + kBandHeight, kSeen);
    top += kBandStep;
  }
  for (const reports::Lane& lane : course_.lanes)
    for (const reports::LaneMark& mark : lane.marks)
      canvas.line({x_of(mark.t0_s), kDepthTop}, {x_of(mark.t0_s), kDepthBottom}, 1.0, kSoft);
}

Canvas ReplayFrame::draw(const cases::State& state, const session::GreyPicture& screen, bool live) const {
  Canvas canvas = ground_;
  const Rectangle shown = canvas.picture(kScreen, screen);
  const bool xray = signals_.setting.modality == cases::Modality::xray;
  if (shown.width == 0)
    canvas.text(kScreen.left + 260, kScreen.top + 240, 2, "nothing on the screen yet", kSoft);
  else if (!live)
    canvas.text(shown.left + 8, shown.top + 8, 2, xray ? "last image held" : "frozen", kAdvisory);

  const auto at = std::upper_bound(course_.points.begin(), course_.points.end(), state.t_s,
                                   [](double t_s, const reports::CoursePoint& point) { return t_s < point.t_s; });
  const auto now = static_cast<std::size_t>(std::max<std::ptrdiff_t>(at - course_.points.begin(), 1) - 1);
  for (const PlacedPlane& placed : planes_) {
    const Rectangle& area = placed.area;
    const auto inside = [&](const glm::dvec2& p) {
      return p.x >= area.left && p.y >= area.top && p.x < area.left + area.width && p.y < area.top + area.height;
    };
    for (std::size_t i = 1; i <= now; ++i) {
      const glm::dvec2 from = placed.px(signals_.poses[i - 1].tip_at_rest_lps_mm()),
                       to = placed.px(signals_.poses[i].tip_at_rest_lps_mm());
      if (!course_.points[i - 1].in_body || from == to || !inside(from) || !inside(to)) continue;
      canvas.line(from, to, 1.6, course_.points[i - 1].tip_seen ? kSeen : kUnseen);
    }
    // The needle as far as the picture goes.
    const glm::dvec2 tip = placed.px(state.needle.tip_lps_mm);
    const glm::dvec2 step =
        placed.px(state.needle.tip_lps_mm - state.needle.direction) - tip;  // of 1 mm to the hub
    double reach_mm = signals_.setting.instrument.length_mm;
    if (!inside(tip)) reach_mm = 0.0;
    while (reach_mm > 0.0 && !inside(tip + reach_mm * step)) reach_mm -= 1.0;
    if (reach_mm > 0.0) {
      canvas.line(tip, tip + reach_mm * step, 1.2, kWhite);
      canvas.circle(tip, 2.5, 1.4, kWhite);
    }
  }

  const auto seen = [&](const char* name) {
    for (const reports::Band& band : course_.bands)
      if (band.name == name)
        return std::any_of(band.spans.begin(), band.spans.end(), [&](const reports::Span& span) {
          return span.from_s <= state.t_s && state.t_s < span.to_s;
        });
    return false;
  };
  const bool tip_seen = seen("Tip seen"), target_seen = seen("Target seen");
  const reports::CoursePoint& point = course_.points[now];
  int top = 40;
  const auto read = [&](const char* name, const std::string& value, Colour colour) {
    canvas.text(kReadLeft, top, 1, name, kSoft);
    canvas.text(kReadLeft, top + 12, 3, value, colour);
    top += 52;
  };
  read("time", text("%.1f s", state.t_s), kText);
  if (state.t_s > course_.points.back().t_s)
    read("depth along the needle", "fired", kTarget);  // after it nothing is measured
  else
    read("depth along the needle", point.in_body ? text("%.1f mm", point.inserted_mm) : "outside",
         point.in_body ? kText : kSoft);
  read("tip", tip_seen ? "seen" : "not seen", tip_seen ? kSeen : kUnseen);
  read("target", target_seen ? "seen" : "not seen", target_seen ? kSeen : kUnseen);
  if (!course_.forces.empty()) {
    const auto force = std::upper_bound(course_.forces.begin(), course_.forces.end(), state.t_s,
                                        [](double t_s, const auto& one) { return t_s < one.t_s; });
    const auto& felt = force == course_.forces.begin() ? course_.forces.front() : *(force - 1);
    const double hundredths_n = std::round(100.0 * felt.axial_n) + 0.0;  // of nothing there is no minus
    read("force along the needle", text("%.2f N", hundredths_n / 100.0), kText);
  }
  // What happened within the last two seconds.
  for (const reports::Lane& lane : course_.lanes)
    for (const reports::LaneMark& mark : lane.marks)
      if (mark.kind != "hand" && mark.t0_s <= state.t_s && state.t_s < std::max(mark.t0_s + 2.0, mark.t1_s)) {
        for (const std::string& line : wrapped(mark.words, kReadLetters)) {
          canvas.text(kReadLeft, top, 1, line, kAdvisory);
          top += 12;
        }
        top += 6;
      }
  canvas.line({x_of(state.t_s), kDepthTop - 4}, {x_of(state.t_s), kHeightPx - 2}, 1.4, kWhite);
  return canvas;
}

}  // namespace seldinger::app
