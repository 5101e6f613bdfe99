#include "reports/words/condition_words.h"

#include <string_view>

#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::string_view words_of(cases::HandKind hand) {
  switch (hand) {
    case cases::HandKind::mouse:
      return "mouse";
    case cases::HandKind::gamepad:
      return "gamepad";
    case cases::HandKind::space_mouse:
      return "3-D mouse";
    case cases::HandKind::arm:
      return "arm with force feedback";
    case cases::HandKind::simulated:
      return "simulated hands";
  }
  return "";
}

std::string hands_text(const casedb::Conditions& conditions) {
  const auto &needle = conditions.needle_hand, &probe = conditions.probe_hand;
  if (!needle && !probe) return "";
  if (needle == cases::HandKind::simulated) return "simulated hands";
  std::string text;
  if (needle && needle == probe) {
    text = std::string(words_of(*needle)) + " for needle and probe";
  } else {
    if (needle) text = std::string(words_of(*needle)) + " for the needle";
    if (probe) text += (text.empty() ? "" : ", ") + std::string(words_of(*probe)) + " for the probe";
  }
  const int changes = conditions.hand_changes.value_or(0);
  if (changes > 0) text += ", changed " + (changes == 1 ? std::string("once") : std::to_string(changes) + " times");
  return text;
}

std::string guide_text(const casedb::Conditions& conditions) {
  if (!conditions.guide_used) return "";
  if (!*conditions.guide_used) return "no needle guide";
  const double percent = 100.0 * conditions.guide_share.value_or(0.0);
  return "needle guide for " + (percent < 1.0 ? "under 1" : number_text(percent, 0)) + " % of the time";
}

std::string pauses_text(const casedb::Conditions& conditions) {
  if (!conditions.pauses) return "";
  if (*conditions.pauses == 0) return "no pause";
  return std::to_string(*conditions.pauses) + (*conditions.pauses == 1 ? " pause, " : " pauses, ") +
         number_text(conditions.paused_s.value_or(0.0), 0) + " s";
}

}  // namespace

std::string conditions_text(const casedb::Conditions& conditions, std::optional<double> away_s) {
  std::string text;
  const auto add = [&](const std::string& more) {
    if (!more.empty()) text += (text.empty() ? "" : "; ") + more;
  };
  add(hands_text(conditions));
  add(guide_text(conditions));
  if (conditions.help_level.value_or(0) > 0) add("help in the room");
  add(pauses_text(conditions));
  if (away_s) add("interrupted for " + number_text(*away_s, 0) + " s");
  if (conditions.speckle_fallback.value_or(false)) add("simplified speckle");
  return text;
}

std::string condition_text(const casedb::ConditionRow& row, const casedb::Conditions& conditions) {
  const casedb::ConditionValue value = row.read(conditions);
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "yes" : "no";
  if (const std::string* words = std::get_if<std::string>(&value)) {
    if (const auto hand = base::from_name(cases::kHandKindNames, *words)) return std::string(words_of(*hand));
    return *words;
  }
  const double* number = std::get_if<double>(&value);
  if (number == nullptr) return "not known";
  const std::string_view unit = row.unit;
  if (unit == "share") return number_text(100.0 * *number, 0) + " %";
  const std::string text = number_text(*number, row.kind == casedb::ConditionKind::whole ? 0 : 1);
  return unit.empty() || unit == "count" ? text : text + " " + std::string(unit);
}

}  // namespace seldinger::reports
