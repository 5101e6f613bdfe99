// doctor.
#include <sched.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <thread>

#include "app/cli/command.h"
#include "app/cli/library_place.h"
#include "app/cli/version.h"
#include "app/library/doctor_json.h"
#include "app/window/surface/window.h"
#include "casedb/database/library.h"
#include "casedb/database/migrate.h"
#include "casedb/import/jail/jail.h"
#include "sim/base/failure.h"
#include "sim/engine/step.h"
#include "sim/gpu/context.h"

namespace seldinger::app {
namespace {

std::string realtime_rights() {
  rlimit limit{};
  const bool has_limit = ::getrlimit(RLIMIT_RTPRIO, &limit) == 0;
  sched_param wanted{};
  wanted.sched_priority = 1;
  sched_param before{};
  const int policy = ::sched_getscheduler(0);
  ::sched_getparam(0, &before);
  if (::sched_setscheduler(0, SCHED_FIFO, &wanted) == 0) {
    ::sched_setscheduler(0, policy, &before);
    return "SCHED_FIFO allowed";
  }
  return "SCHED_FIFO not allowed (RLIMIT_RTPRIO " + std::to_string(has_limit ? limit.rlim_cur : 0) + ")";
}

bool is_in_path(const char* program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && ::access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

// Of the disk on which `folder` is, or would be made.
std::optional<double> free_mb(std::filesystem::path folder) {
  std::error_code error;
  for (folder = std::filesystem::absolute(folder, error); !std::filesystem::exists(folder, error);)
    folder = folder.parent_path();
  const auto space = std::filesystem::space(folder, error);
  return error ? std::nullopt : std::optional(static_cast<double>(space.available) * 1e-6);
}

// What the library's place holds; one that is not there yet is refused only where it is named.
base::Result<void> look_at_library(const Arguments& arguments, DoctorAnswer& doctor, Machine& machine) {
  const std::filesystem::path folder = library_folder_if_any(arguments);
  if (folder.empty()) {
    doctor.facts.emplace_back("library", "no home folder to look in");
    return {};
  }
  doctor.facts.emplace_back("library_folder", folder.string());
  machine.disk_free_mb = free_mb(folder);
  doctor.facts.emplace_back("disk_free_mb",
                            machine.disk_free_mb ? std::to_string(std::llround(*machine.disk_free_mb)) : "unknown");
  auto library = casedb::Library::open(folder);
  if (!library) {
    const bool to_be_made = library.error().code == "no_library" && !arguments.has("--library");
    doctor.facts.emplace_back("library",
                              to_be_made ? "none yet: `seldinger demo` makes one" : library.error().code);
    return to_be_made ? base::Result<void>() : error_of_library(arguments, library.error());
  }
  doctor.facts.emplace_back("library", "opens");
  const auto version = casedb::schema_version(library->database(), casedb::library_schema());
  doctor.facts.emplace_back("schema", version ? std::to_string(*version) : version.error().code);
  return {};
}

int run_doctor(const Arguments& arguments) {
  DoctorAnswer doctor;
  Machine machine;
  const auto add = [&doctor](const char* name, const std::string& value) {
    doctor.facts.emplace_back(name, value);
  };
  add("version", kVersion);
  add("step_version", std::to_string(engine::kStepVersion));
  machine.cores = std::thread::hardware_concurrency();
  add("cores", std::to_string(machine.cores));
  try {
    const gpu::Context context;
    machine.gl = true;
    machine.software = context.software();
    add("gl", context.version());
    add("gl_renderer", context.renderer() + (context.software() ? " (software)" : ""));
  } catch (const base::Failure& failure) {
    add("gl", std::string("none: ") + failure.what() + "; the CPU makes the pictures");
  }
  machine.display = display_opens();
  add("display", machine.display ? "opens" : "none");
  add("devices", "virtual");
  add("real_time", realtime_rights());
  add("readers", casedb::jail_filters_calls() ? "jailed, system calls filtered"
                                              : "jailed by limits only: the kernel does not filter system calls");
  add("films", is_in_path("ffmpeg") ? "by ffmpeg" : "none: ffmpeg is not installed");
  const auto looked = look_at_library(arguments, doctor, machine);
  doctor.fitness = fitness_of(machine);
  const bool json = arguments.has("--json");
  if (!json) {
    for (const auto& [name, value] : doctor.facts) std::printf("%-14s %s\n", name.c_str(), value.c_str());
    std::printf("\ncan train: %s\n", name_of(doctor.fitness.fit));
    for (const std::string& why : doctor.fitness.why) std::printf("  %s\n", why.c_str());
  }
  if (!looked) return refuse(looked.error());
  if (json) std::fputs(json_of_doctor(doctor).c_str(), stdout);
  return doctor.fitness.fit == Fit::no ? kCheckFailed : kDone;
}

}  // namespace

Command doctor_command() {
  return {.name = "doctor",
          .options = kLibraryJson,
          .summary =
              "Reports what this machine can do (GL, display, devices, real-time rights, disk, schema), and "
              "whether somebody can train on it: yes, slowly or no, and why; 1 when not.",
          .run = &run_doctor};
}

}  // namespace seldinger::app
