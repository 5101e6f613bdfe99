// bench --stage haptics: the needle's laws, time of a tick against error to the published lines.
#include <array>
#include <cmath>
#include <functional>

#include "app/measure/bench/bench.h"
#include "app/measure/rigs/thesis_needle.h"
#include "reports/charts/force_page.h"
#include "sim/base/tick.h"
#include "sim/haptics/needle/needle_law.h"
#include "sim/volume/classes.h"

namespace seldinger::measure {
namespace {

using volume::TissueClass;

constexpr double kEncoderMm = 0.055;  // the Omni's
constexpr double kDepthMm = 60.0, kPlateauMm = 20.0;
using base::kTickS;

using Law = std::function<double(double)>;

Law our_law(std::vector<haptics::NeedleLayer> path) {
  return [path = std::move(path), law = haptics::NeedleLaw({}), track = haptics::NeedleTrack()](
             double depth_mm) mutable { return law.advance(path, depth_mm, track).axial_n; };
}

Law thesis_law(TissueClass tissue, int m) {
  return [law = ThesisNeedle(haptics::needle_tissue(tissue).intercept_n, m)](double depth_mm) mutable {
    return law.advance(depth_mm);
  };
}

double seen_mm(double depth_mm) {
  return std::round(depth_mm / kEncoderMm) * kEncoderMm;
}

int ticks(double speed_mm_s) {
  return static_cast<int>(kDepthMm / (speed_mm_s * kTickS));
}

void measure(const std::string& method, const std::function<Law()>& make, TissueClass tissue, double speed_mm_s,
             bool quick, std::vector<BenchRow>& rows) {
  BenchRow row{"haptics",
               method,
               "per tick, Omni's encoder",
               "cpu",
               "1 thread",
               volume::about(tissue).name + std::string(" at ") + bench_number(speed_mm_s) + " mm/s",
               0,
               0,
               0,
               0,
               "",
               "N rms",
               "published line (thesis 5.3.2), 20 to 60 mm"};
  const haptics::NeedleTissue& line = haptics::needle_tissue(tissue);
  double squares = 0.0, n = 0.0;
  Law law = make();
  for (int i = 0; i < ticks(speed_mm_s); ++i) {
    const double depth_mm = speed_mm_s * kTickS * i;
    const double force_n = law(seen_mm(depth_mm));
    if (depth_mm < kPlateauMm) continue;
    squares += std::pow(force_n - (line.slope_n_mm * depth_mm + line.intercept_n), 2);
    n += 1.0;
  }
  row.error = bench_number(std::sqrt(squares / n));
  double sum = 0.0;  // so that nothing is left out
  time_into(row, quick ? 3 : 31, [&] {
    law = make();
    for (int i = 0; i < ticks(speed_mm_s); ++i) sum += law(speed_mm_s * kTickS * i);
  });
  if (!std::isfinite(sum)) row.error = "nan";
  row.ms_median /= ticks(speed_mm_s);
  row.ms_min /= ticks(speed_mm_s);
  row.ms_max /= ticks(speed_mm_s);
  rows.push_back(row);
}

reports::ForceChart force_chart(TissueClass tissue) {
  constexpr double kSpeedMmS = 500.0 / 60.0;
  const haptics::NeedleTissue& line = haptics::needle_tissue(tissue);
  reports::ForceChart chart{volume::about(tissue).name, {}};
  const auto add = [&](const std::string& name, Law law) {
    reports::ForceCurve curve{name, {}};
    for (int i = 0; i < ticks(kSpeedMmS); ++i) {
      const double depth_mm = kSpeedMmS * kTickS * i;
      const double force_n = law(seen_mm(depth_mm));
      if (i % 8 == 0) curve.points.push_back({depth_mm, force_n});
    }
    chart.curves.push_back(std::move(curve));
  };
  add("thesis F1, m 50", thesis_law(tissue, 50));
  add("needle law", our_law({{0.0, line}}));
  chart.curves.push_back({"published line",
                          {{10.0, 10.0 * line.slope_n_mm + line.intercept_n},
                           {kDepthMm, kDepthMm * line.slope_n_mm + line.intercept_n}}});
  return chart;
}

}  // namespace

base::Result<void> bench_haptics(const app::Arguments&, bool quick, std::vector<BenchRow>& rows) {
  for (const TissueClass tissue : {TissueClass::kidney, TissueClass::liver})
    for (const double speed_mm_s : {1.0, 500.0 / 60.0, 100.0}) {
      measure(
          "needle law",
          [&] {
            return our_law({{0.0, haptics::needle_tissue(tissue)}});
          },
          tissue, speed_mm_s, quick, rows);
      for (const int m : {1, 10, 50})
        measure(
            "thesis F1, m " + std::to_string(m), [&] { return thesis_law(tissue, m); }, tissue, speed_mm_s, quick,
            rows);
    }
  if (auto done = bench_servo(quick, rows); !done) return done.error();
  bench_touch(quick, rows);
  return {};
}

std::string force_depth_page() {
  return reports::force_page("Force of a Chiba needle against depth, 500 mm/min, through an encoder of 55 µm",
                             {force_chart(TissueClass::kidney), force_chart(TissueClass::liver)});
}

}  // namespace seldinger::measure
