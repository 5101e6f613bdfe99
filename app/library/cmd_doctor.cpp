// doctor.
#include <sched.h>
#include <sys/resource.h>

#include <cstdio>
#include <filesystem>
#include <thread>

#include "app/attempts/answers_json.h"
#include "app/cli/command.h"
#include "app/cli/version.h"
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

int run_doctor(const Arguments& arguments) {
  DoctorAnswer doctor;
  const auto add = [&doctor](const char* name, const std::string& value) {
    doctor.facts.emplace_back(name, value);
  };
  std::optional<base::Error> refused;
  add("version", kVersion);
  add("step_version", std::to_string(engine::kStepVersion));
  add("cores", std::to_string(std::thread::hardware_concurrency()));
  try {
    const gpu::Context context;
    add("gl", context.version());
    add("gl_renderer", context.renderer() + (context.software() ? " (software)" : ""));
  } catch (const base::Failure& failure) {
    add("gl", std::string("none: ") + failure.what() + "; pictures are made by the CPU");
  }
  add("devices", "virtual");
  add("real_time", realtime_rights());
  add("readers", casedb::jail_filters_calls() ? "jailed, system calls filtered"
                                              : "jailed by limits only: the kernel filters no system calls");
  if (arguments.has("--library")) {
    auto library = casedb::Library::open(arguments.text("--library"));
    if (library) {
      add("library", "opens");
      const auto version = casedb::schema_version(library->database(), casedb::library_schema());
      add("schema", version ? std::to_string(*version) : version.error().code);
      std::error_code error;
      const auto space = std::filesystem::space(arguments.text("--library"), error);
      add("disk_free_mb", error ? "unknown" : std::to_string(space.available / 1'000'000));
    } else {
      add("library", library.error().code);
      refused = library.error();
    }
  }
  if (arguments.has("--json")) {
    std::fputs(json_of_facts(doctor).c_str(), stdout);
  } else {
    for (const auto& [name, value] : doctor.facts) std::printf("%-14s %s\n", name.c_str(), value.c_str());
  }
  return refused ? refuse(*refused) : kDone;
}

}  // namespace

Command doctor_command() {
  return {.name = "doctor",
          .options = kLibraryJson,
          .summary = "Tells what this machine can do: GL, devices, real-time rights, disk, schema.",
          .run = &run_doctor};
}

}  // namespace seldinger::app
