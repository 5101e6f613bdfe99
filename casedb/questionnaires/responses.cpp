#include "casedb/questionnaires/responses.h"

#include <algorithm>
#include <array>
#include <span>

#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/questionnaires/drawn_word.h"
#include "sim/base/check.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {
namespace {

namespace questionnaire = assessment::questionnaire;
using questionnaire::AnswerState;
using questionnaire::ItemAnswer;

constexpr std::size_t kMostRespondent = 16, kDrawnLength = 6;

bool is_respondent(std::string_view code) {
  return !code.empty() && code.size() <= kMostRespondent && std::all_of(code.begin(), code.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-';
  });
}

bool has_respondent(Library& library, const std::string& round_id, const std::string& respondent) {
  Statement row = question(library.database(), "response_set_of_respondent");
  return row.bind("round_id", round_id).bind("respondent", respondent).step();
}

// Whoever has a code needs no account: what they can make the library hold is bounded.
// `of`: a column of sets_begun_in_round.
std::int64_t count_of_sets(Library& library, const Round& round, const char* of) {
  Statement row = question(library.database(), "sets_begun_in_round");
  CHECK(row.bind("round_id", round.round_id).step());
  return row.integer(of);
}

bool is_full(Library& library, const Round& round) {
  return count_of_sets(library, round, "begun") >= static_cast<std::int64_t>(kMostBegunOnPages);
}

const StoredForm& in_language(const std::vector<StoredForm>& forms, const std::string& language) {
  const auto found = std::find_if(forms.begin(), forms.end(),
                                  [&](const StoredForm& one) { return one.form.language == language; });
  return found == forms.end() ? forms.front() : *found;
}

base::Result<void> check_respondent(Library& library, const Round& round, const Respondent& respondent) {
  if (round.groups.empty()
          ? !respondent.group.empty()
          : std::find(round.groups.begin(), round.groups.end(), respondent.group) == round.groups.end())
    return base::Error{"bad_group", "the round has no such group"};
  if (respondent.code.empty()) return {};
  if (!is_respondent(respondent.code))
    return base::Error{"bad_respondent", "a respondent's code is up to 16 letters, digits and dashes"};
  if (has_respondent(library, round.round_id, respondent.code))
    return base::Error{"respondent_taken",
                       "somebody has already answered, or begun to, under that code in this round"};
  return {};
}

base::Result<Round> open_round_of(Library& library, const std::string& code) {
  auto round = find_round(library, code);
  if (round && round->rated)
    return base::Error{"rated_round", "that code is for rating replays: each rater has a key"};
  if (round && round->at_desk)
    return base::Error{"desk_round", "this questionnaire is answered at the workstation, after an attempt"};
  if (round && !round->is_open())
    return base::Error{"round_closed", "the round is closed: nobody answers any more"};
  if (round && count_of_sets(library, *round, "simulated") > 0)
    return base::Error{"round_in_use",
                       "simulated people have answered in this round: people have one of their own"};
  return round;
}

std::string add_set(Library& library, const Round& round, const StoredForm& form, const Respondent& respondent,
                    const char* source, const std::optional<std::string>& draft_key) {
  std::string code = respondent.code;
  while (code.empty() || (respondent.code.empty() && has_respondent(library, round.round_id, code)))
    code = drawn_word(kSmallLetters, kDrawnLength);
  std::string response_id = new_uuid();
  question(library.database(), "add_response_set")
      .bind("response_id", response_id)
      .bind("round_id", round.round_id)
      .bind("questionnaire_id", form.questionnaire_id)
      .bind("respondent", code)
      .bind("group_name", respondent.group)
      .bind("source", source)
      .bind("draft_key", draft_key)
      .bind("now_us", now_us())
      .run();
  return response_id;
}

void put_answer(Library& library, const std::string& response_id, const std::string& item_id,
                const ItemAnswer& answer) {
  question(library.database(), "set_response")
      .bind("response_id", response_id)
      .bind("item_id", item_id)
      .bind("state", base::name_of(questionnaire::kAnswerStateNames, answer.state))
      .bind("value", answer.value)
      .bind("body", answer.text)
      .run();
}

