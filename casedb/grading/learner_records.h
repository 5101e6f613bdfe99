// How far somebody is in a curriculum, attempt by attempt: what they, their mentors and their directors ask
// (assessment/grading/standing.h).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assessment/grading/standing.h"
#include "casedb/database/library.h"
#include "casedb/grading/curriculum.h"

namespace seldinger::casedb {

struct ItemState : assessment::ItemRecord {
  // The version that is published now, of those that reach the person; empty id: none is, the title is the last
  // one's or says that none ever reached them.
  std::string case_id, title;
  int version = 0;
  int attempts = 0, passes = 0;  // over all versions
};
// In the items' order. Only what a person did counts (of a simulated person, what was simulated of them), each
// attempt by the rule of its own version: passes carry over to a new version of the case, attempts used up do not.
std::vector<ItemState> states_of(Library& library, const Curriculum& curriculum, const std::string& person_id);
// Nobody's: which cases the items are.
std::vector<ItemState> states_of(Library& library, const Curriculum& curriculum);

struct CurriculumRecord {
  Curriculum curriculum;
  std::vector<ItemState> items;  // in its items' order
};

// Of every published curriculum, oldest first. A person's attempts are read once.
std::vector<CurriculumRecord> records_of(Library& library, const std::string& person_id);

// Another text once records_of would answer something else: of that person's attempts, those running among them, of
// the last act that enrols them or ends that, and of the last that changes published cases, curricula or scores.
// Drafts, consent, accounts and other people's enrolments change it not. Five rows are read, whatever the library
// holds.
std::string records_mark(Library& library, const std::string& person_id);

assessment::StandingFound standing_in(const CurriculumRecord& record, std::int64_t now_us);

}  // namespace seldinger::casedb
