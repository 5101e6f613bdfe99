#include "web/site/sessions.h"

#include <algorithm>
#include <iterator>

namespace seldinger::web {
namespace {
bool is_dead(const Session& session, std::int64_t now_us) {
  return now_us - session.last_seen_us >= kSessionIdle_us || now_us - session.begun_us >= kSessionLife_us;
}
}  // namespace

void Sessions::drop_dead(std::int64_t now_us) {
  std::erase_if(by_hash_, [&](const auto& entry) { return is_dead(entry.second, now_us); });
}

void Sessions::make_room(const std::string& person_id) {
  const auto drop_oldest = [&](auto&& counts, std::size_t most) {
    std::size_t count = 0;
    auto oldest = by_hash_.end();
    for (auto it = by_hash_.begin(); it != by_hash_.end(); ++it) {
      if (!counts(it->second)) continue;
      ++count;
      if (oldest == by_hash_.end() || it->second.begun_us < oldest->second.begun_us) oldest = it;
    }
    if (count >= most) by_hash_.erase(oldest);
  };
  drop_oldest([&](const Session& session) { return session.person_id == person_id; }, kMaxSessionsOfOne);
  drop_oldest([](const Session&) { return true; }, kMaxSessions);
}

std::string Sessions::begin(const std::string& person_id, const std::string& password_mark) {
  const std::int64_t now_us = surroundings_.now_us();
  std::string id = surroundings_.random_id();
  const Session session{person_id, surroundings_.random_id(), now_us, now_us, password_mark};
  const std::lock_guard lock(mutex_);
  drop_dead(now_us);
  make_room(person_id);
  by_hash_[surroundings_.sha256_hex(id)] = session;
  return id;
}

std::optional<Session> Sessions::find(const std::string& id) {
  if (id.empty()) return std::nullopt;
  const std::string hash = surroundings_.sha256_hex(id);
  const std::int64_t now_us = surroundings_.now_us();
  const std::lock_guard lock(mutex_);
  const auto found = by_hash_.find(hash);
  if (found == by_hash_.end()) return std::nullopt;
  if (is_dead(found->second, now_us)) {
    by_hash_.erase(found);
    return std::nullopt;
  }
  found->second.last_seen_us = now_us;
  return found->second;
}

void Sessions::end(const std::string& id) {
  if (id.empty()) return;
  const std::string hash = surroundings_.sha256_hex(id);
  const std::lock_guard lock(mutex_);
  by_hash_.erase(hash);
}

std::size_t Sessions::count() {
  const std::lock_guard lock(mutex_);
  drop_dead(surroundings_.now_us());
  return by_hash_.size();
}

}  // namespace seldinger::web
