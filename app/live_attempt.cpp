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
#include "assessment/score.h"
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
  if (keep_ == Keep::stored) {
    auto opened = casedb::open_attempt(library_, head_);
    if (!opened) return opened.error();
    attempt_id = std::move(*opened);
    mark.emplace(library_.folder(), attempt_id);
    auto library = casedb::Library::open(library_.folder());
    if (!library) return library.error();
    recorders_library.emplace(std::move(*library));
  }
  std::vector<cases::RecordingChunk> not_kept;  // the recorder's thread, until it has finished
  assessment::Recorder recorder(engine::kStepVersion, engine::kTickSeconds,
                                [&](const cases::RecordingChunk& chunk) -> base::Result<void> {
                                  if (recorders_library)
                                    return casedb::add_chunk(*recorders_library, attempt_id, chunk);
                                  not_kept.push_back(chunk);
                                  return {};
                                });

  const engine::Tick tick(scene_);
  engine::TickState now;
  base::Snapshot<engine::Moment> moments;
  base::Snapshot<engine::Moment> pulses;
  base::Snapshot<cases::FrameTruth> frames;
  base::Snapshot<cases::ExposureReport> reports;
  std::atomic<bool> over{false};
  engine::ServoLoop servo({}, [&, report = cases::ExposureReport{}](double elapsed_s) mutable {
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
  std::optional<cases::FrameTruth> last;  // of a fluoroscope that is live
  cases::ConsoleSetting console;
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
  auto scored = assessment::score(scene_, *recording);
  if (!scored) return scored.error();
  outcome.metrics = std::move(scored->metrics);
  outcome.steps = std::move(scored->steps);
  if (keep_ == Keep::stored) {
    outcome.picture_png = picture_at_endpoint(scene_, *recording);
    if (const auto closed = casedb::close_attempt(library_, attempt_id, outcome); !closed) return closed.error();
  }
  return StoredAttempt{std::move(attempt_id), std::move(outcome.metrics), std::move(outcome.steps), *outcome.end};
}

namespace {

// Empty where nothing can be said: its case cannot be built any more, or nothing was recorded.
assessment::Scored score_of(casedb::Library& library, const casedb::OpenAttempt& attempt) {
  const auto recording = casedb::load_open_recording(library, attempt.attempt_id);
  const auto row = casedb::find_case(library, attempt.case_id);
  if (!recording || recording->poses.empty() || !row) return {};
  for (const casedb::LesionRow& lesion : casedb::list_lesions(library, attempt.case_id))
    if (lesion.lesion_id == attempt.lesion_id) {
      auto scene = build_case(library, *row, lesion.form, attempt.picture, Needs::metrics);
      if (!scene) return {};
      scene->instrument = attempt.instrument;
      scene->approach = attempt.approach;
      auto scored = assessment::score(*scene, *recording);
      return scored ? std::move(*scored) : assessment::Scored{};
    }
  return {};
}

}  // namespace

std::vector<std::string> close_interrupted_attempts(casedb::Library& library) {
  std::vector<std::string> closed;
  for (const casedb::OpenAttempt& attempt : casedb::list_open_attempts(library)) {
    if (casedb::is_running(library.folder(), attempt.attempt_id)) continue;
    casedb::AttemptOutcome outcome;
    outcome.end = casedb::AttemptEnd::interrupted;
    assessment::Scored scored = score_of(library, attempt);
    outcome.metrics = std::move(scored.metrics);
    outcome.steps = std::move(scored.steps);
    // Another process may have been faster.
    if (casedb::close_attempt(library, attempt.attempt_id, outcome)) closed.push_back(attempt.attempt_id);
  }
  return closed;
}

}  // namespace seldinger::app
