#include "casedb/workshops/workshops.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "assessment/study/stations.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/questionnaires/drawn_word.h"
#include "casedb/studies/enrolments.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kMostWorkshopGroups = 6;

base::Result<void> check_stations(Library& library, const std::vector<WorkshopStation>& stations) {
  std::set<std::string> titles;
  for (const WorkshopStation& one : stations) titles.insert(one.title);
  const bool titled =
      std::all_of(titles.begin(), titles.end(), [](const auto& one) { return bool(check_title(one)); });
  if (stations.size() < kLeastStations || stations.size() > kMostStations || titles.size() != stations.size() ||
      !titled)
    return base::Error{"bad_stations", "a workshop has two to twelve stations with different names"};
  for (const WorkshopStation& one : stations)
    if (one.case_id)
      if (const auto known = find_case(library, *one.case_id); !known) return known.error();
  return {};
}

base::Result<void> check_workshop_groups(const std::vector<std::string>& groups) {
  const std::set<std::string> different(groups.begin(), groups.end());
  const bool titled =
      std::all_of(groups.begin(), groups.end(), [](const auto& one) { return bool(check_title(one)); });
  if (groups.size() == 1 || groups.size() > kMostWorkshopGroups || different.size() != groups.size() || !titled)
    return base::Error{"bad_group", "a workshop has no groups, or two to six with different names"};
  return {};
}

// Every group's squares are drawn apart.
std::uint64_t seed_of(const Workshop& workshop, const std::string& group) {
  const auto place = std::find(workshop.groups.begin(), workshop.groups.end(), group) - workshop.groups.begin();
  return static_cast<std::uint64_t>(workshop.seed) + static_cast<std::uint64_t>(place);
}

}  // namespace

std::optional<std::size_t> Participant::next() const {
  const auto found = std::find_if(order.begin(), order.end(), [&](std::size_t place) { return !done[place]; });
  return found == order.end() ? std::nullopt : std::optional(*found);
}

base::Result<Workshop> open_workshop(Library& library, const NewWorkshop& made) {
  if (const auto fit = check_title(made.title); !fit) return fit.error();
  if (const auto fit = check_workshop_groups(made.groups); !fit) return fit.error();
  Transaction transaction(library.database());
  if (const auto fit = check_stations(library, made.stations); !fit) return fit.error();
  if (const auto study = find_study(library, made.study_id); !study) return study.error();
  if (is_of_simulated_people(library, made.study_id))
    return base::Error{"real_person", "the study is of simulated people, who come to no workshop"};
  const std::string workshop_id = new_uuid();
  std::string code = drawn_code();
  while (find_workshop(library, code)) code = drawn_code();
  std::array<std::byte, 4> random{};
  fill_random(random);
  std::uint32_t seed = 0;
  std::memcpy(&seed, random.data(), sizeof seed);
  question(library.database(), "add_workshop")
      .bind("workshop_id", workshop_id)
      .bind("code", code)
      .bind("study_id", made.study_id)
      .bind("title", made.title)
      .bind("seed", static_cast<std::int64_t>(seed))
      .bind("now_us", now_us())
      .bind("opened_by", library.actor().person_id)
      .run();
  for (std::size_t place = 0; place < made.stations.size(); ++place)
    question(library.database(), "add_workshop_station")
        .bind("workshop_id", workshop_id)
        .bind("place", static_cast<std::int64_t>(place))
        .bind("title", made.stations[place].title)
        .bind("case_id", made.stations[place].case_id)
        .run();
  for (std::size_t place = 0; place < made.groups.size(); ++place)
    question(library.database(), "add_workshop_group")
        .bind("workshop_id", workshop_id)
        .bind("place", static_cast<std::int64_t>(place))
        .bind("group_name", made.groups[place])
        .run();
  audit(library, Act::open_workshop, {"workshop", workshop_id});
  transaction.commit();
  return find_workshop(library, code);
}

std::vector<Workshop> list_workshops(Library& library) {
  const Snapshot one_state(library.database());
  std::vector<Workshop> all;
  for (Statement rows = question(library.database(), "workshops"); rows.step();) {
    Workshop& one = all.emplace_back();
    one.workshop_id = rows.text("workshop_id");
    one.code = rows.text("code");
    one.study_id = rows.text("study_id");
    one.title = rows.text("title");
    one.seed = rows.integer("seed");
    one.opened_us = rows.integer("opened_us");
    if (!rows.is_null("closed_us")) one.closed_us = rows.integer("closed_us");
    Statement stations = question(library.database(), "workshop_stations");
    for (stations.bind("workshop_id", one.workshop_id); stations.step();) {
      one.stations.push_back({.title = stations.text("title")});
      if (!stations.is_null("case_id")) one.stations.back().case_id = stations.text("case_id");
    }
    Statement groups = question(library.database(), "workshop_groups");
    for (groups.bind("workshop_id", one.workshop_id); groups.step();)
      one.groups.push_back(groups.text("group_name"));
  }
  return all;
}

