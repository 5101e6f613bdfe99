#include "web/site/site.h"

#include <exception>

#include "casedb/database/credentials.h"
#include "sim/base/failure.h"

namespace seldinger::web {
namespace {

struct Words {
  std::string_view title, message;
};

Words words_for(int status) {
  switch (status) {
    case 400:
      return {"Not understood", "The request is not well formed."};
    case 401:
      return {"Not logged in", "Log in first."};
    case 403:
      return {"Refused",
              "This form did not come from a page of this server, or the page is too old. Go back, reload and try "
              "again."};
    case 404:
      return {"Not found", "There is nothing here, or it is not yours to see."};
    case 405:
      return {"Not possible", "This address does not accept that method."};
    case 415:
      return {"Not understood", "Only forms are accepted here."};
    case 421:
      return {"Refused", "This server does not answer under that name."};
    case 503:
      return {"Not available", "The library cannot be read right now. Try again later."};
    default:
      return {"Something went wrong", "The page could not be made."};
  }
}

// What a form held is overwritten when it is answered.
struct WipedLater {
  std::map<std::string, std::string>& form;
  ~WipedLater() { wipe(form); }
};

// When not even a page can be made.
Response plain_error(int status) noexcept {
  return {.status = status, .content_type = "text/plain", .body = "error\n"};
}

}  // namespace

Response refusal(int status, const Reader* reader, std::string_view fault_id) {
  const Words words = words_for(status);
  std::string message(words.message);
  if (!fault_id.empty())
    message.append(" The server\u2019s log has a line about it: ").append(fault_id).append(".");
  const reports::Visitor visitor = reader != nullptr ? reader->visitor() : reports::Visitor{};
  return html_response(status, reports::message_page(words.title, message, visitor));
}

CookieNames::CookieNames(int port)
    : session("seldinger_" + std::to_string(port)),
      before_login("seldinger_before_login_" + std::to_string(port)),
      answers("seldinger_answers_" + std::to_string(port)),
      rater("seldinger_rater_" + std::to_string(port)),
      known("seldinger_known_" + std::to_string(port)) {}

Site::Site(Questions& questions_in, const Surroundings& surroundings_in, std::span<const Route> routes)
    : questions(questions_in),
      surroundings(surroundings_in),
      cookies(surroundings_in.port),
      sessions(surroundings_in, questions_in.list_sessions(surroundings_in.port)),
      security(surroundings_in),
      routes_(routes),
      secret_(surroundings_in.random_id()) {}

void Site::keep_sessions() {
  sessions.keep(
      [this](const casedb::WebSessionChanges& changes) { questions.keep_sessions(surroundings.port, changes); });
}

std::string Site::login_token(const std::string& before_login_id) const {
  // Both parts have a fixed length, so that nothing can be moved from one to the other.
  return before_login_id.size() == 64 ? surroundings.sha256_hex(secret_ + before_login_id) : "";
}

std::string Site::known_browser(const std::string& name) const {
  const std::string id = surroundings.random_id();
  return id + surroundings.sha256_hex(secret_ + id + casedb::folded_name(name));
}

std::string Site::place_of(const Request& request, const std::string& name) {
  const std::string known = cookie(request, cookies.known), folded = casedb::folded_name(name);
  if (known.size() == 128 &&
      equal_in_constant_time(known.substr(64), surroundings.sha256_hex(secret_ + known.substr(0, 64) + folded)))
    return "browser " + known.substr(0, 64);
  const auto reader = reader_of(request);
  if (reader && casedb::folded_name(reader->account.login_name) == folded)
    return "session of " + reader->account.person_id;
  return "address " + request.from;
}

std::string Site::account_id(const std::string& name) {
  const std::string folded = casedb::folded_name(name);
  for (const casedb::Account& one : questions.list_accounts())
    if (casedb::folded_name(one.login_name) == folded) return one.person_id;
  return {};
}

std::int64_t Site::wait_before_log_in_s(const std::string& name, const std::string& place) {
  const std::int64_t now_us = surroundings.now_us();
  const std::int64_t wait_s = delays.begin(name, place, now_us);
  if (wait_s == 0) return 0;
  const std::string person_id = account_id(name);
  const std::int64_t let_in = questions.last_let_in_again(person_id);  // asked of nobody's name too
  if (person_id.empty() || !delays.heed(name, let_in)) return wait_s;
  return delays.begin(name, place, now_us);
}

Lane Site::lane_of(const Request& request) {
  Lane lane = Lane::pages;
  std::string id_in_path;
  for (const Route& route : routes_)
    if (route.method == (request.method == "HEAD" ? "GET" : request.method) &&
        matches(route.pattern, request.path, id_in_path))
      lane = !route.kept_as.empty() && answers.holds(std::string(route.kept_as) + id_in_path) ? Lane::pages
                                                                                              : route.lane;
  if (lane == Lane::pages || lane == Lane::log_in) return lane;
  const casedb::Secret id{cookie(request, cookies.session)};
  return sessions.find(id.text) ? lane : Lane::pages;
}

std::string Site::log_fault(const std::string& what) const {
  std::string id = surroundings.random_id().substr(0, 8);
  surroundings.log("error " + id + ": " + what);
  return id;
}

Response Site::fault(int status, const Reader* reader, const std::string& what) const {
  return refusal(status, reader, log_fault(what));
}

std::optional<Reader> Site::reader_of(const Request& request) {
  const casedb::Secret id{cookie(request, cookies.session)};
  const auto session = sessions.find(id.text);
  if (!session.has_value()) return std::nullopt;
  // Asked every time, so that a disabled account or an old password is out at once and a changed role holds at
  // once.
  const auto account = questions.find_account(session->person_id);
  if (!account.has_value() || !account->enabled || account->password_mark != session->password_mark) {
    sessions.end(id.text);  // others may have begun since
    security.note("session ended: the account was changed", request.from, session->person_id);
    return std::nullopt;
  }
  return Reader{*account, session->form_token};
}

Response Site::route(const Request& request, std::string_view& pattern) {
  const std::string host = request.header("host");
  const bool proxied = !surroundings.public_authority.empty() && host == surroundings.public_authority;
  if (!proxied && !is_loopback_host_header(host)) return refusal(421, nullptr);
  const std::string method = request.method == "HEAD" ? "GET" : request.method;

  const Route* found = nullptr;
  std::string allowed, id;
  for (const Route& candidate : routes_) {
    if (!matches(candidate.pattern, request.path, id)) continue;
    if (!allowed.empty()) allowed += ", ";
    allowed += candidate.method == "GET" ? "GET, HEAD" : candidate.method;
    if (candidate.method == method) found = &candidate;
  }
  if (found != nullptr) pattern = found->pattern;
  const bool is_change = method == "POST";
  if (found != nullptr && is_change && !is_same_origin(request, surroundings.public_authority))
    return refusal(403, nullptr);

  const auto reader = reader_of(request);
  const Reader* who = reader.has_value() ? &*reader : nullptr;
  if (allowed.empty()) return refusal(404, who);
  if (found == nullptr) {
    Response response = refusal(405, who);
    response.headers.emplace_back("Allow", allowed);
    return response;
  }

  Call call{request, who, id};
  const WipedLater wiped{call.form};
  if (is_change) {
    const std::string type = request.header("content-type");
    if (type.substr(0, type.find(';')) != "application/x-www-form-urlencoded") return refusal(415, who);
    auto form = form_fields(request.body);
    if (!form.has_value()) return refusal(400, who);
    call.form = std::move(*form);
  }
  if (found->who.roles != kOpen.roles) {
    if (who == nullptr) return found->is_page ? redirect("/login") : refusal(401, nullptr);
    if (is_change && !equal_in_constant_time(call.form["token"], who->form_token)) return refusal(403, who);
    if (!found->who.roles.has(who->account.role)) return refusal(404, who);
  }
  return found->handle(*this, call);
}

Response Site::answer(const Request& request) noexcept {
  std::string_view pattern;
  try {
    const std::int64_t begun_us = surroundings.now_us();
    Response response = answer(request, pattern);
    tally.add(pattern, response.status, surroundings.now_us() - begun_us);
    return response;
  } catch (...) {
    return plain_error(500);
  }
}

Response Site::answer(const Request& request, std::string_view& pattern) {
  try {
    Response response = route(request, pattern);
    // A browser that came by TLS sends its cookies by TLS alone.
    if (!surroundings.public_authority.empty() && request.header("host") == surroundings.public_authority)
      for (auto& [name, value] : response.headers)
        if (name == "Set-Cookie") value += "; Secure";
    return response;
  } catch (const base::Failure& failure) {
    return fault(503, nullptr, failure.code() + ": " + failure.what());
  } catch (const std::exception&) {
    // Its text may hold anything, so it goes nowhere.
    return fault(500, nullptr, "internal: a page could not be made");
  }
}

}  // namespace seldinger::web
