#include "web/site/security_log.h"

namespace seldinger::web {
namespace {
constexpr std::int64_t kApart_us = 10 * 1000000;
constexpr std::size_t kMostLines = 256;  // in ten seconds
}  // namespace

SecurityLog::SecurityLog(const Surroundings& surroundings)
    : surroundings_(surroundings), key_(surroundings.random_id()) {}

void SecurityLog::note(std::string_view what, const std::string& address, const std::string& person_id) {
  std::string text = "security: ";
  text += what;
  if (!address.empty()) text += "; address " + surroundings_.sha256_hex(key_ + address).substr(0, 8);
  if (!person_id.empty()) text += "; account " + person_id;
  const std::int64_t now_us = surroundings_.now_us();
  const std::lock_guard lock(mutex_);
  for (auto it = lines_.begin(); it != lines_.end();) {
    Line& line = it->second;
    if (now_us - line.written_us < kApart_us) {
      ++it;
      continue;
    }
    if (line.unwritten > 0) surroundings_.log(it->first + "; " + std::to_string(line.unwritten) + " times more");
    it = lines_.erase(it);
  }
  if (lines_.size() >= kMostLines && !lines_.contains(text)) text = "security: more than are listed one by one";
  const auto [line, is_new] = lines_.try_emplace(text, Line{now_us, 0});
  if (is_new) {
    surroundings_.log(text);
  } else {
    ++line->second.unwritten;
  }
}

}  // namespace seldinger::web
