// The web site as a function from request to response, without sockets.
#pragma once

#include <optional>
#include <string>

#include "reports/pages/page.h"
#include "web/http.h"
#include "web/login_limits.h"
#include "web/questions.h"
#include "web/sessions.h"
#include "web/surroundings.h"

namespace seldinger::web {

// Somebody who is logged in.
struct Reader {
  casedb::Account account;
  std::string form_token;
  reports::Visitor visitor() const { return {account.login_name, casedb::name_of(account.role), form_token}; }
};

// Answers from several threads at once. Never throws: a base::Failure becomes 503, anything else 500, both without
// a word about the inside.
class Site {
 public:
  // Both outlive the site.
  Site(Questions& questions, const Surroundings& surroundings);

  Response answer(const Request& request) noexcept;

  Questions& questions;
  const Surroundings& surroundings;
  Sessions sessions;
  LoginThrottle throttle;
  LoginGate gate;

  // The token of the log-in form, bound to the cookie of the browser that asked for it.
  std::string login_token(const std::string& before_login_id) const;

 private:
  Response route(const Request& request);
  std::optional<Reader> reader_of(const Request& request);

  std::string secret_;
};

inline constexpr std::string_view kSessionCookie = "seldinger_session";
inline constexpr std::string_view kBeforeLoginCookie = "seldinger_before_login";

// A page that says why not. `reader` may be null.
Response refusal(int status, const Reader* reader);

}  // namespace seldinger::web
