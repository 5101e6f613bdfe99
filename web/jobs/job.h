// Long work that somebody asks for on a page: what it is, and how far it is.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/names.h"

namespace seldinger::web {

enum class JobKind { import_ct, study_report, study_export };
inline constexpr auto kJobKindNames = base::names<JobKind>({{JobKind::import_ct, "import"},
                                                            {JobKind::study_report, "study_report"},
                                                            {JobKind::study_export, "study_export"}});

// Receiving: its files are being sent. Interrupted: the server was stopped before it had ended.
enum class JobState { receiving, waiting, running, done, failed, cancelled, interrupted };
inline constexpr auto kJobStateNames = base::names<JobState>({{JobState::receiving, "receiving"},
                                                              {JobState::waiting, "waiting"},
                                                              {JobState::running, "running"},
                                                              {JobState::done, "done"},
                                                              {JobState::failed, "failed"},
                                                              {JobState::cancelled, "cancelled"},
                                                              {JobState::interrupted, "interrupted"}});
constexpr bool has_ended(JobState state) noexcept {
  return state >= JobState::done;
}

struct JobFile {
  std::string name;  // of ours, never what a browser said
  std::uint64_t bytes = 0;
  bool operator==(const JobFile&) const = default;
};

struct Job {
  std::string job_id, person_id;
  JobKind kind = JobKind::import_ct;
  JobState state = JobState::waiting;
  std::map<std::string, std::string> wish{};  // what was asked for, by the form's fields
  std::int64_t asked_us = 0, ended_us = 0;    // since 1970; ended: 0 before
  std::vector<JobFile> files{};               // that were sent
  std::string doing{};                        // while it runs: the last thing that it said
  std::string said{};                         // when it has ended: its result in words, or why there is none
  std::string made_id{};                      // of the case that it made
  std::vector<JobFile> results{};             // in its folder's `results`
  bool operator==(const Job&) const = default;
};

// How a job went, as its runner tells it.
struct JobEnd {
  bool done = false;
  std::string said, made_id;
};
// Does it: reads `folder`/files, writes into `folder`/results, tells what it does as often as it likes, and ends
// soon once it is asked to stop. Called by one thread, one job after the other.
using JobRunner =
    std::function<JobEnd(const Job& job, const std::filesystem::path& folder,
                         const std::function<void(std::string_view)>& doing, const std::stop_token& stop)>;

}  // namespace seldinger::web
