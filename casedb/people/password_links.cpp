#include "casedb/people/password_links.h"

#include <array>
#include <span>

#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/login_delays.h"
#include "casedb/people/password_rules.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {
namespace {

const base::Error kNoLink{"no_link", "this link is no longer valid; ask for another"};

std::string hash_of_link(const std::string& secret) {
  return sha256_hex(std::as_bytes(std::span(secret)));
}

PasswordLink new_link(Library& library, const Account& account, std::int64_t life_us) {
  std::array<std::byte, 32> random{};
  fill_random(random);
  PasswordLink link{base::hex_from_bytes(random), now_us() + life_us};
  Transaction transaction(library.database());
  question(library.database(), "end_password_links")
      .bind("person_id", account.person_id)
      .bind("now_us", now_us())
      .run();
  question(library.database(), "add_password_link")
      .bind("secret_hash", hash_of_link(link.secret))
      .bind("person_id", account.person_id)
      .bind("password_mark", account.password_mark)
      .bind("ends_us", link.ends_us)
      .run();
  audit(library, Act::make_password_link, {"person", account.person_id});
  transaction.commit();
  return link;
}

}  // namespace

base::Result<PasswordLink> invite_user(Library& library, const std::string& name, Role role) {
  Secret nobodys{random_password()};
  const auto person_id = add_user(library, name, role, nobodys.text);
  if (!person_id) return person_id.error();
  return new_link(library, find_user(library, *person_id).value(), kInvitationLife_us);
}

base::Result<PasswordLink> make_password_link(Library& library, const std::string& name) {
  for (const Account& one : list_users(library))
    if (folded_name(one.login_name) == folded_name(name) && one.enabled)
      return new_link(library, one, kResetLife_us);
  return base::Error{"no_user", "there is no such user, or the account is closed"};
}

std::optional<Account> account_of_password_link(Library& library, const std::string& secret) {
  std::string person_id, mark;
  {
    Statement row = question(library.database(), "password_link");
    if (!row.bind("secret_hash", hash_of_link(secret)).bind("now_us", now_us()).step()) return std::nullopt;
    person_id = row.text("person_id");
    mark = row.text("password_mark");
  }
  auto account = find_user(library, person_id);
  if (!account || !account->enabled || account->password_mark != mark) return std::nullopt;
  return account;
}

base::Result<void> set_password_by_link(Library& library, const std::string& secret, const std::string& password) {
  const auto account = account_of_password_link(library, secret);
  if (!account) return kNoLink;
  if (const auto fit = check_password(password, account->login_name); !fit) return fit.error();
  {
    // First: of two who use it at the same time one sets a password.
    Transaction transaction(library.database());
    Statement end = question(library.database(), "use_password_link");
    const bool was_there = end.bind("secret_hash", hash_of_link(secret)).step();
    end.rewind();
    if (!was_there) return kNoLink;
    transaction.commit();
  }
  return set_password(library, account->login_name, password);
}

}  // namespace seldinger::casedb
