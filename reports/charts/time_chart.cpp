#include "reports/charts/time_chart.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "reports/charts/svg_parts.h"
#include "reports/charts/timeline.h"
#include "reports/words/metric_words.h"
#include "sim/base/check.h"

namespace seldinger::reports {
namespace {

// The drawing's own units; CSS scales it.
constexpr double kWidth = 720.0, kHeight = 266.0;
constexpr double kLeft = 56.0, kRight = 12.0, kTop = 14.0, kPlotBottom = 186.0, kStripTop = 200.0,
                 kStripBottom = 214.0;
constexpr std::size_t kChartPoints = 300, kTableRows = 11;

struct Axes {
  double t0_s, t1_s, top_mm;
  double x(double t_s) const { return kLeft + (kWidth - kLeft - kRight) * (t_s - t0_s) / (t1_s - t0_s); }
  double y(double d_mm) const { return kPlotBottom - (kPlotBottom - kTop) * d_mm / top_mm; }
};

void add_ticks(Html& html, const Axes& axes) {
  const double step_mm = tick_step(axes.top_mm, 5);
  for (int i = 0; i * step_mm <= axes.top_mm * (1.0 + 1e-9); ++i) {
    const double d_mm = i * step_mm;
    const std::string y = svg_px(axes.y(d_mm));
    html.raw("<line class=\"grid\" x1=\"")
        .text(svg_px(kLeft))
        .raw("\" x2=\"")
        .text(svg_px(kWidth - kRight))
        .raw("\" y1=\"");
    html.text(y).raw("\" y2=\"").text(y).raw("\"/><text class=\"tick\" text-anchor=\"end\" x=\"");
    html.text(svg_px(kLeft - 6.0)).raw("\" y=\"").text(svg_px(axes.y(d_mm) + 4.0)).raw("\">");
    html.text(tick_text(d_mm, step_mm)).raw("</text>");
  }
  const double step_s = tick_step(axes.t1_s - axes.t0_s, 8);
  for (int i = 0; i * step_s <= (axes.t1_s - axes.t0_s) * (1.0 + 1e-9); ++i) {
    const double t_s = axes.t0_s + i * step_s;
    html.raw("<text class=\"tick\" text-anchor=\"middle\" x=\"").text(svg_px(axes.x(t_s))).raw("\" y=\"");
    html.text(svg_px(kStripBottom + 20.0)).raw("\">").text(tick_text(i * step_s, step_s)).raw("</text>");
  }
}

bool within(std::span<const Span> spans, double t_s) {
  return std::any_of(spans.begin(), spans.end(),
                     [&](const Span& span) { return span.from_s <= t_s && t_s <= span.to_s; });
}

// A frozen or held picture shows nothing: between looks nobody can say whether the tip would have been seen.
void add_table(Html& html, std::span<const DistancePoint> points, std::span<const Span> visible,
               std::span<const Span> live, double t0_s) {
  html.raw(
      "<details><summary>The chart as a table</summary>\n<table>\n<caption>Distance of the tip from the "
      "target’"
      "s centre over time</caption>\n<thead><tr><th scope=\"col\" class=\"number\">Time</th>"
      "<th scope=\"col\" class=\"number\">Distance</th><th scope=\"col\">Tip in the "
      "picture</th></tr></thead>\n<tbody>\n");
  for (const DistancePoint& point : points) {
    html.raw("<tr><th scope=\"row\" class=\"number\">")
        .text(number_text(point.t_s - t0_s, 1))
        .raw(" s</th><td class=\"number\">")
        .text(number_text(point.distance_mm, 1))
        .raw(" mm</td><td>")
        .text(within(visible, point.t_s) ? "Yes"
              : within(live, point.t_s)  ? "No"
                                         : "No live picture")
        .raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n</details>\n");
}

}  // namespace

std::vector<DistancePoint> distance_over_time(std::span<const cases::PoseSample> poses, const cases::Lesion& lesion,
                                              std::size_t max_points) {
  CHECK(max_points >= 2);
  std::vector<DistancePoint> all;
  for (const cases::PoseSample& pose : poses) {
    const double distance_mm = glm::distance(pose.tip_lps_mm, lesion.center_lps_mm);
    const bool in_order = all.empty() || pose.t_s > all.back().t_s;
    if (std::isfinite(distance_mm) && std::isfinite(pose.t_s) && in_order) all.push_back({pose.t_s, distance_mm});
  }
  if (all.size() <= max_points) return all;
  std::vector<DistancePoint> some;
  for (std::size_t i = 0; i < max_points; ++i) some.push_back(all[i * (all.size() - 1) / (max_points - 1)]);
  return some;
}

std::vector<Span> tip_visible_spans(std::span<const cases::FrameTruth> frames) {
  return spans_where(frames, [](const cases::FrameTruth& frame) { return frame.live && frame.needle_tip; });
}

Html time_chart(const cases::Recording& recording, const cases::Lesion& lesion) {
  const std::vector<DistancePoint> points = distance_over_time(recording.poses, lesion, kChartPoints);
  Html html;
  if (points.size() < 2) return html;
  const std::vector<Span> visible = tip_visible_spans(recording.frames);
  double farthest_mm = lesion.radius_mm;
  for (const DistancePoint& point : points) farthest_mm = std::max(farthest_mm, point.distance_mm);
  if (!std::isfinite(farthest_mm) || farthest_mm <= 0.0) farthest_mm = 1.0;
  const Axes axes{points.front().t_s, points.back().t_s, 1.05 * farthest_mm};

  html.raw("<figure class=\"chart\">\n<svg role=\"img\" aria-labelledby=\"chart-title chart-desc\" viewBox=\"0 0 ");
  html.text(svg_px(kWidth))
      .raw(" ")
      .text(svg_px(kHeight))
      .raw("\">\n<title id=\"chart-title\">Distance of the tip from the target");
  html.raw("’s centre over time</title>\n<desc id=\"chart-desc\">From ");
  html.text(number_text(points.front().distance_mm, 1)).raw(" mm at the start to ");
  html.text(number_text(points.back().distance_mm, 1)).raw(" mm at the end, ");
  html.text(number_text(axes.t1_s - axes.t0_s, 1))
      .raw(
          " s later. The band below marks when the picture showed the tip. The table after the chart has the "
          "numbers.</desc>\n");
  // The target itself: within its radius of the centre.
  if (lesion.radius_mm > 0.0) {
    html.raw("<rect class=\"target\" x=\"")
        .text(svg_px(kLeft))
        .raw("\" width=\"")
        .text(svg_px(kWidth - kLeft - kRight));
    html.raw("\" y=\"").text(svg_px(axes.y(lesion.radius_mm))).raw("\" height=\"");
    html.text(svg_px(kPlotBottom - axes.y(lesion.radius_mm))).raw("\"/>");
  }
  add_ticks(html, axes);
  html.raw("<rect class=\"unseen\" x=\"")
      .text(svg_px(kLeft))
      .raw("\" width=\"")
      .text(svg_px(kWidth - kLeft - kRight));
  html.raw("\" y=\"")
      .text(svg_px(kStripTop))
      .raw("\" height=\"")
      .text(svg_px(kStripBottom - kStripTop))
      .raw("\"/>");
  for (const Span& span : visible) {
    const double from_s = std::clamp(span.from_s, axes.t0_s, axes.t1_s);
    const double to_s = std::clamp(span.to_s, axes.t0_s, axes.t1_s);
    if (to_s <= from_s) continue;
    html.raw("<rect class=\"seen\" x=\"").text(svg_px(axes.x(from_s))).raw("\" width=\"");
    html.text(svg_px(axes.x(to_s) - axes.x(from_s))).raw("\" y=\"").text(svg_px(kStripTop)).raw("\" height=\"");
    html.text(svg_px(kStripBottom - kStripTop)).raw("\"/>");
  }
  html.raw("<polyline class=\"curve\" points=\"");
  for (const DistancePoint& point : points) {
    html.text(svg_px(axes.x(point.t_s))).raw(",").text(svg_px(axes.y(point.distance_mm))).raw(" ");
  }
  html.raw("\"/>");
  if (recording.endpoint.has_value() && recording.endpoint->t_s >= axes.t0_s &&
      recording.endpoint->t_s <= axes.t1_s) {
    const std::string x = svg_px(axes.x(recording.endpoint->t_s));
    html.raw("<line class=\"fire\" x1=\"").text(x).raw("\" x2=\"").text(x).raw("\" y1=\"").text(svg_px(kTop));
    html.raw("\" y2=\"").text(svg_px(kStripBottom)).raw("\"/>");
  }
  html.raw("<text class=\"tick\" text-anchor=\"middle\" x=\"").text(svg_px((kLeft + kWidth - kRight) / 2.0));
  html.raw("\" y=\"")
      .text(svg_px(kHeight - 8.0))
      .raw("\">distance in mm, time in seconds since the start</text>\n</svg>\n<figcaption>");
  html.raw(
      "Line: distance of the tip from the target’s centre in mm. Shaded: inside the target’s "
      "radius. "
      "Band below: <span class=\"key seen-key\">tip in the picture</span>, "
      "<span class=\"key unseen-key\">tip not in the picture</span>.");
  if (recording.endpoint.has_value()) html.raw(" Dashed: the moment of firing.");
  html.raw("</figcaption>\n");
  const std::vector<DistancePoint> rows = distance_over_time(recording.poses, lesion, kTableRows);
  add_table(html, rows, visible, spans_where(recording.frames, [](const auto& frame) { return frame.live; }),
            axes.t0_s);
  html.raw("</figure>\n");
  return html;
}

}  // namespace seldinger::reports
