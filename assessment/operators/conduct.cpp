#include "assessment/operators/conduct.h"

#include "sim/base/hash.h"

namespace seldinger::assessment {
namespace {

using cases::EventKind;

constexpr std::uint64_t kStream = 0x636f6e64ULL;  // apart from what the hands draw
constexpr double kTroubleSeconds = 5.0;           // until it is over, longer than a step asks for
constexpr double kBreathSeconds = 1.5;            // until the patient holds still

}  // namespace

bool forbids(const Brief& brief) noexcept {
  return (brief.inr && *brief.inr > kMostInr) ||
         (brief.platelets_per_nl && *brief.platelets_per_nl < kLeastPlateletsPerNl);
}

Conduct::Conduct(const Skills& skills, const Brief& brief, bool with_probe, std::uint64_t seed)
    : skills_(skills),
      patient_(brief.subject == cases::Subject::patient),
      forbidden_(forbids(brief)),
      with_probe_(with_probe),
      rng_(base::hash_combine(seed, kStream)) {}

void Conduct::begin(Part part) {
  steps_.clear();
  next_ = 0;
  const auto add = [this](EventKind step) {
    if (!patient_ && step != EventKind::probe_checked && step != EventKind::note_plan) return false;
    const bool skipped = rng_.uniform() < skills_.skip_step_share;
    if (!skipped) steps_.push_back(step);
    return !skipped;
  };
  switch (part) {
    case Part::sign_in: {
      const bool looked = add(EventKind::sign_in);  // who has not looked does not know
      const bool missed = rng_.uniform() < skills_.misses_contraindication_share;
      deferred_ = forbidden_ && looked && !missed;
      if (deferred_)
        steps_.push_back(EventKind::defer);
      else
        add(EventKind::proceed);
      break;
    }
    case Part::prepare:
      if (with_probe_) add(EventKind::probe_checked);
      for (const EventKind step :
           {EventKind::note_plan, EventKind::aspirate, EventKind::anaesthetic, EventKind::nick})
        add(step);
      break;
    case Part::hold_breath:
      breath_asked_ = add(EventKind::breath_hold_request);
      break;
    case Part::ask_breath:
      if (patient_) steps_.push_back(EventKind::breath_hold_request);
      breath_asked_ = patient_;
      break;
    case Part::finish:
      if (breath_asked_) steps_.push_back(EventKind::breathe_again);
      add(EventKind::sign_out);
      break;
  }
  wait_s_ = steps_.empty() ? 0.0 : skills_.step_s;
  // A breath is not asked for after a talk.
  if (part != Part::hold_breath && part != Part::ask_breath) wait_s_ += skills_.pause_s;
}

void Conduct::hear(EventKind kind) {
  const cases::EventInfo* info = cases::find_event(kind);
  if (info == nullptr || info->source != cases::EventSource::mentor) return;
  if (rng_.uniform() < skills_.stops_in_trouble_share) stopped_s_ = kTroubleSeconds;
}

EventKind Conduct::advance(double dt_s) {
  stopped_s_ -= dt_s;
  if (wait_s_ > 0.0) wait_s_ -= dt_s;
  if (wait_s_ > 0.0 || next_ == steps_.size()) return EventKind::none;
  const EventKind step = steps_[next_++];
  if (next_ < steps_.size()) wait_s_ = skills_.step_s;
  if (step == EventKind::breath_hold_request) wait_s_ = kBreathSeconds;
  return step;
}

}  // namespace seldinger::assessment
