#include "reports/sheets/replay_sheet.h"

#include <algorithm>

#include "reports/charts/timeline.h"
#include "reports/markup/base64.h"
#include "reports/pages/page.h"
#include "reports/pages/sections/metric_details.h"
#include "reports/pages/sections/step_section.h"
#include "reports/words/metric_words.h"
#include "reports/words/shown_metrics.h"

namespace seldinger::reports {
namespace {

// The colours of web/frontend/style.css; seen and unseen differ also in being dashed.
constexpr const char kStyle[] =
    ":root{color-scheme:light dark;--ground:#f6f7f8;--surface:#fff;--text:#1b232b;--soft:#51606e;--line:#d5dbe0;"
    "--seen:#0b6e99;--unseen-way:#c2410c;--target:#17663a;--band-ground:#e4e8ec;--skin:#7a5230}"
    "@media(prefers-color-scheme:dark){:root{--ground:#14191e;--surface:#1c2329;--text:#e5eaee;--soft:#a3b0bb;"
    "--line:#36414a;--seen:#58b2cf;--unseen-way:#fb923c;--target:#6fcf97;--band-ground:#2c353d;--skin:#d6a77a}}"
    "*{box-sizing:border-box}body{margin:0 auto;max-width:80rem;padding:1rem 1.25rem;background:var(--ground);"
    "color:var(--text);font:1rem/1.5 system-ui,'Segoe UI',Roboto,'Noto Sans','DejaVu Sans',sans-serif}"
    "h1{font-size:1.5rem;margin:0 0 .3rem;overflow-wrap:anywhere}h2{font-size:1.1rem;margin:1.6rem 0 .5rem}"
    ".sub,.soft,figcaption{color:var(--soft)}.sub{margin:0;overflow-wrap:anywhere}.notice{font-weight:600}"
    ".strip{display:grid;grid-template-columns:repeat(auto-fill,minmax(210px,1fr));gap:.7rem;list-style:none;"
    "margin:0;padding:0}.strip li,.planes figure{background:var(--surface);border:1px solid var(--line);"
    "border-radius:.35rem;padding:.45rem;margin:0}.strip img,.strip .empty{display:block;width:100%;height:200px;"
    "object-fit:contain;background:#000}.strip p{margin:.3rem 0 0;font-size:.875rem;line-height:1.35}"
    ".planes{display:grid;grid-template-columns:repeat(auto-fit,minmax(280px,1fr));gap:.7rem}"
    ".planes svg{display:block;width:100%;background:#000}figcaption{font-size:.875rem;margin-top:.3rem}"
    ".scroll{overflow-x:auto;background:var(--surface);border:1px solid var(--line);border-radius:.35rem}"
    "svg.timeline{display:block;width:100%;min-width:720px}"
    ".timeline text{fill:var(--soft);font-size:12px}.timeline .moment-number{fill:var(--text);font-weight:700}"
    ".timeline .mark-number{fill:var(--text);font-size:11px}.grid{stroke:var(--line)}"
    ".timeline .skin{stroke:var(--skin);stroke-width:1.5}.timeline .target{fill:var(--target);opacity:.22}"
    "polyline{fill:none;stroke-linejoin:round}.seen-way{stroke:var(--seen);stroke-width:2.2}"
    ".unseen-way{stroke:var(--unseen-way);stroke-width:2.2;stroke-dasharray:4 2.5}"
    ".outside{stroke:var(--soft);stroke-width:1}.axial{stroke:var(--text);stroke-width:1.3}"
    ".lateral{stroke:var(--soft);stroke-width:.8}.band-ground{fill:var(--band-ground)}.band{fill:var(--seen)}"
    ".moment{stroke:var(--soft);stroke-width:.7;stroke-dasharray:1 3}.fire{stroke:var(--text);stroke-width:1.2;"
    "stroke-dasharray:5 3}.mark circle,.mark .lasting{fill:var(--soft)}.mark.mentor circle,.mark.violated .lasting,"
    ".mark.violated circle{fill:var(--unseen-way)}.mark.patient circle{fill:var(--skin)}.mark.trainee circle,"
    ".mark.step .lasting,.mark.step circle{fill:var(--seen)}"
    ".dot::before{content:'';display:inline-block;width:.6em;height:.6em;border-radius:50%;background:var(--soft);"
    "margin-right:.35em}.dot.step::before{background:var(--seen)}.dot.violated::before{background:"
    "var(--unseen-way)}.dot{margin-right:1rem;white-space:nowrap}"
    ".planes .skin{stroke:#f2c79b;stroke-width:1.6}.planes .structure{stroke:#ffd54f;stroke-width:1}"
    ".planes .critical{stroke:#ff5252}.planes .major{stroke:#ff9f68}.planes .must_cross,.planes .organ,"
    ".planes .target-rule{stroke:#8fd3a8}"
    ".planes .target{fill:none;stroke:#69f0ae;stroke-width:1.6}.planes .planned{stroke:#fff;stroke-width:1.4}"
    ".planes .seen-way{stroke:#4fc3f7;stroke-width:2}.planes .unseen-way{stroke:#ff8a50;stroke-width:2}"
    ".planes .outside{stroke:#9aa7b1;stroke-width:1}.planes .needle{stroke:#fff;stroke-width:1.1;opacity:.85}"
    ".planes text{fill:#fff;font-size:12px;paint-order:stroke;stroke:#000;stroke-width:3px}"
    ".key::before{content:'';display:inline-block;width:1.4em;border-top:3px solid var(--seen);"
    "vertical-align:middle;margin-right:.35em}.key.no::before{border-top:3px dashed var(--unseen-way)}"
    ".key.target-key::before{border-top:.7em solid var(--target);opacity:.4}"
    ".key{margin-right:1rem;white-space:nowrap}"
    "table{border-collapse:collapse;width:100%}.tables{display:grid;gap:1rem;align-items:start;"
    "grid-template-columns:repeat(auto-fit,minmax(290px,1fr))}caption{text-align:left;font-weight:600;"
    "padding:.2rem 0}th,td{text-align:left;font-weight:400;padding:.18rem .5rem .18rem 0;"
    "border-bottom:1px solid "
    "var(--line);vertical-align:top}td{text-align:right;white-space:nowrap;font-variant-numeric:tabular-nums}"
    ".events{columns:18rem;column-gap:2.4rem;margin:.5rem 0 0;padding-left:1.6rem;font-size:.9rem}"
    "td .soft{white-space:normal}summary{cursor:pointer}.card{color:var(--soft);font-size:.875rem;"
    "margin:.2rem 0 .5rem}.card p{margin:0 0 .3rem}.card dl{margin:0}.card dt{font-weight:600}.card dd{margin:0}"
    "@media print{body{background:#fff}.strip li,.planes figure,table{break-inside:avoid}}"
    "@media(max-width:30rem){.strip{grid-template-columns:1fr 1fr}.strip img,.strip .empty{height:150px}"
    "body{padding:.7rem}}";

std::string mm(double value) {
  std::string text = number_text(std::abs(value), 2);
  return value < 0.0 ? "-" + text : text;
}

Html picture(const std::vector<std::byte>& png, const std::string& alt) {
  Html html;
  html.raw("<img alt=\"").text(alt).raw("\" src=\"data:image/png;base64,").text(base64(png)).raw("\">");
  return html;
}

void add_strip(Html& html, const ReplaySheet& sheet) {
  html.raw(
      "<section aria-labelledby=\"strip\"><h2 id=\"strip\">What was on the screen</h2>\n<ol class=\"strip\">\n");
  int number = 0;
  for (const SheetMoment& moment : sheet.moments) {
    const std::string words = number_text(moment.t_s, 1) + " s: " + moment.words;
    html.raw("<li>");
    if (moment.png.empty())
      html.raw("<div class=\"empty\"></div>");
    else
      html.add(picture(moment.png, words));
    html.raw("<p><strong>").text(std::to_string(++number)).raw("</strong> · ").text(words);
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
    html.raw("</span></p></li>\n");
  }
  html.raw("</ol></section>\n");
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

void add_plane(Html& html, const SheetPlane& plane, const Course& course) {
  const double side = plane.side_mm;
  html.raw("<figure><svg role=\"img\" aria-label=\"").text(plane.name).raw(": the needle’s path\" viewBox=\"0 0 ");
  html.text(mm(side)).raw(" ").text(mm(side)).raw("\">\n<image width=\"").text(mm(side)).raw("\" height=\"");
  html.text(mm(side)).raw("\" href=\"data:image/png;base64,").text(base64(plane.png)).raw("\"/>\n");
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

void add_planes(Html& html, const ReplaySheet& sheet) {
  if (sheet.planes.empty()) return;
  html.raw(
      "<section aria-labelledby=\"way\"><h2 id=\"way\">The needle’s path in the body</h2>\n<div "
      "class=\"planes\">\n");
  bool planned = false;
  std::vector<std::string> names;
  for (const SheetPlane& plane : sheet.planes) {
    add_plane(html, plane, sheet.course);
    planned = planned || plane.planned_entry_mm.has_value();
    for (const SheetOutline& outline : plane.structures)
      if (std::find(names.begin(), names.end(), outline.name) == names.end()) names.push_back(outline.name);
  }
  html.raw(
      "</div>\n<p class=\"soft\"><span class=\"key\">tip seen</span> <span class=\"key no\">tip not seen</span> ");
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
  html.raw("</p></section>\n");
}

// A step's opens what it is.
void add_mark(Html& html, const LaneMark& mark, const std::string& when) {
  const std::string words = when + mark.words;
  html.raw("<li>").add(mark.step_id.empty() ? Html{}.text(words) : step_details(mark.step_id, 0, words));
  html.raw("</li>\n");
}

void add_timeline(Html& html, const ReplaySheet& sheet) {
  std::vector<double> moments_s;
  for (const SheetMoment& moment : sheet.moments) moments_s.push_back(moment.t_s);
  const Html drawn = timeline(sheet.course, moments_s);
  if (drawn.empty()) return;
  html.raw("<section aria-labelledby=\"time\"><h2 id=\"time\">Over time</h2>\n<div class=\"scroll\">").add(drawn);
  html.raw(
      "</div>\n<p class=\"soft\"><span class=\"key\">depth of the tip, seen</span> <span class=\"key no\">not "
      "seen</span> <span class=\"key target-key\">where the target lies for this entry</span> Numbers above: "
      "the pictures. Dashed upright line: fired. Depth is the length of the needle in the body, from where it "
      "entered "
      "the skin.</p>\n");
  html.add(metric_details("vis_needle")).raw("\n").add(metric_details("vis_target")).raw("\n");
  if (!sheet.course.forces.empty())
    html.add(metric_details("force_peak_axial")).raw("\n").add(metric_details("lateral_force_peak")).raw("\n");

  for (const Lane& lane : sheet.course.lanes) {
    html.raw("<h3>").text(lane.name).raw("</h3>");
    if (std::any_of(lane.marks.begin(), lane.marks.end(),
                    [](const LaneMark& mark) { return !mark.step_id.empty(); }))
      html.raw(
          "<p class=\"soft\"><span class=\"dot step\">done</span> <span class=\"dot\">too late</span> <span "
          "class=\"dot violated\">wrong</span> (said): no deed can show it. A name opens what the step is.</p>");
    html.raw("<ol class=\"events\">\n");
    for (const LaneMark& mark : lane.marks) {
      const std::string until = mark.t1_s > mark.t0_s ? "–" + number_text(mark.t1_s, 1) : "";
      add_mark(html, mark, number_text(mark.t0_s, 1) + until + " s: ");
    }
    html.raw("</ol>\n");
    if (lane.timeless.empty()) continue;
    html.raw("<ul class=\"events\">\n");
    for (const LaneMark& mark : lane.timeless) add_mark(html, mark, "");
    html.raw("</ul>\n");
  }
  html.raw("</section>\n");
}

void add_metrics(Html& html, const casedb::AttemptRow& row) {
  html.raw(
      "<section aria-labelledby=\"measured\"><h2 id=\"measured\">What was measured</h2>\n<div class=\"tables\">\n");
  for (const std::string& group : metric_groups()) {
    Html rows;
    for (const casedb::MetricValue* metric : shown_metrics(row, group)) {
      rows.raw("<tr><th scope=\"row\">").add(metric_details(metric->id, metric->version)).raw("</th><td>");
      rows.text(value_text(*metric));
      const std::string reason = reason_text(*metric);
      if (!reason.empty()) rows.raw(" <span class=\"soft\">").text(reason).raw("</span>");
      rows.raw("</td></tr>\n");
    }
    if (!rows.empty()) html.raw("<table><caption>").text(group).raw("</caption>\n").add(rows).raw("</table>\n");
  }
  html.raw("</div>\n<p class=\"soft\">A name opens what it measures.</p></section>\n");
}

}  // namespace

std::string replay_sheet(const ReplaySheet& sheet) {
  const casedb::AttemptRow& row = sheet.attempt.row;
  Html html;
  html.raw(
          "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
          "content=\"width=device-width, initial-scale=1\"><title>Replay of ")
      .text(sheet.attempt.operator_label)
      .raw("</title><style>")
      .raw(kStyle)
      .raw("</style></head><body>\n<h1>Replay of ")
      .name(sheet.attempt.operator_label)
      .raw("</h1>\n<p class=\"sub\">")
      .name(row.case_title)
      .raw(" · ")
      .text(picture_text(row.picture) + " · " + instrument_text(row.instrument))
      .raw(" · ")
      .text(utc_text(row.started_us) + " · " + number_text(row.duration_s, 1) + " s")
      .raw("</p>\n<p class=\"notice\">")
      .text(kTrainingOnly)
      .raw("</p>\n");
  if (const std::string away = away_text(row); !away.empty())
    html.raw("<p class=\"soft\">").text(away).raw("</p>\n");
  if (!sheet.note.empty()) html.raw("<p class=\"notice\">").text(sheet.note).raw("</p>\n");
  add_strip(html, sheet);
  add_planes(html, sheet);
  add_timeline(html, sheet);
  add_metrics(html, row);
  html.raw("<p class=\"soft\">Attempt ").text(row.attempt_id).raw(" · case ").text(row.case_id);
  html.raw(" · step version ").text(std::to_string(row.step_version)).raw("</p>\n</body></html>\n");
  return html.str();
}

}  // namespace seldinger::reports
