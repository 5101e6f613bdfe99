#include "app/window/trainer/trainer.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/attempts/this_program.h"
#include "casedb/cases/changeable_case.h"
#include "casedb/grading/expert_replay.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/noted_tries.h"
#include "casedb/questionnaires/desk_rounds.h"
#include "session/monitor/monitor.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

constexpr int kMostHelp = 2;
constexpr const char* kThisStation = "station";

}  // namespace

Trainer::Trainer(casedb::Library library, std::optional<Arms> arms)
    : library_(std::move(library)),
      arms_(std::move(arms)),
      thumbnails_(std::make_unique<CaseThumbnails>(library_.folder())) {
  library_.act_for(casedb::Actor::nobody());
  // A person is asked first, when they come to the case.
  session::close_interrupted_attempts(library_, [this](const casedb::OpenAttempt& attempt) {
    return !attempt.synthetic() && attempt.person_id && session::is_interrupted(library_, attempt);
  });
}

void Trainer::log_in(const std::string& name, const std::string& password) {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  const auto now_us = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  auto wait_s = delays_.begin(name, kThisStation, now_us);
  if (wait_s > 0)
    if (const auto account = casedb::open_account(library_, name);
        account && delays_.heed(name, casedb::last_let_in_again(library_, account->person_id)))
      wait_s = delays_.begin(name, kThisStation, now_us);
  if (wait_s > 0) {
    refusal_ = "Too many tries. Try again in " + std::to_string(wait_s) + " s.";
    return;
  }
  std::optional<casedb::Account> account;
  try {
    account = casedb::log_in(library_, name, password);
  } catch (const base::Failure&) {
    delays_.take_back(name, kThisStation);  // nobody was told whether it was right
    throw;
  }
  if (!account) {
    refusal_ = "The name or password is wrong.";
    return;
  }
  delays_.forget(name, kThisStation);
  refusal_.clear();
  account_ = *account;
  library_.act_for(casedb::Actor::person(account_.person_id));
  list_choices();
  screen_ = TrainerScreen::choose;
  if (!first_case_.empty()) open_first();
}

// A case to practise is chosen, a mentor's draft is opened in the case editor; else the list stays, with the
// reason.
void Trainer::open_first() {
  if (const Choice* choice = find_choice(first_case_)) {
    if (choice->open) return choose(first_case_);
    refusal_ = "“" + choice->title + "” is not open for " + account_.login_name + ": " +
               (choice->attempts_left.value_or(1) > 0 ? "you have not yet passed what comes before it."
                                                      : "no attempt is left.");
    return;
  }
  open_editor(first_case_);
  if (screen_ != TrainerScreen::editor)
    refusal_ = "The case of this workstation is not one that " + account_.login_name + " can practise.";
}

std::optional<base::Error> Trainer::open_at_log_in(const std::string& case_id) {
  const auto row = casedb::find_case(library_, case_id);
  if (!row) return row.error();
  first_case_ = case_id;
  return std::nullopt;
}

void Trainer::show_devices() {
  if (screen_ == TrainerScreen::attempt || screen_ == TrainerScreen::watch || screen_ == TrainerScreen::devices ||
      restarting_ || resuming_)
    return;
  devices_from_ = screen_;
  refusal_.clear();
  screen_ = TrainerScreen::devices;
  if (arms_) device_page_ = std::make_unique<DevicePage>(*arms_);
}

void Trainer::leave_devices() {
  if (screen_ != TrainerScreen::devices) return;
  device_page_.reset();  // the arms are an attempt's again
  if (attempt_ &&
      (attempt_->phase() == PersonAttempt::Phase::preparing || attempt_->phase() == PersonAttempt::Phase::ready))
    attempt_->use(arms_);
  refusal_.clear();
  screen_ = devices_from_;
}

bool Trainer::change_station(const std::function<void(Station&)>& change) {
  if (!arms_) return false;
  refusal_.clear();
  if (arms_->station_file.empty()) {
    change(arms_->station);
    return true;
  }
  try {
    auto changed = app::change_station(arms_->station_file, change);
    if (!changed)
      refusal_ = changed.error().text;
    else
      arms_->station = std::move(*changed);
  } catch (const base::Failure& failure) {
    refusal_ = failure.what();
  }
  return refusal_.empty();
}

bool Trainer::keep_calibration(std::size_t side, const devices::Calibration& calibration) {
  if (!device_page_) return false;
  const auto ids = device_page_->status().ids;
  return change_station([&](Station& station) {
    station[kSideNames.at(side)].calibration = calibration;
    // Which arm it was that was calibrated; and once one is named, the other must be.
    for (std::size_t one = 0; one < 2; ++one)
      if (!ids[one].arm.empty()) station[kSideNames[one]].ids = ids[one];
  });
}

