// Says to every process of this machine that an open attempt is being made right now. The kernel takes the mark
// away with the process, so what is open without one was left behind.
#pragma once

#include <filesystem>
#include <string>

namespace seldinger::casedb {

class RunningMark {
 public:
  // Throws base::Failure("disk") where the library's folder cannot be written.
  RunningMark(const std::filesystem::path& folder, const std::string& attempt_id);
  RunningMark(const RunningMark&) = delete;
  RunningMark& operator=(const RunningMark&) = delete;
  ~RunningMark();

 private:
  int descriptor_;
};

bool is_running(const std::filesystem::path& folder, const std::string& attempt_id);

}  // namespace seldinger::casedb
