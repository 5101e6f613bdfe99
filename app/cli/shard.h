// Which part of the people a call makes: "2/8" of --shard.
#pragma once

#include <cstddef>

#include "app/cli/arguments.h"

namespace seldinger::app {

struct Shard {
  std::size_t number = 1, of = 1;
};
// All of them where --shard is not there. Throws UsageError.
Shard shard_of(const Arguments& arguments);

}  // namespace seldinger::app
