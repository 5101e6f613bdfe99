#include "reports/pages/attempt_page.h"

#include <algorithm>
#include <span>
#include <vector>

#include "reports/charts/time_chart.h"
#include "reports/pages/sections/beam_table.h"
#include "reports/pages/sections/comment_section.h"
#include "reports/pages/sections/grade_section.h"
#include "reports/pages/sections/metric_details.h"
#include "reports/pages/sections/step_section.h"
#include "reports/words/condition_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"
#include "reports/words/shown_metrics.h"

namespace seldinger::reports {
namespace {

void add_value(Html& html, const casedb::MetricValue& metric) {
  html.text(value_text(metric));
  const std::string reason = reason_text(metric);
  if (!reason.empty()) html.raw(" <span class=\"why\">").text(reason).raw("</span>");
}

// The two or three numbers that say what came of it.
void add_outcome(Html& html, const casedb::AttemptRow& row) {
  html.raw("<dl class=\"outcome\">\n");
  for (const std::string_view id : {"hit", "tip_target_dist", "core_in_target", "time_total"}) {
    const casedb::MetricValue* found = find_metric(row.metrics, id);
    const bool leads = id == "hit" || id == "tip_target_dist";
    if (found == nullptr && !leads) continue;
    const bool core = row.instrument.kind == cases::InstrumentKind::core;
    if (id == "core_in_target" && !core) continue;
    const casedb::MetricValue missing{std::string(id), 1, std::nullopt, "", "not_measured"};
    const casedb::MetricValue& metric = found != nullptr ? *found : missing;
    const std::string value = value_text(metric);
    html.raw("<div class=\"");
    html.text(id == "hit" && value == "Yes" ? "good" : id == "hit" && value == "No" ? "bad" : "plain");
    html.raw("\"><dt>").add(metric_details(id, found != nullptr ? found->version : 0)).raw("</dt><dd>");
    add_value(html, metric);
    html.raw("</dd></div>\n");
  }
  html.raw("</dl>\n");
}

// As many rows of a group are read at a glance; the others are folded away.
constexpr std::size_t kLeadingRows = 4;

// What consultants do, under the value it belongs to.
void add_band(Html& html, const casedb::MetricValue& metric, const assessment::ExpertSet& experts) {
  const std::string band = band_text(experts, metric.id, metric.version);
  const std::string beside = tolerance_text(experts, metric.id, metric.version);
  if (band.empty() && beside.empty()) return;
  html.raw(" <span class=\"band\">").text(band.empty() ? beside : "consultants " + band + " (" + beside + ")");
  html.raw("</span>");
}

void add_table(Html& html, const std::string& caption, std::span<const casedb::MetricValue* const> metrics,
               const assessment::ExpertSet& experts) {
  html.raw("<table>\n<caption>")
      .text(caption)
      .raw(
          "</caption>\n<thead class=\"unseen-head\"><tr><th scope=\"col\">Metric</th><th scope=\"col\" "
          "class=\"number\">Value</th></tr></thead>\n<tbody>\n");
  for (const casedb::MetricValue* metric : metrics) {
    html.raw("<tr><th scope=\"row\">")
        .add(metric_details(metric->id, metric->version))
        .raw(" <span class=\"id\">")
        .text(metric->id)
        .raw(" v")
        .text(std::to_string(metric->version))
        .raw("</span></th><td class=\"number\">");
    add_value(html, *metric);
    add_band(html, *metric, experts);
    html.raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n");
}

void add_group(Html& html, const std::string& group, const AttemptView& view) {
  const std::vector<const casedb::MetricValue*> metrics = shown_metrics(view.row, group);
  if (metrics.empty()) return;
  // One row alone is not worth a fold.
  const std::size_t leading = metrics.size() > kLeadingRows + 1 ? kLeadingRows : metrics.size();
  const std::span all(metrics);
  add_table(html, group, all.first(leading), view.grade.experts);
  if (leading == metrics.size()) return;
  html.raw("<details><summary>")
      .text(group + ": " + std::to_string(metrics.size() - leading) + " more")
      .raw("</summary>\n");
  add_table(html, group + ", more", all.subspan(leading), view.grade.experts);
  html.raw("</details>\n");
}

void add_absent(Html& html, const casedb::AttemptRow& row) {
  Html items;
  for (const casedb::MetricValue* metric : absent_metrics(row))
    items.raw("<dt>")
        .add(metric_details(metric->id, metric->version))
        .raw("</dt><dd>")
        .text(reason_text(*metric))
        .raw("</dd>\n");
  if (items.empty()) return;
  html.raw("<details><summary>What this case does not measure</summary>\n<dl class=\"definitions\">\n").add(items);
  html.raw("</dl>\n</details>\n");
}

void add_metrics(Html& html, const AttemptView& view) {
  const casedb::AttemptRow& row = view.row;
  html.raw("<section class=\"metrics\" aria-labelledby=\"metrics\">\n<h2 id=\"metrics\">Metrics</h2>\n");
  if (row.metrics.empty())
    html.raw("<p class=\"note\">No metrics are stored with this attempt.</p>\n");
  else
    html.raw(
        "<p class=\"note\">Click a name to see what it measures. All of them: <a "
        "href=\"/metrics\">metrics</a>.</p>\n");
  for (const std::string& group : metric_groups()) add_group(html, group, view);
  add_absent(html, row);
  html.raw("</section>\n");
}

void add_picture(Html& html, const AttemptView& attempt, const cases::Recording* recording) {
  const casedb::AttemptRow& row = attempt.row;
  html.raw("<section class=\"picture\" aria-labelledby=\"picture\">\n<h2 id=\"picture\">Picture</h2>\n");
  if (row.picture_sha256.empty()) {
    html.raw("<p class=\"note\">No picture is stored with this attempt.</p>\n");
  } else {
    const casedb::MetricValue* hit = find_metric(row.metrics, "hit");
    const std::string outcome = hit == nullptr ? "" : value_text(*hit);
    const bool xray = row.picture.modality == cases::Modality::xray;
    const bool ultrasound = row.picture.modality == cases::Modality::ultrasound;
    html.raw("<figure><img src=\"/attempts/")
        .text(row.attempt_id)
        .raw("/picture.png\" alt=\"")
        .text(xray         ? "The fluoroscope's last image before the trigger was pressed, with the needle in it"
              : ultrasound ? "Ultrasound picture under the probe when the trigger was pressed"
                           : "Grey CT plane under the probe when the trigger was pressed, with the needle in it")
        .text(outcome == "Yes"  ? "; the target was hit"
              : outcome == "No" ? "; the target was missed"
                                : "")
        .raw("\">\n<figcaption>");
    if (xray) {
      html.raw("The last image before the moment of firing");
      const double fired_s = recording != nullptr && recording->endpoint ? recording->endpoint->t_s : 1e300;
      if (recording != nullptr)
        if (const auto text = image_text(recording->frames, fired_s)) html.raw(": ").text(*text);
      html.raw(".");
    } else if (ultrasound) {
      html.raw("Ultrasound at the moment of firing: probe ")
          .text(row.picture.probe)
          .raw(" at the upper edge, depth downwards, ")
          .text(number_text(row.picture.depth_mm, 0))
          .raw(" mm deep.");
    } else {
      html.raw("MPR under the probe at the moment of firing: probe at the upper edge, depth downwards, ")
          .text(number_text(row.picture.width_mm, 0))
          .raw(" mm wide, ")
          .text(number_text(row.picture.depth_mm, 0))
          .raw(" mm deep.");
    }
    html.raw("</figcaption></figure>\n");
  }
  if (attempt.may_replay && recording != nullptr)
    html.raw("<p><a href=\"/attempts/")
        .text(row.attempt_id)
        .raw("/pictures\">What was on the screen at the key moments, and where the needle was</a></p>\n");
  html.raw("</section>\n");
}

// What the drawing and the table beneath it show, by the metrics that are measured from the same.
void add_drawn(Html& html, const casedb::AttemptRow& row) {
  const bool xray = row.picture.modality == cases::Modality::xray;
  html.raw("<div class=\"drawn\">\n<span class=\"note\">What is drawn, as the metrics measure it:</span>\n");
  html.add(metric_details("tip_target_dist")).raw("\n").add(metric_details("vis_needle")).raw("\n");
  if (xray)
    for (const std::string_view id : {"views", "pulses", "fluoroscopy_time", "collimated_share", "hand_in_beam"})
      html.add(metric_details(id)).raw("\n");
  if (row.instrument.kind == cases::InstrumentKind::core)
    html.raw(
        "<p class=\"note\">The metric takes the middle of the core needle's notch, the drawing its tip.</p>\n");
  html.raw("</div>\n");
}

// Filled by replay.js, which hides it where there is nothing to show; without a script it is not there.
void add_replay(Html& html, const casedb::AttemptRow& row) {
  html.raw("<div class=\"replay3d\" data-replay=\"/attempts/").text(row.attempt_id);
  html.raw("/replay.json\" data-skin=\"/attempts/").text(row.attempt_id);
  html.raw(
      "/skin.json\" hidden>\n<canvas tabindex=\"0\" role=\"img\" aria-label=\"Needle, probe and target in three "
      "dimensions; arrow keys turn them. The text below says what is shown.\"></canvas>\n<p class=\"told\" "
      "data-told></p>\n<p class=\"said-now\" data-said role=\"status\"></p>\n<div class=\"controls\"><button "
      "type=\"button\" data-play>Play</button>\n<label>Time <input type=\"range\" min=\"0\" max=\"1\" "
      "value=\"0\"></label>\n<label>Speed <select><option value=\"0.25\">¼</option><option value=\"1\" "
      "selected>1</option><option value=\"4\">4</option></select></label>\n<span><button type=\"button\" "
      "class=\"quiet\" data-view=\"front\">From the front</button> <button type=\"button\" class=\"quiet\" "
      "data-view=\"side\">From the left</button> <button type=\"button\" class=\"quiet\" data-view=\"slice\">As a "
      "CT slice</button> <button type=\"button\" class=\"quiet\" data-zoom=\"1.5\">Larger</button> <button "
      "type=\"button\" class=\"quiet\" data-zoom=\"0.667\">Smaller</button></span></div>\n<p class=\"note\">Blue: "
      "the picture showed the tip. Dashed: it did not. Net: the skin, coarsely. R right, A front, H head. A "
      "mentor’s comment appears at its moment.</p>\n</div>\n<script src=\"/replay.js\" defer></script>\n");
}

void add_course(Html& html, const AttemptView& attempt, const cases::Recording* recording) {
  const casedb::AttemptRow& row = attempt.row;
  html.raw("<section aria-labelledby=\"course\">\n<h2 id=\"course\">Course</h2>\n");
  const Html chart = recording == nullptr ? Html{} : time_chart(*recording, row.lesion);
  if (chart.empty()) {
    html.raw("<p class=\"note\">There is no readable recording to draw.</p>\n");
  } else {
    if (attempt.may_replay) add_replay(html, row);
    html.add(chart);
    html.add(beam_table(*recording));
    add_drawn(html, row);
  }
  html.raw("</section>\n");
}

void add_detail(Html& html, std::string_view name, std::string_view value) {
  html.raw("<div><dt>").text(name).raw("</dt><dd>").name(value).raw("</dd></div>\n");
}

// Those that are known, each with what it means.
void add_conditions(Html& html, const casedb::AttemptRow& row) {
  const std::string line = conditions_text(row.conditions, row.away_s);
  if (line.empty()) {
    html.raw("<p class=\"note\">Its conditions were not recorded.</p>\n");
    return;
  }
  html.raw("<p class=\"conditions\">Conditions: ")
      .text(line)
      .raw(".</p>\n<details><summary>All conditions</summary>\n<dl class=\"definitions\">\n");
  for (const casedb::ConditionRow& condition : casedb::condition_rows()) {
    if (std::holds_alternative<std::monostate>(condition.read(row.conditions))) continue;
    html.raw("<dt>").text(condition.words).raw("</dt><dd>").text(condition_text(condition, row.conditions));
    html.raw(" <span class=\"why\">").text(condition.about).raw("</span></dd>\n");
  }
  html.raw("</dl>\n</details>\n");
}

void add_details(Html& html, const AttemptView& attempt) {
  const casedb::AttemptRow& row = attempt.row;
  html.raw(
      "<section aria-labelledby=\"details\">\n<h2 id=\"details\">How it was made</h2>\n<dl class=\"details\">\n");
  add_detail(html, "Case", row.case_title);
  add_detail(html, "Operator", attempt.operator_label);
  if (row.synthetic()) {
    add_detail(html, "Seed", std::to_string(row.seed));
    add_detail(html, "Synthetic", "Made by a simulated operator: tests the software, says nothing about people");
  }
  add_detail(html, "Instrument", instrument_text(row.instrument) + ", " + instrument_size_text(row.instrument));
  if (row.picture.modality != cases::Modality::xray) add_detail(html, "Approach", approach_text(row.approach));
  add_detail(html, "Target", lesion_text(row.lesion));
  add_detail(html, "Picture", picture_text(row.picture));
  add_detail(html, "Started", told_text(row.started_us));
  if (const std::string away = away_text(row); !away.empty()) add_detail(html, "Interruption", away);
  std::string recorded = number_text(row.duration_s, 1) + " s";
  if (row.conditions.paused_s.value_or(0.0) > 0.0)
    recorded += ", without " + number_text(*row.conditions.paused_s, 1) + " s of pauses";
  add_detail(html, "Recorded for", recorded);
  add_detail(html, "Step version", std::to_string(row.step_version));
  add_detail(html, "Program version", row.program_version);
  add_detail(html, "Attempt", row.attempt_id);
  html.raw("</dl>\n");
  add_conditions(html, row);
  html.raw("</section>\n");
}

}  // namespace

std::string attempt_pictures_page(const Visitor& visitor, const AttemptView& attempt,
                                  const base::Result<std::string>& markup) {
  Html html;
  html.raw("<p class=\"back\"><a href=\"/attempts/").text(attempt.row.attempt_id);
  html.raw("\">The attempt</a></p>\n<h1>Pictures of an attempt</h1>\n<p class=\"sub\">")
      .name(attempt.operator_label);
  html.raw(" · ").name(attempt.row.case_title).raw(" · ").text(told_text(attempt.row.started_us)).raw("</p>\n");
  if (!markup) {
    html.raw("<div class=\"message\"><p>There are no pictures: ").text(markup.error().text).raw(".</p></div>\n");
    return page("Pictures of an attempt", visitor, html);
  }
  html.raw(
      "<p class=\"note\">Redrawn from the recording, which was replayed tick for tick and compared with what "
      "was "
      "recorded.</p>\n");
  html.raw(kKeptMarkup);
  return with_kept_markup(page("Pictures of an attempt", visitor, html), *markup);
}

std::string attempt_page(const Visitor& visitor, const AttemptView& attempt, const cases::Recording* recording) {
  const casedb::AttemptRow& row = attempt.row;
  Html html;
  html.raw("<p class=\"back\"><a href=\"/attempts\">All attempts</a></p>\n<h1>Attempt of ")
      .name(attempt.operator_label)
      .raw("</h1>\n<p class=\"sub\">")
      .name(row.case_title)
      .raw(" · ")
      .text(instrument_text(row.instrument))
      .raw(" · <time datetime=\"")
      .text(told_machine_text(row.started_us))
      .raw("\">")
      .text(told_text(row.started_us))
      .raw("</time></p>\n");
  html.add(grade_section(attempt.grade));
  add_outcome(html, row);
  add_course(html, attempt, recording);
  html.add(comment_section(attempt, attempt.may_comment ? visitor.form_token : std::string()));
  html.raw("<div class=\"columns\">\n");
  add_metrics(html, attempt);
  html.raw("<div>\n");
  add_picture(html, attempt, recording);
  html.add(step_section(attempt.steps)).raw("</div>\n</div>\n");
  add_details(html, attempt);
  return page("Attempt of " + attempt.operator_label, visitor, html);
}

}  // namespace seldinger::reports