void Trainer::exchange_arms() {
  if (!device_page_) return;
  const auto ids = device_page_->status().ids;
  const bool kept = change_station([&](Station& station) {
    for (std::size_t side = 0; side < 2; ++side) station[kSideNames[side]].ids = ids[side];
    std::swap(station["left"], station["right"]);
  });
  if (!kept) return;
  device_page_.reset();
  device_page_ = std::make_unique<DevicePage>(*arms_);
}

void Trainer::log_out() {
  device_page_.reset();
  watched_.reset();
  beside_.reset();
  attempt_.reset();
  debrief_.reset();
  editor_.reset();
  interrupted_.reset();
  trying_ = resuming_ = false;
  plan_.reset();
  std::optional<Answering> answering = std::exchange(answering_, std::nullopt);
  choices_ = {};
  in_room_.clear();
  due_.clear();
  imported_.clear();
  // First: whoever leaves is out, whatever becomes of the library.
  const std::string person_id = std::exchange(account_, {}).person_id;
  library_.act_for(casedb::Actor::nobody());
  refusal_.clear();
  screen_ = TrainerScreen::log_in;
  if (person_id.empty()) return;
  try {
    if (answering) static_cast<void>(answering->keep());  // what does not fit its item was shown
    casedb::log_out(library_, person_id);
  } catch (const base::Failure& failure) {
    refusal_ = std::string("Logged out, but the library could not record it: ") + failure.what();
  }
}

void Trainer::list_choices() {
  choices_ = casedb::choices_of(library_, account_.person_id, account_.role);
  due_ = casedb::due_at_desk(library_, account_.person_id);
  library_.shrink();  // a workstation is on for days
  thumbnails_wanted_ = false;
}

// Made while the list is up: an attempt has the processor to itself.
void Trainer::look_at_thumbnails() {
  const bool listed = screen_ == TrainerScreen::choose;
  if (listed == thumbnails_wanted_) return;
  thumbnails_wanted_ = listed;
  std::vector<std::string> case_ids;
  if (listed) {
    for (const Choice& choice : choices()) case_ids.push_back(choice.case_id);
    for (const CaseDraft& draft : drafts()) case_ids.push_back(draft.case_id);
  }
  thumbnails_->want(std::move(case_ids));
}

const Choice* Trainer::next() const noexcept {
  return casedb::next_of(choices_);
}

void Trainer::open_editor(const std::string& case_id) {
  const bool known =
      std::any_of(drafts().begin(), drafts().end(), [&](const CaseDraft& one) { return one.case_id == case_id; });
  if (!known) return;
  refusal_.clear();
  editor_.reset();  // before the next: a case is large
  editor_ = std::make_unique<CaseEditor>(library_, case_id, account_.login_name);
  screen_ = TrainerScreen::editor;
}

void Trainer::new_version(const std::string& case_id) {
  if (!may(casedb::Action::make_case_version)) return;
  const auto made = casedb::new_version(library_, case_id, account_.login_name);
  if (!made) {
    refusal_ = made.error().text;
    return;
  }
  open_made_draft(*made);
}

void Trainer::open_made_draft(const std::string& case_id) {
  list_choices();
  open_editor(case_id);
}

void Trainer::duplicate_draft(const std::string& case_id) {
  const auto draft =
      std::find_if(drafts().begin(), drafts().end(), [&](const CaseDraft& one) { return one.case_id == case_id; });
  if (screen_ != TrainerScreen::choose || draft == drafts().end() || !may(casedb::Action::make_case_version))
    return;
  const std::string title = draft->title;
  const auto made = casedb::duplicate_case(library_, case_id, account_.login_name);
  refusal_ = made ? "" : made.error().text;
  imported_ = made ? "“" + title + "” now has a duplicate: a new draft of the same CT." : "";
  list_choices();
}

bool Trainer::may_delete(const CaseDraft& draft) const noexcept {
  return casedb::may(account_.role, casedb::Action::erase_case, draft.state);
}

void Trainer::delete_draft(const std::string& case_id) {
  const auto draft =
      std::find_if(drafts().begin(), drafts().end(), [&](const CaseDraft& one) { return one.case_id == case_id; });
  if (screen_ != TrainerScreen::choose || draft == drafts().end() || !may_delete(*draft)) return;
  const auto erased = casedb::erase_case(library_, case_id, account_.person_id);
  refusal_ = erased ? "" : erased.error().text;
  list_choices();
}

