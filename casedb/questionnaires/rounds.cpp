#include "casedb/questionnaires/rounds.h"

#include <algorithm>
#include <set>

#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/cohorts.h"
#include "casedb/questionnaires/drawn_word.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostGroups = 6;

base::Result<void> check_groups(const std::vector<std::string>& groups) {
  const base::Error bad{"bad_group", "a round has no groups, or two to six with different names"};
  if (groups.size() == 1 || groups.size() > kMostGroups) return bad;
  if (std::set<std::string>(groups.begin(), groups.end()).size() != groups.size()) return bad;
  for (const std::string& one : groups)
    if (!check_title(one)) return bad;
  return {};
}

std::vector<std::string> groups_of(Library& library, const std::string& round_id) {
  std::vector<std::string> groups;
  Statement rows = question(library.database(), "questionnaire_groups");
  for (rows.bind("round_id", round_id); rows.step();) groups.push_back(rows.text("group_name"));
  return groups;
}

}  // namespace

std::vector<Round> list_rounds(Library& library) {
  std::vector<Round> rounds;
  for (Statement rows = question(library.database(), "questionnaire_rounds"); rows.step();) {
    Round& one = rounds.emplace_back();
    one.round_id = rows.text("round_id");
    one.code = rows.text("code");
    one.title = rows.text("title");
    one.form_id = rows.text("form_id");
    one.version = rows.small_integer("version");
    if (!rows.is_null("study_id")) one.study_id = rows.text("study_id");
    if (!rows.is_null("opened_by")) one.opened_by = rows.text("opened_by");
    one.opened_us = rows.integer("opened_us");
    if (!rows.is_null("closed_us")) one.closed_us = rows.integer("closed_us");
    one.drafts = rows.small_integer("drafts");
    one.submitted = rows.small_integer("submitted");
    one.rated = rows.small_integer("rated") != 0;
    one.at_desk = rows.small_integer("at_desk") != 0;
    one.groups = groups_of(library, one.round_id);
  }
  return rounds;
}

base::Result<Round> find_round(Library& library, std::string_view code) {
  const std::string capitals = code_from(code);
  for (Round& one : list_rounds(library))
    if (one.code == capitals || one.round_id == code) return std::move(one);
  return base::Error{"no_round", "no questionnaire has that code"};
}

base::Result<Round> add_round(Library& library, const NewRound& made) {
  if (const auto fit = check_title(made.title); !fit) return fit.error();
  if (const auto fit = check_groups(made.groups); !fit) return fit.error();
  if (made.at_desk && !made.groups.empty())
    return base::Error{"bad_group", "at the workstation nobody is asked for a group: who answers is logged in"};
  const auto forms = find_forms(library, made.form_id, made.version);
  if (!forms) return forms.error();
  const std::string round_id = new_uuid();
  std::string code = drawn_code();
  while (find_round(library, code)) code = drawn_code();
  question(library.database(), "add_questionnaire_round")
      .bind("round_id", round_id)
      .bind("code", code)
      .bind("title", made.title)
      .bind("form_id", made.form_id)
      .bind("version", forms->front().form.version)
      .bind("study_id", made.study_id)
      .bind("now_us", now_us())
      .bind("opened_by", library.actor().person_id)
      .bind("at_desk", std::int64_t{made.at_desk ? 1 : 0})
      .run();
  Statement group = question(library.database(), "add_questionnaire_group");
  for (std::size_t i = 0; i < made.groups.size(); ++i) {
    group.bind("round_id", round_id)
        .bind("place", static_cast<std::int64_t>(i))
        .bind("group_name", made.groups[i])
        .run();
  }
  audit(library, Act::open_round, {"round", round_id});
  return find_round(library, code);
}

base::Result<Round> open_round(Library& library, const NewRound& made) {
  Transaction transaction(library.database());
  auto round = add_round(library, made);
  if (round) transaction.commit();
  return round;
}

base::Result<void> close_round(Library& library, const std::string& round_id) {
  Transaction transaction(library.database());
  const auto round = find_round(library, round_id);
  if (!round) return round.error();
  if (!round->is_open()) return base::Error{"round_closed", "the round is closed already"};
  question(library.database(), "close_questionnaire_round")
      .bind("round_id", round_id)
      .bind("now_us", now_us())
      .run();
  audit(library, Act::close_round, {"round", round_id});
  transaction.commit();
  return {};
}

}  // namespace seldinger::casedb
