#include "reports/studies/validity_sections.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

// Cheng et al., Adv Simul 1:25 (2016): extensions of CONSORT and STROBE for simulation-based research.
struct ChecklistItem {
  std::string_view topic, asked;
  // Where it is told; empty: missing, to be written by the authors.
  std::string (*where)(const ValidityReport&);
};

std::string nowhere(const ValidityReport&) {
  return {};
}
std::string in_argument(const ValidityReport&) {
  return "section 1";
}
std::string in_flow(const ValidityReport& report) {
  return report.plan.frozen() ? "section 4" : "";
}
std::string in_plan(const ValidityReport&) {
  return "section 9";
}
std::string in_content(const ValidityReport&) {
  return "section 3, content";
}
std::string in_results(const ValidityReport& report) {
  return report.plan.frozen() ? "section 2" : "";
}
std::string of_randomised(const ValidityReport& report) {
  return report.plan.plan.randomised ? "sections 7 and 9" : "does not apply: not randomised";
}
std::string in_response(const ValidityReport& report) {
  return report.plan.frozen() ? "section 3, response process" : "";
}

constexpr ChecklistItem kChecklist[] = {
    {"Title and abstract", "Says that the study is of or with simulation", &nowhere},
    {"Background", "Why simulation answers the question; conceptual framework", &in_argument},
    {"Objectives", "Hypotheses, and whether simulation is studied or the tool", &in_argument},
    {"Design", "Groups or arms, visits, changes after the start (deviations)", &in_plan},
    {"Participants", "Who could take part, and how they were invited", &nowhere},
    {"Participants", "Prior exposure to simulation and orientation to the simulator", &nowhere},
    {"Setting", "Place, dates, teachers", &nowhere},
    {"Intervention or exposure", "Simulator, its version and functions", &in_response},
    {"Intervention or exposure", "Cases: content, and by whom developed and reviewed", &nowhere},
    {"Intervention or exposure", "Instruction, feedback and debriefing", &nowhere},
    {"Outcomes", "Primary and secondary, how measured, with evidence of validity", &in_content},
    {"Outcomes", "The unit of analysis", &in_content},
    {"Sample size", "How it was chosen; interim looks and stopping", &in_plan},
    {"Randomisation", "Sequence, blocks, concealment", &of_randomised},
    {"Blinding", "Who knew what",
     [](const ValidityReport& report) { return std::string(report.plan.frozen() ? "section 6" : ""); }},
    {"Statistics", "Methods, repeated measures, missing data, multiplicity", &in_plan},
    {"Participant flow", "Numbers at each step, with reasons", &in_flow},
    {"Baseline", "Characteristics of each group", &in_flow},
    {"Numbers analysed", "For each outcome", &in_results},
    {"Results", "Effects with intervals", &in_results},
    {"Harms", "Of taking part", &nowhere},
    {"Limitations", "Of simulation as proxy; bias, precision",
     [](const ValidityReport&) { return std::string("sections 1 and 5"); }},
    {"Generalisability", "To other settings and to patients", &in_argument},
    {"Registration", "Where the plan is registered, beside its hash", &nowhere},
    {"Funding", "And interests; who made the simulator", &nowhere},
};

}  // namespace

Html checklist_section(const ValidityReport& report) {
  Html html;
  html.raw(
      "<section id=\"checklist\">\n<h2>8 CONSORT and STROBE, simulation</h2>\n<table "
      "class=\"checklist\"><caption>After Cheng et al., Advances in Simulation 1:25 (2016): where it is reported, "
      "or missing and left to the authors</caption>\n<thead><tr><th scope=\"col\">Item</th><th "
      "scope=\"col\">What</th><th scope=\"col\">Where</th></tr></thead><tbody>\n");
  for (const ChecklistItem& one : kChecklist) {
    const std::string where = one.where(report);
    html.raw("<tr><th scope=\"row\">").text(one.topic).raw("</th><td>").text(one.asked).raw("</td><td>");
    if (where.empty())
      html.raw("<strong class=\"missing\">missing</strong>");
    else
      html.text(where);
    html.raw("</td></tr>\n");
  }
  return html.raw("</tbody></table>\n</section>\n");
}

}  // namespace seldinger::reports
