#include <algorithm>
#include <set>

#include "reports/studies/study_words.h"
#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

constexpr std::string_view kQuestions[] = {
    "Do the numbers record what was done?", "Would other attempts, cases and days give the same?",
    "Do they say what the person does with patients?",
    "Are the decisions based on them justified?"};  // in the order of Inference

// What this study itself adds to a claim.
std::string added(const ValidityReport& report, study::Inference inference) {
  if (!report.plan.frozen()) return "nothing yet: the plan is a draft";
  if (inference != study::Inference::extrapolation) return "nothing: no comparison of groups bears on it alone";
  std::string text;
  for (const study::Compared& one : report.result.primary)
    text += (text.empty() ? "" : " ") + one.outcome.name + (one.hand.empty() ? "" : ", " + one.hand) + ": " +
            verdict_text(one, report.plan.plan.alpha);
  return text;
}

// What stands against it by the data alone.
std::vector<std::string> rebuttals_of_data(const ValidityReport& report, study::Inference inference) {
  std::vector<std::string> all;
  const study::Plan& plan = report.plan.plan;
  if (inference == study::Inference::scoring && plan.people == study::People::simulated)
    all.emplace_back("The attempts are of simulated operators: no hand moved.");
  if (!report.plan.frozen()) return all;
  std::size_t smallest = report.result.primary.empty() ? 0 : ~std::size_t{0};
  bool mouse = false;
  for (const study::Compared& one : report.result.primary) {
    for (const study::GroupSum* sum : {&one.first, &one.second})
      smallest = std::min(smallest, sum->persons - sum->absent);
    for (const std::string& hand : one.hands) mouse = mouse || hand == "mouse" || hand == "gamepad";
  }
  if (inference == study::Inference::scoring && mouse)
    all.emplace_back(
        "The needle was led by mouse or gamepad: no force was felt, and the hand’s movement is not a needle’s.");
  if (inference == study::Inference::generalisation && report.case_titles.size() > 0) {
    std::set<std::string> cases;
    for (const study::Outcome& one : plan.primary) cases.insert(one.case_id);
    if (cases.size() == 1) all.emplace_back("One case: nothing shows how far another would agree.");
  }
  if (inference == study::Inference::extrapolation)
    all.emplace_back("Nobody was observed with patients: groups that differ here need not differ there.");
  if (inference == study::Inference::implications && smallest < 12)
    all.emplace_back("Few people: " + std::to_string(smallest) + " in the smallest group.");
  return all;
}

}  // namespace

Html argument_section(const ValidityReport& report) {
  const study::Plan& plan = report.plan.plan;
  Html html;
  html.raw(
      "<section id=\"argument\">\n<h2>1 The argument</h2>\n<dl class=\"use\"><dt>What the numbers are "
      "for</dt><dd>");
  html.text(plan.intended_use).raw("</dd><dt>What they decide</dt><dd>").text(plan.decision);
  html.raw(
      "</dd></dl>\n<table class=\"argument\"><caption>Kane’s four inferences, each a claim that can fall"
      "</caption>\n<thead><tr><th scope=\"col\">Inference</th><th scope=\"col\">Claim</th><th scope=\"col\">"
      "Evidence</th><th scope=\"col\">What would undo it</th></tr></thead>\n<tbody>\n");
  for (const study::Claim& one : plan.argument) {
    html.raw("<tr><th scope=\"row\">").text(base::name_of(study::kInferenceNames, one.inference));
    html.raw(" <span class=\"why\">")
        .text(kQuestions[static_cast<std::size_t>(one.inference)])
        .raw("</span></th><td>");
    html.text(one.claim)
        .raw("</td><td><p>")
        .text(one.evidence.empty() ? "From elsewhere: none yet." : one.evidence);
    html.raw("</p><p class=\"why\">From this study: ").text(added(report, one.inference)).raw("</p></td><td><ul>");
    for (const std::string& rebuttal : one.rebuttals) html.raw("<li>").text(rebuttal).raw("</li>");
    for (const std::string& rebuttal : rebuttals_of_data(report, one.inference))
      html.raw("<li class=\"of-data\">").text(rebuttal).raw("</li>");
    html.raw("</ul></td></tr>\n");
  }
  return html.raw(
      "</tbody></table>\n<p class=\"note\">Rebuttals marked ▸ come from the data, the others from the plan."
      "</p>\n</section>\n");
}

}  // namespace seldinger::reports
