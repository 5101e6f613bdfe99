// What people are to each other, by which the table of permissions (casedb/cases/permissions.h) decides who sees
// what: asked each time, so that who leaves a cohort or withdraws consent is out of sight at once.
#pragma once

#include <optional>
#include <string>
#include <unordered_map>

#include "casedb/database/library.h"

namespace seldinger::casedb {

// Whose something is, for one who asks.
struct Relation {
  bool own = false;
  bool own_cohort = false;     // of a learner in a cohort that the asking person leads as mentor, or the cohort
  bool own_programme = false;  // of a learner in a programme that the asking person directs, or of its cohorts
  bool own_study = false;      // of one who consents to a study on which the asking person works
  bool nobodys = false;        // of no person: a simulated operator's
  bool reached = false;        // a case: the asking person is among those for whom it was published
  bool agreed = false;         // of one whose consent to research with this library stands
  constexpr bool operator==(const Relation&) const noexcept = default;
};

// Of everybody who is not erased, to `reader_id`.
std::unordered_map<std::string, Relation> relations_of(Library& library, const std::string& reader_id);
// Of one; none: nobody's. Who is erased or unknown is nothing to anybody.
Relation relation_to(Library& library, const std::string& reader_id, const std::optional<std::string>& person_id);

// To a cohort: own_cohort when `reader_id` leads it, own_programme when they direct the programme. Of a cohort that
// is yet to be made, whose id is empty, only the latter.
Relation relation_to_cohort(Library& library, const std::string& reader_id, const std::string& cohort_id,
                            const std::string& programme);

// Whether a case that was published to a mentor's own cohort only reaches this person.
bool reaches_own_cohort(Library& library, const std::string& case_id, const std::string& person_id);

}  // namespace seldinger::casedb
