#include "reports/charts/timeline.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "reports/charts/svg_parts.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

// The drawing's own units; CSS scales it.
constexpr double kWidth = 960.0, kLeft = 92.0, kRight = 24.0;
constexpr double kTop = 30.0, kDepthHeight = 190.0, kForceHeight = 70.0, kRow = 18.0, kGap = 12.0;
constexpr std::size_t kMostPoints = 900;

class Drawing {
 public:
  Drawing(const Course& course, Html& html) : course_(course), html_(html) {
    for (const CoursePoint& point : course.points) deepest_mm_ = std::max(deepest_mm_, point.inserted_mm);
    for (const TargetDepth& target : course.targets)
      deepest_mm_ = std::max(deepest_mm_, target.center_mm + target.radius_mm);
    if (!(deepest_mm_ > 10.0)) deepest_mm_ = 10.0;
    for (const ForcePointInTime& force : course.forces) {
      highest_n_ = std::max({highest_n_, force.axial_n, force.lateral_n});
      lowest_n_ = std::min({lowest_n_, force.axial_n});
    }
    if (!(highest_n_ > 0.5)) highest_n_ = 0.5;
  }

  double draw_depth(double top) {
    const auto y = [&](double mm) { return top + kDepthHeight * mm / (1.04 * deepest_mm_); };
    for (const TargetDepth& target : course_.targets)
      rect("target", x(target.span.from_s), std::max(2.0, x(target.span.to_s) - x(target.span.from_s)),
           y(std::max(0.0, target.center_mm - target.radius_mm)),
           y(target.center_mm + target.radius_mm) - y(std::max(0.0, target.center_mm - target.radius_mm)));
    const double step_mm = tick_step(deepest_mm_, 5);
    for (int i = 0; i * step_mm <= deepest_mm_; ++i) {
      line(i == 0 ? "skin" : "grid", kLeft, y(i * step_mm), kWidth - kRight, y(i * step_mm));
      text("tick", "end", kLeft - 6.0, y(i * step_mm) + 4.0,
           i == 0 ? "skin" : tick_text(i * step_mm, step_mm) + " mm");
    }
    // Pieces of one sight each; the last point of one is the first of the next.
    const std::size_t stride = std::max<std::size_t>(1, course_.points.size() / kMostPoints);
    for (std::size_t i = 0; i + 1 < course_.points.size();) {
      const CoursePoint& first = course_.points[i];
      const auto same = [&](const CoursePoint& point) {
        return point.in_body == first.in_body && (!first.in_body || point.tip_seen == first.tip_seen);
      };
      html_.raw("<polyline class=\"").text(!first.in_body ? "outside" : first.tip_seen ? "seen-way" : "unseen-way");
      html_.raw("\" points=\"");
      std::size_t k = i;
      for (bool more = true; more;) {
        html_.text(svg_px(x(course_.points[k].t_s)))
            .raw(",")
            .text(svg_px(y(course_.points[k].inserted_mm)))
            .raw(" ");
        more = k + 1 < course_.points.size() && same(course_.points[k]);
        if (!more) break;
        std::size_t next = k + 1;
        while (next < k + stride && next + 1 < course_.points.size() && same(course_.points[next])) ++next;
        k = next;
      }
      html_.raw("\"/>\n");
      i = std::max(k, i + 1);
    }
    return top + kDepthHeight + kGap;
  }

  double draw_forces(double top) {
    if (course_.forces.empty()) return top;
    const auto y = [&](double n) {
      return top + kForceHeight * (highest_n_ - n) / (1.04 * (highest_n_ - lowest_n_));
    };
    line("grid", kLeft, y(0.0), kWidth - kRight, y(0.0));
    line("grid", kLeft, y(highest_n_), kWidth - kRight, y(highest_n_));
    text("tick", "end", kLeft - 6.0, y(0.0) + 4.0, "0 N");
    text("tick", "end", kLeft - 6.0, y(highest_n_) + 4.0, number_text(highest_n_, 1) + " N");
    const std::size_t stride = std::max<std::size_t>(1, course_.forces.size() / kMostPoints);
    for (const bool axial : {false, true}) {
      html_.raw("<polyline class=\"").text(axial ? "axial" : "lateral").raw("\" points=\"");
      // The largest of each stretch, so that no peak is lost.
      for (std::size_t i = 0; i < course_.forces.size(); i += stride) {
        ForcePointInTime most = course_.forces[i];
        for (std::size_t k = i; k < std::min(i + stride, course_.forces.size()); ++k)
          if (std::abs(axial ? course_.forces[k].axial_n : course_.forces[k].lateral_n) >
              std::abs(axial ? most.axial_n : most.lateral_n))
            most = course_.forces[k];
        html_.text(svg_px(x(most.t_s))).raw(",").text(svg_px(y(axial ? most.axial_n : most.lateral_n))).raw(" ");
      }
      html_.raw("\"/>\n");
    }
    text("label", "start", kLeft + 4.0, top + 10.0, "force: along the needle, across (thin)");
    return top + kForceHeight + kGap;
  }

