// The pages on which a questionnaire is answered, at a workshop's kiosk or on a phone: the code, who answers,
// section after section, and thanks. Nobody is logged in. What is typed is kept a moment later by a script
// (keep_typed.js); without it each section is kept when it is sent.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "casedb/questionnaires/responses.h"
#include "reports/pages/answer_items.h"

namespace seldinger::reports {

// The first page. `begun`: this browser keeps answers that are not sent yet.
struct AnswerStart {
  std::string token, problem;
  bool begun = false;
};
std::string answer_start_page(const AnswerStart& start);

// Who answers, once the code is known.
struct AnswerWho {
  std::string token, problem;
  casedb::Round round;
  std::vector<casedb::StoredForm> forms;  // one a language
  casedb::Respondent typed;
};
std::string answer_who_page(const AnswerWho& who);

struct AnswerSection {
  std::string token;
  const casedb::Draft* draft = nullptr;
  std::size_t section = 0;                      // from 0; as many as there are: the last look
  std::map<std::string, std::string> typed;     // by item, what was refused
  std::map<std::string, std::string> problems;  // by item
};
std::string answer_section_page(const AnswerSection& view);

// Sent.
std::string answer_thanks_page();

}  // namespace seldinger::reports
