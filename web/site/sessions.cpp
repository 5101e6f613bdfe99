#include "web/site/sessions.h"

#include <algorithm>
#include <iterator>

#include "casedb/database/credentials.h"

namespace seldinger::web {
namespace {

bool is_dead(const Session& session, std::int64_t now_us) {
  return now_us - session.last_seen_us >= kSessionIdle_us || now_us - session.begun_us >= kSessionLife_us;
}

// Who has a page has this, and cannot tell the id from it.
std::string form_token_of(const Surroundings& surroundings, const std::string& id) {
  casedb::Secret both;
  casedb::append_secret(both.text, "form token of ");
  casedb::append_secret(both.text, id);
  return surroundings.sha256_hex(both.text);
}

}  // namespace

Sessions::Sessions(const Surroundings& surroundings, const std::vector<casedb::WebSession>& kept)
    : surroundings_(surroundings) {
  if (kept.empty()) return;
  const std::int64_t now_us = surroundings_.now_us(), utc_from_monotonic = utc_from_monotonic_us();
  for (const casedb::WebSession& one : kept) {
    const std::int64_t seen_us = one.seen_us - utc_from_monotonic;
    const Session session{one.person_id, {}, one.begun_us - utc_from_monotonic, seen_us, one.password_mark};
    by_hash_.emplace(one.id_hash, Held{session, seen_us});
  }
  drop_dead(now_us);
}

std::int64_t Sessions::utc_from_monotonic_us() const {
  return surroundings_.utc_us() - surroundings_.now_us();
}

Sessions::ByHash::iterator Sessions::drop(ByHash::iterator at) {
  ended_.insert(at->first);
  return by_hash_.erase(at);
}

void Sessions::drop_dead(std::int64_t now_us) {
  for (auto at = by_hash_.begin(); at != by_hash_.end();)
    at = is_dead(at->second.session, now_us) ? drop(at) : std::next(at);
}

void Sessions::make_room(const std::string& person_id) {
  const auto drop_oldest = [&](auto&& counts, std::size_t most) {
    std::size_t count = 0;
    auto oldest = by_hash_.end();
    for (auto it = by_hash_.begin(); it != by_hash_.end(); ++it) {
      if (!counts(it->second.session)) continue;
      ++count;
      if (oldest == by_hash_.end() || it->second.session.begun_us < oldest->second.session.begun_us) oldest = it;
    }
    if (count >= most) drop(oldest);
  };
  drop_oldest([&](const Session& session) { return session.person_id == person_id; }, kMaxSessionsOfOne);
  drop_oldest([](const Session&) { return true; }, kMaxSessions);
}

std::string Sessions::begin(const std::string& person_id, const std::string& password_mark) {
  const std::int64_t now_us = surroundings_.now_us();
  std::string id = surroundings_.random_id();
  const std::lock_guard lock(mutex_);
  drop_dead(now_us);
  make_room(person_id);
  by_hash_[surroundings_.sha256_hex(id)] = {{person_id, {}, now_us, now_us, password_mark}};
  return id;
}

std::optional<Session> Sessions::find(const std::string& id) {
  if (id.empty()) return std::nullopt;
  const std::string hash = surroundings_.sha256_hex(id);
  const std::int64_t now_us = surroundings_.now_us();
  std::optional<Session> session;
  {
    const std::lock_guard lock(mutex_);
    const auto found = by_hash_.find(hash);
    if (found == by_hash_.end()) return std::nullopt;
    if (is_dead(found->second.session, now_us)) {
      drop(found);
      return std::nullopt;
    }
    found->second.session.last_seen_us = now_us;
    session = found->second.session;
  }
  session->form_token = form_token_of(surroundings_, id);
  return session;
}

void Sessions::end(const std::string& id) {
  if (id.empty()) return;
  const std::string hash = surroundings_.sha256_hex(id);
  const std::lock_guard lock(mutex_);
  if (const auto found = by_hash_.find(hash); found != by_hash_.end()) drop(found);
}

std::size_t Sessions::count() {
  const std::lock_guard lock(mutex_);
  drop_dead(surroundings_.now_us());
  return by_hash_.size();
}

void Sessions::keep(const Keep& keep) {
  const std::lock_guard in_order(keeping_);
  const std::int64_t utc_from_monotonic = utc_from_monotonic_us();
  casedb::WebSessionChanges changes;
  {
    const std::lock_guard lock(mutex_);
    drop_dead(surroundings_.now_us());
    for (const auto& [hash, held] : by_hash_) {
      const Session& session = held.session;
      if (held.noted_us && session.last_seen_us - *held.noted_us < kSessionNoted_us) continue;
      changes.kept.push_back({hash, session.person_id, session.password_mark, session.begun_us + utc_from_monotonic,
                              session.last_seen_us + utc_from_monotonic,
                              session.begun_us + utc_from_monotonic + kSessionLife_us});
    }
    changes.ended.assign(ended_.begin(), ended_.end());
  }
  if (changes.empty()) return;
  keep(changes);
  const std::lock_guard lock(mutex_);
  for (const casedb::WebSession& one : changes.kept)
    if (const auto found = by_hash_.find(one.id_hash); found != by_hash_.end())
      found->second.noted_us = one.seen_us - utc_from_monotonic;
  for (const std::string& hash : changes.ended) ended_.erase(hash);
}

}  // namespace seldinger::web
