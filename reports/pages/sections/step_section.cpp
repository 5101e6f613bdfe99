#include "reports/pages/sections/step_section.h"

#include <string>

#include "assessment/grading/reason_words.h"
#include "reports/pages/sections/metric_details.h"
#include "reports/words/metric_words.h"
#include "reports/words/step_card.h"

namespace seldinger::reports {
namespace {

using assessment::StepResult;
using assessment::StepState;

const char* class_of(StepState state) {
  return state == StepState::done ? "yes" : state == StepState::violated ? "no" : "left-out";
}

void add_row(Html& html, const StepResult& step) {
  const StepMark& mark = step_mark(step);
  html.raw("<tr><th scope=\"row\">").add(step_details(step.id, step.version)).raw("</th><td class=\"number\">");
  if (step.t_s)
    html.raw("<span data-at-s=\"")
        .text(number_text(*step.t_s, 1))
        .raw("\">")
        .text(number_text(*step.t_s, 1))
        .raw(" s</span>");
  else
    html.raw("–");
  html.raw("</td><td><span class=\"")
      .text(class_of(step.state))
      .raw("\">")
      .text(std::string(mark.sign) + " " + mark.words);
  html.raw("</span></td></tr>\n");
}

void add_legend(Html& html, std::span<const StepResult> steps) {
  html.raw("<dl class=\"legend\">\n");
  for (const StepMark* mark : step_legend(steps)) {
    html.raw("<div><dt>").text(std::string(mark->sign) + " " + mark->words).raw("</dt><dd>");
    html.text(mark->meaning).raw("</dd></div>\n");
  }
  html.raw("</dl>\n");
}

}  // namespace

Html step_details(std::string_view id, int version, std::string_view words) {
  const std::string label = words.empty() ? step_label(id) : std::string(words);
  if (assessment::find_step(id) == nullptr) return Html{}.text(label);
  return card_details(step_card(id, version), label);
}

Html step_section(std::span<const StepResult> steps) {
  Html html, asked, not_asked;
  for (const StepResult& step : steps) {
    if (step.state != StepState::not_asked) {
      add_row(asked, step);
      continue;
    }
    not_asked.raw("<dt>").add(step_details(step.id, step.version)).raw("</dt><dd>");
    not_asked.text(assessment::reason_words(step.reason)).raw("</dd>\n");
  }
  html.raw("<section class=\"steps\" aria-labelledby=\"steps\">\n<h2 id=\"steps\">Steps</h2>\n");
  if (steps.empty())
    html.raw("<p class=\"note\">No steps are stored with this attempt.</p>\n");
  else
    html.raw("<p class=\"note\">Click a name to see what the step is and how it is recognised.</p>\n");
  if (!asked.empty()) {
    add_legend(html, steps);
    html.raw(
        "<table>\n<caption>Steps asked for</caption>\n<thead><tr><th scope=\"col\">Step</th><th scope=\"col\" "
        "class=\"number\">When</th><th scope=\"col\">Result</th></tr></thead>\n<tbody>\n");
    html.add(asked).raw("</tbody>\n</table>\n");
  }
  if (!not_asked.empty())
    html.raw("<details><summary>Steps not asked for</summary>\n<dl class=\"definitions\">\n")
        .add(not_asked)
        .raw("</dl>\n</details>\n");
  return html.raw("</section>\n");
}

}  // namespace seldinger::reports
