#include "session/monitor/guidance_screen.h"

namespace seldinger::session {

GuidanceScreen::GuidanceScreen(const cases::Case& scene, std::uint64_t seed)
    : guidance_(guidance_of(scene)), seed_(seed) {}

void GuidanceScreen::tick(const cases::State& state, const tissue::Displacement& displacement) {
  live_ = guidance_->live(state);
  if (!live_ || !guidance_->due(state)) return;
  shown_ = state;
  shown_displacement_ = displacement;
  drawn_ = false;
}

const GreyPicture& GuidanceScreen::picture() {
  if (drawn_) return picture_;
  drawn_ = true;
  // Numbered as the loop that made the attempt counted its pictures.
  const auto number = static_cast<std::uint64_t>(guidance_->state().clock.count());
  picture_ = guidance_->picture(shown_, shown_displacement_, {seed_, number});
  return picture_;
}

}  // namespace seldinger::session
