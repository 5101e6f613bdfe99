// What was answered in a round. A page keeps a draft from the first section on, so that a browser may die; what is
// submitted is complete, every item with an answer, "not applicable" or nothing, and never changes.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "casedb/questionnaires/rounds.h"

namespace seldinger::casedb {

using ItemAnswers = std::map<std::string, assessment::questionnaire::ItemAnswer>;  // by item

struct ResponseSet {
  std::string response_id, respondent, group;
  std::string source;  // "page", "paper", "window", "simulated"
  std::int64_t begun_us = 0;
  std::optional<std::int64_t> submitted_us;
  ItemAnswers answers;
};

// As far as they are kept.
ItemAnswers answers_of(Library& library, const std::string& response_id);

struct Draft {
  Round round;
  StoredForm form;
  ResponseSet set;
};

// Who answers: a code brought along, or empty, then one is drawn.
struct Respondent {
  std::string code{}, group{};
  std::string language{};  // empty, or none of the form's: the first
};

inline constexpr std::size_t kMostBegunOnPages = 2000;  // in a round, sent or not

std::string new_draft_secret();
// A draft's secret as the library keeps it.
std::string draft_key(const std::string& secret);
// A draft on a page: its secret, which the browser keeps, and the library only as a hash. `no_round`,
// `rated_round`, `desk_round` (answered at the workstation), `round_closed`, `round_full`, `bad_group`,
// `bad_respondent`, `respondent_taken` (has answered or begun in this round).
base::Result<std::string> begin_response(Library& library, const std::string& code, const Respondent& respondent);
// The same in a round that is open, within a transaction of the caller's.
struct BegunSet {
  std::string response_id, secret;
};
base::Result<BegunSet> begin_set(Library& library, const Round& round, const Respondent& respondent);
// `no_draft`: there is none, or it was submitted.
base::Result<Draft> find_draft(Library& library, const std::string& secret);
// By item what was typed; items that are not named stay as they are. All of it or nothing: `no_draft`,
// `round_closed`, `bad_answer` with a finding for each item.
base::Result<void> save_draft(Library& library, const std::string& secret,
                              const std::map<std::string, std::string>& typed);
// Once; the draft is gone.
base::Result<void> submit_draft(Library& library, const std::string& secret);
// A simulated person's or rater's answers to what was begun, kept as such and sent, within a transaction of the
// caller's: `bad_answer`.
base::Result<void> send_simulated(Library& library, const assessment::questionnaire::Form& form,
                                  const std::string& response_id, const std::map<std::string, std::string>& typed);

// From paper: all or none. Items that a row does not name are missing. `bad_answers` with every place, `no_round`,
// `rated_round`, `desk_round`, `round_closed`.
struct PaperForm {
  Respondent respondent;
  std::map<std::string, std::string> typed;  // by item
};
base::Result<std::size_t> add_paper_forms(Library& library, const std::string& code,
                                          const std::vector<PaperForm>& forms);

// What was submitted in a round, in the order of the respondents' codes: when somebody answered tells nothing.
struct Responses {
  Round round;
  std::map<std::string, StoredForm> forms;                // by questionnaire id
  std::vector<std::pair<std::string, ResponseSet>> sets;  // each with its questionnaire's id
};
base::Result<Responses> list_responses(Library& library, const std::string& code);

}  // namespace seldinger::casedb
