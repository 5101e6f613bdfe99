// study visits.
#include <cstdio>

#include "app/studies/acting_in_study.h"
#include "casedb/database/uuid.h"
#include "casedb/database/values_json.h"
#include "casedb/studies/visits.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

std::string json_of_visits(const std::vector<casedb::PersonVisit>& visits) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const casedb::PersonVisit& one : visits)
    all.push_back({{"person", one.pseudonym},
                   {"visit", one.visit},
                   {"from_us", one.from_us},
                   {"to_us", one.to_us},
                   {"state", base::name_of(casedb::kVisitStateNames, one.state)}});
  return casedb::text(nlohmann::ordered_json{{"visits", std::move(all)}});
}

int run_study_visits(const Arguments& arguments) {
  auto open = open_study(arguments, "STUDY", casedb::Action::enrol_in_study);
  if (!open) return refuse(open.error());
  const auto plan = casedb::find_plan(open->library, open->study.study_id);
  if (!plan) return refuse(plan.error());
  auto visits = casedb::list_visits(open->library, *plan, casedb::now_us());
  if (arguments.has("--due"))
    std::erase_if(visits, [](const casedb::PersonVisit& one) { return one.state != casedb::VisitState::due; });
  if (arguments.has("--json")) {
    std::fputs(json_of_visits(visits).c_str(), stdout);
    return kDone;
  }
  if (visits.empty()) std::puts(arguments.has("--due") ? "No visit is due." : "Nobody is enrolled.");
  for (const casedb::PersonVisit& one : visits)
    std::printf("%-12s %-20s %s to %s  %s\n", one.pseudonym.c_str(), one.visit.c_str(),
                reports::utc_text(one.from_us).substr(0, 10).c_str(),
                reports::utc_text(one.to_us).substr(0, 10).c_str(),
                std::string(base::name_of(casedb::kVisitStateNames, one.state)).c_str());
  return kDone;
}

constexpr Option kVisitsOptions[] = {kLibrary, {"--due", nullptr, "only those that are due now"}, kJson};

}  // namespace

Command study_visits_command() {
  return {.name = "study visits",
          .positionals = "STUDY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kVisitsOptions,
          .acts = true,
          .summary =
              "Lists each person's visits with their window of days: made, ahead, due or missed; by pseudonym, "
              "without groups or outcomes.",
          .run = &run_study_visits};
}

}  // namespace seldinger::app
