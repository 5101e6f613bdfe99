// Each metric is held to the laws that its row states, over attempts drawn by chance. With
// SELDINGER_LAWS_TABLE=FILE it writes which laws hold for which metric, stated or not.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <future>
#include <limits>
#include <numbers>
#include <set>
#include <sstream>

#include "assessment/registry.h"
#include "tests/assessment/laws/changes.h"

namespace seldinger::assessment {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr std::uint64_t kAttempts = 100;  // it takes ten times as long
#else
constexpr std::uint64_t kAttempts = 500;
#endif
constexpr int kFewValues = kAttempts / 50;  // under so many attempts with a value, a law says little

// Of one metric and one law, or another change.
struct Held {
  int values = 0, broken = 0;  // attempts in which it had a value before or after; in which it moved
  double worst = 0.0;          // of what is allowed
  std::string first;           // attempt, before, after
};

std::string text_of(const MetricValue& metric) {
  std::ostringstream text;
  text.precision(10);
  if (metric.value)
    text << *metric.value << " " << metric.unit;
  else
    text << "null (" << metric.reason << ")";
  return text.str();
}

std::vector<MetricValue> measured(const RandomAttempt& attempt) {
  const auto signals = attempt.signals();
  if (!signals) {
    ADD_FAILURE() << attempt.words() << ": " << signals.error().text;
    return std::vector<MetricValue>(registry().size());
  }
  return measure_all(*signals);
}

void hold(const Changed& changed, const std::vector<MetricValue>& before, std::vector<Held>& held) {
  const std::vector<MetricValue> after = measured(changed.after);
  for (std::size_t m = 0; m < registry().size(); ++m) {
    if (!before[m].value && !after[m].value) continue;
    Held& one = held[m];
    ++one.values;
    double over = std::numeric_limits<double>::infinity();
    if (before[m].value && after[m].value) {
      const double off = std::abs(*after[m].value - *before[m].value);
      const double allowed = changed.slack.allowed(registry()[m], *before[m].value);
      over = off <= allowed ? (off > 0.0 ? off / allowed : 0.0) : (allowed > 0.0 ? off / allowed : over);
    }
    one.worst = std::max(one.worst, over);
    if (over <= 1.0) continue;
    if (++one.broken == 1)
      one.first = changed.before.words() + ", before " + text_of(before[m]) + ", after " + text_of(after[m]);
  }
}

std::optional<Changed> sliding(const RandomAttempt& attempt, Draw& draw) {
  Changed changed{attempt, attempt, {0.01, 0.01, 0.25}};
  changed.before = changed.after = random_attempt_at_rest(attempt.seed);
  slide_under_hands(changed.after, draw.in(4.0, 14.0));
  return changed;
}

// The needle is left in the patient, held still in the room, while breath slides the tissue along it.
std::optional<Changed> held_in_breath(const RandomAttempt& attempt, Draw& draw) {
  const auto signals = attempt.signals();
  if (attempt.recording.endpoint || !signals || signals->passages.back().depth_mm < 10.0) return std::nullopt;
  Changed changed{attempt, attempt, {0.001, 0.002, kTraceMm}};
  auto& poses = changed.after.recording.poses;
  const cases::PoseSample last = poses.back();
  const double amplitude_mm = draw.in(3.0, 9.0), period_s = draw.in(3.0, 5.0);
  for (int i = 1; i <= static_cast<int>(15.0 * attempt.pose_hz); ++i) {
    const double since_s = i / attempt.pose_hz;
    const double level = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * since_s / period_s);
    poses.push_back(last);
    poses.back().t_s = last.t_s + since_s;
    poses.back().rest_tip_lps_mm = last.tip_at_rest_lps_mm() - last.needle_direction * (amplitude_mm * level);
  }
  return changed;
}

// What hands do, told apart from what breath does.
bool of_the_hand(const MetricInfo& info) {
  static const std::set<std::string> kOfTheHand = {
      "skin_punctures",       "withdrawals_partial", "withdrawals_full",      "advance_visible_share",
      "blind_advance",        "blind_advance_max",   "plane_angle_mean",      "plane_angle_max",
      "advance_beyond_plane", "advance_in_breath",   "probe_drift_advancing", "probe_shift_advancing",
      "probe_turn_advancing"};
  return kOfTheHand.contains(info.id);
}

struct Findings {
  std::vector<std::vector<Held>> of_law;  // one per law, each one per metric
  std::vector<Held> slid;                 // hands in the room as they were, over tissue that slides
  std::vector<Held> held;                 // hands at rest in the room for a while, breath slides the tissue
  std::vector<int> values;                // attempts in which a metric had one
  std::vector<double> best;               // of each metric, over all attempts
  std::vector<Held> nothing;              // values where nothing was done
  std::vector<double> nothing_best;       // the best of them
};

