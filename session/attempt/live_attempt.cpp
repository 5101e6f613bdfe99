#include "session/attempt/live_attempt.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>
#include <utility>

#include "assessment/recorder.h"
#include "assessment/score.h"
#include "casedb/attempts/asked_events.h"
#include "casedb/database/running_mark.h"
#include "session/attempt/endpoint_picture.h"
#include "session/case/case_build.h"
#include "session/guidance/guidance.h"
#include "sim/engine/servo_loop.h"
#include "sim/engine/step.h"

namespace seldinger::session {
namespace {

// A stall longer than this is not caught up with: hands would seem to have stood still for as long.
constexpr long kMostTicksAtOnce = 20;

// Where the recording goes: into the library, piece by piece while it is made, or into memory until it is scored.
class Store {
 public:
  // The library keeps it from now on. Without, memory does.
  base::Result<void> open(casedb::Library& library, const casedb::AttemptHead& head) {
    auto opened = casedb::open_attempt(library, head);
    if (!opened) return opened.error();
    attempt_id_ = std::move(*opened);
    mark_.emplace(library.folder(), attempt_id_);
    return use(library);
  }
  // One that was interrupted, which holds its mark: the library goes on with it.
  base::Result<void> reopen(casedb::Library& library, const casedb::OpenAttempt& attempt) {
    if (const auto noted = casedb::note_resumption(library, attempt.attempt_id); !noted) return noted.error();
    attempt_id_ = attempt.attempt_id;
    return use(library);
  }
  base::Result<void> use(const casedb::Library& library) {
    auto own = casedb::Library::open(library.folder());
    if (!own) return own.error();
    recorders_library_.emplace(std::move(*own));
    return {};
  }
  // By the recorder's thread, until it has finished.
  base::Result<void> add(const cases::RecordingChunk& chunk) {
    if (recorders_library_) return casedb::add_chunk(*recorders_library_, attempt_id_, chunk);
    in_memory_.push_back(chunk);
    return {};
  }
  // The same; nothing of it is kept in memory.
  base::Result<void> add(const casedb::Conditions& conditions) {
    if (!recorders_library_) return {};
    return casedb::note_conditions(*recorders_library_, attempt_id_, conditions);
  }
  std::optional<cases::EventKind> take_asked() {
    return recorders_library_ ? casedb::take_asked_event(*recorders_library_, attempt_id_) : std::nullopt;
  }
  base::Result<cases::Recording> recording(casedb::Library& library) const {
    return recorders_library_ ? casedb::load_open_recording(library, attempt_id_)
                              : cases::recording_from_chunks(in_memory_);
  }
  const std::string& attempt_id() const noexcept { return attempt_id_; }  // empty: memory's

 private:
  std::string attempt_id_;
  std::optional<casedb::RunningMark> mark_;
  std::optional<casedb::Library> recorders_library_;  // one thread at a time uses a library
  std::vector<cases::RecordingChunk> in_memory_;
};

// The attempt while it runs: ticks on the servo's thread, pictures on the caller's.
class Running {
 public:
  Running(const cases::Case& scene, const LiveAttempt::With& with, assessment::Recorder& recorder)
      : with_(with), recorder_(recorder), tick_(scene), guidance_(guidance_of(scene)) {}

  // Before it runs: from where an attempt ended that was interrupted.
  void go_on_from(const InterruptedAttempt& before) {
    now_ = before.now();
    says_resumed_ = true;
    if (!guidance_->pulsed() || !before.pulse()) return;
    // Whether the last pulse's report had come in, nobody knows; told twice it counts once.
    const cases::FrameTruth frame = guidance_->see(before.pulse()->state, before.pulse()->displacement);
    report_ = guidance_->state().report;
    const std::vector<cases::FrameTruth>& frames = before.recording().frames;
    if (frames.empty() || frames.back().t_s < frame.t_s) recorder_.frame(frame);
    if (!frames.empty() && frames.back().t_s > frame.t_s) static_cast<void>(guidance_->stay(now_.state));  // told
  }

