// device list: what hands can use here. device probe: do the arms speak, how often, how evenly? device simulate: a
// service without hardware.
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "app/cli/command.h"
#include "app/device_simulation/haply_simulation.h"
#include "app/hands/desk_arms.h"
#include "app/hands/device_answer.h"
#include "sim/devices/hands/space_mouse.h"

namespace seldinger::app {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kDefaultPort = 10001;
// A service on this machine answers at once; one that does not within this is not there.
constexpr double kLookS = 1.0;
constexpr double kMostSeconds = 86400.0;

volatile std::sig_atomic_t stop_asked = 0;

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}
void sleep_ms(double ms) {
  std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms));
}

devices::WebSocketPlace place_of(const Arguments& arguments) {
  devices::WebSocketPlace place;
  place.host = arguments.text("--host", place.host);
  place.port = static_cast<int>(arguments.whole("--port", kDefaultPort, 1, 65535));
  return place;
}

double seconds_of(const Arguments& arguments, const char* option, double fallback) {
  const double seconds = arguments.number(option, fallback);
  if (arguments.has(option) && !(seconds > 0.0 && seconds <= kMostSeconds))
    throw UsageError(std::string(option) + " is above 0 and at most a day");
  return seconds;
}

void take(const devices::ArmReading& reading, ProbedArm& arm, double& came_s, double now_s) {
  if (reading.count == 0 || (arm.readings > 0 && reading.count == arm.last.count)) return;
  const double at_s = now_s - reading.age_s;
  if (arm.readings == 0) {
    arm.least_mm = arm.most_mm = reading.position_mm;
    arm.readings = 1;
  } else {
    arm.readings += reading.count - arm.last.count;
    if (reading.count == arm.last.count + 1)
      arm.interval.add(static_cast<std::uint64_t>(std::max(0.0, at_s - came_s) * 1e9));
  }
  arm.round_trip.add(static_cast<std::uint64_t>(reading.round_trip_s * 1e9));
  arm.least_mm = glm::min(arm.least_mm, reading.position_mm);
  arm.most_mm = glm::max(arm.most_mm, reading.position_mm);
  arm.last = reading;
  came_s = at_s;
}

int run_device_list(const Arguments& arguments) {
  DeviceListAnswer answer;
  devices::HaplySettings settings;
  settings.place = place_of(arguments);
  answer.service = settings.place.host + ":" + std::to_string(settings.place.port);
  const devices::Haply haply(settings);
  for (const auto begin = Clock::now(); seconds_since(begin) < kLookS && haply.status().messages == 0;)
    sleep_ms(5.0);
  answer.status = haply.status();
  answer.space_mouse = devices::SpaceMouse::open().has_value();
  std::fputs((arguments.has("--json") ? json_of_device_list(answer) : text_of_device_list(answer)).c_str(), stdout);
  return kDone;
}

int run_device_probe(const Arguments& arguments) {
  const double seconds = seconds_of(arguments, "--seconds", 3.0);
  Station station;
  if (arguments.has("--station")) {
    auto known = read_station(arguments.text("--station"));
    if (!known) return refuse(known.error());
    station = std::move(*known);
  }
  const devices::HaplySettings settings = haply_settings(station, place_of(arguments));
  devices::Haply haply(settings);
  for (const auto begin = Clock::now(); seconds_since(begin) < kLookS && haply.status().messages == 0;)
    sleep_ms(5.0);
  if (haply.status().messages == 0)
    return refuse({"no_device",
                   "no Haply Inverse service answers there (`seldinger device simulate` is one without "
                   "hardware)",
                   {}});
  DeviceProbeAnswer answer;
  std::array<double, 2> came_s{};
  const auto begin = Clock::now();
  // Oftener than readings come, so that each is seen; no force is asked for.
  while ((answer.seconds = seconds_since(begin)) < seconds) {
    for (std::size_t side = 0; side < 2; ++side) {
      haply.hand(side).send(glm::dvec3(0.0));
      const devices::ArmReading reading = haply.hand(side).poll();
      take(reading, answer.arms[side], came_s[side], seconds_since(begin));
    }
    sleep_ms(0.2);
  }
  const devices::HaplyStatus status = haply.status();
  for (std::size_t side = 0; side < 2; ++side) answer.arms[side].ids = status.ids[side];
  if (answer.arms[0].readings + answer.arms[1].readings == 0)
    return refuse({"no_device", "the service answers, but no arm with a grip does", {}});
  std::fputs((arguments.has("--json") ? json_of_device_probe(answer) : text_of_device_probe(answer)).c_str(),
             stdout);
  return kDone;
}

