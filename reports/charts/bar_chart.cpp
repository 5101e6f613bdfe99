#include "reports/charts/bar_chart.h"

#include <algorithm>
#include <cmath>

#include "reports/charts/svg_parts.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

constexpr double kWidth = 720.0, kHeight = 190.0, kLeft = 10.0, kRight = 10.0, kTop = 22.0, kBottom = 40.0;
constexpr double kGap = 0.15;  // of a bar's place, at each side

}  // namespace

std::string share_text(double share) {
  if (!(share > 0.0)) return "0 %";
  if (share < 0.001) return "under 0.1 %";
  return number_text(100.0 * share, share < 0.1 ? 1 : 0) + " %";
}

Html bar_chart(const BarChart& chart) {
  Html html;
  if (chart.bars.empty()) return html;
  // Whoever has no mouse moves what is wider than the screen, too.
  html.raw("<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"").text(chart.said);
  html.raw("\"><svg class=\"series\" role=\"img\" viewBox=\"0 0 ").text(svg_px(kWidth) + " " + svg_px(kHeight));
  html.raw("\"><title>").text(chart.said).raw("</title>\n");
  const double base = kHeight - kBottom, pitch = (kWidth - kLeft - kRight) / static_cast<double>(chart.bars.size());
  double most = 0.0;
  for (const Bar& one : chart.bars)
    if (std::isfinite(one.share)) most = std::max(most, one.share);
  add_svg_line(html, "grid", kLeft, base, kWidth - kRight, base);
  for (std::size_t i = 0; i < chart.bars.size(); ++i) {
    const Bar& one = chart.bars[i];
    const double left = kLeft + pitch * (static_cast<double>(i) + kGap), middle = left + pitch * (0.5 - kGap);
    const double height = std::isfinite(one.share) && most > 0.0 ? (base - kTop) * one.share / most : 0.0;
    html.raw("<rect class=\"bar\" x=\"")
        .text(svg_px(left))
        .raw("\" width=\"")
        .text(svg_px(pitch * (1.0 - 2.0 * kGap)));
    html.raw("\" y=\"").text(svg_px(base - height)).raw("\" height=\"").text(svg_px(height)).raw("\"/>");
    add_svg_text(html, "middle", middle, base - height - 5.0, share_text(one.share));
    add_svg_text(html, "middle", middle, base + 15.0, one.label);
  }
  add_svg_text(html, "middle", 0.5 * kWidth, kHeight - 6.0, chart.x_label);
  return html.raw("</svg></div>\n");
}

}  // namespace seldinger::reports
