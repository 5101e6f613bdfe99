#include "reports/pages/people/learner_page.h"

#include <algorithm>

#include "reports/charts/pass_chart.h"
#include "reports/pages/curricula_page.h"
#include "reports/words/metric_words.h"
#include "reports/words/standing_words.h"

namespace seldinger::reports {
namespace {

using assessment::GradedAttempt;
using assessment::Proficiency;
using assessment::Verdict;

std::string day_text(std::int64_t time_us) {
  return utc_text(time_us).substr(0, 10);
}

const GradedAttempt* last_pass(const casedb::ItemState& item) {
  const GradedAttempt* last = nullptr;
  for (const GradedAttempt& one : item.graded)
    if (one.verdict == Verdict::passed) last = &one;
  return last;
}

const GradedAttempt* first_proficient(const casedb::ItemState& item) {
  std::vector<Verdict> verdicts;
  for (const GradedAttempt& one : item.graded) verdicts.push_back(one.verdict);
  const auto at = assessment::proficient_at(verdicts);
  return at ? &item.graded[*at] : nullptr;
}

std::string missed_text(const casedb::ItemState& item) {
  const auto failed = std::count_if(item.graded.begin(), item.graded.end(),
                                    [](const GradedAttempt& one) { return one.verdict == Verdict::failed; });
  const std::vector<assessment::Missed> most = assessment::missed_in(item.graded);
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(most.size(), 3); ++i)
    text += (i == 0 ? "" : ", ") + metric_label(most[i].metric) + " (" + std::to_string(most[i].times) + " of " +
            std::to_string(failed) + ")";
  return text.empty() ? "—" : text;
}

std::string left_text(int attempts) {
  if (attempts == 0) return "no attempts left: a mentor can help";
  return std::to_string(attempts) + (attempts == 1 ? " attempt left" : " attempts left");
}

void add_item(Html& html, const casedb::CurriculumRecord& record, std::size_t index) {
  const casedb::ItemState& item = record.items[index];
  html.raw("<tr><th scope=\"row\">").text(std::to_string(index + 1)).raw(". ").name(item.title);
  const std::string gates = gates_text(record.curriculum.items.at(index).gates);
  if (!gates.empty()) html.raw(" <span class=\"why\">").text(gates).raw("</span>");
  html.raw("</th><td data-label=\"State\">").text(proficiency_text(item.progress.reached));
  if (item.progress.due) html.raw(" <span class=\"mark due\">due</span>");
  if (!item.progress.open) html.raw(" <span class=\"why\">not open yet</span>");
  if (item.progress.attempts_left && item.progress.reached != Proficiency::proficient)
    html.raw(" <span class=\"why\">").text(left_text(*item.progress.attempts_left)).raw("</span>");
  html.raw("</td><td class=\"number\" data-label=\"Passed\">").text(passes_text(item));
  const GradedAttempt* pass = last_pass(item);
  html.raw("</td><td class=\"number\" data-label=\"Last pass\">")
      .text(pass == nullptr ? "—" : day_text(pass->started_us));
  html.raw("</td><td class=\"number\" data-label=\"Retention due\">");
  html.text(pass == nullptr || item.progress.reached != Proficiency::proficient
                ? "—"
                : day_text(pass->started_us + assessment::kRetentionDays * assessment::kDay_us));
  html.raw("</td><td data-label=\"Missed most\">").text(missed_text(item)).raw("</td></tr>\n");
}

void add_record(Html& html, const casedb::CurriculumRecord& record, bool own, std::int64_t now_us) {
  const assessment::StandingFound found = casedb::standing_in(record, now_us);
  html.raw("<section>\n<h2>")
      .name(record.curriculum.title)
      .raw("</h2>\n<p class=\"standing-line\"><span class=\"mark standing ");
  html.text(assessment::name_of(found.standing)).raw("\">").text(standing_text(found.standing)).raw("</span> ");
  html.text(evidence_text(found, record, now_us)).raw(" <span class=\"why\">Rule: ");
  html.text(assessment::rule_of(found.standing)).raw("</span></p>\n");
  if (own) html.add(due_lines(record));
  std::vector<PassRow> rows;
  for (std::size_t i = 0; i < record.items.size(); ++i)
    rows.push_back({std::to_string(i + 1) + ". " + record.items[i].title, &record.items[i].graded});
  html.add(pass_chart(rows));
  html.raw(
      "<div class=\"wide\">\n<table class=\"list learner\">\n<caption>Item by item. The passes of all graded "
      "attempts are followed by the 95 % interval of the share (Wilson); with few attempts it is "
      "wide.</caption>\n<thead><tr><th scope=\"col\">Item</th><th scope=\"col\">State</th><th scope=\"col\" "
      "class=\"number\">Passed</th><th scope=\"col\" class=\"number\">Last pass</th><th scope=\"col\" "
      "class=\"number\">Retention due</th><th scope=\"col\">Missed most</th></tr></thead>\n<tbody>\n");
  for (std::size_t i = 0; i < record.items.size(); ++i) add_item(html, record, i);
  html.raw("</tbody>\n</table>\n</div>\n</section>\n");
}

// The case at which they were last stands open.
void add_learning(Html& html, std::span<const LearnerItem> items) {
  if (items.empty()) return;
  html.raw(
      "<section>\n<h2>Learning curves</h2>\n<p class=\"note\">A filled mark is an attempt that passed, a hollow "
      "one "
      "did not. None of this is a verdict: it is for learner and mentor to talk about.</p>\n");
  const auto last = std::max_element(items.begin(), items.end(), [](const LearnerItem& a, const LearnerItem& b) {
    return a.attempts.back().started_us < b.attempts.back().started_us;
  });
  for (const LearnerItem& one : items) {
    if (&one == &*last)
      html.raw("<details class=\"learned\" open><summary>");
    else
      html.raw("<details class=\"learned\"><summary>");
    html.name(one.title).raw(" <span class=\"why\">").text(passed_text(one)).raw("</span></summary>\n");
    html.add(learning_charts(one)).raw("</details>\n");
  }
  html.raw("</section>\n");
}

void add_title(Html& html, const LearnerView& learner) {
  html.raw("<p class=\"sub\">");
  if (learner.simulated) html.raw("<span class=\"mark\">simulated</span> A simulated person: not a learner. ");
  for (std::size_t i = 0; i < learner.cohorts.size(); ++i) html.text(i == 0 ? "" : ", ").name(learner.cohorts[i]);
  html.raw("</p>\n");
}

}  // namespace

