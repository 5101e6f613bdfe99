// How fast passwords may be tried: what the dashboard and the window hold every log-in to.
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>

namespace seldinger::casedb {

// Five tries of a name from one place are free; from then on each failure doubles the wait, 1 s up to 60 s, and an
// hour without a try forgets. A place is an address, or what proves that its owner has been logged in under that
// name, so that nobody shuts out who has it: who fails elsewhere delays themselves. Names that do not exist count
// as well, so the answer does not tell. There is no count of all names together: hashing bounds how many are tried.
// Tries of several threads at once.
inline constexpr std::int64_t kLoginForgotten_us = 3600LL * 1000000;
std::int64_t login_wait_us(int failures);              // until the next try
std::int64_t whole_seconds(std::int64_t duration_us);  // not less than it; of nothing or less: 0

class LoginDelays {
 public:
  // Whole seconds to wait; 0: go on, and the try counts as failed until forget() is called.
  std::int64_t begin(std::string_view name, std::string_view place, std::int64_t now_us);
  void take_back(std::string_view name, std::string_view place);  // the try of begin() was not answered
  void forget(std::string_view name, std::string_view place);     // the password was right
  void forget(std::string_view name);                             // at every place: somebody lets them in again
  // Somebody was let in again by another program, as the audit log numbers it (noted_tries.h): heeded once. False:
  // it was already.
  bool heed(std::string_view name, std::int64_t let_in_again);
  // The longest that anybody has to wait who tries this name now; 0: nobody has to.
  std::int64_t longest_wait_s(std::string_view name, std::int64_t now_us);

 private:
  struct Tries {
    int failures = 0;
    std::int64_t last_us = 0;
  };
  std::mutex mutex_;
  std::map<std::pair<std::string, std::string>, Tries> tries_;  // by name in lower case, and place
  std::map<std::string, std::int64_t> heeded_;  // by name in lower case: of people, as many as they are
};

// A log-in name as names are compared: without regard to ASCII case.
std::string folded_name(std::string_view name);

}  // namespace seldinger::casedb
