// What comes back through an open needle, and where contrast goes that is injected through it.
//
// Return: as Hagen and Poiseuille have it, the bore's radius⁴ · π · pressure / (8 · viscosity · length). It is seen
// at the hub once it has filled the bore: at once from an artery, after a second from a calyx, slowly from a vein.
// Contrast: a stirred tank that grows. What comes in, contrast and the lumen's own flow, pushes the front on;
// behind it all is mixed; once the front has gone through the lumen, as much leaves as comes in, at the mixture's
// concentration. So a full lumen is rinsed exponentially (Hamilton et al., Am. J. Physiol. 99 (1932) 534). Outside
// a lumen contrast stays where it is.
#pragma once

#include "sim/case/case.h"
#include "sim/case/inputs.h"
#include "sim/case/needle_flow.h"
#include "sim/case/state.h"
#include "sim/tissue/lumens.h"

namespace seldinger::engine {

// One push of the syringe, by hand (design: half of it a second fills a collecting system in some ten).
constexpr double kPushMl = 2.0, kPushMlS = 1.0;

class NeedleFlows {
 public:
  // The scene must outlive it.
  explicit NeedleFlows(const cases::Case& scene);

  // After a step: what the inputs asked, and where the needle is now. Until a stylet is drawn, or something drawn
  // or injected through the needle, it changes nothing. Allocates nothing.
  void advance(const cases::Inputs& inputs, const cases::NeedleState& needle, double dt_s,
               cases::NeedleFlow& flow) const noexcept;

  const tissue::Lumens& lumens() const noexcept { return lumens_; }

 private:
  void hear(const cases::Inputs& inputs, const cases::NeedleState& needle, std::int32_t lumen,
            cases::NeedleFlow& flow) const noexcept;
  void run_back(std::int32_t lumen, double dt_s, cases::NeedleFlow& flow) const noexcept;
  void spread(std::int32_t lumen, const glm::dvec3& tip_lps_mm, double pushed_ml, double dt_s,
              cases::NeedleFlow& flow) const noexcept;

  tissue::Lumens lumens_;
  double bore_ml_ = 0.0;         // 0: nothing runs through this instrument
  double conductance_m3_ = 0.0;  // of the bore: flow is this times pressure over viscosity
};

}  // namespace seldinger::engine
