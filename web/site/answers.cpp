#include "web/site/answers.h"

#include <algorithm>

namespace seldinger::web {

const std::string* Answers::find(const std::string& key) {
  const auto found = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& one) { return one.key == key; });
  if (found == kept_.end()) return nullptr;
  kept_.splice(kept_.begin(), kept_, found);
  return &kept_.front().text;
}

base::Result<std::string> Answers::get(const std::string& key, const Make& make) {
  const auto kept = [&]() -> std::optional<std::string> {
    const std::lock_guard lock(mutex_);
    const std::string* text = find(key);
    return text == nullptr ? std::nullopt : std::optional(*text);
  };
  if (auto text = kept()) return std::move(*text);
  const std::lock_guard one_at_a_time(making_);
  if (auto text = kept()) return std::move(*text);  // while we waited
  auto made = make();
  if (!made) return made.error();
  if (!made->keep) return std::move(made->text);
  const std::lock_guard lock(mutex_);
  kept_.push_front({key, made->text});
  bytes_ += kept_.front().bytes();
  for (; bytes_ > most_bytes_; kept_.pop_back()) bytes_ -= kept_.back().bytes();
  return std::move(made->text);
}

}  // namespace seldinger::web
