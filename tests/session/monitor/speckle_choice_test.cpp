#include "session/monitor/speckle_choice.h"

#include <gtest/gtest.h>

#include <functional>

namespace seldinger::session {
namespace {

using imaging::UltrasoundMethod;

// When the lattice was chosen; −1: never. Pictures take what is told of their time, one after the other.
double lattice_from_s(const std::function<double(double t_s)>& took_s, double for_s) {
  SpeckleChoice choice;
  for (double t_s = 0.0; t_s < for_s;) {
    const double took = took_s(t_s);
    t_s += took;
    choice.made(t_s, took);
    if (choice.method() == UltrasoundMethod::lattice) return t_s;
  }
  return -1.0;
}

TEST(SpeckleChoice, ScatterersStayWhereTheyComeFiveTimesASecond) {
  EXPECT_EQ(SpeckleChoice().method(), UltrasoundMethod::scatterers);
  EXPECT_LT(lattice_from_s([](double) { return 0.190; }, 600.0), 0.0);
}

TEST(SpeckleChoice, TheLatticeComesWhereTheyDoNot) {
  const double from_s = lattice_from_s([](double) { return 0.210; }, 600.0);
  EXPECT_GE(from_s, SpeckleChoice::kForS);
  EXPECT_LE(from_s, SpeckleChoice::kForS + 1.0);
}

TEST(SpeckleChoice, AFewVerySlowPicturesAreNoWhile) {
  const double from_s = lattice_from_s([](double) { return 1.5; }, 600.0);
  EXPECT_GE(from_s, 1.5 * SpeckleChoice::kLeastPictures);
}

TEST(SpeckleChoice, AMomentOfLoadChangesNothing) {
  // A second and a half of it every ten seconds.
  const auto loaded = [](double t_s) { return t_s - 10.0 * static_cast<int>(t_s / 10.0) < 1.5 ? 0.30 : 0.05; };
  EXPECT_LT(lattice_from_s(loaded, 600.0), 0.0);
}

TEST(SpeckleChoice, WhatIsSometimesJustFastEnoughIsStillSlow) {
  // Between kLeastHz and kFineHz the while goes on, once it has begun.
  const auto about = [](double t_s) { return static_cast<int>(t_s / 0.8) % 2 == 0 ? 0.230 : 0.185; };
  EXPECT_GT(lattice_from_s(about, 600.0), 0.0);
}

TEST(SpeckleChoice, ThereIsNoWayBack) {
  SpeckleChoice choice;
  double t_s = 0.0;
  for (; choice.method() == UltrasoundMethod::scatterers && t_s < 100.0; t_s += 0.4) choice.made(t_s, 0.4);
  ASSERT_EQ(choice.method(), UltrasoundMethod::lattice);
  for (int i = 0; i < 10'000; ++i) choice.made(t_s += 0.005, 0.005);
  EXPECT_EQ(choice.method(), UltrasoundMethod::lattice);
}

}  // namespace
}  // namespace seldinger::session
