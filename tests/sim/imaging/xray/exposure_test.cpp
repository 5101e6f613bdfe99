// Dose by inverse square, and automatic exposure from both sides.
#include "sim/imaging/xray/exposure.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/sim/imaging/xray/flat_field.h"

namespace seldinger::imaging {
namespace {

// Left half thin, right half thick.
PathLengths split(int size_px, double left_mm, double right_mm) {
  PathLengths lengths = flat(size_px, left_mm);
  for (int row = 0; row < size_px; ++row)
    for (int column = size_px / 2; column < size_px; ++column)
      lengths.water_mm[static_cast<std::size_t>(row * size_px + column)] = static_cast<float>(right_mm);
  return lengths;
}

class Exposure : public testing::Test {
 protected:
  cases::Fluoroscope machine;
  Beams beams{machine};
  AutomaticExposure automatic{machine};
  cases::FluoroscopeInputs asked;

  // The panel's kerma after each of `frames` pulses, from `first` on.
  std::vector<double> kermas_ngy(const PathLengths& field, cases::Technique first, int frames,
                                 cases::Technique* last = nullptr) {
    std::vector<double> kermas;
    Pulse pulse{first, 1100.0, 0, {}};
    for (int frame = 0; frame < frames; ++frame) {
      kermas.push_back(panel_kerma_ngy(beams, pulse, field));
      pulse.technique = meter(beams, automatic, pulse, field, asked).next;
    }
    if (last != nullptr) *last = pulse.technique;
    return kermas;
  }
};

TEST_F(Exposure, DoseAreaDoesNotDependOnThePlane) {
  Pulse pulse{{80.0, 50.0, 8.0}, 1050.0, 1, {0.7, 0.4}};
  const double at_panel = dose_area_mgy_cm2(beams, pulse, pulse.sid_mm);
  for (const double plane_mm : {100.0, 635.0, 1000.0, 2000.0})
    EXPECT_NEAR(dose_area_mgy_cm2(beams, pulse, plane_mm) / at_panel, 1.0, 1e-12) << plane_mm;
  // At 1 m: kerma there times the field's area there.
  const double side_cm = 20.0 * 1000.0 / 1050.0;
  EXPECT_NEAR(at_panel, beams.at(80.0).open_kerma_mgy_per_mas() * 0.4 * side_cm * 0.7 * side_cm * 0.4, 1e-12);
}

TEST_F(Exposure, ReferenceKermaIsTheSpectrumsByInverseSquare) {
  Pulse pulse{{80.0, 50.0, 8.0}, 1100.0, 0, {}};
  const double expected = air_kerma_mgy_per_mas(fluoroscope_spectrum(machine, 80.0)) * 0.4 / (0.635 * 0.635);
  EXPECT_NEAR(reference_air_kerma_mgy(beams, pulse) / expected, 1.0, 1e-12);
  pulse.collimator = {0.3, 0.3};
  pulse.sid_mm = 900.0;  // neither leaves nor panel change what the reference point gets
  EXPECT_NEAR(reference_air_kerma_mgy(beams, pulse) / expected, 1.0, 1e-12);
  pulse.technique.ma = 100.0;
  EXPECT_NEAR(reference_air_kerma_mgy(beams, pulse) / expected, 2.0, 1e-12);
}

TEST_F(Exposure, ArrivesFromBothSidesWithoutSwinging) {
  for (const double water_mm : {80.0, 150.0, 200.0, 250.0, 320.0})
    for (const cases::Technique& first :
         {cases::Technique{50.0, 2.0, 8.0}, {120.0, 250.0, 8.0}, {70.0, 30.0, 8.0}}) {
      const auto kermas = kermas_ngy(flat(64, water_mm), first, 6);
      // Within 5 % after one step, 1 % after two, and steady.
      EXPECT_NEAR(kermas[1], kPanelKermaNgy, 0.05 * kPanelKermaNgy) << water_mm << " from " << first.kv;
      for (std::size_t frame = 2; frame < kermas.size(); ++frame)
        EXPECT_NEAR(kermas[frame], kPanelKermaNgy, 0.01 * kPanelKermaNgy) << water_mm << ' ' << frame;
    }
}

// What is seen as one thickness of water is none: still a few frames, and no swinging about the aim.
TEST_F(Exposure, ArrivesBehindAnUnevenPatient) {
  for (const PathLengths& field : {split(64, 60.0, 300.0), split(64, 150.0, 250.0), flat(64, 200.0, 30.0)})
    for (const cases::Technique& first : {cases::Technique{50.0, 2.0, 8.0}, {120.0, 250.0, 8.0}}) {
      const auto kermas = kermas_ngy(field, first, 8);
      for (std::size_t frame = 4; frame < kermas.size(); ++frame)
        EXPECT_NEAR(kermas[frame], kPanelKermaNgy, 0.02 * kPanelKermaNgy) << frame << " from " << first.kv;
      for (std::size_t frame = 2; frame + 1 < kermas.size(); ++frame)
        EXPECT_LE(std::abs(kermas[frame + 1] - kPanelKermaNgy), std::abs(kermas[frame] - kPanelKermaNgy) + 0.1);
    }
}

TEST_F(Exposure, StopsAtTheMachinesLimits) {
  cases::Technique last;
  EXPECT_GT(kermas_ngy(flat(64, 0.0), {80.0, 50.0, 8.0}, 5, &last).back(), kPanelKermaNgy);  // air
  EXPECT_EQ(last.kv, machine.kv_min);
  EXPECT_EQ(last.ma, cases::Fluoroscope{}.ma_min);
  EXPECT_LT(kermas_ngy(flat(64, 550.0), {80.0, 50.0, 8.0}, 5, &last).back(), kPanelKermaNgy);
  EXPECT_EQ(last.kv, machine.kv_max);
  EXPECT_EQ(last.ma, machine.ma_max);
  EXPECT_EQ(last.pulse_ms, machine.pulse_ms);
  // Nothing at all, as behind a closed shutter, asks for the most and harms nothing.
  const cases::Technique blind = automatic.next({70.0, 30.0, 8.0}, 0.0, 1100.0);
  EXPECT_EQ(blind.kv, machine.kv_max);
}

TEST_F(Exposure, FourHundredMillimetresOfWater) {
  const auto kermas = kermas_ngy(flat(64, 400.0), {50.0, 2.0, 8.0}, 6);
  EXPECT_NEAR(kermas.back(), kPanelKermaNgy, 0.05 * kPanelKermaNgy);  // just within a strong machine's reach
}

TEST_F(Exposure, ThickerTakesMoreVoltageCurrentAndDose) {
  cases::Technique before{0.0, 0.0, 8.0};
  double before_mgy = 0.0;
  for (double water_mm = 100.0; water_mm <= 350.0; water_mm += 50.0) {
    cases::Technique last;
    kermas_ngy(flat(64, water_mm), {70.0, 30.0, 8.0}, 6, &last);
    EXPECT_GT(last.kv, before.kv) << water_mm;
    EXPECT_GE(last.ma, before.ma) << water_mm;
    const double mgy = reference_air_kerma_mgy(beams, {last, 1100.0, 0, {}});
    EXPECT_GT(mgy, before_mgy) << water_mm;
    before = last;
    before_mgy = mgy;
    // An adult's abdomen at 15 pulses a second: of the order of 10 mGy/min.
    if (water_mm == 200.0) {
      EXPECT_GT(mgy * 15.0 * 60.0, 3.0);
      EXPECT_LT(mgy * 15.0 * 60.0, 40.0);
      EXPECT_NEAR(last.kv, 75.0, 8.0);
    }
  }
}

// Any size of the metered picture gives the same report; so do leaves that do not reach the measuring field.
TEST_F(Exposure, DoesNotDependOnThePicturesSize) {
  const auto field = [](int size_px) {
    PathLengths lengths = flat(size_px, 0.0);
    for (int row = 0; row < size_px; ++row)
      for (int column = 0; column < size_px; ++column) {
        const double u = (column + 0.5) / size_px - 0.5, v = (row + 0.5) / size_px - 0.5;
        const auto i = static_cast<std::size_t>(row * size_px + column);
        lengths.water_mm[i] = static_cast<float>(220.0 - 150.0 * (u * u + 0.5 * v * v));
        lengths.mineral_mm[i] = static_cast<float>(10.0 + 8.0 * std::sin(9.0 * u));
      }
    return lengths;
  };
  Pulse pulse{{75.0, 30.0, 8.0}, 1100.0, 0, {}};
  const double large = panel_kerma_ngy(beams, pulse, field(512));
  EXPECT_NEAR(panel_kerma_ngy(beams, pulse, field(64)) / large, 1.0, 2e-3);
  EXPECT_NEAR(panel_kerma_ngy(beams, pulse, field(128)) / large, 1.0, 5e-4);
  pulse.collimator = {0.6, 0.5};
  EXPECT_EQ(panel_kerma_ngy(beams, pulse, field(512)), large);
}

TEST_F(Exposure, ByHandWithinTheLimits) {
  asked.automatic_exposure = false;
  asked.kv = 81.4;
  asked.ma = 44.0;
  const Pulse pulse{{70.0, 30.0, 8.0}, 1100.0, 0, {}};
  const auto next = [&] { return meter(beams, automatic, pulse, flat(64, 200.0), asked).next; };
  EXPECT_EQ(next().kv, 81.0);  // whole kilovolts
  EXPECT_EQ(next().ma, 44.0);
  asked.kv = 300.0;
  asked.ma = 0.0;
  EXPECT_EQ(next().kv, machine.kv_max);
  EXPECT_EQ(next().ma, cases::Fluoroscope{}.ma_min);
}

// Behind a slab it is the law of scatter.h; air scatters nothing, and of a field half of air half as much arrives.
TEST_F(Exposure, WhatASlabScattersIsByItsLaw) {
  Pulse pulse{{75.0, 30.0, 8.0}, 1100.0, 0, {}};
  for (const double open : {1.0, 0.5})
    for (const double water_mm : {100.0, 203.0, 300.0}) {
      pulse.collimator = {open, open};
      const double expected =
          std::exp(beams.at(75.0).log_share(water_mm, 0.0)) *
          scatter_to_primary({water_mm, 300.0 * open, 1100.0 - machine.source_isocentre_mm, true});
      EXPECT_NEAR(scatter_share(beams, pulse, flat(64, water_mm)) / expected, 1.0, 0.005) << water_mm;
      EXPECT_NEAR(scatter_share(beams, pulse, split(64, 0.0, water_mm)) / expected, 0.5, 0.005) << water_mm;
    }
  EXPECT_EQ(scatter_share(beams, pulse, flat(64, 0.0)), 0.0);
  EXPECT_LT(scatter_share(beams, pulse, flat(64, 200.0, 20.0)), scatter_share(beams, pulse, flat(64, 200.0)));
  pulse = {{75.0, 30.0, 8.0}, machine.source_isocentre_mm, 0, {}};  // the panel is not within the patient
  EXPECT_NEAR(scatter_share(beams, pulse, flat(64, 200.0)) / (std::exp(beams.at(75.0).log_share(200.0, 0.0)) *
                                                              scatter_to_primary({200.0, 300.0, 100.0, true})),
              1.0, 0.005);
}

// The panel gets as much as ever, of which scatter is a part; a closed field has less of it and takes more current.
TEST_F(Exposure, SeesScatterToo) {
  for (const double water_mm : {150.0, 250.0, 320.0}) {
    double mgy[2] = {};
    for (const std::size_t closed : {0U, 1U}) {
      Pulse pulse{{50.0, 2.0, 8.0}, 1100.0, 0, {closed == 0 ? 1.0 : 0.4, closed == 0 ? 1.0 : 0.4}};
      for (int frame = 0; frame < 8; ++frame) {
        pulse.scatter = scatter_share(beams, pulse, flat(64, water_mm));
        if (frame >= 4) {
          EXPECT_NEAR(panel_kerma_ngy(beams, pulse, flat(64, water_mm)), kPanelKermaNgy, 0.6);
        }
        pulse.technique = meter(beams, automatic, pulse, flat(64, water_mm), asked).next;
      }
      mgy[closed] = reference_air_kerma_mgy(beams, pulse);
    }
    EXPECT_GT(mgy[1], 1.05 * mgy[0]) << water_mm;
  }
}

TEST(OpenField, HoldsThePixelsWhoseCentresAreOpen) {
  const auto expect = [](const OpenField& open, int first_column, int end_column, int first_row, int end_row) {
    EXPECT_EQ(open.first_column, first_column);
    EXPECT_EQ(open.end_column, end_column);
    EXPECT_EQ(open.first_row, first_row);
    EXPECT_EQ(open.end_row, end_row);
  };
  expect(open_field(512, 512, {1.0, 1.0}), 0, 512, 0, 512);
  expect(open_field(512, 512, {0.5, 0.25}), 128, 384, 192, 320);
  expect(open_field(5, 4, {0.05, 0.05}), 2, 3, 1, 3);   // never nothing
  expect(open_field(10, 10, {0.5, 0.49}), 2, 8, 3, 7);  // a centre on the border is open
}

}  // namespace
}  // namespace seldinger::imaging
