// Fifty browsers that ask a server for the pages of their roles, and how long they wait.
#pragma once

#include <chrono>
#include <cstddef>

namespace seldinger::load {

// Serves a library of so many attempts to 50 people of every role for so long. Each asks for all
// of their pages once, and then for one after the other, half a second after they had the last; meanwhile somebody
// stores an attempt every five seconds. Prints how long each route took, which is the machine's as well; asserts
// that every answer was right, and that every route was asked.
void serve_fifty(int attempts, std::chrono::seconds time);

// What a browser with nothing kept loads of each page, compressed as a proxy does: the page, its style sheet,
// scripts and pictures.
void check_first_loads(int attempts, std::size_t most_bytes);

}  // namespace seldinger::load
