#include "reports/pages/people/start_page.h"

#include <algorithm>
#include <array>
#include <map>

#include "reports/pages/people/learner_page.h"
#include "reports/pages/sections/grade_section.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"
#include "reports/words/people_words.h"
#include "reports/words/standing_words.h"

namespace seldinger::reports {
namespace {

using assessment::Standing;

constexpr std::size_t kMostInNeed = 12;

std::string attempt_path(const std::string& attempt_id) {
  return "/attempts/" + attempt_id;
}

void add_last_attempt(Html& html, const AttemptView& view) {
  html.raw("<section>\n<h2>Your last attempt</h2>\n<p><a href=\"")
      .text(attempt_path(view.row.attempt_id))
      .raw("\">");
  html.name(view.row.case_title).raw(", ").text(told_text(view.row.started_us)).raw("</a>: <strong>");
  html.text(verdict_text(view.grade.grade)).raw("</strong></p>\n").add(debrief_list(view.grade.debrief));
  html.raw("</section>\n");
}

void add_said(Html& html, const std::vector<SaidOfAttempt>& said) {
  if (said.empty()) return;
  html.raw("<section>\n<h2>What your mentors said</h2>\n<dl class=\"definitions\">\n");
  for (const SaidOfAttempt& one : said) {
    html.raw("<dt><a href=\"").text(attempt_path(one.attempt_id)).raw("#comments\">").name(one.case_title);
    html.raw(", at ").text(number_text(one.comment.comment.at_s, 1)).raw(" s</a></dt><dd>");
    html.text(one.comment.comment.body).raw(" <span class=\"why\">").name(one.comment.author).raw(", ");
    html.text(utc_text(one.comment.comment.written_us)).raw("</span></dd>\n");
  }
  html.raw("</dl>\n</section>\n");
}

// --- who answers for others
// ---------------------------------------------------------------------------------------
struct InNeed {
  const LearnerView* learner = nullptr;
  const casedb::CurriculumRecord* record = nullptr;
  assessment::StandingFound found;
};

// Everybody in every published curriculum, who needs somebody first at the front.
std::vector<InNeed> everybody(const LeaderStart& start) {
  std::vector<InNeed> all;
  for (const LearnerView& learner : start.learners)
    for (const casedb::CurriculumRecord& record : *learner.records)
      all.push_back({&learner, &record, casedb::standing_in(record, start.now_us)});
  const auto place = [](Standing standing) {
    return std::find(std::begin(assessment::kAllStandings), std::end(assessment::kAllStandings), standing) -
           std::begin(assessment::kAllStandings);
  };
  std::stable_sort(all.begin(), all.end(), [&](const InNeed& a, const InNeed& b) {
    return std::pair(place(a.found.standing), a.learner->label) <
           std::pair(place(b.found.standing), b.learner->label);
  });
  return all;
}

// A number opens who it counts.
void add_standings(Html& html, const std::vector<InNeed>& all) {
  struct Counts {
    std::string title;
    std::array<int, std::size(assessment::kAllStandings)> of{}, simulated{};
  };
  std::map<std::string, Counts> by_curriculum;
  for (const InNeed& one : all) {
    Counts& counts = by_curriculum[one.record->curriculum.curriculum_id];
    counts.title = one.record->curriculum.title;
    ++(one.learner->simulated ? counts.simulated : counts.of)[static_cast<std::size_t>(one.found.standing)];
  }
  for (const auto& [curriculum_id, counts] : by_curriculum) {
    html.raw("<h3>").name(counts.title).raw("</h3>\n<ul class=\"standings\">\n");
    for (const Standing standing : assessment::kAllStandings) {
      html.raw("<li class=\"").text(assessment::name_of(standing)).raw("\"><a href=\"/progress?curriculum=");
      html.text(curriculum_id).raw("&amp;standing=").text(assessment::name_of(standing)).raw("\">");
      html.text(standing_text(standing)).raw(" <strong>");
      html.text(std::to_string(counts.of[static_cast<std::size_t>(standing)])).raw("</strong>");
      html.text(and_simulated_text(counts.simulated[static_cast<std::size_t>(standing)])).raw("</a></li>\n");
    }
    html.raw("</ul>\n");
  }
}

bool needs_somebody(const InNeed& one) {
  return one.found.standing == Standing::stuck || one.found.standing == Standing::absent ||
         one.found.standing == Standing::lapsed;
}

void add_in_need(Html& html, const std::vector<InNeed>& all, std::int64_t now_us) {
  const auto count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), needs_somebody));
  if (count == 0) {
    html.raw("<p>Nobody is stuck, absent or due for a test of retention.</p>\n");
    return;
  }
  html.raw(
      "<div class=\"wide\">\n<table class=\"list\">\n<caption>Who needs help</caption>\n<thead><tr><th "
      "scope=\"col\">Learner</th><th scope=\"col\">State</th><th scope=\"col\">Why</th></tr></thead>\n<tbody>\n");
  for (std::size_t i = 0; i < std::min(count, kMostInNeed); ++i) {  // they stand first
    const InNeed& one = all[i];
    html.raw("<tr><th scope=\"row\"><a href=\"/progress/").text(one.learner->person_id).raw("\">");
    html.name(one.learner->label).raw("</a>");
    if (one.learner->simulated) html.raw(" <span class=\"mark\">simulated</span>");
    html.raw("</th><td data-label=\"State\"><span class=\"mark standing ")
        .text(assessment::name_of(one.found.standing));
    html.raw("\">").text(standing_text(one.found.standing)).raw("</span></td><td data-label=\"Why\">");
    html.text(evidence_text(one.found, *one.record, now_us)).raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n</div>\n");
  if (count > kMostInNeed)
    html.raw("<p><a href=\"/progress\">")
        .text(std::to_string(count - kMostInNeed))
        .raw(" more among all learners</a></p>\n");
}

