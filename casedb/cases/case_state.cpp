#include "casedb/cases/case_state.h"

#include <algorithm>
#include <array>

namespace seldinger::casedb {
namespace {

// In the order of the states.
constexpr std::array<std::string_view, 4> kCaseStates = {"draft", "review", "published", "retired"};
constexpr std::array<std::string_view, 3> kCurriculumStates = {"draft", "published", "retired"};

template <typename State, std::size_t kCount>
std::optional<State> state_from(const std::array<std::string_view, kCount>& names, std::string_view name) noexcept {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end()) return std::nullopt;
  return static_cast<State>(found - names.begin());
}

}  // namespace

std::string name_of(CaseState state) {
  return std::string(kCaseStates.at(static_cast<std::size_t>(state)));
}

std::optional<CaseState> case_state_from(std::string_view name) noexcept {
  return state_from<CaseState>(kCaseStates, name);
}

std::string name_of(CurriculumState state) {
  return std::string(kCurriculumStates.at(static_cast<std::size_t>(state)));
}

std::optional<CurriculumState> curriculum_state_from(std::string_view name) noexcept {
  return state_from<CurriculumState>(kCurriculumStates, name);
}

}  // namespace seldinger::casedb
