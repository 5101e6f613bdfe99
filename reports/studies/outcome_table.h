// Planned comparisons as a table with their drawings.
#pragma once

#include <vector>

#include "assessment/study/analysis.h"
#include "reports/markup/html.h"

namespace seldinger::reports {

// `confirmatory`: primary outcomes, with p, p by Holm and a verdict each; all others bear no p.
Html outcome_table(const std::vector<assessment::study::Compared>& outcomes, double alpha, bool confirmatory,
                   std::string_view caption);
// Whether a drawing of theirs has the band of differences that are not worthwhile: of means, not of order.
bool draws_worthwhile(const std::vector<assessment::study::Compared>& outcomes);
Html sensitivity_table(const std::vector<assessment::study::Compared>& outcomes);

}  // namespace seldinger::reports
