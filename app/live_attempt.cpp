#include "app/live_attempt.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <thread>

#include "app/attempt_loop.h"
#include "app/case_build.h"
#include "app/fluoroscopy.h"
#include "app/ultrasound_sight.h"
#include "assessment/recorder.h"
#include "casedb/running_mark.h"
#include "sim/engine/servo_loop.h"
#include "sim/engine/step.h"

namespace seldinger::app {
namespace {

// A stall longer than this is not caught up with: hands would seem to have stood still for as long.
constexpr int kMostTicksAtOnce = 20;
// A pulse's report reaches the servo well before the next pulse, which comes after 1/15 s at the earliest.
constexpr double kPulsesLookedForHz = 500.0;

}  // namespace

LiveAttempt::LiveAttempt(casedb::Library& library, casedb::AttemptHead head, const cases::Case& scene, Keep keep)
    : library_(library), head_(std::move(head)), scene_(scene), keep_(keep) {}

LiveAttempt::LiveAttempt(casedb::Library& library, InterruptedAttempt interrupted, const cases::Case& scene)
    : library_(library),
      head_(interrupted.attempt()),
      scene_(scene),
      keep_(Keep::stored),
      before_(std::move(interrupted)) {}

assessment::RecordedBefore LiveAttempt::recorded_before() const {
  if (!before_) return {};
  return {before_->ticks(), static_cast<std::uint32_t>(before_->attempt().chunks)};
}

base::Result<StoredAttempt> LiveAttempt::run(const With& with) {
  const bool xray = scene_.picture.modality == cases::Modality::xray;
  Sight see;
  std::optional<FluoroscopyRoom> room;
  if (xray)
    room.emplace(scene_);
  else
    see = sight_of(scene_);
  std::string attempt_id;
  std::optional<casedb::RunningMark> mark;
  std::optional<casedb::Library> recorders_library;  // one thread at a time uses a library
  if (before_) {
    attempt_id = before_->attempt().attempt_id;
    if (const auto noted = casedb::note_resumption(library_, attempt_id); !noted) return noted.error();
  } else if (keep_ == Keep::stored) {
    auto opened = casedb::open_attempt(library_, head_);
    if (!opened) return opened.error();
    attempt_id = std::move(*opened);
    mark.emplace(library_.folder(), attempt_id);
  }
  if (keep_ == Keep::stored) {
    auto library = casedb::Library::open(library_.folder());
    if (!library) return library.error();
    recorders_library.emplace(std::move(*library));
    if (with.opened) with.opened(attempt_id);
  }
  std::vector<cases::RecordingChunk> not_kept;  // the recorder's thread, until it has finished
  assessment::Recorder recorder(
      engine::kStepVersion, engine::kTickSeconds,
      [&](const cases::RecordingChunk& chunk) -> base::Result<void> {
        if (recorders_library) return casedb::add_chunk(*recorders_library, attempt_id, chunk);
        not_kept.push_back(chunk);
        return {};
      },
      recorded_before());

  const engine::Tick tick(scene_);
  engine::TickState now = before_ ? before_->now() : engine::TickState{};
  std::optional<cases::FrameTruth> last;  // of a fluoroscope that is live
  cases::ExposureReport reported;
  if (room && before_ && before_->pulse()) {
    // Whether its report had come in, nobody knows; twice does not count twice.
    const engine::Moment& pulse = *before_->pulse();
    const FluoroscopyRoom::Exposed exposed = room->expose(pulse.state, pulse.displacement);
    reported = exposed.report;
    last = exposed.truth;
    const auto& frames = before_->recording().frames;
    if (frames.empty() || frames.back().t_s < exposed.truth.t_s) recorder.frame(exposed.truth);
    if (!frames.empty() && frames.back().t_s > exposed.truth.t_s) last.reset();  // it is held, and that is told
  }
  base::Snapshot<engine::Moment> moments;
  base::Snapshot<engine::Moment> pulses;
  base::Snapshot<cases::FrameTruth> frames;
  base::Snapshot<cases::ExposureReport> reports;
  std::atomic<bool> over{false};
  engine::ServoLoop servo({}, [&, report = reported, resumes = before_.has_value()](double elapsed_s) mutable {
    if (over || (with.paused && with.paused())) {
      over = over || with.done();
      return;
    }
    const auto frame = frames.take();
    if (const auto exposed = reports.take()) report = *exposed;
    // A tick that was missed is made up for, so that the attempt's clock is the wall's.
    const int due =
        std::clamp(static_cast<int>(std::lround(elapsed_s / engine::kTickSeconds)), 1, kMostTicksAtOnce);
    for (int i = 0; i < due && !over; ++i) {
      cases::Inputs inputs = with.hands(now.state, i == 0 && frame ? &*frame : nullptr);
      inputs.exposure = report;
      if (resumes && inputs.event == cases::EventKind::none) {
        inputs.event = cases::EventKind::resumed;
        resumes = false;
      }
      const bool kept =
          recorder.tick(tick.advance_hands(inputs, with.read ? with.read() : engine::ToolsRead(), now));
      if (with.feel) with.feel(tick, now);
      if (now.state.fluoroscopy.frame_due) pulses.put(engine::moment_of(now));
      if (!kept || with.done() || now.state.t_s >= kMostLiveSeconds) over = true;
    }
    const engine::Moment moment = engine::moment_of(now);
    moments.put(moment);
    if (with.watch) with.watch(moment);
  });

  const auto begun = std::chrono::steady_clock::now();
  cases::ConsoleSetting console = now.state.probe.console;
  for (double due_s = 0.0; !over && !recorder.failed();
       due_s += 1.0 / (xray ? kPulsesLookedForHz : picture_rate_hz(scene_.picture, console))) {
    std::this_thread::sleep_until(begun + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                              std::chrono::duration<double>(due_s)));
    const auto moment = moments.take();
    if (room) {
      if (const auto pulse = pulses.take()) {
        const FluoroscopyRoom::Exposed exposed = room->expose(pulse->state, pulse->displacement);
        reports.put(exposed.report);
        recorder.frame(exposed.truth);
        last = exposed.truth;
      } else if (moment && last && !moment->state.fluoroscopy.live) {
        last->t_s = moment->state.t_s;  // the last image stays, and shows nothing that happens
        last->live = false;
        last->beam.reset();
        recorder.frame(*last);
        last.reset();
      }
      continue;
    }
    if (!moment) continue;
    console = moment->state.probe.console;
    cases::FrameTruth frame = see(moment->state, moment->displacement);
    frame.live = !moment->state.probe.frozen;
    recorder.frame(frame);
    frames.put(frame);
  }
  servo.stop();
  if (with.ended) with.ended();
  if (const auto chunks = recorder.finish(); !chunks) return chunks.error();

  casedb::AttemptOutcome outcome;
  outcome.servo = servo.record();
  outcome.end = now.state.fire.fired     ? casedb::AttemptEnd::fired
                : recorder.fell_behind() ? casedb::AttemptEnd::interrupted
                : with.done()            ? casedb::AttemptEnd::stopped
                                         : casedb::AttemptEnd::time_limit;
  const auto recording = keep_ == Keep::stored ? casedb::load_open_recording(library_, attempt_id)
                                               : cases::recording_from_chunks(not_kept);
  if (!recording) return recording.error();
  auto scored = score(scene_, *recording);
  if (!scored) return scored.error();
  outcome.metrics = std::move(scored->metrics);
  outcome.steps = std::move(scored->steps);
  if (keep_ == Keep::stored) {
    outcome.picture_png = picture_at_endpoint(scene_, *recording);
    if (const auto closed = casedb::close_attempt(library_, attempt_id, outcome); !closed) return closed.error();
  }
  return StoredAttempt{std::move(attempt_id), std::move(outcome.metrics), std::move(outcome.steps), *outcome.end};
}

}  // namespace seldinger::app
