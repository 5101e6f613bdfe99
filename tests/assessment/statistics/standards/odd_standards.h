// What the shelf of standards is asked of odd tables, in the quick and in the long test.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "assessment/statistics/standards/standards_procedures.h"
#include "tests/assessment/statistics/odd_tables.h"

namespace seldinger::fixtures {

inline const std::map<std::string, OptionTexts>& standards_options() {
  static const std::map<std::string, OptionTexts> kOptions = {
      {"contrasting_groups", {{"resamples", "10"}}},
      {"borderline", {{"resamples", "10"}}},
      {"hofstee",
       {{"resamples", "10"},
        {"cut_low", "0:0.2:-0.1"},
        {"cut_high", "3"},
        {"fail_low", "0"},
        {"fail_high", "0.9"}}},
      {"classification", {{"cut", "1"}, {"reliability", "0.7"}}},
  };
  return kOptions;
}

inline void expect_sound_standards(std::size_t runs) {
  expect_sound_answers(assessment::statistics::standards_procedures(), runs, standards_options(),
                       [](const assessment::statistics::Answer& answer) {
                         for (const auto& one : answer.more) {
                           const bool is_share = one.name.starts_with("false_") || one.name == "fail_share" ||
                                                 one.name == "accuracy" || one.name.starts_with("pass_share");
                           EXPECT_TRUE(!is_share || (one.value >= 0.0 && one.value <= 1.0))
                               << one.name << one.value;
                         }
                       });
}

}  // namespace seldinger::fixtures