  double draw_rows(double top) {
    for (const Band& band : course_.bands) {
      text("tick", "end", kLeft - 6.0, top + 11.0, band.name);
      rect("band-ground", kLeft, kWidth - kLeft - kRight, top, kRow - 5.0);
      for (const Span& span : band.spans) {
        const double from = x(std::max(span.from_s, course_.t0_s)), to = x(std::min(span.to_s, course_.t1_s));
        if (to > from) rect("band", from, to - from, top, kRow - 5.0);
      }
      top += kRow;
    }
    for (const Lane& lane : course_.lanes) {
      text("tick", "end", kLeft - 6.0, top + 12.0, lane.name);
      int number = 0;
      double free_from = 0.0;
      bool lower = false;
      for (const LaneMark& mark : lane.marks) {
        ++number;
        const double from = x(mark.t0_s), to = x(mark.t1_s);
        html_.raw("<g class=\"mark ").text(mark.kind).raw("\"><title>").text(number_text(mark.t0_s, 1));
        html_.raw(" s: ").text(mark.words).raw("</title>");
        if (to - from > 3.0)
          rect("lasting", from, to - from, top + 1.0, kRow - 6.0);
        else
          html_.raw("<circle r=\"4\" cx=\"").text(svg_px(from)).raw("\" cy=\"").text(svg_px(top + 7.0)).raw("\"/>");
        lower = from < free_from && !lower;
        text("mark-number", "middle", std::max(from, 0.5 * (from + to)), top + (lower ? 34.0 : 22.0),
             std::to_string(number));
        free_from = from + 14.0;
        html_.raw("</g>\n");
      }
      top += kRow + 20.0;
    }
    return top;
  }

  void draw_times(double bottom, std::span<const double> moments_s) {
    const double step_s = tick_step(course_.t1_s - course_.t0_s, 10);
    for (int i = 0; i * step_s <= (course_.t1_s - course_.t0_s) * (1.0 + 1e-9); ++i)
      text("tick", "middle", x(course_.t0_s + i * step_s), bottom + 14.0, tick_text(i * step_s, step_s));
    text("tick", "middle", 0.5 * (kLeft + kWidth - kRight), bottom + 30.0, "seconds since the start");
    if (course_.fired_s) line("fire", x(*course_.fired_s), kTop, x(*course_.fired_s), bottom);
    double free_from = 0.0;
    bool higher = false;
    for (std::size_t i = 0; i < moments_s.size(); ++i) {
      const double at = x(moments_s[i]);
      higher = at < free_from && !higher;
      line("moment", at, higher ? 13.0 : kTop - 5.0, at, kTop + kDepthHeight);
      text("moment-number", "middle", at, higher ? 11.0 : kTop - 7.0, std::to_string(i + 1));
      free_from = at + 14.0;
    }
  }

 private:
  double x(double t_s) const {
    const double length_s = std::max(course_.t1_s - course_.t0_s, 1e-3);
    return kLeft + (kWidth - kLeft - kRight) * (t_s - course_.t0_s) / length_s;
  }
  void line(const char* kind, double x1, double y1, double x2, double y2) {
    html_.raw("<line class=\"").text(kind).raw("\" x1=\"").text(svg_px(x1)).raw("\" y1=\"").text(svg_px(y1));
    html_.raw("\" x2=\"").text(svg_px(x2)).raw("\" y2=\"").text(svg_px(y2)).raw("\"/>\n");
  }
  void rect(const char* kind, double left, double width, double top, double height) {
    html_.raw("<rect class=\"").text(kind).raw("\" x=\"").text(svg_px(left)).raw("\" width=\"").text(svg_px(width));
    html_.raw("\" y=\"").text(svg_px(top)).raw("\" height=\"").text(svg_px(height)).raw("\"/>\n");
  }
  void text(const char* kind, const char* anchor, double left, double baseline, const std::string& words) {
    html_.raw("<text class=\"").text(kind).raw("\" text-anchor=\"").text(anchor).raw("\" x=\"").text(svg_px(left));
    html_.raw("\" y=\"").text(svg_px(baseline)).raw("\">").text(words).raw("</text>\n");
  }

  const Course& course_;
  Html& html_;
  double deepest_mm_ = 0.0, highest_n_ = 0.0, lowest_n_ = 0.0;
};

}  // namespace

double tick_step(double range, int most) {
  const double rough = range / most;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power >= rough) return factor * power;
  }
  return 10.0 * power;
}

Html timeline(const Course& course, std::span<const double> moments_s) {
  Html body, html;
  if (course.points.size() < 2 || !(course.t1_s > course.t0_s)) return html;
  Drawing drawing(course, body);
  double bottom = drawing.draw_depth(kTop);
  bottom = drawing.draw_forces(bottom);
  bottom = drawing.draw_rows(bottom);
  drawing.draw_times(bottom, moments_s);
  html.raw(
      "<svg class=\"timeline\" role=\"img\" aria-label=\"Depth of the tip, what the picture showed, forces and ");
  html.raw("events over time\" viewBox=\"0 0 ")
      .text(svg_px(kWidth))
      .raw(" ")
      .text(svg_px(bottom + 36.0))
      .raw("\">\n");
  html.add(body).raw("</svg>\n");
  return html;
}

}  // namespace seldinger::reports
