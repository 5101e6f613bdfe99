// Attempts of a made-up population, whose truth is known: persons and cases with a share of passes each, and values
// that fall with practice to a plateau.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "casedb/grading/learning.h"
#include "sim/base/rng.h"

namespace seldinger::fixtures {

struct PlantedCase {
  std::string family;
  double difficulty = 0.0;  // on the logit
  bool tells_apart = true;  // whether ability counts there
};

inline casedb::LearningAttempt planted_attempt(const std::string& person, const std::string& family, bool passed,
                                               std::int64_t at_us) {
  casedb::LearningAttempt made;
  made.attempt_id = person + "/" + family + "/" + std::to_string(at_us);
  made.person_id = person;
  made.case_id = made.family_id = family;
  made.started_us = at_us;
  made.verdict = passed ? assessment::Verdict::passed : assessment::Verdict::failed;
  return made;
}

inline double planted_share(double ability, const PlantedCase& at) {
  return 1.0 / (1.0 + std::exp(at.difficulty - (at.tells_apart ? ability : 0.0)));
}

// Each person at each case as often, with abilities of a normal distribution.
inline std::vector<casedb::LearningAttempt> planted_attempts(const std::vector<PlantedCase>& cases,
                                                             std::size_t persons, std::size_t times,
                                                             double ability_sd, std::uint64_t seed) {
  base::Rng rng(seed);
  std::vector<casedb::LearningAttempt> all;
  for (std::size_t p = 0; p < persons; ++p) {
    const double ability = ability_sd * rng.normal();
    for (const PlantedCase& one : cases)
      for (std::size_t i = 0; i < times; ++i)
        all.push_back(planted_attempt("person " + std::to_string(p), one.family,
                                      rng.uniform() < planted_share(ability, one),
                                      static_cast<std::int64_t>(all.size())));
  }
  return all;
}

}  // namespace seldinger::fixtures
