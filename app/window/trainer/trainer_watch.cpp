// Attempts that are watched: a stored one alone, one's own beside an expert's, or one that is being made.
#include <algorithm>

#include "app/window/trainer/trainer.h"
#include "casedb/attempts/asked_events.h"
#include "casedb/database/running_mark.h"
#include "casedb/people/relations.h"

namespace seldinger::app {
namespace {

constexpr double kLookIntoRoomsEveryS = 2.0;

}  // namespace

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

// By the table of permissions, asked each time: whoever leaves a cohort is out of sight at once.
void Trainer::look_into_rooms() {
  if (screen_ != TrainerScreen::choose) return;
  const double now_s = session::clock_s();
  if (now_s < looked_into_rooms_s_ + kLookIntoRoomsEveryS) return;
  looked_into_rooms_s_ = now_s;
  in_room_.clear();
  for (const casedb::OpenAttempt& open : casedb::list_open_attempts(library_)) {
    if (!open.person_id || open.person_id == account_.person_id) continue;
    if (!casedb::may(account_.role, casedb::Action::see_recording,
                     casedb::relation_to(library_, account_.person_id, open.person_id)))
      continue;
    if (!casedb::is_running(library_.folder(), open.attempt_id)) continue;
    const auto of_case = casedb::find_case(library_, open.case_id);
    const auto users = casedb::list_users(library_);
    const auto who = std::find_if(users.begin(), users.end(),
                                  [&](const casedb::Account& one) { return one.person_id == *open.person_id; });
    if (of_case && who != users.end())
      in_room_.push_back({open.attempt_id, open.case_id, who->login_name, of_case->title});
  }
}

void Trainer::look_in(const std::string& attempt_id) {
  const auto there = std::find_if(in_room_.begin(), in_room_.end(),
                                  [&](const InRoom& one) { return one.attempt_id == attempt_id; });
  if (screen_ != TrainerScreen::choose || there == in_room_.end()) return;
  const auto row = casedb::find_case(library_, there->case_id);
  if (!row) return;
  chosen_ = *row;
  refusal_.clear();
  watched_from_ = screen_;
  watched_ids_ = {};
  beside_.reset();
  watched_ = std::make_unique<session::WatchedAttempt>(library_.folder(), attempt_id, by_);
  screen_ = TrainerScreen::watch;
}

bool Trainer::may_cause() const noexcept {
  return screen_ == TrainerScreen::watch && watched_ &&
         watched_->phase() == session::WatchedAttempt::Phase::playing && watched_->live() &&
         may(casedb::Action::cause_event) && chosen_.subject == cases::Subject::patient;
}

void Trainer::cause(cases::EventKind kind) {
  if (!may_cause()) return;
  const auto asked = casedb::ask_event(library_, watched_->attempt().attempt_id, kind);
  refusal_ = asked ? "" : asked.error().text;
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
