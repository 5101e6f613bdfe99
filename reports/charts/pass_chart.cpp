#include "reports/charts/pass_chart.h"

#include <algorithm>
#include <cstdio>
#include <map>

#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

constexpr double kPassLabels = 230.0, kPassPitch = 18.0, kPassRow = 26.0, kPassTop = 8.0, kPassBottom = 26.0;
constexpr double kPassMark = 6.0, kDayLabel = 76.0;
constexpr std::size_t kPassLabelLetters = 34;

std::string pass_px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

// Shape tells as much as colour does: a disc, a cross, a ring.
void add_pass_mark(Html& html, assessment::Verdict verdict, double x, double y) {
  const auto px = [&](double value) { html.text(pass_px(value)); };
  if (verdict == assessment::Verdict::failed) {
    html.raw("<path class=\"missed\" d=\"M");
    px(x - kPassMark), html.raw(" "), px(y - kPassMark), html.raw("L"), px(x + kPassMark), html.raw(" ");
    px(y + kPassMark), html.raw("M"), px(x - kPassMark), html.raw(" "), px(y + kPassMark), html.raw("L");
    px(x + kPassMark), html.raw(" "), px(y - kPassMark), html.raw("\"/>");
    return;
  }
  if (verdict == assessment::Verdict::passed)
    html.raw("<circle class=\"passed\" cx=\"");
  else
    html.raw("<circle class=\"not-graded\" cx=\"");
  px(x), html.raw("\" cy=\""), px(y), html.raw("\" r=\""), px(kPassMark), html.raw("\"/>");
}

}  // namespace

Html pass_chart(const std::vector<PassRow>& rows) {
  // The place of each attempt among all of them.
  std::map<std::pair<std::int64_t, std::string>, std::size_t> places;
  for (const PassRow& row : rows)
    for (const assessment::GradedAttempt& one : *row.attempts)
      places.emplace(std::pair{one.started_us, one.attempt_id}, 0);
  if (places.empty()) return {};
  std::size_t next = 0;
  for (auto& [key, place] : places) place = next++;
  const auto x_of = [](std::size_t place) { return kPassLabels + kPassPitch * (static_cast<double>(place) + 0.5); };
  const double width = std::max(kPassLabels + kPassPitch * static_cast<double>(places.size()) + kDayLabel, 480.0);
  const double bottom = kPassTop + kPassRow * static_cast<double>(rows.size());

  Html html;
  html.raw(
          "<div class=\"wide\"><svg class=\"passes\" role=\"group\" aria-label=\"Attempts in their order, passed "
          "or not\" width=\"")
      .text(pass_px(width))
      .raw("\" viewBox=\"0 0 ")
      .text(pass_px(width))
      .raw(" ")
      .text(pass_px(bottom + kPassBottom))
      .raw("\">\n");
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double y = kPassTop + kPassRow * (static_cast<double>(i) + 0.5);
    std::string label = rows[i].label;
    if (label.size() > kPassLabelLetters) {
      std::size_t end = kPassLabelLetters - 1;
      while (end > 0 && (static_cast<unsigned char>(label[end]) & 0xC0U) == 0x80U) --end;  // no letter is cut
      label = label.substr(0, end) + "…";
    }
    html.raw("<text x=\"0\" y=\"").text(pass_px(y + 4.0)).raw("\">").text(label).raw("</text>");
    html.raw("<line class=\"grid\" x1=\"")
        .text(pass_px(kPassLabels))
        .raw("\" x2=\"")
        .text(pass_px(width - kDayLabel));
    html.raw("\" y1=\"").text(pass_px(y)).raw("\" y2=\"").text(pass_px(y)).raw("\"/>\n");
    for (const assessment::GradedAttempt& one : *rows[i].attempts) {
      const std::string said = rows[i].label + ", " + told_text(one.started_us) + ": " + verdict_word(one.verdict);
      html.raw("<a href=\"/attempts/").text(one.attempt_id).raw("\" aria-label=\"").text(said).raw("\"><title>");
      html.text(said).raw("</title>");
      add_pass_mark(html, one.verdict, x_of(places.at({one.started_us, one.attempt_id})), y);
      html.raw("</a>\n");
    }
  }
  std::string last_day;
  double free_from = 0.0;
  for (const auto& [key, place] : places) {
    const std::string day = utc_text(key.first).substr(0, 10);
    if (day == last_day || x_of(place) < free_from) continue;
    last_day = day;
    free_from = x_of(place) + kDayLabel;
    html.raw("<text class=\"day\" x=\"").text(pass_px(x_of(place) - kPassMark)).raw("\" y=\"");
    html.text(pass_px(bottom + 16.0)).raw("\">").text(day).raw("</text>");
  }
  return html.raw(
      "</svg></div>\n<p class=\"legend-line\"><span class=\"yes\">●</span> passed <span class=\"no\">✕</span> "
      "not passed <span>○</span> not graded</p>\n");
}

}  // namespace seldinger::reports
