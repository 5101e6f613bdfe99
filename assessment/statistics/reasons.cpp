#include "assessment/statistics/reasons.h"

#include <string_view>

namespace seldinger::assessment::statistics {
namespace {

constexpr Reason kReasons[] = {
    {"no_data", "there is no value"},
    {"too_few", "there are too few values for this procedure"},
    {"one_group", "there is only one group"},
    {"not_two_groups", "there are more than the two groups that this procedure compares"},
    {"group_too_small", "a group has too few values for this procedure"},
    {"too_many", "there are more values than this procedure is made for"},
    {"no_variation", "the values do not vary"},
    {"no_variation_within", "the values of no group vary"},
    {"all_tied", "all values are the same"},
    {"no_difference", "no pair differs"},
    {"unbalanced", "rows and columns are not complete"},
    {"repeated_subject", "a person occurs more than once: aggregate by person first"},
    {"subject_in_two_groups", "a person is in two groups that should be independent"},
    {"no_event", "nobody had the event"},
    {"no_solution", "the equations have no solution in the range asked"},
    {"no_crossing", "the two distributions do not cross between their means"},
    {"no_convergence", "the estimate did not converge"},
    {"perfect_separation", "one outcome goes with one side throughout: the estimate is unbounded"},
    {"bad_value", "a value is outside the range the procedure takes"},
    {"no_finite_answer", "the result is not a finite number: the values are too large, too small or too similar"},
};

}  // namespace

std::span<const Reason> reasons() {
  return kReasons;
}

const Reason* find_reason(const char* code) {
  for (const Reason& one : kReasons)
    if (std::string_view(one.code) == code) return &one;
  return nullptr;
}

}  // namespace seldinger::assessment::statistics
