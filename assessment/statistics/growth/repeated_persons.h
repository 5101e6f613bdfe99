// What answers about repeated persons share: when there is none, how many persons and groups it rests on, what its
// estimate is called.
#pragma once

#include <optional>
#include <string>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/growth/person_rows.h"

namespace seldinger::assessment::statistics {

inline constexpr std::size_t kMostGroupsOfModel = 20;

// Why no mixed model can be fitted at all: too few repeated persons, an x that does not vary, too many groups.
std::optional<Answer> unfit_for_model(const char* test, const PersonRows& rows);
Answer no_repeated_persons(const char* test, const PersonRows& rows, const char* reason, const char* why);

// With n, what is missing, values of each group, and a note where somebody stands in several of them.
Answer of_repeated_persons(const char* test, const PersonRows& rows);

std::string effect_name(const FixedEffects& fixed, const PersonRows& rows, std::size_t effect);

}  // namespace seldinger::assessment::statistics
