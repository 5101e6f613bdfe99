#include "app/hands/device_words.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "app/hands/formatted.h"

namespace seldinger::app {
namespace {

using devices::CheckStep;
using devices::PushFound;

constexpr std::array<const char*, devices::kTemplatePoints> kWhere = {
    "the cross, its left end", "the cross, its right end",        "the cross, its far end",
    "the cross, its near end", "the cross, where its lines meet", "the box, anywhere on its top"};
constexpr std::array<const char*, 6> kAlong = {"+x", "−x", "+y", "−y", "+z", "−z"};

double late_ms(const devices::ArmCheck& check) {
  return 1e-6 * static_cast<double>(check.lateness().quantile_ns(0.99));
}

CheckLine line(bool known, bool holds, std::string words) {
  return {!known  ? CheckLine::State::open
          : holds ? CheckLine::State::holds
                  : CheckLine::State::fails,
          std::move(words)};
}

bool names(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

std::string arm_words(const ArmSeen& arm, const devices::HaplyIds& ids, const devices::HaplyStatus& status) {
  if (!status.connected) return "no service answers";
  if (ids.arm.empty()) return "there is no arm for this hand";
  const std::string who = "arm " + ids.arm + (ids.grip.empty() ? "" : ", grip " + ids.grip);
  if (!names(status.arms, ids.arm)) return who + ": the service does not report this arm";
  if (ids.grip.empty() || !names(status.grips, ids.grip))
    return who + ": its grip does not answer; is it switched on?";
  if (!arm.reading.healthy) return who + ": silent";
  return who + formatted(": well, %.0f readings/s, %.1f ms from force to answer", arm.readings_per_s,
                         1e3 * arm.reading.round_trip_s);
}

std::string check_asks(const devices::ArmCheck& check) {
  switch (check.step()) {
    case CheckStep::answer:
      return "Waiting for the arm to answer …";
    case CheckStep::reach:
      return formatted(
          "Move the stylus as far as it goes: left and right, up and down, near and far. It must reach %.0f mm "
          "each way. Space continues with less.",
          devices::kCheckReachMm);
    case CheckStep::push:
      return formatted(
          "Hold the stylus loosely and still. The arm pushes gently, with %.0f N, along each of its axes: push %zu "
          "of 6 is next, along %s.",
          devices::kCheckForceN, check.pushing() + 1, kAlong[std::min<std::size_t>(check.pushing(), 5)]);
    case CheckStep::done:
      return check.holds() ? "This arm is fit for an attempt." : "This arm is not fit for an attempt.";
  }
  return "";
}

std::vector<CheckLine> check_lines(const devices::ArmCheck& check) {
  const bool done = check.step() == CheckStep::done;
  std::vector<CheckLine> lines;
  lines.push_back(line(done || check.answered(), check.answered(), check.answered() ? "It answers" : "No answer"));
  const glm::dvec3 reach = check.reached_mm();
  lines.push_back(line(done || check.step() == CheckStep::push || check.reach_holds(), check.reach_holds(),
                       formatted("Reached %.0f × %.0f × %.0f mm of %.0f each way", reach.x, reach.y, reach.z,
                                 devices::kCheckReachMm)));
  std::string still, wrong, untried;
  for (std::size_t i = 0; i < check.pushes().size(); ++i) {
    if (check.pushes()[i] == PushFound::not_yet) untried += std::string(" ") + kAlong[i];
    if (check.pushes()[i] == PushFound::still) still += std::string(" ") + kAlong[i];
    if (check.pushes()[i] == PushFound::wrong_way) wrong += std::string(" ") + kAlong[i];
  }
  std::string pushes = "Pushes in the right direction";
  if (done && !untried.empty()) pushes = "Not tried along" + untried;
  if (!still.empty()) pushes = "Does not push along" + still + ": held too fast, or a motor is off";
  if (!wrong.empty())
    pushes = "Pushes in the wrong direction along" + wrong + (still.empty() ? "" : "; none along" + still);
  lines.push_back(line(done || !still.empty() || !wrong.empty(), done && check.pushes_hold(), pushes));
  lines.push_back(line(done, check.lateness_holds(),
                       check.lateness().n == 0
                           ? "From force to answer: nothing measured"
                           : formatted("From force to answer %.1f ms in 99 of 100, at most %.1f", late_ms(check),
                                       1e3 * devices::kCheckLateS)));
  lines.push_back(line(done, check.lost() == 0,
                       check.lost() == 0 ? std::string("Was never lost")
                                         : formatted(check.lost() == 1 ? "Was lost once" : "Was lost %llu times",
                                                     static_cast<unsigned long long>(check.lost()))));
  return lines;
}

std::string point_words(std::size_t point) {
  return std::string(devices::template_points()[point].name) + ": " + kWhere.at(point);
}

std::string taking_asks(const devices::PointTaking& taking) {
  const auto asked = taking.asked();
  if (!asked) return "All points are taken.";
  if (taking.state() == devices::Taking::reading) return "Hold it still …";
  std::string words;
  if (taking.state() == devices::Taking::moved) words = "It moved during the reading. ";
  if (taking.state() == devices::Taking::lost) words = "The arm did not answer. ";
  return words + "Put the stylus' tip on " + point_words(*asked) +
         ", hold it still, and press its button (or Space).";
}

std::string calibration_words(const base::Result<devices::Calibration>& calibration) {
  if (calibration) {
    std::string words =
        formatted("Good: off by at most %.2f mm (%.2f rms); %.0f allowed. By point:", calibration->residual_max_mm,
                  calibration->residual_rms_mm, devices::kMostResidualMm);
    for (const devices::Calibration::Point& point : calibration->points)
      words += formatted(" %s %.2f", point.taken.name.c_str(), point.residual_mm);
    return words + ".";
  }
  std::string words = "Refused: " + calibration.error().text;
  for (const base::Problem& finding : calibration.error().findings) words += "; " + finding.text;
  return words + ".";
}

}  // namespace seldinger::app
