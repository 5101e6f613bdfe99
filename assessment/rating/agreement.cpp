#include "assessment/rating/agreement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "assessment/statistics/complete_table.h"
#include "assessment/statistics/distributions.h"
#include "assessment/statistics/reliability/icc.h"
#include "assessment/statistics/reliability/kappa.h"
#include "assessment/statistics/square_matrix.h"

namespace seldinger::assessment::rating {
namespace {

namespace statistics = assessment::statistics;
using statistics::SquareMatrix;

constexpr double kDriftOver = 10.0;  // ratings

// The scores of replays that at least two raters have scored, with what belongs to a replay taken out of scores and
// columns alike, so that replays need no parameters of their own.
class WithinReplays {
 public:
  WithinReplays(const std::vector<Rating>& ratings, const std::vector<std::string>& raters) {
    std::map<std::string, std::vector<const Rating*>> by_view;
    for (const Rating& one : ratings)
      if (one.part == Part::rated) by_view[one.view].push_back(&one);
    std::map<std::string, std::pair<double, double>> order;  // sum and count, by rater
    for (const auto& [view, all] : by_view) {
      if (all.size() < 2) continue;
      ++replays_;
      for (const Rating* one : all) {
        auto& [sum, count] = order[one->rater];
        sum += static_cast<double>(one->number);
        count += 1.0;
        rows_.push_back({one, view});
      }
    }
    for (Row& row : rows_) {
      const auto found = std::find(raters.begin(), raters.end(), row.rating->rater);
      row.rater = static_cast<std::size_t>(found - raters.begin());
      const auto& [sum, count] = order[row.rating->rater];
      row.tens = (static_cast<double>(row.rating->number) - sum / count) / kDriftOver;
    }
    raters_ = raters.size();
  }

  struct Fit {
    std::vector<double> of;  // severity's effects but the last rater's, then slopes
    SquareMatrix covariance{0};
    double t = 0.0;  // of the 95 % interval
  };
  // Nothing: too few scores, or raters who never met.
  std::optional<Fit> fit(bool slopes) const {
    if (raters_ < 2) return std::nullopt;
    const std::size_t effects = raters_ - 1, columns = effects + (slopes ? raters_ : 0);
    if (rows_.size() < replays_ + columns + 1) return std::nullopt;
    std::vector<std::vector<double>> x;
    std::vector<double> y;
    for (const Row& row : rows_) {
      std::vector<double>& one = x.emplace_back(columns);
      for (std::size_t j = 0; j < effects; ++j)
        one[j] = (row.rater == j ? 1.0 : 0.0) - (row.rater == effects ? 1.0 : 0.0);
      if (slopes) one[effects + row.rater] = row.tens;
      y.push_back(row.rating->score);
    }
    take_out_replays(x, y);
    SquareMatrix products(columns);
    std::vector<double> with_y(columns);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (std::size_t a = 0; a < columns; ++a) {
        with_y[a] += x[i][a] * y[i];
        for (std::size_t b = 0; b < columns; ++b) products.at(a, b) += x[i][a] * x[i][b];
      }
    auto inverse = inverse_of(products);
    if (!inverse) return std::nullopt;
    Fit fit;
    fit.of.resize(columns);
    for (std::size_t a = 0; a < columns; ++a)
      for (std::size_t b = 0; b < columns; ++b) fit.of[a] += inverse->at(a, b) * with_y[b];
    double rest = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      double off = y[i];
      for (std::size_t a = 0; a < columns; ++a) off -= fit.of[a] * x[i][a];
      rest += off * off;
    }
    const auto df = static_cast<double>(rows_.size() - replays_ - columns);
    for (double& one : inverse->values) one *= rest / df;
    fit.covariance = std::move(*inverse);
    fit.t = statistics::student_t_quantile(0.975, df);
    return fit;
  }

 private:
  struct Row {
    const Rating* rating = nullptr;
    std::string view{};
    std::size_t rater = 0;
    double tens = 0.0;
  };
  // Rows of a replay stand beside each other.
  void take_out_replays(std::vector<std::vector<double>>& x, std::vector<double>& y) const {
    for (std::size_t from = 0; from < rows_.size();) {
      std::size_t to = from;
      while (to < rows_.size() && rows_[to].view == rows_[from].view) ++to;
      const auto count = static_cast<double>(to - from);
      const auto center = [&](auto&& at) {
        double sum = 0.0;
        for (std::size_t i = from; i < to; ++i) sum += at(i);
        for (std::size_t i = from; i < to; ++i) at(i) -= sum / count;
      };
      center([&](std::size_t i) -> double& { return y[i]; });
      for (std::size_t column = 0; column < x[from].size(); ++column)
        center([&](std::size_t i) -> double& { return x[i][column]; });
      from = to;
    }
  }

