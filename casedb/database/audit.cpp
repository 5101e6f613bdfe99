#include "casedb/database/audit.h"

#include <limits>
#include <span>

#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

struct ActRow {
  Act act;
  std::string_view name, words;
};

constexpr ActRow kActRows[] = {
    {Act::log_in, "log_in", "logs in"},
    {Act::log_out, "log_out", "logs out"},
    {Act::add_account, "add_account", "adds an account"},
    {Act::set_password, "set_password", "sets a password"},
    {Act::make_password_link, "make_password_link", "makes a one-time link to set a password"},
    {Act::set_role, "set_role", "changes a role"},
    {Act::set_level, "set_level", "says who is a consultant"},
    {Act::enable_account, "enable_account", "opens an account again"},
    {Act::disable_account, "disable_account", "closes an account"},
    {Act::let_in_again, "let_in_again", "lets somebody try again at once"},
    {Act::unproven, "unproven", "names a person without proof"},
    {Act::not_allowed, "not_allowed", "asks for what the role may not"},
    {Act::comment_attempt, "comment_attempt", "comments on an attempt"},
    {Act::cause_event, "cause_event", "lets something happen to the patient"},
    {Act::add_case, "add_case", "imports a case"},
    {Act::change_case, "change_case", "changes a draft"},
    {Act::confirm_no_burned_in_text, "confirm_no_burned_in_text", "confirms that no text is burned in"},
    {Act::overrule_face, "overrule_face", "says that what looks like a face is none"},
    {Act::submit_case, "submit_case", "submits a case"},
    {Act::return_case, "return_case", "returns a case"},
    {Act::approve_case, "approve_case", "approves a case"},
    {Act::publish_case, "publish_case", "publishes a case"},
    {Act::retire_case, "retire_case", "retires a case"},
    {Act::make_case_version, "make_case_version", "makes a new version"},
    {Act::make_curriculum, "make_curriculum", "makes a curriculum"},
    {Act::change_curriculum, "change_curriculum", "adds to a curriculum"},
    {Act::publish_curriculum, "publish_curriculum", "publishes a curriculum"},
    {Act::remove_curriculum, "remove_curriculum", "takes a curriculum away"},
    {Act::retire_curriculum, "retire_curriculum", "retires a curriculum"},
    {Act::set_standard, "set_standard", "sets a standard"},
    {Act::propose_cut, "propose_cut", "proposes a cut"},
    {Act::freeze_cut, "freeze_cut", "freezes a cut that somebody else proposed"},
    {Act::make_cohort, "make_cohort", "makes a cohort"},
    {Act::enrol, "enrol", "enrols somebody"},
    {Act::end_enrolment, "end_enrolment", "ends an enrolment"},
    {Act::appoint_director, "appoint_director", "appoints a director"},
    {Act::end_director, "end_director", "ends an appointment"},
    {Act::make_study, "make_study", "makes a study"},
    {Act::appoint_researcher, "appoint_researcher", "lets a researcher work on a study"},
    {Act::end_researcher, "end_researcher", "ends a researcher's work on a study"},
    {Act::plan_study, "plan_study", "stores the plan of a study"},
    {Act::freeze_study, "freeze_study", "freezes the plan of a study"},
    {Act::enrol_in_study, "enrol_in_study", "enrols somebody in a study"},
    {Act::look_at_study, "look_at_study", "looks at a study's outcomes by group"},
    {Act::deviate_from_study, "deviate_from_study", "notes a deviation from a plan"},
    {Act::lock_study_data, "lock_study_data", "locks the data of a study"},
    {Act::store_questionnaire, "store_questionnaire", "stores a questionnaire"},
    {Act::open_round, "open_round", "opens a questionnaire to be answered"},
    {Act::close_round, "close_round", "closes a round of a questionnaire"},
    {Act::import_responses, "import_responses", "takes in answers from paper"},
    {Act::simulate_answers, "simulate_answers", "lets simulated people answer"},
    {Act::export_responses, "export_responses", "exports answers to a questionnaire"},
    {Act::open_workshop, "open_workshop", "opens a workshop's day"},
    {Act::close_workshop, "close_workshop", "closes a workshop's day"},
    {Act::admit_to_workshop, "admit_to_workshop", "admits somebody to a workshop's day"},
    {Act::tick_in_workshop, "tick_in_workshop", "ticks a station of a workshop's day"},
    {Act::add_consent_text, "add_consent_text", "adds a consent text"},
    {Act::give_consent, "give_consent", "consents"},
    {Act::withdraw_consent, "withdraw_consent", "withdraws consent"},
    {Act::give_fact, "give_fact", "states experience"},
    {Act::export_attempts, "export_attempts", "exports attempts"},
    {Act::export_cases, "export_cases", "writes a bundle"},
    {Act::import_cases, "import_cases", "takes cases from a bundle"},
    {Act::trust_key, "trust_key", "trusts the key that signs a site's bundles"},
    {Act::distrust_key, "distrust_key", "trusts such a key no longer"},
    {Act::back_up, "back_up", "backs the library up"},
    {Act::restore, "restore", "restores a backup"},
    {Act::erase_person, "erase_person", "erases a person"},
    {Act::erase_attempts, "erase_attempts", "erases attempts"},
    {Act::erase_case, "erase_case", "deletes a case"},
    {Act::recompute, "recompute", "scores attempts again"},
    {Act::repair, "repair", "repairs the library"},
    {Act::accept_damaged, "accept_damaged", "takes a damaged value as it is"},
    {Act::start_server, "start_server", "starts the server"},
};

