// sin, cos, exp, log, acos that give the same bits on every processor: only + − × ÷ √ and integer bits (libm's
// differ). Errors are measured against libm in tests/sim/base/exact_math_test.cpp.
#pragma once

namespace seldinger::base {

double exact_sin(double x_rad) noexcept;  // |x| ≤ 1e6; absolute error < 1e-13 for |x| ≤ 1e3
double exact_cos(double x_rad) noexcept;  // as exact_sin
double exact_exp(double x) noexcept;      // relative error < 1e-14 for −700 ≤ x ≤ 700; clamped outside
double exact_log(double x) noexcept;      // x > 0 and normal; absolute error < 1e-14·max(1, |log x|)
double exact_atan(double x) noexcept;     // absolute error < 1e-14
double exact_acos(double x) noexcept;     // clamped to −1 ≤ x ≤ 1; absolute error < 1e-14

}  // namespace seldinger::base
