// Jobs as their pages tell them, as JSON. null is what there is not.
#pragma once

#include <span>
#include <string>

#include "reports/pages/people/jobs_page.h"

namespace seldinger::web {

std::string jobs_json(std::span<const reports::JobView> jobs);
std::string job_json(const reports::JobView& job);

}  // namespace seldinger::web
