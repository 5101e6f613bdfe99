// The shelf's table and odd tables: those of every shelf, and for Rasch's models, which ask for 30 persons, odd
// scores of that many.
#pragma once

#include <string>

#include "assessment/statistics/growth/growth_procedures.h"
#include "tests/assessment/statistics/odd_tables.h"

namespace seldinger::fixtures {

inline assessment::statistics::DataTable odd_scores(base::Rng& rng) {
  assessment::statistics::DataTable table;
  const std::size_t persons = 28 + up_to(rng, 20), raters = 1 + up_to(rng, 2), most = 1 + up_to(rng, 2);
  const double holes = 0.4 * rng.uniform() * static_cast<double>(up_to(rng, 1)), easy = rng.uniform();
  table.values.resize(1 + up_to(rng, 4));
  const std::size_t constant = up_to(rng, 9);  // an item that is always scored alike, or none
  for (std::size_t i = 0; i < table.values.size(); ++i) table.values[i].name = "q" + std::to_string(i);
  for (std::size_t p = 0; p < persons; ++p)
    for (std::size_t r = 0; r < raters; ++r, ++table.rows) {
      const bool knows = rng.uniform() < easy;
      for (std::size_t i = 0; i < table.values.size(); ++i) {
        const bool right = i == constant || (rng.uniform() < 0.8 ? knows : !knows);
        const double score = right ? static_cast<double>(most) : static_cast<double>(up_to(rng, most - 1));
        table.values[i].values.push_back(rng.uniform() < holes ? std::numeric_limits<double>::quiet_NaN() : score);
      }
      table.subject.push_back("s" + std::to_string(p));
      if (raters > 1) table.rater.push_back("r" + std::to_string(r));
    }
  return table;
}

inline void expect_sound_growth(std::size_t runs) {
  const auto procedures = assessment::statistics::growth_procedures();
  std::size_t estimated = 0;
  for (const auto& procedure : procedures) {
    if (std::string(procedure.name) != "rasch") {
      expect_sound_answers({&procedure, 1}, runs, {}, [](const assessment::statistics::Answer&) {});
      continue;
    }
    for (std::size_t i = 0; i < runs && !testing::Test::HasFailure(); ++i) {
      SCOPED_TRACE("rasch of sweep " + std::to_string(i));
      base::Rng rng(i);
      const auto any = procedure.run(odd_table(rng, procedure.needs), {});
      const auto scores = procedure.run(odd_scores(rng), {});
      expect_sound(any);
      expect_sound(scores);
      estimated += scores.estimable() ? 1 : 0;
    }
  }
  EXPECT_GE(estimated * 4, runs);
}

}  // namespace seldinger::fixtures
