// A row of the registry: what is asked, by whom, and who answers.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "casedb/cases/permissions.h"
#include "web/site/http.h"
#include "web/site/lane.h"

namespace seldinger::web {

class Site;
struct Reader;

using casedb::kEveryRole;
using casedb::Roles;

// Who a route is for: whoever may do an action to something of this kind, whosever it is, so that nobody else
// learns that there is such a route; the handler asks the table again about the thing itself. Or some roles.
// Without any it is open to whoever is not logged in.
struct Who {
  constexpr Who(casedb::Action its) : action(its), roles(casedb::roles_that_may(its)) {}  // NOLINT
  constexpr Who(Roles some) : roles(some) {}                                              // NOLINT
  std::optional<casedb::Action> action{};
  Roles roles{};
};
inline constexpr Who kOpen = Roles{};
inline constexpr Who kAnyRole = kEveryRole;

struct Call {
  const Request& request;
  const Reader* reader = nullptr;             // null: not logged in
  std::string id{};                           // of the pattern
  std::map<std::string, std::string> form{};  // of a POST

  std::string field(const std::string& name) const;  // of the form; empty where it has none
};

struct Route {
  std::string_view method;   // GET (which also answers HEAD) or POST
  std::string_view pattern;  // "{attempt_id}" or "{case_id}" stands for one UUID
  Who who = kOpen;
  bool is_page = true;     // whoever is not logged in is sent to the log-in page; else 401
  std::string_view scope;  // what the roles leave open, for docs/routes.md
  std::string_view summary;
  Response (*handle)(Site&, const Call&) = nullptr;
  Lane lane = Lane::pages;
  // Of a heavy one that is made of an answer which site.answers keeps as this and the id: once it is there, it is
  // as light as a page.
  std::string_view kept_as{};
};

// Whether `path` fits; fills the pattern's id.
bool matches(std::string_view pattern, std::string_view path, std::string& id);

}  // namespace seldinger::web
