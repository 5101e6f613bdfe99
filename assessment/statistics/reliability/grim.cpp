#include "assessment/statistics/reliability/grim.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace seldinger::assessment::statistics {
namespace {

constexpr double kRounding = 1e-9;        // of sums, for what halves are rounded to
constexpr double kMostWork = 3e7;         // words that looking through all sets may touch
constexpr std::int64_t kMostSums = 2000;  // sums that are worth looking at one by one
constexpr std::size_t kBesides = 5;       // other n on either side that are tried

double half_of_last_digit(std::size_t decimals) {
  return 0.5 * std::pow(10.0, -static_cast<double>(decimals));
}

struct WholeRange {
  std::int64_t low = 0, high = -1;  // empty where low > high
  bool empty() const { return low > high; }
};

WholeRange whole_between(double low, double high) {
  const double slack = kRounding * std::max({1.0, std::abs(low), std::abs(high)});
  return {static_cast<std::int64_t>(std::ceil(low - slack)), static_cast<std::int64_t>(std::floor(high + slack))};
}

// Sums over all answers that round to the mean.
WholeRange possible_sums(const ReportedScale& reported) {
  const double answers = static_cast<double>(reported.n * reported.items),
               half = half_of_last_digit(reported.mean_decimals);
  double low = answers * (reported.mean - half), high = answers * (reported.mean + half);
  if (reported.low) low = std::max(low, answers * *reported.low);
  if (reported.high) high = std::min(high, answers * *reported.high);
  return low > high + kRounding ? WholeRange{} : whole_between(low, high);
}

// Sums of squares of the persons' sums that round to the standard deviation, if those add up to `sum`.
WholeRange possible_squares(const ReportedScale& reported, double sum) {
  const double n = static_cast<double>(reported.n), items = static_cast<double>(reported.items);
  const double half = half_of_last_digit(reported.sd_decimals);
  const double low = std::max(0.0, *reported.sd - half) * items, high = (*reported.sd + half) * items;
  return whole_between((n - 1.0) * low * low + sum * sum / n, (n - 1.0) * high * high + sum * sum / n);
}

// Which sums and sums of squares n whole numbers from `low` to `high` can have, up to `squares`: bits by sum.
class Reachable {
 public:
  Reachable(std::size_t n, std::int64_t low, std::int64_t high, std::int64_t squares)
      : most_(static_cast<std::int64_t>(std::sqrt(static_cast<double>(n) * static_cast<double>(squares))) + 1),
        words_(static_cast<std::size_t>(squares / 64 + 1)),
        bits_(static_cast<std::size_t>(2 * most_ + 1), Bits(words_)) {
    bits_[index(0)][0] = 1;
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<Bits> next(bits_.size(), Bits(words_));
      for (std::int64_t value = low; value <= high; ++value)
        for (std::int64_t sum = -most_; sum <= most_; ++sum)
          if (sum + value >= -most_ && sum + value <= most_)
            merge_shifted(next[index(sum + value)], bits_[index(sum)], static_cast<std::size_t>(value * value));
      bits_ = std::move(next);
    }
  }

  bool has(std::int64_t sum, std::int64_t squares) const {
    if (sum < -most_ || sum > most_ || squares < 0 || static_cast<std::size_t>(squares / 64) >= words_)
      return false;
    return (bits_[index(sum)][static_cast<std::size_t>(squares / 64)] >> (squares % 64) & 1u) != 0;
  }

  static double work(std::size_t n, std::int64_t low, std::int64_t high, std::int64_t squares) {
    const double q = static_cast<double>(squares), many = static_cast<double>(n);
    return many * static_cast<double>(high - low + 1) * (2.0 * std::sqrt(many * q) + 3.0) * (q / 64.0 + 1.0);
  }

 private:
  using Bits = std::vector<std::uint64_t>;
  std::size_t index(std::int64_t sum) const { return static_cast<std::size_t>(sum + most_); }
  static void merge_shifted(Bits& into, const Bits& from, std::size_t by) {
    const std::size_t whole = by / 64, part = by % 64;
    for (std::size_t i = whole; i < into.size(); ++i) {
      into[i] |= from[i - whole] << part;
      if (part > 0 && i > whole) into[i] |= from[i - whole - 1] >> (64 - part);
    }
  }

  std::int64_t most_;
  std::size_t words_;
  std::vector<Bits> bits_;
};

// The persons' sums about a whole number near their mean, so that squares stay small.
struct Centred {
  std::int64_t centre = 0, low = 0, high = 0, squares = 0;
};

Centred centred(const ReportedScale& reported, const WholeRange& sums) {
  const double n = static_cast<double>(reported.n), items = static_cast<double>(reported.items);
  Centred found;
  found.centre = std::llround(reported.mean * items);
  for (const std::int64_t sum : {sums.low, sums.high}) {
    const double off = static_cast<double>(sum) - n * static_cast<double>(found.centre);
    const double high = (*reported.sd + half_of_last_digit(reported.sd_decimals)) * items;
    found.squares = std::max(found.squares, static_cast<std::int64_t>((n - 1.0) * high * high + off * off / n) + 1);
  }
  const auto furthest = static_cast<std::int64_t>(std::sqrt(static_cast<double>(found.squares)));
  found.low = -furthest;
  found.high = furthest;
  if (reported.low)
    found.low = std::max<std::int64_t>(found.low, std::llround(*reported.low * items) - found.centre);
  if (reported.high)
    found.high = std::min<std::int64_t>(found.high, std::llround(*reported.high * items) - found.centre);
  return found;
}

