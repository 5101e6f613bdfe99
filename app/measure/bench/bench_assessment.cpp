// bench --stage assessment: what it takes to score ten minutes, with everything that could be in the way. Goal: 200
// ms.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/common.hpp>
#include <thread>

#include "app/measure/bench/bench.h"
#include "assessment/operators/lesion_site.h"
#include "assessment/recorder.h"
#include "assessment/registry.h"
#include "assessment/score.h"
#include "casedb/import/skin/surface.h"
#include "session/attempt/simulated_attempt.h"
#include "sim/base/rng.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::measure {
namespace {

constexpr double kMinutesS = 600.0, kNoiseMm = 0.05;

// What a torso has beside the target, as voxels, and what a mentor draws.
std::vector<cases::Structure> structures_of(const volume::Phantom& phantom, const assessment::LesionSite& site) {
  using cases::StructureRule;
  const auto classes = volume::tissue_classes(phantom.volume, &phantom.labels);
  std::vector<std::uint8_t> values(classes.size());
  std::transform(classes.begin(), classes.end(), values.begin(),
                 [](volume::TissueClass one) { return static_cast<std::uint8_t>(one); });
  const auto voxels = [&](volume::TissueClass tissue, StructureRule rule) {
    return cases::Structure{volume::about(tissue).name, tissue, rule,
                            cases::voxels_with(phantom.volume, values, static_cast<std::uint8_t>(tissue))};
  };
  const glm::dvec3& target = site.lesion.center_lps_mm;
  const glm::dvec3 beside(6.0, 0.0, 0.0);
  return {
      voxels(volume::TissueClass::bone, StructureRule::major),
      voxels(volume::TissueClass::liver, StructureRule::organ),
      voxels(volume::TissueClass::gas, StructureRule::critical),
      {"vein", volume::TissueClass::vessel, StructureRule::critical,
       cases::Tube{{target + beside, target + beside + glm::dvec3(0, 0, 40)}, 3.0}},
      {"shell", volume::TissueClass::liver, StructureRule::must_cross, cases::Sphere{target, 30.0}},
      {"lumen", volume::TissueClass::liver, StructureRule::target, cases::Sphere{target, site.lesion.radius_mm}}};
}

// The attempt to and fro until ten minutes are over, at a tracker's rate and with its noise.
cases::Recording ten_minutes(const cases::Recording& once, double rate_hz) {
  const double length_s = once.poses.back().t_s - once.poses.front().t_s;
  const auto folded = [&](double t_s) {
    const double turns = t_s / length_s, part = turns - std::floor(turns);
    return once.poses.front().t_s + length_s * (static_cast<long long>(turns) % 2 == 0 ? part : 1.0 - part);
  };
  cases::Recording recording;
  base::Rng rng(1);
  const auto rows = static_cast<long long>(kMinutesS * rate_hz);
  for (long long row = 0; row <= rows; ++row) {
    const double t_s = static_cast<double>(row) / rate_hz, at = (folded(t_s) - once.poses.front().t_s) * 100.0;
    const auto before = std::min(static_cast<std::size_t>(std::max(0.0, at)), once.poses.size() - 2);
    cases::PoseSample pose = once.poses[before];
    pose.t_s = t_s;
    pose.tip_lps_mm = glm::mix(pose.tip_lps_mm, once.poses[before + 1].tip_lps_mm,
                               std::clamp(at - static_cast<double>(before), 0.0, 1.0)) +
                      kNoiseMm * glm::dvec3(rng.normal(), rng.normal(), rng.normal());
    recording.poses.push_back(pose);
  }
  for (long long picture = 0; picture < static_cast<long long>(kMinutesS * 30.0); ++picture) {
    cases::FrameTruth frame = once.frames[static_cast<std::size_t>(picture) % once.frames.size()];
    frame.t_s = static_cast<double>(picture) / 30.0;
    recording.frames.push_back(frame);
  }
  const cases::PoseSample& last = recording.poses.back();
  recording.endpoint = cases::Endpoint{last.t_s, last.tip_lps_mm, last.needle_direction};
  return recording;
}

// What the servo spends on handing a second's ticks over (goal: 1 % of their time), and the recorder's thread on
// making a chunk of two.
void bench_recorder(const cases::Case& scene, const cases::Recording& once, bool quick,
                    std::vector<BenchRow>& rows) {
  constexpr std::size_t kTicks = 1000;
  const auto row_of = [](const char* method, const char* setting, const std::string& size) {
    return BenchRow{"assessment", method, setting, "cpu", "1 thread", size, 0, 0, 0, 0, "", "", ""};
  };
  const engine::Tick tick_of(scene);
  engine::TickState now;
  std::vector<cases::RecordedTick> second;
  for (std::size_t i = 0; i < kTicks; ++i) second.push_back(tick_of.advance_hands(once.inputs[i], {}, now));
  BenchRow handed =
      row_of("recorder", "ticks handed over", std::to_string(sizeof(cases::RecordedTick)) + " bytes each");
  handed.n = quick ? 5 : 21;
  assessment::Recorder recorder(engine::kStepVersion, base::kTickS,
                                [](const cases::RecordingChunk&) { return base::Result<void>{}; });
  std::vector<double> times_ms;
  for (int i = 0; i < handed.n; ++i) {
    const auto begun = std::chrono::steady_clock::now();
    for (const cases::RecordedTick& tick : second) recorder.tick(tick);
    times_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));  // the queue is emptied meanwhile
  }
  std::sort(times_ms.begin(), times_ms.end());
  handed.ms_min = times_ms.front();
  handed.ms_median = times_ms[times_ms.size() / 2];
  handed.ms_max = times_ms.back();
  handed.size = std::to_string(kTicks) + " ticks of " + handed.size;
  handed.error = bench_number(100.0 * handed.ms_median / (1000.0 * base::kTickS * kTicks));
  handed.error_unit = "% of the ticks' time";
  handed.reference = recorder.fell_behind() ? "fell behind" : "goal 1";
  rows.push_back(handed);

  cases::Recording piece;
  piece.step_version = engine::kStepVersion;
  piece.dt_s = base::kTickS;
  piece.events.emplace();
  for (int half = 0; half < 2; ++half)
    for (const cases::RecordedTick& tick : second) {
      piece.inputs.push_back(tick.inputs);
      piece.hashes.push_back(tick.hash);
      if (tick.pose) piece.poses.push_back(*tick.pose);
    }
  BenchRow made =
      row_of("recorder", "a chunk of 2 s", std::to_string(cases::chunk_of(piece, 0).data.size()) + " bytes");
  time_into(made, quick ? 3 : 11, [&] { static_cast<void>(cases::chunk_of(piece, 0)); });
  rows.push_back(made);
}

}  // namespace

