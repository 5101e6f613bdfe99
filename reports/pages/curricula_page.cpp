#include "reports/pages/curricula_page.h"

#include <algorithm>

#include "reports/words/dependability_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::Proficiency;

// `limits`: how many attempts are allowed, of items that are nobody's.
void add_item(Html& html, std::size_t number, const casedb::CurriculumItem& item, const casedb::ItemState& state,
              bool limits) {
  html.raw("<tr><th scope=\"row\">").text(std::to_string(number)).raw(". ").name(state.title);
  const std::string gates = gates_text(item.gates);
  if (!gates.empty()) html.raw(" <span class=\"why\">").text(gates).raw("</span>");
  html.raw("</th><td class=\"number\" data-label=\"Version\">")
      .text(state.case_id.empty() ? "none published" : std::to_string(state.version));
  if (limits)
    html.raw("</td><td class=\"number\" data-label=\"Attempts allowed\">")
        .text(state.progress.attempts_left ? std::to_string(*state.progress.attempts_left) : "no limit");
  html.raw("</td></tr>\n");
}

void add_curriculum(Html& html, const CurriculumView& view, bool limits) {
  html.raw("<section>\n<table class=\"list\">\n<caption><strong>").name(view.curriculum.title).raw("</strong>");
  if (view.curriculum.state != casedb::CurriculumState::published)
    html.raw(" <span class=\"mark\">").text(casedb::name_of(view.curriculum.state)).raw("</span>");
  html.raw("</caption>\n<thead><tr><th scope=\"col\">Case</th><th scope=\"col\" class=\"number\">Version</th>");
  if (limits) html.raw("<th scope=\"col\" class=\"number\">Attempts allowed</th>");
  html.raw("</tr></thead>\n<tbody>\n");
  for (std::size_t i = 0; i < view.items.size(); ++i)
    add_item(html, i + 1, view.curriculum.items[i], view.items[i], limits);
  html.raw("</tbody>\n</table>\n</section>\n");
}

}  // namespace

std::string proficiency_text(Proficiency reached) {
  switch (reached) {
    case Proficiency::not_started:
      return "Not started";
    case Proficiency::practising:
      return "Practising";
    case Proficiency::passed:
      return "Passed, not yet proficient";
    case Proficiency::proficient:
      return "Proficient";
  }
  return "";
}

std::string gates_text(const std::vector<assessment::Gate>& gates) {
  std::string text;
  for (const assessment::Gate& gate : gates)
    text += (text.empty() ? "after " : " and ") + std::to_string(gate.after + 1) + " is " +
            std::string(assessment::name_of(gate.reached));
  return text;
}

std::string curricula_page(const Visitor& visitor, std::span<const CurriculumView> curricula,
                           const assessment::statistics::Answer& dependability) {
  Html html;
  html.raw("<h1>Curriculum</h1>\n");
  const bool learns = visitor.role == "trainee";  // of whom what is left stands with their progress
  html.raw("<p class=\"sub\">Proficient means two passes in a row. What was reached is kept.");
  if (learns) html.raw(" How far you are, and what is due: <a href=\"/progress\">progress</a>.");
  html.raw("</p>\n");
  if (curricula.empty())
    html.raw(
        "<div class=\"message\"><p>There is no curriculum here yet. A mentor makes one with <code>seldinger "
        "curriculum add</code>, a director publishes it.</p></div>\n");
  for (const CurriculumView& one : curricula) add_curriculum(html, one, !learns);
  if (!curricula.empty())
    html.raw("<p class=\"note\">")
        .text(kWhatPassingShows)
        .raw(": ")
        .text(dependability_text(dependability, casedb::Learners::people))
        .raw("</p>\n");
  return page("Curriculum", visitor, html);
}

}  // namespace seldinger::reports
