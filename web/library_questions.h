// The questions put to a real library, and the server that `seldinger serve` runs over it.
#pragma once

#include <functional>
#include <memory>

#include "casedb/database/library.h"
#include "web/jobs/jobs.h"
#include "web/server.h"
#include "web/site/questions.h"

namespace seldinger::web {

// What is done with volumes and pictures, each in a library of its own; empty: not done here.
using CaseChecker = std::function<base::Result<casedb::CaseCheck>(casedb::Library&, const std::string& case_id)>;
using PicturesMaker =
    std::function<base::Result<reports::DrawnPictures>(casedb::Library&, const std::string& attempt_id)>;
struct HeavyWork {
  CaseChecker check{};
  PicturesMaker pictures{};
  JobRunner jobs{};  // in processes of their own
};

// Opens further handles of the same library, so that reading a recording and hashing a password hold up no page.
// Refused as Library::open.
base::Result<std::unique_ptr<Questions>> questions_of(casedb::Library library, HeavyWork work = {});

// As Server::open, with time, chance and hash of this machine. `log` gets one line a fault.
base::Result<Server> open_server(casedb::Library library, const ServeOptions& options, std::string program_version,
                                 std::function<void(const std::string&)> log, HeavyWork work = {});

}  // namespace seldinger::web
