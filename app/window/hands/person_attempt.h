// An attempt of the person at this workstation, from the case that was chosen to the attempt that is stored, beside
// the window's thread: one thread prepares, runs and stores; the servo's and the monitor's are within it. Whatever
// happens to the window, what was recorded is stored.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/window/hands/desk_hands.h"
#include "session/attempt/live_attempt.h"
#include "session/case/program.h"
#include "session/case/task.h"
#include "session/monitor/monitor.h"
#include "sim/case/hand_kind.h"
#include "sim/devices/hands/even_intent.h"
#include "sim/devices/hands/hands.h"

namespace seldinger::app {

// What the window tells the servo, once a frame.
struct HandsTold {
  devices::HandIntent sum;  // running, since the attempt began
  cases::FluoroscopeInputs fluoroscope;
  cases::ConsoleSetting console;
  double between_s = 0.0;  // since it was told before
  double told_s = 0.0;     // when, by clock_s
  // What of mouse, gamepad and 3-D mouse has moved a tool last.
  cases::HandKind by = cases::HandKind::mouse;
};

// What the servo tells the window: the newest tick, and how the hands hold their tools.
struct Seen {
  engine::Moment moment;
  devices::HeldTool held = devices::HeldTool::needle;
  bool frozen = false, inserted = false, guided = false, in_guide = false, returning = false;
  double inserted_mm = 0.0, press_mm = 0.0;    // press: of the probe's face below the skin
  glm::dvec3 needle_side{1.0, 0.0, 0.0};       // in the hand: what it is tilted about (devices::HandIntent)
  std::optional<devices::ProbeGuide> guide{};  // on the probe, taken up (devices::Hands)
  std::uint32_t guides_asked = 0;
  bool needle_by_mouse = true;               // as by_mouse, whichever tool is held
  bool by_mouse = true;                      // the held tool is where mouse and keys led it last, not an arm
  double hand_to_force_s = 0.0;              // from a telling to the tick that took it in
  std::optional<cases::FrameTruth> frame{};  // what the newest picture shows, as it is recorded; none yet
  ArmsHeld arms{};
};

class PersonAttempt {
 public:
  struct Wanted {
    std::filesystem::path library;
    session::Program program;
    std::string case_id;
    std::optional<cases::Modality> modality;  // else the case's own
    std::string person_id;
    std::shared_ptr<session::Task> task{};  // as prepared for an attempt before; else it is prepared
    std::optional<Arms> arms{};
    session::PicturesBy by = session::PicturesBy::cpu;
    session::LiveAttempt::Keep keep = session::LiveAttempt::Keep::stored;
  };
  enum class Phase { preparing, ready, running, storing, stored, refused };

  // Begins to prepare at once.
  explicit PersonAttempt(Wanted wanted);
  // What runs is stopped and stored, as `end`.
  ~PersonAttempt();
  PersonAttempt(const PersonAttempt&) = delete;
  PersonAttempt& operator=(const PersonAttempt&) = delete;

  Phase phase() const noexcept { return phase_.load(std::memory_order_acquire); }
  double prepared() const noexcept { return prepared_; }  // 0 to 1
  std::shared_ptr<session::Task> task() const;   // from `ready` on (CHECKed); after `ready` nobody changes it
  const base::Error& error() const;              // `refused` only (CHECKed)
  const session::StoredAttempt& stored() const;  // `stored` only (CHECKed), or over where it is not kept