  // Until it is over. How time was kept.
  cases::ServoRecord run() {
    engine::ServoLoop servo({}, [this](double elapsed_s) { turn(elapsed_s); });
    guide();
    servo.stop();
    take_pause();  // it was stopped in one
    if (paused_s_ > 0.0) recorder_.note({now_.state.t_s, cases::EventKind::paused, paused_s_});
    return servo.record();
  }

  const cases::State& state() const noexcept { return now_.state; }

 private:
  // How long a pause was that is over now.
  void take_pause() {
    if (!paused_from_) return;
    paused_s_ = std::chrono::duration<double>(std::chrono::steady_clock::now() - *paused_from_).count();
    paused_from_.reset();
  }

  // By the servo: the ticks that are due.
  void turn(double elapsed_s) {
    if (over_ || (with_.paused && with_.paused())) {
      if (!over_ && !paused_from_) paused_from_ = std::chrono::steady_clock::now();
      over_ = over_ || with_.done();
      return;
    }
    take_pause();
    const auto frame = frames_.take();
    if (const auto exposed = reports_.take()) report_ = *exposed;
    // A tick that was missed is made up for, so that the attempt's clock is the wall's.
    const long passed = std::lround(elapsed_s / base::kTickS);
    if (passed > kMostTicksAtOnce && with_.stalled) with_.stalled();
    const long due = std::clamp(passed, 1L, kMostTicksAtOnce);
    for (long i = 0; i < due && !over_; ++i) tick(i == 0 && frame ? &*frame : nullptr);
    const engine::Moment moment = engine::moment_of(now_);
    moments_.put(moment);
    if (with_.watch) with_.watch(moment);
  }

  void tick(const cases::FrameTruth* frame) {
    cases::Inputs inputs = with_.hands(now_.state, frame);
    inputs.exposure = report_;
    if (says_resumed_ && inputs.event == cases::EventKind::none) {
      inputs.event = cases::EventKind::resumed;
      says_resumed_ = false;
    }
    cases::RecordedTick made = tick_.advance_hands(inputs, with_.read ? with_.read() : engine::ToolsRead(), now_);
    if (paused_s_ > 0.0) {
      made.noted = cases::EventKind::paused;
      made.noted_wall_s = std::exchange(paused_s_, 0.0);
    } else if (with_.note) {
      made.noted = with_.note(now_.state);
    }
    const bool kept = recorder_.tick(made);
    if (with_.feel) with_.feel(tick_, now_);
    if (now_.state.fluoroscopy.frame_due) pulses_.put(engine::moment_of(now_));
    if (!kept || with_.done() || now_.state.t_s >= kMostLiveSeconds) over_ = true;
  }

  // Looks for new pictures, as often as the machine makes them.
  void guide() {
    const auto begun = std::chrono::steady_clock::now();
    cases::ConsoleSetting console;
    for (double due_s = 0.0; !over_ && !recorder_.failed(); due_s += 1.0 / guidance_->rate_hz(console)) {
      std::this_thread::sleep_until(begun + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                std::chrono::duration<double>(due_s)));
      const auto newest = moments_.take(), pulse = pulses_.take();
      if (newest) console = newest->state.probe.console;
      if (const auto& moment = guidance_->pulsed() ? pulse : newest) {
        show(*moment);
      } else if (newest) {
        if (const auto held = guidance_->stay(newest->state)) recorder_.frame(*held);
      }
    }
  }

  void show(const engine::Moment& moment) {
    const cases::FrameTruth& frame = guidance_->see(moment.state, moment.displacement);
    reports_.put(guidance_->state().report);  // first: the servo needs it before the next pulse
    recorder_.frame(frame);
    frames_.put(frame);
  }

