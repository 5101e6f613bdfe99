// The fluoroscopy room of a case: what each pulse of the machine costs and shows. The one place where attempts meet
// X-ray imaging. Holds what a projection needs and answers for a State; the next tick takes the report in as an
// input, so that a replay needs no imaging.
#pragma once

#include <cstdint>
#include <memory>

#include "assessment/operators/fluoroscopy.h"
#include "session/guidance/grey_picture.h"
#include "sim/case/case.h"
#include "sim/case/record/recording.h"
#include "sim/case/state.h"
#include "sim/imaging/xray/panel.h"
#include "sim/tissue/displacement.h"

namespace seldinger::session {

class FluoroscopySight {
 public:
  // `scene` must outlive it.
  explicit FluoroscopySight(const cases::Case& scene);
  ~FluoroscopySight();

  struct Exposed {
    cases::ExposureReport report;
    cases::FrameTruth truth;     // with the beam
    assessment::PictureFix fix;  // where a person would see tip and target
  };
  // Of the pulse that `state` has due, its tissue displaced so. Metered on a small picture of its own, so that it
  // does not depend on the one that is displayed, if any is.
  Exposed expose(const cases::State& state, const tissue::Displacement& displacement = {});

  // Of the pictures from the next on; an ideal one unless it is told.
  void set_panel(imaging::Panel panel);
  // The picture that the pulse of `state` gave. `seed` is the noise's: another attempt's is another's.
  GreyPicture picture(const cases::State& state, std::uint64_t seed, const tissue::Displacement& displacement = {});

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace seldinger::session
