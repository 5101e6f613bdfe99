// Long work that the reader asked for: the list, and one of them with its progress and what came of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reports/pages/page.h"

namespace seldinger::reports {

struct JobResult {
  std::string name;
  std::uint64_t bytes = 0;
  bool too_large = false;  // to be handed out by a page
};

struct JobView {
  std::string job_id;
  std::string kind;   // "import", "study_report", "study_export"
  std::string title;  // of the case to be, of the study
  std::string state;  // "receiving" …
  std::int64_t asked_us = 0;
  std::size_t files = 0;
  std::uint64_t sent_bytes = 0;
  std::string doing, said, case_id;
  std::vector<JobResult> results;
  bool ended() const { return state != "receiving" && state != "waiting" && state != "running"; }
};

std::string job_kind_text(const std::string& kind);
std::string job_state_text(const std::string& state);
// How far it is, 0 to 1, of what it says ("3 of 11"); negative: it says nothing of the kind.
double share_done(const std::string& doing);

// `may_import`: the list begins with the form of an import; `problem`: why the last one was refused.
std::string jobs_page(const Visitor& visitor, std::span<const JobView> jobs, bool may_import,
                      std::string_view problem);
std::string job_page(const Visitor& visitor, const JobView& job);

}  // namespace seldinger::reports
