// Dose and automatic exposure of a fluoroscope. Everything is metered on path lengths of the whole field, of any
// size (64 × 64 will do), so that dose and exposure never depend on how the displayed picture was projected.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "sim/case/fluoroscope.h"
#include "sim/imaging/xray/beam/detector.h"
#include "sim/imaging/xray/beam/scatter.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

// Air kerma at the panel that automatic exposure keeps, per pulse, in the measuring field: chosen in the middle of
// the 10 to 50 nGy that are usual in pulsed fluoroscopy with flat panels.
constexpr double kPanelKermaNgy = 30.0;
// The measuring field: this share of the field's half width and half height about its middle.
constexpr double kMeasuringShare = 0.5;

// The beams of one machine by tube voltage, built when first asked for (some 2 ms each). Generators set whole
// kilovolts. For one thread at a time.
class Beams {
 public:
  explicit Beams(const cases::Fluoroscope& fluoroscope, const Detector& detector = {}, const BehindCt& ct = {});
  // kv is rounded to a whole number within kMinTubeKv … kMaxTubeKv.
  const BeamSignal& at(double kv);
  const cases::Fluoroscope& fluoroscope() const noexcept { return fluoroscope_; }
  const Detector& detector() const noexcept { return detector_; }

 private:
  cases::Fluoroscope fluoroscope_;
  Detector detector_;
  BehindCt ct_;
  std::map<int, std::unique_ptr<BeamSignal>> by_kv_;
};

// Follows one line from (kv_min, ma_min) to (kv_max, ma_max): the voltage rises evenly along it, the current by
// a constant factor until ma_max at 60 % of the line, the voltage alone after that. From what reached the panel it
// takes the thickness of water that would have let through as much, and finds the point of the line that gives
// kPanelKermaNgy behind that water; so it arrives in one step behind water and in a few behind anything.
class AutomaticExposure {
 public:
  explicit AutomaticExposure(const cases::Fluoroscope& fluoroscope, const Detector& detector = {});
  // What to set after a pulse with `used` that gave this air kerma at a panel at this distance from the focus.
  cases::Technique next(const cases::Technique& used, double panel_kerma_ngy, double sid_mm) const;

 private:
  double log_kerma(double kv, double water_mm) const;  // of nGy per mAs at 1 m
  cases::Fluoroscope fluoroscope_;
  std::vector<double> table_;  // [kv][water]
};

// One pulse: what was set, where the panel stood, and what the patient scatters onto it.
struct Pulse {
  cases::Technique technique;
  double sid_mm = 1100.0;
  int magnification = 0;
  cases::Collimator collimator;
  // On every pixel, as a share of the open beam behind the grid that then stands before the panel (scatter_share).
  // Nothing: primary only, without a grid.
  std::optional<double> scatter{};
  double mas() const noexcept { return technique.ma * technique.pulse_ms / 1000.0; }
  double grid_passes() const noexcept { return scatter ? kGridPrimaryShare : 1.0; }
};

// Pixels whose centres the collimator leaves open: first ≤ x < end.
struct OpenField {
  int first_column = 0, end_column = 0, first_row = 0, end_row = 0;
};
OpenField open_field(int width_px, int height_px, const cases::Collimator& collimator) noexcept;

// Free in air at the interventional reference point (150 mm from the isocentre towards the source), mGy.
double reference_air_kerma_mgy(Beams& beams, const Pulse& pulse);
// Air kerma times area of the open field at this distance from the focus, mGy cm²: the same at any distance.
double dose_area_mgy_cm2(Beams& beams, const Pulse& pulse, double plane_mm);

// What a pulse's `scatter` is behind what `field` holds (as below): the mean over the open field of what each of
// its pixels would have behind a slab of the water that weakens the beam as much (scatter.h). The patient's middle
// is taken to lie at the isocentre.
double scatter_share(Beams& beams, const Pulse& pulse, const PathLengths& field);

// Mean over the measuring field, behind what `field` (the lengths across the whole field, uncollimated) holds, nGy.
double panel_kerma_ngy(Beams& beams, const Pulse& pulse, const PathLengths& field);

// The report of one pulse; `frame` and `hand_in_beam` are left to the caller. `next` is what automatic exposure
// asks, or what `asked` sets by hand within the machine's limits.
cases::ExposureReport meter(Beams& beams, const AutomaticExposure& automatic, const Pulse& pulse,
                            const PathLengths& field, const cases::FluoroscopeInputs& asked);

}  // namespace seldinger::imaging
