#include "assessment/population/studies/simulated_study.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "assessment/population/streams.h"
#include "sim/base/check.h"

namespace seldinger::assessment::population {
namespace {

constexpr std::uint64_t kTruth = 0;        // the number of the study that tells the truth: none of those drawn
constexpr std::uint64_t kRatersOrder = 3;  // of a rater's streams, after those of drawn_rater

std::vector<MetricValue> metrics_of(const SurrogateMark& mark, const Values& values) {
  std::vector<MetricValue> metrics;
  for (std::size_t m = 0; m < values.size(); ++m)
    metrics.push_back({mark.metrics[m].id, mark.metrics[m].version, values[m], "", values[m] ? "" : "surrogate"});
  return metrics;
}

// What a place adds to every ability of its people. Of one place nothing: there is nothing that it could differ
// from.
double effect_of(std::uint64_t study_key, const char* kind, std::size_t places, std::size_t which, double sd) {
  if (places < 2) return 0.0;
  return sd * normal_of(stream_of(person_key(study_key, kind, which), Drawn::ability));
}

std::string case_of(const study::Plan& plan) {
  CHECK(!plan.primary.empty());
  return plan.primary.front().case_id;
}

// An attempt as raters see it: by whom (a place in the study's people), at which visit, how able they were then.
struct Seen {
  std::size_t person = 0, visit = 0;
  Abilities ability{};
};

void add_visits(const study::Plan& plan, const Surrogate& surrogate, const StudiedPerson& one, SimulatedStudy& made,
                std::vector<Seen>& seen) {
  study::StudyPerson& data = made.data.emplace_back();
  data.name = one.name;
  data.group = one.group;
  std::vector<double> days_before;
  for (std::size_t visit = 0; visit < plan.visits.size(); ++visit) {
    if (!comes_to(one.person, visit)) return;
    const double day = (plan.visits[visit].from_day + plan.visits[visit].to_day) / 2.0;
    Occasion occasion{base::hash_combine(1, std::uint64_t{surrogate.attempts().size()}), visit, 0.0};
    if (days_before.empty() || day > days_before.back())
      occasion.gain = gain_of(one.person.practice, days_before, day);
    days_before.push_back(day);
    study::StudyAttempt& attempt = data.attempts.emplace_back();
    attempt.case_id = case_of(plan);
    attempt.day = day;
    attempt.synthetic = plan.people == study::People::simulated;
    attempt.hand = "simulated";
    if (mishaps_on(one.person, occasion).device_lost_s) attempt.cut_off = "the device was lost";
    attempt.metrics = metrics_of(surrogate.mark(), surrogate.draw(one.person, occasion));
    seen.push_back({made.data.size() - 1, visit, ability_on(one.person, occasion)});
  }
}

// A rater rates every attempt, in an order of their own: what drift adds is no group's more than the other's.
void add_ratings(const Rater& rater, std::size_t number, const std::vector<Seen>& seen, SimulatedStudy& made) {
  std::vector<std::size_t> order(seen.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto place = [&](std::size_t which) { return stream_of(rater.key, Drawn::rater, kRatersOrder, which); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return place(a) < place(b); });
  for (std::size_t rated = 0; rated < order.size(); ++rated) {
    const Seen& one = seen[order[rated]];
    const StudiedPerson& person = made.people[one.person];
    for (std::size_t item = 0; item < rated_items().size(); ++item)
      made.ratings.push_back(
          {person.name, one.visit, number, item, rating_of(rater, person.person, one.ability, item, rated)});
  }
}

std::vector<OutcomeSum> sums_of(const study::Plan& plan) {
  std::vector<OutcomeSum> sums;
  for (const study::Outcome& one : plan.primary) sums.emplace_back().name = one.name;
  return sums;
}

}  // namespace

SimulatedStudy simulated_study(const study::Plan& plan, const World& world, const Surrogate& surrogate,
                               std::uint64_t seed, std::uint64_t number) {
  CHECK(world.groups.size() == plan.groups.size());
  const std::uint64_t study_key = base::hash_combine(base::hash_combine(0x7374756479ULL, seed), number);
  SimulatedStudy made;
  std::vector<Seen> seen;
  for (std::size_t g = 0; g < world.groups.size(); ++g)
    for (std::size_t p = 1; p <= world.per_group; ++p) {
      StudiedPerson& one = made.people.emplace_back();
      one.person = drawn_person(world.groups[g], study_key, p);
      one.group = plan.groups[g].name;
      one.name = "S" + std::to_string(g + 1) + "-" + std::to_string(p);
      one.site = (p - 1) % world.sites + 1;
      one.device = (p - 1) / world.sites % world.devices + 1;
      const std::size_t device_of_all = (one.site - 1) * world.devices + one.device;
      const double added =
          effect_of(study_key, "site", world.sites, one.site, world.site_sd) +
          effect_of(study_key, "device", world.sites * world.devices, device_of_all, world.device_sd);
      for (double& ability : one.person.ability) ability += added;
      add_visits(plan, surrogate, one, made, seen);
    }
  for (std::size_t r = 1; r <= world.raters; ++r) add_ratings(drawn_rater(study_key, r), r, seen, made);
  return made;
}

StudiesSum simulate_studies(const study::Plan& plan, const World& world, const Surrogate& surrogate,
                            std::uint64_t seed, std::size_t studies, std::size_t truth_people,
                            const std::function<bool(std::size_t done)>& told) {
  StudiesSum sum;
  sum.primary = sums_of(plan);
  const auto result_of = [&](const World& of, std::uint64_t number) {
    study::StudyResult result = study::analyse(plan, simulated_study(plan, of, surrogate, seed, number).data);
    std::erase_if(result.primary, [](const study::Compared& one) { return !one.hand.empty(); });
    return result;
  };
  World many = world;
  many.per_group = truth_people;
  many.sites = many.devices = 1;
  many.raters = 0;
  const study::StudyResult truth = result_of(many, kTruth);
  CHECK(truth.primary.size() <= sum.primary.size());
  for (std::size_t i = 0; i < truth.primary.size(); ++i) {
    sum.primary[i].truth = truth.primary[i].answer.estimate;
    sum.primary[i].estimate_name = truth.primary[i].answer.estimate_name;
  }
  for (std::size_t s = 1; s <= studies; ++s) {
    const study::StudyResult result = result_of(world, s);
    ++sum.studies;
    for (std::size_t i = 0; i < result.primary.size(); ++i) {
      const study::Compared& one = result.primary[i];
      OutcomeSum& of = sum.primary[i];
      if (!one.refused.empty() || !one.answer.estimable() || !one.answer.estimate) continue;
      ++of.analysed;
      of.sum_of_estimates += *one.answer.estimate;
      if (one.p_adjusted && *one.p_adjusted < plan.alpha) ++of.significant;
      if (!one.answer.ci95 || !of.truth) continue;
      ++of.with_interval;
      of.sum_of_widths += one.answer.ci95->high - one.answer.ci95->low;
      if (one.answer.ci95->low <= *of.truth && *of.truth <= one.answer.ci95->high) ++of.covered;
    }
    if (told && !told(s)) break;
  }
  return sum;
}

}  // namespace seldinger::assessment::population