ResponseSet set_from(Library& library, const Statement& row) {
  ResponseSet set;
  set.response_id = row.text("response_id");
  set.respondent = row.text("respondent");
  set.group = row.text("group_name");
  set.source = row.text("source");
  set.begun_us = row.integer("begun_us");
  if (!row.is_null("submitted_us")) set.submitted_us = row.integer("submitted_us");
  set.answers = answers_of(library, set.response_id);
  return set;
}

// What was not touched is missing, and says so.
void fill_and_submit(Library& library, const questionnaire::Form& form, const std::string& response_id) {
  const ItemAnswers there = answers_of(library, response_id);
  for (const questionnaire::Item& item : form.items)
    if (!there.contains(item.id)) put_answer(library, response_id, item.id, {});
  question(library.database(), "submit_response_set")
      .bind("response_id", response_id)
      .bind("now_us", now_us())
      .run();
}

// Reads what was typed, each against its item.
ItemAnswers read_typed(const questionnaire::Form& form, const std::map<std::string, std::string>& typed,
                       const std::string& where, std::vector<base::Problem>& wrong) {
  ItemAnswers answers;
  for (const auto& [item_id, text] : typed) {
    const questionnaire::Item* item = form.find_item(item_id);
    if (item == nullptr) {
      wrong.push_back({"bad_answer", where + "there is no item of that id"});
      continue;
    }
    auto answer = questionnaire::answer_from_text(form, *item, text);
    if (answer)
      answers.emplace(item_id, std::move(*answer));
    else
      wrong.push_back({"bad_answer", where + "item " + item_id + " " + answer.error().text});
  }
  return answers;
}

}  // namespace

std::string new_draft_secret() {
  std::array<std::byte, 32> random{};
  fill_random(random);
  return base::hex_from_bytes(random);
}

std::string draft_key(const std::string& secret) {
  return sha256_hex(std::as_bytes(std::span(secret)));
}

ItemAnswers answers_of(Library& library, const std::string& response_id) {
  ItemAnswers answers;
  Statement rows = question(library.database(), "responses_of_set");
  for (rows.bind("response_id", response_id); rows.step();) {
    ItemAnswer one;
    one.state =
        base::from_name(questionnaire::kAnswerStateNames, rows.view("state")).value_or(AnswerState::missing);
    if (!rows.is_null("value")) one.value = rows.real("value");
    one.text = rows.text("body");
    answers.emplace(rows.text("item_id"), std::move(one));
  }
  return answers;
}

base::Result<BegunSet> begin_set(Library& library, const Round& round, const Respondent& respondent) {
  if (const auto fit = check_respondent(library, round, respondent); !fit) return fit.error();
  if (is_full(library, round))
    return base::Error{"round_full", "so many have begun to answer in this round that it takes no more"};
  const auto forms = find_forms(library, round.form_id, round.version);
  if (!forms) return forms.error();
  BegunSet begun;
  begun.secret = new_draft_secret();
  begun.response_id = add_set(library, round, in_language(*forms, respondent.language), respondent, "page",
                              draft_key(begun.secret));
  return begun;
}

base::Result<std::string> begin_response(Library& library, const std::string& code, const Respondent& respondent) {
  Transaction transaction(library.database());
  const auto round = open_round_of(library, code);
  if (!round) return round.error();
  auto begun = begin_set(library, *round, respondent);
  if (!begun) return begun.error();
  transaction.commit();
  return std::move(begun->secret);
}

base::Result<Draft> find_draft(Library& library, const std::string& secret) {
  const base::Error none{"no_draft", "there are no answers that were begun here"};
  Statement row = question(library.database(), "response_set_of_draft");
  if (!row.bind("draft_key", draft_key(secret)).step()) return none;
  Draft draft;
  draft.set = set_from(library, row);
  const auto round = find_round(library, row.text("round_id"));
  if (!round) return round.error();
  draft.round = *round;
  auto forms = find_forms(library, round->form_id, round->version);
  if (!forms) return forms.error();
  const auto form = std::find_if(forms->begin(), forms->end(), [&](const StoredForm& one) {
    return one.questionnaire_id == row.text("questionnaire_id");
  });
  if (form == forms->end()) return base::Error{"damaged", "the answers are to a questionnaire that is not there"};
  draft.form = std::move(*form);
  return draft;
}

