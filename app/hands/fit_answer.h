// The answer of `haptics fit`: a text for people, a document for programs, the row for the table of tissues, a page
// with the residuals.
#pragma once

#include <string>
#include <vector>

#include "sim/case/gauge.h"
#include "sim/haptics/fit/fit.h"

namespace seldinger::app {

struct FitAnswer {
  std::vector<haptics::DepthForce> curve;  // the insertion
  haptics::PlateauFit plateau;
  haptics::GaussianFit gaussians;
  haptics::NeedleTissueRow like;  // the class, and what a steady insertion does not show
  cases::Gauge gauge;             // it was measured with
  std::string source;             // of the curve, in its owner's words; may be empty
};

// The parameters at the table's gauge. Tip stiffness is the class's: a needle that never turns back does not show
// it.
haptics::NeedleTissue row_of_fit(const FitAnswer& answer);
// As sim/haptics/needle/needle_tissue.cpp holds its rows.
std::string row_text_of_fit(const FitAnswer& answer);
std::string provenance_of_fit(const FitAnswer& answer);
std::string validated_against_of_fit(const FitAnswer& answer);

std::string text_of_fit(const FitAnswer& answer);
std::string json_of_fit(const FitAnswer& answer);
// HTML: the curve under both models, and what they leave.
std::string page_of_fit(const FitAnswer& answer);

}  // namespace seldinger::app
