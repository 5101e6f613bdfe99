// What happens at a workstation, from logging in to the debrief, without a window: which screen is up, what can be
// chosen, and what an attempt came to. The window draws it and tells it what was pressed.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/editor/case_editor.h"
#include "app/window/hands/device_page.h"
#include "app/window/hands/person_attempt.h"
#include "app/window/trainer/answering.h"
#include "app/window/trainer/case_import.h"
#include "app/window/trainer/case_thumbnails.h"
#include "casedb/attempts/attempts.h"
#include "casedb/attempts/stations.h"
#include "casedb/cases/cases.h"
#include "casedb/cases/permissions.h"
#include "casedb/grading/choices.h"
#include "casedb/grading/dependability.h"
#include "casedb/grading/grading.h"
#include "casedb/people/login_delays.h"
#include "casedb/people/people.h"
#include "session/attempt/watched_attempt.h"

namespace seldinger::app {

enum class TrainerScreen { log_in, choose, briefing, attempt, debrief, answer, watch, editor, devices };

using casedb::CaseDraft;
using casedb::Choice;

// One of the person's own attempts at a case, as it is graded now.
struct OwnAttempt {
  std::string attempt_id;
  double duration_s = 0.0;
  assessment::Grade grade;
};

// Somebody whose attempt runs right now, at this workstation's library.
struct InRoom {
  std::string attempt_id, case_id, who, case_title;
  bool operator==(const InRoom&) const = default;
};

// What an attempt came to.
struct Debrief {
  casedb::AttemptRow attempt;  // without an id: it was tried and is not kept
  casedb::AttemptGrade grade;
  std::vector<assessment::StepResult> steps;
  std::vector<assessment::FaultMoment> faults{};  // of what it was graded by
  std::optional<assessment::DonePath> path{};     // how the needle went in
  std::vector<OwnAttempt> own{};                  // the latest at this case, oldest first, with this one
};

class Trainer {
 public:
  // Without arms, mouse and keys and what is like them are the hands.
  explicit Trainer(casedb::Library library, std::optional<Arms> arms = std::nullopt);

  // Of what comes from now on.
  void set_pictures_by(session::PicturesBy by) noexcept { by_ = by; }
  void set_station(std::string name) { station_ = std::move(name); }

  TrainerScreen screen() const noexcept { return screen_; }
  // Whoever logs in finds this case's briefing open at once (a mentor a draft in the case editor), or is told why
  // not. Refused: `no_case`.
  std::optional<base::Error> open_at_log_in(const std::string& case_id);
  // The last thing that was refused, in words for the screen; empty: nothing was.
  const std::string& refusal() const noexcept { return refusal_; }

  // Accounts and delays as the dashboard's. A refusal does not say which of the two was wrong.
  void log_in(const std::string& name, const std::string& password);
  void log_out();  // what runs is stopped and stored
  const casedb::Account& account() const noexcept { return account_; }

  const std::vector<Choice>& choices() const noexcept { return choices_.cases; }
  // Whether whoever is logged in may do it (casedb/cases/permissions.h).
  bool may(casedb::Action action) const noexcept { return casedb::may(account_.role, action); }
  void choose(const std::string& case_id);  // of the choices; else nothing happens
  // A picture of a listed case or draft; null: not made yet, or there is none.
  std::shared_ptr<const CaseThumbnail> thumbnail(const std::string& case_id) const {
    return thumbnails_->of(case_id);
  }
  // What comes next, by what was reached when the choices were listed: the first that is due. Null: nothing is.
  const Choice* next() const noexcept;
  // The chosen case among the choices, and what follows once it is passed (casedb::after_pass); null: it is not
  // one.
  const Choice* own_choice() const noexcept { return find_choice(chosen_.case_id); }
  const Choice* after_pass() const noexcept { return casedb::after_pass(choices_, chosen_.case_id); }
  const casedb::CaseRow& chosen() const noexcept { return chosen_; }
  bool provisional() const noexcept { return provisional_; }  // nobody has set a standard for it
  // Of passing it, by what people did: what stands beside its pass rule.
  // Nothing: it has none, or is tried.
  const std::optional<assessment::statistics::Answer>& dependability() const noexcept { return dependability_; }
  // An attempt at it that an expert passed, to watch before one's own; empty: there is none.
  const std::string& expert_attempt() const noexcept { return expert_; }
  // How much the room helps (imaging::RoomOptions): in easy cases the needle's own line and the picture's plane,
  // and less with each pass; where the target lies is never told.
  int help() const noexcept { return help_; }
  void back();  // from briefing or debrief to the choice, or to the case editor whose draft was tried

