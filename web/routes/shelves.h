// The rows of each file of this folder; routes.cpp joins them.
#pragma once

#include <span>

#include "web/site/route.h"

namespace seldinger::web {

std::span<const Route> entry_routes();
std::span<const Route> start_routes();
std::span<const Route> answering_routes();
std::span<const Route> rating_routes();
std::span<const Route> attempt_routes();
std::span<const Route> case_routes();
std::span<const Route> learner_routes();
std::span<const Route> people_routes();
std::span<const Route> account_routes();
std::span<const Route> study_routes();
std::span<const Route> me_routes();
std::span<const Route> station_routes();
std::span<const Route> job_routes();
std::span<const Route> server_routes();

}  // namespace seldinger::web
