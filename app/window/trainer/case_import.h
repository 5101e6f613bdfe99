// A CT becomes a draft, on a thread of its own: read, its skin made, stored in a mentor's name.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "casedb/cases/cases.h"
#include "sim/base/result.h"

namespace seldinger::app {

class CaseImport {
 public:
  struct Wish {
    std::filesystem::path source;  // as `seldinger import` takes it
    std::string title;             // empty: by its size
    cases::Modality modality = cases::Modality::ultrasound;
  };
  struct Made {
    std::string case_id, title;
    std::vector<std::string> same_ct;  // cases that hold this CT already: "“Liver”, version 2"
  };

  // Begins at once.
  CaseImport(std::filesystem::path library, std::string person_id, Wish wish);
  ~CaseImport();  // waits for its end
  CaseImport(const CaseImport&) = delete;
  CaseImport& operator=(const CaseImport&) = delete;

  const std::string& person_id() const noexcept { return person_id_; }
  std::optional<base::Result<Made>> made() const;  // nothing: it is at work

 private:
  const std::string person_id_;
  mutable std::mutex mutex_;
  std::optional<base::Result<Made>> made_;
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::app