  // --- questionnaires that are asked after an attempt (casedb/questionnaires/desk_rounds.h) ---
  const std::vector<casedb::Round>& due_questionnaires() const noexcept { return due_; }
  void answer(const std::string& round_id);  // of those, from the choice or the debrief
  Answering* answering() noexcept { return answering_ ? &*answering_ : nullptr; }
  void send_answers();
  void leave_answers();  // kept as a draft; back to where one came from

  // --- the case editor; empty, and nothing happens, for everybody else ---
  const std::vector<CaseDraft>& drafts() const noexcept { return choices_.drafts; }
  void open_editor(const std::string& case_id);  // of the drafts
  // For good, unless attempts were made on it.
  bool may_delete(const CaseDraft& draft) const noexcept;
  void delete_draft(const std::string& case_id);
  // A CT becomes a draft of theirs, in the background.
  bool may_import() const noexcept {
    return may(casedb::Action::add_case) &&
           casedb::may(account_.role, casedb::Action::work_on_case, casedb::CaseState::draft);
  }
  void import_case(CaseImport::Wish wish);
  bool importing() const noexcept { return import_ != nullptr; }
  // What became of it, or of a draft's duplicate, in words for the list: also which cases hold this CT already.
  const std::string& imported() const noexcept { return imported_; }
  // A draft like a case that was published or that attempts were made on, the next version, in the case editor.
  void new_version(const std::string& case_id);
  void open_made_draft(const std::string& case_id);  // one that the editor made of the case in it
  // A draft like one of the drafts, of the same CT, that is a case of its own.
  void duplicate_draft(const std::string& case_id);
  CaseEditor* editor() noexcept { return editor_.get(); }
  void leave_editor();  // to the choice
  // An attempt at what is in the case editor: of no trainee, graded and forgotten.
  void try_draft();
  bool trying() const noexcept { return trying_; }

  // --- the trainee's own plan: the way in, set in the briefing, kept with each attempt from there on ---
  const std::optional<assessment::PlannedPath>& plan() const noexcept { return plan_; }
  // The skin nearest to this place; and where the tip is to be. Nothing happens before the case is prepared, and
  // where entry and tip would be one.
  void plan_entry(const glm::dvec3& place_lps_mm);
  void plan_tip(const glm::dvec3& place_lps_mm);
  bool proposes_path() const;  // of what may be planned now
  void plan_as_proposed();     // the case's planned way, up to where its needle is fired
  void drop_plan() noexcept { plan_.reset(); }

  // The probes among which the trainee chooses, once the case is prepared; empty: there is no choice.
  std::vector<std::string> probes() const;
  // One of these; in an attempt that begins again the last, unless another is chosen. Empty: not yet.
  void choose_probe(const std::string& name);
  const std::string& chosen_probe() const noexcept { return probe_; }

