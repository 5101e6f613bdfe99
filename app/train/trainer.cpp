#include "app/train/trainer.h"

#include <algorithm>

#include "app/this_program.h"
#include "casedb/changeable_case.h"
#include "casedb/expert_replay.h"
#include "sim/base/failure.h"

namespace seldinger::app {
namespace {

constexpr int kMostHelp = 2;

std::size_t passes_among(casedb::Grader& grader, const std::vector<casedb::AttemptRow>& attempts,
                         const std::string& case_id, int& made) {
  std::size_t passes = 0;
  for (const casedb::AttemptRow& attempt : attempts) {
    if (attempt.case_id != case_id || attempt.synthetic()) continue;
    ++made;
    if (grader.grade(attempt).verdict == assessment::Verdict::passed) ++passes;
  }
  return passes;
}

bool has_attempts(casedb::Library& library, const casedb::CaseRow& row) {
  const auto changeable = casedb::changeable_case(library, row.case_id);
  return !changeable && changeable.error().code == "has_attempts";
}

}  // namespace

Trainer::Trainer(casedb::Library library, std::optional<Arms> arms)
    : library_(std::move(library)), arms_(std::move(arms)) {
  // A person is asked first, when they come to the case.
  close_interrupted_attempts(library_, [this](const casedb::OpenAttempt& attempt) {
    return !attempt.synthetic() && attempt.person_id && is_interrupted(library_, attempt);
  });
}

void Trainer::log_in(const std::string& name, const std::string& password) {
  const auto account = casedb::log_in(library_, name, password);
  if (!account) {
    refusal_ = "Name or password is not right.";
    return;
  }
  refusal_.clear();
  account_ = *account;
  list_choices();
  screen_ = TrainerScreen::choose;
  if (!first_case_.empty()) open_first();
}

// A case to practise is chosen, a mentor's draft is opened on the bench; else the list stays, with the reason.
void Trainer::open_first() {
  if (const Choice* choice = find_choice(first_case_)) {
    if (choice->open) return choose(first_case_);
    refusal_ =
        "“" + choice->title + "” is not open for " + account_.login_name + ": " +
        (choice->attempts_left.value_or(1) > 0 ? "what comes before it is not passed yet." : "no attempt is left.");
    return;
  }
  open_bench(first_case_);
  if (screen_ != TrainerScreen::bench)
    refusal_ = "The case of this workstation is not one for " + account_.login_name + " to practise.";
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
  if (arms_) device_bench_ = std::make_unique<DeviceBench>(*arms_);
}

void Trainer::leave_devices() {
  if (screen_ != TrainerScreen::devices) return;
  device_bench_.reset();  // the arms are an attempt's again
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
  if (!device_bench_) return false;
  const auto ids = device_bench_->status().ids;
  return change_station([&](Station& station) {
    station[kSideNames.at(side)].calibration = calibration;
    // Which arm it was that was calibrated; and once one is named, the other must be.
    for (std::size_t one = 0; one < 2; ++one)
      if (!ids[one].arm.empty()) station[kSideNames[one]].ids = ids[one];
  });
}

void Trainer::exchange_arms() {
  if (!device_bench_) return;
  const auto ids = device_bench_->status().ids;
  const bool kept = change_station([&](Station& station) {
    for (std::size_t side = 0; side < 2; ++side) station[kSideNames[side]].ids = ids[side];
    std::swap(station["left"], station["right"]);
  });
  if (!kept) return;
  device_bench_.reset();
  device_bench_ = std::make_unique<DeviceBench>(*arms_);
}

void Trainer::log_out() {
  device_bench_.reset();
  watched_.reset();
  attempt_.reset();
  debrief_.reset();
  bench_.reset();
  interrupted_.reset();
  trying_ = resuming_ = false;
  choices_.clear();
  drafts_.clear();
  account_ = {};
  refusal_.clear();
  screen_ = TrainerScreen::log_in;
}

void Trainer::list_choices() {
  choices_.clear();
  casedb::Grader grader(library_);
  const auto attempts = casedb::list_attempts_of(library_, account_.person_id);
  const auto rows = casedb::list_case_heads(library_);
  const auto row_of = [&](const std::string& case_id) {
    return std::find_if(rows.begin(), rows.end(), [&](const auto& row) { return row.case_id == case_id; });
  };
  const auto add = [&](const casedb::CaseRow& row) -> Choice& {
    Choice choice;
    choice.case_id = row.case_id;
    choice.title = row.title;
    choice.modality = row.modality;
    choice.difficulty = row.difficulty;
    return choices_.emplace_back(std::move(choice));
  };
  for (const casedb::Curriculum& curriculum : casedb::list_curricula(library_)) {
    if (curriculum.state != "published") continue;
    for (const casedb::ItemState& item : casedb::states_of(library_, curriculum, account_.person_id)) {
      const auto row = row_of(item.case_id);
      if (row == rows.end()) continue;
      Choice& choice = add(*row);
      choice.curriculum = curriculum.title;
      choice.attempts = item.attempts;
      choice.passes = item.passes;
      choice.attempts_left = item.progress.attempts_left;
      choice.open = item.progress.open && choice.attempts_left.value_or(1) > 0;
      choice.due = item.progress.due;
      choice.reached = assessment::name_of(item.progress.reached);
      std::replace(choice.reached.begin(), choice.reached.end(), '_', ' ');
    }
  }
  list_drafts(rows);
  for (const casedb::CaseRow& row : rows) {
    const bool listed = std::any_of(choices_.begin(), choices_.end(),
                                    [&](const Choice& choice) { return choice.case_id == row.case_id; });
    // A mentor may also practise a draft that attempts have frozen; any other is for the bench, where trying it
    // freezes nothing.
    const bool frozen =
        account_.role == casedb::Role::mentor && row.state == "draft" && has_attempts(library_, row);
    if (listed || (row.state != "published" && !frozen)) continue;
    if (casedb::list_lesions(library_, row.case_id).empty()) continue;
    Choice& choice = add(row);
    choice.passes = static_cast<int>(passes_among(grader, attempts, row.case_id, choice.attempts));
  }
  library_.shrink();  // a workstation is on for days
}

const Choice* Trainer::next() const noexcept {
  const auto due = std::find_if(choices_.begin(), choices_.end(),
                                [](const Choice& choice) { return choice.due && choice.open; });
  return due == choices_.end() ? nullptr : &*due;
}

void Trainer::list_drafts(const std::vector<casedb::CaseRow>& rows) {
  drafts_.clear();
  if (account_.role != casedb::Role::mentor) return;
  for (const casedb::CaseRow& row : rows)
    if (row.state == "draft" || row.state == "review")
      drafts_.push_back({row.case_id, row.title, row.state, row.modality, row.version});
}

void Trainer::open_bench(const std::string& case_id) {
  const bool known =
      std::any_of(drafts_.begin(), drafts_.end(), [&](const Draft& one) { return one.case_id == case_id; });
  if (!known) return;
  refusal_.clear();
  bench_.reset();  // before the next: a case is large
  bench_ = std::make_unique<CaseBench>(library_, case_id, account_.login_name);
  screen_ = TrainerScreen::bench;
}

void Trainer::new_version(const std::string& case_id) {
  if (account_.role != casedb::Role::mentor) return;
  const auto made = casedb::new_version(library_, case_id, account_.login_name);
  if (!made) {
    refusal_ = made.error().text;
    return;
  }
  list_choices();
  open_bench(*made);
}

void Trainer::leave_bench() {
  if (screen_ != TrainerScreen::bench) return;
  bench_.reset();
  list_choices();
  screen_ = TrainerScreen::choose;
}

void Trainer::try_draft() {
  if (screen_ != TrainerScreen::bench) return;
  chosen_ = bench_->row();
  expert_.clear();
  restarting_ = false;
  trying_ = true;
  prepare(nullptr);
}

const Choice* Trainer::find_choice(const std::string& case_id) const noexcept {
  const auto choice =
      std::find_if(choices_.begin(), choices_.end(), [&](const Choice& one) { return one.case_id == case_id; });
  return choice == choices_.end() ? nullptr : &*choice;
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
  expert_ = casedb::expert_replay_of(library_, case_id).value_or("");
  restarting_ = trying_ = false;
  prepare(nullptr);
}

void Trainer::prepare(std::shared_ptr<const Task> task) {
  refusal_.clear();
  const Choice* choice = find_choice(chosen_.case_id);
  const int passes = choice != nullptr && !trying_ ? choice->passes : 0;
  help_ = chosen_.difficulty == casedb::Difficulty::easy ? std::max(0, kMostHelp - passes) : 0;
  debrief_.reset();
  resuming_ = false;
  attempt_.reset();  // before the next: a case is large
  interrupted_.reset();
  if (!trying_) interrupted_ = find_interrupted(library_, account_.person_id, chosen_.case_id);
  attempt_ = std::make_unique<PersonAttempt>(PersonAttempt::Wanted{
      library_.folder(), this_program(), chosen_.case_id, std::nullopt, account_.person_id, std::move(task), arms_,
      by_, trying_ ? LiveAttempt::Keep::not_kept : LiveAttempt::Keep::stored});
  screen_ = TrainerScreen::briefing;
}

void Trainer::back() {
  if (resuming_) return;  // it is to run in a moment
  if (screen_ != TrainerScreen::briefing && screen_ != TrainerScreen::debrief) return;
  attempt_.reset();
  debrief_.reset();
  if (trying_) {
    trying_ = false;
    screen_ = TrainerScreen::bench;
    return;
  }
  list_choices();
  screen_ = TrainerScreen::choose;
}

void Trainer::again() {
  if (chosen_.case_id.empty() || screen_ == TrainerScreen::log_in || screen_ == TrainerScreen::choose ||
      screen_ == TrainerScreen::bench)
    return;
  if (screen_ == TrainerScreen::debrief && !once_more()) return;
  const bool prepared = attempt_ && attempt_->phase() != PersonAttempt::Phase::preparing;
  restarting_ = true;
  prepare(prepared ? attempt_->task() : nullptr);
}

bool Trainer::begin(bool left_handed) {
  if (screen_ != TrainerScreen::briefing || !attempt_ || attempt_->phase() != PersonAttempt::Phase::ready)
    return false;
  restarting_ = false;
  if (interrupted_ && !trying_) close_interrupted_attempt(library_, *interrupted_);
  interrupted_.reset();
  attempt_->begin(left_handed);
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
  attempt_->resume(interrupted_->attempt_id, left_handed);
  interrupted_.reset();
  return true;
}

void Trainer::watch(const std::string& attempt_id) {
  if (resuming_) return;
  if (screen_ != TrainerScreen::briefing && screen_ != TrainerScreen::debrief) return;
  refusal_.clear();
  watched_from_ = screen_;
  watched_ = std::make_unique<WatchedAttempt>(library_.folder(), attempt_id, by_);
  screen_ = TrainerScreen::watch;
}

void Trainer::stop_watching() {
  if (screen_ == TrainerScreen::watch) screen_ = watched_from_;
}

// Graded as a stored one would be.
Debrief Trainer::debrief_of_try() {
  const StoredAttempt& made = attempt_->stored();
  const std::shared_ptr<const Task> task = attempt_->task();
  casedb::AttemptRow row;
  static_cast<casedb::AttemptHead&>(row) =
      head_of(*task, this_program(), std::string(casedb::kPersonOperator), 0, account_.person_id);
  row.case_title = task->row.title;
  row.lesion = task->lesion.lesion;
  row.end = made.end;
  row.metrics = made.metrics;
  return {row, casedb::Grader(library_).look_at(row), made.steps};
}

void Trainer::look() {
  if (watched_ && screen_ != TrainerScreen::watch) watched_.reset();
  if (watched_ && watched_->phase() == WatchedAttempt::Phase::refused) {
    refusal_ = watched_->error().text;
    stop_watching();
  }
  if (bench_ && screen_ == TrainerScreen::bench) bench_->look();
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
      screen_ = TrainerScreen::bench;
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
    debrief_ = Debrief{*row, casedb::Grader(library_).look_at(*row), casedb::list_steps(library_, id)};
    list_choices();  // what it opened
    screen_ = TrainerScreen::debrief;
  }
}

}  // namespace seldinger::app
