#include "reports/studies/forest_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "reports/studies/study_words.h"

namespace seldinger::reports {
namespace {

constexpr double kForestWidth = 320.0, kForestHeight = 54.0, kForestMargin = 26.0, kAxisY = 34.0, kMiddleY = 16.0;

std::string forest_px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  return text;
}

void add_line(Html& html, double x1, double y1, double x2, double y2, std::string_view kind) {
  html.raw("<line class=\"").text(kind).raw("\" x1=\"").text(forest_px(x1)).raw("\" y1=\"").text(forest_px(y1));
  html.raw("\" x2=\"").text(forest_px(x2)).raw("\" y2=\"").text(forest_px(y2)).raw("\"/>");
}

}  // namespace

Html forest_plot(const ForestRow& row, std::string_view said) {
  double low = std::min(row.estimate, row.nothing), high = std::max(row.estimate, row.nothing);
  if (row.interval) {
    low = std::min(low, row.interval->low);
    high = std::max(high, row.interval->high);
  }
  if (row.worthwhile) {
    low = std::min(low, row.nothing - *row.worthwhile);
    high = std::max(high, row.nothing + *row.worthwhile);
  }
  const double air = 0.08 * (high > low ? high - low : 1.0);
  low = row.bounds ? row.bounds->low : low - air;
  high = row.bounds ? row.bounds->high : high + air;
  const auto at = [&](double value) {
    return kForestMargin +
           (kForestWidth - 2.0 * kForestMargin) * (std::clamp(value, low, high) - low) / (high - low);
  };
  Html html;
  html.raw("<svg class=\"forest\" role=\"img\" viewBox=\"0 0 ").text(forest_px(kForestWidth)).raw(" ");
  html.text(forest_px(kForestHeight)).raw("\"><title>").text(said).raw("</title>");
  if (row.worthwhile) {
    html.raw("<rect class=\"small\" x=\"")
        .text(forest_px(at(row.nothing - *row.worthwhile)))
        .raw("\" y=\"4\" width=\"");
    html.text(forest_px(at(row.nothing + *row.worthwhile) - at(row.nothing - *row.worthwhile)));
    html.raw("\" height=\"").text(forest_px(kAxisY - 4.0)).raw("\"/>");
  }
  add_line(html, kForestMargin, kAxisY, kForestWidth - kForestMargin, kAxisY, "axis");
  add_line(html, at(row.nothing), 4.0, at(row.nothing), kAxisY, "nothing");
  if (row.interval) {
    add_line(html, at(row.interval->low), kMiddleY, at(row.interval->high), kMiddleY, "interval");
    for (const double end : {row.interval->low, row.interval->high})
      add_line(html, at(end), kMiddleY - 5.0, at(end), kMiddleY + 5.0, "interval");
  }
  html.raw("<rect class=\"estimate\" x=\"").text(forest_px(at(row.estimate) - 4.0)).raw("\" y=\"");
  html.text(forest_px(kMiddleY - 4.0)).raw("\" width=\"8\" height=\"8\"/>");
  const auto label = [&](double value) {
    html.raw("<text text-anchor=\"middle\" x=\"").text(forest_px(at(value))).raw("\" y=\"");
    html.text(forest_px(kForestHeight - 5.0)).raw("\">").text(digits_text(value)).raw("</text>");
  };
  label(row.nothing);
  // The ends of a scale that has them, else those of the interval, as far as they do not meet the middle's label.
  const auto ends = row.bounds ? row.bounds : row.interval;
  if (ends)
    for (const double end : {ends->low, ends->high})
      if (std::abs(at(end) - at(row.nothing)) > 34.0) label(end);
  return html.raw("</svg>");
}

}  // namespace seldinger::reports
