#include "app/cli/shard.h"

#include <cmath>
#include <string>

#include "app/cli/command.h"

namespace seldinger::app {

Shard shard_of(const Arguments& arguments) {
  if (!arguments.has("--shard")) return {};
  const std::string text = arguments.text("--shard");
  const std::size_t slash = text.find('/');
  const auto part = [](const std::string& digits) {
    const double number = parse_number(digits).value_or(0.0);
    const bool whole = number >= 1.0 && number <= 100'000.0 && number == std::floor(number);
    return whole ? static_cast<std::size_t>(number) : std::size_t{0};
  };
  const Shard shard{part(text.substr(0, slash)), slash == text.npos ? 0 : part(text.substr(slash + 1))};
  if (shard.number == 0 || shard.of == 0 || shard.number > shard.of)
    throw UsageError("--shard is which of how many: 2/8");
  return shard;
}

}  // namespace seldinger::app
