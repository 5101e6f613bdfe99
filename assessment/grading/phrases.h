// What a sentence says of a metric's value, as a table: a row a metric.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace seldinger::assessment {

// "{}" stands for the value with its unit, "{times}" for how often, "{s}" for the plural's ending. Sentences
// without their end.
struct Phrase {
  std::string_view id;
  std::string_view topic;  // two metrics of one topic say nearly the same
  std::string_view bad, good;
  std::string_view zero = {};      // of 0, good or bad; empty: as any other
  std::string_view negative = {};  // of a value below 0, by its size; empty: as any other
};

std::span<const Phrase> phrases();
const Phrase* find_phrase(std::string_view id) noexcept;  // nullptr for a metric without one

// `value_text`: with its unit, without a sign where `negative` stands for it.
std::string said(const Phrase& phrase, double value, std::string_view value_text, bool good);

}  // namespace seldinger::assessment
