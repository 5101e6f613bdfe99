#include "reports/metric_words.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace seldinger::reports {
namespace {

constexpr std::string_view kNone = "—";   // em dash
constexpr std::string_view kMinus = "−";  // U+2212

struct Words {
  std::string_view id, group, label;
};

// Groups in the order of what a trainee asks first.
constexpr std::array kWords = {
    Words{"hit", "Target", "Hit"},
    Words{"tip_target_dist", "Target", "Distance to the target’s centre"},
    Words{"tip_target_axial", "Target", "Distance along the needle"},
    Words{"tip_target_lateral", "Target", "Distance across the needle"},
    Words{"tip_target_surface", "Target", "Distance to the target’s surface (inside is negative)"},
    Words{"core_in_target", "Target", "Length of the core inside the target"},
    Words{"closest_approach", "Target", "Closest approach to the centre"},
    Words{"first_pass_success", "Target", "Hit on the first pass"},
    Words{"time_total", "Time", "Whole time"},
    Words{"time_in_tissue", "Time", "Time with the tip in tissue"},
    Words{"time_puncture_to_target", "Time", "Time from puncture to firing"},
    Words{"vis_joint", "Picture", "Tip and target visible together"},
    Words{"vis_tip", "Picture", "Tip visible"},
    Words{"vis_needle", "Picture", "Needle visible"},
    Words{"vis_target", "Picture", "Target visible"},
    Words{"blind_advance", "Picture", "Advanced without seeing the tip"},
    Words{"blind_advance_max", "Picture", "Longest advance without seeing the tip"},
    Words{"probe_drift_advancing", "Picture", "Probe movement while advancing"},
    Words{"plane_angle_mean", "Picture", "Mean angle between needle and picture"},
    Words{"plane_angle_max", "Picture", "Largest angle between needle and picture"},
    Words{"skin_punctures", "Needle path", "Skin punctures"},
    Words{"withdrawals_partial", "Needle path", "Partial withdrawals"},
    Words{"withdrawals_full", "Needle path", "Full withdrawals"},
    Words{"path_in_tissue", "Needle path", "Tip path in tissue"},
    Words{"path_tip", "Needle path", "Tip path"},
    Words{"path_inefficiency", "Needle path", "Detour over the straight way"},
    Words{"swept_area", "Needle path", "Area swept by the shaft in tissue"},
    Words{"entry_angle_error", "Needle path", "Error of the entry angle"},
    Words{"ldlj", "Needle path", "Smoothness (log dimensionless jerk)"},
    Words{"lateral_force_peak", "Force", "Peak sideways force (model)"},
    Words{"force_peak_axial", "Force", "Peak axial force (model)"},
    Words{"nogo_contacts", "No-go structures", "Contacts"},
    Words{"nogo_time", "No-go structures", "Time inside"},
    Words{"clearance_min", "No-go structures", "Smallest clearance"},
    Words{"gap_share", "Recording", "Share of missing samples"},
    Words{"sample_rate_p5", "Recording", "Sample rate, 5th percentile"},
};

const Words* words_of(std::string_view id) {
  const auto* found = std::find_if(kWords.begin(), kWords.end(), [&](const Words& w) { return w.id == id; });
  return found == kWords.end() ? nullptr : found;
}

std::string words_from_code(std::string_view code) {
  std::string words(code);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

bool is_yes_or_no(const casedb::MetricValue& metric) {
  return metric.unit == "bool" || metric.id == "hit" || metric.id == "first_pass_success";
}

}  // namespace

std::string metric_label(std::string_view id) {
  const Words* words = words_of(id);
  return words != nullptr ? std::string(words->label) : words_from_code(id);
}

std::string metric_group(std::string_view id) {
  const Words* words = words_of(id);
  return words != nullptr ? std::string(words->group) : "Other";
}

const std::vector<std::string>& metric_groups() {
  static const std::vector<std::string> groups = [] {
    std::vector<std::string> list;
    for (const Words& words : kWords) {
      if (list.empty() || list.back() != words.group) list.emplace_back(words.group);
    }
    list.emplace_back("Other");
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
  if (unit == "mm^2" || unit == "mm2") return number_text(value, 0) + " mm²";
  if (unit == "deg") return number_text(value, 1) + "°";
  if (unit == "N") return number_text(value, 2) + " N";
  return number_text(value, 1) + " " + unit;
}

std::string reason_text(const casedb::MetricValue& metric) {
  if (metric.value.has_value()) return std::isfinite(*metric.value) ? "" : "the stored number is not finite";
  return metric.reason.empty() ? "no reason was stored" : words_from_code(metric.reason);
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
}  // namespace

std::string utc_text(std::int64_t time_us) {
  return utc_written(time_us, "%04d-%02u-%02u %02d:%02d UTC");
}
std::string utc_machine_text(std::int64_t time_us) {
  return utc_written(time_us, "%04d-%02u-%02uT%02d:%02d:%02dZ");
}

}  // namespace seldinger::reports
