// Whole studies of simulated people, by a surrogate: who is in which group, at which site, with which device, comes
// to which visit, what is measured and how raters see it; and what the planned analysis makes of thousands of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assessment/population/raters.h"
#include "assessment/population/surrogate.h"
#include "assessment/study/analysis.h"

namespace seldinger::assessment::population {

struct World {
  std::vector<Group> groups;  // one for each of the plan's, in its order
  std::size_t per_group = 30;
  std::size_t sites = 1;
  std::size_t devices = 1;  // at each site its own; people are dealt to sites and devices in turn
  std::size_t raters = 0;
  double site_sd = 0.2, device_sd = 0.1;  // of what each adds to every ability of its people
};

struct StudiedPerson {
  Person person;
  std::string name, group;
  std::size_t site = 1, device = 1;  // the device's number at the site
};
struct Rating {
  std::string person;
  std::size_t visit = 0, rater = 1, item = 0;
  int points = 1;
};
struct SimulatedStudy {
  std::vector<StudiedPerson> people;
  std::vector<study::StudyPerson> data;  // of the same people, as the analysis takes it
  std::vector<Rating> ratings;           // of each attempt, by every rater; a rater's in the order they were given
};
// The `number`-th study of a seed, from 1. Everybody makes an attempt at each visit to which they come, at the
// plan's only case.
SimulatedStudy simulated_study(const study::Plan& plan, const World& world, const Surrogate& surrogate,
                               std::uint64_t seed, std::uint64_t number);

// What became of one outcome in all of the studies.
struct OutcomeSum {
  std::string name;
  std::size_t analysed = 0, significant = 0, covered = 0, with_interval = 0;
  std::optional<double> truth;  // of the estimate, by the same analysis of many people
  std::string estimate_name;
  double sum_of_estimates = 0.0, sum_of_widths = 0.0;
};
struct StudiesSum {
  std::size_t studies = 0;
  std::vector<OutcomeSum> primary;
};
// `truth_people`: how many of each group tell the truth. `told` of each study; false: no more.
StudiesSum simulate_studies(const study::Plan& plan, const World& world, const Surrogate& surrogate,
                            std::uint64_t seed, std::size_t studies, std::size_t truth_people,
                            const std::function<bool(std::size_t done)>& told = {});

}  // namespace seldinger::assessment::population
