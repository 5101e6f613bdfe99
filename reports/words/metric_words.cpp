#include "reports/words/metric_words.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "assessment/grading/reason_words.h"
#include "assessment/registry.h"

namespace seldinger::reports {
namespace {

constexpr std::string_view kNone = "—";   // em dash
constexpr std::string_view kMinus = "−";  // U+2212

constexpr std::string_view kOther = "Other";

constexpr std::string_view words_of(assessment::Group group) {
  switch (group) {
    case assessment::Group::target:
      return "Target";
    case assessment::Group::safety:
      return "Safety";
    case assessment::Group::procedure:
      return "Procedure";
    case assessment::Group::picture:
      return "Picture";
    case assessment::Group::path:
      return "Path";
    case assessment::Group::time:
      return "Time";
    case assessment::Group::dose:
      return "Dose";
    case assessment::Group::recording:
      return "Recording";
  }
  return kOther;
}

bool is_yes_or_no(const casedb::MetricValue& metric) {
  return metric.unit == "bool" || metric.id == "hit" || metric.id == "first_pass_success";
}

}  // namespace

std::string words_from_code(std::string_view code) {
  std::string words(code);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

std::string metric_label(std::string_view id) {
  const assessment::MetricInfo* info = assessment::find_metric(std::string(id));
  return info != nullptr ? std::string(info->label) : words_from_code(id);
}

std::string metric_group(std::string_view id) {
  const assessment::MetricInfo* info = assessment::find_metric(std::string(id));
  return std::string(info != nullptr ? words_of(info->group) : kOther);
}

const std::vector<std::string>& metric_groups() {
  static const std::vector<std::string> groups = [] {
    std::vector<std::string> list;
    for (int group = 0; group <= static_cast<int>(assessment::Group::recording); ++group)
      list.emplace_back(words_of(static_cast<assessment::Group>(group)));
    list.emplace_back(kOther);
    return list;
  }();
  return groups;
}

const casedb::MetricValue* find_metric(const std::vector<casedb::MetricValue>& metrics, std::string_view id) {
  const auto found =
      std::find_if(metrics.begin(), metrics.end(), [&](const casedb::MetricValue& m) { return m.id == id; });
  return found == metrics.end() ? nullptr : &*found;
}

std::string number_text(double value, int digits) {
  std::array<char, 400> buffer{};  // the widest double has 309 digits before the point
  std::snprintf(buffer.data(), buffer.size(), "%.*f", digits, std::fabs(value));
  std::string text = buffer.data();
  const bool is_zero = text.find_first_not_of("0.") == std::string::npos;
  return value < 0.0 && !is_zero ? std::string(kMinus) + text : text;
}

std::string value_text(const casedb::MetricValue& metric) {
  if (!metric.value.has_value() || !std::isfinite(*metric.value)) return std::string(kNone);
  const double value = *metric.value;
  const std::string& unit = metric.unit;
  if (is_yes_or_no(metric)) return value != 0.0 ? "Yes" : "No";
  if (unit == "count" || unit == "1" || unit.empty()) {
    return number_text(value, value == std::floor(value) ? 0 : 3);
  }
  if (unit == "share") return number_text(100.0 * value, 0) + " %";
  if (unit == "%") return number_text(value, 0) + " %";
  if (unit == "mm²") return number_text(value, 0) + " mm²";
  if (unit == "deg") return number_text(value, 1) + "°";
  if (unit == "Gy·cm²") return number_text(value, 3) + " Gy·cm²";
  if (unit == "N") return number_text(value, 2) + " N";
  return number_text(value, 1) + " " + unit;
}

std::string reason_text(const casedb::MetricValue& metric) {
  if (metric.value.has_value()) return std::isfinite(*metric.value) ? "" : "the stored number is not finite";
  return metric.reason.empty() ? "no reason was stored" : assessment::reason_words(metric.reason);
}

namespace {
struct Utc {
  std::chrono::year_month_day date;
  std::chrono::hh_mm_ss<std::chrono::seconds> time;
};
Utc utc_from(std::int64_t time_us) {
  using namespace std::chrono;
  const sys_seconds seconds_since = floor<seconds>(sys_time<microseconds>(microseconds(time_us)));
  const sys_days day = floor<days>(seconds_since);
  return {year_month_day(day), hh_mm_ss<seconds>(seconds_since - day)};
}
std::string utc_written(std::int64_t time_us, const char* format) {
  const Utc utc = utc_from(time_us);
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, static_cast<int>(utc.date.year()),
                static_cast<unsigned>(utc.date.month()), static_cast<unsigned>(utc.date.day()),
                static_cast<int>(utc.time.hours().count()), static_cast<int>(utc.time.minutes().count()),
                static_cast<int>(utc.time.seconds().count()));
  return buffer.data();
}
constexpr const char* kDay = "%04d-%02u-%02u";
bool is_whole_day(std::int64_t time_us) {
  return time_us % 86'400'000'000 == 0;
}
}  // namespace

std::string clock_text(double t_s) {
  const auto whole_s = static_cast<long>(std::max(0.0, t_s));
  char text[32];
  std::snprintf(text, sizeof text, "%ld:%02ld", whole_s / 60, whole_s % 60);
  return text;
}

std::string utc_text(std::int64_t time_us) {
  return utc_written(time_us, "%04d-%02u-%02u %02d:%02d UTC");
}
std::string utc_machine_text(std::int64_t time_us) {
  return utc_written(time_us, "%04d-%02u-%02uT%02d:%02d:%02dZ");
}
std::string told_text(std::int64_t time_us) {
  return is_whole_day(time_us) ? utc_written(time_us, kDay) : utc_text(time_us);
}
std::string told_machine_text(std::int64_t time_us) {
  return is_whole_day(time_us) ? utc_written(time_us, kDay) : utc_machine_text(time_us);
}

}  // namespace seldinger::reports
