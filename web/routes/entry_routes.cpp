// The way in and out, and what everybody may ask.
#include "casedb/database/credentials.h"
#include "reports/pages/login_page.h"
#include "reports/pages/style_sheet.h"
#include "sim/base/failure.h"
#include "web/json/attempt_json.h"
#include "web/json/case_json.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

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

Response healthz(Site& site, const Call&) {
  const casedb::Health health = site.questions.health();
  return {.status = health == casedb::Health::ok ? 200 : 503,
          .content_type = "application/json",
          .body = health_json(health, site.surroundings.program_version)};
}

Response style(Site&, const Call&) {
  return {.content_type = "text/css; charset=utf-8", .body = std::string(reports::style_sheet())};
}

Response icon(Site&, const Call&) {
  return {.content_type = "image/svg+xml", .body = std::string(reports::icon())};
}

Response tables_script(Site&, const Call&) {
  return {.content_type = "text/javascript; charset=utf-8", .body = std::string(reports::tables_script())};
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
  if (call.reader != nullptr) return redirect("/");
  return login_form(site, call, 200, "");
}

Response log_in(Site& site, const Call& call) {
  const std::string token = site.login_token(cookie(call.request, site.cookies.before_login));
  if (token.empty() || !equal_in_constant_time(call.field("token"), token)) {
    return login_form(site, call, 403, "The page was too old. Please try again.");
  }
  const std::string name = call.field("name");
  const std::string place = site.place_of(call.request, name);
  if (const std::int64_t wait_s = site.wait_before_log_in_s(name, place); wait_s > 0) {
    site.security.note("log-in delayed", call.request.from, site.account_id(name));
    Response response =
        login_form(site, call, 429, "Too many tries. Try again in " + std::to_string(wait_s) + " s.");
    response.headers.emplace_back("Retry-After", std::to_string(wait_s));
    return response;
  }
  const casedb::Secret password{call.field("password")};
  std::optional<casedb::Account> account;
  try {
    account = site.questions.log_in(name, password.text);
  } catch (const base::Failure&) {
    site.delays.take_back(name, place);  // nobody was told whether it was right
    throw;
  }
  if (!account.has_value() || !account->enabled) {
    site.security.note("log-in failed", call.request.from, site.account_id(name));
    return login_form(site, call, 403, "Wrong name or password.");
  }
  site.delays.forget(name, place);
  site.security.note("logged in", call.request.from, account->person_id);
  const casedb::Secret old{cookie(call.request, site.cookies.session)};
  site.sessions.end(old.text);
  const casedb::Secret id{site.sessions.begin(account->person_id, account->password_mark)};
  try {
    site.keep_sessions();
  } catch (const base::Failure&) {
    // The next minute's try may do it; until then a restart would end the session.
  }
  Response response = redirect("/");
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
    site.keep_sessions();
  } catch (const base::Failure& failure) {
    site.log_fault(failure.code() + ": a log-out is not kept in the library");
  }
  Response response = redirect("/login");
  response.headers.emplace_back("Set-Cookie", drop_cookie(site.cookies.session));
  return response;
}

constexpr Route kEntryRoutes[] = {
    {"GET", "/healthz", kOpen, false, "",
     "`ok`, `moved`, `full` or `read_only` (503) as the library is, and the version, as JSON", healthz},
    {"GET", "/style.css", kOpen, false, "", "the style sheet", style},
    {"GET", "/icon.svg", kOpen, false, "", "the icon of the pages", icon},
    {"GET", "/tables.js", kOpen, false, "", "the script that orders and narrows lists", tables_script},
    {"GET", "/login", kOpen, true, "", "the log-in form", show_login},
    {"POST", "/login", kOpen, true, "", "logs in: name, password, token", log_in, Lane::log_in},
    {"POST", "/logout", kAnyRole, true, "", "ends the session: token", log_out, Lane::changes},
};

}  // namespace

std::span<const Route> entry_routes() {
  return kEntryRoutes;
}

}  // namespace seldinger::web
