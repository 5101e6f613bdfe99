#include "assessment/grading/debrief.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "assessment/estimand.h"
#include "assessment/grading/phrases.h"
#include "assessment/grading/plain_words.h"
#include "assessment/grading/reason_words.h"
#include "assessment/grading/worthwhile.h"
#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

constexpr std::string_view kKinds[] = {"not_gradable", "critical_error", "missed", "not_measured",
                                       "shortfall",    "well",           "fact"};  // as SentenceKind

// What hurts a patient comes before what costs time; the recording is nobody's merit.
constexpr Group kBySeverity[] = {Group::safety, Group::procedure, Group::target, Group::picture,
                                 Group::dose,   Group::path,      Group::time,   Group::recording};

// Said where a rule asks for them, not of their own accord: variants of others, secondary by definition, or nothing
// that a trainee could do otherwise next time.
constexpr std::string_view kOnlyIfAsked[] = {"vis_shaft",
                                             "vis_joint_2_mm",
                                             "vis_joint_5_mm",
                                             "vis_joint_session",
                                             "closest_approach",
                                             "path_tip",
                                             "ldlj",
                                             "sparc",
                                             "probe_shift_advancing",
                                             "probe_turn_advancing",
                                             "force_peak_axial",
                                             "lateral_force_peak",
                                             "withdrawn_at_end"};

// Said without judging where there is neither rule nor band.
constexpr std::string_view kFacts[] = {
    "hit",        "tip_target_dist", "blind_advance", "advance_beyond_plane", "fluoroscopy_time",
    "time_total", "probe_suits"};

int severity_of(const MetricInfo& info) {
  return static_cast<int>(std::find(std::begin(kBySeverity), std::end(kBySeverity), info.group) -
                          std::begin(kBySeverity));
}

struct Candidate {
  Sentence sentence;
  std::string_view topic;
  int severity = 0;
  double by_how_much = 0.0;  // larger comes first within a kind and severity
};

bool tells_yes_or_no(std::string_view unit) {
  return unit == "bool";
}

// "; 9 consultants: 0–3 mm". Not beside a sentence that says all there is: a yes or no, or none where there should
// be none.
std::string experts_clause(const MetricBand* band, bool said_all = false) {
  if (band == nullptr || tells_yes_or_no(band->unit) || said_all) return "";
  return "; " + std::to_string(band->n) + " consultants: " + plain_range(band->low, band->high, band->unit);
}

std::string said_of(const Phrase& phrase, double value, const std::string& unit, double other, bool good) {
  const bool by_size = value < 0.0 && !phrase.negative.empty();
  const double shown = by_size ? -value : value;
  return said(phrase, value, plain_apart(shown, by_size ? -other : other, unit).first, good);
}

// "…; to pass: at most 5 mm", unless a yes or a nothing says it already.
std::string pass_clause(const CriterionResult& one) {
  if (one.critical_error()) return "; this alone fails the attempt";
  if (tells_yes_or_no(one.unit)) return "";
  return std::string(one.of_the_time_limit ? "; time limit: " : "; to pass: ") +
         limit_text(one.criterion, one.unit);
}

Candidate of_missed(const CriterionResult& one, const Phrase& phrase, const MetricInfo& info,
                    const ExpertSet& experts) {
  Candidate made{{one.critical_error() ? SentenceKind::critical_error : SentenceKind::missed, "", info.id},
                 phrase.topic,
                 severity_of(info)};
  made.sentence.text = said_of(phrase, *one.value, one.unit, one.criterion.value, false) + pass_clause(one) +
                       experts_clause(experts.find(info.id, one.criterion.version)) + ".";
  made.by_how_much = std::fabs(*one.value - one.criterion.value) / std::max(std::fabs(one.criterion.value), 1.0);
  return made;
}

