#include "app/window/trainer/answering.h"

#include <algorithm>
#include <utility>

namespace seldinger::app {
namespace {

namespace questionnaire = assessment::questionnaire;

constexpr double kKeepAfterS = 0.5;

}  // namespace

// The items that sections_ points to are the form's, which moves with its vector and stays where it is.
Answering::Answering(casedb::Library& library, std::string secret, casedb::Draft draft)
    : library_(&library),
      secret_(std::move(secret)),
      draft_(std::move(draft)),
      sections_(questionnaire::sections_of(draft_.form.form)) {
  for (const questionnaire::Item& item : form().items)
    if (const auto kept = draft_.set.answers.find(item.id); kept != draft_.set.answers.end())
      typed_[item.id] = questionnaire::text_of(item, kept->second);
}

base::Result<Answering> Answering::open(casedb::Library& library, const std::string& secret) {
  auto draft = casedb::find_draft(library, secret);
  if (!draft) return draft.error();
  return Answering(library, secret, std::move(*draft));
}

const std::string& Answering::typed(const std::string& item_id) const noexcept {
  static const std::string kNone;
  const auto found = typed_.find(item_id);
  return found == typed_.end() ? kNone : found->second;
}

bool Answering::is_missing(const questionnaire::Item& item) const {
  const auto answer = questionnaire::answer_from_text(form(), item, typed(item.id));
  return answer && answer->state == questionnaire::AnswerState::missing;
}

void Answering::type(const std::string& item_id, const std::string& text, double now_s) {
  if (form().find_item(item_id) == nullptr || typed(item_id) == text) return;
  typed_[item_id] = waiting_[item_id] = text;
  typed_at_s_ = now_s;
}

std::string Answering::problem(const std::string& item_id) const {
  const questionnaire::Item* item = form().find_item(item_id);
  if (!told_ || item == nullptr) return {};
  const auto answer = questionnaire::answer_from_text(form(), *item, typed(item_id));
  return answer ? std::string() : "Please correct this: it " + answer.error().text + ".";
}

std::vector<std::pair<std::size_t, const questionnaire::Item*>> Answering::open_items() const {
  std::vector<std::pair<std::size_t, const questionnaire::Item*>> open;
  for (std::size_t section = 0; section < sections_.size(); ++section)
    for (const questionnaire::Item* item : sections_[section])
      if (item->kind != questionnaire::ItemKind::comment && is_missing(*item)) open.emplace_back(section, item);
  return open;
}

void Answering::next() {
  if (last_look()) return;
  told_ = true;
  const auto& items = sections_[section_];
  if (std::any_of(items.begin(), items.end(), [&](const auto* item) { return !problem(item->id).empty(); })) return;
  go_to(section_ + 1);
}

void Answering::back() {
  if (section_ > 0) go_to(section_ - 1);
}

void Answering::go_to(std::size_t section) {
  told_ = false;
  section_ = std::min(section, sections_.size());
}

void Answering::look(double now_s) {
  if (typed_at_s_ && now_s - *typed_at_s_ >= kKeepAfterS) static_cast<void>(keep());
}

base::Result<void> Answering::keep() {
  std::map<std::string, std::string> fitting;
  for (const auto& [item_id, text] : waiting_)
    if (questionnaire::answer_from_text(form(), *form().find_item(item_id), text)) fitting.emplace(item_id, text);
  typed_at_s_.reset();
  if (fitting.empty()) return {};
  const auto kept = casedb::save_draft(*library_, secret_, fitting);
  lost_ = !kept;
  if (!kept) return kept.error();
  for (const auto& [item_id, text] : fitting) waiting_.erase(item_id);
  return {};
}

base::Result<void> Answering::send() {
  if (!last_look()) return {};
  if (const auto kept = keep(); !kept) return kept.error();
  return casedb::submit_draft(*library_, secret_);
}

}  // namespace seldinger::app
