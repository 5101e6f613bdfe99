// How far somebody is in a curriculum: of each item what was reached, whether it is open, and which one is due.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "assessment/grading/grade.h"

namespace seldinger::assessment {

enum class Proficiency { not_started, practising, passed, proficient };
std::string_view name_of(Proficiency proficiency) noexcept;
std::optional<Proficiency> proficiency_from(std::string_view name) noexcept;

// Proficient: two passes in a row (docs/clinical.md, "Passing"), once at any time: what was reached stays.
// `verdicts` are of all attempts, oldest first. One that is not gradable, or has no rule, neither makes nor breaks
// a run.
Proficiency proficiency_of(std::span<const Verdict> verdicts);

// Which attempt first made somebody proficient.
std::optional<std::size_t> proficient_at(std::span<const Verdict> verdicts);

// How many passes in a row, from now on, that takes; 0 of who is.
int passes_missing(std::span<const Verdict> verdicts);

struct Gate {
  std::size_t after = 0;  // an earlier item's index
  Proficiency reached = Proficiency::passed;
};

struct ItemPast {
  std::vector<Verdict> verdicts;  // oldest first
  std::vector<Gate> gates;
  bool available = true;     // a version of its case is published
  std::optional<int> limit;  // of attempts on that version
  int begun = 0;             // attempts on that version, whatever became of them
};

struct ItemProgress {
  Proficiency reached = Proficiency::not_started;
  bool open = false;  // its gates are reached
  bool due = false;   // the first that is open, available, not proficient, and may still be attempted
  std::optional<int> attempts_left;
  int passes_missing = 0;  // to proficient
};

// In the items' order. CHECKs that gates name earlier items.
std::vector<ItemProgress> progress_of(std::span<const ItemPast> items);

}  // namespace seldinger::assessment
