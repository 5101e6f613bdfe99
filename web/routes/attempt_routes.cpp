// Attempts: the list, one of them, what is said of it.
#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>

#include "reports/pages/attempt_page.h"
#include "reports/pages/attempts_page.h"
#include "reports/pages/style_sheet.h"
#include "web/json/attempt_json.h"
#include "web/json/lists_json.h"
#include "web/json/replay_json.h"
#include "web/json/skin_json.h"
#include "web/routes/said.h"
#include "web/routes/shelves.h"
#include "web/site/access.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

constexpr std::size_t kRowsOfAPage = 50;
constexpr std::string_view kDrawn = "pictures ";  // as site.answers keeps them, by attempt
constexpr std::string_view kSeen =
    "trainee: own; mentor: own, own cohort, simulated; director: own programmes; researcher: consenting people of "
    "own studies as pseudonyms, simulated";
constexpr std::string_view kRecordingSeen =
    "trainee: own; mentor: own, own cohort, simulated; director: own programmes; researcher: simulated";
constexpr std::string_view kSeenOrNone = "the same; admin: none, the page says so";

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

// What a reader sees of the list.
struct AttemptList {
  std::vector<reports::AttemptView> views;
  reports::ListPart part;
};

AttemptList visible_attempts(Site& site, const Call& call) {
  const casedb::Account& account = call.reader->account;
  const Relations relations = site.questions.relations_of(account.person_id);
  const casedb::WhoseAttempts seen = attempts_seen(account.role, relations);
  const std::size_t total = site.questions.count_attempts(seen);
  const std::size_t pages = std::max<std::size_t>(1, (total + kRowsOfAPage - 1) / kRowsOfAPage);
  const std::size_t page = wanted_page(call.request, pages);
  auto rows = site.questions.list_attempts(seen, (page - 1) * kRowsOfAPage, kRowsOfAPage);

  std::map<std::string, std::optional<casedb::Account>> accounts;  // of those on the page
  const AccountOf account_of = [&](const std::string& person_id) {
    const auto [at, is_new] = accounts.try_emplace(person_id);
    if (is_new) at->second = site.questions.find_account(person_id);
    return at->second;
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
  return {std::move(views), {page, pages, total, account.role == casedb::Role::trainee}};
}

Response list_attempts(Site& site, const Call& call) {
  if (!casedb::roles_that_may(Action::see_attempt).has(call.reader->account.role))
    return html_response(200, reports::no_attempts_page(call.reader->visitor()));
  const AttemptList list = visible_attempts(site, call);
  return list_response(reports::attempts_page(call.reader->visitor(), list.views, list.part));
}

Response list_attempts_json(Site& site, const Call& call) {
  const AttemptList list = visible_attempts(site, call);
  return json_response(attempts_json(list.views, list.part));
}

// The attempt when it exists and this reader may see it. Both are asked before either is answered.
std::optional<casedb::AttemptRow> visible_attempt(Site& site, const Call& call) {
  auto row = site.questions.find_attempt(call.id);
  const Relations relations = site.questions.relations_of(call.reader->account.person_id);
  if (!row.has_value() || !may_see_attempt(call.reader->account.role, relations, *row)) return std::nullopt;
  return std::move(*row);
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
  view.may_replay = casedb::may(role, casedb::Action::see_recording, relation_to(relations, row->person_id));
  view.may_comment = casedb::may(role, casedb::Action::comment_attempt, relation_to(relations, row->person_id));
  Response response = html_response(
      200,
      reports::attempt_page(call.reader->visitor(), view, recording.has_value() ? &recording.value() : nullptr));
  response.policy = Policy::replay;
  return response;
}

Response comment_attempt(Site& site, const Call& call) {
  const auto row = visible_attempt(site, call);
  const casedb::Account& account = call.reader->account;
  const Relations relations = site.questions.relations_of(account.person_id);
  if (!row || !casedb::may(account.role, casedb::Action::comment_attempt, relation_to(relations, row->person_id)))
    return refusal(404, call.reader);
  const std::string at = call.field("at");
  double at_s = 0.0;
  const auto read = std::from_chars(at.data(), at.data() + at.size(), at_s, std::chars_format::fixed);
  if (!at.empty() && (read.ec != std::errc() || read.ptr != at.data() + at.size()))
    return refusal(400, call.reader);
  const auto said = site.questions.add_comment(account.person_id, row->attempt_id, at_s, call.field("text"));
  return said ? redirect("/attempts/" + row->attempt_id + "#comments") : refusal(400, call.reader);
}

bool is_png(const std::vector<std::byte>& bytes) {
  constexpr std::string_view kSignature = "\x89PNG\r\n\x1a\n";
  return bytes.size() > kSignature.size() && std::memcmp(bytes.data(), kSignature.data(), kSignature.size()) == 0;
}

Response png_response(const Site& site, const Call& call, const std::vector<std::byte>& png) {
  Response response{.content_type = "image/png", .policy = Policy::picture};
  response.body.resize(png.size());
  std::memcpy(response.body.data(), png.data(), png.size());
  const std::string tag = "\"" + site.surroundings.sha256_hex(response.body) + "\"";
  if (call.request.header("if-none-match") == tag) {
    response.status = 304;
    response.body.clear();
  }
  response.headers.emplace_back("ETag", tag);
  return response;
}

Response show_picture(Site& site, const Call& call) {
  const auto row = visible_attempt(site, call);
  if (!row.has_value() || row->picture_sha256.empty()) return refusal(404, call.reader);
  const auto picture = site.questions.load_picture(*row);
  if (!picture.has_value() || !is_png(*picture)) {
    const std::string code = picture.has_value() ? "not_png" : picture.error().code;
    return site.fault(500, call.reader, code + ": a stored picture cannot be shown");
  }
  return png_response(site, call, *picture);
}

// The same, where the reader may also see it pose by pose.
std::optional<casedb::AttemptRow> replayable_attempt(Site& site, const Call& call) {
  auto row = visible_attempt(site, call);
  const casedb::Account& account = call.reader->account;
  const Relations relations = site.questions.relations_of(account.person_id);
  if (!row || !casedb::may(account.role, Action::see_recording, relation_to(relations, row->person_id)))
    return std::nullopt;
  return row;
}

Response show_replay(Site& site, const Call& call) {
  const auto row = replayable_attempt(site, call);
  if (!row.has_value()) return refusal(404, call.reader);
  const auto recording = site.questions.load_recording(row->attempt_id);
  if (!recording.has_value()) return refusal(404, call.reader);
  return {.content_type = "application/json", .body = replay_json(*row, *recording)};
}

Response show_skin(Site& site, const Call& call) {
  const auto row = replayable_attempt(site, call);
  if (!row.has_value()) return refusal(404, call.reader);
  auto skin = site.answers.get("skin " + row->case_id, [&]() -> base::Result<Answers::Made> {
    const auto mesh = site.questions.load_skin(row->case_id);
    if (!mesh) return mesh.error();
    return Answers::Made{skin_json(*mesh)};
  });
  if (!skin) return site.fault(500, call.reader, skin.error().code + ": a skin cannot be shown");
  return {.content_type = "application/json", .body = (*skin)->text};
}

base::Result<std::shared_ptr<const Answers::Made>> drawn_pictures(Site& site, const std::string& attempt_id) {
  return site.answers.get(std::string(kDrawn) + attempt_id, [&]() -> base::Result<Answers::Made> {
    auto drawn = site.questions.pictures_of(attempt_id);
    if (!drawn) return drawn.error();
    return Answers::Made{std::move(drawn->markup), true, std::move(drawn->pngs)};
  });
}

Response show_pictures(Site& site, const Call& call) {
  auto row = replayable_attempt(site, call);
  if (!row.has_value()) return refusal(404, call.reader);
  const auto drawn = drawn_pictures(site, row->attempt_id);
  const base::Result<std::string> markup = drawn ? base::Result<std::string>((*drawn)->text) : drawn.error();
  const casedb::Account& account = call.reader->account;
  const AccountOf account_of = [&](const std::string& person_id) { return site.questions.find_account(person_id); };
  const std::string label =
      operator_label(account.role, site.questions.relations_of(account.person_id), *row, account_of);
  withhold(account.role, *row);
  return html_response(200, reports::attempt_pictures_page(call.reader->visitor(), {*row, label}, markup));
}

// One of them, as the page names it.
Response show_drawn_picture(Site& site, const Call& call) {
  const auto row = replayable_attempt(site, call);
  if (!row.has_value()) return refusal(404, call.reader);
  const auto asked = form_fields(call.request.query);
  std::size_t number = 1;
  if (const auto n = asked ? asked->find("n") : std::map<std::string, std::string>::iterator{};
      asked && n != asked->end() &&
      std::from_chars(n->second.data(), n->second.data() + n->second.size(), number).ec != std::errc())
    return refusal(404, call.reader);
  const auto drawn = drawn_pictures(site, row->attempt_id);
  if (!drawn || number < 1 || number > (*drawn)->pictures.size()) return refusal(404, call.reader);
  return png_response(site, call, (*drawn)->pictures[number - 1]);
}

Response show_replay_script(Site&, const Call&) {
  return {.content_type = "text/javascript; charset=utf-8", .body = std::string(reports::replay_script())};
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

constexpr Route kAttemptRoutes[] = {
    {"GET", "/replay.js", kOpen, false, "", "the script that draws the replay", show_replay_script},
    {"GET", "/attempts", kAnyRole, true, kSeenOrNone, "the list, newest first; ?page=N", list_attempts},
    {"GET", "/attempts.json", Action::see_attempt, false, kSeen, "the same list; ?page=N", list_attempts_json},
    {"GET", "/attempts/{attempt_id}", Action::see_attempt, true, kSeen,
     "one attempt: debrief, criteria, metrics, picture, course", show_attempt},
    {"GET", "/attempts/{attempt_id}/picture.png", Action::see_attempt, false, kSeen,
     "the picture at the moment of firing", show_picture},
    {"GET", "/attempts/{attempt_id}/replay.json", Action::see_recording, false, kRecordingSeen,
     "its course for the replay: poses in LPS, target, what the pictures showed of the tip", show_replay},
    {"GET", "/attempts/{attempt_id}/skin.json", Action::see_recording, false, kRecordingSeen,
     "a coarse net of the patient's skin for the replay, in LPS", show_skin, Lane::heavy},
    {"GET", "/attempts/{attempt_id}/pictures", Action::see_recording, true, kRecordingSeen,
     "what was on the screen at its key moments and where the needle was, drawn when first asked for",
     show_pictures, Lane::heavy, kDrawn},
    {"GET", "/attempts/{attempt_id}/pictures.png", Action::see_recording, false, kRecordingSeen,
     "one of those pictures; ?n=N", show_drawn_picture, Lane::heavy, kDrawn},
    {"GET", "/attempts/{attempt_id}/metrics.json", Action::see_attempt, false, kSeen,
     "its metrics as `score` prints them", show_metrics},
    {"GET", "/attempts/{attempt_id}/grade.json", Action::see_attempt, false, kSeen,
     "its grade, score and sentences as `score` prints them; of experts to others than mentors only rounded bands",
     show_grade},
    {"POST", "/attempts/{attempt_id}/comments", Action::comment_attempt, true, "mentor: own cohort",
     "comments on a moment of it: at, text, token", comment_attempt, Lane::changes},
};

}  // namespace

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

std::span<const Route> attempt_routes() {
  return kAttemptRoutes;
}

}  // namespace seldinger::web
