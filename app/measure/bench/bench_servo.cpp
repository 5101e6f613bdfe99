// bench --stage haptics: what a tick of two hands costs. One recording is replayed several times; the least time of
// each tick is what the work costs, all times together are what this machine made of it.
#include <algorithm>
#include <chrono>
#include <limits>

#include "app/hands/servo_trial.h"
#include "app/measure/bench/bench.h"
#include "sim/engine/tick.h"

namespace seldinger::measure {
namespace {

constexpr int kReplays = 5;
constexpr int kTicks = 30000, kQuickTicks = 6000;  // five insertions; one
constexpr int kSize = 512;
constexpr double kSkinDecimation = 0.28, kQuickSkinDecimation = 0.7;  // 0.28: above 200,000 triangles

double quantile_ms(const std::vector<double>& sorted_ms, double share) {
  return sorted_ms[static_cast<std::size_t>(share * static_cast<double>(sorted_ms.size() - 1))];
}

base::Result<void> bench_pair(const app::ServoCase& torso, const haptics::TwoHands& hands, const char* name,
                              std::array<haptics::Tool, 2> tools, bool quick, std::vector<BenchRow>& rows) {
  app::HandsAtWork work(torso.plan, haptics::Handedness::right, tools);
  std::vector<haptics::HandInputs> recording;
  for (int tick = 0; tick < (quick ? kQuickTicks : kTicks); ++tick) recording.push_back(work.next());

  std::vector<double> least_ms(recording.size(), std::numeric_limits<double>::infinity()), all_ms;
  all_ms.reserve(recording.size() * kReplays);
  double sum_n = 0.0;  // so that nothing is left out
  for (int replay = 0; replay < kReplays; ++replay) {
    haptics::HandStates states{};
    for (std::size_t tick = 0; tick < recording.size(); ++tick) {
      const auto start = std::chrono::steady_clock::now();
      const haptics::HandForces forces = hands.advance(recording[tick], haptics::kTickS, states);
      const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
      sum_n += forces[0].motor_n.x + forces[1].motor_n.x;
      least_ms[tick] = std::min(least_ms[tick], ms);
      all_ms.push_back(ms);
    }
  }
  const auto add = [&](const std::string& what, std::vector<double> times_ms) {
    std::sort(times_ms.begin(), times_ms.end());
    for (const auto& [quantile, share] : {std::pair{"p50", 0.5}, std::pair{"p99.9", 0.999}}) {
      BenchRow row{"haptics",
                   std::string("servo step of ") + name,
                   std::string(quantile) + " of a tick's time, " + what + ", " +
                       std::to_string(torso.scene.skin.triangles.size()) + " triangles",
                   "cpu",
                   "1 thread",
                   bench_size(torso.scene.volume),
                   static_cast<int>(times_ms.size()),
                   quantile_ms(times_ms, share),
                   times_ms.front(),
                   times_ms.back(),
                   "",
                   "",
                   ""};
      rows.push_back(row);
    }
  };
  add("least of " + std::to_string(kReplays) + " replays", std::move(least_ms));
  add("all " + std::to_string(kReplays) + " replays", std::move(all_ms));
  if (!(sum_n == sum_n)) return base::Error{"not_finite", "a force is not a number"};
  return {};
}

// All that a servo does in a tick of an attempt: step, displacement, both hands, hashes.
void bench_room(const app::ServoCase& torso, const char* name, bool quick, std::vector<BenchRow>& rows) {
  app::HandsAtWork work(torso.plan, haptics::Handedness::right, {haptics::Tool::needle, haptics::Tool::probe});
  std::vector<cases::Inputs> recording;
  for (int tick = 0; tick < (quick ? kQuickTicks : kTicks); ++tick) {
    cases::Inputs& inputs = recording.emplace_back();
    for (const haptics::HandInput& hand : work.next())
      (hand.tool == haptics::Tool::needle ? inputs.needle : inputs.probe) = hand.pose;
  }
  std::vector<double> least_ms(recording.size(), std::numeric_limits<double>::infinity()), all_ms;
  const engine::Tick whole(torso.scene);
  for (int replay = 0; replay < kReplays; ++replay) {
    engine::TickState now;
    for (std::size_t tick = 0; tick < recording.size(); ++tick) {
      const auto start = std::chrono::steady_clock::now();
      whole.advance(recording[tick], haptics::kTickS, now);
      all_ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
      least_ms[tick] = std::min(least_ms[tick], all_ms.back());
    }
  }
  for (auto& [what, times_ms] :
       {std::pair{"least of replays", std::move(least_ms)}, std::pair{"all replays", std::move(all_ms)}}) {
    std::vector<double> sorted_ms = times_ms;
    std::sort(sorted_ms.begin(), sorted_ms.end());
    for (const auto& [quantile, share, goal_ms] : {std::tuple{"p50", 0.5, 0.015}, std::tuple{"p99.9", 0.999, 0.05}})
      rows.push_back({"haptics", std::string("tick of an attempt, ") + name,
                      std::string(quantile) + " of a tick's time, " + what, "cpu", "1 thread",
                      bench_size(torso.scene.volume), static_cast<int>(sorted_ms.size()),
                      quantile_ms(sorted_ms, share), sorted_ms.front(), sorted_ms.back(), "", "",
                      "goal " + bench_number(goal_ms) + " ms"});
  }
}

}  // namespace

base::Result<void> bench_servo(bool quick, std::vector<BenchRow>& rows) {
  auto torso = app::torso_under_hands(quick ? kQuickSkinDecimation : kSkinDecimation);
  if (!torso) return torso.error();
  if (!quick) app::refine(torso->scene, kSize);
  const haptics::TwoHands hands(torso->scene, haptics::two_virtual_arms());
  struct Pair {
    const char* name;
    std::array<haptics::Tool, 2> tools;
  };
  using enum haptics::Tool;
  for (const Pair& pair :
       {Pair{"needle and probe", {needle, probe}}, Pair{"pointer and finger", {pointer, finger}}})
    if (auto measured = bench_pair(*torso, hands, pair.name, pair.tools, quick, rows); !measured)
      return measured.error();
  bench_room(*torso, "still", quick, rows);
  torso->scene.yields = true;
  bench_room(*torso, "yielding", quick, rows);
  torso->scene.breathing.emplace();
  bench_room(*torso, "breathing and yielding", quick, rows);
  return {};
}

}  // namespace seldinger::measure
