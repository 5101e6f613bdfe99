#include "reports/sheets/sheet_parts.h"

#include <algorithm>
#include <cmath>

#include "reports/markup/base64.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::string mm(double value) {
  std::string text = number_text(std::abs(value), 2);
  return value < 0.0 ? "-" + text : text;
}

Html picture(const std::vector<std::byte>& png, const std::string& alt, const Placed& placed) {
  Html html;
  html.raw("<img alt=\"").text(alt).raw("\" src=\"").text(placed(png)).raw("\">");
  return html;
}

// A small one that opens the whole one; browsers fetch it when it comes near the screen.
Html small_picture(const SheetMoment& moment, const std::string& alt, const Placed& placed) {
  Html html;
  html.raw("<a href=\"").text(placed(moment.png)).raw("\"><img loading=\"lazy\" width=\"");
  html.text(std::to_string(moment.small.width_px)).raw("\" height=\"");
  html.text(std::to_string(moment.small.height_px)).raw("\" alt=\"").text(alt).raw("\" src=\"");
  html.text(placed(moment.small.png)).raw("\"></a>");
  return html;
}

// What the picture showed, as the recording knows it.
void add_seen(Html& html, const ReplaySheet& sheet, const SheetMoment& moment) {
  html.raw(" <span class=\"soft\">· ");
  const bool xray = sheet.attempt.row.picture.modality == cases::Modality::xray;
  if (moment.png.empty())
    html.text("nothing on the screen yet");
  else if (!moment.live)
    html.text(xray ? "last image held" : "frozen");
  else
    html.text(moment.tip_seen && moment.target_seen ? "tip and target seen"
              : moment.tip_seen                     ? "tip seen, target not"
              : moment.target_seen                  ? "target seen, tip not"
                                                    : "neither tip nor target seen");
  html.raw("</span>");
}

// Names of structures are often made of words and underscores.
std::string spaced(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

// All segments as one path, in the plane's millimetres.
void add_segments(Html& html, std::string_view kind, const std::vector<SheetSegment>& segments,
                  const std::string& title) {
  if (segments.empty()) return;
  html.raw("<path vector-effect=\"non-scaling-stroke\" fill=\"none\" class=\"").text(kind).raw("\" d=\"");
  for (const SheetSegment& segment : segments)
    html.raw("M")
        .text(mm(segment.from_mm.x))
        .raw(" ")
        .text(mm(segment.from_mm.y))
        .raw("L")
        .text(mm(segment.to_mm.x))
        .raw(" ")
        .text(mm(segment.to_mm.y));
  html.raw("\"><title>").text(title).raw("</title></path>\n");
}

const char* way_kind(const CoursePoint& point) {
  return !point.in_body ? "outside" : point.tip_seen ? "seen-way" : "unseen-way";
}

void add_way(Html& html, const std::vector<CoursePoint>& points, const std::vector<glm::dvec2>& way) {
  constexpr double kStepMm = 0.3;
  for (std::size_t i = 0; i + 1 < way.size();) {
    const char* kind = way_kind(points[i]);
    html.raw("<polyline vector-effect=\"non-scaling-stroke\" class=\"").text(kind).raw("\" points=\"");
    glm::dvec2 last(1e300);
    std::size_t k = i;
    for (;; ++k) {
      const bool ends = k + 1 >= way.size() || way_kind(points[k]) != kind;
      const glm::dvec2 moved = way[k] - last;
      if (ends || moved.x * moved.x + moved.y * moved.y >= kStepMm * kStepMm) {
        html.text(mm(way[k].x)).raw(",").text(mm(way[k].y)).raw(" ");
        last = way[k];
      }
      if (ends) break;
    }
    html.raw("\"/>\n");
    i = std::max(k, i + 1);
  }
}

void add_line(Html& html, const char* kind, const glm::dvec2& from, const glm::dvec2& to) {
  html.raw("<line vector-effect=\"non-scaling-stroke\" class=\"").text(kind).raw("\" x1=\"").text(mm(from.x));
  html.raw("\" y1=\"").text(mm(from.y)).raw("\" x2=\"").text(mm(to.x)).raw("\" y2=\"").text(mm(to.y)).raw("\"/>\n");
}

void add_plane(Html& html, const SheetPlane& plane, const Course& course, const Placed& placed) {
  const double side = plane.side_mm;
  html.raw("<figure><svg role=\"img\" aria-label=\"").text(plane.name).raw(": the needle’s path\" viewBox=\"0 0 ");
  html.text(mm(side)).raw(" ").text(mm(side)).raw("\">\n<image width=\"").text(mm(side)).raw("\" height=\"");
  html.text(mm(side)).raw("\" href=\"").text(placed(plane.png)).raw("\"/>\n");
  add_segments(html, "skin", plane.skin, "skin");
  for (const SheetOutline& outline : plane.structures)
    add_segments(html, "structure " + (outline.rule == "target" ? "target-rule" : outline.rule), outline.segments,
                 spaced(outline.name));
  if (plane.target_mm) {
    html.raw("<circle vector-effect=\"non-scaling-stroke\" class=\"target\" cx=\"").text(mm(plane.target_mm->x));
    html.raw("\" cy=\"").text(mm(plane.target_mm->y)).raw("\" r=\"").text(mm(plane.target_radius_mm));
    html.raw("\"><title>target</title></circle>\n");
  }
  if (plane.tip_mm && plane.hub_mm) add_line(html, "needle", *plane.hub_mm, *plane.tip_mm);
  add_way(html, course.points, plane.way);
  if (plane.planned_entry_mm) {
    const double arm = 0.02 * side;
    const glm::dvec2 at = *plane.planned_entry_mm;
    add_line(html, "planned", at - glm::dvec2(arm, arm), at + glm::dvec2(arm, arm));
    add_line(html, "planned", at - glm::dvec2(arm, -arm), at + glm::dvec2(arm, -arm));
  }
  // Letters and the bar keep their size: a drawing of its own, over the same square.
  html.raw("<svg viewBox=\"0 0 300 300\"><text x=\"4\" y=\"154\">").text(plane.left);
  html.raw("</text><text x=\"296\" y=\"154\" text-anchor=\"end\">").text(plane.right);
  html.raw("</text><text x=\"150\" y=\"13\" text-anchor=\"middle\">").text(plane.upper);
  html.raw("</text><text x=\"150\" y=\"296\" text-anchor=\"middle\">").text(plane.lower);
  const double bar = 300.0 * 20.0 / side;
  html.raw("</text><line stroke=\"#dfe6ea\" stroke-width=\"2\" x1=\"8\" x2=\"").text(mm(8.0 + bar));
  html.raw("\" y1=\"290\" y2=\"290\"/><text x=\"8\" y=\"285\">20 mm</text></svg>\n</svg><figcaption>");
  html.text(plane.name).raw("</figcaption></figure>\n");
}

}  // namespace

