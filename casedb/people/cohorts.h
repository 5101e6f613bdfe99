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

// What a learner did by themselves while in a cohort: neither coming to it nor leaving it changes its sums.
struct Learner {
  std::string person_id;
  bool still = true;  // in it now
  int attempts = 0;
  int with_hit = 0, hits = 0;  // of the attempts: whose hit is known, and those that hit
  bool simulated = false;
};

struct Cohort {
  std::string cohort_id, title, programme, site;
  std::vector<Learner> learners;  // also those who left
};

// What is told of a cohort; −1: withheld.
struct CohortCells {
  int learners = 0;  // now; people
  int attempts = 0;
  int with_hit = 0, hits = 0;
  int simulated = 0;  // learners now, who are nobody
  constexpr bool operator==(const CohortCells&) const noexcept = default;
};

struct Enrolment {
  std::string person_id, pseudonym;
  Post post = Post::learner;
  std::int64_t from_us = 0;
  std::optional<std::int64_t> to_us;
  bool simulated = false;  // who is nobody
};

// One line of 1 to 200 bytes of UTF-8: else `bad_title`.
base::Result<void> check_title(const std::string& title);

base::Result<std::string> add_cohort(Library& library, const std::string& title, const std::string& programme,
                                     const std::string& site);  // `bad_title`, `title_taken`
std::vector<Cohort> list_cohorts(Library& library);             // by programme and title
std::vector<Cohort> list_members(Library& library);  // the same, without what they did, which is long to count
base::Result<Cohort> find_cohort(Library& library, const std::string& title_or_id);  // `no_cohort`
std::vector<Enrolment> list_enrolments(Library& library, const std::string& cohort_id);

// From now on; who is in it already keeps that and has the other post beside it.
base::Result<void> enrol(Library& library, const std::string& cohort_id, const std::string& person_id, Post post);
// From now on out of it, in whatever post: `not_enrolled`.
base::Result<void> end_enrolment(Library& library, const std::string& cohort_id, const std::string& person_id);
base::Result<void> appoint_director(Library& library, const std::string& programme, const std::string& person_id);
base::Result<void> end_director(Library& library, const std::string& programme,
                                const std::string& person_id);  // `not_enrolled`

// For who sees its people: of those who are in it now. For others: told_cells.h.
CohortCells cells_of(const Cohort& cohort);
int simulated_learners(const Cohort& cohort);  // now

}  // namespace seldinger::casedb
