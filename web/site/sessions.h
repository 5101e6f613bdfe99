// Who is logged in. Kept in memory under the hash of the session's id, so that a copy of the memory opens no
// session.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>

#include "web/site/surroundings.h"

namespace seldinger::web {

inline constexpr std::int64_t kSessionIdle_us = 30LL * 60 * 1000000;
inline constexpr std::int64_t kSessionLife_us = 12LL * 3600 * 1000000;
inline constexpr std::size_t kMaxSessions = 2000;
inline constexpr std::size_t kMaxSessionsOfOne = 8;

struct Session {
  std::string person_id;
  std::string form_token;
  std::int64_t begun_us = 0;
  std::int64_t last_seen_us = 0;
  std::string password_mark{};  // of the password that began it
};

class Sessions {
 public:
  explicit Sessions(const Surroundings& surroundings) : surroundings_(surroundings) {}

  // Answers the id that goes into the cookie. The oldest session makes room when there are too many.
  std::string begin(const std::string& person_id, const std::string& password_mark = {});
  // The living session of this id, which is thereby used; none when unknown, idle too long or too old.
  std::optional<Session> find(const std::string& id);
  void end(const std::string& id);
  std::size_t count();

 private:
  void drop_dead(std::int64_t now_us);
  void make_room(const std::string& person_id);

  const Surroundings& surroundings_;
  std::mutex mutex_;
  std::map<std::string, Session> by_hash_;
};

}  // namespace seldinger::web
