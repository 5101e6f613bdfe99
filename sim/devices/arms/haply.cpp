#include "sim/devices/arms/haply.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>

#include "sim/base/check.h"
#include "sim/base/snapshot.h"
#include "sim/base/vectors.h"
#include "sim/devices/arms/haply_json.h"

namespace seldinger::devices {
namespace {

constexpr double kMmPerM = 1000.0;
// A message that cannot be sent for so long will not be: the other end hangs.
constexpr double kStuckS = 0.1;
// Who was asked several times in vain may answer each, and an answer to one of those must not be taken for that to
// the next: a late arm would be told as one in time from then on. Whose answers are of use at all sends the last of
// them within kHoldS of the first; quiet for so long, one command is on its way again. Until that is answered the
// arm is not followed: it would be lost a second time in this quiet.
constexpr double kQuietS = kHoldS + 0.002;
// A grip speaks by radio, and not in every message.
constexpr double kGripSilentS = 0.1;

std::int64_t now_ns() noexcept {
  return std::chrono::steady_clock::now().time_since_epoch().count();
}
double seconds_since(std::int64_t then_ns) noexcept {
  return static_cast<double>(now_ns() - then_ns) * 1e-9;
}

struct Heard {
  ArmReading reading;
  std::int64_t at_ns = 0;
};
struct Wanted {
  glm::dvec3 force_n{0.0};
  std::int64_t at_ns = 0;
};

class Arm final : public HapticArm {
 public:
  ArmReading poll() noexcept override {
    if (const auto heard = readings.take()) last_ = *heard;
    ArmReading now = last_.reading;
    now.age_s = last_.at_ns == 0 ? 1.0 : seconds_since(last_.at_ns);
    now.healthy = last_.at_ns != 0 && now.age_s <= kHoldS;
    return now;
  }
  void send(const glm::dvec3& force_n) noexcept override { forces.put({force_n, now_ns()}); }

  base::Snapshot<Heard> readings;  // to the servo
  base::Snapshot<Wanted> forces;   // from it
  // The connection's thread's own:
  HaplyIds ids;
  ArmReading reading;
  std::int64_t heard_ns = 0, grip_ns = 0;
  bool has_orientation = false;
  Wanted wanted;

 private:
  Heard last_;  // the servo's own
};

}  // namespace

int delay_ticks(const ArmReading& reading, double tick_s) noexcept {
  const double ticks = std::ceil((reading.age_s + reading.round_trip_s) / tick_s);
  return std::isfinite(ticks) ? static_cast<int>(std::clamp(ticks, 1.0, 1e6)) : 1'000'000;
}

struct Haply::Connection final : WebSocketPeer {
  explicit Connection(const HaplySettings& how) : settings(how) {
    CHECK(settings.most_force_n >= 0.0);
    for (std::size_t side = 0; side < arms.size(); ++side) status.ids[side] = arms[side].ids = settings.ids[side];
  }

  void opened(WebSocketLink&) override {
    const std::lock_guard lock(mutex);
    status.connected = true;
    ++status.connections;
  }

  void closed() override {
    // What comes after is a new beginning: half of a reading of before is not one.
    for (Arm& arm : arms) arm.has_orientation = false;
    waiting_since_ns = 0;
    running_dry = false;
    const std::lock_guard lock(mutex);
    status.connected = false;
  }

  void heard(WebSocketLink& link, std::string_view text) override {
    const auto message = haply_message(text);
    {
      const std::lock_guard lock(mutex);
      ++(message ? status.messages : status.unusable);
      if (message) tell(*message);
    }
    if (message) {
      give_out(*message);
      for (Arm& arm : arms) read(*message, arm);
      heard_ns = now_ns();
      waiting_since_ns = 0;
    }
    // One command is on its way at a time, so that a round trip can be told.
    if (!running_dry && waiting_since_ns == 0) ask(link);
  }

  void ticked(WebSocketLink* link) override {
    if (link == nullptr) return;
    if (link->waiting_s() > kStuckS) return link->hang_up();
    if (waiting_since_ns != 0) {
      // Not answered: those that follow take the force away.
      if (seconds_since(waiting_since_ns) > kHoldS) {
        ask(*link);
        running_dry = true;
      }
    } else if (!running_dry || seconds_since(heard_ns) > kQuietS) {
      running_dry = false;
      ask(*link);
    }
  }

  void tell(const HaplyMessage& message) {
    status.arms.clear();
    status.grips.clear();
    for (const auto& arm : message.arms) status.arms.push_back(arm.id);
    for (const auto& grip : message.grips) status.grips.push_back(grip.id);
  }

