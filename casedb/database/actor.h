// For whom an open library acts.
#pragma once

#include <optional>
#include <string>
#include <utility>

namespace seldinger::casedb {

enum class ActorKind {
  nobody,            // a server or a window at which nobody has logged in
  library_operator,  // whoever has the library's files
  person             // who has proven to be that person: by password or by a session begun with it
};

struct Actor {
  ActorKind kind = ActorKind::library_operator;
  // Of a person; of the operator, in whose name; none: in nobody's.
  std::optional<std::string> person_id{};

  static Actor nobody() { return {ActorKind::nobody, {}}; }
  static Actor person(std::string id) { return {ActorKind::person, std::move(id)}; }
  bool is_operator() const noexcept { return kind == ActorKind::library_operator; }
};

}  // namespace seldinger::casedb
