// Sessions of the pages as a server keeps them for its next start (web/site/sessions.h): the SHA-256 of what the
// browser has, which opens nothing. Times are microseconds since 1970 UTC.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "casedb/database/library.h"

namespace seldinger::casedb {

struct WebSession {
  std::string id_hash;  // 64 hexadecimal digits
  std::string person_id, password_mark;
  std::int64_t begun_us = 0, seen_us = 0, ends_us = 0;
};

// Those of the server at this port that are neither over nor from the future, oldest first. Whether their accounts
// are open and their passwords still the same is for whoever uses them to ask.
std::vector<WebSession> list_web_sessions(Library& library, int port);

struct WebSessionChanges {
  std::vector<WebSession> kept;    // begun, or used again
  std::vector<std::string> ended;  // hashes; also of what was never kept
  bool empty() const noexcept { return kept.empty() && ended.empty(); }
};
// In one transaction; also takes away what is over.
void keep_web_sessions(Library& library, int port, const WebSessionChanges& changes);

}  // namespace seldinger::casedb
