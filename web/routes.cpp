#include "web/routes.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>

#include "casedb/database/credentials.h"
#include "reports/pages/attempt_page.h"
#include "reports/pages/attempts_page.h"
#include "reports/pages/case_page.h"
#include "reports/pages/cohorts_page.h"
#include "reports/pages/log_ins_page.h"
#include "reports/pages/login_page.h"
#include "reports/pages/me_page.h"
#include "reports/pages/metrics_page.h"
#include "reports/pages/style_sheet.h"
#include "sim/base/failure.h"
#include "web/access.h"
#include "web/answering.h"
#include "web/json/attempt_json.h"
#include "web/json/case_json.h"
#include "web/rating.h"

namespace seldinger::web {
namespace {

constexpr std::size_t kRowsOfAPage = 50;

std::string set_cookie(std::string_view name, std::string_view value) {
  // No Secure: on the loopback there is no TLS. Without Max-Age the browser forgets it when it closes.
  constexpr std::string_view kRest = "; Path=/; HttpOnly; SameSite=Strict";
  std::string text;
  text.reserve(name.size() + 1 + value.size() + kRest.size());  // a session's id leaves no pieces behind
  return std::move(text.append(name).append("=").append(value).append(kRest));
}
std::string drop_cookie(std::string_view name) {
  return set_cookie(name, "") + "; Max-Age=0";
}

// --- open to all
// --------------------------------------------------------------------------------------------------

Response start(Site&, const Call& call) {
  return redirect(call.reader != nullptr ? "/attempts" : "/login");
}

Response healthz(Site& site, const Call&) {
  const casedb::Health health = site.questions.health();
  return {.status = health == casedb::Health::ok ? 200 : 503,
          .content_type = "application/json",
          .body = health_json(health, site.surroundings.program_version)};
}

Response style(Site&, const Call&) {
  return {.content_type = "text/css; charset=utf-8", .body = std::string(reports::style_sheet())};
}

Response login_form(Site& site, const Call& call, int status, std::string_view problem) {
  std::string before_id = cookie(call.request, site.cookies.before_login);
  const bool is_new = site.login_token(before_id).empty();
  if (is_new) before_id = site.surroundings.random_id();
  Response response = html_response(status, reports::login_page(site.login_token(before_id), problem));
  if (is_new) response.headers.emplace_back("Set-Cookie", set_cookie(site.cookies.before_login, before_id));
  return response;
}

Response show_login(Site& site, const Call& call) {
  if (call.reader != nullptr) return redirect("/attempts");
  return login_form(site, call, 200, "");
}

std::string field(const Call& call, const std::string& name) {
  const auto found = call.form.find(name);
  return found == call.form.end() ? "" : found->second;
}

Response log_in(Site& site, const Call& call) {
  const std::string token = site.login_token(cookie(call.request, site.cookies.before_login));
  if (token.empty() || !equal_in_constant_time(field(call, "token"), token)) {
    return login_form(site, call, 403, "The page was too old. Please try again.");
  }
  const std::string name = field(call, "name");
  const std::string place = site.place_of(call.request, name);
  if (const std::int64_t wait_s = site.wait_before_log_in_s(name, place); wait_s > 0) {
    site.security.note("log-in delayed", call.request.from, site.account_id(name));
    Response response =
        login_form(site, call, 429, "Too many tries. Try again in " + std::to_string(wait_s) + " s.");
    response.headers.emplace_back("Retry-After", std::to_string(wait_s));
    return response;
  }
  const casedb::Secret password{field(call, "password")};
  std::optional<casedb::Account> account;
  try {
    account = site.questions.log_in(name, password.text);
  } catch (const base::Failure&) {
    site.delays.take_back(name, place);  // nobody was told whether it was right
    throw;
  }
  if (!account.has_value() || !account->enabled) {
    site.security.note("log-in failed", call.request.from, site.account_id(name));
    return login_form(site, call, 403, "Name and password do not fit.");
  }
  site.delays.forget(name, place);
  site.security.note("logged in", call.request.from, account->person_id);
  const casedb::Secret old{cookie(call.request, site.cookies.session)};
  site.sessions.end(old.text);
  const casedb::Secret id{site.sessions.begin(account->person_id, account->password_mark)};
  Response response = redirect("/attempts");
  response.headers.emplace_back("Set-Cookie", set_cookie(site.cookies.session, id.text));
  response.headers.emplace_back("Set-Cookie", drop_cookie(site.cookies.before_login));
  constexpr std::string_view kHalfAYear = "; Max-Age=15552000";
  response.headers.emplace_back("Set-Cookie",
                                set_cookie(site.cookies.known, site.known_browser(name)).append(kHalfAYear));
  return response;
}

Response log_out(Site& site, const Call& call) {
  const casedb::Secret id{cookie(call.request, site.cookies.session)};
  site.sessions.end(id.text);  // first: whoever leaves is out, whatever becomes of the library
  try {
    site.questions.log_out(call.reader->account.person_id);
  } catch (const base::Failure& failure) {
    site.log_fault(failure.code() + ": a log-out is not in the audit log");
  }
  Response response = redirect("/login");
  response.headers.emplace_back("Set-Cookie", drop_cookie(site.cookies.session));
  return response;
}

// --- attempts
// -----------------------------------------------------------------------------------------------------

std::size_t wanted_page(const Request& request, std::size_t pages) {
  std::size_t page = 1;
  const std::string_view query = request.query;
  constexpr std::string_view kName = "page=";
  if (query.substr(0, kName.size()) == kName) {
    const std::string_view digits = query.substr(kName.size());
    std::from_chars(digits.data(), digits.data() + digits.size(), page);
  }
  return std::clamp<std::size_t>(page, 1, pages);
}

Response list_attempts(Site& site, const Call& call) {
  const casedb::Account& account = call.reader->account;
  if (!casedb::roles_that_may(casedb::Action::see_attempt).has(account.role))
    return html_response(200, reports::no_attempts_page(call.reader->visitor()));
  const Relations relations = site.questions.relations_of(account.person_id);
  const casedb::WhoseAttempts seen = attempts_seen(account.role, relations);
  const std::size_t total = site.questions.count_attempts(seen);
  const std::size_t pages = std::max<std::size_t>(1, (total + kRowsOfAPage - 1) / kRowsOfAPage);
  const std::size_t page = wanted_page(call.request, pages);
  auto rows = site.questions.list_attempts(seen, (page - 1) * kRowsOfAPage, kRowsOfAPage);

  std::map<std::string, casedb::Account> accounts;
  for (casedb::Account& one : site.questions.list_accounts()) accounts.emplace(one.person_id, one);
  const AccountOf account_of = [&](const std::string& person_id) {
    const auto found = accounts.find(person_id);
    return found == accounts.end() ? std::nullopt : std::optional(found->second);
  };
  // The question was right already; this holds it to the table.
  std::erase_if(rows,
                [&](const casedb::AttemptRow& row) { return !may_see_attempt(account.role, relations, row); });
  std::vector<reports::AttemptView> views;
  for (const casedb::AttemptRow& row : rows) {
    casedb::AttemptRow told = row;
    withhold(account.role, told);
    std::string label = operator_label(account.role, relations, told, account_of);
    views.push_back({std::move(told), std::move(label)});
  }
  const std::vector<assessment::Grade> grades = site.questions.grades_of(rows);
  for (std::size_t i = 0; i < views.size(); ++i) views[i].grade.grade = grades.at(i);
  const reports::ListPart part{page, pages, total, account.role == casedb::Role::trainee};
  return html_response(200, reports::attempts_page(call.reader->visitor(), views, part));
}

// The attempt when it exists and this reader may see it. Both are asked before either is answered.
std::optional<casedb::AttemptRow> visible_attempt(Site& site, const Call& call) {
  auto row = site.questions.find_attempt(call.id);
  const Relations relations = site.questions.relations_of(call.reader->account.person_id);
  if (!row.has_value() || !may_see_attempt(call.reader->account.role, relations, *row)) return std::nullopt;
  return std::move(*row);
}

std::vector<reports::CommentView> comments_of(Site& site, const std::string& attempt_id) {
  std::vector<reports::CommentView> comments;
  for (casedb::AttemptComment& one : site.questions.list_comments(attempt_id)) {
    const auto author = one.person_id ? site.questions.find_account(*one.person_id) : std::nullopt;
    std::string name = author          ? author->login_name
                       : one.person_id ? reports::person_text(*one.person_id)
                                       : "Operator";
    comments.push_back({std::move(one), std::move(name)});
  }
  return comments;
}

Response show_attempt(Site& site, const Call& call) {
  auto row = visible_attempt(site, call);
  if (!row.has_value()) return refusal(404, call.reader);
  const casedb::Role role = call.reader->account.role;
  const casedb::AttemptGrade grade = site.questions.look_at(*row);
  withhold(role, *row);
  const AccountOf account_of = [&](const std::string& person_id) { return site.questions.find_account(person_id); };
  const auto recording = site.questions.load_recording(row->attempt_id);
  const Relations relations = site.questions.relations_of(call.reader->account.person_id);
  reports::AttemptView view{*row, operator_label(role, relations, *row, account_of), grade,
                            site.questions.list_steps(row->attempt_id)};
  if (casedb::may(role, casedb::Action::see_free_text)) view.comments = comments_of(site, row->attempt_id);
  view.may_comment = casedb::may(role, casedb::Action::comment_attempt, relation_to(relations, row->person_id));
  return html_response(200, reports::attempt_page(call.reader->visitor(), view,
                                                  recording.has_value() ? &recording.value() : nullptr));
}

Response comment_attempt(Site& site, const Call& call) {
  const auto row = visible_attempt(site, call);
  const casedb::Account& account = call.reader->account;
  const Relations relations = site.questions.relations_of(account.person_id);
  if (!row || !casedb::may(account.role, casedb::Action::comment_attempt, relation_to(relations, row->person_id)))
    return refusal(404, call.reader);
  const std::string at = field(call, "at");
  double at_s = 0.0;
  const auto read = std::from_chars(at.data(), at.data() + at.size(), at_s, std::chars_format::fixed);
  if (!at.empty() && (read.ec != std::errc() || read.ptr != at.data() + at.size()))
    return refusal(400, call.reader);
  const auto said = site.questions.add_comment(account.person_id, row->attempt_id, at_s, field(call, "text"));
  return said ? redirect("/attempts/" + row->attempt_id + "#comments") : refusal(400, call.reader);
}

bool is_png(const std::vector<std::byte>& bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  return bytes.size() > kSignature.size() && std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) == 0;
}

Response show_picture(Site& site, const Call& call) {
  const auto row = visible_attempt(site, call);
  if (!row.has_value() || row->picture_sha256.empty()) return refusal(404, call.reader);
  const auto picture = site.questions.load_picture(*row);
  if (!picture.has_value() || !is_png(*picture)) {
    const std::string code = picture.has_value() ? "not_png" : picture.error().code;
    return site.fault(500, call.reader, code + ": a stored picture cannot be shown");
  }
  Response response{.content_type = "image/png"};
  response.body.resize(picture->size());
  std::memcpy(response.body.data(), picture->data(), picture->size());
  return response;
}

Response show_metrics(Site& site, const Call& call) {
  const auto row = visible_attempt(site, call);
  if (!row.has_value()) return refusal(404, call.reader);
  return {.content_type = "application/json", .body = metrics_json(*row)};
}

Response show_grade(Site& site, const Call& call) {
  const auto row = visible_attempt(site, call);
  if (!row.has_value()) return refusal(404, call.reader);
  return {.content_type = "application/json",
          .body = grade_json(*row, site.questions.look_at(*row), may_see_experts(call.reader->account.role))};
}

// --- cases
// ------------------------------------------------------------------------------------------------------

Response list_cases(Site& site, const Call& call) {
  std::vector<casedb::CaseRow> seen;
  for (casedb::CaseRow& row : site.questions.list_cases())
    if (may_see_case(call.reader->account.role, row)) {
      withhold(call.reader->account.role, row);
      seen.push_back(std::move(row));
    }
  return html_response(200, reports::cases_page(call.reader->visitor(), seen));
}

std::optional<casedb::CaseParts> visible_case(Site& site, const Call& call) {
  auto parts = site.questions.find_case(call.id);
  if (!parts.has_value() || !may_see_case(call.reader->account.role, parts->row)) return std::nullopt;
  withhold(call.reader->account.role, *parts);
  return std::move(*parts);
}

Response show_case(Site& site, const Call& call) {
  const auto parts = visible_case(site, call);
  if (!parts.has_value()) return refusal(404, call.reader);
  return html_response(200, reports::case_page(call.reader->visitor(), *parts));
}

Response show_case_json(Site& site, const Call& call) {
  const auto parts = visible_case(site, call);
  if (!parts.has_value()) return refusal(404, call.reader);
  return {.content_type = "application/json", .body = case_json(*parts)};
}

Response show_checks(Site& site, const Call& call) {
  const auto parts = visible_case(site, call);
  if (!parts.has_value()) return refusal(404, call.reader);
  const std::string& case_id = parts->row.case_id;
  const std::string mark = site.questions.case_mark(case_id);
  auto checks = site.answers.get(case_id + " " + mark, [&]() -> base::Result<Answers::Made> {
    const auto check = site.questions.check_case(parts->row);
    if (!check) return check.error();
    return Answers::Made{checks_json(case_id, *check), check->content_mark == mark};
  });
  if (!checks) return site.fault(500, call.reader, checks.error().code + ": a case cannot be checked");
  return {.content_type = "application/json", .body = std::move(*checks)};
}

Response list_metrics(Site&, const Call& call) {
  return html_response(200, reports::metrics_page(call.reader->visitor()));
}

Response list_curricula(Site& site, const Call& call) {
  const casedb::Account& account = call.reader->account;
  const bool own = casedb::may(account.role, casedb::Action::see_own_progress);
  auto views = site.questions.list_curricula(own ? std::optional(account.person_id) : std::nullopt);
  std::erase_if(views, [&](const auto& one) { return !may_see_curriculum(account.role, one.curriculum); });
  for (auto& view : views)
    for (casedb::ItemState& item : view.items) withhold(account.role, item);
  return html_response(200, reports::curricula_page(call.reader->visitor(), views));
}

// --- people
// -----------------------------------------------------------------------------------------------------

Response list_cohorts(Site& site, const Call& call) {
  const casedb::Role role = call.reader->account.role;
  const Relations relations = site.questions.relations_of(call.reader->account.person_id);
  std::map<std::string, std::string> names;
  for (const casedb::Account& one : site.questions.list_accounts()) names.emplace(one.person_id, one.login_name);
  std::vector<reports::CohortView> views;
  for (const casedb::Cohort& cohort : site.questions.list_cohorts()) {
    // By name to who leads it or directs its programme. That each of its learners is seen elsewhere tells nothing
    // of it.
    const casedb::Relation to_cohort = site.questions.relation_to_cohort(call.reader->account.person_id, cohort);
    reports::CohortView view{cohort, casedb::may(role, casedb::Action::see_cohort, to_cohort), {}, {}};
    if (view.named) {
      view.cells = casedb::cells_of(cohort);
      for (const casedb::Learner& one : cohort.learners) {
        if (!one.still) continue;
        const auto name = names.find(one.person_id);
        const bool may_read =
            casedb::may(role, casedb::Action::see_operator_name, relation_to(relations, one.person_id));
        view.learners.push_back(name != names.end() && may_read ? name->second
                                                                : reports::person_text(one.person_id));
      }
    } else if (casedb::may(role, casedb::Action::see_cohort_cells)) {
      view.cells = casedb::suppressed(cohort, [&](const std::string& person_id) {
        return casedb::may(role, casedb::Action::see_attempt, relation_to(relations, person_id));
      });
    } else {
      continue;
    }
    views.push_back(std::move(view));
  }
  return html_response(200, reports::cohorts_page(call.reader->visitor(), views));
}

// What /me says was done, by the query of the redirect; %: the number behind it.
struct Done {
  std::string_view query, text;
};
constexpr Done kConsented{"consented", "Noted: you consent."};
constexpr Done kWithdrew{"withdrew", "Noted: you do not consent."};
constexpr Done kSaved{"saved", "Saved."};
constexpr Done kErased{"erased=", "Attempts deleted: %. They cannot be brought back."};
constexpr Done kErasedNotYet{"erased-later=",
                             "Attempts deleted: %. Old bytes of them lie in the library's files until nobody uses "
                             "it: tell whoever runs it."};

std::string text_of(std::string_view query) {
  for (const Done& one : {kConsented, kWithdrew, kSaved, kErased, kErasedNotYet}) {
    if (!query.starts_with(one.query)) continue;
    const std::string_view digits = query.substr(one.query.size());
    const std::size_t hole = one.text.find('%');
    if (hole == one.text.npos && digits.empty()) return std::string(one.text);
    std::size_t count = 0;
    const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), count);
    if (hole != one.text.npos && !digits.empty() && read.ec == std::errc() &&
        read.ptr == digits.data() + digits.size())
      return std::string(one.text).replace(hole, 1, std::to_string(count));
  }
  return {};
}

