#include "assessment/statistics/growth/rasch/rasch.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "assessment/statistics/growth/rasch/abilities.h"
#include "assessment/statistics/growth/rasch/conditional_likelihood.h"
#include "assessment/statistics/growth/rasch/facets.h"
#include "assessment/statistics/spread.h"

namespace seldinger::assessment::statistics {
namespace {

constexpr const char* kRasch = "rasch";
constexpr std::size_t kMostCells = 200;

// Parameters: places of all items in use but the last, of all raters in use but the last, steps of the scale but
// the last; each kind adds up to 0, so the last is what the others leave.
class Places {
 public:
  explicit Places(const Facets& facets) : facets_(facets) {
    std::vector<bool> item(facets.items.size()), rater(std::max<std::size_t>(1, facets.raters.size()));
    for (const auto& own : facets.scores)
      for (std::size_t c = 0; c < own.size(); ++c)
        if (own[c] >= 0) item[facets.item_of(c)] = rater[facets.rater_of(c)] = true;
    for (std::size_t i = 0; i < item.size(); ++i)
      if (item[i]) items_.push_back(i);
    for (std::size_t r = 0; r < rater.size(); ++r)
      if (rater[r]) raters_.push_back(r);
  }

  const std::vector<std::size_t>& items() const { return items_; }
  const std::vector<std::size_t>& raters() const { return raters_; }
  std::size_t steps() const { return static_cast<std::size_t>(facets_.most); }
  std::size_t parameters() const { return items_.size() - 1 + raters_.size() - 1 + steps() - 1; }

  std::vector<double> of_item(std::size_t item) const { return weights(items_, item, 0); }
  std::vector<double> of_rater(std::size_t rater) const { return weights(raters_, rater, items_.size() - 1); }
  std::vector<double> of_step(std::size_t step) const {
    std::vector<std::size_t> all;
    for (std::size_t h = 0; h < steps(); ++h) all.push_back(h);
    return weights(all, step, items_.size() + raters_.size() - 2);
  }

  ScoreModel model() const {
    ScoreModel model;
    model.parameters = parameters();
    for (std::size_t c = 0; c < facets_.cells(); ++c) {
      const std::vector<double> item = of_item(facets_.item_of(c)), rater = of_rater(facets_.rater_of(c));
      std::vector<double> sum(parameters());
      model.weights.emplace_back();
      for (std::size_t h = 0; h < steps(); ++h) {
        const std::vector<double> step = of_step(h);
        for (std::size_t k = 0; k < sum.size(); ++k) sum[k] -= item[k] + rater[k] + step[k];
        model.weights.back().push_back(sum);
      }
    }
    return model;
  }

 private:
  std::vector<double> weights(const std::vector<std::size_t>& in_use, std::size_t one, std::size_t from) const {
    std::vector<double> found(parameters());
    const auto at = std::find(in_use.begin(), in_use.end(), one);
    if (at == in_use.end()) return found;
    const std::size_t place = static_cast<std::size_t>(at - in_use.begin());
    for (std::size_t k = 0; k + 1 < in_use.size(); ++k)
      found[from + k] = place + 1 == in_use.size() ? -1.0 : (k == place ? 1.0 : 0.0);
    return found;
  }

