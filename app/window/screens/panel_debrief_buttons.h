// What can be done from the debrief: what comes next, once more, a replay, the list.
#pragma once

#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"

namespace seldinger::app {

// Done after the screen is drawn: what it shows goes with the debrief.
enum class Wish { none, next, again, watch, expert, cases, log_out };

// What is still missing for proficient, in words; nothing where no pass counts towards it.
void draw_missing(const Trainer& trainer);

// `escapes`: whether the key Escape is theirs.
Wish draw_debrief_buttons(Trainer& trainer, const Keys& keys, bool escapes);
void do_wish(Trainer& trainer, Wish wish);

}  // namespace seldinger::app
