// Every route, and who may ask it. A route that is not in the registry does not exist.
#pragma once

#include <span>
#include <string>

#include "web/site/route.h"

namespace seldinger::web {

// In the order of docs/routes.md.
std::span<const Route> routes();

// docs/routes.md
std::string routes_markdown();

}  // namespace seldinger::web
