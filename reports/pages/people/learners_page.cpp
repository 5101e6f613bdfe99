#include "reports/pages/people/learners_page.h"

#include <algorithm>
#include <array>

#include "reports/pages/curricula_page.h"
#include "reports/words/metric_words.h"
#include "reports/words/people_words.h"
#include "reports/words/standing_words.h"

namespace seldinger::reports {
namespace {

using assessment::Proficiency;
using assessment::Standing;

struct Row {
  const LearnerView* learner = nullptr;
  const casedb::CurriculumRecord* record = nullptr;
  assessment::StandingFound found;
};

// Their record in the curriculum that is shown.
const casedb::CurriculumRecord* record_in(const LearnerView& learner, const std::string& curriculum_id) {
  for (const casedb::CurriculumRecord& one : *learner.records)
    if (curriculum_id.empty() || one.curriculum.curriculum_id == curriculum_id) return &one;
  return nullptr;
}

bool in_cohort(const LearnerView& learner, const std::string& cohort) {
  return cohort.empty() ||
         std::find(learner.cohorts.begin(), learner.cohorts.end(), cohort) != learner.cohorts.end();
}

std::vector<Row> rows_of(const LearnersView& view) {
  std::vector<Row> rows;
  for (const LearnerView& learner : view.learners) {
    const casedb::CurriculumRecord* record = record_in(learner, view.part.curriculum_id);
    if (record == nullptr || !in_cohort(learner, view.part.cohort)) continue;
    rows.push_back({&learner, record, casedb::standing_in(*record, view.now_us)});
  }
  const auto place = [](Standing standing) {
    return std::find(std::begin(assessment::kAllStandings), std::end(assessment::kAllStandings), standing) -
           std::begin(assessment::kAllStandings);
  };
  std::stable_sort(rows.begin(), rows.end(), [&](const Row& a, const Row& b) {
    return std::pair(place(a.found.standing), a.learner->label) <
           std::pair(place(b.found.standing), b.learner->label);
  });
  return rows;
}

void add_option(Html& html, const std::string& value, const std::string& text, bool chosen) {
  html.raw("<option value=\"").text(value);
  if (chosen)
    html.raw("\" selected>");
  else
    html.raw("\">");
  html.text(text).raw("</option>");
}

void add_filter(Html& html, const LearnersView& view) {
  html.raw("<form class=\"filter\" method=\"get\" action=\"/progress\">\n");
  if (!view.learners.empty() && view.learners.front().records->size() > 1) {
    html.raw("<p><label for=\"curriculum\">Curriculum</label>\n<select id=\"curriculum\" name=\"curriculum\">");
    for (const casedb::CurriculumRecord& one : *view.learners.front().records)
      add_option(html, one.curriculum.curriculum_id, one.curriculum.title,
                 one.curriculum.curriculum_id == view.part.curriculum_id);
    html.raw("</select></p>\n");
  }
  if (view.cohorts.size() > 1) {
    html.raw("<p><label for=\"cohort\">Cohort</label>\n<select id=\"cohort\" name=\"cohort\">");
    add_option(html, "", "All", view.part.cohort.empty());
    for (const std::string& title : view.cohorts) add_option(html, title, title, title == view.part.cohort);
    html.raw("</select></p>\n");
  }
  html.raw("<p><label for=\"standing\">State</label>\n<select id=\"standing\" name=\"standing\">");
  add_option(html, "", "All", view.part.standing.empty());
  for (const Standing standing : assessment::kAllStandings) {
    const std::string name(assessment::name_of(standing));
    add_option(html, name, standing_text(standing), name == view.part.standing);
  }
  html.raw("</select></p>\n<p><button class=\"quiet\">Show</button></p>\n</form>\n");
}

// Simulated ones are counted apart.
struct Counted {
  int people = 0, simulated = 0;
};
template <typename Which>
Counted counted(const std::vector<Row>& rows, const Which& which) {
  Counted count;
  for (const Row& row : rows)
    if (which(row)) ++(row.learner->simulated ? count.simulated : count.people);
  return count;
}

// How many are in each state: a bar whose parts say themselves.
void add_counts(Html& html, const std::vector<Row>& rows) {
  html.raw("<dl class=\"standings\">\n");
  for (const Standing standing : assessment::kAllStandings) {
    const Counted count = counted(rows, [&](const Row& row) { return row.found.standing == standing; });
    html.raw("<div class=\"").text(assessment::name_of(standing)).raw("\"><dt>").text(standing_text(standing));
    html.raw("</dt><dd>").text(std::to_string(count.people));
    if (count.simulated > 0)
      html.raw("<span class=\"why\">").text(and_simulated_text(count.simulated)).raw("</span>");
    html.raw("</dd></div>\n");
  }
  html.raw("</dl>\n");
}

std::string state_text(const casedb::ItemState& item) {
  return item.graded.empty() ? proficiency_text(item.progress.reached)
                             : proficiency_text(item.progress.reached) + ", " + std::to_string(item.passes) +
                                   " of " + std::to_string(item.attempts) + " passed";
}

// A letter tells the state where colour cannot.
void add_state_cell(Html& html, const casedb::ItemState& item, std::size_t number) {
  html.raw("<td class=\"state ").text(assessment::name_of(item.progress.reached)).raw("\" data-label=\"Item ");
  html.text(std::to_string(number)).raw("\"><span title=\"").text(state_text(item)).raw("\">");
  switch (item.progress.reached) {
    case Proficiency::not_started:
      html.raw("–");
      break;
    case Proficiency::practising:
      html.raw("○");
      break;
    case Proficiency::passed:
      html.raw("◐");
      break;
    case Proficiency::proficient:
      html.raw("●");
      break;
  }
  html.raw("<span class=\"said\"> ").text(state_text(item)).raw("</span></span></td>");
}

void add_row(Html& html, const Row& row, std::int64_t now_us) {
  html.raw("<tr><th scope=\"row\"><a href=\"/progress/").text(row.learner->person_id).raw("\">");
  html.name(row.learner->label).raw("</a>");
  if (row.learner->simulated) html.raw(" <span class=\"mark\">simulated</span>");
  html.raw("</th><td data-label=\"State\"><span class=\"mark standing ")
      .text(assessment::name_of(row.found.standing));
  html.raw("\">").text(standing_text(row.found.standing)).raw("</span></td><td data-label=\"Why\">");
  html.text(evidence_text(row.found, *row.record, now_us)).raw("</td>");
  for (std::size_t i = 0; i < row.record->items.size(); ++i) add_state_cell(html, row.record->items[i], i + 1);
  html.raw("</tr>\n");
}

void add_people(Html& html, const std::vector<Row>& rows, const LearnersView& view) {
  html.raw("<div class=\"wide\">\n<table class=\"list learners\">\n<caption>");
  html.name(rows.front().record->curriculum.title).raw(": ");
  const Counted count = counted(rows, [](const Row&) { return true; });
  html.text(std::to_string(count.people) + (count.people == 1 ? " learner" : " learners") +
            and_simulated_text(count.simulated));
  html.raw(
      ". ● proficient ◐ passed ○ practising – not started</caption>\n<thead><tr><th scope=\"col\">Learner</th><th "
      "scope=\"col\">State</th><th scope=\"col\">Why</th>");
  const auto& items = rows.front().record->items;
  for (std::size_t i = 0; i < items.size(); ++i)
    html.raw("<th scope=\"col\" class=\"state\"><abbr title=\"")
        .text(items[i].title)
        .raw("\">")
        .text(std::to_string(i + 1))
        .raw("</abbr></th>");
  html.raw("</tr></thead>\n<tbody>\n");
  for (const Row& row : rows) add_row(html, row, view.now_us);
  html.raw("</tbody>\n</table>\n</div>\n");
}

// What keeps whom: each item with how many are where, and what is missed most by those who practise it. Of people;
// where nobody is one, of the simulated.
void add_items(Html& html, std::vector<Row> rows) {
  const bool simulated = counted(rows, [](const Row&) { return true; }).people == 0;
  std::erase_if(rows, [&](const Row& row) { return row.learner->simulated != simulated; });
  html.raw("<section>\n<h2>Item by item</h2>\n<div class=\"wide\">\n<table class=\"list\">\n<caption>How many ");
  html.text(simulated ? "simulated learners " : "learners ");
  html.raw(
      "have come how far, and what their attempts that did not pass missed</caption>\n<thead><tr><th "
      "scope=\"col\">Item</th><th scope=\"col\" class=\"number\">Proficient</th><th scope=\"col\" "
      "class=\"number\">Passed</th><th scope=\"col\" class=\"number\">Practising</th><th scope=\"col\" "
      "class=\"number\">Stuck</th><th scope=\"col\" class=\"number\">Attempts passed</th><th scope=\"col\">Missed "
      "most</th></tr></thead>\n<tbody>\n");
  const std::size_t items = rows.front().record->items.size();
  for (std::size_t i = 0; i < items; ++i) {
    std::array<int, 4> reached{};
    int stuck = 0, passes = 0, failed = 0;
    std::vector<assessment::GradedAttempt> all;
    for (const Row& row : rows) {
      const casedb::ItemState& item = row.record->items.at(i);
      ++reached.at(static_cast<std::size_t>(item.progress.reached));
      stuck += row.found.standing == Standing::stuck && row.found.item == i ? 1 : 0;
      passes += item.passes;
      for (const assessment::GradedAttempt& one : item.graded) {
        if (one.verdict != assessment::Verdict::failed) continue;
        ++failed;
        all.push_back(one);
      }
    }
    const std::vector<assessment::Missed> missed = assessment::missed_in(all);
    html.raw("<tr><th scope=\"row\">").text(std::to_string(i + 1)).raw(". ");
    html.name(rows.front().record->items[i].title).raw("</th>");
    for (const Proficiency one : {Proficiency::proficient, Proficiency::passed, Proficiency::practising}) {
      html.raw("<td class=\"number\" data-label=\"").text(proficiency_text(one)).raw("\">");
      html.text(std::to_string(reached.at(static_cast<std::size_t>(one)))).raw("</td>");
    }
    html.raw("<td class=\"number\" data-label=\"Stuck\">").text(std::to_string(stuck));
    html.raw("</td><td class=\"number\" data-label=\"Attempts passed\">");
    html.text(std::to_string(passes) + " of " + std::to_string(passes + failed));
    html.raw("</td><td data-label=\"Missed most\">");
    if (missed.empty())
      html.raw("—");
    else
      html.text(metric_label(missed.front().metric) + " (" + std::to_string(missed.front().times) + " of " +
                std::to_string(failed) + ")");
    html.raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n</div>\n</section>\n");
}

void add_rules(Html& html) {
  html.raw("<section>\n<h2>What the states mean</h2>\n<dl class=\"definitions\">\n");
  for (const Standing standing : assessment::kAllStandings)
    html.raw("<dt>")
        .text(standing_text(standing))
        .raw("</dt><dd>")
        .text(assessment::rule_of(standing))
        .raw("</dd>\n");
  html.raw(
      "</dl>\n<p class=\"note\">A state is worked out from stored attempts whenever this page is made. It predicts "
      "nothing, and says nothing about work on patients.</p>\n</section>\n");
}

}  // namespace

std::string learners_page(const Visitor& visitor, const LearnersView& view) {
  Html html;
  html.raw("<h1>Learners</h1>\n");
  if (view.learners.empty()) {
    html.raw(
        "<div class=\"message\"><p>There are no learners in a cohort that you may see by name. Whoever runs this "
        "library adds learners with <code>seldinger cohort enrol</code>.</p></div>\n");
    return page("Learners", visitor, html);
  }
  if (view.learners.front().records->empty()) {
    html.raw(
        "<div class=\"message\"><p>No curriculum is published, so nothing is due. A mentor makes one with "
        "<code>seldinger curriculum add</code>, a director publishes it.</p></div>\n<ul>\n");
    for (const LearnerView& one : view.learners)
      html.raw("<li><a href=\"/progress/").text(one.person_id).raw("\">").name(one.label).raw("</a></li>\n");
    html.raw("</ul>\n");
    return page("Learners", visitor, html);
  }
  add_filter(html, view);
  const std::vector<Row> all = rows_of(view);
  std::vector<Row> shown = all;
  if (!view.part.standing.empty())
    std::erase_if(shown,
                  [&](const Row& row) { return assessment::name_of(row.found.standing) != view.part.standing; });
  add_counts(html, all);
  if (shown.empty())
    html.raw("<p>Nobody is in that state.</p>\n");
  else
    add_people(html, shown, view);
  if (!all.empty()) add_items(html, all);
  add_rules(html);
  return list_page("Learners", visitor, html);
}

}  // namespace seldinger::reports
