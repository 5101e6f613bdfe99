// An introducer: a tube through which a core needle goes. With its stylet in, it is what is pushed; with the stylet
// out, it stays where it stands, and the needle slides in it.
#pragma once

#include "sim/case/event.h"

namespace seldinger::cases {

enum class Introducer { none, closed, open };  // its stylet
inline constexpr int kIntroducers = 3;

// Taken up outside the body, its stylet in; drawn there, it is put aside. In the body it stays once its stylet is
// drawn, and goes on with the needle once that is in again; none is taken up there.
constexpr Introducer introducer_after(EventKind said, bool in_body, Introducer now) noexcept {
  if (said == EventKind::stylet_in) return in_body && now == Introducer::none ? now : Introducer::closed;
  if (said == EventKind::stylet_out && now == Introducer::closed)
    return in_body ? Introducer::open : Introducer::none;
  return now;
}

}  // namespace seldinger::cases
