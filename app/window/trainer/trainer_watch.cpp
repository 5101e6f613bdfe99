// Stored attempts that are watched: one alone, or one's own beside an expert's.
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

bool Trainer::may_watch(const std::string& attempt_id) {
  if (resuming_) return false;
  if (screen_ != TrainerScreen::briefing && screen_ != TrainerScreen::debrief) return false;
  const auto attempt = casedb::find_attempt(library_, attempt_id);
  return attempt && (attempt_id == expert_ || attempt->person_id == account_.person_id);
}

void Trainer::watch(const std::string& attempt_id, double from_s) {
  if (!may_watch(attempt_id)) return;
  refusal_.clear();
  watched_from_ = screen_;
  watched_ids_ = {attempt_id};
  beside_.reset();
  watched_ = std::make_unique<session::WatchedAttempt>(library_.folder(), attempt_id, by_);
  if (from_s > 0.0) watched_->go_to(from_s);
  screen_ = TrainerScreen::watch;
}

void Trainer::watch_beside_expert() {
  if (!debrief_ || expert_.empty() || !may_watch(debrief_->attempt.attempt_id)) return;
  watch(std::string(debrief_->attempt.attempt_id));
  watched_ids_.push_back(expert_);
  beside_ = std::make_unique<session::WatchedAttempt>(library_.folder(), expert_, by_);
}

void Trainer::stop_watching() {
  if (screen_ == TrainerScreen::watch) screen_ = watched_from_;
}

void Trainer::look_at_watched() {
  if (screen_ != TrainerScreen::watch) {
    watched_.reset();
    beside_.reset();
  }
  bool prepared = watched_ != nullptr;
  for (const auto* one : {&watched_, &beside_}) {
    if (!*one) continue;
    const session::WatchedAttempt::Phase phase = (*one)->phase();
    if (phase == session::WatchedAttempt::Phase::refused) {
      refusal_ = (*one)->error().text;
      stop_watching();
      return;
    }
    prepared = prepared && phase != session::WatchedAttempt::Phase::preparing;
  }
  if (!prepared) return;
  // Whoever is not in the library any more watches as nobody.
  for (const std::string& id : watched_ids_)
    static_cast<void>(casedb::note_replay_watched(library_, account_.person_id, id));
  watched_ids_.clear();
}

}  // namespace seldinger::app