constexpr bool rows_are_in_the_order_of_the_acts() {
  for (std::size_t i = 0; i < std::size(kActRows); ++i)
    if (kActRows[i].act != static_cast<Act>(i)) return false;
  return std::size(kActRows) == kActs;
}
static_assert(rows_are_in_the_order_of_the_acts());

constexpr std::string_view kActorNames[] = {"nobody", "operator", "person"};  // in the order of ActorKind
constexpr std::string_view kOutcomes[] = {"done", "refused"};                 // in the order of Outcome

// No field holds a line's end: each is a number, a code or an id.
std::string hash_of(const AuditRow& row, const std::string& before) {
  const std::string fields[] = {before,
                                std::to_string(row.sequence),
                                std::to_string(row.at_us),
                                row.actor,
                                row.person_id.value_or(""),
                                row.act,
                                row.object,
                                row.object_id,
                                row.result};
  std::string text;
  for (const std::string& field : fields) text += field + '\n';
  return sha256_hex(std::as_bytes(std::span(text)));
}

AuditRow read_row(const Statement& from) {
  return {
      from.integer("sequence"), from.integer("at_us"),
      from.text("actor"),       from.is_null("person_id") ? std::nullopt : std::optional(from.text("person_id")),
      from.text("act"),         from.text("object"),
      from.text("object_id"),   from.text("result"),
      from.text("hash")};
}

const std::string& beginning() {
  static const std::string zeros(64, '0');
  return zeros;
}

}  // namespace

std::string_view name_of(Act act) {
  return kActRows[static_cast<std::size_t>(act)].name;
}
std::string_view words_of(Act act) {
  return kActRows[static_cast<std::size_t>(act)].words;
}
std::string_view name_of(ActorKind kind) {
  return kActorNames[static_cast<std::size_t>(kind)];
}

void audit(Library& library, const Actor& actor, Act act, const Object& object, Outcome outcome) {
  Sqlite& database = library.database();
  CHECK(database.in_transaction());
  const AuditHead head = audit_head(library);
  AuditRow row{head.count + 1,
               now_us(),
               std::string(name_of(actor.kind)),
               actor.person_id,
               std::string(name_of(act)),
               std::string(object.kind),
               std::string(object.id),
               std::string(kOutcomes[static_cast<std::size_t>(outcome)]),
               {}};
  row.hash = hash_of(row, head.hash);
  question(database, "add_audit")
      .bind("sequence", row.sequence)
      .bind("at_us", row.at_us)
      .bind("actor", row.actor)
      .bind("person_id", row.person_id)
      .bind("act", row.act)
      .bind("object", row.object)
      .bind("object_id", row.object_id)
      .bind("result", row.result)
      .bind("hash", row.hash)
      .run();
  question(database, "set_audit_head").bind("count", row.sequence).bind("hash", row.hash).run();
}

void audit(Library& library, Act act, const Object& object, Outcome outcome) {
  audit(library, library.actor(), act, object, outcome);
}

void audit_alone(Library& library, Act act, const Object& object, Outcome outcome) {
  audit_alone(library, library.actor(), act, object, outcome);
}

void audit_alone(Library& library, const Actor& actor, Act act, const Object& object, Outcome outcome) {
  if (library.database().read_only()) return;
  Transaction transaction(library.database());
  audit(library, actor, act, object, outcome);
  transaction.commit();
}

std::vector<AuditRow> list_audit(Library& library, std::int64_t since_us) {
  std::vector<AuditRow> all;
  Statement rows = question(library.database(), "audit_rows");
  for (rows.bind("since_us", since_us); rows.step();) all.push_back(read_row(rows));
  return all;
}

bool entered_by_operator(Sqlite& database, Act act, std::string_view object_id) {
  Statement row = question(database, "last_audit_of");
  row.bind("act", name_of(act)).bind("object_id", object_id);
  return row.step() && row.text("actor") == name_of(ActorKind::library_operator);
}

AuditHead audit_head(Library& library) {
  Statement row = question(library.database(), "audit_head");
  if (!row.step()) return {0, beginning()};
  return {row.integer("count"), row.text("hash")};
}

bool still_stands(Library& library, const AuditHead& noted) {
  if (noted.count == 0) return noted.hash == beginning();
  Statement row = question(library.database(), "audit_hash");
  return row.bind("sequence", noted.count).step() && row.text("hash") == noted.hash;
}

std::vector<base::Problem> problems_of_audit(Library& library) {
  std::vector<base::Problem> problems;
  const Snapshot snapshot(library.database());
  std::int64_t sequence = 0;
  std::string before = beginning();
  Statement rows = question(library.database(), "audit_rows");
  for (rows.bind("since_us", std::numeric_limits<std::int64_t>::min()); rows.step();) {
    const AuditRow row = read_row(rows);
    const bool follows = row.sequence == sequence + 1;
    if (!follows)
      problems.push_back({"audit_missing", "the audit log lacks what came after row " + std::to_string(sequence) +
                                               ", before row " + std::to_string(row.sequence)});
    else if (row.hash != hash_of(row, before))
      problems.push_back(
          {"audit_changed", "row " + std::to_string(row.sequence) + " of the audit log is not as it was written"});
    sequence = row.sequence;
    before = row.hash;
  }
  const AuditHead head = audit_head(library);
  if (head.count != sequence)
    problems.push_back({"audit_cut", "the audit log has " + std::to_string(sequence) + " rows, " +
                                         std::to_string(head.count) + " were written"});
  else if (head.hash != before)
    problems.push_back({"audit_changed", "the end of the audit log is not as it was written"});
  return problems;
}

}  // namespace seldinger::casedb