void add_learners(Html& html, const LeaderStart& start) {
  html.raw("<section>\n<h2>Learners</h2>\n");
  const std::vector<InNeed> all = everybody(start);
  if (start.learners.empty())
    html.raw(
        "<p>There are no learners in a cohort that you may see by name. Whoever runs this library adds learners "
        "with <code>seldinger cohort enrol</code>.</p>\n");
  else if (all.empty())
    html.raw("<p>No curriculum is published, so nothing is due.</p>\n");
  if (!all.empty()) {
    add_standings(html, all);
    add_in_need(html, all, start.now_us);
  }
  html.raw("</section>\n");
}

void add_reviews(Html& html, const std::vector<CaseInReview>& reviews) {
  html.raw("<section>\n<h2>Cases in review</h2>\n");
  if (reviews.empty()) html.raw("<p>None is waiting.</p>\n");
  if (!reviews.empty()) html.raw("<ul>\n");
  for (const CaseInReview& one : reviews) {
    html.raw("<li><a href=\"/cases/").text(one.case_id).raw("\">").name(one.title).raw("</a>: ");
    if (one.approved)
      html.text(one.for_reader ? "approved; you may publish it" : "approved; somebody else has to publish it");
    else
      html.text(one.for_reader ? "waits for your review" : "you submitted it; a second person has to review it");
    html.raw("</li>\n");
  }
  if (!reviews.empty())
    html.raw(
        "</ul>\n<p class=\"why\">In the case editor, or with <code>seldinger case approve</code> and <code>case "
        "publish</code>.</p>\n");
  html.raw("</section>\n");
}

void add_uncommented(Html& html, const std::vector<AttemptView>& attempts) {
  if (attempts.empty()) return;
  html.raw("<section>\n<h2>Not passed, and no comment yet</h2>\n<ul>\n");
  for (const AttemptView& one : attempts) {
    html.raw("<li><a href=\"").text(attempt_path(one.row.attempt_id)).raw("\">").name(one.operator_label).raw(", ");
    html.name(one.row.case_title).raw("</a>, ").text(told_text(one.row.started_us)).raw("</li>\n");
  }
  html.raw("</ul>\n</section>\n");
}