Response me(Site& site, const Call& call, int status, const reports::Told& told) {
  const auto about = site.questions.about(call.reader->account.person_id);
  return html_response(status, reports::me_page(call.reader->visitor(), about, told));
}

Response show_me(Site& site, const Call& call) {
  return me(site, call, 200, {.done = text_of(call.request.query)});
}

Response problem(Site& site, const Call& call, const std::string& text) {
  return me(site, call, 400, {.problem = text});
}

Response after(Site& site, const Call& call, const base::Result<void>& result, const Done& done) {
  if (!result) return problem(site, call, result.error().text);
  return redirect("/me?" + std::string(done.query));
}

Response erase_attempts(Site& site, const Call& call) {
  const auto erased = site.questions.erase_attempts_of(call.reader->account.person_id);
  if (!erased) return problem(site, call, erased.error().text);
  const Done& done = erased->overwritten && erased->kept_copies == 0 ? kErased : kErasedNotYet;
  return redirect("/me?" + std::string(done.query) + std::to_string(erased->attempts));
}

Response answer_consent(Site& site, const Call& call) {
  const std::string& person_id = call.reader->account.person_id;
  const std::string text_id = field(call, "text"), answer = field(call, "answer");
  if (answer == "give") return after(site, call, site.questions.give_consent(person_id, text_id), kConsented);
  if (answer != "withdraw") return problem(site, call, "Choose to consent or to withdraw.");
  const auto withdrawn = site.questions.withdraw_consent(person_id, text_id);
  if (!withdrawn || field(call, "delete") != "yes") return after(site, call, withdrawn, kWithdrew);
  return erase_attempts(site, call);
}

