// What is asked of the server itself: its audit log, and what it answers.
#include <algorithm>
#include <charconv>

#include "reports/pages/people/audit_page.h"
#include "web/json/lists_json.h"
#include "web/routes/openapi_json.h"
#include "web/routes/routes.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

// Of how many days; none: nobody understands what was asked.
std::optional<reports::AuditView> asked_audit(Site& site, const Call& call) {
  const auto asked = form_fields(call.request.query);
  if (!asked) return std::nullopt;
  int days = 30;
  if (const auto found = asked->find("days"); found != asked->end())
    std::from_chars(found->second.data(), found->second.data() + found->second.size(), days);
  return site.questions.audit_of(std::clamp(days, 1, 3650));
}

Response show_audit(Site& site, const Call& call) {
  const auto audit = asked_audit(site, call);
  return audit ? list_response(reports::audit_page(call.reader->visitor(), *audit)) : refusal(400, call.reader);
}

Response show_audit_json(Site& site, const Call& call) {
  const auto audit = asked_audit(site, call);
  return audit ? json_response(audit_json(*audit)) : refusal(400, call.reader);
}

// Prometheus has no session: whoever asks on the machine itself is told, and an admin from anywhere.
Response show_tally(Site& site, const Call& call) {
  const bool here = is_loopback_address(call.request.from) && is_loopback_host_header(call.request.header("host"));
  const bool admin = call.reader != nullptr && casedb::may(call.reader->account.role, Action::read_audit);
  if (!here && !admin) return refusal(404, call.reader);
  std::string text = site.tally.text();
  const auto add = [&](const std::string& name, const std::string& help, const std::string& value,
                       const std::string& labels = "") {
    text += "# HELP seldinger_" + name + " " + help + "\n# TYPE seldinger_" + name + " gauge\nseldinger_" + name +
            labels + " " + value + "\n";
  };
  add("sessions", "Open sessions.", std::to_string(site.sessions.count()));
  add("library_healthy", "1 while the library can be read and written.",
      site.questions.health() == casedb::Health::ok ? "1" : "0");
  add("build_info", "The program.", "1", "{version=\"" + site.surroundings.program_version + "\"}");
  return {.content_type = "text/plain; version=0.0.4; charset=utf-8", .body = std::move(text)};
}

Response show_openapi(Site& site, const Call&) {
  return {.content_type = "application/json", .body = openapi_json(routes(), site.surroundings.program_version)};
}

constexpr Route kServerRoutes[] = {
    {"GET", "/audit", Action::read_audit, true, "",
     "who did what to what, newest first, and whether every row is as it was written; ?days=N", show_audit,
     Lane::heavy},
    {"GET", "/audit.json", Action::read_audit, false, "", "the same; ?days=N", show_audit_json, Lane::heavy},
    {"GET", "/prometheus", kOpen, false, "who asks on the machine itself, not through a proxy; admin",
     "counts of answers and how long they took, as Prometheus reads them", show_tally},
    {"GET", "/openapi.json", kOpen, false, "", "these routes as OpenAPI 3.1", show_openapi},
};

}  // namespace

std::span<const Route> server_routes() {
  return kServerRoutes;
}

}  // namespace seldinger::web
