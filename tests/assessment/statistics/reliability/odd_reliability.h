// What the shelf of reliability is asked of odd tables, in the quick and in the long test.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "assessment/statistics/reliability/reliability_procedures.h"
#include "tests/assessment/statistics/odd_tables.h"

namespace seldinger::fixtures {

inline const std::map<std::string, OptionTexts>& reliability_options() {
  static const std::map<std::string, OptionTexts> kOptions = {
      {"omega", {{"resamples", "10"}}},
      {"grim", {{"n", "28"}, {"mean", "5.19"}, {"low", "1"}, {"high", "7"}}},
      {"grimmer", {{"n", "18"}, {"mean", "3.4"}, {"sd", "1.15"}, {"low", "1"}, {"high", "7"}}},
  };
  return kOptions;
}

inline void expect_sound_reliability(std::size_t runs) {
  expect_sound_answers(
      assessment::statistics::reliability_procedures(), runs, reliability_options(),
      [](const assessment::statistics::Answer& answer) {
        if (!answer.estimate || answer.test == "bland_altman") return;
        // None of these can be above 1; what is a share is not below 0 either.
        EXPECT_LE(*answer.estimate, 1.0 + 1e-9);
        if (answer.ci95) {
          EXPECT_LE(answer.ci95->high, 1.0 + 1e-9);
        }
        const bool is_share = answer.test == "omega" || answer.test == "g_theory" || answer.test == "grim" ||
                              answer.test == "grimmer";
        EXPECT_GE(*answer.estimate, is_share ? 0.0 : answer.test == "kappa" ? -1.0 - 1e-9 : -HUGE_VAL);
      });
}

}  // namespace seldinger::fixtures
