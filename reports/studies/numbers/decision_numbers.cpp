#include "reports/studies/numbers/decision_numbers.h"

#include "assessment/statistics/complete_table.h"
#include "assessment/statistics/reliability/icc.h"
#include "assessment/statistics/standards/classification.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;
namespace statistics = assessment::statistics;

constexpr std::size_t kIcc2 = 1;  // of kIccForms: agreement of single attempts

}  // namespace

statistics::Answer agreement_of(const study::Compared& one) {
  statistics::DataTable table;
  table.values = {{"before", {}}, {"last", {}}};
  for (const study::PersonValue& person : one.people) {
    if (person.values.size() < 2) continue;
    table.values[0].values.push_back(person.values[person.values.size() - 2]);
    table.values[1].values.push_back(person.values.back());
    ++table.rows;
  }
  return statistics::icc(statistics::complete_table(table), kIcc2);
}

std::optional<PassMark> pass_mark_of(const CaseMarks& marks, const study::Outcome& outcome) {
  if (const auto cuts = marks.cuts.find(outcome.case_id); cuts != marks.cuts.end())
    if (const casedb::Cut* cut = casedb::cut_in_force(cuts->second, outcome.metric);
        cut != nullptr && cut->version == outcome.version)
      return PassMark{cut->value, cut->higher_is_better, "the frozen cut (" + cut->words + ")"};
  const auto rule = marks.rules.find(outcome.case_id);
  if (rule == marks.rules.end()) return std::nullopt;
  for (const assessment::Criterion& one : rule->second.criteria)
    if (one.metric == outcome.metric && one.version == outcome.version &&
        one.comparison != assessment::Comparison::equal)
      return PassMark{one.value, one.comparison == assessment::Comparison::at_least, "the case’s rule"};
  return std::nullopt;
}

bool is_at_mark(const study::PersonValue& person, const PassMark& mark) {
  return person.standing == study::Standing::value &&
         (mark.higher_is_better ? person.value >= mark.cut : person.value <= mark.cut);
}

AtMark at_mark(const study::Compared& one, const std::string& group, const PassMark& mark) {
  AtMark found;
  for (const study::PersonValue& person : one.people) {
    if (person.group != group || person.standing == study::Standing::absent) continue;
    ++found.n;
    found.passed += is_at_mark(person, mark) ? 1 : 0;
  }
  return found;
}

statistics::Answer decisions_of(const study::Compared& one, const PassMark& mark,
                                const statistics::Answer& agreement) {
  statistics::CutScores scores;
  for (const study::PersonValue& person : one.people)
    if (person.standing == study::Standing::value) scores.scores.push_back(person.value);
  scores.cut = mark.cut;
  scores.reliability = agreement.estimate.value_or(0.0);
  scores.higher_is_better = mark.higher_is_better;
  return statistics::classification(scores);
}

}  // namespace seldinger::reports
