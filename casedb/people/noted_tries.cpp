#include "casedb/people/noted_tries.h"

#include <algorithm>

#include "casedb/database/audit.h"
#include "casedb/database/disk.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/login_delays.h"

namespace seldinger::casedb {
namespace {

// Until the next try. Of a clock that was set back, rows of the future count for nothing.
std::int64_t wait_s(Library& library, const std::string& person_id, std::int64_t now) {
  int failures = 0;
  std::int64_t last_us = 0;
  Statement rows = question(library.database(), "noted_tries");
  rows.bind("person_id", person_id).bind("since_us", now - kLoginForgotten_us).bind("now_us", now);
  for (; rows.step() && rows.text("result") == "refused"; ++failures)
    last_us = std::max(last_us, rows.integer("at_us"));
  return whole_seconds(last_us + login_wait_us(failures) - now);
}

std::string person_of(Library& library, const std::string& name) {
  Statement row = question(library.identities(), "identity_by_name");
  return row.bind("name", name).step() ? row.text("person_id") : std::string();
}

}  // namespace

base::Result<Account> log_in_by_command(Library& library, const std::string& name, const std::string& password) {
  const bool notes = !library.database().read_only();
  std::optional<FolderLock> one_at_a_time;
  if (notes) one_at_a_time.emplace(library.folder());
  if (const std::string person_id = person_of(library, name); notes && !person_id.empty())
    if (const std::int64_t wait = wait_s(library, person_id, now_us()); wait > 0)
      return base::Error{"too_many_tries", "too many tries: again in " + std::to_string(wait) + " s"};
  auto account = log_in(library, name, password);
  if (!account) return base::Error{"bad_log_in", "the name or password is wrong"};
  return std::move(*account);
}

base::Result<void> let_in_again(Library& library, const std::string& name) {
  const std::string person_id = person_of(library, name);
  if (person_id.empty()) return base::Error{"no_user", "there is no such user"};
  Transaction transaction(library.database());
  audit(library, Act::let_in_again, {"person", person_id});
  transaction.commit();
  return {};
}

std::int64_t last_let_in_again(Library& library, const std::string& person_id) {
  const std::int64_t now = now_us();
  Statement row = question(library.database(), "last_let_in_again");
  row.bind("person_id", person_id).bind("since_us", now - kLoginForgotten_us).bind("now_us", now);
  return row.step() ? row.integer("sequence") : 0;
}

}  // namespace seldinger::casedb
