// A stored case as the case editor looks at it: its scene, and whether its checks hold, made anew by a thread
// each time the case was changed. It reads what is stored, so that editor, page and command line see the same.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "casedb/cases/case_checks.h"
#include "session/case/case_build.h"
#include "session/case/case_check.h"
#include "session/case/planned_way.h"

namespace seldinger::app {

struct CheckedCase {
  std::uint64_t number = 0;  // rises
  casedb::CaseRow row;
  // With classes; lesions in their order, and what is drawn painted.
  cases::Case scene;
  casedb::CaseCheck check;
  std::optional<session::PlannedWay> way;
};

class DraftCase {
 public:
  // Begins at once.
  DraftCase(std::filesystem::path library, std::string case_id);
  ~DraftCase();
  DraftCase(const DraftCase&) = delete;
  DraftCase& operator=(const DraftCase&) = delete;

  // The case was changed; what is stored from now on is looked at.
  void look_again();

  // The newest; nothing before the first.
  std::shared_ptr<const CheckedCase> newest() const;
  bool busy() const;                         // a change has not been looked at yet
  std::optional<base::Error> error() const;  // why the newest change could not be

 private:
  void run();
  base::Result<std::shared_ptr<const CheckedCase>> make(casedb::Library& library, std::uint64_t number);

  std::filesystem::path library_;
  std::string case_id_;
  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::uint64_t asked_ = 1, answered_ = 0;
  bool stopping_ = false;
  std::shared_ptr<const CheckedCase> newest_;
  std::optional<base::Error> error_;
  std::optional<session::CaseAssets> assets_;  // the thread's
  std::thread thread_;                         // last: it uses the rest
};

}  // namespace seldinger::app
