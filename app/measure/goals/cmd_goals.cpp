// goals ultrasound, goals haptics.
#include <algorithm>
#include <cstdio>

#include "app/cli/command.h"
#include "app/hands/servo_trial.h"
#include "app/measure/goals/cmd_goals.h"
#include "app/measure/goals/goals_answer.h"
#include "app/measure/rigs/motion_trials.h"
#include "sim/base/vectors.h"

namespace seldinger::measure {
namespace {

constexpr double kSkinDecimation = 0.7;
constexpr int kProxyTicks = 100000;  // a second or two; the long tests take a million

}  // namespace

int run_goals_ultrasound(const app::Arguments& arguments) {
  const std::string quality_text = arguments.text("--quality", "fast");
  if (quality_text != "fast" && quality_text != "reference")
    throw app::UsageError("--quality is fast or reference");
  const Quality quality = quality_text == "fast" ? Quality::fast : Quality::reference;
  const std::string method_text = arguments.text("--method", "scatterers");
  std::vector<imaging::UltrasoundMethod> methods;
  for (const imaging::UltrasoundMethod method : kUltrasoundMethods)
    if (method_text == "all" || method_text == name_of(method)) methods.push_back(method);
  if (methods.empty()) throw app::UsageError("--method is scatterers, lattice, thesis or all");
  std::vector<imaging::Probe> probes;
  for (const imaging::Probe& probe : imaging::kProbes)
    if (!arguments.has("--probe") || arguments.text("--probe") == probe.name) probes.push_back(probe);
  if (probes.empty()) throw app::UsageError("--probe is C5-2v, L11-5v, thesis-linear or thesis-curved");

  std::vector<GoalsOfMethod> answer;
  bool holds = true;
  for (const imaging::UltrasoundMethod method : methods) {
    GoalsOfMethod measured{name_of(method), quality, {}};
    for (const imaging::Probe& probe : probes) {
      Setting setting = Setting::of(method, probe, quality);
      setting.quick = arguments.has("--quick");
      for (const Goal& goal : ultrasound_goals()) {
        std::fprintf(stderr, "%s, %s: %s …\n", measured.method.c_str(), probe.name.data(), goal.name);
        goal.measure(setting, measured.readings);
      }
    }
    std::stable_sort(measured.readings.begin(), measured.readings.end(),
                     [](const Reading& a, const Reading& b) { return a.goal < b.goal; });
    for (const Reading& reading : measured.readings)
      holds = holds && (method != imaging::UltrasoundMethod::scatterers || reading.holds(quality));
    answer.push_back(std::move(measured));
  }
  if (arguments.has("--json"))
    std::fputs(json_of_goals(answer).c_str(), stdout);
  else
    for (const GoalsOfMethod& measured : answer) std::fputs(goals_table(measured).c_str(), stdout);
  return holds ? app::kDone : app::kCheckFailed;
}

int run_goals_haptics(const app::Arguments& arguments) {
  std::vector<ForceReading> readings = force_readings();
  for (const auto& more : {proxy_readings(kProxyTicks), stability_readings(survey_stability())})
    readings.insert(readings.end(), more.begin(), more.end());
  // A needle into the torso's liver, the probe 30 mm beside it.
  const auto torso = app::torso_under_hands(kSkinDecimation);
  if (!torso) return app::refuse(torso.error());
  TrialPlace place{torso->plan.entry_lps_mm, torso->plan.direction, torso->plan.depth_mm};
  const glm::dvec3 beside = place.entry_lps_mm + 30.0 * base::perpendiculars(place.direction).u;
  const cases::Closest skin = torso->scene.skin_index.closest_skin(beside);
  place.probe_lps_mm = skin.point_lps_mm;
  place.probe_axis = place.direction;
  const auto moving = motion_readings(torso->scene, place);
  readings.insert(readings.end(), moving.begin(), moving.end());
  std::fputs((arguments.has("--json") ? json_of_goals(readings) : goals_table(readings)).c_str(), stdout);
  const bool holds =
      std::all_of(readings.begin(), readings.end(), [](const ForceReading& one) { return one.holds(); });
  return holds ? app::kDone : app::kCheckFailed;
}

}  // namespace seldinger::measure
