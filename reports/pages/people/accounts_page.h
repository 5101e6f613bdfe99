// Accounts, for whoever keeps them: who has one, invitations, and one-time links to set a password.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "casedb/people/people.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

// A link that was made just now: the only time that it is shown.
struct ShownLink {
  std::string name, url;
  std::int64_t ends_us = 0;
};

// Its forms go to /accounts. `problem`: why the last one was refused, else empty.
std::string accounts_page(const Visitor& visitor, const std::vector<casedb::Account>& accounts,
                          const std::optional<ShownLink>& link, std::string_view problem);

// The form of a one-time link, which goes to /password. `problem` as above.
std::string password_page(std::string_view link, std::string_view login_name, std::string_view problem);

}  // namespace seldinger::reports
