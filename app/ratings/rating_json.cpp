#include "app/ratings/rating_json.h"

#include "app/statistics/answer_json.h"
#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using OrderedJson = nlohmann::ordered_json;
namespace rated = assessment::rating;

OrderedJson json_of(const std::optional<rated::Estimated>& one) {
  if (!one) return nullptr;
  return {{"value", one->value}, {"ci95", {one->ci95.low, one->ci95.high}}};
}

OrderedJson json_of(const rated::Agreement& agreement) {
  OrderedJson raters = OrderedJson::array();
  for (const rated::RaterResult& one : agreement.raters)
    raters.push_back({{"rater", one.rater},
                      {"rated", one.rated},
                      {"severity", json_of(one.severity)},
                      {"drift_per_ten", json_of(one.drift)},
                      {"calibrated", one.calibrated},
                      {"off_known", casedb::maybe(one.off_known)},
                      {"repeated", one.repeated},
                      {"off_self", casedb::maybe(one.off_self)}});
  return {{"ratings", agreement.ratings},
          {"icc_one", OrderedJson::parse(json_of_answer(agreement.one))},
          {"icc_mean", OrderedJson::parse(json_of_answer(agreement.mean))},
          {"kappa", OrderedJson::parse(json_of_answer(agreement.kappa))},
          {"raters", std::move(raters)}};
}

}  // namespace

std::string json_of_opened(const casedb::OpenedRatingRound& opened, std::size_t replays, std::size_t calibration) {
  OrderedJson keys = OrderedJson::array();
  for (std::size_t i = 0; i < opened.keys.size(); ++i)
    keys.push_back({{"rater", "R" + std::to_string(i + 1)}, {"key", opened.keys[i]}});
  return casedb::text(OrderedJson{
      {"code", opened.round.code}, {"replays", replays}, {"calibration", calibration}, {"keys", std::move(keys)}});
}

std::string json_of_simulated(const casedb::SimulatedAnswers& made) {
  return casedb::text(OrderedJson{{"synthetic", true}, {"sent", made.sent}, {"there", made.there}});
}

std::string json_of_agreements(const casedb::SentRatings& ratings, const Agreements& agreements) {
  OrderedJson scores = OrderedJson::array();
  for (const auto& [item_id, agreement] : agreements) {
    OrderedJson json = json_of(agreement);
    json["item"] = item_id.empty() ? "mean" : item_id;
    scores.push_back(std::move(json));
  }
  return casedb::text(OrderedJson{{"code", ratings.round.code},
                                  {"form", ratings.round.form_id},
                                  {"version", ratings.round.version},
                                  {"asked", ratings.asked},
                                  {"sent", ratings.ratings.size()},
                                  {"simulated", casedb::count_simulated(ratings)},
                                  {"scores", std::move(scores)}});
}

}  // namespace seldinger::app
