#include "casedb/people/cohorts.h"

#include <algorithm>
#include <map>

#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/utf8.h"
#include "casedb/database/uuid.h"
#include "casedb/people/people.h"
#include "sim/base/check.h"
#include "sim/base/names.h"

namespace seldinger::casedb {
namespace {

constexpr auto kPosts = base::names<Post>({{Post::learner, "learner"}, {Post::mentor, "mentor"}});
constexpr std::size_t kMostTitle = 200;
const base::Error kNotEnrolled{"not_enrolled", "this person does not belong to it now"};
const base::Error kNoCohort{"no_cohort", "there is no such cohort"};

base::Result<void> check_cohort(Library& library, const std::string& cohort_id) {
  Statement row = question(library.database(), "cohort_exists");
  CHECK(row.bind("cohort_id", cohort_id).step());
  if (row.integer("found") == 0) return kNoCohort;
  return {};
}

}  // namespace

std::string name_of(Post post) {
  return std::string(base::name_of(kPosts, post));
}

std::optional<Post> post_from(const std::string& name) {
  return base::from_name(kPosts, name);
}

base::Result<void> check_title(const std::string& title) {
  const bool sound = !title.empty() && title.size() <= kMostTitle && is_text(title) &&
                     std::none_of(title.begin(), title.end(),
                                  [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; });
  if (!sound) return base::Error{"bad_title", "a title is one line of 1 to 200 bytes"};
  return {};
}

base::Result<std::string> add_cohort(Library& library, const std::string& title, const std::string& programme,
                                     const std::string& site) {
  for (const std::string& text : {title, programme})
    if (const auto fit = check_title(text); !fit) return fit.error();
  if (!site.empty())
    if (const auto fit = check_title(site); !fit) return fit.error();
  Transaction transaction(library.database());
  std::string cohort_id = new_uuid();
  {
    Statement insert = question(library.database(), "add_cohort");
    insert.bind("cohort_id", cohort_id).bind("title", title).bind("programme", programme).bind("site", site);
    if (!insert.bind("created_us", now_us()).step())
      return base::Error{"title_taken", "there is already a cohort of that title"};
    CHECK(!insert.step());
  }
  audit(library, Act::make_cohort, {"cohort", cohort_id});
  transaction.commit();
  return cohort_id;
}

namespace {

// `learners` asks for cohort_id, person_id, still, attempts, with_hit and hits.
std::vector<Cohort> read_cohorts(Library& library, std::string_view learners_question) {
  const Snapshot snapshot(library.database());
  std::vector<Cohort> cohorts;
  Statement rows = question(library.database(), "cohorts");
  while (rows.step())
    cohorts.push_back({rows.text("cohort_id"), rows.text("title"), rows.text("programme"), rows.text("site"), {}});
  std::map<std::string, Cohort*> by_id;
  for (Cohort& one : cohorts) by_id.emplace(one.cohort_id, &one);
  Statement learners = question(library.database(), learners_question);
  while (learners.step())
    by_id.at(learners.text("cohort_id"))
        ->learners.push_back({learners.text("person_id"), learners.integer("still") != 0,
                              learners.small_integer("attempts"), learners.small_integer("with_hit"),
                              learners.small_integer("hits"), learners.integer("simulated") != 0});
  return cohorts;
}

}  // namespace

std::vector<Cohort> list_cohorts(Library& library) {
  return read_cohorts(library, "learners_of_cohorts");
}

std::vector<Cohort> list_members(Library& library) {
  return read_cohorts(library, "members_of_cohorts");
}

base::Result<Cohort> find_cohort(Library& library, const std::string& title_or_id) {
  for (Cohort& one : list_cohorts(library))
    if (one.title == title_or_id || one.cohort_id == title_or_id) return std::move(one);
  return kNoCohort;
}

std::vector<Enrolment> list_enrolments(Library& library, const std::string& cohort_id) {
  std::vector<Enrolment> enrolments;
  Statement rows = question(library.database(), "enrolments");
  for (rows.bind("cohort_id", cohort_id); rows.step();) {
    const auto post = post_from(rows.text("post"));
    CHECK(post.has_value());
    enrolments.push_back({rows.text("person_id"), rows.text("pseudonym"), *post, rows.integer("from_us"),
                          rows.is_null("to_us") ? std::nullopt : std::optional(rows.integer("to_us")),
                          rows.integer("simulated") != 0});
  }
  return enrolments;
}

base::Result<void> enrol(Library& library, const std::string& cohort_id, const std::string& person_id, Post post) {
  Transaction transaction(library.database());
  if (const auto known = check_person(library, person_id); !known) return known.error();
  if (const auto cohort = check_cohort(library, cohort_id); !cohort) return cohort.error();
  for (const Enrolment& one : list_enrolments(library, cohort_id))
    if (one.person_id == person_id && one.post == post && !one.to_us) return {};
  question(library.database(), "add_enrolment")
      .bind("cohort_id", cohort_id)
      .bind("person_id", person_id)
      .bind("post", name_of(post))
      .bind("from_us", now_us())
      .run();
  audit(library, Act::enrol, {"person", person_id});
  transaction.commit();
  return {};
}

base::Result<void> end_enrolment(Library& library, const std::string& cohort_id, const std::string& person_id) {
  Transaction transaction(library.database());
  int ended = 0;
  {
    Statement end = question(library.database(), "end_enrolments");
    for (end.bind("cohort_id", cohort_id).bind("person_id", person_id).bind("to_us", now_us()); end.step();)
      ++ended;
  }
  if (ended == 0) return kNotEnrolled;
  audit(library, Act::end_enrolment, {"person", person_id});
  transaction.commit();
  return {};
}

base::Result<void> appoint_director(Library& library, const std::string& programme, const std::string& person_id) {
  if (const auto fit = check_title(programme); !fit) return fit.error();
  Transaction transaction(library.database());
  if (const auto known = check_person(library, person_id); !known) return known.error();
  question(library.database(), "add_director")
      .bind("programme", programme)
      .bind("person_id", person_id)
      .bind("from_us", now_us())
      .run();
  audit(library, Act::appoint_director, {"person", person_id});
  transaction.commit();
  return {};
}

base::Result<void> end_director(Library& library, const std::string& programme, const std::string& person_id) {
  Transaction transaction(library.database());
  int ended = 0;
  {
    Statement end = question(library.database(), "end_director");
    for (end.bind("programme", programme).bind("person_id", person_id).bind("to_us", now_us()); end.step();)
      ++ended;
  }
  if (ended == 0) return kNotEnrolled;
  audit(library, Act::end_director, {"person", person_id});
  transaction.commit();
  return {};
}

CohortCells cells_of(const Cohort& cohort) {
  CohortCells cells;
  for (const Learner& one : cohort.learners) {
    if (!one.still || one.simulated) continue;
    ++cells.learners;
    cells.attempts += one.attempts;
    cells.with_hit += one.with_hit;
    cells.hits += one.hits;
  }
  cells.simulated = simulated_learners(cohort);
  return cells;
}

int simulated_learners(const Cohort& cohort) {
  return static_cast<int>(std::count_if(cohort.learners.begin(), cohort.learners.end(),
                                        [](const Learner& one) { return one.still && one.simulated; }));
}

}  // namespace seldinger::casedb