  const Facets& facets_;
  std::vector<std::size_t> items_, raters_;
};

// How far answers are from what is expected: squares over their variance (infit), and squares of each over its own
// (outfit); about 1.
struct Misfit {
  double squares = 0.0, variance = 0.0, ratios = 0.0, n = 0.0;
  void add(int score, const ScoreMoments& expected) {
    const double off = score - expected.mean;
    squares += off * off;
    variance += expected.variance;
    ratios += off * off / expected.variance;
    n += 1.0;
  }
  double infit() const { return squares / variance; }
  double outfit() const { return ratios / n; }
};

double se_of(const std::vector<double>& weights, const ConditionalFit& fit) {
  double variance = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i)
    for (std::size_t j = 0; j < weights.size(); ++j) variance += weights[i] * weights[j] * fit.covariance[i][j];
  return std::sqrt(variance);
}

double place_of(const std::vector<double>& weights, const ConditionalFit& fit) {
  double sum = 0.0;
  for (std::size_t k = 0; k < weights.size(); ++k) sum += weights[k] * fit.eta[k];
  return sum;
}

Row row_of(std::string name, double place, double se, const Misfit& misfit) {
  return {std::move(name),
          {{"logits", place}, {"se", se}, {"infit", misfit.infit()}, {"outfit", misfit.outfit()}, {"n", misfit.n}}};
}

// Rows of items, raters and persons; how well persons are told apart.
void add_rows(Answer& answer, const Facets& facets, const Places& places, const ConditionalFit& fit,
              const CellLogs& logs, const std::vector<bool>& extreme) {
  std::vector<Misfit> of_items(facets.items.size()), of_raters(std::max<std::size_t>(1, facets.raters.size()));
  std::vector<Row> persons;
  std::vector<double> abilities;
  double error = 0.0;
  for (std::size_t p = 0; p < facets.persons.size(); ++p) {
    const Ability ability = ability_of(logs, facets.scores[p]);
    if (!std::isfinite(ability.logits)) continue;
    Misfit own;
    for (std::size_t c = 0; c < facets.cells(); ++c) {
      const int score = facets.scores[p][c];
      if (score < 0) continue;
      const ScoreMoments expected = score_moments(logs[c], ability.logits);
      own.add(score, expected);
      if (extreme[p]) continue;
      of_items[facets.item_of(c)].add(score, expected);
      of_raters[facets.rater_of(c)].add(score, expected);
    }
    persons.push_back(row_of("person: " + facets.persons[p], ability.logits, ability.se, own));
    if (extreme[p]) continue;
    abilities.push_back(ability.logits);
    error += ability.se * ability.se;
  }
  for (const std::size_t i : places.items()) {
    const std::vector<double> weights = places.of_item(i);
    answer.rows.push_back(
        row_of("item: " + facets.items[i], place_of(weights, fit), se_of(weights, fit), of_items[i]));
  }
  for (const std::size_t r : places.raters()) {
    if (facets.raters.empty()) break;
    const std::vector<double> weights = places.of_rater(r);
    answer.rows.push_back(
        row_of("rater: " + facets.raters[r], place_of(weights, fit), se_of(weights, fit), of_raters[r]));
  }
  answer.rows.insert(answer.rows.end(), persons.begin(), persons.end());
  const Spread spread = spread_of(abilities);
  if (spread.n > 1 && spread.varies)
    answer.more.push_back(
        {"person_reliability", 1.0 - error / static_cast<double>(abilities.size()) / spread.variance});
}

void note_left_out(Answer& answer, const Extremes& extremes) {
  for (const std::string& item : extremes.items)
    answer.notes.push_back("Item " + item + " is left out: it was always scored the same, at one end.");
  for (const std::string& rater : extremes.raters)
    answer.notes.push_back("Rater " + rater + " is left out: always the same score, at one end.");
  const auto ends = std::count(extremes.person.begin(), extremes.person.end(), true);
  if (ends > 0)
    answer.notes.push_back(std::to_string(ends) +
                           " persons have the least or the greatest score there is: their ability is by Warm's "
                           "weighted likelihood, and they say nothing about items.");
}

Answer refused(const Facets& facets, const char* reason, const char* why) {
  Answer answer = not_estimable(kRasch, reason, facets.persons.size());
  answer.missing = facets.missing;
  answer.notes.emplace_back(why);
  return answer;
}

std::string method_of(const Facets& facets) {
  std::string name = facets.most > 1 ? "rating scale model" : "Rasch model";
  if (!facets.raters.empty()) name = "many-facet " + name;
  return name + " by conditional maximum likelihood; abilities by maximum likelihood";
}

}  // namespace

Answer rasch(const DataTable& table) {
  const Facets all = facets_of(table);
  if (all.reason != nullptr) return refused(all, all.reason, all.why);
  if (all.persons.empty()) return refused(all, "no_data", "There is no score.");
  if (all.persons.size() < kLeastPersonsOfRasch)
    return refused(all, "too_few", "Fewer than 30 persons are too few to place items.");
  if (all.cells() > kMostCells) return refused(all, "too_many", "There may be 200 items, or items by raters.");
  if (all.most == 0) return refused(all, "no_variation", "All scores are 0.");
  Facets used = all;
  const Extremes extremes = without_extremes(used);
  std::vector<std::vector<int>> inner;
  for (std::size_t p = 0; p < used.persons.size(); ++p)
    if (!extremes.person[p]) inner.push_back(used.scores[p]);
  if (inner.empty()) return refused(all, "no_variation", "All scores are at one end.");
  const Places places(used);
  if (places.items().size() * places.raters().size() < 2 || places.parameters() == 0)
    return refused(all, "too_few", "There must be two items, or raters, that are not always scored alike.");
  const ScoreModel model = places.model();
  const auto fit = fit_conditional(model, inner);
  if (!fit)
    return refused(all, "perfect_separation",
                   "Some items, raters or scores are never met by the same persons, or always in one order.");
  Answer answer;
  answer.test = kRasch;
  answer.method = method_of(all);
  answer.n = all.persons.size();
  answer.missing = all.missing;
  answer.more = {{"log_likelihood", fit->log_likelihood}, {"items", static_cast<double>(places.items().size())}};
  for (std::size_t h = 0; places.steps() > 1 && h < places.steps(); ++h)
    answer.more.push_back({"step_" + std::to_string(h + 1), place_of(places.of_step(h), *fit)});
  add_rows(answer, used, places, *fit, model.logs(fit->eta), extremes.person);
  note_left_out(answer, extremes);
  return settled(std::move(answer));
}

}  // namespace seldinger::assessment::statistics
