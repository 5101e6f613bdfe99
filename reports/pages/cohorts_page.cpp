#include "reports/pages/cohorts_page.h"

#include "reports/words/people_words.h"

namespace seldinger::reports {
namespace {

// −1: withheld.
std::string count_text(int count) {
  return count < 0 ? "withheld" : std::to_string(count);
}

void add_row(Html& html, const CohortView& view) {
  const casedb::Cohort& cohort = view.cohort;
  const casedb::CohortCells& cells = view.cells;
  html.raw("<tr><th scope=\"row\">")
      .name(cohort.title)
      .raw("</th><td data-label=\"Programme\">")
      .name(cohort.programme);
  if (!cohort.site.empty()) html.raw(" <span class=\"why\">").name(cohort.site).raw("</span>");
  html.raw("</td><td data-label=\"Learners\">").text(count_text(cells.learners));
  for (std::size_t i = 0; i < view.learners.size(); ++i) html.raw(i == 0 ? ": " : ", ").name(view.learners[i]);
  html.text(and_simulated_text(cells.simulated));
  for (std::size_t i = 0; i < view.simulated.size(); ++i) html.raw(i == 0 ? ": " : ", ").name(view.simulated[i]);
  html.raw("</td><td class=\"number\" data-label=\"Attempts\">").text(count_text(cells.attempts));
  html.raw("</td><td class=\"number\" data-label=\"Hits\">");
  if (cells.hits < 0)
    html.text(count_text(cells.hits));
  else
    html.text(cells.with_hit == 0 ? "—" : std::to_string(cells.hits) + " of " + std::to_string(cells.with_hit));
  html.raw("</td></tr>\n");
}

}  // namespace

std::string cohorts_page(const Visitor& visitor, std::span<const CohortView> cohorts) {
  Html html;
  html.raw(
          "<h1>Cohorts</h1>\n<p class=\"sub\">The learners of your own cohorts are shown by name. Of other "
          "cohorts you see only counts, as they were at the end of the last week, and only once there are at "
          "least ")
      .text(std::to_string(casedb::kSmallestCell))
      .raw(" people behind them.</p>\n");
  if (cohorts.empty()) {
    html.raw(
        "<p>There is no cohort for you to see. Whoever runs this library adds one with <code>seldinger cohort "
        "add</code>.</p>\n");
    return page("Cohorts", visitor, html);
  }
  html.raw(
      "<div class=\"wide\">\n<table class=\"list\">\n<caption>Learners, what they did themselves in the cohort, "
      "and how "
      "often they hit; nothing simulated counts</caption>\n<thead><tr><th scope=\"col\">Cohort</th><th "
      "scope=\"col\">Programme</th><th scope=\"col\">Learners</th><th scope=\"col\" "
      "class=\"number\">Attempts</th><th "
      "scope=\"col\" class=\"number\">Hits</th></tr></thead>\n<tbody>\n");
  for (const CohortView& view : cohorts) add_row(html, view);
  html.raw("</tbody>\n</table>\n</div>\n");
  return list_page("Cohorts", visitor, html);
}

}  // namespace seldinger::reports
