// What drawings are put together from: lines, words, and an axis of round numbers.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "reports/markup/html.h"

namespace seldinger::reports {

std::string svg_px(double value);  // "12.5", in the drawing's own units
// `kind` is a class of the style sheet.
void add_svg_line(Html& html, std::string_view kind, double x1, double y1, double x2, double y2);
// `anchor`: start, middle or end.
void add_svg_text(Html& html, std::string_view anchor, double x, double y, std::string_view text);

// At most so many letters of UTF-8; where some are cut off, "…" says so.
std::string shortened(const std::string& label, std::size_t columns);

// Round numbers, about 4 to 8 of them, that hold low to high: {0, 5, 10, 15, 20}.
std::vector<double> round_ticks(double low, double high, double least_step = 0.0);
std::string tick_text(double value);               // without needless digits, with a true minus sign
std::string tick_text(double value, double step);  // with the digits that tell it from the next tick

}  // namespace seldinger::reports
