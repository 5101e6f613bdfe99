// What whoever watches over the server wants to know, as lines of its log: who it was stands there as an account's
// id and an address as a hash that holds for this run only, so the log names nobody.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

#include "web/site/surroundings.h"

namespace seldinger::web {

class SecurityLog {
 public:
  explicit SecurityLog(const Surroundings& surroundings);

  // "security: log-in failed; address 3fa1b2c4; account 0190a1b2-…". The same thing of the same address is written
  // at most once in ten seconds; what came meanwhile is counted in the next line. Beyond 256 lines
  // in ten seconds the rest is one line with its count, so nobody fills a disk with many addresses either.
  void note(std::string_view what, const std::string& address, const std::string& person_id = {});

 private:
  struct Line {
    std::int64_t written_us = 0;
    std::size_t unwritten = 0;
  };
  const Surroundings& surroundings_;
  std::string key_;
  std::mutex mutex_;
  std::map<std::string, Line> lines_;  // of the last ten seconds, by their text
};

}  // namespace seldinger::web
