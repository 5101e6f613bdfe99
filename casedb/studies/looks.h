// What a reader of a study has to know of how it was made: every look at outcomes by group, and everything that was
// done otherwise than planned. Appended, never edited; the database refuses both.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct StudyNote {
  int number = 1;
  std::int64_t at_us = 0;
  std::string actor;                     // "person", "operator", "nobody"
  std::optional<std::string> pseudonym;  // of the person, or in whose name the operator acted
  std::string text;                      // of a look what was asked, of a deviation what was typed
  int people = 0;                        // of a look: with an outcome by then
};

// By whom the library acts for, now.
void note_look(Library& library, const std::string& study_id, const std::string& query, std::size_t people);
std::vector<StudyNote> list_looks(Library& library, const std::string& study_id);

// `no_plan`, `plan_not_frozen` (a draft is changed itself), `bad_text` (1 to 4,000 bytes of text).
base::Result<void> add_deviation(Library& library, const std::string& study_id, const std::string& text);
std::vector<StudyNote> list_deviations(Library& library, const std::string& study_id);

}  // namespace seldinger::casedb
