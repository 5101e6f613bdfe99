#include "assessment/grading/rule.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "assessment/metrics/registry.h"

namespace seldinger::assessment {
namespace {

constexpr std::string_view kSigns[] = {"<=", ">=", "="};  // in the order of Comparison

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::string number_text(double value) {
  char buffer[40];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value).ptr;
  return {buffer, end};
}

// A ball of skin, 200 mm wide, about the origin.
cases::Mesh ball() {
  cases::Mesh mesh;
  constexpr float kRadius = 100.0F;
  mesh.vertices_lps_mm = {{kRadius, 0, 0},  {-kRadius, 0, 0}, {0, kRadius, 0},
                          {0, -kRadius, 0}, {0, 0, kRadius},  {0, 0, -kRadius}};
  mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  mesh.cut.assign(mesh.triangles.size(), 0);
  return mesh;
}

// An attempt in which all goes as it should, so that a metric without a value has none because of the guidance.
cases::Recording good_attempt(cases::Modality modality) {
  cases::Recording recording;
  constexpr double kSeconds = 12.0;
  for (int i = 0; i <= 1200; ++i) {
    const double t_s = 0.01 * i;
    recording.poses.push_back(
        {t_s, {0.0, 0.0, -130.0 + 130.0 * t_s / kSeconds}, {0, 0, 1}, {0, 0, -100}, {0, 0, 1}, {1, 0, 0}});
  }
  for (int i = 0; i <= 360; ++i) {
    cases::FrameTruth frame;
    frame.t_s = i / 30.0;
    frame.live = frame.needle_tip = frame.target = true;
    frame.needle_length_mm = 30.0;
    if (modality == cases::Modality::ultrasound) frame.near_plane = cases::NearPlane{true, true, true, true};
    if (modality == cases::Modality::xray) {
      cases::BeamTruth beam;
      beam.beam_s = 1.0 / 30.0;
      beam.lao_deg = i < 180 ? 0.0 : 50.0;
      frame.beam = beam;
    }
    recording.frames.push_back(frame);
  }
  recording.endpoint = cases::Endpoint{kSeconds, {0, 0, 0}, {0, 0, 1}};
  return recording;
}

// Reasons that begin so tell that the metric is of another guidance, approach or instrument.
bool is_of_another(const MetricValue& value) {
  return !value.value && value.reason.rfind("not_", 0) == 0;
}

}  // namespace

std::string_view sign_of(Comparison comparison) noexcept {
  return kSigns[static_cast<std::size_t>(comparison)];
}

std::optional<Comparison> comparison_from(std::string_view sign) noexcept {
  for (std::size_t i = 0; i < std::size(kSigns); ++i)
    if (kSigns[i] == sign) return static_cast<Comparison>(i);
  return std::nullopt;
}

std::string text_of(const Criterion& criterion) {
  std::string text = criterion.metric;
  if (criterion.version != 1) text.append("@").append(std::to_string(criterion.version));
  return text.append(" ").append(sign_of(criterion.comparison)).append(" ").append(number_text(criterion.value));
}

std::optional<Criterion> criterion_from(std::string_view text) {
  for (const std::string_view sign : kSigns) {
    const std::size_t at = text.find(sign);
    if (at == text.npos) continue;
    Criterion criterion;
    criterion.comparison = *comparison_from(sign);
    std::string_view name = trimmed(text.substr(0, at));
    const std::string_view value = trimmed(text.substr(at + sign.size()));
    if (const std::size_t mark = name.find('@'); mark != name.npos) {
      const std::string_view version = name.substr(mark + 1);
      const auto read = std::from_chars(version.data(), version.data() + version.size(), criterion.version);
      if (read.ec != std::errc() || read.ptr != version.data() + version.size() || criterion.version < 1)
        return std::nullopt;
      name = name.substr(0, mark);
    }
    const bool is_id = !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
      return c == '_' || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9');
    });
    const auto read = std::from_chars(value.data(), value.data() + value.size(), criterion.value);
    if (!is_id || read.ec != std::errc() || read.ptr != value.data() + value.size() ||
        !std::isfinite(criterion.value))
      return std::nullopt;
    criterion.metric = name;
    return criterion;
  }
  return std::nullopt;
}

std::vector<std::string> meaningful_metrics(const Guidance& guidance) {
  const cases::MeshIndex skin(ball());
  AttemptSetting setting;
  setting.skin = &skin;
  setting.target = cases::Lesion{{0, 0, 0}, 5.0, 0.0};
  setting.instrument.kind = guidance.instrument;
  setting.modality = guidance.modality;
  setting.approach = guidance.approach;
  const auto signals = make_signals(setting, good_attempt(guidance.modality));
  std::vector<std::string> ids;
  for (const MetricValue& value : measure_all(signals.value()))
    if (!is_of_another(value)) ids.push_back(value.id);
  return ids;
}

std::vector<base::Problem> problems_of(const PassRule& rule, const Guidance& guidance) {
  std::vector<base::Problem> problems;
  const std::vector<std::string> meaningful = meaningful_metrics(guidance);
  for (std::size_t i = 0; i < rule.criteria.size(); ++i) {
    const Criterion& one = rule.criteria[i];
    const MetricInfo* info = find_metric(one.metric);
    if (info == nullptr)
      problems.push_back({"unknown_metric", "no metric is called " + one.metric});
    else if (info->version != one.version)
      problems.push_back({"other_version", one.metric + " is measured by version " + std::to_string(info->version) +
                                               ", not " + std::to_string(one.version)});
    else if (std::find(meaningful.begin(), meaningful.end(), one.metric) == meaningful.end())
      problems.push_back(
          {"not_meaningful", one.metric + " says nothing under this guidance, approach and instrument"});
    if (!std::isfinite(one.value)) problems.push_back({"not_finite", one.metric + " is compared with no number"});
    for (std::size_t other = 0; other < i; ++other)
      if (rule.criteria[other].metric == one.metric && rule.criteria[other].comparison == one.comparison) {
        problems.push_back({"twice", one.metric + " is asked for twice"});
        break;
      }
  }
  return problems;
}

}  // namespace seldinger::assessment
