#include "reports/charts/interval_chart.h"

#include <algorithm>
#include <cmath>

#include "reports/charts/svg_parts.h"

namespace seldinger::reports {
namespace {

constexpr double kWidth = 720.0, kLeft = 230.0, kRight = 120.0, kTop = 10.0, kPitch = 26.0, kBottom = 40.0;
constexpr double kEnd = 4.0, kHalf = 4.5;
constexpr std::size_t kLabelColumns = 34;

struct Ends {
  double low = 1e300, high = -1e300;
  void hold(double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

}  // namespace

Html interval_chart(const IntervalChart& chart) {
  Ends ends;
  std::vector<const IntervalRow*> rows;
  for (const IntervalRow& one : chart.rows) {
    if (!std::isfinite(one.estimate)) continue;
    rows.push_back(&one);
    ends.hold(one.estimate);
    if (one.interval) ends.hold(one.interval->low);
    if (one.interval) ends.hold(one.interval->high);
    if (one.truth) ends.hold(*one.truth);
  }
  Html html;
  if (rows.empty()) return html;
  const std::vector<double> ticks = round_ticks(chart.low.value_or(ends.low), chart.high.value_or(ends.high));
  const auto at = [&](double value) {
    return kLeft + (kWidth - kLeft - kRight) * (std::clamp(value, ticks.front(), ticks.back()) - ticks.front()) /
                       (ticks.back() - ticks.front());
  };
  const double bottom = kTop + kPitch * static_cast<double>(rows.size());
  html.raw("<svg class=\"intervals\" role=\"img\"");
  if (chart.alone)
    html.raw(" xmlns=\"http://www.w3.org/2000/svg\" font-family=\"'DejaVu Sans', Verdana, sans-serif\"");
  html.raw(" viewBox=\"0 0 ").text(svg_px(kWidth) + " " + svg_px(bottom + kBottom));
  html.raw("\"><title>").text(chart.said).raw("</title>\n");
  if (chart.alone)
    html.raw(
        "<style>text{fill:#333;font-size:11px}line{stroke:#333;stroke-width:1.6}.grid{stroke:#ccc;stroke-width:0.8}"
        ".estimate{fill:#fff;stroke:#1a5fa8;stroke-width:1.8}.marked{fill:#1a5fa8}.truth{stroke:#b3261e}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
  for (const double tick : ticks) {
    add_svg_line(html, "grid", at(tick), kTop, at(tick), bottom);
    add_svg_text(html, "middle", at(tick), bottom + 15.0, tick_text(tick));
  }
  add_svg_text(html, "middle", 0.5 * (kLeft + kWidth - kRight), bottom + kBottom - 6.0, chart.x_label);
  double y = kTop + 0.5 * kPitch;
  for (const IntervalRow* row : rows) {
    add_svg_text(html, "start", 0.0, y + 4.0, shortened(row->label, kLabelColumns));
    add_svg_text(html, "start", kWidth - kRight + 10.0, y + 4.0, row->beside);
    if (row->interval) {
      add_svg_line(html, "interval", at(row->interval->low), y, at(row->interval->high), y);
      for (const double end : {row->interval->low, row->interval->high})
        add_svg_line(html, "interval", at(end), y - kEnd, at(end), y + kEnd);
    }
    html.raw("<rect class=\"").text(row->marked ? "estimate marked" : "estimate").raw("\" x=\"");
    html.text(svg_px(at(row->estimate) - kHalf)).raw("\" y=\"").text(svg_px(y - kHalf)).raw("\" width=\"");
    html.text(svg_px(2.0 * kHalf)).raw("\" height=\"").text(svg_px(2.0 * kHalf)).raw("\"/>");
    if (row->truth) {
      for (const double side : {-1.0, 1.0})
        add_svg_line(html, "truth", at(*row->truth) - kHalf, y - side * kHalf, at(*row->truth) + kHalf,
                     y + side * kHalf);
    }
    html.raw("\n");
    y += kPitch;
  }
  return html.raw("</svg>\n");
}

}  // namespace seldinger::reports