std::string in_the_page(const std::vector<std::byte>& png) {
  return "data:image/png;base64," + base64(png);
}

Html sheet_strip(const ReplaySheet& sheet, const Placed& placed) {
  Html html;
  html.raw(
      "<section aria-labelledby=\"strip\"><h2 id=\"strip\">What was on the screen</h2>\n<ol class=\"strip\">\n");
  int number = 0;
  for (const SheetMoment& moment : sheet.moments) {
    const std::string words = number_text(moment.t_s, 1) + " s" + (moment.words.empty() ? "" : ": " + moment.words);
    html.raw("<li>");
    if (moment.png.empty())
      html.raw("<div class=\"empty\"></div>");
    else
      html.add(moment.small.png.empty() ? picture(moment.png, words, placed)
                                        : small_picture(moment, words, placed));
    html.raw("<p><strong>").text(std::to_string(++number)).raw("</strong> · ").text(words);
    if (!sheet.blinded) add_seen(html, sheet, moment);
    html.raw("</p></li>\n");
  }
  return html.raw("</ol></section>\n");
}

Html sheet_film(const ReplaySheet& sheet) {
  Html html;
  if (sheet.film.empty()) return html;
  html.raw(
      "<section aria-labelledby=\"film\" data-film hidden><h2 id=\"film\">The film</h2>\n<ol class=\"frames\">\n");
  for (const SheetMoment& moment : sheet.film) {
    html.raw("<li data-t=\"").text(number_text(moment.t_s, 2)).raw("\">");
    if (moment.png.empty())
      html.raw("<div class=\"empty\"></div>");
    else
      html.add(picture(moment.png, number_text(moment.t_s, 1) + " s", in_the_page));
    html.raw("</li>\n");
  }
  html.raw(
      "</ol>\n<p class=\"film-keys\"><button type=\"button\" data-play>Play</button> <input type=\"range\" "
      "data-moment min=\"0\" max=\"");
  html.text(std::to_string(sheet.film.size() - 1));
  html.raw(
      "\" value=\"0\" aria-label=\"Moment\"> <span data-told></span> <label>Pace <select data-pace>"
      "<option value=\"0.5\">half</option><option value=\"1\" selected>as it was</option><option "
      "value=\"2\">twice</option><option value=\"4\">four times</option></select></label></p></section>\n");
  return html;
}

Html sheet_planes(const ReplaySheet& sheet, const Placed& placed) {
  Html html;
  if (sheet.planes.empty()) return html;
  html.raw(
      "<section aria-labelledby=\"way\"><h2 id=\"way\">The needle’s path in the body</h2>\n<div "
      "class=\"planes\">\n");
  bool planned = false;
  std::vector<std::string> names;
  for (const SheetPlane& plane : sheet.planes) {
    add_plane(html, plane, sheet.course, placed);
    planned = planned || plane.planned_entry_mm.has_value();
    for (const SheetOutline& outline : plane.structures)
      if (std::find(names.begin(), names.end(), outline.name) == names.end()) names.push_back(outline.name);
  }
  html.raw("</div>\n<p class=\"soft\">");
  if (!sheet.blinded) html.raw("<span class=\"key\">tip seen</span> <span class=\"key no\">tip not seen</span> ");
  html.raw(
      "The CT is cut through the target (circle); the path, and the needle as it ended (white), are projected "
      "onto it. Pale line: skin.");
  if (sheet.attempt.row.picture.modality == cases::Modality::xray)
    html.raw(" Between exposures nothing is seen; to advance there, in small steps, is correct practice.");
  if (planned) html.raw(" Cross: the planned entry.");
  if (!names.empty()) {
    html.raw(" Outlined: ");
    for (std::size_t i = 0; i < names.size(); ++i) html.text(i == 0 ? "" : ", ").name(spaced(names[i]));
    html.raw(".");
  }
  return html.raw("</p></section>\n");
}

}  // namespace seldinger::reports
