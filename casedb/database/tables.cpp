#include "casedb/database/tables.h"

#include <algorithm>
#include <array>

namespace seldinger::casedb {
namespace {

constexpr std::string_view kAssetEnding = "_sha256";
constexpr std::string_view kOfCase = "case_id = :case_id";
// Also what was done about faces and burned-in text: here, or in the library that it came from.
constexpr std::array<std::string_view, 7> kChanging{"title",
                                                    "state",
                                                    "audience",
                                                    "face_state",
                                                    "burned_in_checked_us",
                                                    "burned_in_by_operator",
                                                    "burned_in_checked_by"};

constexpr TravellingTable kTravelling[] = {
    {"training_case", kOfCase, kChanging}, {"case_attribute", kOfCase, {}},   {"case_warning", kOfCase, {}},
    {"case_dropped", kOfCase, {}},         {"lesion", kOfCase, {}},           {"structure", kOfCase, {}},
    {"case_label_map", kOfCase, {}},       {"case_preparation", kOfCase, {}},
};
constexpr std::string_view kStaying[] = {"person",
                                         "account",
                                         "attempt",
                                         "recording_chunk",
                                         "metric_value",
                                         "open_attempt",
                                         "open_chunk",
                                         "asked_event",
                                         "servo_record",
                                         "case_decision",
                                         "attempt_step",
                                         "person_level",
                                         "curriculum",
                                         "curriculum_item",
                                         "curriculum_gate",
                                         "cohort",
                                         "enrolment",
                                         "programme_director",
                                         "case_cohort",
                                         "case_received",
                                         "trusted_key",
                                         "person_fact",
                                         "simulated_truth",
                                         "study",
                                         "study_researcher",
                                         "study_plan",
                                         "study_stratum",
                                         "study_enrolment",
                                         "study_look",
                                         "study_deviation",
                                         "study_lock",
                                         "attempt_comment",
                                         "questionnaire",
                                         "questionnaire_round",
                                         "questionnaire_group",
                                         "response_set",
                                         "response",
                                         "desk_response",
                                         "workshop",
                                         "workshop_station",
                                         "workshop_group",
                                         "workshop_participant",
                                         "workshop_tick",
                                         "rating_round",
                                         "rating_rater",
                                         "rating_view",
                                         "rating_known",
                                         "rating",
                                         "consent_text",
                                         "consent",
                                         "erasure",
                                         "erased_attempt",
                                         "erasing",
                                         "attempt_condition",
                                         "open_attempt_condition",
                                         "replay_watched",
                                         "cut",
                                         "standard",
                                         "standard_attempt",
                                         "standard_band",
                                         "login_session",
                                         "web_session",
                                         "password_link",
                                         "audit",
                                         "audit_head",
                                         "digest"};

}  // namespace

std::span<const TravellingTable> travelling_tables() {
  return kTravelling;
}

std::span<const std::string_view> staying_tables() {
  return kStaying;
}

std::vector<std::string> tables_of(Sqlite& database) {
  std::vector<std::string> names;
  for (Statement rows = database.prepare("SELECT name FROM sqlite_schema WHERE type = 'table' AND "
                                         "name NOT LIKE 'sqlite^_%' ESCAPE '^' ORDER BY name");
       rows.step();)
    names.push_back(rows.text("name"));
  return names;
}

std::vector<std::string> columns_of(Sqlite& database, std::string_view table) {
  std::vector<std::string> names;
  Statement rows = database.prepare("SELECT name FROM pragma_table_info(:name) ORDER BY cid");
  for (rows.bind("name", table); rows.step();) names.push_back(rows.text("name"));
  return names;
}

std::set<std::string> columns_to_staying_tables(Sqlite& database, std::string_view table) {
  std::set<std::string> names;
  Statement rows =
      database.prepare("SELECT \"table\" AS other, \"from\" AS name FROM pragma_foreign_key_list(:name)");
  for (rows.bind("name", table); rows.step();)
    if (std::ranges::find(kStaying, rows.view("other")) != std::end(kStaying)) names.insert(rows.text("name"));
  return names;
}

std::vector<Reference> references_to(Sqlite& database, const std::string& table) {
  std::vector<Reference> found;
  for (const std::string& one : tables_of(database)) {
    Statement rows = database.prepare(
        "SELECT \"from\" AS name FROM pragma_foreign_key_list(:name) WHERE \"table\" = :other AND id NOT IN "
        "(SELECT id FROM pragma_foreign_key_list(:name) WHERE seq > 0) ORDER BY name");
    for (rows.bind("name", one).bind("other", table); rows.step();) found.push_back({one, rows.text("name")});
  }
  return found;
}

std::vector<AssetColumn> asset_columns(Sqlite& database) {
  std::vector<AssetColumn> found;
  for (const std::string& table : tables_of(database))
    for (const std::string& column : columns_of(database, table))
      if (column.ends_with(kAssetEnding)) found.push_back({table, column});
  return found;
}

std::set<std::string> assets_named(Sqlite& database) {
  std::set<std::string> names;
  for (const AssetColumn& at : asset_columns(database))
    for (Statement rows = database.prepare("SELECT DISTINCT " + at.column + " AS name FROM " + at.table +
                                           " WHERE " + at.column + " IS NOT NULL");
         rows.step();)
      names.insert(rows.text("name"));
  return names;
}

std::set<std::string> assets_of_case(Sqlite& database, const std::string& case_id) {
  std::set<std::string> names;
  for (const TravellingTable& table : kTravelling)
    for (const std::string& column : columns_of(database, table.name)) {
      if (!column.ends_with(kAssetEnding)) continue;
      Statement rows = database.prepare("SELECT " + column + " AS name FROM " + std::string(table.name) +
                                        " WHERE " + column + " IS NOT NULL AND " + std::string(table.of_case));
      for (rows.bind("case_id", case_id); rows.step();) names.insert(rows.text("name"));
    }
  return names;
}

}  // namespace seldinger::casedb
