#include <cmath>
#include <nlohmann/json.hpp>

#include "app/hands/fit_answer.h"
#include "sim/volume/classes.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json quality(const haptics::FitQuality& quality) {
  return {{"rmse_n", quality.rmse_n},
          {"starts", quality.starts},
          {"agreeing", quality.agreeing},
          {"worst_rmse_n", quality.worst_rmse_n}};
}

}  // namespace

std::string json_of_fit(const FitAnswer& answer) {
  const haptics::PlateauFit& fit = answer.plateau;
  Json plateau = quality(fit.quality);
  plateau["plateau_rmse_n"] = fit.plateau_rmse_n;
  plateau["plateau_from_mm"] = fit.model.plateau_mm();
  plateau["capsule"] = fit.capsule;
  const auto add = [&plateau](const char* name, double value, double error) {
    plateau[name] = {{"value", value}, {"standard_error", number(error)}};
  };
  add("slope_n_mm", fit.model.slope_n_mm, fit.standard_error.slope_n_mm);
  add("intercept_n", fit.model.intercept_n, fit.standard_error.intercept_n);
  add("rupture_n", fit.model.rupture_n, fit.standard_error.rupture_n);
  add("dent_mm", fit.model.dent_mm, fit.standard_error.dent_mm);
  add("linear_part", fit.model.linear_part, fit.standard_error.linear_part);
  add("fall_mm", fit.model.fall_mm, fit.standard_error.fall_mm);
  Json gaussians = quality(answer.gaussians.quality), parts = Json::array();
  for (const haptics::Gaussian& part : answer.gaussians.model.parts)
    parts.push_back({{"height_n", part.height_n}, {"centre_mm", part.centre_mm}, {"sigma_mm", part.sigma_mm}});
  gaussians["parts"] = parts;
  const haptics::NeedleTissue row = row_of_fit(answer);
  const Json document = {{"rows", answer.curve.size()},
                         {"depth_mm", {answer.curve.front().depth_mm, answer.curve.back().depth_mm}},
                         {"plateau", plateau},
                         {"gaussians", gaussians},
                         {"row",
                          {{"tissue", volume::about(answer.like.tissue).name},
                           {"gauge", haptics::kTableGauge},
                           {"slope_n_mm", row.slope_n_mm},
                           {"intercept_n", row.intercept_n},
                           {"tip_stiffness_n_mm", row.tip_stiffness_n_mm},
                           {"rupture_n", row.rupture_n},
                           {"dent_mm", row.dent_mm},
                           {"provenance", provenance_of_fit(answer)},
                           {"validated_against", validated_against_of_fit(answer)}}}};
  // Bytes of a source that are no UTF-8 are replaced.
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace seldinger::app
