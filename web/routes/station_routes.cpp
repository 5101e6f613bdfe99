// Workstations: for a director what was done at them, for an admin how well they keep time.
#include "reports/pages/people/stations_page.h"
#include "web/json/stations_json.h"
#include "web/routes/shelves.h"
#include "web/site/access.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

std::vector<casedb::StationUse> visible_use(Site& site, const Call& call) {
  const casedb::Account& account = call.reader->account;
  std::vector<std::string> people;
  for (const auto& [person_id, relation] : site.questions.relations_of(account.person_id))
    if (casedb::may(account.role, Action::see_station_use, relation)) people.push_back(person_id);
  return site.questions.list_station_use(people);
}

Response show_stations(Site& site, const Call& call) {
  return list_response(reports::stations_page(call.reader->visitor(), visible_use(site, call)));
}

Response show_stations_json(Site& site, const Call& call) {
  return json_response(stations_json(visible_use(site, call)));
}

Response show_timing(Site& site, const Call& call) {
  return list_response(reports::station_timing_page(call.reader->visitor(), site.questions.list_station_timing()));
}

Response show_timing_json(Site& site, const Call&) {
  return json_response(station_timing_json(site.questions.list_station_timing()));
}

constexpr Route kStationRoutes[] = {
    {"GET", "/stations", Action::see_station_use, true, "director: own programmes",
     "hours, attempts and people at each workstation, and speed against accuracy", show_stations},
    {"GET", "/stations.json", Action::see_station_use, false, "director: own programmes", "the same",
     show_stations_json},
    {"GET", "/stations/timing", Action::see_station_timing, true, "",
     "how well servo and screen of each workstation keep time, in shares", show_timing, Lane::heavy},
    {"GET", "/stations/timing.json", Action::see_station_timing, false, "", "the same", show_timing_json,
     Lane::heavy},
};

}  // namespace

std::span<const Route> station_routes() {
  return kStationRoutes;
}

}  // namespace seldinger::web
