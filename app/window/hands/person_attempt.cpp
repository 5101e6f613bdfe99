#include "app/window/hands/person_attempt.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "session/case/target_organ.h"
#include "session/guidance/guidance.h"
#include "sim/base/check.h"
#include "sim/base/failure.h"
#include "sim/engine/step.h"

namespace seldinger::app {
namespace {

constexpr double kAimMm = 60.0;  // any depth: only its direction counts
// An arm that has not answered by then, since the attempt began, does not lead from the beginning.
constexpr double kArmAnswersS = 0.5;
constexpr double kShareBeforeOrgan =
    0.85;  // of the time in which a case is prepared; then its target's organ is found

}  // namespace

PersonAttempt::PersonAttempt(Wanted wanted) : wanted_(std::move(wanted)) {
  thread_ = std::thread([this] { run(); });
}

PersonAttempt::~PersonAttempt() {
  end();
  {
    const std::lock_guard lock(mutex_);
    gone_ = true;
  }
  begun_.notify_all();
  thread_.join();
}

std::shared_ptr<session::Task> PersonAttempt::task() const {
  CHECK(phase() != Phase::preparing && task_);
  return task_;
}

const base::Error& PersonAttempt::error() const {
  CHECK(phase() == Phase::refused);
  return *error_;
}

const session::StoredAttempt& PersonAttempt::stored() const {
  CHECK(phase() == Phase::stored);
  return *stored_;
}

session::Monitor& PersonAttempt::monitor() {
  CHECK(phase() != Phase::preparing && phase() != Phase::ready && monitor_);
  return *monitor_;
}

void PersonAttempt::begin(bool left_handed) {
  CHECK(phase() == Phase::ready);
  take_up_tools(left_handed);
  phase_.store(Phase::running, std::memory_order_release);
  {
    const std::lock_guard lock(mutex_);
    begin_ = true;
  }
  begun_.notify_all();
}

void PersonAttempt::choose_probe(std::string_view name) {
  CHECK(phase() == Phase::ready);
  session::choose_probe(*task_, name);
}

void PersonAttempt::resume(std::string attempt_id, bool left_handed) {
  CHECK(phase() == Phase::ready);
  phase_.store(Phase::preparing, std::memory_order_release);
  {
    const std::lock_guard lock(mutex_);
    resumed_ = std::move(attempt_id);
    left_handed_ = left_handed;
    begin_ = true;
  }
  begun_.notify_all();
}

void PersonAttempt::take_up_tools(bool left_handed) {
  const cases::Case& scene = task_->scene;
  const assessment::PuncturePlan& plan = task_->plan;
  devices::HandsSettings settings;
  settings.needle_length_mm = scene.instrument.length_mm;
  // Over the entry, but straight down: where the target lies is for the trainee to find.
  const glm::dvec3 entry_lps_mm = scene.planned_entry_lps_mm.value_or(plan.entry_lps_mm);
  const cases::Closest near = scene.skin_index.closest_skin(entry_lps_mm);
  const glm::dvec3 aim_lps_mm =
      near.point_lps_mm - kAimMm * devices::face_normal(scene.skin_index, near.point_lps_mm,
                                                        scene.skin_index.normal(near.triangle), near.triangle);
  devices::HandsStart start = devices::start_over(scene.skin_index, near.point_lps_mm, aim_lps_mm,
                                                  scene.approach == cases::Approach::in_plane, left_handed);
  settings.has_probe = settings.has_guide = session::guidance_kind(scene.picture.modality).probe_guides;
  if (!settings.has_probe) start.probe = plan.probe;  // laid aside
  hands_.emplace(scene, start, settings, left_handed ? haptics::Handedness::left : haptics::Handedness::right,
                 wanted_.arms ? &*wanted_.arms : nullptr);
  monitor_ = std::make_unique<session::Monitor>(task_->scene, 0, wanted_.by);
  know([&](casedb::Conditions& conditions) {
    conditions.handedness = left_handed ? casedb::Handedness::left : casedb::Handedness::right;
    conditions.needle_arm = conditions.probe_arm = hands_->arm_model();
  });
}

// A new one, or the one that is resumed, replayed.
base::Result<session::LiveAttempt> PersonAttempt::live(casedb::Library& library) {
  if (!resumed_)
    return session::LiveAttempt(library, wanted_.program,
                                session::head_of(*task_, wanted_.program, std::string(casedb::kPersonOperator), 0,
                                                 std::optional(wanted_.person_id)),
                                task_->scene, wanted_.keep);
  auto interrupted = session::InterruptedAttempt::take(library, *resumed_);
  if (!interrupted) return interrupted.error();
  if (!session::was_made_at(interrupted->attempt(), *task_))
    return base::Error{"other_case", "the interrupted attempt was made on a different task"};
  if (const auto replayed = interrupted->replay(task_->scene); !replayed) return replayed.error();
  take_up_tools(left_handed_);
  for (const cases::Inputs& inputs : interrupted->recording().inputs)
    if (inputs.event != cases::EventKind::none) said_before_.push_back(inputs.event);
  const cases::Inputs& left = interrupted->recording().inputs.back();
  hands_->take_over(left, interrupted->now().state);
  fluoroscope_ = left.fluoroscope;
  fluoroscope_.pedal = false;  // nobody's foot has been on it
  console_ = left.console;
  phase_.store(Phase::running, std::memory_order_release);
  return session::LiveAttempt(library, wanted_.program, std::move(*interrupted), task_->scene);
}

bool PersonAttempt::say(cases::EventKind kind, double length_mm) noexcept {
  const std::uint64_t said = said_count_.load(std::memory_order_relaxed);
  if (said - heard_count_.load(std::memory_order_acquire) >= kMostSaid) return false;
  said_[said % kMostSaid].store({kind, cases::tenths_of(length_mm)}, std::memory_order_relaxed);
  said_count_.store(said + 1, std::memory_order_release);
  return true;
}

void PersonAttempt::know(const std::function<void(casedb::Conditions&)>& change) {
  const std::lock_guard lock(conditions_mutex_);
  change(conditions_);
}

// By whoever stores.
casedb::Conditions PersonAttempt::conditions() {
  casedb::Conditions known;
  know([&](const casedb::Conditions& told) { known = told; });
  if (phase() == Phase::storing) known.begun_again = again_.load();
  return known;
}

// By the servo.
cases::Inputs PersonAttempt::hands(const cases::State& state, const cases::FrameTruth* frame) {
  if (frame != nullptr) frame_ = *frame;
  if (const auto told = told_.take()) {
    if (devices::way_of(devices::since(told_sum_, told->sum)) > 0.0)
      led_by_[hands_->mouse().held() == devices::HeldTool::needle ? 0 : 1] = told->by;
    told_sum_ = told->sum;
    even_.tell(told->sum, told->between_s);
    fluoroscope_ = told->fluoroscope;
    console_ = told->console;
    told_s_ = told->told_s;
    hand_to_force_s_ = session::clock_s() - told_s_;
  }
  cases::Inputs inputs;
  inputs.fluoroscope = fluoroscope_;
  hands_->advance(even_.advance(base::kTickS), state, forces_, base::kTickS, inputs);
  inputs.console = console_;
  const std::uint64_t heard = heard_count_.load(std::memory_order_relaxed);
  if (said_count_.load(std::memory_order_acquire) != heard) {
    const Said next = said_[heard % kMostSaid].load(std::memory_order_relaxed);
    inputs.event = next.kind;
    inputs.event_tenths_mm = next.tenths_mm;
    heard_count_.store(heard + 1, std::memory_order_release);
  } else if (asked_.load(std::memory_order_relaxed) != cases::EventKind::none) {
    inputs.event = asked_.exchange(cases::EventKind::none);
  }
  return inputs;
}

// Nothing: that is not known yet.
std::optional<cases::HandKind> PersonAttempt::hand_of(haptics::Tool tool, const cases::State& state) const {
  if (!hands_->mouse_leads(tool)) return cases::HandKind::arm;
  const bool an_arms =
      hands_->arms().used && std::ranges::find(hands_->arms().tools, tool) != hands_->arms().tools.end();
  const std::size_t of = tool == haptics::Tool::needle ? 0 : 1;
  if (an_arms && !noted_hand_[of] && state.t_s < begun_at_s_ + kArmAnswersS) return std::nullopt;
  return led_by_[of];
}

// One thing a tick; what else there is waits for the next.
cases::EventKind PersonAttempt::note(const cases::State& state) {
  if (begun_at_s_ < 0.0) begun_at_s_ = state.t_s;
  for (const haptics::Tool tool : {haptics::Tool::needle, haptics::Tool::probe}) {
    const bool needle = tool == haptics::Tool::needle;
    std::optional<cases::HandKind>& noted = noted_hand_[needle ? 0 : 1];
    const auto hand = hand_of(tool, state);
    if (!hand || hand == noted) continue;
    noted = hand;
    return cases::led_by(needle ? cases::LedTool::needle : cases::LedTool::probe, *hand);
  }
  const devices::Hands& mouse = hands_->mouse();
  const bool leads = hands_->mouse_leads(haptics::Tool::needle);  // a guide is for what mouse and keys lead
  const auto turned = [](bool now, bool& noted) { return std::exchange(noted, now) != now; };
  if (turned(leads && mouse.guided(), noted_guided_)) {
    noted_in_guide_ = false;
    return noted_guided_ ? cases::EventKind::guide_on : cases::EventKind::guide_off;
  }
  if (turned(leads && mouse.in_guide(), noted_in_guide_) && noted_in_guide_) return cases::EventKind::guide_reached;
  if (turned(mouse.returning(), noted_returning_))
    return noted_returning_ ? cases::EventKind::return_begun : cases::EventKind::return_ended;
  return cases::EventKind::none;
}

void PersonAttempt::feel(const engine::Tick& tick, const engine::TickState& now) {
  hands_->feel(tick, now, base::kTickS);
  if (ArmsWatch* arms = hands_->watch(); arms != nullptr && arms->due(base::kTickS)) arms_seen_.put(arms->seen());
}

void PersonAttempt::watch(engine::Moment moment) {
  moment.told_s = told_s_;
  if (moment.force) forces_ = {moment.force->needle_axial_n, moment.force->probe_n};
  Seen seen{moment};
  const devices::Hands& mouse = hands_->mouse();
  seen.held = mouse.held();
  seen.frozen = hands_->frozen();
  seen.guided = mouse.guided();
  seen.in_guide = mouse.in_guide();
  seen.guide = mouse.guide_on_probe();
  seen.guides_asked = mouse.guides_asked();
  seen.needle_side = mouse.needle().side;
  seen.returning = mouse.returning();
  // What an arm led is where it is; mouse and keys know what they asked for.
  const bool by_mouse = hands_->mouse_leads(haptics::Tool::needle);
  seen.inserted_mm = by_mouse ? mouse.inserted_mm() : moment.state.needle.inserted_mm;
  seen.inserted = by_mouse ? mouse.needle_inserted() : seen.inserted_mm > 0.0;
  seen.needle_by_mouse = by_mouse;
  seen.press_mm = hands_->press_mm(moment.state);
  seen.by_mouse =
      hands_->mouse_leads(seen.held == devices::HeldTool::needle ? haptics::Tool::needle : haptics::Tool::probe);
  seen.frame = frame_;
  seen.arms = hands_->arms();
  seen.hand_to_force_s = hand_to_force_s_;
  seen_.put(seen);
  monitor_->show(moment);
}

void PersonAttempt::run() {
  const auto refuse = [this](base::Error error) {
    error_ = std::move(error);
    phase_.store(Phase::refused, std::memory_order_release);
  };
  try {
    auto library = casedb::Library::open(wanted_.library);
    if (!library) return refuse(library.error());
    task_ = wanted_.task;
    if (!task_) {
      auto task = session::prepare_task(*library, wanted_.case_id, "", std::nullopt, wanted_.modality,
                                        [this](double share) { prepared_ = kShareBeforeOrgan * share; });
      if (!task) return refuse(task.error());
      {
        const std::lock_guard lock(mutex_);
        if (gone_) return;
      }
      task->organ = session::organ_of_target(*library, task->row, task->lesion.lesion.center_lps_mm);
      task_ = std::make_shared<session::Task>(std::move(*task));
    }
    prepared_ = 1.0;
    phase_.store(Phase::ready, std::memory_order_release);
    {
      std::unique_lock lock(mutex_);
      begun_.wait(lock, [this] { return begin_ || gone_; });
      if (!begin_) return;
    }
    auto attempt = live(*library);
    if (!attempt) return refuse(attempt.error());
    const auto stored = attempt->run(
        {.hands = [this](const cases::State& state, const cases::FrameTruth* frame) { return hands(state, frame); },
         .read = [this] { return hands_->read(); },
         .note = [this](const cases::State& state) { return note(state); },
         .feel = [this](const engine::Tick& tick, const engine::TickState& now) { feel(tick, now); },
         .done = [this] { return ending_.load() && said_count_.load() == heard_count_.load(); },
         .paused =
             [this] {
               if (!paused_.load()) return false;
               hands_->let_go();
               return true;
             },
         .stalled = [this] { hands_->let_go(); },
         .watch = [this](const engine::Moment& moment) { watch(moment); },
         .ended = [this] { phase_.store(Phase::storing, std::memory_order_release); },
         .asked = [this](cases::EventKind kind) { asked_ = kind; },
         .conditions = [this] { return conditions(); }});
    hands_.reset();  // an arm's service speaks with one program at a time
    if (!stored) return refuse(stored.error());
    stored_ = *stored;
    phase_.store(Phase::stored, std::memory_order_release);
  } catch (const base::Failure& failure) {
    refuse({failure.code(), failure.what()});
  }
}

}  // namespace seldinger::app
