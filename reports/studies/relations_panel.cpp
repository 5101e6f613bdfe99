// Relations to other variables: outcomes beside what raters saw and the experience that people stated.
#include "reports/studies/numbers/relations.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

namespace statistics = assessment::statistics;

std::string estimate_words(double estimate, const std::optional<statistics::Interval>& interval) {
  std::string words = number_text(estimate, 2);
  if (interval) words += " [" + number_text(interval->low, 2) + " to " + number_text(interval->high, 2) + "]";
  return words;
}

void add_reliability(Html& html, const Reliability& reliability) {
  html.raw("<td>").text(reliability.value ? number_text(*reliability.value, 2) : "–").raw("</td>");
}

void add_relation(Html& rows, const assessment::study::Compared& one, const Other& other) {
  const Reliability of_outcome = value_reliability(one);
  const Related found = related(one, other, of_outcome);
  const bool lower = one.outcome.better == assessment::Direction::lower_is_better;
  rows.raw("<tr><th scope=\"row\">").text(one.outcome.name + (one.hand.empty() ? "" : ", hand: " + one.hand));
  rows.raw("<span class=\"why\">")
      .text(lower ? "lower is better: a ρ below 0 speaks for it" : "higher is better: a ρ above 0 speaks for it");
  rows.raw("</span></th><td>").text(other.name).raw(" <span class=\"why\">").text(other.detail);
  rows.raw("</span></td><td>").text(std::to_string(found.raw.n)).raw("</td><td>");
  rows.text(found.raw.estimate ? estimate_words(*found.raw.estimate, found.raw.ci95)
                               : "not estimated: too few, or all alike");
  rows.raw("</td>");
  add_reliability(rows, of_outcome);
  add_reliability(rows, other.reliability);
  rows.raw("<td>");
  if (found.corrected)
    rows.text(estimate_words(*found.corrected, found.corrected_ci95));
  else
    rows.text("not estimated: " + (found.why_not_corrected.empty() ? "there is no ρ" : found.why_not_corrected));
  rows.raw("</td></tr>\n");
}

}  // namespace

Html relations_panel(const ValidityReport& report) {
  constexpr std::string_view kSource = "Relations to other variables",
                             kTitle = "What raters saw, and what experience people stated";
  const std::vector<Other> experience = stated_experience(report.backgrounds);
  Html rows;
  for (const assessment::study::Compared& one : report.result.primary) {
    for (const casedb::RatedPeople& rated : report.ratings)
      if (rated.case_id == one.outcome.case_id) add_relation(rows, one, mean_rating(rated));
    for (const Other& other : experience) add_relation(rows, one, other);
  }
  if (rows.empty())
    return no_evidence_yet(kSource, kTitle,
                           "No rated replay shows a primary outcome’s case, and nobody stated their experience.");
  Html html = evidence_panel(kSource, kTitle);
  html.raw(
      "<table><thead><tr><th scope=\"col\">Outcome</th><th scope=\"col\">Beside</th><th scope=\"col\">Persons</th>"
      "<th scope=\"col\">Spearman’s ρ</th><th scope=\"col\">Reliability of the outcome</th><th scope=\"col\">of "
      "the "
      "other</th><th scope=\"col\">ρ corrected for both</th></tr></thead><tbody>\n");
  return html.add(rows).raw(
      "</tbody></table>\n<p class=\"note\">95 % intervals in brackets. Those who failed have no value and are not "
      "among the persons. The mean rating is of all rated replays of a person at the case, whatever the visit, by "
      "raters who did not know whose it was. Reliability of an outcome: ranks of two halves of each person’s "
      "attempts, stepped up (Spearman and Brown 1910), a half being the mean of its attempts with a value; a "
      "person with one attempt is in ρ alone, so it may be corrected too little. Reliability of ratings: ICC of a "
      "replay’s mean. Corrected: ρ over the root of both (Spearman 1904), as if both were known exactly, so that "
      "its interval is too narrow; beyond 1 it is so by chance, or because a reliability is too "
      "low.</p>\n</article>\n");
}

}  // namespace seldinger::reports