base::Result<Workshop> find_workshop(Library& library, std::string_view code) {
  const std::string capitals = code_from(code);
  for (Workshop& one : list_workshops(library))
    if (one.code == capitals) return std::move(one);
  return base::Error{"no_workshop", "there is no workshop with that code"};
}

base::Result<void> close_workshop(Library& library, const Workshop& workshop) {
  Transaction transaction(library.database());
  const auto now = find_workshop(library, workshop.code);
  if (!now) return now.error();
  if (!now->is_open()) return base::Error{"workshop_closed", "the workshop is closed already"};
  question(library.database(), "close_workshop")
      .bind("workshop_id", workshop.workshop_id)
      .bind("now_us", now_us())
      .run();
  audit(library, Act::close_workshop, {"workshop", workshop.workshop_id});
  transaction.commit();
  return {};
}

base::Result<Participant> admit_to_workshop(Library& library, const Workshop& workshop,
                                            const std::string& person_id, const std::string& group,
                                            bool consents_now) {
  Transaction transaction(library.database());
  const auto now = find_workshop(library, workshop.code);
  if (!now) return now.error();
  if (!now->is_open()) return base::Error{"workshop_closed", "the workshop is closed: nobody comes any more"};
  if (now->groups.empty() ? !group.empty()
                          : std::find(now->groups.begin(), now->groups.end(), group) == now->groups.end())
    return base::Error{"bad_group", "the workshop has no such group"};
  if (consents_now) {
    if (const auto given = add_consent_to_study(library, person_id, now->study_id); !given) return given.error();
  } else if (!consenting_people(library, now->study_id).contains(person_id)) {
    return base::Error{"no_consent", "this person does not consent to the study"};
  }
  if (is_of_simulated_people(library, now->study_id))  // planned since it was opened
    return base::Error{"real_person", "the study is of simulated people, and this person is a real one"};
  const auto came = [&]() -> std::optional<Participant> {
    for (Participant& one : list_participants(library, *now))
      if (one.person_id == person_id) return std::move(one);
    return std::nullopt;
  };
  if (came()) return base::Error{"already_admitted", "this person has a number already"};
  question(library.database(), "add_workshop_participant")
      .bind("workshop_id", now->workshop_id)
      .bind("person_id", person_id)
      .bind("group_name", group)
      .bind("now_us", now_us())
      .run();
  audit(library, Act::admit_to_workshop, {"workshop", now->workshop_id});
  Participant admitted = *came();
  transaction.commit();
  return admitted;
}

base::Result<void> tick_in_workshop(Library& library, const Workshop& workshop, int number,
                                    const std::string& station) {
  Transaction transaction(library.database());
  const auto came = list_participants(library, workshop);
  if (std::none_of(came.begin(), came.end(), [&](const Participant& one) { return one.number == number; }))
    return base::Error{"no_participant", "nobody has that number"};
  const auto found = std::find_if(workshop.stations.begin(), workshop.stations.end(),
                                  [&](const WorkshopStation& one) { return one.title == station && !one.case_id; });
  if (found == workshop.stations.end())
    return base::Error{"no_station", "there is no station of that name without a case"};
  question(library.database(), "add_workshop_tick")
      .bind("workshop_id", workshop.workshop_id)
      .bind("number", std::int64_t{number})
      .bind("place", static_cast<std::int64_t>(found - workshop.stations.begin()))
      .bind("now_us", now_us())
      .run();
  audit(library, Act::tick_in_workshop, {"workshop", workshop.workshop_id});
  transaction.commit();
  return {};
}

std::vector<Participant> list_participants(Library& library, const Workshop& workshop) {
  const Snapshot one_state(library.database());
  std::vector<Participant> all;
  Statement rows = question(library.database(), "workshop_participants");
  for (rows.bind("workshop_id", workshop.workshop_id); rows.step();) {
    Participant& one = all.emplace_back();
    one.number = rows.small_integer("number");
    one.person_id = rows.text("person_id");
    one.pseudonym = rows.text("pseudonym");
    one.group = rows.text("group_name");
    one.came_us = rows.integer("came_us");
    one.order = assessment::study::order_of_arrival(
        workshop.stations.size(), static_cast<std::size_t>(rows.integer("arrival")), seed_of(workshop, one.group));
    one.done.assign(workshop.stations.size(), false);
  }
  Statement done = question(library.database(), "workshop_done");
  for (done.bind("workshop_id", workshop.workshop_id).bind("operator", kPersonOperator); done.step();) {
    const auto one = std::find_if(all.begin(), all.end(), [&](const Participant& participant) {
      return participant.number == done.small_integer("number");
    });
    if (one != all.end()) one->done[static_cast<std::size_t>(done.integer("place"))] = true;
  }
  return all;
}

}  // namespace seldinger::casedb