Response give_facts(Site& site, const Call& call) {
  const auto given = casedb::newest_facts(site.questions.about(call.reader->account.person_id).facts);
  std::map<std::string, std::string> answers;
  for (const casedb::FactInfo& fact : casedb::fact_infos()) {
    const std::string id(fact.id), answer = field(call, id);
    const auto last = given.find(id);
    if (!answer.empty() && (last == given.end() || last->second.answer != answer)) answers.emplace(id, answer);
  }
  return after(site, call, site.questions.give_facts(call.reader->account.person_id, answers), kSaved);
}

Response erase_own(Site& site, const Call& call) {
  if (field(call, "sure") != "yes") return problem(site, call, "Tick the box if you are sure.");
  return erase_attempts(site, call);
}

// --- log-ins
// ----------------------------------------------------------------------------------------------------

Response show_log_ins(Site& site, const Call& call) {
  std::vector<reports::DelayedLogIn> delayed;
  for (const casedb::Account& one : site.questions.list_accounts())
    if (const auto wait_s = site.delays.longest_wait_s(one.login_name, site.surroundings.now_us()); wait_s > 0)
      delayed.push_back({one.person_id, one.login_name, wait_s});
  return html_response(200, reports::log_ins_page(call.reader->visitor(), delayed));
}

Response let_in_again(Site& site, const Call& call) {
  const auto account = site.questions.find_account(field(call, "person"));
  if (!account) return refusal(404, call.reader);
  site.delays.forget(account->login_name);
  site.security.note("let in again by an admin", call.request.from, account->person_id);
  try {
    site.questions.let_in_again(call.reader->account.person_id, account->login_name);
    site.delays.heed(account->login_name, site.questions.last_let_in_again(account->person_id));
  } catch (const base::Failure& failure) {  // they are in, whatever becomes of the library
    site.log_fault(failure.code() + ": that somebody was let in again is not in the audit log");
  }
  return redirect("/log-ins");
}

