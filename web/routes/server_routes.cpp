// What is asked of the server itself: its audit log, and what it answers.
#include <algorithm>
#include <charconv>

#include "reports/pages/people/audit_page.h"
#include "web/routes/openapi_json.h"
#include "web/routes/routes.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

Response show_audit(Site& site, const Call& call) {
  const auto asked = form_fields(call.request.query);
  if (!asked) return refusal(400, call.reader);
  int days = 30;
  if (const auto found = asked->find("days"); found != asked->end())
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), days);
  return list_response(
      reports::audit_page(call.reader->visitor(), site.questions.audit_of(std::clamp(days, 1, 3650))));
}

Response show_openapi(Site& site, const Call&) {
  return {.content_type = "application/json", .body = openapi_json(routes(), site.surroundings.program_version)};
}

constexpr Route kServerRoutes[] = {
    {"GET", "/audit", Action::read_audit, true, "",
     "who did what to which thing, newest first, and whether every row stands as it was written; ?days=N",
     show_audit, Lane::heavy},
    {"GET", "/openapi.json", kOpen, false, "", "these routes as OpenAPI 3.1", show_openapi},
};

}  // namespace

std::span<const Route> server_routes() {
  return kServerRoutes;
}

}  // namespace seldinger::web