  // From briefing to attempt, once it is prepared; a patient's sign-in is said with it. False: not yet, or a probe
  // is to be chosen. An attempt at the case that was interrupted is closed: it will not be resumed.
  bool begin(bool left_handed);
  // The account's attempt at the chosen case that a program left behind when it died; nothing: there is none.
  const std::optional<casedb::OpenAttempt>& interrupted() const noexcept { return interrupted_; }
  // Goes on with it instead, from briefing over its replay (`resuming`) to attempt. False: not yet, or there is
  // none.
  bool resume(bool left_handed);
  bool resuming() const noexcept { return resuming_; }
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
  void watch(const std::string& attempt_id, double from_s = 0.0);
  void watch_beside_expert();  // the trainee's own of the debrief, and an expert's beside it
  void stop_watching();
  // Who is in the room while the list is up, of those whose recordings one may see; and one of them is followed.
  const std::vector<InRoom>& in_room() const noexcept { return in_room_; }
  void look_in(const std::string& attempt_id);
  // Whoever looks in and may lets something happen to the patient there; it does within some seconds.
  bool may_cause() const noexcept;
  void cause(cases::EventKind kind);
  session::WatchedAttempt* watched() noexcept { return watched_.get(); }
  session::WatchedAttempt* beside() noexcept { return beside_.get(); }  // null: one alone is watched

  // The hands at this desk, from any screen but an attempt, a replay and one that is to begin again; and back
  // there.
  void show_devices();
  void leave_devices();
  const std::optional<Arms>& arms() const noexcept { return arms_; }
  DevicePage* device_page() noexcept { return device_page_.get(); }  // of the arms, while they are shown
  // What is known of the station becomes so, in its file too; false: refused, and nothing is changed.
  bool change_station(const std::function<void(Station&)>& change);
  // A side's arm is calibrated so, and is that arm from now on.
  bool keep_calibration(std::size_t side, const devices::Calibration& calibration);
  void exchange_arms();  // what is the left hand's becomes the right one's

  // Looks whether threads have got on; once a frame.
  void look();
  const Debrief* debrief() const noexcept { return debrief_ ? &*debrief_ : nullptr; }

 private:
  void list_choices();
  void look_at_thumbnails();
  void open_first();
  const Choice* find_choice(const std::string& case_id) const noexcept;  // null: it is not among them
  void prepare(std::shared_ptr<session::Task> task);
  const session::Task* planned_task() const;  // what may be planned now; null: nothing
  void put_plan(const assessment::PlannedPath& path);
  void take_import();
  void tell_conditions();
  bool may_watch(const std::string& attempt_id);
  void look_at_watched();
  void look_into_rooms();
  Debrief debrief_of_try();
  std::vector<OwnAttempt> own_attempts();

  casedb::Library library_;
  casedb::LoginDelays delays_;
  std::optional<Arms> arms_;
  session::PicturesBy by_ = session::PicturesBy::cpu;
  std::string station_ = casedb::kUnnamedStation;
  TrainerScreen screen_ = TrainerScreen::log_in;
  std::string refusal_;
  casedb::Account account_;
  casedb::Choices choices_;
  std::unique_ptr<CaseThumbnails> thumbnails_;
  bool thumbnails_wanted_ = false;  // of what is listed now
  casedb::CaseRow chosen_;
  std::string expert_;
  std::unique_ptr<PersonAttempt> attempt_;
  std::optional<Debrief> debrief_;
  std::unique_ptr<session::WatchedAttempt> watched_, beside_;
  std::vector<InRoom> in_room_;
  double looked_into_rooms_s_ = -1e9;
  std::vector<std::string> watched_ids_;  // until it is noted that they are watched
  TrainerScreen watched_from_ = TrainerScreen::debrief, devices_from_ = TrainerScreen::choose;
  std::vector<casedb::Round> due_;
  std::optional<Answering> answering_;
  TrainerScreen answered_from_ = TrainerScreen::choose;
  std::unique_ptr<CaseEditor> editor_;
  std::unique_ptr<DevicePage> device_page_;
  std::unique_ptr<CaseImport> import_;
  std::string imported_;
  std::string first_case_;  // to be opened at log-in
  std::optional<casedb::OpenAttempt> interrupted_;
  std::string probe_;
  bool provisional_ = true, restarting_ = false, trying_ = false, resuming_ = false;
  casedb::KeptDependability kept_dependability_;
  std::optional<assessment::statistics::Answer> dependability_;
  int help_ = 0;
  std::optional<assessment::PlannedPath> plan_;
};

}  // namespace seldinger::app
