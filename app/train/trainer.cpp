#include "app/train/trainer.h"

#include <algorithm>

#include "casedb/expert_replay.h"

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

}  // namespace

Trainer::Trainer(casedb::Library library, std::optional<Arms> arms)
    : library_(std::move(library)), arms_(std::move(arms)) {
  close_interrupted_attempts(library_);
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
}

void Trainer::log_out() {
  watched_.reset();
  attempt_.reset();
  debrief_.reset();
  choices_.clear();
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
  for (const casedb::CaseRow& row : rows) {
    const bool listed = std::any_of(choices_.begin(), choices_.end(),
                                    [&](const Choice& choice) { return choice.case_id == row.case_id; });
    // A mentor tries what is not published yet; everybody else practises what is.
    const bool tries = account_.role == casedb::Role::mentor && row.state == "draft";
    if (listed || (row.state != "published" && !tries)) continue;
    if (casedb::list_lesions(library_, row.case_id).empty()) continue;
    Choice& choice = add(row);
    choice.passes = static_cast<int>(passes_among(grader, attempts, row.case_id, choice.attempts));
  }
}

const Choice* Trainer::next() const noexcept {
  const auto due = std::find_if(choices_.begin(), choices_.end(),
                                [](const Choice& choice) { return choice.due && choice.open; });
  return due == choices_.end() ? nullptr : &*due;
}

const Choice* Trainer::find_choice(const std::string& case_id) const noexcept {
  const auto choice =
      std::find_if(choices_.begin(), choices_.end(), [&](const Choice& one) { return one.case_id == case_id; });
  return choice == choices_.end() ? nullptr : &*choice;
}

bool Trainer::once_more() const noexcept {
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
  restarting_ = false;
  prepare(nullptr);
}

void Trainer::prepare(std::shared_ptr<const Task> task) {
  refusal_.clear();
  const Choice* choice = find_choice(chosen_.case_id);
  const bool easy = choice != nullptr && choice->difficulty == casedb::Difficulty::easy;
  help_ = easy ? std::max(0, kMostHelp - choice->passes) : 0;
  debrief_.reset();
  attempt_.reset();  // before the next: a case is large
  attempt_ = std::make_unique<PersonAttempt>(PersonAttempt::Wanted{
      library_.folder(), chosen_.case_id, std::nullopt, account_.person_id, std::move(task), arms_, by_});
  screen_ = TrainerScreen::briefing;
}

void Trainer::back() {
  if (screen_ != TrainerScreen::briefing && screen_ != TrainerScreen::debrief) return;
  attempt_.reset();
  debrief_.reset();
  list_choices();
  screen_ = TrainerScreen::choose;
}

void Trainer::again() {
  if (chosen_.case_id.empty() || screen_ == TrainerScreen::log_in || screen_ == TrainerScreen::choose) return;
  if (screen_ == TrainerScreen::debrief && !once_more()) return;
  const bool prepared = attempt_ && attempt_->phase() != PersonAttempt::Phase::preparing;
  restarting_ = true;
  prepare(prepared ? attempt_->task() : nullptr);
}

bool Trainer::begin(bool left_handed) {
  if (screen_ != TrainerScreen::briefing || !attempt_ || attempt_->phase() != PersonAttempt::Phase::ready)
    return false;
  restarting_ = false;
  attempt_->begin(left_handed);
  if (chosen_.subject == cases::Subject::patient) attempt_->say(cases::EventKind::sign_in);
  screen_ = TrainerScreen::attempt;
  return true;
}

void Trainer::watch(const std::string& attempt_id) {
  if (screen_ != TrainerScreen::briefing && screen_ != TrainerScreen::debrief) return;
  refusal_.clear();
  watched_from_ = screen_;
  watched_ = std::make_unique<WatchedAttempt>(library_.folder(), attempt_id, by_);
  screen_ = TrainerScreen::watch;
}

void Trainer::stop_watching() {
  if (screen_ == TrainerScreen::watch) screen_ = watched_from_;
}

void Trainer::look() {
  if (watched_ && screen_ != TrainerScreen::watch) watched_.reset();
  if (watched_ && watched_->phase() == WatchedAttempt::Phase::refused) {
    refusal_ = watched_->error().text;
    stop_watching();
  }
  if (!attempt_) return;
  const PersonAttempt::Phase phase = attempt_->phase();
  if (phase == PersonAttempt::Phase::refused) {
    refusal_ = attempt_->error().text;
    attempt_.reset();
    list_choices();
    screen_ = TrainerScreen::choose;
  } else if (phase == PersonAttempt::Phase::stored && !debrief_ && screen_ == TrainerScreen::attempt) {
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
