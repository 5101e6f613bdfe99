#include "casedb/questionnaires/forms.h"

#include <algorithm>
#include <span>

#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"

namespace seldinger::casedb {
namespace {

namespace questionnaire = assessment::questionnaire;

std::string hash_of_body(const std::string& body) {
  return sha256_hex(std::as_bytes(std::span(body)));
}

base::Result<StoredForm> stored_form(const Statement& row) {
  StoredForm stored;
  stored.questionnaire_id = row.text("questionnaire_id");
  stored.body = row.text("body");
  stored.body_hash = row.text("body_hash");
  stored.stored_us = row.integer("stored_us");
  auto form = questionnaire::form_from_json(stored.body);
  if (!form || hash_of_body(stored.body) != stored.body_hash)
    return base::Error{"damaged", "a stored questionnaire is not what was stored"};
  stored.form = std::move(*form);
  return stored;
}

}  // namespace

std::vector<StoredForm> list_forms(Library& library) {
  std::vector<StoredForm> forms;
  for (Statement rows = question(library.database(), "questionnaires"); rows.step();)
    if (auto one = stored_form(rows)) forms.push_back(std::move(*one));
  return forms;
}

base::Result<std::vector<StoredForm>> find_forms(Library& library, const std::string& form_id, int version) {
  std::vector<StoredForm> found;
  Statement rows = question(library.database(), "questionnaires");
  while (rows.step()) {
    if (rows.text("form_id") != form_id || (version > 0 && rows.small_integer("version") != version)) continue;
    auto one = stored_form(rows);
    if (!one) return one.error();
    if (version == 0 && !found.empty() && found.front().form.version < one->form.version) found.clear();
    found.push_back(std::move(*one));
  }
  if (found.empty()) return base::Error{"no_form", "the library has no such questionnaire"};
  return found;
}

base::Result<StoredForm> store_form(Library& library, const std::string& json) {
  const auto form = questionnaire::form_from_json(json);
  if (!form) return form.error();
  const std::string body = questionnaire::canonical_json(*form);
  Transaction transaction(library.database());
  if (auto there = find_forms(library, form->id, form->version)) {
    for (StoredForm& one : *there) {
      if (one.form.language == form->language) {
        if (one.body == body) return std::move(one);
        return base::Error{"form_taken",
                           "that version is stored already, with other words: give yours another version"};
      }
      if (questionnaire::structure_of(one.form) != questionnaire::structure_of(*form))
        return base::Error{"form_differs",
                           "items, scales or limits differ from those of this version in its other languages: give "
                           "yours another version"};
    }
  } else if (there.error().code != "no_form") {
    return there.error();
  }
  const std::string questionnaire_id = new_uuid();
  question(library.database(), "add_questionnaire")
      .bind("questionnaire_id", questionnaire_id)
      .bind("form_id", form->id)
      .bind("version", form->version)
      .bind("language", form->language)
      .bind("body", body)
      .bind("body_hash", hash_of_body(body))
      .bind("now_us", now_us())
      .run();
  audit(library, Act::store_questionnaire, {"questionnaire", questionnaire_id});
  const auto stored = find_forms(library, form->id, form->version);
  transaction.commit();
  return *std::find_if(stored->begin(), stored->end(),
                       [&](const StoredForm& one) { return one.questionnaire_id == questionnaire_id; });
}

}  // namespace seldinger::casedb
