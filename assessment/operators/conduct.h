// What a trainee says and asks for around the puncture (docs/clinical.md, "Steps around the puncture"), step by
// step, and whether he defers it. Left out with the profile's probability.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "assessment/operators/profile.h"
#include "sim/base/rng.h"
#include "sim/case/event.h"
#include "sim/case/subject.h"

namespace seldinger::assessment {

// What is known of the patient before. Around a phantom only the probe is checked and the plan noted.
struct Brief {
  std::optional<double> inr, platelets_per_nl;  // 10⁹/l
  cases::Subject subject = cases::Subject::patient;
};

// SIR 2019, high-risk biopsy: INR at most 1.5 to 1.8, platelets at least 50 · 10⁹/l (docs/clinical.md).
constexpr double kMostInr = 1.8, kLeastPlateletsPerNl = 50.0;
bool forbids(const Brief& brief) noexcept;

class Conduct {
 public:
  // hold_breath: may be left out; ask_breath: by who has made up his mind.
  enum class Part { sign_in, prepare, hold_breath, ask_breath, finish };

  Conduct(const Skills& skills, const Brief& brief, bool with_probe, std::uint64_t seed);

  void begin(Part part);
  // The step that is done in this tick, or none.
  cases::EventKind advance(double dt_s);
  bool over() const noexcept { return next_ == steps_.size() && wait_s_ <= 0.0; }
  // A mentor's event.
  void hear(cases::EventKind kind);
  // Whether hands keep still until the trouble is over.
  bool stopped() const noexcept { return stopped_s_ > 0.0; }
  // Whether there is to be no puncture; known once the sign-in is over.
  bool deferred() const noexcept { return deferred_; }

 private:
  Skills skills_;
  bool patient_, forbidden_, with_probe_;
  base::Rng rng_;
  std::vector<cases::EventKind> steps_;
  std::size_t next_ = 0;
  double wait_s_ = 0.0, stopped_s_ = 0.0;
  bool deferred_ = false, breath_asked_ = false;
};

}  // namespace seldinger::assessment
