#include "app/demo/demo_programme.h"

#include <algorithm>
#include <cstdio>
#include <thread>
#include <vector>

#include "app/attempts/this_program.h"
#include "app/cli/command.h"
#include "app/cli/library_place.h"
#include "app/cli/progress.h"
#include "app/demo/demo_cases.h"
#include "app/demo/demo_library.h"
#include "casedb/people/cohorts.h"
#include "session/attempt/simulated_people.h"

namespace seldinger::app {
namespace {

using namespace std::string_literals;

constexpr const char* kOwnProgramme = "Radiology North";
constexpr const char* kOtherProgramme = "Radiology South";

// When a cohort practised one of the drills: days from now, and how many attempts each person made on each.
struct Practice {
  std::size_t drill;
  std::vector<double> days;
  std::size_t count;
};
struct DemoCohort {
  const char *title, *programme, *site, *group;
  std::size_t people;
  std::uint64_t seed;
  std::vector<Practice> practice;
};

// Sixty people: some finished long ago, some under way, some who have not come for long.
std::vector<DemoCohort> demo_cohorts() {
  return {
      {"North, third year",
       kOwnProgramme,
       "St Anne",
       "expert",
       12,
       11,
       {{0, {-240.0, -20.0}, 3}, {1, {-239.0, -19.0}, 3}, {2, {-238.0}, 3}}},
      {"North, second year",
       kOwnProgramme,
       "St Anne",
       "intermediate",
       24,
       12,
       {{0, {-40.0, -39.0}, 3}, {1, {-20.0, -18.0}, 3}, {2, {-3.0}, 3}}},
      {"South, first year", kOtherProgramme, "Harbour", "novice", 24, 13, {{0, {-60.0, -2.0}, 3}, {1, {-1.0}, 3}}}};
}

base::Result<std::string> cohort_of(casedb::Library& library, const DemoCohort& wanted) {
  if (const auto known = casedb::find_cohort(library, wanted.title)) return known->cohort_id;
  return casedb::add_cohort(library, wanted.title, wanted.programme, wanted.site);
}

base::Result<std::string> person_called(casedb::Library& library, const std::string& name) {
  for (const casedb::Account& one : casedb::list_users(library))
    if (one.login_name == name) return one.person_id;
  return base::Error{"no_user", "nobody has that name"};
}

// The published one that a drill became.
std::string case_of(casedb::Library& library, const DemoCase& drill) {
  for (const casedb::CaseRow& row : casedb::list_cases(library))
    if (row.title == drill.title && row.state == casedb::CaseState::published) return row.case_id;
  return {};
}

base::Result<void> practise(casedb::Library& library, const DemoCohort& cohort, const std::string& cohort_id) {
  for (const Practice& one : cohort.practice) {
    auto simulation =
        session::Simulation::prepare(library, this_program(), case_of(library, drills().at(one.drill)), {});
    if (!simulation) return simulation.error();
    const session::PeopleWish wish{*assessment::population::named_group(cohort.group), cohort.seed, cohort.people,
                                   one.count, one.days};
    auto people = session::people_trials(library, wish, simulation->task());
    for (session::SimulatedTrial& trial : people.trials)
      trial.station = cohort.site + (trial.person.value_or(0) % 3 == 0 ? " 2"s : " 1"s);
    for (const std::string& person_id : people.person_ids)
      if (const auto done = casedb::enrol(library, cohort_id, person_id, casedb::Post::learner); !done)
        return done.error();
    Progress progress(people.trials.size());
    const auto done = simulation->attempts(people.trials, std::max(1U, std::thread::hardware_concurrency()), true,
                                           [&](const session::SimulatedAttempt&) { progress.one_done(); });
    progress.clear();
    if (!done) return done.error();
  }
  return {};
}

}  // namespace

int run_demo_programme(const Arguments& arguments) {
  if (const int made = run_demo_cases(arguments); made != kDone) return made;
  auto library = casedb::Library::open(library_folder(arguments));
  if (!library) return refuse(library.error());
  auto passwords =
      add_missing_accounts(*library, {{"admin", casedb::Role::admin}, {"researcher", casedb::Role::researcher}});
  if (!passwords) return refuse(passwords.error());
  print_accounts(*passwords);
  const auto mentor = person_called(*library, "mentor"), director = person_called(*library, "director"),
             trainee = person_called(*library, "trainee");
  for (const auto* one : {&mentor, &director, &trainee})
    if (!*one) return refuse(one->error());
  if (const auto done = casedb::appoint_director(*library, kOwnProgramme, *director); !done)
    return refuse(done.error());
  for (const DemoCohort& cohort : demo_cohorts()) {
    const auto cohort_id = cohort_of(*library, cohort);
    if (!cohort_id) return refuse(cohort_id.error());
    const bool own = cohort.programme == std::string_view(kOwnProgramme);
    if (own)
      if (const auto done = casedb::enrol(*library, *cohort_id, *mentor, casedb::Post::mentor); !done)
        return refuse(done.error());
    if (const auto done = practise(*library, cohort, *cohort_id); !done) return refuse(done.error());
    std::printf("%s: %zu simulated people practised\n", cohort.title, cohort.people);
    std::fflush(stdout);
    // The trainee's account is a learner among them.
    if (cohort.title == std::string_view("North, second year"))
      if (const auto done = casedb::enrol(*library, *cohort_id, *trainee, casedb::Post::learner); !done)
        return refuse(done.error());
  }
  return kDone;
}

}  // namespace seldinger::app