Findings found(std::uint64_t first_seed, std::uint64_t last_seed) {
  const std::size_t metrics = registry().size();
  Findings all;
  all.of_law.assign(laws().size(), std::vector<Held>(metrics));
  all.slid.resize(metrics), all.held.resize(metrics);
  all.nothing.resize(metrics);
  all.values.assign(metrics, 0);
  const double far = std::numeric_limits<double>::infinity();
  all.best.assign(metrics, -far), all.nothing_best.assign(metrics, -far);
  const auto goodness = [](const MetricInfo& info, double value) {
    return info.direction == Direction::lower_is_better ? -value : value;
  };
  for (std::uint64_t seed = first_seed; seed <= last_seed; ++seed) {
    const RandomAttempt attempt = random_attempt(seed);
    const std::vector<MetricValue> values = measured(attempt);
    for (std::size_t m = 0; m < metrics; ++m)
      if (values[m].value) {
        ++all.values[m];
        all.best[m] = std::max(all.best[m], goodness(registry()[m], *values[m].value));
      }
    for (std::size_t l = 0; l < laws().size(); ++l) {
      Draw draw(base::hash_combine(seed, l));
      const auto changed = laws()[l].change(attempt, draw);
      if (!changed) continue;
      const bool other = laws()[l].law == kInAnyBreath;
      hold(*changed, other ? measured(changed->before) : values, all.of_law[l]);
    }
    Draw draw(base::hash_combine(seed, laws().size()));
    const auto slid = sliding(attempt, draw);
    hold(*slid, measured(slid->before), all.slid);
    if (const auto held = held_in_breath(attempt, draw)) hold(*held, values, all.held);
    const std::vector<MetricValue> nothing = measured(nothing_done(seed));
    for (std::size_t m = 0; m < metrics; ++m) {
      if (!nothing[m].value) continue;
      Held& one = all.nothing[m];
      if (++one.values == 1) one.first = "seed " + std::to_string(seed) + ": " + text_of(nothing[m]);
      all.nothing_best[m] = std::max(all.nothing_best[m], goodness(registry()[m], *nothing[m].value));
    }
  }
  return all;
}

void add(Held& sum, const Held& later) {
  if (sum.first.empty()) sum.first = later.first;
  sum.values += later.values, sum.broken += later.broken;
  sum.worst = std::max(sum.worst, later.worst);
}

// By two threads, each with half of the seeds.
Findings found() {
  constexpr std::uint64_t kHalf = kAttempts / 2;
  auto second = std::async(std::launch::async, [] { return found(kHalf + 1, kAttempts); });
  Findings all = found(1, kHalf);
  const Findings other = second.get();
  for (std::size_t m = 0; m < registry().size(); ++m) {
    for (std::size_t l = 0; l < laws().size(); ++l) add(all.of_law[l][m], other.of_law[l][m]);
    add(all.slid[m], other.slid[m]), add(all.held[m], other.held[m]);
    add(all.nothing[m], other.nothing[m]);
    all.values[m] += other.values[m];
    all.best[m] = std::max(all.best[m], other.best[m]);
    all.nothing_best[m] = std::max(all.nothing_best[m], other.nothing_best[m]);
  }
  return all;
}

std::string cell(const Held& held) {
  if (held.values == 0) return "none";
  if (held.broken == 0) return held.values < kFewValues ? "few" : "holds";
  return std::to_string(held.broken) + "/" + std::to_string(held.values);
}

// Whoever does nothing has the best value that anybody has.
bool flatters_nothing(const Findings& all, std::size_t m) {
  return registry()[m].direction != Direction::none && all.nothing[m].values > 0 &&
         all.nothing_best[m] >= all.best[m];
}

std::string table_of(const Findings& all) {
  std::ostringstream text;
  const auto column = [&](const std::string& word, std::size_t width) {
    text << word << std::string(word.size() < width ? width - word.size() : 1, ' ');
  };
  text << "holds: in every attempt with a value (few: under " << kFewValues
       << "); broken/with a value; none: never a "
       << "value.\nnothing: null where nobody does anything, else in how many of " << kAttempts
       << " it has a value (!: the best that there is). slide: hands in the room as they were, tissue slid under "
       << "them; held: needle left in the patient, held still in the room for 15 s of breath; both no law.\n* "
          "before a cell: its row states the law.\n\n";
  column("metric", 36), column("values", 8);
  for (const LawInfo& law : laws()) column(law.column, 11);
  column("nothing", 11), column("slide", 11), text << "held\n";
  for (std::size_t m = 0; m < registry().size(); ++m) {
    const MetricInfo& info = registry()[m];
    column(std::string(info.id) + " " + std::to_string(info.version), 36), column(std::to_string(all.values[m]), 8);
    for (std::size_t l = 0; l < laws().size(); ++l)
      column(((info.laws & laws()[l].law) != 0 ? "*" : "") + cell(all.of_law[l][m]), 11);
    const std::string nothing = all.nothing[m].values == 0
                                    ? "null"
                                    : std::to_string(all.nothing[m].values) + (flatters_nothing(all, m) ? "!" : "");
    column(((info.laws & kNothingIsNothing) != 0 ? "*" : "") + nothing, 11);
    column(cell(all.slid[m]), 11), text << cell(all.held[m]) << "\n";
  }
  text << "\nThe first attempt that breaks a law:\n";
  for (std::size_t m = 0; m < registry().size(); ++m)
    for (std::size_t l = 0; l < laws().size(); ++l)
      if (all.of_law[l][m].broken > 0)
        text << registry()[m].id << ", " << laws()[l].name << ": " << all.of_law[l][m].first << "\n";
  for (std::size_t m = 0; m < registry().size(); ++m)
    for (const auto& [name, held] : {std::pair("slide", &all.slid[m]), std::pair("held", &all.held[m])})
      if (held->broken > 0) text << registry()[m].id << ", " << name << ": " << held->first << "\n";
  return text.str();
}

