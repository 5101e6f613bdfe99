#include "reports/charts/box_chart.h"

#include <algorithm>
#include <cmath>

#include "reports/charts/svg_parts.h"

namespace seldinger::reports {
namespace {

constexpr double kWidth = 980.0, kLeft = 400.0, kRight = 170.0, kTop = 8.0, kNote = 15.0;
constexpr double kTitle = 26.0, kPitch = 17.0, kAxis = 24.0, kGap = 12.0;
constexpr double kBoxHalf = 5.0, kEnd = 3.0, kMark = 3.5, kFoot = 4.0;
constexpr std::size_t kLabelColumns = 72;

struct Scale {
  std::vector<double> ticks;  // the first and the last are its ends
  bool logarithmic = false;
  double at(double value) const {
    const auto place = [&](double x) { return logarithmic ? std::log(x) : x; };
    const double low = place(ticks.front()), high = place(ticks.back());
    const double inside = std::clamp(value, ticks.front(), ticks.back());
    return kLeft + (kWidth - kLeft - kRight) * (place(inside) - low) / (high - low);
  }
};

std::vector<double> values_of(const BoxPanel& panel) {
  std::vector<double> values;
  const auto add = [&](double value) {
    if (std::isfinite(value)) values.push_back(value);
  };
  for (const BoxRow& row : panel.rows) {
    if (row.box) std::for_each(row.box->begin(), row.box->end(), add);
    if (row.centre) add(*row.centre);
    if (row.spread) {
      add(row.spread->low);
      add(row.spread->high);
    }
  }
  return values;
}

// 1, 2, 5, 10, … about low and high.
std::vector<double> logarithmic_ticks(double low, double high) {
  const bool decades = high / low > 500.0;
  std::vector<double> ticks;
  for (int power = static_cast<int>(std::floor(std::log10(low))) - 1; power < 300; ++power)
    for (const double digit : {1.0, 2.0, 5.0}) {
      if (decades && digit != 1.0) continue;
      const double tick = digit * std::pow(10.0, power);
      if (tick <= low * (1.0 + 1e-9)) ticks.clear();
      ticks.push_back(tick);
      if (tick >= high) return ticks;
    }
  return ticks;
}

Scale scale_of(const BoxPanel& panel) {
  const std::vector<double> values = values_of(panel);
  if (values.empty()) return {};
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const double low = panel.low.value_or(*least), high = panel.high.value_or(*most);
  Scale scale;
  scale.logarithmic = low > 0.0 && high > kLogarithmicFrom * low;
  scale.ticks = scale.logarithmic ? logarithmic_ticks(low, high) : round_ticks(std::min(low, 0.0), high);
  return scale;
}

void add_rect(Html& html, std::string_view kind, double x, double y, double width, double height) {
  html.raw("<rect class=\"").text(kind).raw("\" x=\"").text(svg_px(x)).raw("\" y=\"").text(svg_px(y));
  html.raw("\" width=\"").text(svg_px(width)).raw("\" height=\"").text(svg_px(height)).raw("\"/>");
}

void add_span(Html& html, std::string_view kind, double from, double to, double y) {
  add_svg_line(html, kind, from, y, to, y);
  for (const double end : {from, to}) add_svg_line(html, kind, end, y - kEnd, end, y + kEnd);
}

void add_row(Html& html, const BoxRow& row, const Scale& scale, double y) {
  const std::string_view line = row.reported ? "reported" : "drawn";
  add_svg_text(html, "start", 8.0, y + kFoot, shortened(row.label, kLabelColumns));
  add_svg_text(html, "start", kWidth - kRight + 12.0, y + kFoot, row.beside);
  const auto finite = [](double value) { return std::isfinite(value); };
  if (row.box && std::all_of(row.box->begin(), row.box->end(), finite)) {
    const auto& box = *row.box;
    add_span(html, line, scale.at(box[0]), scale.at(box[4]), y);
    add_rect(html, "box", scale.at(box[1]), y - kBoxHalf, std::max(1.0, scale.at(box[3]) - scale.at(box[1])),
             2.0 * kBoxHalf);
    add_svg_line(html, "median", scale.at(box[2]), y - kBoxHalf, scale.at(box[2]), y + kBoxHalf);
  }
  if (row.spread && finite(row.spread->low) && finite(row.spread->high))
    add_span(html, line, scale.at(row.spread->low), scale.at(row.spread->high), y);
  if (row.centre && finite(*row.centre)) {
    if (row.reported || !row.box)
      add_rect(html, row.reported ? "square said" : "square", scale.at(*row.centre) - kMark, y - kMark, 2.0 * kMark,
               2.0 * kMark);
    else
      html.raw("<circle class=\"mean\" cx=\"")
          .text(svg_px(scale.at(*row.centre)))
          .raw("\" cy=\"")
          .text(svg_px(y))
          .raw("\" r=\"2.5\"/>");
  }
  html.raw("\n");
}

double height_of(const BoxPanel& panel) {
  return kTitle + kPitch * static_cast<double>(panel.rows.size()) + kAxis + kGap;
}

void add_panel(Html& html, const BoxPanel& panel, double top) {
  const Scale scale = scale_of(panel);
  const double first = top + kTitle, bottom = first + kPitch * static_cast<double>(panel.rows.size());
  html.raw("<g class=\"title\">");
  add_svg_text(html, "start", 0.0, top + 16.0, panel.title + (scale.logarithmic ? " (logarithmic axis)" : ""));
  html.raw("</g>\n");
  const double step = scale.ticks.size() < 2 ? 1.0 : scale.ticks[1] - scale.ticks[0];
  for (const double tick : scale.ticks) {
    add_svg_line(html, "grid", scale.at(tick), first, scale.at(tick), bottom);
    add_svg_text(html, "middle", scale.at(tick), bottom + 14.0,
                 scale.logarithmic ? tick_text(tick) : tick_text(tick, step));
  }
  html.raw("\n");
  for (std::size_t i = 0; i < panel.rows.size(); ++i)
    add_row(html, panel.rows[i], scale, first + kPitch * (static_cast<double>(i) + 0.5));
}

}  // namespace

Html box_chart(const BoxChart& chart) {
  Html html;
  if (chart.panels.empty()) return html;
  double height = kTop + kNote * static_cast<double>(chart.notes.size()) + kFoot;
  for (const BoxPanel& panel : chart.panels) height += height_of(panel);
  html.raw(
      "<svg class=\"boxes\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\" "
      "font-family=\"'DejaVu Sans', Verdana, sans-serif\" viewBox=\"0 0 ");
  html.text(svg_px(kWidth) + " " + svg_px(height)).raw("\"><title>").text(chart.said).raw("</title>\n");
  html.raw(
      "<style>text{fill:#333;font-size:11px}.title text{font-size:12.5px;font-weight:bold}"
      "line{stroke-width:1.4}.grid{stroke:#ddd;stroke-width:0.8}.drawn{stroke:#1a5fa8}.reported{stroke:#b3261e}"
      ".box{fill:#a9c8ea;stroke:#1a5fa8}.median{stroke:#0d3a6b;stroke-width:2}.mean{fill:#fff;stroke:#0d3a6b}"
      ".square{fill:#1a5fa8}.said{fill:#b3261e}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n");
  double y = kTop;
  for (const BoxPanel& panel : chart.panels) {
    add_panel(html, panel, y);
    y += height_of(panel);
  }
  for (const std::string& note : chart.notes) {
    add_svg_text(html, "start", 0.0, y + 11.0, note);
    html.raw("\n");
    y += kNote;
  }
  return html.raw("</svg>\n");
}

}  // namespace seldinger::reports
