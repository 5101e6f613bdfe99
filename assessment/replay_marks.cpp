#include "assessment/replay_marks.h"

#include <algorithm>
#include <string_view>

#include "assessment/fault_moments.h"
#include "assessment/metrics/tables.h"
#include "assessment/moments.h"

namespace seldinger::assessment {
namespace {

// Of fault_moments, what speaks against an attempt whatever its rule asks; pain is among the events.
constexpr std::string_view kAgainst[] = {"nogo_contacts", "posterior_wall", "hand_in_beam", "advance_beyond_plane"};

bool pain(cases::EventKind kind) {
  return kind == cases::EventKind::pain_skin || kind == cases::EventKind::pain_bone;
}

std::string sentence(std::string words) {
  if (!words.empty() && words.front() >= 'a' && words.front() <= 'z')
    words.front() = static_cast<char>(words.front() - 'a' + 'A');
  return words;
}

}  // namespace

std::vector<ReplayMark> replay_marks(const Signals& signals) {
  std::vector<ReplayMark> marks;
  if (signals.poses.empty()) return marks;
  for (const Moment& moment : telling_moments(signals)) {
    if (moment.kind == MomentKind::between || moment.kind == MomentKind::end) continue;
    marks.push_back(
        {moment.t_s, words_for(moment.kind, signals.setting.modality), moment.kind == MomentKind::blind_run});
  }
  for (const cases::Event& event : signals.events.value_or(std::vector<cases::Event>{})) {
    const cases::EventInfo* info = cases::find_event(event.kind);
    if (info == nullptr || info->source == cases::EventSource::workstation) continue;
    marks.push_back({event.t_s, sentence(info->words), pain(event.kind)});
  }
  for (const FaultMoment& fault : fault_moments(signals))
    if (std::find(std::begin(kAgainst), std::end(kAgainst), fault.metric) != std::end(kAgainst))
      marks.push_back({fault.t_s, sentence(fault.words), true});
  std::stable_sort(marks.begin(), marks.end(),
                   [](const ReplayMark& a, const ReplayMark& b) { return a.t_s < b.t_s; });
  return marks;
}

std::string words_at(const std::vector<ReplayMark>& marks, double t_s, double within_s) {
  std::string words;
  for (const ReplayMark& mark : marks)
    if (mark.t_s <= t_s && t_s < mark.t_s + within_s) words += (words.empty() ? "" : " · ") + mark.words;
  return words;
}

std::optional<double> first_puncture_s(const Signals& signals) {
  return count_punctures(signals).first_s;
}

}  // namespace seldinger::assessment
