#include "reports/charts/svg_parts.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "reports/words/metric_words.h"

namespace seldinger::reports {

std::string svg_px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

void add_svg_line(Html& html, std::string_view kind, double x1, double y1, double x2, double y2) {
  html.raw("<line class=\"").text(kind).raw("\" x1=\"").text(svg_px(x1)).raw("\" y1=\"").text(svg_px(y1));
  html.raw("\" x2=\"").text(svg_px(x2)).raw("\" y2=\"").text(svg_px(y2)).raw("\"/>");
}

void add_svg_text(Html& html, std::string_view anchor, double x, double y, std::string_view text) {
  html.raw("<text text-anchor=\"").text(anchor).raw("\" x=\"").text(svg_px(x)).raw("\" y=\"").text(svg_px(y));
  html.raw("\">").text(text).raw("</text>");
}

std::string shortened(const std::string& label, std::size_t columns) {
  std::size_t letters = 0;
  for (std::size_t i = 0; i < label.size(); ++i)
    if ((static_cast<unsigned char>(label[i]) & 0xC0U) != 0x80 && ++letters > columns)
      return label.substr(0, i) + "…";
  return label;
}

std::vector<double> round_ticks(double low, double high, double least_step) {
  if (!(high > low)) {
    const double off = low == 0.0 ? 1.0 : 0.1 * std::abs(low);
    low -= off;
    high = low + 2.0 * off;
  }
  double step = std::pow(10.0, std::floor(std::log10((high - low) / 4.0)));
  for (const double factor : {2.0, 2.5, 2.0})  // 1, 2, 5, 10
    if ((high - low) / step > 6.0) step *= factor;
  step = std::max(step, least_step);
  // A hair, so that what is round already stays an end.
  const double first = std::floor(low / step + 1e-9), last = std::ceil(high / step - 1e-9);
  std::vector<double> ticks;
  for (double count = first; count <= last + 0.5; count += 1.0) ticks.push_back(count * step);
  return ticks;
}

std::string tick_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", std::abs(value));
  return value < 0.0 ? "−" + std::string(text) : text;
}

std::string tick_text(double value, double step) {
  return number_text(value, step < 1.0 ? std::min(3, static_cast<int>(std::ceil(-std::log10(step)))) : 0);
}

}  // namespace seldinger::reports
