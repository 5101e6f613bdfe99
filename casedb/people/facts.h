// What people say of themselves, by which studies compare them: the questions that the midterm evaluation asked its
// participants (thesis, §6.3.2 and questionnaire C.2, items 4 to 6; its handedness is ours). One table: command,
// page and export loop over it. An answer holds from when it is given.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct FactInfo {
  std::string_view id;
  std::string_view words;             // the question
  std::string_view unit = {};         // empty: none
  bool whole = true;                  // a whole number; else one with decimals
  double least = 0.0, most = 0.0;     // of a number
  std::string_view choices = {};      // "left|right|both": one of these words in place of a number
  std::string_view least_words = {};  // what the ends of a scale mean
  std::string_view most_words = {};
  bool is_choice() const noexcept { return !choices.empty(); }
};
std::span<const FactInfo> fact_infos();
const FactInfo* find_fact(std::string_view id) noexcept;  // null: there is no such one
std::vector<std::string> choices_of(const FactInfo& fact);

// The answer as it is stored, digits without needless zeros: `unknown_fact`, `bad_answer` (with what is asked for).
base::Result<std::string> checked_answer(const std::string& fact_id, const std::string& answer);

struct FactGiven {
  std::string fact_id, answer;
  std::int64_t given_us = 0;
};
// All of them or none, by their ids: `no_person`, and as checked_answer; `bad_answer`, too, where more procedures
// would be independent than there were.
base::Result<void> give_facts(Library& library, const std::string& person_id,
                              const std::map<std::string, std::string>& answers);
base::Result<void> give_fact(Library& library, const std::string& person_id, const std::string& fact_id,
                             const std::string& answer);
std::vector<FactGiven> list_facts(Library& library, const std::string& person_id);  // oldest first
// The last answer to each.
std::map<std::string, FactGiven> newest_facts(const std::vector<FactGiven>& given);

}  // namespace seldinger::casedb
