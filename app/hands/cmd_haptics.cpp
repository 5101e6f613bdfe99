// haptics insert: force against depth of a needle in one tissue, without hardware. haptics needles: the same of
// every form of tip, drawn. haptics fit: the way back, from a measured curve to a tissue's row. haptics selftest:
// does the servo keep time here?
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/csv.h"
#include "app/cli/file.h"
#include "app/cli/words.h"
#include "app/hands/fit_answer.h"
#include "app/hands/servo_answer.h"
#include "app/hands/servo_trial.h"
#include "reports/charts/force_page.h"
#include "sim/engine/servo_loop.h"
#include "sim/haptics/needle/insertion.h"
#include "sim/volume/classes.h"

namespace seldinger::app {
namespace {

// A day of samples makes no file that anyone reads.
constexpr double kMostSamples = 5e6;

// The row of a class that a needle can be driven into.
const haptics::NeedleTissueRow& tissue_named(const std::string& name) {
  std::string known;
  for (const haptics::NeedleTissueRow& row : haptics::needle_tissues()) {
    if (!(row.needle.rupture_n > 0.0)) continue;
    if (name == volume::about(row.tissue).name) return row;
    known += std::string(known.empty() ? "" : ", ") + volume::about(row.tissue).name;
  }
  throw UsageError("--tissue is one of " + known);
}

// A machine that others share misses this much under load (measured with SCHED_FIFO: 4-5 %); an idle one of its
// own should be asked for less.
constexpr double kMostMissedShare = 0.05;

// Beyond these no hand moves and no needle reaches (design).
constexpr double kMostSpeedMmS = 1000.0, kMostDepthMm = 400.0;

double positive(const Arguments& arguments, const char* option, double most) {
  arguments.required(option);
  const double value = arguments.number(option, 0.0);
  if (!(value > 0.0 && value <= most))
    throw UsageError(std::string(option) + " is above 0 and at most " + std::to_string(std::lround(most)));
  return value;
}

// The option takes the names of the table and no others.
template <typename Value, std::size_t n>
Value named(const Arguments& arguments, const char* option, const base::Names<Value, n>& names) {
  return base::from_name(names, arguments.text(option)).value_or(names.front().value);
}

cases::Gauge gauge_in(const Arguments& arguments) {
  return *cases::gauge(static_cast<int>(arguments.whole("--gauge", haptics::kTableGauge, 16, 25)));
}

double introducer_in(const Arguments& arguments) {
  return arguments.number("--introducer-mm", 0.0, 0.0, kMostDepthMm);
}

int run_haptics_insert(const Arguments& arguments) {
  const std::string out = arguments.required("--out");
  const haptics::NeedleTissue& row = tissue_named(arguments.required("--tissue")).needle;
  const cases::Touch touch{named(arguments, "--tip", cases::kNeedleTipNames),
                           named(arguments, "--touch", cases::kTouchLawNames)};
  haptics::Insertion insertion{haptics::felt_by(row, gauge_in(arguments), touch),
                               positive(arguments, "--speed-mm-s", kMostSpeedMmS),
                               positive(arguments, "--depth-mm", kMostDepthMm),
                               arguments.number("--hold-s", 0.0),
                               arguments.has("--retract"),
                               introducer_in(arguments)};
  if (!(insertion.hold_s >= 0.0)) throw UsageError("--hold-s must not be below 0");
  haptics::NeedleSettings settings = haptics::of_law(haptics::NeedleSettings{}, touch.law);
  settings.relaxation = settings.relaxation || arguments.has("--relaxation");
  if (!(haptics::insertion_samples(insertion, settings) <= kMostSamples))
    return refuse({"too_long", "the insertion takes more than 5,000,000 samples of 1 ms", {}});

  std::string csv = "t_s,depth_mm,force_axial_n\n";
  for (const haptics::InsertionSample& sample : haptics::insert(insertion, settings)) {
    char line[96];
    std::snprintf(line, sizeof line, "%.3f,%.6f,%.6f\n", sample.t_s, sample.depth_mm, sample.force.axial_n);
    csv += line;
  }
  write_file(out, csv);
  return kDone;
}

int run_haptics_needles(const Arguments& arguments) {
  const auto& tissue = tissue_named(arguments.required("--tissue"));
  const std::string out = arguments.required("--out");
  const double speed_mm_s =
      arguments.number("--speed-mm-s", haptics::kRowSpeedMmS, haptics::kSlowestMmS, kMostSpeedMmS);
  const cases::Gauge gauge = gauge_in(arguments);
  constexpr double kDrawnDepthMm = 60.0;
  constexpr std::size_t kDrawnPoints = 400;
  const haptics::NeedleSettings settings = haptics::of_law(haptics::NeedleSettings{}, cases::kNewestTouchLaw);
  reports::ForceChart chart{volume::about(tissue.tissue).name, {}};
  for (const haptics::NeedleTipRow& tip : haptics::needle_tips()) {
    const haptics::NeedleTissue felt = haptics::felt_by(tissue.needle, gauge, {tip.tip, cases::kNewestTouchLaw});
    const auto samples = haptics::insert({felt, speed_mm_s, kDrawnDepthMm}, settings);
    reports::ForceCurve curve{std::string(base::name_of(cases::kNeedleTipNames, tip.tip)), {}};
    double opened_n = 0.0;
    const std::size_t each = 1 + samples.size() / kDrawnPoints;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (samples[i].force.ruptured && opened_n == 0.0) opened_n = samples[i - 1].force.axial_n;
      if (i % each == 0) curve.points.push_back({samples[i].depth_mm, samples[i].force.axial_n});
    }
    char opens[32] = "no capsule";
    if (opened_n > 0.0) std::snprintf(opens, sizeof opens, "opens at %.2f N", opened_n);
    std::printf("%-8s %s, %.2f N at %.0f mm: %s\n", curve.name.c_str(), opens, samples.back().force.axial_n,
                kDrawnDepthMm, tip.provenance);
    chart.curves.push_back(std::move(curve));
  }
  char title[96];
  std::snprintf(title, sizeof title, "Force of needles of %d G against depth, %.3g mm/s", gauge.number, speed_mm_s);
  write_file(out, reports::force_page(title, {std::move(chart)}));
  return kDone;
}

int run_haptics_fit(const Arguments& arguments) {
  const std::filesystem::path from = arguments.positional(0);
  const auto& like = tissue_named(arguments.text("--tissue", "soft_tissue"));
  const cases::Gauge gauge = gauge_in(arguments);
  const auto gaussians =
      static_cast<int>(arguments.whole("--gaussians", haptics::kThesisGaussians, 1, haptics::kMostGaussians));
  const auto text = read_text_of(arguments, "FILE.csv");
  if (!text) return refuse(text.error());
  constexpr const char* kColumns[] = {"depth_mm", "force_axial_n"};
  const auto rows = rows_in_csv(*text, kColumns);
  if (!rows) return refuse(rows.error());
  std::vector<haptics::DepthForce> measured;
  for (std::size_t i = 0; i < rows->size(); ++i) measured.push_back({rows->row(i)[0], rows->row(i)[1]});
  auto curve = haptics::insertion_in(measured);
  if (!curve) return refuse(curve.error());
  const auto plateau = haptics::fit_plateau(*curve);
  if (!plateau) return refuse(plateau.error());
  auto by_gaussians = haptics::fit_gaussians(*curve, gaussians);
  const FitAnswer answer{std::move(*curve),         *plateau, std::move(by_gaussians), like, gauge,
                         arguments.text("--source")};

  auto beside = from;
  const std::string page = arguments.text("--out", beside.replace_extension(".fit.html").string());
  write_file(page, page_of_fit(answer));
  if (arguments.has("--json"))
    std::fputs(json_of_fit(answer).c_str(), stdout);
  else
    std::printf("%s\nResiduals: %s\n", text_of_fit(answer).c_str(), page.c_str());
  return kDone;
}

int run_haptics_selftest(const Arguments& arguments) {
  const double seconds = arguments.number("--seconds", 10.0);
  if (!(seconds > 0.0 && seconds <= 3600.0))
    throw UsageError("--seconds is above 0 and at most 3600, not " + shown(arguments.text("--seconds")));
  ServoAnswer answer;
  answer.most_missed_share = arguments.number("--most-missed", kMostMissedShare, 0.0, 1.0);
  constexpr double kSkinDecimation = 0.7;  // as import's
  const auto torso = torso_under_hands(kSkinDecimation);
  if (!torso) return refuse(torso.error());
  const haptics::TwoHands hands(torso->scene, haptics::two_virtual_arms());
  HandsAtWork work(torso->plan, haptics::Handedness::right);
  haptics::HandStates states{};
  engine::ServoLoop loop({}, [&](double elapsed_s) {
    const haptics::HandInputs inputs = work.next();
    const haptics::HandForces forces = hands.advance(inputs, elapsed_s, states);
    for (std::size_t side = 0; side < forces.size(); ++side) {
      double& most_n = inputs[side].tool == haptics::Tool::needle ? answer.most_needle_n : answer.most_probe_n;
      most_n = std::max(most_n, glm::length(forces[side].motor_n));
      answer.ruptures += forces[side].ruptured ? 1U : 0U;
    }
  });
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  loop.stop();
  answer.record = loop.record();
  std::fputs((arguments.has("--json") ? json_of_servo(answer) : text_of_servo(answer)).c_str(), stdout);
  return answer.holds() ? kDone : kCheckFailed;
}

constexpr Option kInsertOptions[] = {
    {"--tissue", "kidney|liver|muscle|fat|skin|…", "a half space of this tissue, behind its capsule"},
    {"--speed-mm-s", "V", "the needle's speed"},
    {"--depth-mm", "D", "how deep, from first touching the undeformed capsule"},
    {"--hold-s", "T", "rest at that depth; default 0"},
    {"--retract", nullptr, "then pull back to depth 0"},
    {"--gauge", "G", "16 to 25; default 22"},
    {"--relaxation", nullptr, "held tissue relaxes"},
    {"--touch", base::kAlternatives<cases::kTouchLawNames>,
     "the law of touch; default steady, the same at any speed. by_speed: the faster the needle, the less force "
     "opens a capsule, and held tissue relaxes. organs_move: as by_speed; the movement is seen, not felt"},
    {"--tip", base::kAlternatives<cases::kNeedleTipNames>,
     "its shape, which matters with every law but steady; default bevel"},
    {"--introducer-mm", "D", "it goes through an introducer that ends at this depth; default none"},
    {"--out", "FILE.csv", "t_s, depth_mm, force_axial_n (> 0 resists insertion), one row per ms"}};

constexpr Option kNeedlesOptions[] = {
    {"--tissue", "kidney|liver|muscle|fat|skin|…", "a half space of this tissue, behind its capsule"},
    {"--gauge", "G", "16 to 25; default 22"},
    {"--speed-mm-s", "V", "speed of each needle; default 8.33 (the thesis' 500 mm/min)"},
    {"--out", "FILE.html", "the chart"}};

constexpr Option kSelftestOptions[] = {
    {"--seconds", "S", "how long; default 10"},
    {"--most-missed", "SHARE", "share of ticks that may be missed; default 0.05, for a shared machine"},
    kJson};

constexpr Option kFitOptions[] = {
    {"--tissue", "kidney|liver|muscle|fat|skin|…", "the row's class; default soft_tissue"},
    {"--gauge", "G", "the needle it was measured with, 16 to 25; default 22. The row is for 22"},
    {"--gaussians", "K", "1 to 12; default 8 (thesis eq. 5.1)"},
    {"--source", "TEXT", "where the curve was measured; stored in the row"},
    {"--out", "FILE.html", "curve, models and residuals; default FILE.fit.html beside FILE.csv"},
    kJson};

}  // namespace

Command haptics_insert_command() {
  return {.name = "haptics insert",
          .options = kInsertOptions,
          .summary = "Drives a needle into one tissue and writes its force against depth.",
          .run = &run_haptics_insert};
}

Command haptics_needles_command() {
  return {.name = "haptics needles",
          .options = kNeedlesOptions,
          .summary =
              "Draws force against depth for every tip shape in one tissue, and says where its numbers come from.",
          .run = &run_haptics_needles};
}

Command haptics_fit_command() {
  return {.name = "haptics fit",
          .positionals = "FILE.csv",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kFitOptions,
          .summary =
              "Fits a plateau behind a capsule, and a sum of Gaussians, to a measured insertion: columns depth_mm, "
              "from the touch, and force_axial_n, > 0 resists.",
          .run = &run_haptics_fit};
}

Command haptics_selftest_command() {
  return {
      .name = "haptics selftest",
      .options = kSelftestOptions,
      .summary =
          "Runs the 1 kHz servo with two virtual devices on the built-in torso; 1 when it misses too many ticks.",
      .run = &run_haptics_selftest};
}

}  // namespace seldinger::app
