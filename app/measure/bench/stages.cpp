#include "app/measure/bench/stages.h"

#include <algorithm>
#include <iterator>

namespace seldinger::measure {
namespace {

// The words of a stage; a name that app/bench_stages.h does not have fails to compile.
consteval const app::BenchStageWords& about(std::string_view name) {
  for (const app::BenchStageWords& words : app::kBenchStages)
    if (name == words.name) return words;
  throw "app/bench_stages.h has no such stage";
}

constexpr BenchStage kStages[] = {
    {about("import"), &bench_import},
    {about("mpr"), &bench_mpr},
    {about("xray"), &bench_xray},
    {about("breathing"), &bench_breathing},
    {about("ultrasound"), &bench_ultrasound},
    {about("room"), &bench_room},
    {about("displacement"), &bench_displacement},
    {about("haptics"), &bench_haptics, "force_depth.html", &force_depth_page},
    {about("step"), &bench_step},
    {about("library"), &bench_library},
    {about("assessment"), &bench_assessment},
};

consteval bool runs_every_stage() {
  return std::equal(
      std::begin(kStages), std::end(kStages), std::begin(app::kBenchStages), std::end(app::kBenchStages),
      [](const BenchStage& stage, const app::BenchStageWords& words) { return &stage.about == &words; });
}
static_assert(runs_every_stage(), "this registry and app/bench_stages.h have the same stages in the same order");

}  // namespace

std::span<const BenchStage> bench_stages() {
  return kStages;
}

const BenchStage* find_bench_stage(std::string_view name) {
  const auto found =
      std::ranges::find_if(kStages, [&](const BenchStage& stage) { return name == stage.about.name; });
  return found == std::end(kStages) ? nullptr : found;
}

}  // namespace seldinger::measure
