#include "web/routes/answering.h"

#include <algorithm>
#include <charconv>

#include "casedb/database/credentials.h"
#include "reports/pages/answer_pages.h"
#include "reports/pages/style_sheet.h"
#include "reports/questionnaires/board_page.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

constexpr std::string_view kAnswersCookieRest = "; Path=/answer; HttpOnly; SameSite=Strict; Max-Age=86400";
constexpr std::string_view kTooOld = "The page was too old. Please try again.";

std::string answers_cookie(const Site& site, std::string_view value) {
  return site.cookies.answers + "=" + std::string(value) + std::string(kAnswersCookieRest);
}

// The number behind "name=" of a query or of a form; none: 1.
std::size_t section_from(std::string_view digits, std::size_t sections) {
  std::size_t section = 1;
  std::from_chars(digits.data(), digits.data() + digits.size(), section);
  return std::clamp<std::size_t>(section, 1, sections + 1) - 1;
}

std::string_view query_value(const Call& call, std::string_view name) {
  const std::string_view query = call.request.query;
  return query.substr(0, name.size()) == name ? query.substr(name.size()) : std::string_view();
}

Response with_cookie(Site& site, const KeptForm& kept, Response response) {
  if (kept.is_new) response.headers.emplace_back("Set-Cookie", answers_cookie(site, kept.secret));
  return response;
}

Response start_page(Site& site, const Call& call, int status, std::string_view problem) {
  const KeptForm kept = form_kept(site, call, site.cookies.answers);
  const bool begun = !kept.is_new && site.questions.find_draft(kept.secret).has_value();
  return with_cookie(site, kept,
                     html_response(status, reports::answer_start_page(
                                               {site.login_token(kept.secret), std::string(problem), begun})));
}

Response who_page(Site& site, const Call& call, int status, const RoundForms& found, casedb::Respondent typed,
                  const std::string& problem) {
  const KeptForm kept = form_kept(site, call, site.cookies.answers);
  return with_cookie(site, kept,
                     html_response(status, reports::answer_who_page({site.login_token(kept.secret), problem,
                                                                     found.round, found.forms, std::move(typed)})));
}

// The page of a code that was typed or followed.
Response page_of_code(Site& site, const Call& call, const std::string& code) {
  const auto found = site.questions.find_round(code);
  if (!found) return start_page(site, call, 404, "No questionnaire has that code. Is it typed correctly?");
  if (!found->round.is_open()) return start_page(site, call, 404, "This questionnaire is closed.");
  return who_page(site, call, 200, *found, {}, "");
}

Response section_page(Site& site, const std::string& secret, int status, const casedb::Draft& draft,
                      std::size_t section, const std::map<std::string, std::string>& typed,
                      const std::map<std::string, std::string>& problems) {
  return answering_response(
      status, reports::answer_section_page({site.login_token(secret), &draft, section, typed, problems}));
}

}  // namespace

KeptForm form_kept(Site& site, const Call& call, const std::string& cookie_name) {
  KeptForm kept{cookie(call.request, cookie_name)};
  kept.is_new = site.login_token(kept.secret).empty();
  if (kept.is_new) kept.secret = site.surroundings.random_id();
  return kept;
}

bool has_form_token(const Site& site, const Call& call, const std::string& kept) {
  const std::string token = site.login_token(kept);
  return !token.empty() && equal_in_constant_time(call.field("token"), token);
}

Response answering_response(int status, std::string body) {
  Response response = html_response(status, std::move(body));
  response.policy = Policy::answering;
  return response;
}

std::map<std::string, std::string> typed_of(const Call& call,
                                            const std::vector<const assessment::questionnaire::Item*>& items) {
  std::map<std::string, std::string> typed;
  for (const auto* item : items) {
    const std::string name = reports::field_of(*item);
    const bool none = call.field(name + "-none") == "yes" && call.field(name).empty();
    typed[item->id] = none ? std::string(assessment::questionnaire::kNotApplicableWord) : call.field(name);
  }
  return typed;
}

std::map<std::string, std::string> problems_of(const assessment::questionnaire::Form& form,
                                               const std::map<std::string, std::string>& typed) {
  std::map<std::string, std::string> problems;
  for (const auto& [item_id, text] : typed) {
    const auto* item = form.find_item(item_id);
    if (item == nullptr) continue;
    const auto answer = assessment::questionnaire::answer_from_text(form, *item, text);
    if (!answer) problems.emplace(item_id, "Please correct this: it " + answer.error().text + ".");
  }
  return problems;
}

std::map<std::string, std::string> fitting(const assessment::questionnaire::Form& form,
                                           std::map<std::string, std::string> typed) {
  for (const auto& [item_id, problem] : problems_of(form, typed)) typed.erase(item_id);
  return typed;
}

Response kept_response(const base::Result<void>& kept) {
  return {.status = kept ? 204 : 409};
}

Response show_answer_start(Site& site, const Call& call) {
  const std::string_view code = query_value(call, "code=");
  return code.empty() ? start_page(site, call, 200, "") : page_of_code(site, call, std::string(code));
}

