#include "reports/charts/frontier_page.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "reports/charts/svg_parts.h"

namespace seldinger::reports {
namespace {

// The drawing's own units; CSS scales it.
constexpr double kWidth = 910.0, kHeight = 420.0, kLeft = 70.0, kRight = 240.0, kTop = 16.0, kBottom = 46.0;
constexpr double kLabelHeight = 13.0;
// Okabe and Ito's colours, told apart by all kinds of colour vision.
constexpr const char* kColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9"};

std::string three_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

bool usable(const FrontierPoint& point) {
  return std::isfinite(point.ms) && std::isfinite(point.error) && point.ms > 0.0 && point.error >= 0.0;
}

// Whole decades around values.
struct LogAxis {
  int from = 0, to = 1;
  double low_px = 0.0, high_px = 1.0;
  LogAxis(const std::vector<double>& values, double low, double high) : low_px(low), high_px(high) {
    // What is so far below the rest that it is rounding alone counts as 0.
    const double largest = values.empty() ? 0.0 : *std::max_element(values.begin(), values.end());
    double least = 1e300, most = 0.0;
    for (const double value : values) {
      if (value <= 1e-12 * largest) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
    if (most <= 0.0) return;
    from = static_cast<int>(std::floor(std::log10(least) - 0.05));
    to = std::max(from + 1, static_cast<int>(std::ceil(std::log10(most) + 0.05)));
  }
  double at(double value) const {
    const double decades = value > 0.0 ? std::max(std::log10(value), from + 0.0) : from + 0.0;
    return low_px + (high_px - low_px) * (decades - from) / (to - from);
  }
};

const char* colour_of(const std::vector<std::string>& methods, const std::string& method) {
  const auto found = std::find(methods.begin(), methods.end(), method) - methods.begin();
  return kColours[static_cast<std::size_t>(found) % std::size(kColours)];
}

void add_grid(Html& html, const LogAxis& x, const LogAxis& y, const std::string& error_unit) {
  for (int decade = x.from; decade <= x.to; ++decade) {
    const std::string at = svg_px(x.at(std::pow(10.0, decade)));
    html.raw("<line class=\"grid\" y1=\"").text(svg_px(kTop)).raw("\" y2=\"").text(svg_px(kHeight - kBottom));
    html.raw("\" x1=\"").text(at).raw("\" x2=\"").text(at).raw("\"/><text text-anchor=\"middle\" x=\"").text(at);
    html.raw("\" y=\"")
        .text(svg_px(kHeight - kBottom + 16.0))
        .raw("\">")
        .text(three_digits(std::pow(10.0, decade)));
    html.raw("</text>\n");
  }
  for (int decade = y.from; decade <= y.to; ++decade) {
    const std::string at = svg_px(y.at(std::pow(10.0, decade)));
    html.raw("<line class=\"grid\" x1=\"").text(svg_px(kLeft)).raw("\" x2=\"").text(svg_px(kWidth - kRight));
    html.raw("\" y1=\"").text(at).raw("\" y2=\"").text(at).raw("\"/><text text-anchor=\"end\" x=\"");
    html.text(svg_px(kLeft - 6.0)).raw("\" y=\"").text(svg_px(y.at(std::pow(10.0, decade)) + 4.0)).raw("\">");
    html.text(three_digits(std::pow(10.0, decade))).raw("</text>\n");
  }
  html.raw("<text text-anchor=\"middle\" x=\"").text(svg_px(0.5 * (kLeft + kWidth - kRight))).raw("\" y=\"");
  html.text(svg_px(kHeight - 8.0)).raw("\">time, ms</text><text text-anchor=\"middle\" transform=\"translate(14 ");
  html.text(svg_px(0.5 * (kTop + kHeight - kBottom)))
      .raw(") rotate(-90)\">error, ")
      .text(error_unit)
      .raw("</text>\n");
}

void add_chart(Html& html, const std::string& title, std::vector<FrontierPoint> points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.error > b.error; });
  std::vector<double> times, errors;
  std::vector<std::string> methods;
  for (const FrontierPoint& point : points) {
    times.push_back(point.ms);
    errors.push_back(point.error);
    if (std::find(methods.begin(), methods.end(), point.method) == methods.end()) methods.push_back(point.method);
  }
  std::sort(methods.begin(), methods.end());
  const LogAxis x(times, kLeft, kWidth - kRight), y(errors, kHeight - kBottom, kTop);
  const std::vector<std::size_t> best = frontier_of(points);