void Trainer::import_case(CaseImport::Wish wish) {
  if (screen_ != TrainerScreen::choose || !may_import() || importing()) return;
  refusal_.clear();
  imported_.clear();
  import_ = std::make_unique<CaseImport>(library_.folder(), account_.person_id, std::move(wish));
}

// Whoever began it may be gone: it is stored all the same.
void Trainer::take_import() {
  if (!import_) return;
  const auto made = import_->made();
  if (!made) return;
  const bool theirs = import_->person_id() == account_.person_id;
  import_.reset();
  if (!theirs) return;
  if (!*made) {
    refusal_ = made->error().text;
    return;
  }
  imported_ = "“" + (*made)->title + "” is imported, as a draft.";
  for (const std::string& other : (*made)->same_ct)
    imported_ += " The library already has this CT, in " + other + ".";
  if (screen_ == TrainerScreen::choose) list_choices();
}

void Trainer::leave_editor() {
  if (screen_ != TrainerScreen::editor) return;
  thumbnails_->forget(editor_->row().case_id);
  editor_.reset();
  list_choices();
  screen_ = TrainerScreen::choose;
}

void Trainer::try_draft() {
  if (screen_ != TrainerScreen::editor) return;
  chosen_ = editor_->row();
  expert_.clear();
  restarting_ = false;
  provisional_ = trying_ = true;
  dependability_.reset();
  plan_.reset();
  prepare(nullptr);
}

const Choice* Trainer::find_choice(const std::string& case_id) const noexcept {
  const auto choice =
      std::find_if(choices().begin(), choices().end(), [&](const Choice& one) { return one.case_id == case_id; });
  return choice == choices().end() ? nullptr : &*choice;
}

bool Trainer::once_more() const noexcept {
  if (trying_) return true;
  const Choice* choice = find_choice(chosen_.case_id);
  return choice != nullptr && choice->open;
}

void Trainer::choose(const std::string& case_id) {
  const Choice* choice = find_choice(case_id);
  if (choice == nullptr || !choice->open) return;
  const auto row = casedb::find_case(library_, case_id);
  if (!row) {
    refusal_ = row.error().text;
    return;
  }
  chosen_ = *row;
  expert_ = casedb::expert_replay_of(library_, case_id, account_.person_id, account_.role).value_or("");
  provisional_ = !casedb::has_standard(library_, chosen_);
  dependability_.reset();
  if (!chosen_.rule.criteria.empty()) dependability_ = kept_dependability_.of(library_);
  restarting_ = trying_ = false;
  plan_.reset();
  prepare(nullptr);
}

void Trainer::prepare(std::shared_ptr<session::Task> task) {
  refusal_.clear();
  if (!task) probe_.clear();
  const Choice* choice = find_choice(chosen_.case_id);
  const int passes = choice != nullptr && !trying_ ? choice->passes : 0;
  help_ = chosen_.difficulty == casedb::Difficulty::easy ? std::max(0, kMostHelp - passes) : 0;
  debrief_.reset();
  resuming_ = false;
  attempt_.reset();  // before the next: a case is large
  interrupted_.reset();
  if (!trying_) interrupted_ = session::find_interrupted(library_, account_.person_id, chosen_.case_id);
  attempt_ = std::make_unique<PersonAttempt>(PersonAttempt::Wanted{
      library_.folder(), this_program(), chosen_.case_id, std::nullopt, account_.person_id, std::move(task), arms_,
      by_, trying_ ? session::LiveAttempt::Keep::not_kept : session::LiveAttempt::Keep::stored});
  screen_ = TrainerScreen::briefing;
}

void Trainer::back() {
  if (resuming_) return;  // it is to run in a moment
  if (screen_ != TrainerScreen::briefing && screen_ != TrainerScreen::debrief) return;
  attempt_.reset();
  debrief_.reset();
  if (trying_) {
    trying_ = false;
    screen_ = TrainerScreen::editor;
    return;
  }
  list_choices();
  screen_ = TrainerScreen::choose;
}

void Trainer::again() {
  if (chosen_.case_id.empty() || screen_ == TrainerScreen::log_in || screen_ == TrainerScreen::choose ||
      screen_ == TrainerScreen::editor)
    return;
  if (screen_ == TrainerScreen::debrief && !once_more()) return;
  if (attempt_ && attempt_->phase() == PersonAttempt::Phase::running) attempt_->end_to_begin_again();
  const bool prepared = attempt_ && attempt_->phase() != PersonAttempt::Phase::preparing;
  restarting_ = true;
  prepare(prepared ? attempt_->task() : nullptr);
}