  std::vector<Row> rows_;
  std::size_t replays_ = 0, raters_ = 0;
};

std::optional<Estimated> estimated(double value, double variance, double t) {
  const double half = t * std::sqrt(std::max(0.0, variance));
  if (!std::isfinite(value) || !std::isfinite(half)) return std::nullopt;
  return Estimated{value, {value - half, value + half}};
}

void add_severity(std::vector<RaterResult>& raters, const WithinReplays::Fit& fit) {
  const std::size_t effects = raters.size() - 1;
  double last = 0.0;
  for (std::size_t j = 0; j < effects; ++j) {
    raters[j].severity = estimated(-fit.of[j], fit.covariance.at(j, j), fit.t);
    last += fit.of[j];  // all effects together are 0
  }
  raters[effects].severity = estimated(last, fit.covariance.sum(), fit.t);
}

void add_drift(std::vector<RaterResult>& raters, const WithinReplays::Fit& fit) {
  const std::size_t effects = raters.size() - 1;
  for (std::size_t j = 0; j < raters.size(); ++j)
    raters[j].drift = estimated(fit.of[effects + j], fit.covariance.at(effects + j, effects + j), fit.t);
}

// Against known scores, and against what the same rater gave the first time.
void add_own(RaterResult& of, const std::vector<Rating>& ratings) {
  std::map<std::string, double> first;
  for (const Rating& one : ratings) {
    if (one.rater != of.rater || one.part != Part::rated) continue;
    first.emplace(one.view, one.score);
    ++of.rated;
  }
  double off_known = 0.0, squares = 0.0;
  for (const Rating& one : ratings) {
    if (one.rater != of.rater) continue;
    if (one.part == Part::calibration && one.known) {
      ++of.calibrated;
      off_known += one.score - *one.known;
    }
    const auto before = first.find(one.view);
    if (one.part != Part::repeated || before == first.end()) continue;
    ++of.repeated;
    squares += (one.score - before->second) * (one.score - before->second);
  }
  if (of.calibrated > 0) of.off_known = off_known / static_cast<double>(of.calibrated);
  if (of.repeated > 0) of.off_self = std::sqrt(squares / 2.0 / static_cast<double>(of.repeated));
}

// A replay's ratings as first, second …, by the names of their raters.
statistics::CompleteTable by_turn(const std::vector<Rating>& ratings, std::size_t each) {
  std::map<std::string, std::map<std::string, double>> by_view;
  for (const Rating& one : ratings)
    if (one.part == Part::rated) by_view[one.view].emplace(one.rater, one.score);
  statistics::DataTable table;
  statistics::Column& scores = table.values.emplace_back();
  for (const auto& [view, all] : by_view) {
    std::size_t turn = 0;
    for (const auto& [rater, score] : all) {
      if (turn == each) break;
      table.subject.push_back(view);
      table.rater.push_back(std::to_string(++turn));
      scores.values.push_back(score);
    }
  }
  table.rows = scores.values.size();
  return statistics::complete_table(table);
}

}  // namespace

Agreement agreement_of(const std::vector<Rating>& ratings, std::size_t each) {
  Agreement agreement;
  std::set<std::string> names, compared;
  for (const Rating& one : ratings) {
    names.insert(one.rater);
    if (one.part == Part::rated) compared.insert(one.rater);
    agreement.ratings += one.part == Part::rated ? 1U : 0U;
  }
  const statistics::CompleteTable table = by_turn(ratings, each);
  constexpr std::size_t kOne = 0, kMean = 3;  // of kIccForms
  agreement.one = statistics::icc(table, kOne);
  agreement.mean = statistics::icc(table, kMean);
  agreement.kappa = statistics::kappa(table, statistics::KappaWeights::kQuadratic);
  std::vector<RaterResult> with_others;
  for (const std::string& name : compared) with_others.push_back({.rater = name});
  const WithinReplays within(ratings, {compared.begin(), compared.end()});
  if (const auto fit = within.fit(false)) add_severity(with_others, *fit);
  if (const auto fit = within.fit(true)) add_drift(with_others, *fit);
  for (const std::string& name : names) {
    const auto found = std::find_if(with_others.begin(), with_others.end(),
                                    [&](const RaterResult& one) { return one.rater == name; });
    agreement.raters.push_back(found == with_others.end() ? RaterResult{.rater = name} : *found);
    add_own(agreement.raters.back(), ratings);
  }
  return agreement;
}

}  // namespace seldinger::assessment::rating
