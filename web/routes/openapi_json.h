// The registry of routes as OpenAPI 3.1, for programs that ask what pages show.
#pragma once

#include <span>
#include <string>

#include "web/site/route.h"

namespace seldinger::web {

// Each route with who may ask it (`x-roles`; none: anybody), its path's ids, what it answers as and, of a POST,
// that it takes a form with the session's token.
std::string openapi_json(std::span<const Route> routes, const std::string& program_version);

}  // namespace seldinger::web
