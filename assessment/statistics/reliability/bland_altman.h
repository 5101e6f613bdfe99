// How far two methods, or two raters, differ on the same subjects (Bland, Altman, Lancet 1986;1:307): their mean
// difference, the limits between which most differences lie, and whether differences grow with what is measured.
#pragma once

#include "assessment/statistics/answer.h"
#include "assessment/statistics/complete_table.h"

namespace seldinger::assessment::statistics {

// First column less second; limits at `widths` standard deviations, 1.96 for 95 of 100.
Answer bland_altman(const CompleteTable& table, double widths);

}  // namespace seldinger::assessment::statistics