int run_device_simulate(const Arguments& arguments) {
  devices::WebSocketPlace place;
  place.port = static_cast<int>(arguments.whole("--port", kDefaultPort, 0, 65535));
  const double seconds = seconds_of(arguments, "--seconds", kMostSeconds);
  const double lose_s = seconds_of(arguments, "--lose-every", kMostSeconds);
  const double damage_s = seconds_of(arguments, "--damage-every", kMostSeconds);
  SimulatedFaults faults;
  faults.delay_s = 0.001 * arguments.number("--delay-ms", 0.0);
  if (!(faults.delay_s >= 0.0 && faults.delay_s <= 10.0)) throw UsageError("--delay-ms is 0 to 10000");
  faults.swapped = arguments.has("--swap");
  const auto service = HaplySimulation::start(place, circling_arms());
  if (!service) return refuse(service.error());
  (*service)->set(faults);
  std::printf("A simulated Haply Inverse service on ws://127.0.0.1:%d\n", (*service)->port());
  std::fflush(stdout);
  const auto stop = [](int) { stop_asked = 1; };
  std::signal(SIGINT, stop);
  std::signal(SIGTERM, stop);
  const auto begin = Clock::now();
  double lost_s = 0.0, damaged_s = 0.0;
  for (double now_s = 0.0; now_s < seconds && stop_asked == 0; now_s = seconds_since(begin)) {
    if (now_s - lost_s >= lose_s) {
      (*service)->hang_up();
      lost_s = now_s;
    }
    if (now_s - damaged_s >= damage_s) {
      (*service)->say_once((*service)->message().substr(3), false);
      damaged_s = now_s;
    }
    sleep_ms(10.0);
  }
  return kDone;
}

constexpr Option kHost{"--host", "ADDRESS", "where the Haply Inverse service is; default 127.0.0.1"};
constexpr Option kPort{"--port", "N", "its port; default 10001"};
constexpr Option kDeviceListOptions[] = {kHost, kPort, kJson};

constexpr Option kDeviceProbeOptions[] = {
    kHost,
    kPort,
    {"--seconds", "S", "how long; default 3"},
    {"--station", "FILE.json", "which arm is left and which right, and their positions"},
    kJson};

constexpr Option kDeviceSimulateOptions[] = {
    {"--port", "N", "the port on loopback; 0 takes any free one; default 10001"},
    {"--seconds", "S", "how long; default until it is stopped"},
    {"--delay-ms", "D", "delay of every message"},
    {"--lose-every", "S", "hangs up every S seconds"},
    {"--damage-every", "S", "sends a damaged message every S seconds"},
    {"--swap", nullptr, "lists the arms in the other order"}};

}  // namespace

Command device_list_command() {
  return {.name = "device list",
          .options = kDeviceListOptions,
          .summary = "Lists the hand devices here: arms and grips of a Haply Inverse service, a 3-D mouse.",
          .run = &run_device_list};
}

Command device_probe_command() {
  return {.name = "device probe",
          .options = kDeviceProbeOptions,
          .summary = "Reads both arms for a while, without force: poses, rate, jitter, round trip.",
          .run = &run_device_probe};
}

Command device_simulate_command() {
  return {.name = "device simulate",
          .options = kDeviceSimulateOptions,
          .summary =
              "Acts as a Haply Inverse service without hardware: two virtual hands on virtual arms, with faults on "
              "request.",
          .run = &run_device_simulate};
}

}  // namespace seldinger::app
