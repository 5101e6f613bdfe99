// The web site as a function from request to response, without sockets.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "casedb/people/login_delays.h"
#include "reports/pages/page.h"
#include "web/site/answers.h"
#include "web/site/http.h"
#include "web/site/questions.h"
#include "web/site/route.h"
#include "web/site/security_log.h"
#include "web/site/sessions.h"
#include "web/site/surroundings.h"
#include "web/site/tally.h"

namespace seldinger::web {

// Somebody who is logged in.
struct Reader {
  casedb::Account account;
  std::string form_token;
  reports::Visitor visitor() const { return {account.login_name, casedb::name_of(account.role), form_token}; }
};

// What browsers call our cookies, for the server's port.
struct CookieNames {
  explicit CookieNames(int port);
  std::string session;       // "seldinger_8080"
  std::string before_login;  // of the log-in form
  std::string answers;       // of a questionnaire that is being answered
  std::string rater;         // of a rater's bench
  std::string known;         // that this browser has logged somebody in: see casedb::LoginDelays
};

// Answers from several threads at once. Never throws: a base::Failure becomes 503, anything else 500, both without
// a word about the inside, but for an id that stands in the log as well.
class Site {
 public:
  // All outlive the site. Who was logged in at this port before still is.
  Site(Questions& questions, const Surroundings& surroundings, std::span<const Route> routes);

  Response answer(const Request& request) noexcept;

  Questions& questions;
  const Surroundings& surroundings;
  const CookieNames cookies;
  Sessions sessions;
  casedb::LoginDelays delays;
  SecurityLog security;
  Answers answers;  // heavy ones
  Tally tally;

  // Writes who is logged in for the next start, as far as the library does not know it. Throws where it cannot.
  void keep_sessions();
  // The token of the log-in form, bound to the cookie of the browser that asked for it.
  std::string login_token(const std::string& before_login_id) const;
  // What a browser keeps that has logged in under this name, so that it is told from those who only know the name.
  std::string known_browser(const std::string& name) const;
  // Where this request tries to log in from under this name.
  std::string place_of(const Request& request, const std::string& name);
  std::string account_id(const std::string& name);  // empty: nobody has that name
  // As LoginDelays::begin; whom a command let in again meanwhile need not wait (casedb/people/noted_tries.h).
  std::int64_t wait_before_log_in_s(const std::string& name, const std::string& place);
  // Which threads answer it. What needs a session and has none is only refused, as pages are.
  Lane lane_of(const Request& request);
  // Logs what happened (no patient data, no names) under an id, which the page carries.
  std::string log_fault(const std::string& what) const;
  Response fault(int status, const Reader* reader, const std::string& what) const;

 private:
  // In both `pattern` is filled with that of the route that answers.
  Response answer(const Request& request, std::string_view& pattern);
  Response route(const Request& request, std::string_view& pattern);
  std::optional<Reader> reader_of(const Request& request);

  const std::span<const Route> routes_;
  std::string secret_;
};

// A page that says why not. `reader` may be null; `fault_id` empty.
Response refusal(int status, const Reader* reader, std::string_view fault_id = {});

}  // namespace seldinger::web
