// What somebody decides of themselves: consent, facts, deletion.
#include <charconv>
#include <map>
#include <utility>

#include "reports/pages/me_page.h"
#include "web/json/lists_json.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;
constexpr std::string_view kSelf = "of oneself";

// What /me says was done, by the query of the redirect; %: the number behind it.
struct Done {
  std::string_view query, text;
};
constexpr Done kConsented{"consented", "Noted: you consent."};
constexpr Done kWithdrew{"withdrew", "Noted: you do not consent."};
constexpr Done kSaved{"saved", "Saved."};
constexpr Done kErased{"erased=", "Attempts deleted: %. They cannot be brought back."};
constexpr Done kErasedNotYet{"erased-later=",
                             "Attempts deleted: %. Old bytes of them stay in the library's files until nobody is "
                             "using it: tell whoever runs it."};

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

Response show_me_json(Site& site, const Call& call) {
  return json_response(about_json(site.questions.about(call.reader->account.person_id)));
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
  const std::string text_id = call.field("text"), answer = call.field("answer");
  if (answer == "give") return after(site, call, site.questions.give_consent(person_id, text_id), kConsented);
  if (answer != "withdraw") return problem(site, call, "Choose to consent or to withdraw.");
  const auto withdrawn = site.questions.withdraw_consent(person_id, text_id);
  if (!withdrawn || call.field("delete") != "yes") return after(site, call, withdrawn, kWithdrew);
  return erase_attempts(site, call);
}

Response give_facts(Site& site, const Call& call) {
  const auto given = casedb::newest_facts(site.questions.about(call.reader->account.person_id).facts);
  std::map<std::string, std::string> answers, typed;
  for (const casedb::FactInfo& fact : casedb::fact_infos()) {
    const std::string id(fact.id), answer = call.field(id);
    const auto last = given.find(id);
    typed.emplace(id, answer);
    if (!answer.empty() && (last == given.end() || last->second.answer != answer)) answers.emplace(id, answer);
  }
  const auto saved = site.questions.give_facts(call.reader->account.person_id, answers);
  if (!saved) return me(site, call, 400, {.problem = saved.error().text, .typed = std::move(typed)});
  return after(site, call, saved, kSaved);
}

Response erase_own(Site& site, const Call& call) {
  if (call.field("sure") != "yes") return problem(site, call, "Tick the box if you are sure.");
  return erase_attempts(site, call);
}

constexpr Route kMeRoutes[] = {
    {"GET", "/me", Action::answer_consent, true, kSelf, "consent, facts, deletion", show_me},
    {"GET", "/me.json", Action::answer_consent, false, kSelf, "consents and facts", show_me_json},
    {"POST", "/me/consent", Action::answer_consent, true, kSelf, "gives or withdraws: text, answer, delete, token",
     answer_consent, Lane::changes},
    {"POST", "/me/facts", Action::answer_consent, true, kSelf, "gives facts: one field each, token", give_facts,
     Lane::changes},
    {"POST", "/me/erase", Action::erase_attempts, true, kSelf, "erases what one has recorded: sure, token",
     erase_own, Lane::changes},
};

}  // namespace

std::span<const Route> me_routes() {
  return kMeRoutes;
}

}  // namespace seldinger::web
