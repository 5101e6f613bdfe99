// Questionnaires at the workstation: which are due, and the one that is being answered.
#include <algorithm>

#include "app/window/trainer/trainer.h"
#include "casedb/questionnaires/desk_rounds.h"

namespace seldinger::app {

void Trainer::answer(const std::string& round_id) {
  if (screen_ != TrainerScreen::choose && screen_ != TrainerScreen::debrief) return;
  refusal_.clear();
  const auto secret = casedb::answer_at_desk(library_, round_id, account_.person_id);
  auto opened = secret ? Answering::open(library_, *secret) : base::Result<Answering>(secret.error());
  if (!opened) {
    refusal_ = opened.error().text;
    due_ = casedb::due_at_desk(library_, account_.person_id);
    return;
  }
  answering_.emplace(std::move(*opened));
  answered_from_ = screen_;
  screen_ = TrainerScreen::answer;
}

void Trainer::send_answers() {
  if (screen_ != TrainerScreen::answer || !answering_) return;
  const auto sent = answering_->send();
  refusal_ = sent ? "" : sent.error().text;
  if (sent) leave_answers();
}

void Trainer::leave_answers() {
  if (screen_ != TrainerScreen::answer) return;
  static_cast<void>(answering_->keep());  // what does not fit its item was shown
  answering_.reset();
  due_ = casedb::due_at_desk(library_, account_.person_id);
  screen_ = answered_from_;
}

}  // namespace seldinger::app
