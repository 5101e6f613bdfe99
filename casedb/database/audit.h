// The audit log: who did what to which thing, when, and whether it was refused; by ids and codes, never a name nor
// anything typed. Each row carries the SHA-256 of itself and of the row before it; how many rows there are and the
// last hash stand a second time in audit_head. What that shows, and what it cannot, is told in docs/keeping.md.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/database/actor.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

enum class Act {
  // People.
  log_in,
  log_out,
  add_account,
  set_password,
  make_password_link,
  set_role,
  set_level,
  enable_account,
  disable_account,
  let_in_again,
  unproven,     // --by a name without a password or a session
  not_allowed,  // the table of permissions refused; the object is the action
  comment_attempt,
  cause_event,
  // Cases.
  add_case,
  change_case,  // lesions, structures, label maps, setting, title
  confirm_no_burned_in_text,
  overrule_face,
  submit_case,
  return_case,
  approve_case,
  publish_case,
  retire_case,
  make_case_version,
  // Curricula and standards.
  make_curriculum,
  change_curriculum,
  publish_curriculum,
  remove_curriculum,
  retire_curriculum,
  set_standard,
  propose_cut,
  freeze_cut,
  // Cohorts, studies, consent.
  make_cohort,
  enrol,
  end_enrolment,
  appoint_director,
  end_director,
  make_study,
  appoint_researcher,
  end_researcher,
  plan_study,
  freeze_study,
  enrol_in_study,
  look_at_study,
  deviate_from_study,
  lock_study_data,
  store_questionnaire,
  open_round,
  close_round,
  import_responses,
  simulate_answers,
  export_responses,
  open_workshop,
  close_workshop,
  admit_to_workshop,
  tick_in_workshop,
  add_consent_text,
  give_consent,
  withdraw_consent,
  give_fact,
  // What leaves and what goes.
  export_attempts,
  export_cases,
  import_cases,
  trust_key,
  distrust_key,
  back_up,
  restore,
  erase_person,
  erase_attempts,
  erase_case,
  // The program.
  recompute,
  repair,
  accept_damaged,
  start_server,
};
inline constexpr std::size_t kActs = static_cast<std::size_t>(Act::start_server) + 1;
std::string_view name_of(Act act);         // the code in the log
std::string_view words_of(Act act);        // for who reads it
std::string_view name_of(ActorKind kind);  // "nobody", "operator", "person"

struct Object {
  std::string_view kind{};  // "case", "person", …; empty: none
  std::string_view id{};
};

enum class Outcome { done, refused };

// Within the transaction of the act itself (CHECKed): stored with it or not at all. By whom the library acts for.
void audit(Library& library, Act act, const Object& object, Outcome outcome = Outcome::done);
void audit(Library& library, const Actor& actor, Act act, const Object& object, Outcome outcome = Outcome::done);
// In a transaction of its own: what changes no other row. Of a library that cannot be written nothing is kept.
void audit_alone(Library& library, Act act, const Object& object = {}, Outcome outcome = Outcome::done);
void audit_alone(Library& library, const Actor& actor, Act act, const Object& object, Outcome outcome);

struct AuditRow {
  std::int64_t sequence = 0, at_us = 0;
  std::string actor;
  std::optional<std::string> person_id;
  std::string act, object, object_id, result, hash;
};
std::vector<AuditRow> list_audit(Library& library, std::int64_t since_us = 0);  // oldest first

// Whether the operator did that last to the thing, not the person named with it.
bool entered_by_operator(Sqlite& database, Act act, std::string_view object_id);

struct AuditHead {
  std::int64_t count = 0;
  std::string hash;
};
AuditHead audit_head(Library& library);

// Whether the row that was the last then still is as it was.
bool still_stands(Library& library, const AuditHead& noted);

// `audit_changed`, `audit_missing`, `audit_cut`; empty when every row is as it was written.
std::vector<base::Problem> problems_of_audit(Library& library);

}  // namespace seldinger::casedb