const Findings& findings() {
  static const Findings all = [] {
    Findings made = found();
    if (const char* path = std::getenv("SELDINGER_LAWS_TABLE")) std::ofstream(path) << table_of(made);
    return made;
  }();
  return all;
}

TEST(Laws, HoldForEveryMetricThatStatesThem) {
  for (std::size_t l = 0; l < laws().size(); ++l)
    for (std::size_t m = 0; m < registry().size(); ++m) {
      const MetricInfo& info = registry()[m];
      if ((info.laws & laws()[l].law) == 0) continue;
      const Held& held = findings().of_law[l][m];
      EXPECT_EQ(held.broken, 0) << info.id << ", " << laws()[l].name << ": " << held.broken << " of " << held.values
                                << " attempts, first " << held.first;
    }
}

// What every metric must be: the same wherever the patient lies, and for the left hand as for the right.
TEST(Laws, OfSpaceAreEveryMetrics) {
  for (const MetricInfo& info : registry())
    for (const LawInfo& law : laws())
      if (law.law == kInAnyFrame || law.law == kMirrored) {
        EXPECT_NE(info.laws & law.law, 0U) << info.id << ": " << law.name;
      }
}

// The changes are such: what they must change, they do.
TEST(Laws, ChangeWhatTheyMay) {
  const auto broken = [](Law law, const char* id) {
    for (std::size_t l = 0; l < laws().size(); ++l)
      for (std::size_t m = 0; m < registry().size(); ++m)
        if (laws()[l].law == law && id == std::string(registry()[m].id)) return findings().of_law[l][m];
    return Held{};
  };
  EXPECT_GT(broken(kAtAnySpeed, "time_total").broken, static_cast<int>(kAttempts) * 3 / 4);
  EXPECT_EQ(broken(kIdleBefore, "time_total").broken, static_cast<int>(kAttempts));
  EXPECT_GT(broken(kIdleAfter, "time_total").broken, static_cast<int>(kAttempts) / 5);
  EXPECT_GT(broken(kInAnyFrame, "tip_target_dist").worst, 0.0);
  EXPECT_GT(broken(kInAnyBreath, "closest_approach").values, static_cast<int>(kAttempts) / 3);
  EXPECT_GT(broken(kOneDarkFrame, "vis_needle").worst, 0.1);
  EXPECT_GT(broken(kLostSamples, "path_tip").worst, 0.0);
}

// Breath that slides past a hand at rest is neither a withdrawal nor an advance, however deep the needle is.
TEST(Laws, HandsAtRestDoNothingWhateverBreathDoes) {
  for (std::size_t m = 0; m < registry().size(); ++m) {
    const MetricInfo& info = registry()[m];
    if (!of_the_hand(info)) continue;
    const Held& held = findings().held[m];
    EXPECT_GE(held.values, kFewValues) << info.id;
    EXPECT_EQ(held.broken, 0) << info.id << ": " << held.broken << " of " << held.values << ", first "
                              << held.first;
  }
}

TEST(Laws, SpeakOfEveryMetricInManyAttempts) {
  for (std::size_t m = 0; m < registry().size(); ++m)
    EXPECT_GE(findings().values[m], kFewValues) << registry()[m].id;
}

TEST(Laws, OfNothingDoneIsNothing) {
  std::string flattered;
  for (std::size_t m = 0; m < registry().size(); ++m) {
    const MetricInfo& info = registry()[m];
    const Held& nothing = findings().nothing[m];
    if ((info.laws & kNothingIsNothing) != 0) {
      EXPECT_EQ(nothing.values, 0) << info.id << ", nothing done, first " << nothing.first;
    } else if (info.id == std::string("procedure_performed")) {
      EXPECT_EQ(nothing.values, static_cast<int>(kAttempts));
      EXPECT_EQ(findings().nothing_best[m], 0.0) << "comparisons are among those who did something";
    } else if (flatters_nothing(findings(), m)) {
      flattered += std::string(flattered.empty() ? "" : ", ") + info.id;
    }
  }
  std::printf("Best for who does nothing, and compared only among those who did something: %s\n",
              flattered.c_str());
}

}  // namespace
}  // namespace seldinger::assessment
