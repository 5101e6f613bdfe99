// bench --stage step: a whole simulated attempt, and one tick of it.
#include "app/measure/bench/bench.h"
#include "assessment/operators/lesion_site.h"
#include "casedb/import/skin/surface.h"
#include "session/attempt/simulated_attempt.h"
#include "sim/engine/step.h"
#include "sim/volume/phantom.h"

namespace seldinger::measure {

base::Result<void> bench_step(const app::Arguments&, bool quick, std::vector<BenchRow>& rows) {
  cases::Case scene;
  scene.volume = volume::make_phantom().volume;
  auto skin = casedb::skin_surface(scene.volume);
  if (!skin) return skin.error();
  scene.skin = std::move(*skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  const auto site = assessment::find_lesion_site(scene.volume, scene.skin_index);
  if (!site) return site.error();
  scene.lesions.push_back(site->lesion);
  const auto profile = *assessment::named_profile("expert");
  cases::Recording recording;
  BenchRow attempt{"attempt", "expert",   "simulated at 1 kHz with pictures' truth",
                   "cpu",     "1 thread", bench_size(scene.volume),
                   0,         0,          0,
                   0,         "",         "",
                   ""};
  time_into(attempt, quick ? 1 : 5, [&] { recording = session::run_attempt(scene, site->plan, profile, 1); });
  attempt.setting +=
      ", " + bench_number(static_cast<double>(recording.inputs.size()) * recording.dt_s) + " s of attempt";
  rows.push_back(attempt);
  BenchRow row{"step",
               "skin index, no forces",
               "per tick, " + std::to_string(scene.skin.triangles.size()) + " triangles",
               "cpu",
               "1 thread",
               bench_size(scene.volume),
               0,
               0,
               0,
               0,
               "",
               "",
               ""};
  time_into(row, quick ? 3 : 11, [&] {
    cases::State state;
    for (const cases::Inputs& inputs : recording.inputs) engine::step(scene, inputs, recording.dt_s, state);
  });
  const auto ticks = static_cast<double>(recording.inputs.size());
  row.ms_median /= ticks;
  row.ms_min /= ticks;
  row.ms_max /= ticks;
  rows.push_back(row);
  return {};
}

}  // namespace seldinger::measure
