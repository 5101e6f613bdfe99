#include "app/measure/stability/stability_answer.h"

#include <algorithm>
#include <cstdio>
#include <vector>

namespace seldinger::measure {
namespace {

template <typename... Values>
std::string formatted(const char* format, Values... values) {
  char text[512];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

constexpr const char* kHead = R"(# Stability of what the hand feels

Written by `seldinger haptics stability`, which measures it on a bench of hand and device without hardware: steps of 10 µs, a
force each 1 ms, encoder, dry friction and delay (sim/haptics/hand_rig.h). A sampled wall can be felt without a limit cycle
when K ≤ (b + B) / (T/2 + td): K its stiffness, B its damping, b the device's own, T the tick, td the delay (Colgate and Schenkel
1994; with delay Gil 2009, Hulin 2013). Every device takes its K from this bound divided by 1.4, for its own delay.

)";

std::string devices_table() {
  std::string text =
      "## Devices\n\n| device | mass, kg | dry friction, N | encoder, µm | delay, ms | bound, N/mm | our K, N/mm | "
      "numbers from |\n|---|---|---|---|---|---|---|---|\n";
  for (const haptics::ArmModel& device : haptics::arm_models())
    text += formatted("| %s | %.3f | %.2f | %.0f | %d | %.3f | %.3f | %s |\n", device.name, device.mass_kg,
                      device.coulomb_n, 1000.0 * device.encoder_mm, device.delay_ticks,
                      haptics::stiffness_bound_n_mm(device.damping_n_s_mm + haptics::kWallDampingNSMm,
                                                    haptics::kTickS, device.delay_ticks * haptics::kTickS),
                      haptics::stiffness_n_mm(device), device.provenance);
  return text;
}

bool same_trial(const RestRow& a, const RestRow& b) {
  return a.device.name == b.device.name && a.device.coulomb_n == b.device.coulomb_n &&
         a.device.delay_ticks == b.device.delay_ticks;
}

// The longest of a device's situations under one hand.
std::string longest(const std::vector<RestRow>& rows, const RestRow& rig, const haptics::Hand& hand) {
  double rest_s = 0.0;
  bool holds = true;
  for (const RestRow& row : rows) {
    if (!same_trial(row, rig) || row.hand.name != hand.name) continue;
    rest_s = std::max(rest_s, row.settling.rest_s);
    holds = holds && row.holds();
  }
  return holds ? formatted("%.2f", rest_s) : "**never**";
}

std::string rest_table(const StabilitySurvey& survey) {
  std::string text =
      "\n## Needle and probe at rest\n\nThe tool is brought somewhere, then left to a hand that pushes on with 1 N "
      "(sideways 0.1 N), or to none: ";
  for (std::size_t i = 0; i < survey.rest.size() && same_trial(survey.rest[i], survey.rest[0]) &&
                          survey.rest[i].hand.name == survey.rest[0].hand.name;
       ++i)
    text += std::string(i == 0 ? "" : "; ") + survey.rest[i].situation;
  text +=
      ". The time in s until it stays within one count of the encoder, the longest of these. **never**: it moves "
      "by "
      "more or its force by 0.1 N after 3 s, it gives more than 1 mJ, or its force steps by more than 0.15 N in a "
      "tick.\n\n| device | dry friction, N | delay, ms |";
  std::string line = "|---|---|---|";
  for (const haptics::Hand& hand : haptics::hands()) {
    text += std::string(" ") + hand.name + " |";
    line += "---|";
  }
  text += "\n" + line + "\n";
  const RestRow* last = nullptr;
  for (const RestRow& row : survey.rest) {
    if (last != nullptr && same_trial(row, *last)) continue;
    last = &row;
    text += formatted("| %s | %.2f | %d |", row.device.name, row.device.coulomb_n, row.device.delay_ticks);
    for (const haptics::Hand& hand : haptics::hands())
      text.append(" ").append(longest(survey.rest, row, hand)).append(" |");
    text += "\n";
  }
  return text;
}

std::string margin_table(const StabilitySurvey& survey) {
  std::string text = formatted(
      "\nThe same, let go, dry friction %.2f N, with all stiffness multiplied: the largest factor at which it "
      "still "
      "rests, of 1, 1.2, 1.4, 1.7, 2, 2.4, 3 and 4, and where it fails first beyond.\n\n| device | delay, ms | our "
      "K, "
      "N/mm | rests up to | fails then |\n|---|---|---|---|---|\n",
      kLeastCoulombN);
  for (const MarginRow& row : survey.margins)
    text +=
        formatted("| %s | %d | %.3f | %.1f | %s |\n", row.device.name, row.device.delay_ticks,
                  haptics::stiffness_n_mm(row.device), row.rests_at, row.fails == nullptr ? "nowhere" : row.fails);
  return text;
}

std::string driven_table(const StabilitySurvey& survey) {
  std::string text = formatted(
      "\n## The needle driven on\n\nA hand drives it through kidney at 500 mm/min on the %s. Standard deviation of "
      "the "
      "motors' force from a straight line over 2 s, in N; the thesis' law F1 is tuned to its own plateau at this "
      "speed.\n\n| hand | ours |",
      haptics::arm_models()[0].name);
  std::string line = "|---|---|";
  for (const int m : kThesisMeans) {
    text += formatted(" thesis, m = %d |", m);
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (const DrivenRow& row : survey.driven) {
    text += formatted("| %s | %.3f |", row.hand.name, row.ours_n);
    for (const double thesis_n : row.thesis_n) text += formatted(" %.2f |", thesis_n);
    text += "\n";
  }
  return text;
}

char sign(const WallCell& cell) {
  if (cell.settles) return cell.stiffness_n_mm <= cell.bound_n_mm ? '.' : 'o';
  return cell.stiffness_n_mm <= cell.bound_n_mm / haptics::kStiffnessMargin
             ? '!'
             : (cell.stiffness_n_mm <= cell.bound_n_mm ? '?' : 'x');
}

std::string map_of(const WallMap& map) {
  std::string text = formatted("\n%s, dry friction %.2f N, hand %s:\n\n```\ndelay   B N s/m | K N/mm",
                               map.device.name, map.device.coulomb_n, map.hand.name);
  for (const double stiffness : kMapStiffnessNMm) text += formatted(" %4.4g", stiffness);
  text += "   bound\n";
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    const WallCell& cell = map.cells[i];
    if (i % std::size(kMapStiffnessNMm) == 0)
      text += formatted("%d ms    %7.1f |       ", cell.delay_ticks, 1000.0 * cell.damping_n_s_mm);
    text += formatted("    %c", sign(cell));
    if ((i + 1) % std::size(kMapStiffnessNMm) == 0) text += formatted("   %.3f\n", cell.bound_n_mm);
  }
  return text + "```\n";
}

std::string failures(const StabilitySurvey& survey) {
  std::string text = "\n## Where each law fails\n\n";
  const auto failed = static_cast<int>(
      std::count_if(survey.rest.begin(), survey.rest.end(), [](const RestRow& row) { return !row.holds(); }));
  text += formatted("- Our laws of needle and probe: in %d of %d trials at rest.\n", failed,
                    static_cast<int>(survey.rest.size()));
  for (const RestRow& row : survey.rest)
    if (!row.holds())
      text += formatted("  - %s, dry friction %.2f N, delay %d ms, hand %s: %s\n", row.device.name,
                        row.device.coulomb_n, row.device.delay_ticks, row.hand.name, row.situation);
  double least_n = survey.driven.empty() ? 0.0 : survey.driven[0].thesis_n[0];
  for (const DrivenRow& row : survey.driven)
    for (const double thesis_n : row.thesis_n) least_n = std::min(least_n, thesis_n);
  text += formatted("- The thesis' law: driven on, under every hand; its force never varies by less than %.2f N.\n",
                    least_n);
  for (const WallMap& map : survey.maps) {
    int above = 0, within = 0;
    std::string which;
    for (const WallCell& cell : map.cells) {
      if (cell.settles) continue;
      ++(cell.stiffness_n_mm <= cell.bound_n_mm ? within : above);
      if (cell.stiffness_n_mm <= cell.bound_n_mm / haptics::kStiffnessMargin)
        which += formatted("%s%.4g N/mm with %.1f N s/m at %d ms", which.empty() ? "" : ", ", cell.stiffness_n_mm,
                           1000.0 * cell.damping_n_s_mm, cell.delay_ticks);
    }
    text += formatted(
        "- The plain wall, dry friction %.2f N: %d walls above the bound, %d between bound / 1.4 and bound; "
        "below that: ",
        map.device.coulomb_n, above,
        within - static_cast<int>(std::count_if(map.cells.begin(), map.cells.end(),
                                                [](const auto& cell) { return sign(cell) == '!'; })));
    text += (which.empty() ? "none" : which + ", the damper behind its low-pass") + ".\n";
  }
  return text;
}

}  // namespace

std::string markdown_of_stability(const StabilitySurvey& survey) {
  std::string text = kHead + devices_table() + rest_table(survey) + margin_table(survey) + driven_table(survey);
  text +=
      "\n## Walls\n\nA plain wall, its damper behind a low-pass of 100 Hz, struck at 100 mm/s and pushed on by 1 "
      "N. `.` "
      "rests within the bound, `o` rests above it (dry friction helps), `x` cycles above it, `?` cycles between "
      "bound / "
      "1.4 and bound, `!` cycles below bound / 1.4.\n";
  for (const WallMap& map : survey.maps) text += map_of(map);
  return text + failures(survey);
}

}  // namespace seldinger::measure
