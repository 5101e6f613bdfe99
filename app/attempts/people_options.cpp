#include "app/attempts/people_options.h"

#include <cmath>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/shard.h"
#include "app/cli/words.h"
#include "assessment/population/group_json.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/relations.h"

namespace seldinger::app {
namespace {

namespace population = assessment::population;

constexpr std::size_t kMostGroupBytes = 1U << 20U;

// A group by name, or by a file that says `shift`; nothing: the operator is not a group.
base::Result<std::optional<population::Group>> group_called(const std::string& name) {
  if (auto group = population::named_group(name)) return std::optional(std::move(*group));
  if (!name.ends_with(".json")) return std::optional<population::Group>();
  const auto text = read_text(name, kMostGroupBytes);
  if (!text) return error_of("--operator", name, text.error());
  if (!population::is_group_json(*text)) return std::optional<population::Group>();
  auto group = population::group_from_json(*text);
  if (!group) return error_of("--operator", name, group.error());
  return std::optional(std::move(*group));
}

// "0,7,28"
std::vector<double> session_days(const Arguments& arguments) {
  if (!arguments.has("--days")) return {0.0};
  std::vector<double> days;
  std::string rest = arguments.text("--days");
  for (bool more = true; more;) {
    const std::size_t comma = rest.find(',');
    more = comma != rest.npos;
    const double day = parse_number(rest.substr(0, comma)).value_or(NAN);
    if (!(std::abs(day) <= 3650.0) || (!days.empty() && !(day > days.back())))
      throw UsageError("--days is increasing numbers of days, −3650 to 3650, separated by commas: 0,7,28");
    days.push_back(day);
    rest = more ? rest.substr(comma + 1) : "";
  }
  return days;
}

}  // namespace

base::Result<std::optional<session::PeopleWish>> people_wish(const Arguments& arguments,
                                                             std::optional<std::size_t> people, std::uint64_t seed,
                                                             std::size_t count) {
  std::optional<session::PeopleWish> wish;
  if (people) {
    auto group = group_called(arguments.required("--operator"));
    if (!group) return group.error();
    if (*group) {
      wish = session::PeopleWish{std::move(**group), seed, *people, count, session_days(arguments)};
      const Shard shard = shard_of(arguments);
      wish->shard = shard.number;
      wish->shards = shard.of;
    }
  }
  for (const char* option : {"--days", "--shard", "--cohort"})
    if (!wish && arguments.has(option))
      throw UsageError(std::string(option) + " needs --people with novice, intermediate, expert or a group's file");
  if (wish && arguments.has("--real-time"))
    throw UsageError("--real-time works with an operator, not with simulated people");
  return wish;
}

base::Result<session::StoredPeople> people_in_library(casedb::Library& library, const Arguments& arguments,
                                                      const std::optional<session::PeopleWish>& wish,
                                                      const session::Simulation& simulation) {
  if (!wish) return session::StoredPeople{};
  std::string cohort_id;
  if (arguments.has("--cohort")) {
    const auto cohort = casedb::find_cohort(library, arguments.text("--cohort"));
    if (!cohort) return cohort.error();
    const auto& reader = library.actor().person_id;
    const casedb::Subject subject =
        reader ? casedb::relation_to_cohort(library, *reader, cohort->cohort_id, cohort->programme)
               : casedb::Relation();
    if (const auto by = acting(library, arguments, casedb::Action::manage_cohorts, subject); !by) return by.error();
    cohort_id = cohort->cohort_id;
  }
  auto stored = session::people_trials(library, *wish, simulation.task());
  for (const std::string& person_id : stored.person_ids)
    if (!cohort_id.empty())
      if (const auto done = casedb::enrol(library, cohort_id, person_id, casedb::Post::learner); !done)
        return done.error();
  return stored;
}

}  // namespace seldinger::app
