#include "assessment/grading/progress.h"

#include <algorithm>

#include "sim/base/check.h"
#include "sim/base/names.h"

namespace seldinger::assessment {
namespace {

constexpr int kPassesRunning = 2;
constexpr auto kNames = base::names<Proficiency>({{Proficiency::not_started, "not_started"},
                                                  {Proficiency::practising, "practising"},
                                                  {Proficiency::passed, "passed"},
                                                  {Proficiency::proficient, "proficient"}});

struct Passes {
  int running = 0, longest = 0;  // up to the last verdict; of all
};

Passes passes_of(std::span<const Verdict> verdicts) {
  Passes passes;
  for (const Verdict verdict : verdicts) {
    if (verdict == Verdict::passed) passes.longest = std::max(passes.longest, ++passes.running);
    if (verdict == Verdict::failed) passes.running = 0;
  }
  return passes;
}

}  // namespace

std::string_view name_of(Proficiency proficiency) noexcept {
  return base::name_of(kNames, proficiency);
}

std::optional<Proficiency> proficiency_from(std::string_view name) noexcept {
  return base::from_name(kNames, name);
}

Proficiency proficiency_of(std::span<const Verdict> verdicts) {
  const Passes passes = passes_of(verdicts);
  if (passes.longest >= kPassesRunning) return Proficiency::proficient;
  if (passes.longest > 0) return Proficiency::passed;
  return verdicts.empty() ? Proficiency::not_started : Proficiency::practising;
}

std::optional<std::size_t> proficient_at(std::span<const Verdict> verdicts) {
  for (std::size_t i = 1; i <= verdicts.size(); ++i)
    if (proficiency_of(verdicts.first(i)) == Proficiency::proficient) return i - 1;
  return std::nullopt;
}

int passes_missing(std::span<const Verdict> verdicts) {
  const Passes passes = passes_of(verdicts);
  return passes.longest >= kPassesRunning ? 0 : kPassesRunning - passes.running;
}

std::vector<ItemProgress> progress_of(std::span<const ItemPast> items) {
  std::vector<ItemProgress> all;
  bool is_due = false;
  for (const ItemPast& item : items) {
    ItemProgress one;
    one.reached = proficiency_of(item.verdicts);
    one.passes_missing = passes_missing(item.verdicts);
    one.open = std::all_of(item.gates.begin(), item.gates.end(), [&](const Gate& gate) {
      CHECK(gate.after < all.size());
      return all[gate.after].reached >= gate.reached;
    });
    if (item.limit) one.attempts_left = std::max(0, *item.limit - item.begun);
    one.due = !is_due && one.open && item.available && one.reached != Proficiency::proficient &&
              one.attempts_left.value_or(1) > 0;
    is_due = is_due || one.due;
    all.push_back(one);
  }
  return all;
}

}  // namespace seldinger::assessment
