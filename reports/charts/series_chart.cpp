#include "reports/charts/series_chart.h"

#include <algorithm>
#include <cmath>

#include "reports/charts/svg_parts.h"

namespace seldinger::reports {
namespace {

// The drawing's own units; CSS scales it.
constexpr double kWidth = 720.0, kHeight = 230.0, kLeft = 62.0, kRight = 110.0, kTop = 12.0, kBottom = 40.0;
constexpr double kRadius = 4.0, kLabelGap = 13.0;
constexpr std::size_t kMostXLabels = 12;

struct Axis {
  double low = 0.0, high = 1.0, low_px = 0.0, high_px = 1.0;
  double at(double value) const {
    return low_px + (high_px - low_px) * (std::clamp(value, low, high) - low) / (high - low);
  }
};

void add_path(Html& html, const char* kind, const std::vector<std::pair<double, double>>& points, const Axis& x,
              const Axis& y) {
  html.raw("<polyline class=\"").text(kind).raw("\" points=\"");
  for (const auto& [px_x, px_y] : points) html.text(svg_px(x.at(px_x)) + "," + svg_px(y.at(px_y)) + " ");
  html.raw("\"/>");
}

Axis y_axis(const SeriesChart& chart, std::vector<double>& ticks) {
  double low = chart.points.front().y, high = low;
  const auto hold = [&](double value) {
    if (!std::isfinite(value)) return;
    low = std::min(low, value);
    high = std::max(high, value);
  };
  for (const SeriesPoint& one : chart.points) hold(one.y);
  for (const auto& one : chart.curve) hold(one.second);
  for (const SeriesLimit& one : chart.limits) hold(one.y);
  if (chart.band) hold(chart.band->low), hold(chart.band->high);
  ticks = round_ticks(chart.y_low.value_or(low), chart.y_high.value_or(high), chart.y_whole ? 1.0 : 0.0);
  return {ticks.front(), ticks.back(), kHeight - kBottom, kTop};
}

std::vector<double> x_ticks_of(const SeriesChart& chart) {
  if (chart.measured_x) return round_ticks(chart.points.front().x, chart.points.back().x);
  std::vector<double> ticks;
  const std::size_t every = (chart.points.size() - 1) / kMostXLabels + 1;
  for (std::size_t i = 0; i < chart.points.size(); i += every) ticks.push_back(chart.points[i].x);
  return ticks;
}

void add_axes(Html& html, const SeriesChart& chart, const Axis& x, const Axis& y, const std::vector<double>& ticks,
              const std::vector<double>& x_ticks) {
  for (const double tick : ticks) {
    add_svg_line(html, "grid", kLeft, y.at(tick), kWidth - kRight, y.at(tick));
    add_svg_text(html, "end", kLeft - 6.0, y.at(tick) + 4.0, tick_text(tick * chart.y_shown));
  }
  for (const double at : x_ticks) add_svg_text(html, "middle", x.at(at), kHeight - kBottom + 15.0, tick_text(at));
  add_svg_text(html, "middle", 0.5 * (kLeft + kWidth - kRight), kHeight - 6.0, chart.x_label);
  html.raw("<text text-anchor=\"middle\" transform=\"translate(14 ").text(svg_px(0.5 * (kTop + kHeight - kBottom)));
  html.raw(") rotate(-90)\">").text(chart.y_label).raw("</text>\n");
}

// A word at the right end, below those that are there.
void add_label(Html& html, const std::string& label, double at_px, std::vector<double>& taken) {
  double label_y = at_px + 4.0;
  for (const double other : taken)
    if (std::abs(label_y - other) < kLabelGap) label_y = other + kLabelGap;
  taken.push_back(label_y);
  add_svg_text(html, "start", kWidth - kRight + 6.0, label_y, label);
}

void add_band(Html& html, const SeriesBand& band, const Axis& y) {
  html.raw("<rect class=\"band\" x=\"")
      .text(svg_px(kLeft))
      .raw("\" width=\"")
      .text(svg_px(kWidth - kRight - kLeft));
  html.raw("\" y=\"").text(svg_px(y.at(band.high))).raw("\" height=\"");
  // A band of one value is seen, too.
  html.text(svg_px(std::max(2.0, y.at(band.low) - y.at(band.high)))).raw("\"/>");
}

void add_limits(Html& html, const SeriesChart& chart, const Axis& y) {
  std::vector<double> taken;
  for (const SeriesLimit& one : chart.limits) {
    if (!std::isfinite(one.y)) continue;
    add_svg_line(html, "limit", kLeft, y.at(one.y), kWidth - kRight, y.at(one.y));
    add_label(html, one.label, y.at(one.y), taken);
  }
  if (chart.band) add_label(html, chart.band->label, 0.5 * (y.at(chart.band->low) + y.at(chart.band->high)), taken);
}

}  // namespace

Html series_chart(const SeriesChart& asked) {
  SeriesChart chart = asked;
  std::erase_if(chart.points,
                [](const SeriesPoint& one) { return !std::isfinite(one.x) || !std::isfinite(one.y); });
  if (chart.band && !(std::isfinite(chart.band->low) && std::isfinite(chart.band->high))) chart.band.reset();
  std::erase_if(chart.curve,
                [](const auto& one) { return !std::isfinite(one.first) || !std::isfinite(one.second); });
  Html html;
  if (chart.points.empty()) return html;
  std::vector<double> ticks;
  const Axis y = y_axis(chart, ticks);
  const std::vector<double> x_ticks = x_ticks_of(chart);
  const double first = chart.measured_x ? x_ticks.front() : chart.points.front().x;
  const double last = chart.measured_x ? x_ticks.back() : chart.points.back().x;
  // One point stands in the middle.
  const double margin = last > first ? 0.02 * (last - first) : 1.0;
  const Axis x{first - margin, last + margin, kLeft, kWidth - kRight};
  // Whoever has no mouse moves what is wider than the screen, too.
  html.raw("<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"").text(chart.said);
  html.raw("\"><svg class=\"series\" role=\"img\" viewBox=\"0 0 ").text(svg_px(kWidth) + " " + svg_px(kHeight));
  html.raw("\"><title>").text(chart.said).raw("</title>\n");
  if (chart.band) add_band(html, *chart.band, y);
  add_axes(html, chart, x, y, ticks, x_ticks);
  add_limits(html, chart, y);
  if (!chart.curve.empty()) add_path(html, "curve", chart.curve, x, y);
  if (chart.joined) {
    std::vector<std::pair<double, double>> path;
    for (const SeriesPoint& one : chart.points) path.emplace_back(one.x, one.y);
    add_path(html, "path", path, x, y);
  }
  for (const SeriesPoint& one : chart.points) {
    html.raw("<circle class=\"").text(one.filled ? "point" : "point hollow").raw("\" r=\"").text(svg_px(kRadius));
    html.raw("\" cx=\"").text(svg_px(x.at(one.x))).raw("\" cy=\"").text(svg_px(y.at(one.y))).raw("\"/>");
  }
  return html.raw("</svg></div>\n");
}

}  // namespace seldinger::reports
