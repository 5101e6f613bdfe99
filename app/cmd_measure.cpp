// bench, goals and haptics stability: start seldinger-measure, a program of its own (docs/decisions/0038).
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "app/command.h"
#include "sim/base/failure.h"

namespace seldinger::app {

int run_measure(const Arguments& arguments) {
  std::error_code error;
  const std::filesystem::path own = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw base::Failure("measure_not_started", "this program cannot tell where it lies");
  const std::string program = own.parent_path() / "seldinger-measure";

  std::vector<std::string> words = {program};
  std::istringstream name(arguments.command());
  for (std::string word; name >> word;) words.push_back(word);
  words.insert(words.end(), arguments.words().begin(), arguments.words().end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  ::execv(program.c_str(), argv.data());  // returns only when it failed
  if (errno == ENOENT)
    throw base::Failure("measure_not_built",
                        "benchmarks and goals are a program of their own: build it with ./run measure");
  throw base::Failure("measure_not_started", "the program of benchmarks and goals cannot be started");
}

}  // namespace seldinger::app