std::vector<std::string> Trainer::probes() const {
  if (screen_ != TrainerScreen::briefing || !attempt_ || attempt_->phase() != PersonAttempt::Phase::ready)
    return {};
  return session::probes_to_choose(*attempt_->task());
}

void Trainer::choose_probe(const std::string& name) {
  const std::vector<std::string> offered = probes();
  if (std::find(offered.begin(), offered.end(), name) == offered.end()) return;
  probe_ = name;
  attempt_->choose_probe(name);
}

bool Trainer::begin(bool left_handed) {
  if (screen_ != TrainerScreen::briefing || !attempt_ || attempt_->phase() != PersonAttempt::Phase::ready)
    return false;
  if (probe_.empty() && !probes().empty()) return false;
  restarting_ = false;
  if (interrupted_ && !trying_) session::close_interrupted_attempt(library_, *interrupted_);
  interrupted_.reset();
  tell_conditions();
  attempt_->begin(left_handed);
  attempt_->say(cases::EventKind::calipers_recorded);
  if (chosen_.subject == cases::Subject::patient) attempt_->say(cases::EventKind::sign_in);
  screen_ = TrainerScreen::attempt;
  return true;
}

bool Trainer::resume(bool left_handed) {
  if (screen_ != TrainerScreen::briefing || !interrupted_ || trying_ || !attempt_ ||
      attempt_->phase() != PersonAttempt::Phase::ready)
    return false;
  restarting_ = false;
  resuming_ = true;
  tell_conditions();
  choose_probe(interrupted_->picture.probe);  // where one is chosen, it goes on with that
  attempt_->resume(interrupted_->attempt_id, left_handed);
  interrupted_.reset();
  return true;
}

// What helps, and what was seen before.
void Trainer::tell_conditions() {
  const casedb::ReplaysWatched watched =
      casedb::count_replays_watched(library_, account_.person_id, chosen_.case_id);
  attempt_->know([&](casedb::Conditions& conditions) {
    conditions.station = station_;
    conditions.help_level = help_;
    conditions.expert_replays = watched.others;
    conditions.own_replays = watched.own;
    casedb::put_planned_path(plan_, conditions);
  });
}

// Graded as a stored one would be.
Debrief Trainer::debrief_of_try() {
  const session::StoredAttempt& made = attempt_->stored();
  const std::shared_ptr<const session::Task> task = attempt_->task();
  casedb::AttemptRow row;
  static_cast<casedb::AttemptHead&>(row) =
      session::head_of(*task, this_program(), std::string(casedb::kPersonOperator), 0, account_.person_id);
  row.case_title = task->row.title;
  row.lesion = task->lesion.lesion;
  row.end = made.end;
  row.metrics = made.metrics;
  row.conditions = made.conditions;
  return {row, casedb::Grader(library_).look_at(row), made.steps, made.faults, made.path};
}

void Trainer::look() {
  take_import();
  look_at_thumbnails();
  look_into_rooms();
  look_at_watched();
  if (answering_) answering_->look(session::clock_s());
  if (editor_ && screen_ == TrainerScreen::editor) editor_->look();
  if (!attempt_) return;
  const PersonAttempt::Phase phase = attempt_->phase();
  if (resuming_ && phase != PersonAttempt::Phase::preparing) {
    resuming_ = false;
    if (phase != PersonAttempt::Phase::refused) screen_ = TrainerScreen::attempt;
  }
  if (phase == PersonAttempt::Phase::refused) {
    refusal_ = attempt_->error().text;
    attempt_.reset();
    if (trying_) {
      trying_ = false;
      screen_ = TrainerScreen::editor;
      return;
    }
    list_choices();
    (screen_ == TrainerScreen::devices ? devices_from_ : screen_) = TrainerScreen::choose;
  } else if (phase == PersonAttempt::Phase::stored && !debrief_ && screen_ == TrainerScreen::attempt) {
    if (trying_) {
      debrief_ = debrief_of_try();
      screen_ = TrainerScreen::debrief;
      return;
    }
    const std::string id = attempt_->stored().attempt_id;
    const auto row = casedb::find_attempt(library_, id);
    if (!row) {
      refusal_ = row.error().text;
      return;
    }
    debrief_ = Debrief{*row,
                       casedb::Grader(library_).look_at(*row),
                       casedb::list_steps(library_, id),
                       attempt_->stored().faults,
                       attempt_->stored().path,
                       own_attempts()};
    list_choices();  // what it opened
    screen_ = TrainerScreen::debrief;
  }
}

}  // namespace seldinger::app
