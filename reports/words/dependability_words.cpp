#include "reports/words/dependability_words.h"

#include "assessment/statistics/reasons.h"
#include "casedb/grading/dependability.h"
#include "casedb/people/cohorts.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::optional<double> further_of(const assessment::statistics::Answer& answer, std::string_view name) {
  for (const assessment::statistics::Named& one : answer.more)
    if (one.name == name) return one.value;
  return std::nullopt;
}

std::string cases_text(double cases) {
  return number_text(cases, 0) + (cases == 1.0 ? " case" : " cases");
}

}  // namespace

bool withheld(const assessment::statistics::Answer& dependability, casedb::Learners whose) {
  return whose == casedb::Learners::people && dependability.estimable() &&
         dependability.n < static_cast<std::size_t>(casedb::kSmallestCell);
}

std::string dependability_text(const assessment::statistics::Answer& of, casedb::Learners whose) {
  if (!of.estimable())
    return "Φ is not estimated: " + std::string(assessment::statistics::find_reason(of.reason.c_str())->words) +
           ". It takes two persons or more with graded attempts at two cases or more in common.";
  if (withheld(of, whose)) return "Φ is withheld: it comes from fewer than five people.";
  const double cases = further_of(of, "cases").value_or(0.0);
  const auto needed = further_of(of, "cases_for_phi");
  std::string text = "One case alone decides about a person with a dependability Φ of " +
                     number_text(further_of(of, "phi_one_case").value_or(0.0), 2) + ", " + number_text(cases, 0) +
                     " cases together with " + number_text(of.estimate.value_or(0.0), 2);
  if (of.ci95)
    text += " (95 % interval " + number_text(of.ci95->low, 2) + " to " + number_text(of.ci95->high, 2) + ")";
  text += "; " + std::to_string(of.n) + " persons";
  const auto occasions = further_of(of, "occasions");
  if (occasions) text += ", each case on " + number_text(*occasions, 0) + " occasions";
  text += ". For " + number_text(casedb::kDependable, 1) + " it takes ";
  return text +
         (needed ? cases_text(*needed) + "." : "more than any number of cases: the persons do not differ enough.");
}

std::string dependability_line(const assessment::statistics::Answer& of, casedb::Learners whose) {
  if (!of.estimable()) return "How well passing one case tells people apart (Φ) is not known yet.";
  if (withheld(of, whose))
    return "How well passing one case tells people apart (Φ) is withheld: it comes from fewer than five people.";
  const auto needed = further_of(of, "cases_for_phi");
  return "Passing one case decides about a person with a dependability Φ of " +
         number_text(further_of(of, "phi_one_case").value_or(0.0), 2) + "; " + number_text(casedb::kDependable, 1) +
         " takes " + (needed ? cases_text(*needed) : "more than any number of cases") + ".";
}

}  // namespace seldinger::reports
