// A round is one version of a questionnaire, answered at one occasion (a workshop's day, a visit of a study) under
// a short code that is read aloud or stands on a poster.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/database/library.h"
#include "casedb/questionnaires/forms.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct Round {
  std::string round_id, code, title, form_id;
  int version = 1;
  std::optional<std::string> study_id, opened_by;
  std::int64_t opened_us = 0;
  std::optional<std::int64_t> closed_us;
  std::vector<std::string> groups;  // that a respondent chooses from; none: nobody is asked
  int drafts = 0, submitted = 0;
  bool rated = false;    // by raters (casedb/ratings): nobody else answers
  bool at_desk = false;  // at the workstation, after an attempt (desk_rounds.h), and nowhere else
  bool is_open() const noexcept { return !closed_us.has_value(); }
};

struct NewRound {
  std::string title, form_id;
  int version = 0;  // 0: the newest
  std::optional<std::string> study_id{};
  std::vector<std::string> groups{};
  bool at_desk = false;
};
// `bad_title`, `bad_group` (also at the desk, where nobody is asked for one), `no_form`.
base::Result<Round> open_round(Library& library, const NewRound& made);
// The same, within a transaction of the caller's.
base::Result<Round> add_round(Library& library, const NewRound& made);
// Nobody begins or goes on from now on: `no_round`, `round_closed`.
base::Result<void> close_round(Library& library, const std::string& round_id);
std::vector<Round> list_rounds(Library& library);  // newest first
// By its code, in capitals or not: `no_round`.
base::Result<Round> find_round(Library& library, std::string_view code);

}  // namespace seldinger::casedb
