// demo --programme: what mentors and directors see of a programme in which people have practised.
#pragma once

namespace seldinger::app {

class Arguments;

int run_demo_programme(const Arguments& arguments);

}  // namespace seldinger::app
