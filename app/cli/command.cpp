#include "app/cli/command.h"

#include <cstdio>
#include <iterator>

namespace seldinger::app {

std::vector<Option> options_of(const Command& command) {
  std::vector<Option> options(command.options.begin(), command.options.end());
  if (command.acts) options.insert(options.end(), std::begin(kActs), std::end(kActs));
  return options;
}

int refuse(const base::Error& error) {
  std::fprintf(stderr, "error: %s: %s\n", error.code.c_str(), error.text.c_str());
  for (const base::Problem& finding : error.findings)
    std::fprintf(stderr, "finding: %s: %s\n", finding.code.c_str(), finding.text.c_str());
  return kRefused;
}

}  // namespace seldinger::app
