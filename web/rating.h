// Replays rated by whoever has a rater's key: nobody is logged in, and nothing tells whose a replay is. What the
// browser keeps is the key's hash, which the library knows only as a hash of its own.
#pragma once

#include "web/http.h"

namespace seldinger::web {

class Site;
struct Call;

Response show_film_script(Site& site, const Call& call);
Response show_rating_start(Site& site, const Call& call);
Response open_rating_bench(Site& site, const Call& call);
Response show_rating_bench(Site& site, const Call& call);
Response show_rating(Site& site, const Call& call);
Response keep_rating(Site& site, const Call& call);

}  // namespace seldinger::web
