#include "web/routes/routes.h"

#include <vector>

#include "web/routes/shelves.h"

namespace seldinger::web {

std::span<const Route> routes() {
  static const std::vector<Route> all = [] {
    std::vector<Route> joined;
    for (const std::span<const Route> shelf :
         {entry_routes(), start_routes(), answering_routes(), rating_routes(), attempt_routes(), case_routes(),
          learner_routes(), people_routes(), account_routes(), study_routes(), me_routes(), station_routes(),
          job_routes(), server_routes()})
      joined.insert(joined.end(), shelf.begin(), shelf.end());
    return joined;
  }();
  return all;
}

std::string routes_markdown() {
  std::string text =
      "# Routes of the dashboard\n\nGenerated from the registry in `web/routes`; a test compares. HEAD is answered "
      "as GET without a body. What a\nreader may not see answers 404 with the same page as what does not exist. A "
      "page requested without a session goes to\n`/login` (303); the other routes answer 401. Every POST needs the "
      "form's token and the browser's statement that it comes\nfrom this server (`Sec-Fetch-Site: same-origin`, or "
      "an `Origin` that names it), else 403.\n\n| method | path | who | scope | answers |\n|---|---|---|---|---|\n";
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
