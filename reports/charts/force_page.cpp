#include "reports/charts/force_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reports/charts/svg_parts.h"

namespace seldinger::reports {
namespace {

// The drawing's own units; CSS scales it.
constexpr double kWidth = 860.0, kHeight = 400.0, kLeft = 60.0, kRight = 20.0, kTop = 30.0, kBottom = 46.0;
// Okabe and Ito's colours, told apart by all kinds of colour vision; the first, of what lies below, is pale.
constexpr const char* kColours[] = {"#e69f00", "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9"};
constexpr double kTableStepMm = 5.0;

std::string number(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

bool usable(const ForcePoint& point) {
  return std::isfinite(point.depth_mm) && std::isfinite(point.force_n);
}

// A round step that divides a range into at most ten.
double step_of(double range) {
  const double decade = std::pow(10.0, std::floor(std::log10(range / 10.0)));
  for (const double step : {1.0, 2.0, 5.0})
    if (range <= 10.0 * step * decade) return step * decade;
  return 10.0 * decade;
}

struct Axis {
  double step, from, to, low_px, high_px;
  Axis(double least, double most, double low, double high)
      : step(step_of(std::max(1e-6, most - least))),
        from(std::floor(least / step) * step),
        to(std::max(from + step, std::ceil(most / step) * step)),
        low_px(low),
        high_px(high) {}
  double at(double value) const { return low_px + (high_px - low_px) * (value - from) / (to - from); }
  int steps() const { return static_cast<int>(std::lround((to - from) / step)); }
};

void add_axes(Html& html, const Axis& x, const Axis& y) {
  for (int i = 0; i <= x.steps(); ++i) {
    const std::string at = svg_px(x.at(x.from + i * x.step));
    html.raw("<line class=\"grid\" y1=\"").text(svg_px(kTop)).raw("\" y2=\"").text(svg_px(kHeight - kBottom));
    html.raw("\" x1=\"").text(at).raw("\" x2=\"").text(at).raw("\"/><text text-anchor=\"middle\" x=\"").text(at);
    html.raw("\" y=\"").text(svg_px(kHeight - kBottom + 16.0)).raw("\">").text(number("%g", x.from + i * x.step));
    html.raw("</text>\n");
  }
  for (int i = 0; i <= y.steps(); ++i) {
    const double value = y.from + i * y.step;
    html.raw("<line class=\"grid\" x1=\"").text(svg_px(kLeft)).raw("\" x2=\"").text(svg_px(kWidth - kRight));
    html.raw("\" y1=\"").text(svg_px(y.at(value))).raw("\" y2=\"").text(svg_px(y.at(value)));
    html.raw("\"/><text text-anchor=\"end\" x=\"")
        .text(svg_px(kLeft - 6.0))
        .raw("\" y=\"")
        .text(svg_px(y.at(value) + 4.0));
    html.raw("\">").text(number("%.3g", value)).raw("</text>\n");
  }
  html.raw("<text text-anchor=\"middle\" x=\"").text(svg_px(0.5 * (kLeft + kWidth - kRight))).raw("\" y=\"");
  html.text(svg_px(kHeight - 8.0)).raw("\">depth, mm</text><text text-anchor=\"middle\" transform=\"translate(14 ");
  html.text(svg_px(0.5 * (kTop + kHeight - kBottom))).raw(") rotate(-90)\">force, N</text>\n");
}

// Its force at a depth, between the neighbours; nothing outside of it.
std::string force_at(const std::vector<ForcePoint>& points, double depth_mm) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ForcePoint &a = points[i - 1], &b = points[i];
    if (depth_mm < a.depth_mm || depth_mm > b.depth_mm || !(b.depth_mm > a.depth_mm)) continue;
    const double share = (depth_mm - a.depth_mm) / (b.depth_mm - a.depth_mm);
    return number("%.2f", a.force_n + share * (b.force_n - a.force_n));
  }
  return "";
}

void add_table(Html& html, const ForceChart& chart, const Axis& x) {
  html.raw("<details><summary>The chart as a table</summary><table><thead><tr><th>Depth, mm</th>");
  for (const ForceCurve& curve : chart.curves) html.raw("<th>").text(curve.name).raw(", N</th>");
  html.raw("</tr></thead><tbody>\n");
  for (double depth_mm = x.from; depth_mm <= x.to; depth_mm += kTableStepMm) {
    html.raw("<tr><td>").text(number("%g", depth_mm)).raw("</td>");
    for (const ForceCurve& curve : chart.curves)
      html.raw("<td>").text(force_at(curve.points, depth_mm)).raw("</td>");
    html.raw("</tr>\n");
  }
  html.raw("</tbody></table></details>");
}

void add_chart(Html& html, ForceChart chart) {
  double least_mm = INFINITY, most_mm = -INFINITY, least_n = 0.0, most_n = 0.0;
  std::size_t count = 0;
  for (ForceCurve& curve : chart.curves) {
    std::erase_if(curve.points, [](const ForcePoint& point) { return !usable(point); });
    count += curve.points.size();
    for (const ForcePoint& point : curve.points) {
      least_mm = std::min(least_mm, point.depth_mm);
      most_mm = std::max(most_mm, point.depth_mm);
      least_n = std::min(least_n, point.force_n);
      most_n = std::max(most_n, point.force_n);
    }
  }
  if (count < 2) return;
  const Axis x(least_mm, most_mm, kLeft, kWidth - kRight), y(least_n, most_n, kHeight - kBottom, kTop);
  html.raw("<section><h2>").text(chart.title).raw("</h2>\n<svg role=\"img\" viewBox=\"0 0 ").text(svg_px(kWidth));
  html.raw(" ").text(svg_px(kHeight)).raw("\" aria-label=\"Force against depth, ").text(chart.title).raw("\">\n");
  add_axes(html, x, y);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const char* colour = kColours[i % std::size(kColours)];
    html.raw("<polyline class=\"curve\" stroke=\"").text(colour).raw("\" points=\"");
    for (const ForcePoint& point : chart.curves[i].points)
      html.text(svg_px(x.at(point.depth_mm))).raw(",").text(svg_px(y.at(point.force_n))).raw(" ");
    html.raw("\"/><text fill=\"").text(colour).raw("\" x=\"");
    html.text(svg_px(kLeft + 10.0 + 180.0 * static_cast<double>(i)))
        .raw("\" y=\"18\">")
        .text(chart.curves[i].name)
        .raw("</text>\n");
  }
  html.raw("</svg>\n");
  add_table(html, chart, x);
  html.raw("</section>\n");
}

}  // namespace

std::string force_page(const std::string& title, const std::vector<ForceChart>& charts) {
  Html html;
  html.raw(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>");
  html.text(title);
  html.raw(
      "</title><style>\n"
      "body{font:15px/1.45 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;"
      "color:#1b1b1b;background:#fff}\n"
      "svg{width:100%;height:auto}svg text{font-size:12px}svg text:not([fill]){fill:#555}\n"
      ".grid{stroke:#ddd}.curve{fill:none;stroke-width:1.6}\n"
      "table{border-collapse:collapse}td,th{padding:.15rem .8rem .15rem 0;text-align:left}\n"
      "@media(prefers-color-scheme:dark){body{color:#e8e8e8;background:#161616}svg text:not([fill]){fill:#aaa}"
      ".grid{stroke:#333}}\n</style></head><body><h1>");
  html.text(title).raw("</h1>\n");
  for (const ForceChart& chart : charts) add_chart(html, chart);
  html.raw("</body></html>\n");
  return html.str();
}

}  // namespace seldinger::reports
