#include "casedb/questionnaires/desk_rounds.h"

#include <algorithm>

#include "casedb/attempts/attempts.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

std::string pseudonym_of(Library& library, const std::string& person_id) {
  Statement row = question(library.database(), "pseudonym_of");
  CHECK(row.bind("person_id", person_id).step());
  return row.text("pseudonym");
}

}  // namespace

std::vector<Round> due_at_desk(Library& library, const std::string& person_id) {
  const Snapshot snapshot(library.database());
  std::vector<Round> due;
  Statement rows = question(library.database(), "rounds_due_at_desk");
  for (rows.bind("person_id", person_id).bind("operator", kPersonOperator); rows.step();) {
    auto round = find_round(library, rows.text("round_id"));
    CHECK(round.has_value());
    due.push_back(std::move(*round));
  }
  return due;
}

base::Result<BegunSet> begin_set_of(Library& library, const Round& round, const std::string& person_id,
                                    const std::string& group) {
  auto made = begin_set(
      library, round,
      {.code = round.study_id ? pseudonym_of(library, person_id) : std::string(), .group = group, .language = ""});
  if (!made) return made.error();
  question(library.database(), "add_desk_response")
      .bind("response_id", made->response_id)
      .bind("round_id", round.round_id)
      .bind("person_id", person_id)
      .run();
  return made;
}

base::Result<std::string> answer_at_desk(Library& library, const std::string& round_id,
                                         const std::string& person_id) {
  Transaction transaction(library.database());
  const auto round = find_round(library, round_id);
  if (!round) return round.error();
  const auto due = due_at_desk(library, person_id);
  if (std::none_of(due.begin(), due.end(), [&](const Round& one) { return one.round_id == round->round_id; }))
    return base::Error{"not_due", "this questionnaire is not to be answered now"};
  std::string begun;
  {
    Statement row = question(library.database(), "desk_response");
    if (row.bind("round_id", round->round_id).bind("person_id", person_id).step()) begun = row.text("response_id");
  }
  std::string secret;
  if (!begun.empty()) {
    secret = new_draft_secret();
    question(library.database(), "set_draft_key")
        .bind("response_id", begun)
        .bind("draft_key", draft_key(secret))
        .run();
  } else {
    const auto made = begin_set_of(library, *round, person_id, "");
    if (!made) return made.error();
    secret = made->secret;
  }
  transaction.commit();
  return secret;
}

}  // namespace seldinger::casedb
