#include "casedb/people/login_session.h"

#include <algorithm>
#include <array>
#include <span>

#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {
namespace {

std::string hash_of(const std::string& token) {
  return sha256_hex(std::as_bytes(std::span(token)));
}

}  // namespace

std::string begin_login_session(Library& library, const Account& account) {
  std::array<std::byte, 32> random{};
  fill_random(random);
  std::string token = base::hex_from_bytes(random);
  const std::int64_t now = now_us();
  Transaction transaction(library.database());
  question(library.database(), "end_old_login_sessions").bind("now_us", now).run();
  question(library.database(), "add_login_session")
      .bind("token_hash", hash_of(token))
      .bind("person_id", account.person_id)
      .bind("password_mark", account.password_mark)
      .bind("begun_us", now)
      .bind("ends_us", now + kLoginSessionLife_us)
      .run();
  transaction.commit();
  return token;
}

std::optional<Account> account_of_login_session(Library& library, const std::string& token) {
  std::string person_id, mark;
  {
    Statement row = question(library.database(), "login_session");
    if (!row.bind("token_hash", hash_of(token)).bind("now_us", now_us()).step()) return std::nullopt;
    person_id = row.text("person_id");
    mark = row.text("password_mark");
  }
  const auto accounts = list_users(library);
  const auto found = std::find_if(accounts.begin(), accounts.end(), [&](const Account& one) {
    return one.person_id == person_id && one.enabled && one.password_mark == mark;
  });
  return found == accounts.end() ? std::nullopt : std::optional(*found);
}

bool end_login_session(Library& library, const std::string& token) {
  Transaction transaction(library.database());
  std::optional<std::string> person_id;
  {
    Statement row = question(library.database(), "end_login_session");
    for (row.bind("token_hash", hash_of(token)); row.step();) person_id = row.text("person_id");
  }
  if (!person_id) return false;
  audit(library, Actor::person(*person_id), Act::log_out, {"person", *person_id});
  transaction.commit();
  return true;
}

}  // namespace seldinger::casedb