  // By the window's thread, before `begin`: the arms are others, or stand elsewhere.
  void use(const std::optional<Arms>& arms) { wanted_.arms = arms; }
  // By the window's thread, in `ready`: one of session::probes_to_choose.
  void choose_probe(std::string_view name);
  // By the window's thread. From `ready` to `running`, with hands where the plan's entry is before them.
  void begin(bool left_handed);
  // The same, from `ready` over `preparing` to `running`: goes on with an attempt at this task that was
  // interrupted, with hands where they were. `refused` where that cannot be.
  void resume(std::string attempt_id, bool left_handed);
  void tell(const HandsTold& told) noexcept { told_.put(told); }
  // Into the next tick in which nothing else is said, with a length or (0) without; false: too much was said at
  // once, and this is not.
  bool say(cases::EventKind kind, double length_mm = 0.0) noexcept;
  // From `running` on: what was said before, of an attempt that is resumed; in its order.
  const std::vector<cases::EventKind>& said_before() const noexcept { return said_before_; }
  // No time goes by, and hands are still.
  void pause(bool paused) noexcept { paused_ = paused; }
  bool paused() const noexcept { return paused_; }
  // Stops it once all that was said is in; then it is stored.
  void end() noexcept {
    paused_ = false;  // first: the pause is noted in a tick
    ending_ = true;
  }
  // The same, because the trainee wants to begin again; the attempt's conditions say so.
  void end_to_begin_again() noexcept {
    again_ = true;
    end();
  }
  // By the window's thread: what is known now of the conditions under which the attempt is made. What the hands and
  // the clock do is known by itself.
  void know(const std::function<void(casedb::Conditions&)>& change);

  // The newest since the last call.
  std::optional<Seen> seen() noexcept { return seen_.take(); }
  std::optional<ArmsSeen> arms_seen() noexcept { return arms_seen_.take(); }  // where there are arms
  session::Monitor& monitor();                                                // from `running` on (CHECKed)

 private:
  void run();
  void take_up_tools(bool left_handed);
  base::Result<session::LiveAttempt> live(casedb::Library& library);
  cases::Inputs hands(const cases::State& state, const cases::FrameTruth* frame);
  cases::EventKind note(const cases::State& state);
  std::optional<cases::HandKind> hand_of(haptics::Tool tool, const cases::State& state) const;
  casedb::Conditions conditions();
  void watch(engine::Moment moment);
  void feel(const engine::Tick& tick, const engine::TickState& now);

  Wanted wanted_;
  std::atomic<Phase> phase_{Phase::preparing};
  std::atomic<double> prepared_{0.0};
  std::shared_ptr<session::Task> task_;
  std::optional<base::Error> error_;
  std::optional<session::StoredAttempt> stored_;
  std::unique_ptr<session::Monitor> monitor_;
  base::Snapshot<HandsTold> told_;
  base::Snapshot<Seen> seen_;
  base::Snapshot<ArmsSeen> arms_seen_;
  std::optional<DeskHands> hands_;  // the servo's, from here …
  devices::EvenIntent even_;
  devices::AxialForces forces_;
  double told_s_ = 0.0, hand_to_force_s_ = 0.0;
  std::optional<cases::FrameTruth> frame_;
  devices::HandIntent told_sum_;
  // What leads needle and probe where no arm does; what the recorder has noted last.
  std::array<cases::HandKind, 2> led_by_{cases::HandKind::mouse, cases::HandKind::mouse};
  std::array<std::optional<cases::HandKind>, 2> noted_hand_{};
  bool noted_guided_ = false, noted_in_guide_ = false, noted_returning_ = false;
  double begun_at_s_ = -1.0;  // of the attempt, before its first tick here
  cases::FluoroscopeInputs fluoroscope_;
  cases::ConsoleSetting console_;
  static constexpr std::uint64_t kMostSaid = 32;
  struct alignas(4) Said {  // as large as it is aligned: else clang calls libatomic for it
    cases::EventKind kind = cases::EventKind::none;
    std::uint16_t tenths_mm = 0;
  };
  std::atomic<cases::EventKind> asked_{cases::EventKind::none};  // by a mentor who looks in; not happened yet
  std::array<std::atomic<Said>, kMostSaid> said_{};              // … a ring between window and servo
  alignas(64) std::atomic<std::uint64_t> said_count_{0};
  alignas(64) std::atomic<std::uint64_t> heard_count_{0};
  std::atomic<bool> ending_{false}, paused_{false}, again_{false};
  std::mutex conditions_mutex_;
  casedb::Conditions conditions_;  // conditions_mutex_'s
  std::mutex mutex_;
  std::condition_variable begun_;
  bool begin_ = false, gone_ = false;
  std::optional<std::string> resumed_;  // the attempt that is resumed
  std::vector<cases::EventKind> said_before_;
  bool left_handed_ = false;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::app
