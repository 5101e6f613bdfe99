// The options of `case setting`: the library, the title, one for each setting that has one, and those of the rule.
#pragma once

#include <algorithm>
#include <array>
#include <iterator>

#include "app/cli/command.h"
#include "casedb/cases/setting_table.h"

namespace seldinger::app {

namespace internal {
constexpr Option kBeforeSettings[] = {{"--library", "DIR", "the library's folder"},
                                      {"--title", "TEXT", "the case's title"}};
constexpr Option kAfterSettings[] = {
    {"--pass", "METRIC>=VALUE", "a criterion: <=, >= or =; with --critical it replaces the whole rule", true},
    {"--critical", "METRIC=VALUE", "a criterion that must be met, however good the rest is", true},
    {"--rule", "FILE.json", "the rule from a file"}};
constexpr std::size_t kOfSettings = [] {
  std::size_t count = 0;
  for (const casedb::SettingRow& row : casedb::kSettingRows) count += row.option.name != nullptr ? 1U : 0U;
  return count;
}();
}  // namespace internal

inline constexpr auto kSettingOptions = [] {
  std::array<Option,
             std::size(internal::kBeforeSettings) + internal::kOfSettings + std::size(internal::kAfterSettings)>
      options{};
  auto next =
      std::copy(std::begin(internal::kBeforeSettings), std::end(internal::kBeforeSettings), options.begin());
  for (const casedb::SettingRow& row : casedb::kSettingRows)
    if (const casedb::SettingOption& one = row.option; one.name != nullptr)
      *next++ = {one.name, one.value, one.help, one.repeatable};
  std::copy(std::begin(internal::kAfterSettings), std::end(internal::kAfterSettings), next);
  return options;
}();

}  // namespace seldinger::app
