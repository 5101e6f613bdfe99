#include "app/questionnaires/questionnaire_json.h"

#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson head_of(const casedb::StoredForm& one) {
  return {{"form", one.form.id},       {"version", one.form.version},    {"language", one.form.language},
          {"title", one.form.title},   {"items", one.form.items.size()}, {"form_sha256", one.body_hash},
          {"stored_us", one.stored_us}};
}

OrderedJson round_json(const casedb::Round& one) {
  return {{"code", one.code},
          {"title", one.title},
          {"form", one.form_id},
          {"version", one.version},
          {"study_id", casedb::maybe(one.study_id)},
          {"groups", one.groups},
          {"at_desk", one.at_desk},
          {"opened_us", one.opened_us},
          {"closed_us", casedb::maybe(one.closed_us)},
          {"begun", one.drafts},
          {"submitted", one.submitted}};
}

}  // namespace

std::string json_of_form(const casedb::StoredForm& form) {
  OrderedJson json = head_of(form);
  json["questionnaire"] = OrderedJson::parse(form.body);
  return casedb::text(json);
}

std::string json_of_questionnaires(const std::vector<casedb::StoredForm>& forms,
                                   const std::vector<casedb::Round>& rounds) {
  OrderedJson json = {{"questionnaires", OrderedJson::array()}, {"rounds", OrderedJson::array()}};
  for (const casedb::StoredForm& one : forms) json["questionnaires"].push_back(head_of(one));
  for (const casedb::Round& one : rounds) json["rounds"].push_back(round_json(one));
  return casedb::text(json);
}

std::string json_of_round(const casedb::Round& round) {
  return casedb::text(round_json(round));
}

std::string json_of_entry(std::size_t stored, const std::vector<EntryDifference>& differences) {
  OrderedJson json = {{"stored", stored}, {"differences", OrderedJson::array()}};
  for (const EntryDifference& one : differences)
    json["differences"].push_back(
        {{"respondent", one.respondent}, {"column", one.column}, {"first", one.first}, {"second", one.second}});
  return casedb::text(json);
}

}  // namespace seldinger::app
