// The board of a workshop's day: nobody is logged in, and whoever has its code sees it.
#pragma once

#include "web/http.h"

namespace seldinger::web {

class Site;
struct Call;

Response show_board(Site& site, const Call& call);

}  // namespace seldinger::web
