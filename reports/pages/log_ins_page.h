// Who has to wait before logging in, for whoever may let them try again at once.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/pages/page.h"

namespace seldinger::reports {

struct DelayedLogIn {
  std::string person_id, login_name;
  std::int64_t wait_s = 0;
};

// Its forms go to /log-ins.
std::string log_ins_page(const Visitor& visitor, const std::vector<DelayedLogIn>& delayed);

}  // namespace seldinger::reports
