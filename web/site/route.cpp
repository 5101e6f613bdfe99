#include "web/site/route.h"

namespace seldinger::web {
namespace {

bool is_uuid(std::string_view text) {
  if (text.size() != 36) return false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool dash = i == 8 || i == 13 || i == 18 || i == 23;
    const char c = text[i];
    const bool hex = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f');
    if (dash ? c != '-' : !hex) return false;
  }
  return true;
}

}  // namespace

std::string Call::field(const std::string& name) const {
  const auto found = form.find(name);
  return found == form.end() ? "" : found->second;
}

bool matches(std::string_view pattern, std::string_view path, std::string& id) {
  const std::size_t hole = pattern.find('{');
  if (hole == pattern.npos) return pattern == path;
  const std::string_view before = pattern.substr(0, hole), after = pattern.substr(pattern.find('}') + 1);
  if (path.size() != before.size() + 36 + after.size()) return false;
  const std::string_view found = path.substr(hole, 36);
  if (path.substr(0, hole) != before || path.substr(hole + 36) != after || !is_uuid(found)) return false;
  id = found;
  return true;
}

}  // namespace seldinger::web
