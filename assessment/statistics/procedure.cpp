#include "assessment/statistics/procedure.h"

#include <charconv>
#include <cmath>

namespace seldinger::assessment::statistics {

std::string ProcedureOptions::text(const std::string& name, const std::string& fallback) const {
  const auto found = values_.find(name);
  return found == values_.end() ? fallback : found->second;
}

std::optional<double> ProcedureOptions::number(const std::string& name, double fallback) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return fallback;
  const std::string& text = found->second;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<std::size_t> ProcedureOptions::whole(const std::string& name, std::size_t fallback, std::size_t least,
                                                   std::size_t most) const {
  if (!has(name)) return fallback;
  const std::optional<double> value = number(name, 0.0);
  if (!value || *value < static_cast<double>(least) || *value > static_cast<double>(most) ||
      std::floor(*value) != *value)
    return std::nullopt;
  return static_cast<std::size_t>(*value);
}

std::vector<std::string> ProcedureOptions::list(const std::string& name) const {
  std::vector<std::string> items;
  const auto found = values_.find(name);
  if (found == values_.end() || found->second.empty()) return items;
  std::size_t from = 0;
  for (std::size_t colon = 0; colon != std::string::npos; from = colon + 1) {
    colon = found->second.find(':', from);
    items.push_back(found->second.substr(from, colon == std::string::npos ? colon : colon - from));
  }
  return items;
}

}  // namespace seldinger::assessment::statistics