using casedb::Action;
constexpr std::string_view kCurricula =
    "trainee: published, own states; mentor, director: all; researcher: no drafts";
constexpr std::string_view kCases =
    "mentor: all; director: no drafts; researcher, admin: published and retired, without reviewers' notes";
constexpr std::string_view kSeen =
    "trainee: own; mentor: own, own cohort, simulated; director: own programmes; researcher: consenting people of "
    "own studies as pseudonyms, simulated";
constexpr std::string_view kSeenOrNone = "the same; admin: none, the page says so";
constexpr std::string_view kSelf = "of oneself";

constexpr Route kRoutes[] = {
    {"GET", "/healthz", kOpen, false, "",
     "`ok`, `moved`, `full` or `read_only` (503) as the library is, and the version, as JSON", healthz},
    {"GET", "/style.css", kOpen, false, "", "the style sheet", style},
    {"GET", "/", kOpen, true, "", "goes on to /attempts or /login", start},
    {"GET", "/login", kOpen, true, "", "the log-in form", show_login},
    {"POST", "/login", kOpen, true, "", "logs in: name, password, token", log_in, Lane::log_in},
    {"POST", "/logout", kAnyRole, true, "", "ends the session: token", log_out, Lane::changes},
    {"GET", "/answer", kOpen, true, "", "a questionnaire's code, or who answers it; ?code=CODE", show_answer_start},
    {"POST", "/answer", kOpen, true, "", "begins to answer: code, group, respondent, language, begin, token",
     begin_answers},
    {"GET", "/answer/form", kOpen, true, "the browser that began",
     "a section of the questionnaire that is being answered; ?section=N", show_answer_section},
    {"POST", "/answer/form", kOpen, true, "the browser that began",
     "keeps a section's answers, or sends all: section, go, a field each item, token", keep_answers},
    {"GET", "/answer/thanks", kOpen, true, "", "that the answers were sent", show_answer_thanks},
    {"GET", "/answer.js", kOpen, false, "", "the script that keeps what is typed", show_answer_script},
    {"GET", "/film.js", kOpen, false, "", "the script that plays a replay to rate", show_film_script},
    {"GET", "/rate", kOpen, true, "", "asks for a rater's key", show_rating_start},
    {"POST", "/rate", kOpen, true, "", "opens the bench of a rater: key, token", open_rating_bench},
    {"GET", "/rate/bench", kOpen, true, "the browser of a rater", "the replays that are theirs to rate, by number",
     show_rating_bench},
    {"GET", "/rate/replay", kOpen, true, "the browser of a rater", "a replay beside the form; ?n=N", show_rating},
    {"POST", "/rate/replay", kOpen, true, "the browser of a rater",
     "keeps a rating, or sends it: n, go, a field each item, token", keep_rating},
    {"GET", "/board", kOpen, true, "", "a workshop's board, by numbers alone, or asks for its code; ?code=CODE",
     show_board},
    {"GET", "/attempts", kAnyRole, true, kSeenOrNone, "the list, newest first; ?page=N", list_attempts},
    {"GET", "/attempts/{attempt_id}", Action::see_attempt, true, kSeen,
     "one attempt: debrief, criteria, metrics, picture, course", show_attempt},
    {"GET", "/attempts/{attempt_id}/picture.png", Action::see_attempt, false, kSeen,
     "the picture at the moment of firing", show_picture},
    {"GET", "/attempts/{attempt_id}/metrics.json", Action::see_attempt, false, kSeen,
     "its metrics as `score` prints them", show_metrics},
    {"GET", "/attempts/{attempt_id}/grade.json", Action::see_attempt, false, kSeen,
     "its grade, score and sentences as `score` prints them; of experts to others than mentors only rounded bands",
     show_grade},
    {"POST", "/attempts/{attempt_id}/comments", Action::comment_attempt, true, "mentor: own cohort",
     "says something of a moment of it: at, text, token", comment_attempt, Lane::changes},
    {"GET", "/metrics", kAnyRole, true, "", "what each metric measures; #metric-ID", list_metrics},
    {"GET", "/curricula", Action::see_curriculum, true, kCurricula, "items, gates, and how far the trainee is",
     list_curricula},
    {"GET", "/cases", Action::see_case, true, kCases, "the list, oldest first", list_cases},
    {"GET", "/cases/{case_id}", Action::see_case, true, kCases,
     "one case: state, version, who reviewed it, needle, patient, structures, rule", show_case},
    {"GET", "/cases/{case_id}/case.json", Action::see_case, false, kCases, "as `case show` prints it",
     show_case_json},
    {"GET", "/cases/{case_id}/checks.json", Action::see_case, false, kCases,
     "its checks as `case check` prints them", show_checks, Lane::heavy},
    {"GET", "/cohorts", Action::see_cohort, true,
     "mentor: own cohorts by name; director: own programmes by name, of others counts of at least 5 people",
     "who is in which cohort, and what they did together", list_cohorts},
    {"GET", "/log-ins", Action::let_in_again, true, "", "who has to wait before the next try", show_log_ins},
    {"POST", "/log-ins", Action::let_in_again, true, "", "lets somebody try again at once: person, token",
     let_in_again, Lane::changes},
    {"GET", "/me", Action::answer_consent, true, kSelf, "consent, facts, deletion", show_me},
    {"POST", "/me/consent", Action::answer_consent, true, kSelf, "gives or withdraws: text, answer, delete, token",
     answer_consent, Lane::changes},
    {"POST", "/me/facts", Action::answer_consent, true, kSelf, "gives facts: one field each, token", give_facts,
     Lane::changes},
    {"POST", "/me/erase", Action::erase_attempts, true, kSelf, "erases what one has recorded: sure, token",
     erase_own, Lane::changes},
};

