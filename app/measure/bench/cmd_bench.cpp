// bench: time against error, relative to a stated reference. Figures, not tests: machines here are noisy.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "app/bench_stages.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/measure/bench/cmd_bench.h"
#include "app/measure/bench/stages.h"
#include "reports/charts/frontier_page.h"
#include "sim/base/failure.h"

namespace seldinger::measure {
namespace {

std::string csv(const std::vector<BenchRow>& rows) {
  std::string text =
      "stage,method,setting,backend,device,size,n,ms_median,ms_min,ms_max,error,error_unit,reference\n";
  const auto quoted = [](const std::string& cell) {
    return cell.find(',') == std::string::npos ? cell : '"' + cell + '"';
  };
  for (const BenchRow& row : rows)
    text += row.stage + ',' + quoted(row.method) + ',' + quoted(row.setting) + ',' + row.backend + ',' +
            quoted(row.device) + ',' + row.size + ',' + std::to_string(row.n) + ',' + bench_number(row.ms_median) +
            ',' + bench_number(row.ms_min) + ',' + bench_number(row.ms_max) + ',' + row.error + ',' +
            quoted(row.error_unit) + ',' + quoted(row.reference) + '\n';
  return text;
}

// What a chart is of: rows with the same can be compared.
std::string scene_of(const BenchRow& row) {
  if (row.stage == "xray") return row.setting.substr(0, row.setting.find(' '));
  if (row.stage == "ultrasound") return row.setting.substr(0, row.setting.find(' ', row.setting.find(' ') + 1));
  return row.size;
}

// Stages that chart one against the other: rows with an error, one chart for each scene, one thread and GL alone.
std::string frontier(const std::vector<BenchRow>& rows) {
  std::vector<reports::FrontierPoint> points;
  for (const BenchRow& row : rows) {
    if (row.error.empty() || row.device == "2 threads" || row.method == "fluoroscopy chain" ||
        row.method == "peak memory of a picture")
      continue;
    const std::string scene = scene_of(row);
    const std::string detail = row.setting.size() > scene.size() ? row.setting.substr(scene.size()) : "";
    const std::string where = row.backend == "gpu" ? " gpu" : "";
    points.push_back({row.stage + ", " + scene + ", " + row.error_unit, row.method, row.method + detail + where,
                      row.ms_median, std::strtod(row.error.c_str(), nullptr), row.error_unit, row.reference});
  }
  return reports::frontier_page("Time against error", points);
}

// The stages named in "a,b", in that order; every stage when nothing is asked for.
std::vector<const BenchStage*> stages_in(const app::Arguments& arguments) {
  std::vector<const BenchStage*> asked;
  if (!arguments.has("--stage")) {
    for (const BenchStage& stage : bench_stages()) asked.push_back(&stage);
    return asked;
  }
  const std::string list = arguments.text("--stage");
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t comma = std::min(list.find(',', begin), list.size());
    const BenchStage* stage = find_bench_stage(list.substr(begin, comma - begin));
    if (stage == nullptr) throw app::UsageError("--stage knows " + std::string(app::kBenchStageNames.data()));
    asked.push_back(stage);
    begin = comma + 1;
  }
  return asked;
}

}  // namespace

int run_bench(const app::Arguments& arguments) {
  const std::filesystem::path out = arguments.required("--out");
  const bool quick = arguments.has("--quick");
  const std::vector<const BenchStage*> asked = stages_in(arguments);
  std::vector<BenchRow> rows;
  for (const BenchStage* stage : asked) {
    const app::BenchStageWords& about = stage->about;
    std::fprintf(stderr, "bench %s: %s%s%s …\n", about.name, about.measures,
                 *about.reference ? "; errors from " : "", about.reference);
    const base::Result<void> done = stage->run(arguments, quick, rows);
    if (!done) return app::refuse(done.error());
  }
  std::error_code error;
  std::filesystem::create_directories(out, error);
  if (error) throw base::Failure("disk", "the output folder cannot be made");
  const std::string text = csv(rows);
  app::write_file(out / "results.csv", text);
  app::write_file(out / "frontier.html", frontier(rows));
  for (const BenchStage* stage : asked)
    if (stage->page_name != nullptr) app::write_file(out / stage->page_name, stage->page());
  std::fputs(text.c_str(), stdout);
  return app::kDone;
}

}  // namespace seldinger::measure
