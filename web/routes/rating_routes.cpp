// Replays rated by whoever has a rater's key: nobody is logged in, and nothing tells whose a replay is. What the
// browser keeps is the key's hash, which the library knows only as a hash of its own.
#include <charconv>

#include "reports/pages/rating_pages.h"
#include "reports/pages/style_sheet.h"
#include "web/routes/answering.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

constexpr std::string_view kRaterCookieRest = "; Path=/rate; HttpOnly; SameSite=Strict; Max-Age=604800";

std::string rater_cookie(const Site& site, std::string_view value) {
  return site.cookies.rater + "=" + std::string(value) + std::string(kRaterCookieRest);
}

Response rating_start(Site& site, const Call& call, int status, const std::string& problem) {
  const KeptForm kept = form_kept(site, call, site.cookies.rater);
  Response response = html_response(status, reports::rating_start_page(site.login_token(kept.secret), problem));
  if (kept.is_new) response.headers.emplace_back("Set-Cookie", rater_cookie(site, kept.secret));
  return response;
}

// Digits alone; 0: none.
std::size_t number_in(std::string_view digits) {
  std::size_t number = 0;
  const auto read = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  return read.ec == std::errc() && read.ptr == digits.data() + digits.size() ? number : 0;
}

Response replay_page(Site& site, const Call& call, int status, const casedb::RatingPage& page,
                     const std::map<std::string, std::string>& typed,
                     const std::map<std::string, std::string>& problems) {
  const std::string kept = cookie(call.request, site.cookies.rater);
  return answering_response(status, reports::rating_page({site.login_token(kept), &page, typed, problems}));
}

// What is to be sent and has an item without an answer that could be "not applicable": a slip, which would cost the
// rating its mean.
std::map<std::string, std::string> unanswered(const assessment::questionnaire::Form& form,
                                              const std::map<std::string, std::string>& typed) {
  std::map<std::string, std::string> problems;
  for (const auto& item : form.items)
    if (const auto found = typed.find(item.id);
        item.not_applicable && (found == typed.end() || found->second.empty()))
      problems.emplace(item.id, "Please rate this, or say that it is not applicable.");
  return problems;
}

// To whoever has no bench, and of a number that is none of theirs.
Response no_replay(const base::Error& error) {
  return redirect(error.code == "no_rater" ? "/rate" : "/rate/bench");
}

}  // namespace

Response show_film_script(Site&, const Call&) {
  return {.content_type = "text/javascript; charset=utf-8", .body = std::string(reports::film_script())};
}

Response show_rating_start(Site& site, const Call& call) {
  if (site.questions.find_rating_bench(cookie(call.request, site.cookies.rater))) return redirect("/rate/bench");
  return rating_start(site, call, 200, "");
}

Response open_rating_bench(Site& site, const Call& call) {
  if (!has_form_token(site, call, cookie(call.request, site.cookies.rater)))
    return rating_start(site, call, 403, "The page was too old. Please try again.");
  const std::string secret = casedb::rater_secret(call.field("key"));
  if (!site.questions.find_rating_bench(secret))
    return rating_start(site, call, 404, "No rater has that key. Is it typed correctly?");
  Response response = redirect("/rate/bench");
  response.headers.emplace_back("Set-Cookie", rater_cookie(site, secret));
  return response;
}

Response show_rating_bench(Site& site, const Call& call) {
  const auto bench = site.questions.find_rating_bench(cookie(call.request, site.cookies.rater));
  if (!bench) return redirect("/rate");
  return html_response(200, reports::rating_bench_page(*bench));
}

Response show_rating(Site& site, const Call& call) {
  const std::string_view query = call.request.query;
  const std::size_t number = query.substr(0, 2) == "n=" ? number_in(query.substr(2)) : 0;
  const auto page = site.questions.find_rating(cookie(call.request, site.cookies.rater), number);
  if (!page) return no_replay(page.error());
  return replay_page(site, call, 200, *page, {}, {});
}

Response keep_rating(Site& site, const Call& call) {
  const std::string kept = cookie(call.request, site.cookies.rater);
  const std::string go = call.field("go");
  if (!has_form_token(site, call, kept))
    return go == "keep" ? Response{.status = 403} : rating_start(site, call, 403, "The page was too old.");
  const std::size_t number = number_in(call.field("n"));
  const auto page = site.questions.find_rating(kept, number);
  if (!page) return go == "keep" ? Response{.status = 404} : no_replay(page.error());
  std::vector<const assessment::questionnaire::Item*> items;
  for (const auto& item : page->form.form.items) items.push_back(&item);
  auto typed = typed_of(call, items);
  if (go == "keep")
    return kept_response(site.questions.keep_rating(kept, number, fitting(page->form.form, typed), false));
  const auto open = unanswered(page->form.form, typed);
  if (go == "send" && !open.empty() && !page->task.sent) return replay_page(site, call, 400, *page, typed, open);
  const auto done = site.questions.keep_rating(kept, number, typed, go == "send");
  if (!done && done.error().code == "bad_answer")
    return replay_page(site, call, 400, *page, typed, problems_of(page->form.form, typed));
  // What was sent meanwhile, and a round that was closed, say so there.
  const bool look = !done || (go == "send" && page->task.part == assessment::rating::Part::calibration);
  return redirect(look ? "/rate/replay?n=" + std::to_string(number) : "/rate/bench");
}

namespace {

constexpr Route kRatingRoutes[] = {
    {"GET", "/film.js", kOpen, false, "", "the script that plays a replay to rate", show_film_script},
    {"GET", "/rate", kOpen, true, "", "asks for a rater's key", show_rating_start},
    {"POST", "/rate", kOpen, true, "", "opens the bench of a rater: key, token", open_rating_bench},
    {"GET", "/rate/bench", kOpen, true, "the browser of a rater", "the replays that are theirs to rate, by number",
     show_rating_bench},
    {"GET", "/rate/replay", kOpen, true, "the browser of a rater", "a replay beside the form; ?n=N", show_rating},
    {"POST", "/rate/replay", kOpen, true, "the browser of a rater",
     "keeps a rating, or sends it: n, go, a field each item, token", keep_rating},
};

}  // namespace

std::span<const Route> rating_routes() {
  return kRatingRoutes;
}

}  // namespace seldinger::web
