// One whole tick of an attempt: hands through the arms into the step, the tissue that moves, what it asks of the
// hands, how the patient reacts, and what a recording keeps of it. Everything fixed once the case is loaded is in
// Tick, everything that changes in TickState; the same for an attempt and for its replay.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "sim/case/case.h"
#include "sim/case/event.h"
#include "sim/case/inputs.h"
#include "sim/case/record/recorded_tick.h"
#include "sim/engine/moving_tissue.h"
#include "sim/engine/needle_flow.h"
#include "sim/engine/patient.h"
#include "sim/engine/tick_state.h"
#include "sim/haptics/two_hands.h"

namespace seldinger::engine {

// An introducer's tube that stands in tissue while the needle slides in it or is out of it: where it went in, and
// its end, at rest.
struct StandingTube {
  glm::dvec3 entry_lps_mm{0.0}, end_lps_mm{0.0};
};

// What is shown of a tick, by whoever draws: where everything is, and what the hands feel.
struct Moment {
  cases::State state;
  tissue::Displacement displacement{};
  std::optional<cases::ForceSample> force{};           // none: nothing is felt in this case
  cases::EventKind reaction = cases::EventKind::none;  // the patient's last
  double reaction_t_s = 0.0;
  cases::EventKind event = cases::EventKind::none;  // what was said, or a mentor let happen, last
  double event_t_s = 0.0;
  std::uint32_t capsules = 0;  // that the needle opened since the beginning,
  double capsule_n = 0.0;      // and the force that the last one took
  // PatientState's: the latest places of the skin that are numb, at rest, and how many there were.
  std::uint32_t numbed = 0;
  std::array<glm::dvec3, kNumbPlaces> numb_lps_mm{};
  std::uint32_t deep = 0;              // places about a tip in tissue were made numb
  haptics::Introducer introducer{};    // of a core needle
  std::optional<StandingTube> tube{};  // of an open one, until another hole is sought
  // PatientState's: the latest places where the skin is nicked, at rest, and how many there were.
  std::uint32_t nicked = 0;
  std::array<glm::dvec3, kNickPlaces> nick_lps_mm{};
  double told_s = 0.0;  // when what the hands wanted last was told, by whoever's clock told it; 0: it was not
};

Moment moment_of(const TickState& now) noexcept;

// A mentor's events, each put into the first tick from its time on in which nobody else says anything.
class Scenario {
 public:
  // By rising time; what they lie in outlives it.
  explicit Scenario(std::span<const cases::Event> events) : events_(events) {}
  // t_s: before the tick. `happened`: how many of the events have.
  void add_to(cases::Inputs& inputs, double t_s, std::uint32_t& happened) const noexcept;

 private:
  std::span<const cases::Event> events_;
};

// Which tools an arm says the place of; a hand's wish passes the virtual arm first.
struct ToolsRead {
  bool needle = false, probe = false;
};

// Remembers nothing between two ticks: any number of attempts at one case may share it.
class Tick {
 public:
  // The scene must outlive it. Without classes in it nothing is felt, and hands move no tissue.
  explicit Tick(const cases::Case& scene);

  // One tick of what tools and buttons say, and what it leaves behind. Pure: the same arguments give the same bits
  // on every machine. Allocates nothing.
  cases::RecordedTick advance(const cases::Inputs& inputs, double dt_s, TickState& now) const noexcept;
  // The same of base::kTickS and of where hands want their tools to be.
  cases::RecordedTick advance_hands(const cases::Inputs& hands, ToolsRead read, TickState& now) const noexcept;

  // From where a hand holds its tool to where that is in tissue at rest, by which forces are told.
  void bring_to_rest(const TickState& now, haptics::HandInput& hand) const noexcept;

 private:
  std::optional<cases::ForceSample> feel(double elapsed_s, TickState& now) const noexcept;
  std::optional<glm::dvec3> rest_of(const glm::dvec3& tip_lps_mm, const TickState& now) const noexcept;

  const cases::Case& scene_;
  MovingTissue tissue_;
  Patient patient_;
  NeedleFlows flows_;
  std::optional<haptics::TwoHands> hands_;
};

}  // namespace seldinger::engine
