// The stages of `seldinger bench`: what each is called, measures, and is held against. Words only, because the
// program's help lists them; app/measure/bench/stages.cpp says what runs.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace seldinger::app {

struct BenchStageWords {
  const char* name;
  const char* measures;
  const char* reference;  // what errors are relative to; "": the stage has times only
};

// In the order in which they run when none is named.
inline constexpr BenchStageWords kBenchStages[] = {
    {"import", "reading a CT, and its skin by decimation and smoothing", "the full-resolution iso-surface"},
    {"mpr", "a slice by interpolation and backend", "linear interpolation in double"},
    {"xray", "projectors and the fluoroscopy chain", "the same lines in double, plain"},
    {"breathing", "a fluoroscope's pulse of tissue that breathes",
     "the way through displaced tissue, every 0.25 mm"},
    {"ultrasound", "pictures by method, beams, samples and density", "the goals of `goals ultrasound`"},
    {"room", "the patient's picture by quality and size", "8 samples a pixel and large shadow maps"},
    {"displacement", "tissue under a probe, the way back, and moving pictures", "Hertz' field, and the way there"},
    {"haptics", "needle laws, a tick of two hands, segment queries and proxies",
     "published lines, Embree, exact normals"},
    {"step", "a simulated attempt, and one tick of its step", ""},
    {"library", "lists, checks, backups and bundles of a large library", ""},
    {"assessment", "every metric of an attempt of ten minutes", ""},
};

inline constexpr std::string_view kBetweenStages = ", ";

constexpr std::size_t bench_stages_length() {
  std::size_t length = 0;
  for (const BenchStageWords& stage : kBenchStages)
    length += (length > 0 ? kBetweenStages.size() : 0) + std::string_view(stage.name).size();
  return length;
}

// "import, mpr, …" and an ending, as a string that ends in '\0'.
template <std::size_t EndingSize>
consteval auto bench_stage_names(const char (&ending)[EndingSize]) {
  std::array<char, bench_stages_length() + EndingSize> text{};
  std::size_t at = 0;
  const auto add = [&](std::string_view part) {
    for (const char letter : part) text[at++] = letter;
  };
  for (const BenchStageWords& stage : kBenchStages) {
    if (at > 0) add(kBetweenStages);
    add(stage.name);
  }
  add({ending, EndingSize - 1});
  return text;
}

inline constexpr auto kBenchStageNames = bench_stage_names("");
inline constexpr auto kBenchStageHelp = bench_stage_names("; default all");

}  // namespace seldinger::app
