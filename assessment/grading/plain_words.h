// Numbers with their units, as a sentence says them: few digits, a true minus sign, "once" and "twice".
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace seldinger::assessment {

// "14 mm", "2.5 mm", "80 %" of a share, "7.5 a second", "1"; a true or false has no such text.
std::string plain_value(double value, std::string_view unit);

// Both, with as many digits as it takes to tell them apart when they are not the same ("5.04 mm", "5 mm").
std::pair<std::string, std::string> plain_apart(double value, double other, std::string_view unit);

// "0–3 mm", "−2 to 3 mm"; one value where both read the same.
std::string plain_range(double low, double high, std::string_view unit);
// The two numbers that it says: what draws a range tells no more of it than what writes it.
std::pair<double, double> said_range(double low, double high, std::string_view unit);

std::string plain_times(double count);  // "once", "twice", "3 times"

// "not_in_tissue" as "not in tissue".
std::string plain_code(std::string_view code);

}  // namespace seldinger::assessment
