#include "reports/charts/mean_chart.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace seldinger::reports {
namespace {

constexpr double kMeanWidth = 720.0, kMeanLabels = 330.0, kMeanRight = 16.0, kMeanTop = 30.0;
constexpr double kMarkPitch = 15.0, kRowGap = 12.0, kMeanBottom = 40.0, kWhiskerEnd = 3.5, kMarkRadius = 4.5;
constexpr std::size_t kLabelColumns = 52;

std::string mean_px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

void add_mean_line(Html& html, const std::string& kind, double x1, double y1, double x2, double y2) {
  html.raw("<line class=\"").text(kind).raw("\" x1=\"").text(mean_px(x1)).raw("\" y1=\"").text(mean_px(y1));
  html.raw("\" x2=\"").text(mean_px(x2)).raw("\" y2=\"").text(mean_px(y2)).raw("\"/>");
}

void add_mean_text(Html& html, const char* anchor, double x, double y, std::string_view text) {
  html.raw("<text text-anchor=\"").text(anchor).raw("\" x=\"").text(mean_px(x)).raw("\" y=\"").text(mean_px(y));
  html.raw("\">").text(text).raw("</text>");
}

// A label on as many lines as it needs.
std::vector<std::string> label_lines(const std::string& label) {
  std::vector<std::string> lines(1);
  for (std::size_t from = 0; from < label.size();) {
    const std::size_t end = std::min(label.find(' ', from), label.size());
    const std::string word = label.substr(from, end - from);
    if (!lines.back().empty() && lines.back().size() + 1 + word.size() > kLabelColumns) lines.emplace_back();
    lines.back() += (lines.back().empty() ? "" : " ") + word;
    from = end + 1;
  }
  return lines;
}

// A shape of its own for each series, so that colour is not needed to tell them.
void add_mark(Html& html, std::size_t series, double x, double y) {
  const std::string kind = "mean s" + std::to_string(series);
  if (series % 2 == 0) {
    html.raw("<circle class=\"").text(kind).raw("\" cx=\"").text(mean_px(x)).raw("\" cy=\"").text(mean_px(y));
    html.raw("\" r=\"").text(mean_px(kMarkRadius)).raw("\"/>");
  } else {
    html.raw("<rect class=\"").text(kind).raw("\" x=\"").text(mean_px(x - kMarkRadius)).raw("\" y=\"");
    html.text(mean_px(y - kMarkRadius)).raw("\" width=\"").text(mean_px(2.0 * kMarkRadius)).raw("\" height=\"");
    html.text(mean_px(2.0 * kMarkRadius)).raw("\"/>");
  }
}

}  // namespace

Html mean_chart(const MeanChart& chart) {
  const auto at = [&](double value) {
    return kMeanLabels + (kMeanWidth - kMeanLabels - kMeanRight) *
                             (std::clamp(value, chart.low, chart.high) - chart.low) / (chart.high - chart.low);
  };
  Html rows;
  double y = kMeanTop;
  for (const MeanRow& row : chart.rows) {
    const auto lines = label_lines(row.label);
    const double height =
        std::max(kMarkPitch * static_cast<double>(chart.series.size()), 13.0 * static_cast<double>(lines.size()));
    for (std::size_t i = 0; i < lines.size(); ++i)
      add_mean_text(rows, "start", 0.0, y + 11.0 + 13.0 * static_cast<double>(i), lines[i]);
    for (std::size_t i = 0; i < row.marks.size(); ++i) {
      const double middle = y + kMarkPitch * (static_cast<double>(i) + 0.5);
      const auto& mark = row.marks[i];
      if (!mark || !std::isfinite(mark->mean) || !std::isfinite(mark->sd)) {
        add_mean_text(rows, "start", kMeanLabels + 4.0, middle + 4.0, "N.A.");
        continue;
      }
      const std::string kind = "spread s" + std::to_string(i);
      const double from = at(mark->mean - mark->sd), to = at(mark->mean + mark->sd);
      add_mean_line(rows, kind, from, middle, to, middle);
      for (const double end : {from, to})
        add_mean_line(rows, kind, end, middle - kWhiskerEnd, end, middle + kWhiskerEnd);
      add_mark(rows, i, at(mark->mean), middle);
    }
    y += height + kRowGap;
  }
  Html html;
  html.raw("<svg class=\"means\" role=\"img\" viewBox=\"0 0 ").text(mean_px(kMeanWidth)).raw(" ");
  html.text(mean_px(y + kMeanBottom)).raw("\"><title>").text(chart.said).raw("</title>");
  for (std::size_t i = 0; i < chart.series.size(); ++i) {
    // More than two names do not fit above the marks alone.
    const double from = chart.series.size() > 2 ? 0.0 : kMeanLabels;
    const double x =
        from + 10.0 + (kMeanWidth - from) / static_cast<double>(chart.series.size()) * static_cast<double>(i);
    add_mark(html, i, x, 10.0);
    add_mean_text(html, "start", x + 9.0, 14.0, chart.series[i]);
  }
  for (double value = chart.low; value <= chart.high + 0.5; value += 1.0) {
    add_mean_line(html, "grid", at(value), kMeanTop - 6.0, at(value), y);
    add_mean_text(html, "middle", at(value), y + 14.0, std::to_string(std::lround(value)));
  }
  add_mean_text(html, "start", kMeanLabels, y + 30.0, chart.low_label);
  add_mean_text(html, "end", kMeanWidth - kMeanRight, y + 30.0, chart.high_label);
  return html.add(rows).raw("</svg>");
}

}  // namespace seldinger::reports
