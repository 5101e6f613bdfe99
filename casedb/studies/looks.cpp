#include "casedb/studies/looks.h"

#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/utf8.h"
#include "casedb/database/uuid.h"
#include "casedb/studies/plans.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostDeviation = 4'000;

Statement note_of(Library& library, const char* sql, const std::string& study_id) {
  Statement insert = question(library.database(), sql);
  insert.bind("study_id", study_id)
      .bind("now_us", now_us())
      .bind("actor", name_of(library.actor().kind))
      .bind("person_id", library.actor().person_id);
  return insert;
}

enum class Kind { look, deviation };

std::vector<StudyNote> notes_of(Library& library, Kind kind, const std::string& study_id) {
  const bool look = kind == Kind::look;
  std::vector<StudyNote> notes;
  Statement rows = question(library.database(), look ? "study_looks" : "study_deviations");
  for (rows.bind("study_id", study_id); rows.step();) {
    StudyNote& one = notes.emplace_back();
    one.number = rows.small_integer("number");
    one.at_us = rows.integer("at_us");
    one.actor = rows.text("actor");
    if (!rows.is_null("person_id")) one.pseudonym = rows.text("pseudonym");
    one.text = rows.text(look ? "query" : "body");
    if (look) one.people = rows.small_integer("people");
  }
  return notes;
}

}  // namespace

void note_look(Library& library, const std::string& study_id, const std::string& query, std::size_t people) {
  Transaction transaction(library.database());
  note_of(library, "add_study_look", study_id)
      .bind("query", query)
      .bind("people", static_cast<std::int64_t>(people))
      .run();
  audit(library, Act::look_at_study, {"study", study_id});
  transaction.commit();
}

std::vector<StudyNote> list_looks(Library& library, const std::string& study_id) {
  return notes_of(library, Kind::look, study_id);
}

base::Result<void> add_deviation(Library& library, const std::string& study_id, const std::string& text) {
  if (text.empty() || text.size() > kMostDeviation || !is_text(text))
    return base::Error{"bad_text", "a deviation has 1 to 4,000 bytes of UTF-8 text"};
  Transaction transaction(library.database());
  const auto stored = find_plan(library, study_id);
  if (!stored) return stored.error();
  if (!stored->frozen())
    return base::Error{"plan_not_frozen",
                       "a draft is replaced (`seldinger study plan`); from a frozen plan one deviates"};
  note_of(library, "add_study_deviation", study_id).bind("body", text).run();
  audit(library, Act::deviate_from_study, {"study", study_id});
  transaction.commit();
  return {};
}

std::vector<StudyNote> list_deviations(Library& library, const std::string& study_id) {
  return notes_of(library, Kind::deviation, study_id);
}

}  // namespace seldinger::casedb