Candidate of_null(const CriterionResult& one, std::string_view topic, const MetricInfo* info) {
  Candidate made{
      {SentenceKind::not_measured, "", one.criterion.metric}, topic, info == nullptr ? 0 : severity_of(*info)};
  const std::string label = info == nullptr ? one.criterion.metric : info->label;
  if (one.reason == kOtherVersion)
    made.sentence.text = "“" + label + "” was measured by a version other than the rule's: not comparable.";
  else if (one.reason == "no_endpoint")
    made.sentence.text =
        "The needle was neither fired nor declared to be on target, so the endpoint cannot be judged.";
  else
    made.sentence.text = "“" + label + "” has no value (" + reason_words(one.reason) + "), so it is not met.";
  if (one.criterion.critical) made.by_how_much = 1.0;
  return made;
}

Candidate of_met(const CriterionResult& one, const Phrase& phrase, const MetricInfo& info,
                 const ExpertSet& experts) {
  Candidate made{{SentenceKind::well, "", info.id}, phrase.topic, severity_of(info)};
  made.sentence.text =
      said_of(phrase, *one.value, one.unit, one.criterion.value, true) +
      experts_clause(experts.find(info.id, one.criterion.version), *one.value == 0.0 && !phrase.zero.empty()) + ".";
  made.by_how_much = 2.0;  // before what no criterion asks for
  if (one.criterion.critical) made.by_how_much = 3.0;
  return made;
}

// Against a band: how far on the wrong side, in widths of it; 0 inside or better. A band counts for no narrower
// than what is worth a word, so that consultants who all do the same do not make a trifle the largest shortfall.
double beyond(double value, const MetricBand& band, const MetricInfo& info) {
  const double far = info.direction == Direction::lower_is_better ? value - band.high : band.low - value;
  if (!(far > 0.0)) return 0.0;
  return far / std::max(band.high - band.low, worthwhile(info).difference);
}

// What is beside a band by less than this share of its width is neither a shortfall nor praised.
constexpr double kTrifle = 0.25;

std::optional<Candidate> of_band(double value, const MetricBand& band, const Phrase& phrase,
                                 const MetricInfo& info) {
  const double far = beyond(value, band, info);
  if (far > 0.0 && far < kTrifle) return std::nullopt;
  Candidate made{{far > 0.0 ? SentenceKind::shortfall : SentenceKind::well, "", info.id},
                 phrase.topic,
                 // Time only limits: it is the last that is held against somebody.
                 far > 0.0 ? (info.group == Group::time ? 1 : 0) : severity_of(info),
                 far > 0.0 ? far : 1.0};
  const double edge = info.direction == Direction::lower_is_better ? band.high : band.low;
  const bool said_all = far == 0.0 && value == 0.0 && !phrase.zero.empty();
  made.sentence.text = said_of(phrase, value, band.unit, edge, far == 0.0) + experts_clause(&band, said_all) + ".";
  return made;
}

