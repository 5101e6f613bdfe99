// Jobs of the pages as commands of this very program, each a process of its own: what it takes of memory goes with
// it, and whatever it reads, the server does not read. It acts for whoever asked, by a session of theirs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "web/jobs/job.h"

namespace seldinger::app {

// The words of a job's command, without the program and without who acts. `folder` is the job's own.
std::vector<std::string> words_of_job(const web::Job& job, const std::filesystem::path& folder);

// In the library at that folder.
web::JobRunner job_runner(std::filesystem::path library);

}  // namespace seldinger::app
