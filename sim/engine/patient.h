// How the patient reacts to what is done and asked: pain where the needle meets bone or skin that is not numb,
// holding the breath, and what runs back through an open needle. A phantom never does. Same inputs, same reactions,
// on every machine.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <span>

#include "sim/case/case.h"
#include "sim/case/event.h"
#include "sim/case/inputs.h"
#include "sim/case/state.h"

namespace seldinger::engine {

// How far about its place an anaesthetic works (a wheal and what spreads from it): judgement. That it takes a
// minute to work is left out: nobody trains waiting. What is given at the skin leaves bone below it as it was; what
// is told with a length goes through the needle, and works about its tip, on bone too (decision 0072).
constexpr double kNumbMm = 15.0;
inline constexpr std::size_t kNumbPlaces = 4;  // that are remembered, of each
inline constexpr std::size_t kNickPlaces = 4;  // the same, of nicks
// Bone felt again so much later hurts again.
constexpr double kBoneAgainSeconds = 0.5;

// What must be kept from tick to tick. A new one: nothing was done yet.
struct PatientState {
  std::array<glm::dvec3, kNumbPlaces> numb_lps_mm{};  // the latest places of the skin, at rest,
  std::uint32_t numbed = 0;                           // and how many there were
  std::array<glm::dvec3, kNumbPlaces> deep_lps_mm{};  // the same of those about a tip in tissue
  std::uint32_t deep = 0;
  std::array<glm::dvec3, kNickPlaces> nick_lps_mm{};  // the latest places of the skin that are cut, at rest,
  std::uint32_t nicked = 0;                           // and how many there were
  bool was_in_body = false, held = false, let_go = false;
  cases::LumenContent returned = cases::LumenContent::none;  // that was told
  double bone_s = -1e9;
  std::array<cases::EventKind, 4> waiting{};  // reactions not told yet, in their order
};

// Where the skin is cut.
std::span<const glm::dvec3> nicks_of(const PatientState& patient) noexcept;

class Patient {
 public:
  // The scene must outlive it. Without classes nothing is bone.
  explicit Patient(const cases::Case& scene);

  // After a tick: what the inputs asked, and where the needle is now. At most one reaction a tick; a second one
  // comes in the next. Allocates nothing.
  cases::EventKind advance(const cases::Inputs& inputs, const cases::State& state,
                           PatientState& patient) const noexcept;

 private:
  // The tip, the skin and bone as they lie in the patient at rest.
  glm::dvec3 pointed_at(const cases::NeedleState& needle) const noexcept;
  void numb(const cases::Inputs& inputs, const cases::NeedleState& needle, PatientState& patient) const noexcept;
  bool in_bone(const glm::dvec3& tip_lps_mm) const noexcept;

  const cases::Case& scene_;
  glm::dmat4 voxel_from_lps_{1.0};
};

}  // namespace seldinger::engine
