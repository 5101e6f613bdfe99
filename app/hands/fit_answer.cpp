#include "app/hands/fit_answer.h"

#include <cmath>
#include <cstdio>

#include "reports/charts/force_page.h"
#include "sim/volume/classes.h"

namespace seldinger::app {
namespace {

constexpr int kDrawnPoints = 1500;

template <typename... Values>
std::string line(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string with_error(double value, double error, const char* unit) {
  return line("%.4f", value) + (std::isfinite(error) ? line(" ± %.2g", error) : "") + " " + unit;
}

// As a C++ literal; other bytes than printable ASCII in octal, which cannot run on into what follows.
std::string quoted(const std::string& text) {
  std::string literal = "\"";
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\')
      literal += std::string("\\") + c;
    else if (byte >= 0x20 && byte < 0x7f)
      literal += c;
    else
      literal += line("\\%03o", static_cast<unsigned>(byte));
  }
  return literal + "\"";
}

std::string text_of_starts(const haptics::FitQuality& quality) {
  return line("%d of %d starts end there, the worst at %.4f N", quality.agreeing, quality.starts,
              quality.worst_rmse_n);
}

}  // namespace

haptics::NeedleTissue row_of_fit(const FitAnswer& answer) {
  const haptics::PlateauModel& model = answer.plateau.model;
  haptics::NeedleTissue row;
  row.slope_n_mm = model.slope_n_mm;
  row.intercept_n = model.intercept_n;
  if (answer.plateau.capsule) {
    row.rupture_n = model.rupture_n;
    row.dent_mm = model.dent_mm;
  }
  row = haptics::at_table_gauge(row, answer.gauge);
  row.tip_stiffness_n_mm = answer.like.needle.tip_stiffness_n_mm;
  return row;
}

std::string provenance_of_fit(const FitAnswer& answer) {
  return (answer.source.empty() ? "measured" : answer.source) +
         line(": fitted to an insertion of %zu rows to %.1f mm, %d G; tip stiffness as %s's row (design)",
              answer.curve.size(), answer.curve.back().depth_mm, answer.gauge.number,
              volume::about(answer.like.tissue).name);
}

std::string validated_against_of_fit(const FitAnswer& answer) {
  return line("only the curve it was fitted to, RMSE %.4f N, plateau %.4f N", answer.plateau.quality.rmse_n,
              answer.plateau.plateau_rmse_n);
}

std::string row_text_of_fit(const FitAnswer& answer) {
  const haptics::NeedleTissue row = row_of_fit(answer);
  return line("    {TissueClass::%s,\n     {%.4g, %.4g, %.4g, %.4g, %.4g},\n     ",
              volume::about(answer.like.tissue).name, row.slope_n_mm, row.intercept_n, row.tip_stiffness_n_mm,
              row.rupture_n, row.dent_mm) +
         quoted(provenance_of_fit(answer)) + ",\n     " + quoted(validated_against_of_fit(answer)) + "},\n";
}

std::string text_of_fit(const FitAnswer& answer) {
  const haptics::PlateauFit& plateau = answer.plateau;
  const haptics::PlateauModel &model = plateau.model, &error = plateau.standard_error;
  std::string text =
      line("%zu rows of insertion, to %.1f mm\n\n", answer.curve.size(), answer.curve.back().depth_mm);
  text += "Plateau: " + with_error(model.slope_n_mm, error.slope_n_mm, "N/mm") + " x + " +
          with_error(model.intercept_n, error.intercept_n, "N") + line(" from %.1f mm\n", model.plateau_mm());
  text += plateau.capsule ? "Capsule: opens at " + with_error(model.rupture_n, error.rupture_n, "N") + ", dent " +
                                with_error(model.dent_mm, error.dent_mm, "mm") + "\n"
                          : "Capsule: none found\n";
  text += line("RMSE %.4f N, on the plateau %.4f N; ", plateau.quality.rmse_n, plateau.plateau_rmse_n) +
          text_of_starts(plateau.quality) + "\n\n";
  text += "Sum of Gaussians (thesis eq. 5.1):\n  height, N  centre, mm  sigma, mm\n";
  for (const haptics::Gaussian& part : answer.gaussians.model.parts)
    text += line("  %9.4f  %10.3f  %9.3f\n", part.height_n, part.centre_mm, part.sigma_mm);
  text +=
      line("RMSE %.4f N; ", answer.gaussians.quality.rmse_n) + text_of_starts(answer.gaussians.quality) + "\n\n";
  return text + line("Row of sim/haptics/needle_tissue.cpp, %d G:\n", haptics::kTableGauge) +
         row_text_of_fit(answer);
}

std::string page_of_fit(const FitAnswer& answer) {
  reports::ForceChart forces{"force", {{"measured", {}}, {"plateau", {}}, {"sum of Gaussians", {}}}};
  // The line of no residual first: so each model keeps its colour.
  reports::ForceChart left{"residual: measured less model",
                           {{"none", {}}, {"plateau", {}}, {"sum of Gaussians", {}}}};
  for (const haptics::DepthForce& point : haptics::thinned(answer.curve, kDrawnPoints)) {
    const double plateau_n = answer.plateau.model.force_n(point.depth_mm);
    const double gaussians_n = answer.gaussians.model.force_n(point.depth_mm);
    forces.curves[0].points.push_back({point.depth_mm, point.force_n});
    forces.curves[1].points.push_back({point.depth_mm, plateau_n});
    forces.curves[2].points.push_back({point.depth_mm, gaussians_n});
    left.curves[0].points.push_back({point.depth_mm, 0.0});
    left.curves[1].points.push_back({point.depth_mm, point.force_n - plateau_n});
    left.curves[2].points.push_back({point.depth_mm, point.force_n - gaussians_n});
  }
  return reports::force_page(
      line("Force against depth, fitted: RMSE %.4f N by plateau, %.4f N by %zu Gaussians",
           answer.plateau.quality.rmse_n, answer.gaussians.quality.rmse_n, answer.gaussians.model.parts.size()),
      {std::move(forces), std::move(left)});
}

}  // namespace seldinger::app
