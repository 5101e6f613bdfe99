// The questionnaires that a library holds: stored once, never changed. Another wording is another version; the same
// version in another language asks the same.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "assessment/questionnaire/form.h"
#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct StoredForm {
  std::string questionnaire_id, body, body_hash;
  std::int64_t stored_us = 0;
  assessment::questionnaire::Form form;
};

// `bad_form`, `form_taken` (that version is there in that language, in other words), `form_differs` (a translation
// that asks otherwise than the version does). Stored again word for word it is the one that is there.
base::Result<StoredForm> store_form(Library& library, const std::string& json);
std::vector<StoredForm> list_forms(Library& library);  // by id, version and language
// In every language: `no_form`. Version 0: the newest.
base::Result<std::vector<StoredForm>> find_forms(Library& library, const std::string& form_id, int version = 0);

}  // namespace seldinger::casedb