  // Only where nobody said which is whose.
  void give_out(const HaplyMessage& message) {
    if (given_out || message.arms.empty()) return;
    given_out = true;
    for (const Arm& arm : arms)
      if (!arm.ids.arm.empty()) return;
    auto ids_of = [](const auto& devices) {
      std::vector<std::string> ids;
      for (const auto& device : devices) ids.push_back(device.id);
      std::sort(ids.begin(), ids.end());
      return ids;
    };
    std::vector<std::string> left = ids_of(message.arms);
    const std::vector<std::string> grips = ids_of(message.grips);
    const auto give = [&](std::size_t side, const std::string& id) {
      arms[side].ids.arm = id;
      left.erase(std::remove(left.begin(), left.end(), id), left.end());
    };
    for (const auto& arm : message.arms) {
      if (arm.handedness == "left" && arms[0].ids.arm.empty()) give(0, arm.id);
      if (arm.handedness == "right" && arms[1].ids.arm.empty()) give(1, arm.id);
    }
    for (const std::size_t side : {1U, 0U})  // one arm alone is the right hand's
      if (arms[side].ids.arm.empty() && !left.empty()) give(side, std::string(left.front()));
    // Nothing says which grip is on which arm: in the order of their ids, and a station's file for who has it
    // otherwise.
    const std::vector<std::string> all = ids_of(message.arms);
    for (Arm& arm : arms) {
      const auto rank = static_cast<std::size_t>(std::find(all.begin(), all.end(), arm.ids.arm) - all.begin());
      if (!arm.ids.arm.empty() && rank < grips.size()) arm.ids.grip = grips[rank];
    }
    const std::lock_guard lock(mutex);
    for (const std::size_t side : {0U, 1U}) status.ids[side] = arms[side].ids;
  }

  void read(const HaplyMessage& message, Arm& arm) {
    if (arm.ids.arm.empty()) return;
    for (const auto& grip : message.grips)
      if (grip.id == arm.ids.grip && grip.orientation) {
        arm.reading.orientation = *grip.orientation;
        arm.reading.buttons = grip.buttons;
        arm.has_orientation = true;
        arm.grip_ns = now_ns();
      }
    for (const auto& heard : message.arms)
      if (heard.id == arm.ids.arm && heard.position_m) {
        if (running_dry) continue;
        arm.reading.position_mm = *heard.position_m * kMmPerM;
        // An arm without a grip that tells how it is held has a position, and cannot hold a tool.
        if (!arm.has_orientation || seconds_since(arm.grip_ns) > kGripSilentS) continue;
        arm.heard_ns = now_ns();
        ++arm.reading.count;
        if (waiting_since_ns != 0) arm.reading.round_trip_s = seconds_since(waiting_since_ns);
        arm.readings.put({arm.reading, arm.heard_ns});
      }
  }

  void ask(WebSocketLink& link) {
    std::vector<HaplyForce> forces;
    for (Arm& arm : arms) {
      if (arm.ids.arm.empty()) continue;
      if (const auto wanted = arm.forces.take()) arm.wanted = *wanted;
      // Silent is who was not heard: the arm, or the servo.
      const double silent_s = arm.heard_ns == 0 || arm.wanted.at_ns == 0
                                  ? kGoneS
                                  : std::max(seconds_since(arm.heard_ns), seconds_since(arm.wanted.at_ns));
      glm::dvec3 force_n = base::is_finite(arm.wanted.force_n) ? arm.wanted.force_n : glm::dvec3(0.0);
      const double length_n = glm::length(force_n);
      if (length_n > settings.most_force_n) force_n *= settings.most_force_n / length_n;
      forces.push_back({arm.ids.arm, force_n * share_of_force(silent_s)});
    }
    if (forces.empty()) return;
    link.say(text_of(forces));
    if (waiting_since_ns == 0) waiting_since_ns = now_ns();
  }

  HaplySettings settings;
  std::array<Arm, 2> arms;
  bool given_out = false;
  std::int64_t waiting_since_ns = 0;  // first asked without an answer so far; 0: nothing is
  std::int64_t heard_ns = 0;
  bool running_dry = false;  // what was asked in vain may still be answered
  mutable std::mutex mutex;
  HaplyStatus status;
  std::unique_ptr<WebSocketClient> client;  // last: its thread uses the rest
};

Haply::Haply(const HaplySettings& settings) : connection_(std::make_unique<Connection>(settings)) {
  connection_->client = std::make_unique<WebSocketClient>(settings.place, *connection_);
}

Haply::~Haply() = default;

HapticArm& Haply::hand(std::size_t side) {
  CHECK(side < 2);
  return connection_->arms[side];
}

HaplyStatus Haply::status() const {
  const std::lock_guard lock(connection_->mutex);
  return connection_->status;
}

}  // namespace seldinger::devices