  const LiveAttempt::With& with_;
  assessment::Recorder& recorder_;
  const engine::Tick tick_;  // with the next two: the servo's
  engine::TickState now_;
  cases::ExposureReport report_;
  bool says_resumed_ = false;
  std::optional<std::chrono::steady_clock::time_point> paused_from_;
  double paused_s_ = 0.0;               // not noted yet
  std::unique_ptr<Guidance> guidance_;  // the caller's
  base::Snapshot<engine::Moment> moments_, pulses_;
  base::Snapshot<cases::FrameTruth> frames_;
  base::Snapshot<cases::ExposureReport> reports_;
  std::atomic<bool> over_{false};
};

}  // namespace

LiveAttempt::LiveAttempt(casedb::Library& library, Program program, casedb::AttemptHead head,
                         const cases::Case& scene, Keep keep)
    : library_(library), program_(std::move(program)), head_(std::move(head)), scene_(scene), keep_(keep) {}

LiveAttempt::LiveAttempt(casedb::Library& library, Program program, InterruptedAttempt interrupted,
                         const cases::Case& scene)
    : library_(library),
      program_(std::move(program)),
      head_(interrupted.attempt()),
      scene_(scene),
      keep_(Keep::stored),
      before_(std::move(interrupted)) {}

base::Result<StoredAttempt> LiveAttempt::run(const With& with) {
  Store store;
  assessment::RecordedBefore recorded;
  if (keep_ == Keep::stored) {
    const auto opened = before_ ? store.reopen(library_, before_->attempt()) : store.open(library_, head_);
    if (!opened) return opened.error();
    if (with.opened) with.opened(store.attempt_id());
  }
  if (before_) recorded = {before_->ticks(), static_cast<std::uint32_t>(before_->attempt().chunks)};
  const auto note_conditions = [&]() -> base::Result<void> {
    return with.conditions ? store.add(with.conditions()) : base::Result<void>{};
  };
  if (const auto noted = note_conditions(); !noted) return noted.error();
  assessment::Recorder recorder(
      engine::kStepVersion, base::kTickS,
      [&](const cases::RecordingChunk& chunk) -> base::Result<void> {
        if (const auto added = store.add(chunk); !added) return added.error();
        if (with.asked)
          if (const auto kind = store.take_asked()) with.asked(*kind);
        return note_conditions();
      },
      recorded);
  Running running(scene_, with, recorder);
  if (before_) running.go_on_from(*before_);
  casedb::AttemptOutcome outcome;
  outcome.servo = running.run();
  if (with.ended) with.ended();
  if (const auto chunks = recorder.finish(); !chunks) return chunks.error();

  outcome.end = running.state().fire.fired ? casedb::AttemptEnd::fired
                : recorder.fell_behind()   ? casedb::AttemptEnd::interrupted
                : with.done()              ? casedb::AttemptEnd::stopped
                                           : casedb::AttemptEnd::time_limit;
  const auto recording = store.recording(library_);
  if (!recording) return recording.error();
  const auto signals = assessment::signals_of(scene_, *recording);
  if (!signals) return signals.error();
  assessment::Scored scored = assessment::score(*signals);
  outcome.metrics = std::move(scored.metrics);
  outcome.steps = std::move(scored.steps);
  if (with.conditions) outcome.conditions = with.conditions();
  casedb::add_recorded(*recording, outcome.conditions);
  if (keep_ == Keep::stored) {
    outcome.picture_png = program_.file_of(picture_at_endpoint(scene_, *recording));
    if (const auto closed = casedb::close_attempt(library_, store.attempt_id(), outcome); !closed)
      return closed.error();
  }
  return StoredAttempt{store.attempt_id(),
                       std::move(outcome.metrics),
                       std::move(outcome.steps),
                       *outcome.end,
                       std::move(outcome.conditions),
                       assessment::fault_moments(*signals),
                       assessment::done_path(*signals)};
}

}  // namespace seldinger::session