base::Result<void> save_draft(Library& library, const std::string& secret,
                              const std::map<std::string, std::string>& typed) {
  Transaction transaction(library.database());
  const auto draft = find_draft(library, secret);
  if (!draft) return draft.error();
  if (!draft->round.is_open()) return base::Error{"round_closed", "the round is closed: nobody answers any more"};
  base::Error error{"bad_answer", "an answer does not fit its item"};
  const ItemAnswers answers = read_typed(draft->form.form, typed, "", error.findings);
  if (!error.findings.empty()) return error;
  for (const auto& [item_id, answer] : answers) put_answer(library, draft->set.response_id, item_id, answer);
  transaction.commit();
  return {};
}

base::Result<void> submit_draft(Library& library, const std::string& secret) {
  Transaction transaction(library.database());
  const auto draft = find_draft(library, secret);
  if (!draft) return draft.error();
  if (!draft->round.is_open()) return base::Error{"round_closed", "the round is closed: nobody answers any more"};
  fill_and_submit(library, draft->form.form, draft->set.response_id);
  transaction.commit();
  return {};
}

base::Result<void> send_simulated(Library& library, const questionnaire::Form& form, const std::string& response_id,
                                  const std::map<std::string, std::string>& typed) {
  base::Error error{"bad_answer", "an answer does not fit its item"};
  const ItemAnswers answers = read_typed(form, typed, "", error.findings);
  if (!error.findings.empty()) return error;
  for (const auto& [item_id, answer] : answers) put_answer(library, response_id, item_id, answer);
  question(library.database(), "mark_response_simulated").bind("response_id", response_id).run();
  fill_and_submit(library, form, response_id);
  return {};
}

base::Result<std::size_t> add_paper_forms(Library& library, const std::string& code,
                                          const std::vector<PaperForm>& papers) {
  Transaction transaction(library.database());
  const auto round = open_round_of(library, code);
  if (!round) return round.error();
  const auto forms = find_forms(library, round->form_id, round->version);
  if (!forms) return forms.error();
  base::Error error{"bad_answers", "nothing was stored: some answers do not fit"};
  for (std::size_t i = 0; i < papers.size(); ++i) {
    const PaperForm& paper = papers[i];
    const std::string where = "row " + std::to_string(i + 1) + ": ";
    const StoredForm& form = in_language(*forms, paper.respondent.language);
    if (paper.respondent.code.empty())
      error.findings.push_back({"bad_respondent", where + "a respondent's code is missing"});
    else if (const auto fit = check_respondent(library, *round, paper.respondent); !fit)
      error.findings.push_back({fit.error().code, where + fit.error().text});
    const ItemAnswers answers = read_typed(form.form, paper.typed, where, error.findings);
    if (!error.findings.empty()) continue;
    const std::string response_id = add_set(library, *round, form, paper.respondent, "paper", {});
    for (const auto& [item_id, answer] : answers) put_answer(library, response_id, item_id, answer);
    fill_and_submit(library, form.form, response_id);
  }
  if (!error.findings.empty()) return error;
  audit(library, Act::import_responses, {"round", round->round_id});
  transaction.commit();
  return papers.size();
}

base::Result<Responses> list_responses(Library& library, const std::string& code) {
  const Snapshot snapshot(library.database());
  const auto round = find_round(library, code);
  if (!round) return round.error();
  Responses all;
  all.round = *round;
  auto forms = find_forms(library, round->form_id, round->version);
  if (!forms) return forms.error();
  for (StoredForm& one : *forms) all.forms.emplace(one.questionnaire_id, std::move(one));
  Statement rows = question(library.database(), "responses_of_round");
  for (rows.bind("round_id", round->round_id).bind("study_id", round->study_id); rows.step();)
    all.sets.emplace_back(rows.text("questionnaire_id"), set_from(library, rows));
  return all;
}

}  // namespace seldinger::casedb
