#include "assessment/grading/progress.h"

#include <algorithm>

#include "sim/base/check.h"

namespace seldinger::assessment {
namespace {

constexpr int kPassesRunning = 2;
constexpr std::string_view kNames[] = {"not_started", "practising", "passed", "proficient"};  // as Proficiency

}  // namespace

std::string_view name_of(Proficiency proficiency) noexcept {
  return kNames[static_cast<std::size_t>(proficiency)];
}

std::optional<Proficiency> proficiency_from(std::string_view name) noexcept {
  for (std::size_t i = 0; i < std::size(kNames); ++i)
    if (kNames[i] == name) return static_cast<Proficiency>(i);
  return std::nullopt;
}

Proficiency proficiency_of(std::span<const Verdict> verdicts) {
  int running = 0, longest = 0;
  for (const Verdict verdict : verdicts) {
    if (verdict == Verdict::passed) longest = std::max(longest, ++running);
    if (verdict == Verdict::failed) running = 0;
  }
  if (longest >= kPassesRunning) return Proficiency::proficient;
  if (longest > 0) return Proficiency::passed;
  return verdicts.empty() ? Proficiency::not_started : Proficiency::practising;
}

std::vector<ItemProgress> progress_of(std::span<const ItemPast> items) {
  std::vector<ItemProgress> all;
  bool is_due = false;
  for (const ItemPast& item : items) {
    ItemProgress one;
    one.reached = proficiency_of(item.verdicts);
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
