// What happens at a workstation, from logging in to the debrief, without a window: which screen is up, what can be
// chosen, and what an attempt came to. The window draws it and tells it what was pressed.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/train/person_attempt.h"
#include "app/train/watched_attempt.h"
#include "casedb/curriculum.h"
#include "casedb/grading.h"
#include "casedb/store.h"

namespace seldinger::app {

enum class TrainerScreen { log_in, choose, briefing, attempt, debrief, watch };

// A case that can be chosen, as a line of the list.
struct Choice {
  std::string case_id, title, curriculum;  // no curriculum: it stands alone
  cases::Modality modality = cases::Modality::mpr;
  casedb::Difficulty difficulty = casedb::Difficulty::moderate;
  int attempts = 0, passes = 0;
  bool open = true;     // else a gate of the curriculum is shut, or no attempt is left
  bool due = false;     // what comes next
  std::string reached;  // "proficient"; empty out of a curriculum
  std::optional<int> attempts_left;
};

// What an attempt came to.
struct Debrief {
  casedb::AttemptRow attempt;
  casedb::AttemptGrade grade;
  std::vector<assessment::StepResult> steps;
};

class Trainer {
 public:
  // Without arms, mouse and keys and what is like them are the hands.
  explicit Trainer(casedb::Library library, std::optional<Arms> arms = std::nullopt);

  // Of what comes from now on.
  void set_pictures_by(PicturesBy by) noexcept { by_ = by; }

  TrainerScreen screen() const noexcept { return screen_; }
  // The last thing that was refused, in words for the screen; empty: nothing was.
  const std::string& refusal() const noexcept { return refusal_; }

  // Accounts as the dashboard's. A refusal does not say which of the two was wrong.
  void log_in(const std::string& name, const std::string& password);
  void log_out();  // what runs is stopped and stored
  const casedb::Account& account() const noexcept { return account_; }

  const std::vector<Choice>& choices() const noexcept { return choices_; }
  void choose(const std::string& case_id);  // of the choices; else nothing happens
  // What comes next, by what was reached when the choices were listed: the first that is due. Null: nothing is.
  const Choice* next() const noexcept;
  const casedb::CaseRow& chosen() const noexcept { return chosen_; }
  // An attempt at it that an expert passed, to watch before one's own; empty: there is none.
  const std::string& expert_attempt() const noexcept { return expert_; }
  // How much the room helps (imaging::RoomOptions): in easy cases the needle's own line and the picture's plane,
  // and less with each pass; where the target lies is never told.
  int help() const noexcept { return help_; }
  void back();  // from briefing or debrief to the choice

  // From briefing to attempt, once it is prepared; a patient's sign-in is said with it. False: not yet.
  bool begin(bool left_handed);
  // The same case once more, to begin as soon as it is ready; a running attempt is stopped and stored.
  void again();
  bool restarting() const noexcept { return restarting_; }
  // How far the chosen case is prepared, 0 to 1.
  double prepared() const noexcept { return attempt_ ? attempt_->prepared() : 0.0; }
  // Whether the chosen case may be begun once more: attempts can be used up. From the debrief on.
  bool once_more() const noexcept;
  // Nothing before a case was chosen, and none after a refusal.
  PersonAttempt* attempt() noexcept { return attempt_.get(); }

  // A stored attempt is watched, from briefing or debrief, and back to there. The trainee's own, or an expert's.
  void watch(const std::string& attempt_id);
  void stop_watching();
  WatchedAttempt* watched() noexcept { return watched_.get(); }

  // Looks whether threads have got on; once a frame.
  void look();
  const Debrief* debrief() const noexcept { return debrief_ ? &*debrief_ : nullptr; }

 private:
  void list_choices();
  const Choice* find_choice(const std::string& case_id) const noexcept;  // null: it is not among them
  void prepare(std::shared_ptr<const Task> task);

  casedb::Library library_;
  std::optional<Arms> arms_;
  PicturesBy by_ = PicturesBy::cpu;
  TrainerScreen screen_ = TrainerScreen::log_in;
  std::string refusal_;
  casedb::Account account_;
  std::vector<Choice> choices_;
  casedb::CaseRow chosen_;
  std::string expert_;
  std::unique_ptr<PersonAttempt> attempt_;
  std::optional<Debrief> debrief_;
  std::unique_ptr<WatchedAttempt> watched_;
  TrainerScreen watched_from_ = TrainerScreen::debrief;
  bool restarting_ = false;
  int help_ = 0;
};

}  // namespace seldinger::app