  html.raw("<section><h2>").text(title).raw("</h2>\n<svg role=\"img\" viewBox=\"0 0 ").text(svg_px(kWidth));
  html.raw(" ").text(svg_px(kHeight)).raw("\" aria-label=\"Time against error, ").text(title).raw("\">\n");
  add_grid(html, x, y, points.front().error_unit);
  html.raw("<polyline class=\"frontier\" points=\"");
  for (const std::size_t i : best)
    html.text(svg_px(x.at(points[i].ms))).raw(",").text(svg_px(y.at(points[i].error))).raw(" ");
  html.raw("\"/>\n");
  // Labels stand right of the plot's points, moved down where they would lie on each other,
  // and so far up that all find room above the chart's end.
  double label_y = kTop - kLabelHeight,
         last_room_y = kHeight - 6.0 - kLabelHeight * static_cast<double>(points.size());
  for (const FrontierPoint& point : points) {
    const double px_x = x.at(point.ms), px_y = y.at(point.error);
    last_room_y += kLabelHeight;
    label_y = std::max(label_y + kLabelHeight, std::min(px_y, last_room_y));
    const char* colour = colour_of(methods, point.method);
    const std::string label_x = svg_px(kWidth - kRight + 14.0);
    html.raw("<line class=\"leader\" x1=\"").text(svg_px(px_x)).raw("\" y1=\"").text(svg_px(px_y)).raw("\" x2=\"");
    html.text(svg_px(kWidth - kRight + 10.0))
        .raw("\" y2=\"")
        .text(svg_px(label_y - 1.0))
        .raw("\"/><circle r=\"4.5\" fill=\"");
    html.text(colour).raw("\" cx=\"").text(svg_px(px_x)).raw("\" cy=\"").text(svg_px(px_y)).raw("\"><title>");
    html.text(point.name).raw(": ").text(three_digits(point.ms)).raw(" ms, ").text(three_digits(point.error));
    html.raw("</title></circle><text fill=\"").text(colour).raw("\" x=\"").text(label_x).raw("\" y=\"");
    html.text(svg_px(label_y + 3.0)).raw("\">").text(point.name).raw("</text>\n");
  }
  html.raw(
      "</svg>\n<details><summary>The chart as a table</summary><table><thead><tr><th>What</th><th>ms</th><th>");
  html.text(points.front().error_unit).raw("</th><th>Reference</th><th>Frontier</th></tr></thead><tbody>\n");
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool on = std::find(best.begin(), best.end(), i) != best.end();
    html.raw("<tr><td>").text(points[i].name).raw("</td><td>").text(three_digits(points[i].ms)).raw("</td><td>");
    html.text(three_digits(points[i].error)).raw("</td><td>").text(points[i].reference).raw("</td><td>");
    html.text(on ? "yes" : "").raw("</td></tr>\n");
  }
  html.raw("</tbody></table></details></section>\n");
}

}  // namespace

std::vector<std::size_t> frontier_of(const std::vector<FrontierPoint>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return points[a].ms != points[b].ms ? points[a].ms < points[b].ms : points[a].error < points[b].error;
  });
  std::vector<std::size_t> best;
  for (const std::size_t i : order)
    if (best.empty() || points[i].error < points[best.back()].error) best.push_back(i);
  return best;
}

std::string frontier_page(const std::string& title, const std::vector<FrontierPoint>& points) {
  Html html;
  html.raw(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
      "content=\"width=device-width\"><title>");
  html.text(title);
  html.raw(
      "</title><style>\n"
      "body{font:15px/1.45 system-ui,sans-serif;max-width:60rem;margin:2rem auto;padding:0 1rem;"
      "color:#1b1b1b;background:#fff}\n"
      "svg{width:100%;height:auto}svg text{font-size:11px}svg text:not([fill]){fill:#555}\n"
      ".grid{stroke:#ddd}.leader{stroke:#ccc;stroke-width:.6}.frontier{fill:none;stroke:#888;stroke-dasharray:4 "
      "3}\n"
      "table{border-collapse:collapse}td,th{padding:.15rem .8rem .15rem 0;text-align:left}\n"
      "@media(prefers-color-scheme:dark){body{color:#e8e8e8;background:#161616}svg text:not([fill]){fill:#aaa}"
      ".grid{stroke:#333}.leader{stroke:#444}}\n</style></head><body><h1>");
  html.text(title).raw(
      "</h1>\n<p>Left is faster, down is nearer the reference; the dashed line joins what nothing "
      "beats in both.</p>\n");
  std::vector<std::string> charts;
  for (const FrontierPoint& point : points)
    if (usable(point) && std::find(charts.begin(), charts.end(), point.chart) == charts.end())
      charts.push_back(point.chart);
  for (const std::string& chart : charts) {
    std::vector<FrontierPoint> of_chart;
    for (const FrontierPoint& point : points)
      if (usable(point) && point.chart == chart) of_chart.push_back(point);
    add_chart(html, chart, of_chart);
  }
  html.raw("</body></html>\n");
  return html.str();
}

}  // namespace seldinger::reports