void add_drafts(Html& html, const std::vector<std::string>& drafts) {
  if (drafts.empty()) return;
  html.raw("<section>\n<h2>Curricula to publish</h2>\n<ul>\n");
  for (const std::string& title : drafts)
    html.raw("<li><a href=\"/curricula\">").name(title).raw("</a> is a draft</li>\n");
  html.raw("</ul>\n</section>\n");
}

std::string_view health_words(casedb::Health health) {
  switch (health) {
    case casedb::Health::ok:
      return "The library can be written.";
    case casedb::Health::moved:
      return "The library is no longer in its folder, or another one is there: nothing is stored.";
    case casedb::Health::full:
      return "There is less room left than an import needs.";
    case casedb::Health::read_only:
      return "The library cannot be written: nothing is stored.";
  }
  return "";
}

}  // namespace

std::string trainee_start_page(const Visitor& visitor, const TraineeStart& start) {
  Html html;
  html.raw("<h1>What is next</h1>\n");
  if (start.records->empty())
    html.raw("<div class=\"message\"><p>No curriculum is published yet, so nothing is due.</p></div>\n");
  for (const casedb::CurriculumRecord& record : *start.records) {
    html.raw("<section>\n<h2>").name(record.curriculum.title).raw("</h2>\n<p>").text(proficient_text(record.items));
    html.raw(" items proficient.</p>\n");
    const Html due = due_lines(record);
    if (due.empty())
      html.raw("<p>Nothing is due here.</p>\n");
    else
      html.add(due).raw("<p class=\"why\">At the simulator, or with <code>seldinger train</code>.</p>\n");
    html.raw("</section>\n");
  }
  if (start.last)
    add_last_attempt(html, *start.last);
  else
    html.raw("<p>You have made no attempt yet.</p>\n");
  add_said(html, start.said);
  html.raw(
      "<p><a href=\"/progress\">Your progress and learning curves</a> · <a href=\"/attempts\">All your "
      "attempts</a></p>\n");
  return page("What is next", visitor, html);
}

std::string leader_start_page(const Visitor& visitor, const LeaderStart& start) {
  Html html;
  html.raw("<h1>What waits for you</h1>\n");
  add_learners(html, start);
  add_drafts(html, start.drafts);
  add_reviews(html, start.reviews);
  add_uncommented(html, start.uncommented);
  return page("What waits for you", visitor, html);
}

std::string admin_start_page(const Visitor& visitor, const AdminStart& start) {
  Html html;
  html.raw("<h1>This server</h1>\n<p>").text(health_words(start.health)).raw("</p>\n<dl class=\"details\">\n");
  const auto row = [&](std::string_view name, const std::string& value) {
    html.raw("<div><dt>").text(name).raw("</dt><dd>").text(value).raw("</dd></div>\n");
  };
  row("Version", start.program_version);
  row("Accounts",
      std::to_string(start.open_accounts) + " open, " + std::to_string(start.closed_accounts) + " closed");
  row("Log-ins", start.delayed == 0 ? "nobody has to wait" : std::to_string(start.delayed) + " have to wait");
  html.raw(
      "</dl>\n<ul>\n<li><a href=\"/log-ins\">Who has to wait before the next try</a></li>\n<li><a "
      "href=\"/audit\">Who did what: the audit log</a></li>\n<li><a href=\"/cases\">Cases</a></li>\n<li><a "
      "href=\"/healthz\">Whether the server is up</a>, <a href=\"/openapi.json\">what it answers</a>: for "
      "programs</li>\n</ul>\n<p class=\"why\">Accounts are kept with <code>seldinger user</code>, backups with "
      "<code>seldinger backup</code>.</p>\n");
  return page("This server", visitor, html);
}

}  // namespace seldinger::reports
