// How a metric is called and written for people.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "casedb/attempts/attempts.h"

namespace seldinger::reports {

// The registry's label, e.g. "Distance to target centre"; an id it does not know gives its own words.
std::string metric_label(std::string_view id);

// The table it stands in, e.g. "Picture"; "Other" when not known.
std::string metric_group(std::string_view id);
// The groups in the order they are shown.
const std::vector<std::string>& metric_groups();

const casedb::MetricValue* find_metric(const std::vector<casedb::MetricValue>& metrics, std::string_view id);

// "1.3 mm", "42 %", "Yes". Null or not finite gives an em dash: never 0.
std::string value_text(const casedb::MetricValue& metric);
// Why there is no value, in words; empty when there is one.
std::string reason_text(const casedb::MetricValue& metric);

// Fixed digits with a true minus sign, and no minus before a rounded zero.
std::string number_text(double value, int digits);
std::string words_from_code(std::string_view code);  // "out_of_plane": "out of plane"

// A time within an attempt: "0:41".
std::string clock_text(double t_s);

// "2026-03-01 14:05 UTC" and "2026-03-01T14:05:09Z".
std::string utc_text(std::int64_t time_us);
std::string utc_machine_text(std::int64_t time_us);
// The same of a time that may have been cut to its day for the reader: "2026-03-01" of one that was.
std::string told_text(std::int64_t time_us);
std::string told_machine_text(std::int64_t time_us);

}  // namespace seldinger::reports
