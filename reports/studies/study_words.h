// Numbers and verdicts of a study in words.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "assessment/study/analysis.h"

namespace seldinger::reports {

// Three significant digits without needless zeros and a true minus sign: "0.0281", "−12.4", "1.2 × 10⁻⁷".
std::string digits_text(double value);
std::string p_text(const std::optional<double>& p);  // "0.031", "< 0.001", "–"
std::string interval_text(const std::optional<assessment::statistics::Interval>& interval);
// "12 of 14"
std::string of_text(std::size_t some, std::size_t all);
// The number by that name among an answer's further ones.
std::optional<double> further(const assessment::statistics::Answer& answer, std::string_view beginning);

// What a primary outcome lets conclude, in one sentence; by the adjusted p.
std::string verdict_text(const assessment::study::Compared& one, double alpha);
// What a comparison of that size would have found.
std::string detectable_text(const assessment::study::Compared& one);
std::string test_text(assessment::study::Test test);
// "median 4.2 (3.1 to 6.0), 1 failed, 2 absent"
std::string group_text(const assessment::study::GroupSum& sum, std::string_view unit);

}  // namespace seldinger::reports
