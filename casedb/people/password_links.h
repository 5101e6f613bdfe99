// One-time links with which people set their own password: whom an admin invites, or who has forgotten theirs. The
// library holds only the SHA-256 of a link; whoever makes it hands it over, since nothing here sends mail.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "casedb/people/people.h"

namespace seldinger::casedb {

inline constexpr std::int64_t kInvitationLife_us = 7LL * 24 * 3600 * 1'000'000;
inline constexpr std::int64_t kResetLife_us = 24LL * 3600 * 1'000'000;

struct PasswordLink {
  std::string secret;  // 64 hexadecimal digits, 256 random bits; told once
  std::int64_t ends_us = 0;
};

// An account whose password nobody knows, and its link. Refused as add_user: `bad_name`, `name_taken`.
base::Result<PasswordLink> invite_user(Library& library, const std::string& name, Role role);
// Ends the person's earlier links; the password stays until the link is used. `no_user`: also of a closed account.
base::Result<PasswordLink> make_password_link(Library& library, const std::string& name);
// Whose it is; none when it is unknown, used or over, or when password, role or account changed since.
std::optional<Account> account_of_password_link(Library& library, const std::string& secret);
// Once, in that person's own name; ends what was begun with the old password. `no_link`, `weak_password`: then the
// link still holds.
base::Result<void> set_password_by_link(Library& library, const std::string& secret, const std::string& password);

}  // namespace seldinger::casedb
