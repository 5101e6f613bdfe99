// surrogate distributions.
#include <algorithm>
#include <cstdio>
#include <optional>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/words.h"
#include "app/population/distributions.h"
#include "app/population/open_surrogate.h"
#include "app/population/population_json.h"
#include "assessment/registry.h"

namespace seldinger::app {
namespace {

std::vector<std::string> metrics_of(const Arguments& arguments) {
  if (!arguments.has("--metric")) return drawn_metrics();
  std::vector<std::string> metrics;
  for (const std::string& metric : arguments.all("--metric")) {
    if (assessment::find_metric(metric) == nullptr)
      throw UsageError("--metric: there is no metric called " + shown(metric) +
                       "; `seldinger help --metrics` lists them");
    if (std::find(metrics.begin(), metrics.end(), metric) == metrics.end()) metrics.push_back(metric);
  }
  return metrics;
}

int run_surrogate_distributions(const Arguments& arguments) {
  std::optional<std::filesystem::path> chart;
  if (arguments.has("--chart")) chart = file_of("--chart", arguments.text("--chart"), {".svg"});
  const auto metrics = metrics_of(arguments);
  const auto people = static_cast<std::size_t>(arguments.whole("--people", 2000, 100, 1'000'000));
  const auto surrogate = surrogate_of(arguments);
  if (!surrogate) return refuse(surrogate.error());
  const auto made = simulated_distributions(*surrogate, metrics, people, 1);
  if (made.metrics.empty())
    return refuse({"bad_surrogate", "none of these metrics has a value in the surrogate's attempts"});
  if (chart) write_file(*chart, svg_of_distributions(made));
  std::fputs(arguments.has("--json") ? json_of_distributions(made).c_str() : text_of_distributions(made).c_str(),
             stdout);
  return kDone;
}

constexpr Option kDistributionsOptions[] = {
    {"--surrogate", "FILE.json", "what `seldinger surrogate fit` wrote"},
    {"--metric", "ID",
     "which metric; may be given many times; default those with published figures and a few that a puncture is "
     "about",
     true},
    {"--people", "N", "people drawn for each level; default 2000"},
    {"--chart", "FILE.svg", "a new file with a chart of them beside published ones"},
    kJson};

}  // namespace

Command surrogate_distributions_command() {
  return {.name = "surrogate distributions",
          .options = kDistributionsOptions,
          .summary =
              "Shows how simulated novices, intermediates and experts spread in each metric, beside published "
              "distributions.",
          .run = &run_surrogate_distributions};
}

}  // namespace seldinger::app