std::vector<Candidate> candidates_of(const Grade& grade, const Gradable& attempt, const ExpertSet& experts) {
  std::vector<Candidate> all;
  for (const CriterionResult& one : grade.criteria) {
    const MetricInfo* info = find_metric(one.criterion.metric);
    const Phrase* phrase = find_phrase(one.criterion.metric);
    if (one.outcome == Outcome::not_measured)
      all.push_back(of_null(one, phrase == nullptr ? std::string_view("") : phrase->topic, info));
    else if (phrase != nullptr && info != nullptr && one.outcome == Outcome::missed)
      all.push_back(of_missed(one, *phrase, *info, experts));
    else if (phrase != nullptr && info != nullptr && info->group != Group::recording &&
             tells(*info, attempt.metrics))
      all.push_back(of_met(one, *phrase, *info, experts));
  }
  for (const MetricBand& band : experts.bands) {
    const MetricInfo* info = find_metric(band.id);
    const Phrase* phrase = find_phrase(band.id);
    const MetricValue* found = find_version(attempt.metrics, band.id, band.version);
    if (std::find(std::begin(kOnlyIfAsked), std::end(kOnlyIfAsked), band.id) != std::end(kOnlyIfAsked)) continue;
    if (info == nullptr || phrase == nullptr || info->direction == Direction::none || found == nullptr ||
        !found->value || !std::isfinite(*found->value) || !tells(*info, attempt.metrics))
      continue;
    if (auto one = of_band(*found->value, band, *phrase, *info)) all.push_back(std::move(*one));
  }
  for (const std::string_view id : kFacts) {
    const MetricInfo* info = find_metric(std::string(id));
    // Nothing is compared: the newest that is stored, which at a case of an older law of sight is an older one.
    const MetricValue* found = nullptr;
    for (const MetricValue& one : attempt.metrics)
      if (one.id == id && (found == nullptr || one.version > found->version)) found = &one;
    if (found == nullptr || !found->value || !std::isfinite(*found->value)) continue;
    const Phrase& phrase = *find_phrase(id);
    Candidate made{{SentenceKind::fact, "", std::string(id)}, phrase.topic};
    made.sentence.text = said_of(phrase, *found->value, info->unit, *found->value, false) + ".";
    all.push_back(std::move(made));
  }
  std::stable_sort(all.begin(), all.end(), [](const Candidate& a, const Candidate& b) {
    if (a.sentence.kind != b.sentence.kind) return a.sentence.kind < b.sentence.kind;
    if (a.severity != b.severity) return a.severity < b.severity;
    return a.by_how_much > b.by_how_much;
  });
  return all;
}

bool is_good(const Candidate& one) {
  return one.sentence.kind == SentenceKind::well || one.sentence.kind == SentenceKind::fact;
}

}  // namespace

std::string_view name_of(SentenceKind kind) noexcept {
  return kKinds[static_cast<std::size_t>(kind)];
}

std::string limit_text(const Criterion& criterion, std::string_view unit) {
  constexpr std::string_view kWords[] = {"at most ", "at least ", "exactly "};  // as Comparison
  if (tells_yes_or_no(unit)) return criterion.value != 0.0 ? "yes" : "no";
  const MetricInfo* info = find_metric(criterion.metric);
  const bool least = info != nullptr && info->estimand.scale != Scale::interval;  // nothing is below 0
  if (least && criterion.value == 0.0 && criterion.comparison != Comparison::at_least) return "none";
  return std::string(kWords[static_cast<std::size_t>(criterion.comparison)]) + plain_value(criterion.value, unit);
}

std::string not_gradable_text(std::string_view reason) {
  return "This attempt is not graded: " + reason_words(reason) + ".";
}

std::vector<Sentence> debrief(const Grade& grade, const Gradable& attempt, const ExpertSet& set) {
  const ExpertSet nobody;
  const ExpertSet& experts = set.standard() ? set : nobody;
  if (!grade.reason.empty()) return {{SentenceKind::not_gradable, not_gradable_text(grade.reason), ""}};
  const std::vector<Candidate> all = candidates_of(grade, attempt, experts);
  std::vector<std::size_t> chosen;
  const auto clashes = [&](const Candidate& one, bool by_topic) {
    return std::any_of(chosen.begin(), chosen.end(), [&](std::size_t i) {
      const Candidate& other = all[i];
      if (one.sentence.metric_id == other.sentence.metric_id || one.sentence.text == other.sentence.text)
        return true;
      // Nothing of a topic is praised beside what went wrong in it.
      return one.topic == other.topic && (by_topic || (is_good(one) && !is_good(other)));
    });
  };
  for (const bool by_topic : {true, false})
    for (std::size_t i = 0; i < all.size() && chosen.size() < kSentences; ++i)
      if (!clashes(all[i], by_topic)) chosen.push_back(i);
  std::sort(chosen.begin(), chosen.end());
  std::vector<Sentence> sentences;
  for (const std::size_t i : chosen) sentences.push_back(all[i].sentence);
  return sentences;
}

}  // namespace seldinger::assessment
