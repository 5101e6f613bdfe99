// goals ultrasound, goals haptics.
#include <algorithm>
#include <cstdio>

#include "app/command.h"
#include "app/goals_answer.h"
#include "app/servo_trial.h"
#include "sim/base/vectors.h"
#include "sim/engine/motion_trials.h"

namespace seldinger::app {
namespace {

constexpr double kSkinDecimation = 0.7;
constexpr int kProxyTicks = 100000;  // a second or two; the long tests take a million

int run_goals_ultrasound(const Arguments& arguments) {
  const std::string quality_text = arguments.text("--quality", "fast");
  if (quality_text != "fast" && quality_text != "reference") throw UsageError("--quality is fast or reference");
  const goals::Quality quality = quality_text == "fast" ? goals::Quality::fast : goals::Quality::reference;
  const std::string method_text = arguments.text("--method", "scatterers");
  std::vector<imaging::UltrasoundMethod> methods;
  for (const imaging::UltrasoundMethod method : kUltrasoundMethods)
    if (method_text == "all" || method_text == name_of(method)) methods.push_back(method);
  if (methods.empty()) throw UsageError("--method is scatterers, lattice, thesis or all");
  std::vector<imaging::Probe> probes;
  for (const imaging::Probe& probe : imaging::kProbes)
    if (!arguments.has("--probe") || arguments.text("--probe") == probe.name) probes.push_back(probe);
  if (probes.empty()) throw UsageError("--probe is C5-2v, L11-5v, thesis-linear or thesis-curved");

  std::vector<GoalsOfMethod> answer;
  bool holds = true;
  for (const imaging::UltrasoundMethod method : methods) {
    GoalsOfMethod measured{name_of(method), quality, {}};
    for (const imaging::Probe& probe : probes) {
      goals::Setting setting = goals::Setting::of(method, probe, quality);
      setting.quick = arguments.has("--quick");
      for (const goals::Goal& goal : goals::ultrasound_goals()) {
        std::fprintf(stderr, "%s, %s: %s …\n", measured.method.c_str(), probe.name.data(), goal.name);
        goal.measure(setting, measured.readings);
      }
    }
    std::stable_sort(measured.readings.begin(), measured.readings.end(),
                     [](const goals::Reading& a, const goals::Reading& b) { return a.goal < b.goal; });
    for (const goals::Reading& reading : measured.readings)
      holds = holds && (method != imaging::UltrasoundMethod::scatterers || reading.holds(quality));
    answer.push_back(std::move(measured));
  }
  if (arguments.has("--json"))
    std::fputs(json_of_goals(answer).c_str(), stdout);
  else
    for (const GoalsOfMethod& measured : answer) std::fputs(goals_table(measured).c_str(), stdout);
  return holds ? kDone : kCheckFailed;
}

int run_goals_haptics(const Arguments& arguments) {
  std::vector<haptics::ForceReading> readings = haptics::force_readings();
  for (const auto& more :
       {haptics::proxy_readings(kProxyTicks), haptics::stability_readings(haptics::survey_stability())})
    readings.insert(readings.end(), more.begin(), more.end());
  // A needle into the torso's liver, the probe 30 mm beside it.
  const auto torso = torso_under_hands(kSkinDecimation);
  if (!torso) return refuse(torso.error());
  engine::TrialPlace place{torso->plan.entry_lps_mm, torso->plan.direction, torso->plan.depth_mm};
  const glm::dvec3 beside = place.entry_lps_mm + 30.0 * base::perpendiculars(place.direction).u;
  const cases::Closest skin = torso->scene.skin_index.closest_skin(beside);
  place.probe_lps_mm = skin.point_lps_mm;
  place.probe_axis = place.direction;
  const auto moving = engine::motion_readings(torso->scene, place);
  readings.insert(readings.end(), moving.begin(), moving.end());
  std::fputs((arguments.has("--json") ? json_of_goals(readings) : goals_table(readings)).c_str(), stdout);
  const bool holds =
      std::all_of(readings.begin(), readings.end(), [](const haptics::ForceReading& one) { return one.holds(); });
  return holds ? kDone : kCheckFailed;
}

constexpr Option kGoalsOptions[] = {
    {"--method", "scatterers|lattice|thesis|all", "how speckle comes about; default scatterers"},
    {"--probe", "NAME", "C5-2v, L11-5v, thesis-linear or thesis-curved; default all"},
    {"--quality", "fast|reference",
     "reference: 512 beams, 2048 samples, three times the scatterers, against the narrower tolerances; default "
     "fast"},
    {"--quick", nullptr, "fewer frames, so more chance in the figures"},
    kJson};

}  // namespace

Command goals_ultrasound_command() {
  return {
      .name = "goals ultrasound",
      .options = kGoalsOptions,
      .summary = "Measures the ultrasound picture against closed forms, goal by goal; 1 when scatterers miss one.",
      .run = &run_goals_ultrasound};
}

Command goals_haptics_command() {
  return {.name = "goals haptics",
          .options = kJsonOnly,
          .summary =
              "Measures what the hand feels against published lines and under simulated hands; 1 when a goal is "
              "missed.",
          .run = &run_goals_haptics};
}

}  // namespace seldinger::app