// The least sum of squares of whole numbers with a sum: all as equal as can be.
double least_squares(double n, double sum) {
  const double whole = std::floor(sum / n), more = sum - n * whole;
  return (n - more) * whole * whole + more * (whole + 1.0) * (whole + 1.0);
}

// The most: as many as can be at either end of the scale, and one between.
double most_squares(const ReportedScale& reported, double n, double sum) {
  if (!reported.low || !reported.high) return HUGE_VAL;
  const double items = static_cast<double>(reported.items), low = *reported.low * items,
               high = *reported.high * items;
  const double above = sum - n * low, at_high = std::floor(above / (high - low));
  const double between = low + above - at_high * (high - low);
  return at_high >= n ? n * high * high
                      : at_high * high * high + between * between + (n - at_high - 1.0) * low * low;
}

bool not_refuted(const ReportedScale& reported, std::int64_t sum, const WholeRange& squares) {
  const double n = static_cast<double>(reported.n), total = static_cast<double>(sum);
  std::int64_t low = std::max(squares.low, static_cast<std::int64_t>(least_squares(n, total)));
  const double most = std::min(static_cast<double>(squares.high), most_squares(reported, n, total));
  if ((low - sum) % 2 != 0) ++low;  // a square is as odd as its root
  return static_cast<double>(low) <= most;
}

Answer answer_of(const char* test, const char* method, const ReportedScale& reported, double possible) {
  Answer answer;
  answer.test = test;
  answer.method = method;
  answer.n = reported.n;
  answer.estimate = possible;
  answer.estimate_name = "possible (1) or not (0)";
  return answer;
}

template <typename IsPossible>
void add_other_n(Answer& answer, const ReportedScale& reported, std::size_t least, const IsPossible& is_possible) {
  const std::size_t from = reported.n > least + kBesides ? reported.n - kBesides : least;
  for (std::size_t n = from; n <= reported.n + kBesides; ++n) {
    ReportedScale other = reported;
    other.n = n;
    answer.rows.push_back({"n = " + std::to_string(n),
                           {{"n", static_cast<double>(n)}, {"possible", is_possible(other) ? 1.0 : 0.0}}});
  }
}

}  // namespace

bool mean_is_possible(const ReportedScale& reported) {
  return !possible_sums(reported).empty();
}

Possible sd_is_possible(const ReportedScale& reported) {
  const WholeRange sums = possible_sums(reported);
  if (sums.empty()) return Possible::kNo;
  if (sums.high - sums.low > kMostSums) return Possible::kNotRefuted;
  const Centred about = centred(reported, sums);
  const auto n = static_cast<std::int64_t>(reported.n);
  const bool look =
      about.low <= about.high && Reachable::work(reported.n, about.low, about.high, about.squares) < kMostWork;
  if (!look) {
    for (std::int64_t sum = sums.low; sum <= sums.high; ++sum)
      if (not_refuted(reported, sum, possible_squares(reported, static_cast<double>(sum))))
        return Possible::kNotRefuted;
    return Possible::kNo;
  }
  const Reachable reachable(reported.n, about.low, about.high, about.squares);
  for (std::int64_t sum = sums.low; sum <= sums.high; ++sum) {
    const std::int64_t off = sum - n * about.centre;
    const WholeRange squares = possible_squares(reported, static_cast<double>(off));
    for (std::int64_t square = squares.low; square <= std::min(squares.high, about.squares); ++square)
      if (reachable.has(off, square)) return Possible::kYes;
  }
  return Possible::kNo;
}

Answer grim(const ReportedScale& reported) {
  const bool possible = mean_is_possible(reported);
  const double answers = static_cast<double>(reported.n * reported.items);
  Answer answer =
      answer_of("grim", "GRIM: whether a sum of whole numbers rounds to the mean", reported, possible ? 1.0 : 0.0);
  answer.more = {{"nearest_mean", std::round(reported.mean * answers) / answers}};
  add_other_n(answer, reported, 1, mean_is_possible);
  if (2.0 * half_of_last_digit(reported.mean_decimals) * answers >= 1.0)
    answer.notes.emplace_back(
        "With so many answers, any mean with so few decimals is possible: this says nothing.");
  if (!possible)
    answer.notes.emplace_back("Not possible says that mean, n or items differ from what is reported, not why.");
  return settled(std::move(answer));
}

Answer grimmer(const ReportedScale& reported) {
  const Possible possible = sd_is_possible(reported);
  Answer answer = answer_of("grimmer",
                            possible == Possible::kNotRefuted
                                ? "GRIMMER: whether a sum of squares of the right parity rounds to the SD"
                                : "GRIMMER, exact: whether any set of whole numbers has this mean and SD",
                            reported, possible == Possible::kNo ? 0.0 : 1.0);
  answer.more = {{"mean_possible", mean_is_possible(reported) ? 1.0 : 0.0}};
  add_other_n(answer, reported, 2, [](const ReportedScale& one) { return sd_is_possible(one) != Possible::kNo; });
  if (possible == Possible::kNotRefuted)
    answer.notes.emplace_back(
        "There are too many sets of numbers to look through: this is neither refuted nor shown.");
  if (possible == Possible::kNo)
    answer.notes.emplace_back("Not possible says that mean, SD, n or items differ from what is reported, not why.");
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
