#include "assessment/grading/rule.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "assessment/registry.h"
#include "sim/base/names.h"

namespace seldinger::assessment {
namespace {

// "=" last: it ends the others too.
constexpr auto kSigns =
    base::names<Comparison>({{Comparison::at_most, "<="}, {Comparison::at_least, ">="}, {Comparison::equal, "="}});

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string number_text(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

bool has_rule(std::span<const cases::Structure> structures, cases::StructureRule rule) {
  return std::any_of(structures.begin(), structures.end(),
                     [&](const cases::Structure& one) { return one.rule == rule; });
}

bool can_have_a_value(const MetricInfo& info, const Guidance& guidance) {
  return applies(info.needs, guidance.manner) && (info.needs & guidance.absent) == 0;
}

}  // namespace

std::string_view sign_of(Comparison comparison) noexcept {
  return base::name_of(kSigns, comparison);
}

std::optional<Comparison> comparison_from(std::string_view sign) noexcept {
  return base::from_name(kSigns, sign);
}

int version_in_force(const std::string& metric, cases::SightLaw law) {
  const MetricInfo* info = find_metric(metric);
  return info == nullptr ? 1 : version_of(*info, law);
}

std::string text_of(const Criterion& criterion) {
  std::string text = criterion.metric;
  if (criterion.version != version_in_force(criterion.metric, cases::kNewestSightLaw))
    text.append("@").append(std::to_string(criterion.version));
  return text.append(" ").append(sign_of(criterion.comparison)).append(" ").append(number_text(criterion.value));
}

std::optional<Criterion> criterion_from(std::string_view text, cases::SightLaw law) {
  for (const std::string_view sign : base::kNamesOf<kSigns>) {
    const std::size_t at = text.find(sign);
    if (at == text.npos) continue;
    Criterion criterion;
    criterion.comparison = *comparison_from(sign);
    std::optional<int> version;
    std::string_view name = trimmed(text.substr(0, at));
    const std::string_view value = trimmed(text.substr(at + sign.size()));
    if (const std::size_t mark = name.find('@'); mark != name.npos) {
      const std::string_view number = name.substr(mark + 1);
      const auto read = std::from_chars(number.data(), number.data() + number.size(), version.emplace());
      if (read.ec != std::errc() || read.ptr != number.data() + number.size() || *version < 1) return std::nullopt;
      name = name.substr(0, mark);
    }
    const bool is_id = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
      return c == '_' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    });
    const auto read = std::from_chars(value.data(), value.data() + value.size(), criterion.value);
    if (!is_id || read.ec != std::errc() || read.ptr != value.data() + value.size() ||
        !std::isfinite(criterion.value))
      return std::nullopt;
    criterion.metric = name;
    criterion.version = version.value_or(version_in_force(criterion.metric, law));
    return criterion;
  }
  return std::nullopt;
}

Needs absent_needs(std::span<const cases::Structure> structures, bool planned_entry, cases::Subject subject) {
  using enum cases::StructureRule;
  Needs absent = planned_entry ? 0U : Needs{kPlan};
  const std::pair<cases::StructureRule, Needs> needs[] = {{critical, kNoGoCritical}, {major, kNoGoMajor},
                                                          {advisory, kNoGoAdvisory}, {must_cross, kMustCross},
                                                          {organ, kOrgan},           {target, kLumen}};
  for (const auto& [rule, need] : needs)
    if (!has_rule(structures, rule)) absent |= need;
  if (!has_rule(structures, critical) && !has_rule(structures, major) && !has_rule(structures, advisory))
    absent |= kNoGo;
  if (subject == cases::Subject::phantom) absent |= kPatient | kDecision | kBreathes;
  return absent;
}

std::vector<std::string> meaningful_metrics(const Guidance& guidance) {
  std::vector<std::string> ids;
  for (const MetricInfo& info : registry())
    if (can_have_a_value(info, guidance)) ids.emplace_back(info.id);
  return ids;
}

std::vector<base::Problem> problems_of(const PassRule& rule, const Guidance& guidance) {
  std::vector<base::Problem> problems;
  for (std::size_t i = 0; i < rule.criteria.size(); ++i) {
    const Criterion& one = rule.criteria[i];
    const MetricInfo* info = find_metric(one.metric);
    if (info == nullptr)
      problems.push_back({"unknown_metric", "there is no metric called " + one.metric});
    else if (const int version = version_of(*info, guidance.sight_law); version != one.version)
      problems.push_back({"other_version", one.metric + " is measured by version " + std::to_string(version) +
                                               ", not " + std::to_string(one.version) +
                                               ": name that one, and see whether the limit still fits"});
    else if (!can_have_a_value(*info, guidance))
      problems.push_back({"not_meaningful", one.metric + " has no value under the case's guidance, approach and "
                                                         "instrument, or needs a structure that it does not have"});
    if (!std::isfinite(one.value))
      problems.push_back({"not_finite", one.metric + " is not compared with a number"});
    for (std::size_t other = 0; other < i; ++other)
      if (rule.criteria[other].metric == one.metric && rule.criteria[other].comparison == one.comparison) {
        problems.push_back({"twice", one.metric + " is given twice"});
        break;
      }
  }
  return problems;
}

}  // namespace seldinger::assessment