Response begin_answers(Site& site, const Call& call) {
  const std::string kept = cookie(call.request, site.cookies.answers);
  if (!has_form_token(site, call, kept)) return start_page(site, call, 403, kTooOld);
  const std::string code = call.field("code");
  if (call.field("begin") != "yes") return page_of_code(site, call, code);
  const auto found = site.questions.find_round(code);
  if (!found) return page_of_code(site, call, code);
  const casedb::Respondent respondent{call.field("respondent"), call.field("group"), call.field("language")};
  const auto secret = site.questions.begin_response(code, respondent);
  if (!secret) {
    const bool group = secret.error().code == "bad_group";
    return who_page(site, call, 400, *found, respondent,
                    group ? "Please choose what you are here as." : "Not yet: " + secret.error().text + ".");
  }
  Response response = redirect("/answer/form");
  response.headers.emplace_back("Set-Cookie", answers_cookie(site, *secret));
  return response;
}

Response show_answer_section(Site& site, const Call& call) {
  const std::string kept = cookie(call.request, site.cookies.answers);
  const auto draft = site.questions.find_draft(kept);
  if (!draft) return redirect("/answer");
  const std::size_t sections = assessment::questionnaire::sections_of(draft->form.form).size();
  return section_page(site, kept, 200, *draft, section_from(query_value(call, "section="), sections), {}, {});
}

Response keep_answers(Site& site, const Call& call) {
  const std::string kept = cookie(call.request, site.cookies.answers);
  const std::string go = call.field("go");
  if (!has_form_token(site, call, kept))
    return go == "keep" ? Response{.status = 403} : start_page(site, call, 403, kTooOld);
  const auto draft = site.questions.find_draft(kept);
  if (!draft) return go == "keep" ? Response{.status = 404} : redirect("/answer");
  const auto sections = assessment::questionnaire::sections_of(draft->form.form);
  const std::size_t section = section_from(call.field("section"), sections.size());
  std::map<std::string, std::string> typed;
  if (section < sections.size()) typed = typed_of(call, sections[section]);
  if (go == "keep")
    return kept_response(site.questions.keep_answers(kept, fitting(draft->form.form, typed), false));
  const bool send = go == "send" && section == sections.size();
  const auto done = site.questions.keep_answers(kept, typed, send);
  if (!done && done.error().code == "bad_answer")
    return section_page(site, kept, 400, *draft, section, typed, problems_of(draft->form.form, typed));
  if (!done && done.error().code == "no_draft") return redirect("/answer");
  if (!done) return start_page(site, call, 409, "Not kept: " + done.error().text + ".");
  if (send) {
    Response response = redirect("/answer/thanks");
    response.headers.emplace_back("Set-Cookie",
                                  site.cookies.answers + "=; Path=/answer; HttpOnly; SameSite=Strict; Max-Age=0");
    return response;
  }
  const std::size_t next = go == "back" ? (section > 0 ? section - 1 : 0) : std::min(section + 1, sections.size());
  return redirect("/answer/form?section=" + std::to_string(next + 1));
}

Response show_answer_script(Site&, const Call&) {
  return {.content_type = "text/javascript; charset=utf-8", .body = std::string(reports::keep_typed_script())};
}

Response show_answer_thanks(Site&, const Call&) {
  return html_response(200, reports::answer_thanks_page());
}

Response show_board(Site& site, const Call& call) {
  const std::string_view code = query_value(call, "code=");
  if (code.empty()) return html_response(200, reports::board_start_page(""));
  const auto board = site.questions.find_board(std::string(code));
  if (!board)
    return html_response(404, reports::board_start_page("No workshop has that code. Is it typed correctly?"));
  Response response = html_response(200, reports::board_page(board->workshop, board->participants));
  response.headers.emplace_back("Refresh", std::to_string(reports::kBoardEveryS));
  return response;
}

namespace {

constexpr Route kAnsweringRoutes[] = {
    {"GET", "/answer", kOpen, true, "", "a questionnaire's code, or who answers it; ?code=CODE", show_answer_start},
    {"POST", "/answer", kOpen, true, "", "begins to answer: code, group, respondent, language, begin, token",
     begin_answers},
    {"GET", "/answer/form", kOpen, true, "the browser that began",
     "a section of the questionnaire being answered; ?section=N", show_answer_section},
    {"POST", "/answer/form", kOpen, true, "the browser that began",
     "keeps a section's answers, or sends all: section, go, a field each item, token", keep_answers},
    {"GET", "/answer/thanks", kOpen, true, "", "that the answers were sent", show_answer_thanks},
    {"GET", "/answer.js", kOpen, false, "", "the script that keeps what is typed", show_answer_script},
    {"GET", "/board", kOpen, true, "", "a workshop's board, by numbers alone, or asks for its code; ?code=CODE",
     show_board},
};

}  // namespace

std::span<const Route> answering_routes() {
  return kAnsweringRoutes;
}

}  // namespace seldinger::web
