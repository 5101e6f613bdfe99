#include "app/studies/workshop_json.h"

#include <nlohmann/json.hpp>

#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using WorkshopJson = nlohmann::ordered_json;

WorkshopJson head_of(const casedb::Workshop& workshop) {
  WorkshopJson stations = WorkshopJson::array();
  for (const casedb::WorkshopStation& one : workshop.stations)
    stations.push_back({{"title", one.title}, {"case_id", casedb::maybe(one.case_id)}});
  return {{"code", workshop.code},
          {"title", workshop.title},
          {"study_id", workshop.study_id},
          {"stations", std::move(stations)},
          {"groups", workshop.groups},
          {"opened_us", workshop.opened_us},
          {"closed_us", casedb::maybe(workshop.closed_us)}};
}

WorkshopJson json_of(const casedb::Workshop& workshop, const casedb::Participant& one) {
  WorkshopJson turns = WorkshopJson::array();
  for (const std::size_t place : one.order)
    turns.push_back({{"station", workshop.stations[place].title}, {"done", bool(one.done[place])}});
  return {{"number", one.number},
          {"pseudonym", one.pseudonym},
          {"group", casedb::maybe(one.group)},
          {"came_us", one.came_us},
          {"turns", std::move(turns)}};
}

}  // namespace

std::string json_of_workshop(const casedb::Workshop& workshop) {
  return casedb::text(head_of(workshop));
}

std::string json_of_participant(const casedb::Workshop& workshop, const casedb::Participant& one) {
  return casedb::text(json_of(workshop, one));
}

std::string json_of_day(const casedb::Workshop& workshop, const std::vector<casedb::Participant>& participants,
                        const std::vector<casedb::PersonVisit>& visits) {
  WorkshopJson json = head_of(workshop);
  json["participants"] = WorkshopJson::array();
  for (const casedb::Participant& one : participants) {
    WorkshopJson shown = json_of(workshop, one);
    shown["visits"] = WorkshopJson::array();
    for (const casedb::PersonVisit& visit : visits)
      if (visit.pseudonym == one.pseudonym)
        shown["visits"].push_back({{"visit", visit.visit},
                                   {"from_us", visit.from_us},
                                   {"to_us", visit.to_us},
                                   {"state", base::name_of(casedb::kVisitStateNames, visit.state)}});
    json["participants"].push_back(std::move(shown));
  }
  return casedb::text(json);
}

}  // namespace seldinger::app
