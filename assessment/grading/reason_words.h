// Why something has no value, or is not graded, in a trainee's words: one table of every reason code that a metric,
// a criterion or a grade can give. Each reads on after "no value, as" and after "no value if", and has neither
// capital nor full stop.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace seldinger::assessment {

struct ReasonWords {
  std::string_view code;  // stable snake_case
  std::string_view words;
};

std::span<const ReasonWords> all_reason_words();

// Null: not in the table.
const ReasonWords* find_reason_words(std::string_view code) noexcept;

// "never_punctured" as "the skin was never punctured"; a code that is not in the table as its own words.
std::string reason_words(std::string_view code);

}  // namespace seldinger::assessment
