#include "reports/pages/curricula_page.h"

#include <algorithm>

#include "reports/words/dependability_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::Proficiency;

void add_state(Html& html, const casedb::ItemState& state) {
  if (state.progress.reached >= Proficiency::passed) {
    html.raw("<span class=\"yes\">");
  } else {
    html.raw("<span>");
  }
  html.text(proficiency_text(state.progress.reached)).raw("</span>");
  if (state.progress.due) html.raw(" <span class=\"mark due\">due</span>");
  if (!state.progress.open) html.raw(" <span class=\"why\">not open yet</span>");
  if (state.case_id.empty()) html.raw(" <span class=\"why\">no version is published now</span>");
  if (state.progress.attempts_left == 0 && state.progress.reached < Proficiency::proficient)
    html.raw(" <span class=\"why\">no attempts left: ask your mentor</span>");
}

void add_item(Html& html, std::size_t number, const casedb::CurriculumItem& item, const casedb::ItemState& state,
              bool own) {
  html.raw("<tr><th scope=\"row\">").text(std::to_string(number)).raw(". ").name(state.title);
  const std::string gates = gates_text(item.gates);
  if (!gates.empty()) html.raw(" <span class=\"why\">").text(gates).raw("</span>");
  html.raw("</th>");
  if (own) {
    html.raw("<td data-label=\"State\">");
    add_state(html, state);
    html.raw("</td><td class=\"number\" data-label=\"Passes\">")
        .text(std::to_string(state.passes) + " of " + std::to_string(state.attempts))
        .raw("</td><td class=\"number\" data-label=\"Attempts left\">")
        .text(state.progress.attempts_left ? std::to_string(*state.progress.attempts_left) : "no limit");
  } else {
    html.raw("<td class=\"number\" data-label=\"Version\">")
        .text(state.case_id.empty() ? "none published" : std::to_string(state.version))
        .raw("</td><td class=\"number\" data-label=\"Attempts allowed\">")
        .text(state.progress.attempts_left ? std::to_string(*state.progress.attempts_left) : "no limit");
  }
  html.raw("</td></tr>\n");
}

void add_curriculum(Html& html, const CurriculumView& view) {
  html.raw("<section>\n<table class=\"list\">\n<caption><strong>").name(view.curriculum.title).raw("</strong>");
  if (view.curriculum.state != casedb::CurriculumState::published)
    html.raw(" <span class=\"mark\">").text(casedb::name_of(view.curriculum.state)).raw("</span>");
  html.raw("</caption>\n<thead><tr><th scope=\"col\">Case</th>");
  if (view.own) {
    html.raw(
        "<th scope=\"col\">State</th><th scope=\"col\" class=\"number\">Passes</th>"
        "<th scope=\"col\" class=\"number\">Attempts left</th>");
  } else {
    html.raw(
        "<th scope=\"col\" class=\"number\">Version</th>"
        "<th scope=\"col\" class=\"number\">Attempts allowed</th>");
  }
  html.raw("</tr></thead>\n<tbody>\n");
  for (std::size_t i = 0; i < view.items.size(); ++i)
    add_item(html, i + 1, view.curriculum.items[i], view.items[i], view.own);
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
  const bool own = std::any_of(curricula.begin(), curricula.end(), [](const auto& one) { return one.own; });
  if (own)
    html.raw(
        "<p class=\"sub\">Proficient is two passes running. What was reached stays. The case that is due comes "
        "next.</p>\n");
  if (curricula.empty())
    html.raw(
        "<div class=\"message\"><p>There is no curriculum here yet. A mentor makes one with <code>seldinger "
        "curriculum add</code>, a director publishes it.</p></div>\n");
  for (const CurriculumView& one : curricula) add_curriculum(html, one);
  if (!curricula.empty())
    html.raw("<p class=\"note\">What passing tells: ")
        .text(dependability_text(dependability, casedb::Learners::people))
        .raw("</p>\n");
  return page("Curriculum", visitor, html);
}

}  // namespace seldinger::reports
