// Every route, and who may ask it. A route that is not in the registry does not exist.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "web/http.h"
#include "web/site.h"

namespace seldinger::web {

// Roles as a set of bits; a route without any is open to whoever is not logged in.
using Roles = unsigned;
constexpr Roles bit_of(casedb::Role role) {
  return 1U << static_cast<unsigned>(role);
}
inline constexpr Roles kOpen = 0;
inline constexpr Roles kEveryRole = bit_of(casedb::Role::trainee) | bit_of(casedb::Role::mentor) |
                                    bit_of(casedb::Role::researcher) | bit_of(casedb::Role::director) |
                                    bit_of(casedb::Role::admin);
inline constexpr Roles kAttemptReaders =
    bit_of(casedb::Role::trainee) | bit_of(casedb::Role::mentor) | bit_of(casedb::Role::researcher);

inline constexpr Roles kCaseReaders = bit_of(casedb::Role::mentor) | bit_of(casedb::Role::researcher) |
                                      bit_of(casedb::Role::director) | bit_of(casedb::Role::admin);

inline constexpr Roles kCurriculumReaders = bit_of(casedb::Role::trainee) | bit_of(casedb::Role::mentor) |
                                            bit_of(casedb::Role::researcher) | bit_of(casedb::Role::director);

struct Call {
  const Request& request;
  const Reader* reader = nullptr;             // null: not logged in
  std::string id{};                           // of the pattern
  std::map<std::string, std::string> form{};  // of a POST
};

struct Route {
  std::string_view method;   // GET (which also answers HEAD) or POST
  std::string_view pattern;  // "{attempt_id}" or "{case_id}" stands for one UUID
  Roles roles = kOpen;
  bool is_page = true;     // whoever is not logged in is sent to the log-in page; else 401
  std::string_view scope;  // what the roles leave open, for docs/routes.md
  std::string_view summary;
  Response (*handle)(Site&, const Call&) = nullptr;
};

std::span<const Route> routes();

// Whether `path` fits; fills the pattern's id.
bool matches(std::string_view pattern, std::string_view path, std::string& id);

// docs/routes.md
std::string routes_markdown();

}  // namespace seldinger::web
