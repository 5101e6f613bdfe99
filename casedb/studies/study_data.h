// What a study's people did, as the analysis takes it, and how many came how far. Only of people who are enrolled
// and whose consent stands; who goes is gone from the next question on.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "assessment/study/analysis.h"
#include "casedb/database/library.h"
#include "casedb/people/consent.h"
#include "casedb/studies/enrolments.h"
#include "casedb/studies/plans.h"

namespace seldinger::casedb {

struct GroupFlow {
  std::string name;
  std::size_t allocated = 0, withdrew = 0, attempted = 0, analysed = 0;
};
struct ParticipantFlow {
  StudyPeople people{};  // now, enrolled or not
  std::size_t ever_enrolled = 0;
  std::size_t unknown = 0;        // enrolled, and erased since
  std::vector<GroupFlow> groups;  // in the plan's order
};

// What is known of somebody beside what they did.
struct Background {
  std::string group;                           // that they are enrolled in
  std::map<std::string, std::string> answers;  // by fact id, as they stood at the enrolment
  std::vector<std::string> sites;  // of the cohorts in which they are or were learners, each once, by name
};

struct StudyData {
  std::vector<assessment::study::StudyPerson> people;  // by their pseudonyms, in the order of enrolment
  std::map<std::string, Background> backgrounds;       // by pseudonym
  ParticipantFlow flow;                                // `analysed` by the first primary outcome
};
StudyData study_data(Library& library, const StoredPlan& stored);

// How many persons have an outcome, a failure too, at a primary one: what a look sees.
std::size_t people_with_outcome(const assessment::study::StudyResult& result);
// Of the analysis: fills in how many of each group were analysed at the first primary outcome.
void add_analysed(const assessment::study::StudyResult& result, ParticipantFlow& flow);

// What may be told before the freeze: counts of all together, whatever group they will be in.
struct BlindedCounts {
  StudyPeople people{};
  std::size_t with_attempts = 0;  // at the cases of the plan, of the plan's kind
  std::size_t attempts = 0;
};
BlindedCounts blinded_counts(Library& library, const StoredPlan& stored);

// SHA-256 of every value that was analysed, in a fixed form: two reports of the same data have the same.
std::string data_hash(const assessment::study::StudyResult& result);

}  // namespace seldinger::casedb
