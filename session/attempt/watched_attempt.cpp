#include "session/attempt/watched_attempt.h"

#include <algorithm>
#include <chrono>

#include "assessment/score.h"
#include "session/case/case_build.h"
#include "sim/base/check.h"
#include "sim/base/failure.h"

namespace seldinger::session {
namespace {

using Clock = std::chrono::steady_clock;
// So often it looks at the clock.
constexpr double kPieceS = 0.005;
// So often, at its end, for what has been stored since of one that is being made.
constexpr std::chrono::milliseconds kLookAgain{250};

}  // namespace

WatchedAttempt::WatchedAttempt(std::filesystem::path library, std::string attempt_id, PicturesBy by)
    : library_(std::move(library)), attempt_id_(std::move(attempt_id)), by_(by) {
  thread_ = std::thread([this] { run(); });
}

WatchedAttempt::~WatchedAttempt() {
  ending_ = true;
  thread_.join();
}

const base::Error& WatchedAttempt::error() const {
  CHECK(phase() == Phase::refused);
  return *error_;
}

const casedb::AttemptRow& WatchedAttempt::attempt() const {
  CHECK(phase() == Phase::playing || phase() == Phase::over);
  return *attempt_;
}

const cases::Case& WatchedAttempt::scene() const {
  CHECK(phase() == Phase::playing || phase() == Phase::over);
  return *scene_;
}

std::shared_ptr<const cases::Recording> WatchedAttempt::recording() const {
  CHECK(phase() == Phase::playing || phase() == Phase::over);
  const std::lock_guard lock(recording_mutex_);
  return recording_;
}

Monitor& WatchedAttempt::monitor() {
  CHECK(phase() == Phase::playing || phase() == Phase::over);
  return *monitor_;
}

const std::vector<assessment::ReplayMark>& WatchedAttempt::marks() const {
  CHECK(phase() == Phase::playing || phase() == Phase::over);
  return marks_;
}

std::optional<double> WatchedAttempt::punctured_s() const {
  CHECK(phase() == Phase::playing || phase() == Phase::over);
  return punctured_s_;
}

std::optional<double> WatchedAttempt::fired_s() const {
  CHECK(phase() == Phase::playing || phase() == Phase::over);
  return fired_s_;
}

double WatchedAttempt::duration_s() const {
  const auto so_far = recording();
  return static_cast<double>(so_far->inputs.size()) * so_far->dt_s;
}

// What was open may have become an attempt like any other since.
void WatchedAttempt::look_for_more(casedb::Library& library) {
  auto more = casedb::load_open_recording(library, attempt_id_);
  if (!more) {
    live_ = false;
    more = casedb::load_recording(library, attempt_id_);
  }
  if (!more || more->inputs.size() <= recording_->inputs.size()) return;
  const std::lock_guard lock(recording_mutex_);
  recording_ = std::make_shared<const cases::Recording>(std::move(*more));
}

void WatchedAttempt::play(casedb::Library& library) {
  std::size_t ticks = recording_->inputs.size();
  const double dt_s = recording_->dt_s;
  const auto piece = static_cast<std::size_t>(std::max(1.0, kPieceS / dt_s));
  const engine::Tick whole(*scene_);
  engine::TickState now;
  std::size_t tick = 0;
  std::optional<engine::Moment> pulse;  // a fluoroscope's picture stays until its next
  const auto advance = [&] {
    whole.advance(recording_->inputs[tick++], dt_s, now);
    if (now.state.fluoroscopy.frame_due) pulse = engine::moment_of(now);
  };
  const auto show = [&] {
    if (pulse) monitor_->show(*pulse);
    pulse.reset();
    const engine::Moment moment = engine::moment_of(now);
    moments_.put(moment);
    monitor_->show(moment);
  };
  auto looked = Clock::now();
  for (auto due = Clock::now(); !ending_;) {
    if (live_ && tick == ticks && Clock::now() >= looked + kLookAgain) {
      look_for_more(library);
      looked = Clock::now();
      ticks = recording_->inputs.size();
    }
    if (const double wanted_s = wanted_s_.exchange(kNowhere); wanted_s != kNowhere) {
      const auto to = std::min(ticks, static_cast<std::size_t>(wanted_s / dt_s));
      if (to < tick) {
        now = {};
        tick = 0;
      }
      while (tick < to && !ending_ && wanted_s_ == kNowhere) advance();
      if (tick > 0) show();
      due = Clock::now();
    }
    phase_.store(tick < ticks || live_ ? Phase::playing : Phase::over, std::memory_order_release);
    const double speed = tick < ticks ? speed_.load() : 0.0;
    if (speed > 0.0) {
      const std::size_t end = std::min(ticks, tick + piece);
      while (tick < end) advance();
      show();
    }
    // A machine that cannot keep up shows it slower, and does not leap.
    due = std::max(due, Clock::now() - std::chrono::milliseconds(50)) +
          std::chrono::duration_cast<Clock::duration>(
              std::chrono::duration<double>(speed > 0.0 ? kPieceS / speed : kPieceS));
    std::this_thread::sleep_until(due);
  }
}

base::Result<casedb::AttemptRow> WatchedAttempt::find(casedb::Library& library) {
  for (casedb::OpenAttempt& open : casedb::list_open_attempts(library)) {
    if (open.attempt_id != attempt_id_) continue;
    live_ = true;
    casedb::AttemptRow row;
    static_cast<casedb::AttemptHead&>(row) = std::move(open);
    row.attempt_id = attempt_id_;
    const auto of_case = casedb::find_case(library, row.case_id);
    if (!of_case) return of_case.error();
    row.case_title = of_case->title;
    return row;
  }
  return casedb::find_attempt(library, attempt_id_);
}

void WatchedAttempt::run() {
  const auto refuse = [this](base::Error error) {
    error_ = std::move(error);
    phase_.store(Phase::refused, std::memory_order_release);
  };
  try {
    auto library = casedb::Library::open(library_);
    if (!library) return refuse(library.error());
    auto attempt = find(*library);
    if (!attempt) return refuse(attempt.error());
    auto recording =
        live_ ? casedb::load_open_recording(*library, attempt_id_) : casedb::load_recording(*library, attempt_id_);
    if (!recording) return refuse(recording.error());
    auto scene = build_case_of(*library, *attempt, needs_of(attempt->picture.modality));
    if (!scene) return refuse(scene.error());
    attempt_ = std::move(*attempt);
    recording_ = std::make_shared<const cases::Recording>(std::move(*recording));
    scene_ = std::make_shared<const cases::Case>(std::move(*scene));
    // A recording that nothing can be measured of can still be watched.
    if (!live_)
      if (const auto signals = assessment::signals_of(*scene_, *recording_)) {
        marks_ = assessment::replay_marks(*signals);
        punctured_s_ = assessment::first_puncture_s(*signals);
        if (signals->endpoint) fired_s_ = signals->endpoint->t_s;
      }
    monitor_ = std::make_unique<Monitor>(*scene_, attempt_->seed, by_);
    if (live_) go_to(static_cast<double>(recording_->inputs.size()) * recording_->dt_s);
    phase_.store(Phase::playing, std::memory_order_release);
    play(*library);
  } catch (const base::Failure& failure) {
    return refuse({failure.code(), failure.what()});
  }
}

}  // namespace seldinger::session