base::Result<void> bench_assessment(const app::Arguments&, bool quick, std::vector<BenchRow>& rows) {
  volume::Phantom phantom = volume::make_phantom();
  cases::Case scene;
  auto skin = casedb::skin_surface(phantom.volume);
  if (!skin) return skin.error();
  scene.skin = std::move(*skin);
  scene.skin_index = cases::MeshIndex(scene.skin);
  const auto site = assessment::find_lesion_site(phantom.volume, scene.skin_index);
  if (!site) return site.error();
  scene.lesions.push_back(site->lesion);
  scene.structures = structures_of(phantom, *site);
  scene.volume = std::move(phantom.volume);
  {
    const std::string form = std::to_string(assessment::registry().size()) + " metrics, under slices";
    BenchRow row{"assessment", "simulate", "an expert's attempt, " + form, "cpu", "1 thread", "", 0, 0, 0, 0, "",
                 "",           ""};
    std::uint64_t seed = 0;
    double simulated_s = 0.0;
    time_into(row, quick ? 3 : 11, [&] {
      const auto recording = session::run_attempt(scene, site->plan, *assessment::named_profile("expert"), ++seed);
      if (assessment::score(scene, recording))
        simulated_s += static_cast<double>(recording.inputs.size()) * recording.dt_s;
    });
    if (!(simulated_s > 0.0)) return base::Error{"bench_failed", "the attempt cannot be scored"};
    row.size = bench_number(60e3 / row.ms_median) + " attempts a minute";
    rows.push_back(row);
  }
  const cases::Recording once = session::run_attempt(scene, site->plan, *assessment::named_profile("novice"), 1);
  for (const double rate_hz : {100.0, 1000.0}) {
    const cases::Recording recording = ten_minutes(once, rate_hz);
    BenchRow row{"assessment",
                 "score",
                 "10 min at " + bench_number(rate_hz) + " Hz, " + std::to_string(assessment::registry().size()) +
                     " metrics, " + std::to_string(scene.structures.size()) + " structures",
                 "cpu",
                 "1 thread",
                 std::to_string(recording.poses.size()) + " poses",
                 0,
                 0,
                 0,
                 0,
                 "",
                 "",
                 ""};
    std::size_t values = 0;
    time_into(row, quick ? 3 : 11, [&] {
      const auto metrics = assessment::measure(scene, recording);
      values += metrics ? metrics->size() : 0;
    });
    if (values == 0) return base::Error{"bench_failed", "the attempt cannot be scored"};
    rows.push_back(row);
  }
  bench_recorder(scene, once, quick, rows);
  return {};
}

}  // namespace seldinger::measure