Html due_lines(const casedb::CurriculumRecord& record) {
  Html html;
  for (std::size_t i = 0; i < record.items.size(); ++i) {
    const casedb::ItemState& item = record.items[i];
    if (!item.progress.due) continue;
    html.raw("<p><strong>Next: ").text(std::to_string(i + 1)).raw(". ").name(item.title).raw("</strong>, ");
    html.text(std::to_string(item.progress.passes_missing));
    html.text(item.progress.passes_missing == 1 ? " more pass" : " passes in a row");
    html.raw(" to be proficient. It is due because it is the first open item that is not proficient yet.</p>\n");
  }
  return html;
}

std::string learner_page(const Visitor& visitor, const LearnerView& learner, std::span<const LearnerItem> items,
                         bool own, std::int64_t now_us) {
  Html html;
  if (own)
    html.raw("<h1>Your progress</h1>\n");
  else
    html.raw("<p class=\"back\"><a href=\"/progress\">All learners</a></p>\n<h1>")
        .name(learner.label)
        .raw("</h1>\n");
  add_title(html, learner);
  if (learner.records->empty()) html.raw("<div class=\"message\"><p>No curriculum is published yet.</p></div>\n");
  for (const casedb::CurriculumRecord& one : *learner.records) add_record(html, one, own, now_us);
  add_learning(html, items);
  if (!learner.records->empty())
    html.raw("<p><a href=\"/progress/").text(learner.person_id).raw("/record\">Record to print</a></p>\n");
  return page(own ? "Your progress" : learner.label, visitor, html);
}

std::string learner_record_page(const Visitor& visitor, const LearnerView& learner, const StandardTexts& standards,
                                std::int64_t now_us) {
  Html html;
  html.raw("<p class=\"back\"><a href=\"/progress/")
      .text(learner.person_id)
      .raw("\">Back</a></p>\n<h1>Training record</h1>\n");
  html.raw("<dl class=\"details\"><div><dt>Learner</dt><dd>").name(learner.label);
  if (learner.simulated) html.raw(" (simulated)");
  html.raw("</dd></div><div><dt>Cohorts</dt><dd>");
  for (std::size_t i = 0; i < learner.cohorts.size(); ++i) html.text(i == 0 ? "" : ", ").name(learner.cohorts[i]);
  html.raw("</dd></div><div><dt>As of</dt><dd>").text(utc_text(now_us)).raw("</dd></div></dl>\n");
  for (const casedb::CurriculumRecord& record : *learner.records) {
    const assessment::StandingFound found = casedb::standing_in(record, now_us);
    html.raw("<section>\n<h2>")
        .name(record.curriculum.title)
        .raw("</h2>\n<p><strong>")
        .text(standing_text(found.standing));
    html.raw("</strong>: ")
        .text(evidence_text(found, record, now_us))
        .raw(
            "</p>\n<div class=\"wide\" tabindex=\"0\" role=\"group\" aria-label=\"Item by "
            "item\">\n<table>\n<caption>");
    html.raw(
        "Proficient: two passes in a row, by the pass rule of the case’s version that was "
        "attempted</caption>\n<thead><tr>"
        "<th scope=\"col\">Case</th><th scope=\"col\">Version now</th><th scope=\"col\">Attempts</th><th "
        "scope=\"col\">Passed (95 % interval)</th><th scope=\"col\">Proficient since</th><th scope=\"col\">Last "
        "pass</th><th scope=\"col\">Standard</th></tr></thead>\n<tbody>\n");
    for (std::size_t i = 0; i < record.items.size(); ++i) {
      const casedb::ItemState& item = record.items[i];
      const GradedAttempt *since = first_proficient(item), *pass = last_pass(item);
      html.raw("<tr><th scope=\"row\">").text(std::to_string(i + 1)).raw(". ").name(item.title).raw("</th><td>");
      html.text(item.case_id.empty() ? "none published" : std::to_string(item.version)).raw("</td><td>");
      html.text(std::to_string(item.attempts)).raw("</td><td>").text(passes_text(item)).raw("</td><td>");
      html.text(since == nullptr ? "—" : day_text(since->started_us)).raw("</td><td>");
      html.text(pass == nullptr ? "—" : day_text(pass->started_us)).raw("</td><td>");
      const auto standard = standards.find(item.case_id);
      html.text(standard == standards.end() ? "none" : standard->second).raw("</td></tr>\n");
    }
    html.raw("</tbody>\n</table>\n</div>\n</section>\n");
  }
  html.raw(
      "<section class=\"signatures\">\n<p>Made on a simulator. It shows what was done there, not competence with "
      "patients.</p>\n<dl><div><dt>Learner</dt><dd></dd></div><div><dt>Mentor</dt><dd></dd></"
      "div><div><dt>Programme "
      "director</dt><dd></dd></div></dl>\n</section>\n");
  return page("Training record", visitor, html);
}

}  // namespace seldinger::reports