bool is_uuid(std::string_view text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    const char c = text[i];
    const bool hex = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
    if (dash ? c != '-' : !hex) return false;
  }
  return true;
}

}  // namespace

std::span<const Route> routes() {
  return kRoutes;
}

Lane lane_of(const Request& request) {
  std::string id;
  for (const Route& route : routes())
    if (route.method == (request.method == "HEAD" ? "GET" : request.method) &&
        matches(route.pattern, request.path, id))
      return route.lane;
  return Lane::pages;
}

bool matches(std::string_view pattern, std::string_view path, std::string& id) {
  const std::size_t hole = pattern.find('{');
  if (hole == pattern.npos) return pattern == path;
  const std::string_view before = pattern.substr(0, hole), after = pattern.substr(pattern.find('}') + 1);
  if (path.size() != before.size() + 36 + after.size()) return false;
  const std::string_view found = path.substr(hole, 36);
  if (path.substr(0, hole) != before || path.substr(hole + 36) != after || !is_uuid(found)) return false;
  id = found;
  return true;
}

std::string routes_markdown() {
  std::string text =
      "# Routes of the dashboard\n\n"
      "Generated from the registry in `web/routes.cpp`; a test compares. HEAD is answered as GET without a body. "
      "What a\n"
      "reader may not see answers 404 with the same page as what does not exist. A page asked without a session "
      "goes to\n"
      "`/login` (303); the other routes answer 401. Every POST needs the form's token and a browser's word that it "
      "comes\n"
      "from this server (`Sec-Fetch-Site: same-origin`, or an `Origin` that names it), else 403.\n\n"
      "| method | path | who | scope | answers |\n|---|---|---|---|---|\n";
  for (const Route& route : routes()) {
    std::string who;
    for (const casedb::Role role : casedb::kAllRoles) {
      if (!route.who.roles.has(role)) continue;
      if (!who.empty()) who += ", ";
      who += casedb::name_of(role);
    }
    if (route.who.roles == kOpen.roles) who = "anyone";
    if (route.who.roles == kEveryRole) who = "any role";
    text.append("| ").append(route.method).append(" | `").append(route.pattern).append("` | ").append(who);
    text.append(" | ").append(route.scope).append(" | ").append(route.summary).append(" |\n");
  }
  return text;
}

}  // namespace seldinger::web
