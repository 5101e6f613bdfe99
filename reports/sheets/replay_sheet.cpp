#include "reports/sheets/replay_sheet.h"

#include <algorithm>

#include "reports/charts/timeline.h"
#include "reports/pages/page.h"
#include "reports/pages/sections/metric_details.h"
#include "reports/pages/sections/step_section.h"
#include "reports/sheets/sheet_parts.h"
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
          "class=\"dot violated\">wrong</span> (said): no action can show it. Click a name to see what the step "
          "is.</p>");
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
  html.raw("</div>\n<p class=\"soft\">Click a name to see what it measures.</p></section>\n");
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
  html.add(sheet_strip(sheet)).add(sheet_planes(sheet));
  add_timeline(html, sheet);
  add_metrics(html, row);
  html.raw("<p class=\"soft\">Attempt ").text(row.attempt_id).raw(" · case ").text(row.case_id);
  html.raw(" · step version ").text(std::to_string(row.step_version)).raw("</p>\n</body></html>\n");
  return html.str();
}

}  // namespace seldinger::reports
