#include "app/cases/tissue_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace seldinger::app {
namespace {

const char* words_of(volume::ContrastPhase phase) {
  switch (phase) {
    case volume::ContrastPhase::none:
      return "none";
    case volume::ContrastPhase::early:
      return "early (arterial) phase";
    case volume::ContrastPhase::venous:
      return "venous phase";
    case volume::ContrastPhase::late:
      return "late (excretory) phase";
  }
  return "";
}

void add_to(std::string& list, const std::string& words) {
  list += (list.empty() ? "" : ", ") + words;
}

}  // namespace

std::string tissue_text(const volume::TissueTold& told) {
  std::string text = std::string("contrast ") + words_of(told.contrast.phase);
  if (told.contrast.aorta_hu)
    text += ": the aorta's blood is at " + std::to_string(*told.contrast.aorta_hu) + " HU";
  else if (told.contrast.phase != volume::ContrastPhase::none)
    text += ": 30 ml of blood and organs are at " + std::to_string(*told.contrast.brightest_hu) + " HU or more";
  std::array<std::size_t, volume::kTissueClasses> order{};
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return told.share[a] > told.share[b]; });
  text += "\ntissue  ";
  for (const std::size_t at : order) {
    if (!(told.share[at] > 0.0)) break;
    const long percent = std::lround(100.0 * told.share[at]);
    std::string name = volume::about(static_cast<volume::TissueClass>(at)).name;  // "soft_tissue"
    std::replace(name.begin(), name.end(), '_', ' ');
    text += std::string(at == order.front() ? " " : ", ") + name + " " +
            (percent > 0 ? std::to_string(percent) : std::string("< 1")) + " %";
  }
  text += "\n";
  for (const std::string& doubt : told.doubts) text += "doubtful: " + doubt + "\n";
  return text;
}

std::string organs_text(const volume::Organs& organs) {
  std::string named, not_named;
  for (const auto& [one_organ, name] : volume::kFoundOrganNames) {
    const volume::FoundOrgan organ = one_organ;  // clang 14 lets no lambda have a binding
    if (organ == volume::FoundOrgan::none) continue;
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    const auto found = std::find_if(organs.found.begin(), organs.found.end(), [&](const volume::OrganFound& one) {
      return one.organ == organ && one.confidence >= volume::kOrganConfidence;
    });
    if (found == organs.found.end())
      add_to(not_named, words);
    else
      add_to(named, words + " (" + std::to_string(std::lround(found->ml)) + " ml, " +
                        std::to_string(std::lround(100.0 * found->confidence)) + " % sure)");
  }
  return "organs   " + (named.empty() ? std::string("none is certain enough to be named") : named) + "\n" +
         (not_named.empty() ? std::string() : "not found, or too uncertain to name: " + not_named + "\n") +
         "not looked for: heart, stomach, bowel, pancreas and anything else not listed\n";
}

}  // namespace seldinger::app
