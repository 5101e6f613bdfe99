// A job as it is kept in its folder.
#pragma once

#include <optional>
#include <string>

#include "web/jobs/job.h"

namespace seldinger::web {

std::string json_of_kept_job(const Job& job);
std::optional<Job> job_from_json(const std::string& text);  // none: it is none of ours

}  // namespace seldinger::web
