// audit.
#include <charconv>
#include <chrono>
#include <cstdio>

#include "app/acting/acting.h"
#include "app/acting/audit_json.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

// "2026-11-23", UTC; nothing for what is no day.
std::optional<std::int64_t> start_of_day_us(const std::string& text) {
  int parts[3] = {};
  const std::size_t from[] = {0, 5, 8}, digits[] = {4, 2, 2};
  if (text.size() != 10 || text[4] != '-' || text[7] != '-') return std::nullopt;
  for (std::size_t i = 0; i < 3; ++i) {
    const char* first = text.data() + from[i];
    const auto read = std::from_chars(first, first + digits[i], parts[i]);
    if (read.ec != std::errc() || read.ptr != first + digits[i] || parts[i] < 0) return std::nullopt;
  }
  const std::chrono::year_month_day day{std::chrono::year(parts[0]),
                                        std::chrono::month(static_cast<unsigned>(parts[1])),
                                        std::chrono::day(static_cast<unsigned>(parts[2]))};
  if (!day.ok()) return std::nullopt;
  return std::chrono::microseconds(std::chrono::sys_days(day).time_since_epoch()).count();
}

int run_audit(const Arguments& arguments) {
  std::int64_t since_us = 0;
  if (arguments.has("--since")) {
    const auto day = start_of_day_us(arguments.text("--since"));
    if (!day) throw UsageError("--since is a day, YYYY-MM-DD");
    since_us = *day;
  }
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::read_audit); !by) return refuse(by.error());
  const auto rows = casedb::list_audit(*library, since_us);
  const casedb::AuditHead head = casedb::audit_head(*library);
  if (arguments.has("--json")) {
    std::fputs(json_of_audit(rows, head).c_str(), stdout);
    return kDone;
  }
  for (const casedb::AuditRow& row : rows)
    std::printf("%6lld  %s  %-8s %-36s  %-7s  %s%s%s%s%s\n", static_cast<long long>(row.sequence),
                reports::utc_text(row.at_us).c_str(), row.actor.c_str(), row.person_id.value_or("").c_str(),
                row.result.c_str(), row.act.c_str(), row.object.empty() ? "" : " ", row.object.c_str(),
                row.object_id.empty() ? "" : " ", row.object_id.c_str());
  std::printf("%lld rows, the last %s\n", static_cast<long long>(head.count), head.hash.c_str());
  return kDone;
}

constexpr Option kAuditOptions[] = {kLibrary, {"--since", "YYYY-MM-DD", "from that day on, UTC"}, kJson};

}  // namespace

Command audit_command() {
  return {.name = "audit",
          .options = kAuditOptions,
          .acts = true,
          .summary = "Lists who did what: ids and codes, never a name (docs/keeping.md).",
          .run = &run_audit};
}

}  // namespace seldinger::app
