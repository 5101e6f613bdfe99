#include "web/site/answers.h"

#include <algorithm>

namespace seldinger::web {

std::size_t Answers::Kept::bytes() const noexcept {
  std::size_t sum = sizeof(Kept) + sizeof(Made) + key.size() + made->text.size();
  for (const auto& picture : made->pictures) sum += sizeof picture + picture.size();
  return sum;
}

std::shared_ptr<const Answers::Made> Answers::find(const std::string& key) {
  const std::lock_guard lock(mutex_);
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) { return one.key == key; });
  if (found == kept_.end()) return nullptr;
  kept_.splice(kept_.begin(), kept_, found);
  return kept_.front().made;
}

bool Answers::holds(const std::string& key) {
  return find(key) != nullptr;
}

base::Result<std::shared_ptr<const Answers::Made>> Answers::get(const std::string& key, const Make& make) {
  if (auto kept = find(key)) return kept;
  const std::lock_guard one_at_a_time(making_);
  if (auto kept = find(key)) return kept;  // while we waited
  auto made = make();
  if (!made) return made.error();
  auto answer = std::make_shared<const Made>(std::move(*made));
  if (!answer->keep) return answer;
  const std::lock_guard lock(mutex_);
  kept_.push_front({key, answer});
  bytes_ += kept_.front().bytes();
  for (; bytes_ > most_bytes_; kept_.pop_back()) bytes_ -= kept_.back().bytes();
  return answer;
}

}  // namespace seldinger::web
