// Who is logged in. Kept under the hash of the session's id, so that neither a copy of the memory nor one of the
// library opens a session: in memory, and in the library for the next start.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "casedb/people/web_sessions.h"
#include "web/site/surroundings.h"

namespace seldinger::web {

inline constexpr std::int64_t kSessionIdle_us = 30LL * 60 * 1000000;
inline constexpr std::int64_t kSessionLife_us = 12LL * 3600 * 1000000;
inline constexpr std::int64_t kSessionNoted_us = 60LL * 1000000;  // how exactly the library knows the last use
inline constexpr std::size_t kMaxSessions = 2000;
inline constexpr std::size_t kMaxSessionsOfOne = 8;

struct Session {
  std::string person_id;
  std::string form_token;     // follows from the id, so find() alone can tell it
  std::int64_t begun_us = 0;  // monotonic
  std::int64_t last_seen_us = 0;
  std::string password_mark{};  // of the password that began it
};

class Sessions {
 public:
  // Begins with those that a server before it kept; how old they are is told by the calendar.
  explicit Sessions(const Surroundings& surroundings, const std::vector<casedb::WebSession>& kept = {});

  // Answers the id that goes into the cookie. The oldest session makes room when there are too many.
  std::string begin(const std::string& person_id, const std::string& password_mark = {});
  // The living session of this id, which is thereby used; none when unknown, idle too long or too old.
  std::optional<Session> find(const std::string& id);
  void end(const std::string& id);
  std::size_t count();

  // Hands over what began, what ended, and what was used a minute or more after what was handed over of it last;
  // not called with nothing. What it throws is thrown on: the same is handed over again the next time.
  using Keep = std::function<void(const casedb::WebSessionChanges&)>;
  void keep(const Keep& keep);

 private:
  struct Held {
    Session session;
    std::optional<std::int64_t> noted_us{};  // its last use, as far as it was handed over
  };
  using ByHash = std::map<std::string, Held>;

  std::int64_t utc_from_monotonic_us() const;
  ByHash::iterator drop(ByHash::iterator at);
  void drop_dead(std::int64_t now_us);
  void make_room(const std::string& person_id);

  const Surroundings& surroundings_;
  std::mutex keeping_, mutex_;  // the first one first
  ByHash by_hash_;
  std::set<std::string> ended_;  // hashes, not handed over yet
};

}  // namespace seldinger::web
