// Consequences: whether passing goes with what may not matter.
#include "reports/studies/numbers/subgroups.h"
#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

std::string percent_words(const assessment::statistics::Interval& share) {
  return number_text(100.0 * share.low, 0) + " to " + number_text(100.0 * share.high, 0);
}

std::string difference_words(const Subgroup& one, const Subgroup& largest) {
  if (!one.difference) return "the largest; others are compared with it";
  const auto share = [](const Subgroup& of) {
    return 100.0 * static_cast<double>(of.passes()) / static_cast<double>(of.n());
  };
  return number_text(share(one) - share(largest), 0) + " points [" + percent_words(*one.difference) + "]" +
         (one.descriptive ? "; descriptive" : "");
}

void add_parting(Html& rows, const assessment::study::Compared& one, const Subgroups& parted) {
  for (const Subgroup& group : parted.groups) {
    rows.raw("<tr><th scope=\"row\">").text(one.outcome.name + (one.hand.empty() ? "" : ", hand: " + one.hand));
    rows.raw("</th><td>").text(parted.by + ": " + group.name);
    if (!group.told) {
      rows.raw("</td><td colspan=\"2\">withheld</td></tr>\n");
      continue;
    }
    rows.raw("</td><td>")
        .text(of_text(static_cast<std::size_t>(group.passes()), static_cast<std::size_t>(group.n())));
    rows.raw(" <span class=\"why\">").text(percent_words(group.share) + " %").raw("</span></td><td>");
    rows.text(difference_words(group, parted.groups.front())).raw("</td></tr>\n");
  }
}

}  // namespace

Html subgroups_panel(const ValidityReport& report) {
  constexpr std::string_view kSource = "Consequences", kTitle = "Who passes, by hand, device and site";
  Html rows;
  for (const assessment::study::Compared& one : report.result.primary)
    if (const auto mark = pass_mark_of(report.marks, one.outcome))
      for (const Subgroups& parted : subgroups_of(one, *mark, report.backgrounds)) add_parting(rows, one, parted);
  if (rows.empty())
    return no_evidence_yet(
        kSource, kTitle, "No primary outcome has both a pass mark and people who differ in hand, device or site.");
  Html html = evidence_panel(kSource, kTitle);
  html.raw(
      "<table><thead><tr><th scope=\"col\">Outcome</th><th scope=\"col\">Persons</th><th scope=\"col\">At the pass "
      "mark</th><th scope=\"col\">Difference from the largest</th></tr></thead><tbody>\n");
  return html.add(rows).raw(
      "</tbody></table>\n<p class=\"note\">Both groups together; 95 % intervals in brackets and grey (Wilson, "
      "Newcombe). Descriptive: fewer than 5 passed or failed on one side, which says something about these persons "
      "and nothing about others. Withheld: fewer than 5 persons, or what would reveal so few. Nobody was assigned "
      "to these subgroups by chance: a difference may come from anything that goes with them.</p>\n</article>\n");
}

}  // namespace seldinger::reports
