// Cohorts of learners with their mentors, and the programmes to which they belong. A title or a programme is one
// line of 1 to 200 bytes. Times are microseconds since 1970 UTC. Every write is one transaction.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// A cell of a table about people is shown when it counts at least this many of them.
constexpr int kSmallestCell = 5;

enum class Post { learner, mentor };
std::string name_of(Post post);
std::optional<Post> post_from(const std::string& name);

struct Cohort {
  std::string cohort_id, title, programme, site;
  int learners = 0;              // now
  int attempts = 0;              // of these learners, made by themselves
  int people_with_attempts = 0;  // how many of them have made any
  int with_hit = 0, hits = 0;    // of the attempts: whose hit is known, and those that hit
};

struct Enrolment {
  std::string person_id, pseudonym;
  Post post = Post::learner;
  std::int64_t from_us = 0;
  std::optional<std::int64_t> to_us;
};

// One line of 1 to 200 bytes: else `bad_title`.
base::Result<void> check_title(const std::string& title);

base::Result<std::string> add_cohort(Library& library, const std::string& title, const std::string& programme,
                                     const std::string& site);                       // `bad_title`, `title_taken`
std::vector<Cohort> list_cohorts(Library& library);                                  // by programme and title
base::Result<Cohort> find_cohort(Library& library, const std::string& title_or_id);  // `no_cohort`
std::vector<Enrolment> list_enrolments(Library& library, const std::string& cohort_id);

// From now on; who is in it already keeps that and has the other post beside it.
base::Result<void> enrol(Library& library, const std::string& cohort_id, const std::string& person_id, Post post);
// From now on out of it: `not_enrolled`.
base::Result<void> end_enrolment(Library& library, const std::string& cohort_id, const std::string& person_id);
base::Result<void> appoint_director(Library& library, const std::string& programme, const std::string& person_id);
base::Result<void> end_director(Library& library, const std::string& programme,
                                const std::string& person_id);  // `not_enrolled`

// The cohort as one sees it who may not see its people: counts of attempts and hits only where at least
// kSmallestCell people made them, and nothing at all of a cohort with fewer learners. What is withheld is -1.
Cohort suppressed(Cohort cohort);

}  // namespace seldinger::casedb
