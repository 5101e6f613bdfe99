#include "reports/pages/sections/beam_table.h"

#include <algorithm>
#include <cmath>

#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

constexpr double kSameDirectionDeg = 1.0;
constexpr std::size_t kMostRows = 40;

bool same_look(const cases::BeamTruth& a, const cases::BeamTruth& b) {
  if (a.arm_moving != b.arm_moving) return false;
  return a.arm_moving || (std::abs(a.lao_deg - b.lao_deg) <= kSameDirectionDeg &&
                          std::abs(a.cranial_deg - b.cranial_deg) <= kSameDirectionDeg);
}

std::string degrees(const char* positive, const char* negative, double deg) {
  return std::string(deg > 0.0 ? positive : negative) + " " + number_text(std::abs(deg), 0) + "°";
}

}  // namespace

std::vector<Look> looks_of(std::span<const cases::FrameTruth> frames) {
  std::vector<Look> looks;
  for (const cases::FrameTruth& frame : frames) {
    if (!frame.beam) continue;
    if (looks.empty() || !same_look(looks.back().last, *frame.beam)) {
      looks.emplace_back();
      looks.back().from_s = frame.t_s;
    }
    Look& look = looks.back();
    ++look.pulses;
    look.beam_s += frame.beam->beam_s;
    look.last = *frame.beam;
    look.hand_in_beam = look.hand_in_beam || frame.beam->hand_in_beam;
  }
  return looks;
}

std::string direction_text(const cases::BeamTruth& beam) {
  const bool turned = std::abs(beam.lao_deg) >= 0.5, tilted = std::abs(beam.cranial_deg) >= 0.5;
  if (!turned && !tilted) return "AP";
  std::string text = turned ? degrees("LAO", "RAO", beam.lao_deg) : "";
  if (tilted) text += (turned ? ", " : "") + degrees("cranial", "caudal", beam.cranial_deg);
  return text;
}

std::optional<std::string> image_text(std::span<const cases::FrameTruth> frames, double t_s) {
  const cases::BeamTruth* last = nullptr;
  for (const cases::FrameTruth& frame : frames)
    if (frame.beam && frame.t_s <= t_s) last = &*frame.beam;
  if (last == nullptr) return std::nullopt;
  return direction_text(*last) + ", " + number_text(last->kv, 0) + " kV, " + number_text(last->ma, 0) + " mA";
}

Html beam_table(const cases::Recording& recording) {
  const std::vector<Look> looks = looks_of(recording.frames);
  Html html;
  if (looks.empty()) return html;
  html.raw(
      "<table>\n<caption>Looks: pulses from one direction</caption>\n<thead><tr><th scope=\"col\" "
      "class=\"number\">From</th><th scope=\"col\">Direction</th><th scope=\"col\" class=\"number\">Pulses</th>"
      "<th scope=\"col\" class=\"number\">Beam</th><th scope=\"col\">Tube</th><th scope=\"col\" "
      "class=\"number\">Shut off</th><th scope=\"col\">Hand</th></tr></thead>\n<tbody>\n");
  const double t0_s = recording.poses.empty() ? 0.0 : recording.poses.front().t_s;
  for (std::size_t i = 0; i < std::min(looks.size(), kMostRows); ++i) {
    const Look& look = looks[i];
    html.raw("<tr><th scope=\"row\" class=\"number\">").text(number_text(look.from_s - t0_s, 1)).raw(" s</th><td>");
    html.text(look.last.arm_moving ? "moving" : direction_text(look.last)).raw("</td><td class=\"number\">");
    html.text(std::to_string(look.pulses)).raw("</td><td class=\"number\">").text(number_text(look.beam_s, 1));
    html.raw(" s</td><td>").text(number_text(look.last.kv, 0)).raw(" kV, ").text(number_text(look.last.ma, 0));
    html.raw(" mA</td><td class=\"number\">").text(number_text(100.0 * look.last.collimated_share, 0));
    html.raw(" %</td><td>").text(look.hand_in_beam ? "in the beam" : "").raw("</td></tr>\n");
  }
  html.raw("</tbody>\n</table>\n");
  if (looks.size() > kMostRows)
    html.raw("<p class=\"note\">").text(std::to_string(looks.size() - kMostRows)).raw(" further looks.</p>\n");
  return html;
}

}  // namespace seldinger::reports
