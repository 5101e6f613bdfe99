#include "reports/pages/people/studies_page.h"

#include <algorithm>
#include <map>

#include "reports/words/attempt_words.h"
#include "reports/words/metric_words.h"
#include "reports/words/people_words.h"

namespace seldinger::reports {
namespace {

namespace study = assessment::study;

std::string date_text(std::int64_t time_us) {
  return utc_text(time_us).substr(0, 10);
}

std::string state_of_plan(const StudyView& view) {
  if (!view.plan) return "No plan yet";
  if (!view.plan->frozen()) return "Draft";
  return "Frozen on " + date_text(*view.plan->frozen_us);
}

std::string people_text(const StudyView& view) {
  const std::string people = study_people_text(view.study.people);
  if (!view.plan || !view.plan->frozen()) return people;
  return people + ", " + std::to_string(view.enrolments.size()) + " enrolled";
}

bool is_simulated(const StudyView& view) {
  return view.plan && view.plan->plan.people == study::People::simulated;
}

// Wherever such a study is named.
void add_simulated(Html& html, const StudyView& view) {
  if (is_simulated(view)) html.raw(" <span class=\"mark\">simulated</span>");
}

Html study_list(const std::vector<StudyView>& studies) {
  Html html;
  if (studies.empty())
    return html.raw(
        "<div class=\"message\"><p>You work on no study yet. A director or an admin makes one with <code>seldinger "
        "study new</code> and adds you with <code>study researcher</code>.</p></div>\n");
  html.raw(
      "<div class=\"wide\">\n<table class=\"list\">\n<caption>Studies on which you work</caption>\n<thead><tr><th "
      "scope=\"col\">Study</th><th scope=\"col\">Plan</th><th scope=\"col\">People</th><th scope=\"col\" "
      "class=\"number\">Looks</th></tr></thead>\n<tbody>\n");
  for (const StudyView& one : studies) {
    html.raw("<tr><th scope=\"row\"><a href=\"/studies/").text(one.study.study_id).raw("\">").name(one.study.title);
    html.raw("</a>");
    add_simulated(html, one);
    html.raw("</th><td data-label=\"Plan\">").text(state_of_plan(one)).raw("</td><td data-label=\"People\">");
    html.text(people_text(one)).raw("</td><td class=\"number\" data-label=\"Looks\">");
    html.text(std::to_string(one.looks.size())).raw("</td></tr>\n");
  }
  return html.raw("</tbody>\n</table>\n</div>\n");
}

void add_fact_row(Html& html, std::string_view name, std::string_view value) {
  html.raw("<div><dt>").text(name).raw("</dt><dd>").text(value).raw("</dd></div>\n");
}

std::string outcome_line(const study::Outcome& one) {
  return one.name + ": " + metric_label(one.metric) + ", at " + case_text(one.case_id) + ", visit " + one.visit +
         "; " + one.first + " against " + one.second;
}

void add_plan(Html& html, const casedb::StoredPlan& stored) {
  const study::Plan& plan = stored.plan;
  html.raw("<section>\n<h2>The plan</h2>\n<dl class=\"details\">\n");
  add_fact_row(html, "Intended use", plan.intended_use);
  add_fact_row(html, "Whose attempts", whose_attempts_words(plan.people));
  for (const study::PlannedGroup& group : plan.groups)
    add_fact_row(html, plan.randomised ? "Arm" : "Group", group.name);
  for (const study::Outcome& one : plan.primary) add_fact_row(html, "Primary outcome", outcome_line(one));
  for (const study::Outcome& one : plan.secondary) add_fact_row(html, "Secondary outcome", outcome_line(one));
  add_fact_row(html, "Stops at", std::to_string(plan.per_group) + " in each group");
  add_fact_row(html, "SHA-256", stored.body_hash);
  html.raw("</dl>\n</section>\n");
}

void add_blinded(Html& html, const casedb::BlindedCounts& counts) {
  html.raw(
      "<section>\n<h2>So far</h2>\n<p class=\"note\">Before the freeze there are only counts of all together: "
      "nobody is in a group, and no outcome is shown.</p>\n<dl class=\"outcome\">\n");
  add_fact_row(html, "Who may be in", study_people_text(counts.people));
  add_fact_row(html, "Have made an attempt at the plan’s cases", std::to_string(counts.with_attempts));
  add_fact_row(html, "Attempts at them", std::to_string(counts.attempts));
  html.raw("</dl>\n</section>\n");
}

void add_flow(Html& html, const StudyView& view) {
  html.raw("<section>\n<h2>How far people came</h2>\n<p>").text(study_people_text(view.flow.people));
  html.raw(" now, ").text(std::to_string(view.flow.ever_enrolled)).raw(" were enrolled.");
  if (view.flow.unknown > 0)
    html.raw(" ").text(std::to_string(view.flow.unknown)).raw(" of them have been erased since.");
  html.raw(
      "</p>\n<div class=\"wide\">\n<table class=\"list\">\n<caption>By group</caption>\n<thead><tr><th "
      "scope=\"col\">Group</th><th scope=\"col\" class=\"number\">Enrolled</th><th scope=\"col\" "
      "class=\"number\">Withdrew since</th><th scope=\"col\" class=\"number\">Made an attempt</th><th "
      "scope=\"col\" "
      "class=\"number\">Planned</th></tr></thead>\n<tbody>\n");
  for (const casedb::GroupFlow& group : view.flow.groups) {
    html.raw("<tr><th scope=\"row\">").text(group.name).raw("</th>");
    for (const auto& [name, count] : {std::pair{"Enrolled", group.allocated},
                                      {"Withdrew since", group.withdrew},
                                      {"Made an attempt", group.attempted},
                                      {"Planned", static_cast<std::size_t>(view.plan->plan.per_group)}}) {
      html.raw("<td class=\"number\" data-label=\"").text(name).raw("\">").text(std::to_string(count)).raw("</td>");
    }
    html.raw("</tr>\n");
  }
  html.raw("</tbody>\n</table>\n</div>\n</section>\n");
}

// Of each visit how many have made it, and who should.
void add_visits(Html& html, const StudyView& view) {
  html.raw(
      "<section>\n<h2>Whether the data are complete</h2>\n<div class=\"wide\">\n<table "
      "class=\"list\">\n<caption>Visits of those who are enrolled; made means an attempt at a case of the plan, "
      "whatever came of it</caption>\n<thead><tr><th scope=\"col\">Visit</th><th scope=\"col\" "
      "class=\"number\">Made</th><th scope=\"col\" class=\"number\">Ahead</th><th scope=\"col\" "
      "class=\"number\">Due</th><th scope=\"col\" class=\"number\">Missed</th><th scope=\"col\">Due or missed "
      "by</th></tr></thead>\n<tbody>\n");
  for (const study::Visit& visit : view.plan->plan.visits) {
    std::map<casedb::VisitState, int> counts;
    std::string owing;
    for (const casedb::PersonVisit& one : view.visits) {
      if (one.visit != visit.name) continue;
      ++counts[one.state];
      if (one.state == casedb::VisitState::due || one.state == casedb::VisitState::missed)
        owing += (owing.empty() ? "" : ", ") + one.pseudonym;
    }
    html.raw("<tr><th scope=\"row\">").text(visit.name).raw("</th>");
    for (const auto& [name, state] : {std::pair{"Made", casedb::VisitState::made},
                                      {"Ahead", casedb::VisitState::ahead},
                                      {"Due", casedb::VisitState::due},
                                      {"Missed", casedb::VisitState::missed}}) {
      html.raw("<td class=\"number\" data-label=\"").text(name).raw("\">").text(std::to_string(counts[state]));
      html.raw("</td>");
    }
    html.raw("<td data-label=\"Due or missed by\">").text(owing.empty() ? "—" : owing).raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n</div>\n</section>\n");
}

void add_people_in(Html& html, const StudyView& view) {
  html.raw("<section>\n<h2>Who is in</h2>\n");
  if (view.enrolments.empty()) {
    html.raw("<p>Nobody is enrolled yet: <code>seldinger study enrol</code>.</p>\n</section>\n");
    return;
  }
  html.raw("<div class=\"wide\">\n<table class=\"list\">\n<caption>");
  html.text(is_simulated(view) ? "Simulated people, by pseudonym" : "Only those who consent now, by pseudonym");
  html.raw(
      "</caption>\n<thead><tr><th scope=\"col\">Pseudonym</th><th scope=\"col\">Group</th><th "
      "scope=\"col\">Stratum</th><th scope=\"col\">Enrolled</th></tr></thead>\n<tbody>\n");
  for (const casedb::StudyEnrolment& one : view.enrolments) {
    html.raw("<tr><th scope=\"row\">").text(one.pseudonym).raw("</th><td data-label=\"Group\">").text(one.group);
    html.raw("</td><td data-label=\"Stratum\">").text(one.stratum.empty() ? "—" : one.stratum);
    html.raw("</td><td data-label=\"Enrolled\">").text(date_text(one.enrolled_us)).raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n</div>\n</section>\n");
}

void add_notes(Html& html, std::string_view title, const std::vector<casedb::StudyNote>& notes, bool looks,
               bool simulated) {
  html.raw("<section>\n<h2>").text(title).raw("</h2>\n");
  if (notes.empty()) html.raw("<p>None.</p>\n");
  if (!notes.empty()) html.raw("<ol>\n");
  for (const casedb::StudyNote& one : notes) {
    html.raw("<li>").text(date_text(one.at_us)).raw(": ").name(one.text);
    if (looks) html.raw(", of ").text(with_outcome_text(one.people, simulated));
    html.raw("</li>\n");
  }
  if (!notes.empty()) html.raw("</ol>\n");
  html.raw("</section>\n");
}

// A job of that kind (jobs_page.h).
void add_job_form(Html& html, const Visitor& visitor, const StudyView& view, std::string_view kind,
                  std::string_view button) {
  html.raw("<form method=\"post\" action=\"/jobs\">\n<input type=\"hidden\" name=\"token\" value=\"");
  html.text(visitor.form_token).raw("\">\n<input type=\"hidden\" name=\"kind\" value=\"").text(kind);
  html.raw("\"><input type=\"hidden\" name=\"study\" value=\"").text(view.study.study_id);
  html.raw("\">\n<p><button>").text(button).raw("</button></p>\n</form>\n");
}

void add_what_next(Html& html, const Visitor& visitor, const StudyView& view) {
  html.raw("<section>\n<h2>Report and export</h2>\n");
  if (view.plan) {
    html.raw("<p class=\"note\">");
    html.text(view.plan->frozen()
                  ? "The report compares the groups: making it is a look, which is noted under your pseudonym."
                  : "Before the freeze the report holds the plan and counts of all together, and is no look.");
    html.raw("</p>\n");
    add_job_form(html, visitor, view, "study_report", "Make the validity report");
  }
  if (!view.plan || view.plan->frozen()) {
    html.raw("<p class=\"note\">");
    if (view.plan) html.raw("The export shows outcomes by person: it is a look, too. ");
    html.raw("It holds the attempts of ").text(is_simulated(view) ? "simulated people" : "those who consent");
    html.raw(", without names; their numbers have two significant digits.</p>\n");
    add_job_form(html, visitor, view, "study_export", "Export the attempts");
  }
  html.raw(
      "<p class=\"why\">Recordings and exact numbers are exported with <code>seldinger export --study "
      "--key</code>. The "
      "plan is stored and frozen with <code>seldinger study plan</code> and <code>study freeze</code>.</p>\n"
      "</section>\n");
}

}  // namespace

std::string studies_page(const Visitor& visitor, const std::vector<StudyView>& studies) {
  Html html;
  html.raw("<h1>Studies</h1>\n").add(study_list(studies));
  return page("Studies", visitor, html);
}

std::string researcher_start_page(const Visitor& visitor, const std::vector<StudyView>& studies) {
  Html html;
  html.raw("<h1>Your studies</h1>\n").add(study_list(studies));
  html.raw(
      "<p><a href=\"/attempts\">Attempts of those who consent to them, and simulated ones</a> · <a "
      "href=\"/metrics\">What each metric measures</a></p>\n");
  return page("Your studies", visitor, html);
}

std::string study_page(const Visitor& visitor, const StudyView& view) {
  Html html;
  html.raw("<p class=\"back\"><a href=\"/studies\">All studies</a></p>\n<h1>").name(view.study.title);
  add_simulated(html, view);
  html.raw("</h1>\n<p class=\"sub\">").text(state_of_plan(view)).raw(" · ").text(people_text(view)).raw("</p>\n");
  if (!view.plan) {
    html.raw(
        "<div class=\"message\"><p>It has no plan yet: <code>seldinger study plan</code> stores one.</p></div>\n");
    add_what_next(html, visitor, view);
    return page(view.study.title, visitor, html);
  }
  if (view.plan->frozen()) {
    add_flow(html, view);
    add_visits(html, view);
    add_people_in(html, view);
    add_notes(html, "Looks at the outcomes", view.looks, true, is_simulated(view));
    add_notes(html, "Deviations from the plan", view.deviations, false, is_simulated(view));
  } else {
    add_blinded(html, view.blinded);
  }
  add_what_next(html, visitor, view);
  add_plan(html, *view.plan);
  return list_page(view.study.title, visitor, html);
}

}  // namespace seldinger::reports
