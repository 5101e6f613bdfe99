#include "reports/pages/sections/grade_section.h"

#include "assessment/grading/plain_words.h"
#include "assessment/grading/reason_words.h"
#include "reports/pages/sections/metric_details.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::CriterionResult;
using assessment::Outcome;
using assessment::Verdict;

void add_verdict(Html& html, const casedb::AttemptGrade& grade) {
  switch (grade.grade.verdict) {
    case Verdict::passed:
      html.raw("<p class=\"verdict good\">");
      break;
    case Verdict::failed:
      html.raw("<p class=\"verdict bad\">");
      break;
    case Verdict::not_gradable:
    case Verdict::no_rule:
      html.raw("<p class=\"verdict\">");
      break;
  }
  html.raw("<strong>").text(verdict_text(grade.grade)).raw("</strong>");
  const bool judged = grade.grade.verdict == Verdict::passed || grade.grade.verdict == Verdict::failed;
  if (judged && grade.provisional)
    html.raw(
        " <span class=\"mark\">provisional</span> <span class=\"why\">no consultant standard has been set "
        "for this case</span>");
  html.raw("</p>\n");
}

std::string needed_text(const CriterionResult& one) {
  return assessment::limit_text(one.criterion, one.unit);
}

void add_criterion(Html& html, const CriterionResult& one, const assessment::ExpertSet& experts) {
  html.raw("<tr><th scope=\"row\">").add(metric_details(one.criterion.metric, one.criterion.version));
  if (one.criterion.critical) html.raw(" <span class=\"mark critical\">critical</span>");
  if (one.of_the_time_limit) html.raw(" <span class=\"mark\">time limit</span>");
  html.raw("</th><td class=\"number\" data-label=\"Measured\">");
  if (one.value && one.unit == "bool")
    html.text(*one.value != 0.0 ? "Yes" : "No");
  else if (one.value)
    html.text(assessment::plain_apart(*one.value, one.criterion.value, one.unit).first);
  else
    html.raw("— <span class=\"why\">").text(assessment::reason_words(one.reason)).raw("</span>");
  html.raw("</td><td class=\"number\" data-label=\"To pass\">").text(needed_text(one));
  if (experts.standard()) {
    html.raw("</td><td class=\"number\" data-label=\"Consultants\">");
    const std::string band = band_text(experts, one.criterion.metric, one.criterion.version);
    const std::string beside = tolerance_text(experts, one.criterion.metric, one.criterion.version);
    html.text(band.empty() ? "–" : band);
    if (!beside.empty()) html.raw(" <span class=\"why\">").text(beside).raw("</span>");
  }
  html.raw("</td><td data-label=\"Result\">");
  switch (one.outcome) {
    case Outcome::met:
      html.raw("<span class=\"yes\">Met</span>");
      break;
    case Outcome::missed:
      html.raw("<span class=\"no\">Missed</span>");
      break;
    case Outcome::not_measured:
      html.raw("<span class=\"no\">Not met</span>");
      break;
  }
  html.raw("</td></tr>\n");
}

void add_criteria(Html& html, const casedb::AttemptGrade& grade) {
  if (grade.grade.criteria.empty()) return;
  html.raw(
      "<table class=\"list criteria\">\n<caption>To pass, every criterion must be met. Nothing makes up for a "
      "critical "
      "error.</caption>\n<thead><tr><th scope=\"col\">Criterion</th><th scope=\"col\" "
      "class=\"number\">Measured</th>"
      "<th scope=\"col\" class=\"number\">To pass</th>");
  if (grade.experts.standard()) html.raw("<th scope=\"col\" class=\"number\">Consultants</th>");
  html.raw("<th scope=\"col\">Result</th></tr></thead>\n<tbody>\n");
  for (const CriterionResult& one : grade.grade.criteria) add_criterion(html, one, grade.experts);
  html.raw("</tbody>\n</table>\n");
}

void add_score(Html& html, const casedb::AttemptGrade& grade) {
  html.raw("<details><summary>Standard and score</summary>\n<p class=\"note\">").text(experts_text(grade.experts));
  if (grade.experts.standard()) html.text(" " + bands_note());
  html.raw("</p>\n<p>Score: ")
      .text(score_text(grade.score))
      .raw(". <span class=\"why\">It is shown beside the result and does not change it.</span></p>\n");
  if (grade.score.value) {
    html.raw(
        "<table>\n<caption>What the score is made of</caption>\n<thead><tr><th scope=\"col\">Metric</th><th "
        "scope=\"col\" class=\"number\">Measured</th><th scope=\"col\" class=\"number\">Consultants’ mean</th><th "
        "scope=\"col\" class=\"number\">SD</th><th scope=\"col\" class=\"number\">SD at least</th><th "
        "scope=\"col\" class=\"number\">z</th></tr></thead>\n<tbody>\n");
    for (const assessment::ScorePart& part : grade.score.parts) {
      html.raw("<tr><th scope=\"row\">")
          .add(metric_details(part.id, part.version))
          .raw("</th><td class=\"number\">");
      html.text(part.value ? assessment::plain_value(*part.value, part.unit) : "—");
      html.raw("</td><td class=\"number\">").text(assessment::plain_value(part.mean, part.unit));
      html.raw("</td><td class=\"number\">").text(assessment::plain_value(part.sd, part.unit));
      html.raw("</td><td class=\"number\">").text(assessment::plain_value(part.least_sd, part.unit));
      html.raw("</td><td class=\"number\">")
          .text(part.z ? number_text(*part.z, 1) : assessment::reason_words(part.reason))
          .raw("</td></tr>\n");
    }
    html.raw("</tbody>\n</table>\n<p class=\"note\">").text(assessment::kScoreFormula).raw("</p>\n");
  }
  html.raw("</details>\n");
}

}  // namespace

Html debrief_list(const std::vector<assessment::Sentence>& sentences) {
  Html html;
  if (sentences.empty()) return html;
  html.raw("<ol class=\"debrief\">\n");
  for (const assessment::Sentence& one : sentences) {
    switch (one.kind) {
      case assessment::SentenceKind::critical_error:
      case assessment::SentenceKind::missed:
      case assessment::SentenceKind::not_measured:
        html.raw("<li class=\"bad\">");
        break;
      case assessment::SentenceKind::well:
        html.raw("<li class=\"good\">");
        break;
      case assessment::SentenceKind::not_gradable:
      case assessment::SentenceKind::shortfall:
      case assessment::SentenceKind::fact:
        html.raw("<li>");
        break;
    }
    html.text(one.text);
    if (!one.metric_id.empty()) html.raw(" ").add(metric_details(one.metric_id));
    html.raw("</li>\n");
  }
  html.raw("</ol>\n");
  return html;
}

Html grade_section(const casedb::AttemptGrade& grade) {
  Html html;
  html.raw("<section class=\"grade\" aria-labelledby=\"grade\">\n<h2 id=\"grade\">Debrief</h2>\n");
  html.add(debrief_list(grade.debrief));
  add_verdict(html, grade);
  add_criteria(html, grade);
  if (grade.grade.verdict != Verdict::no_rule || !grade.experts.id.empty()) add_score(html, grade);
  html.raw("</section>\n");
  return html;
}

}  // namespace seldinger::reports
