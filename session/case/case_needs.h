// What a case's scene needs, and what it costs: `case explain`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "sim/case/case.h"

namespace seldinger::session {

constexpr int kMostMotionSources = 16;  // shaders/shared: one displacement holds no more

struct CaseNeed {
  std::string what;  // "volume"
  std::size_t bytes = 0;
};

// A cause that can displace the scene's tissue.
struct MotionSource {
  std::string kind;  // press, needle tip, needle shaft, vein, breath
  std::string name;  // of a vein; else empty
  std::size_t bytes = 0;
};

struct CaseNeeds {
  std::vector<CaseNeed> held;          // as long as the scene is open
  std::vector<MotionSource> sources;   // at most kMostMotionSources
  std::size_t displacement_bytes = 0;  // of a picture's or tick's displacement; 0: none is made
  // Under ultrasound: the vessels whose flow colour Doppler shows, and those of which it knows nothing.
  std::vector<std::string> flowing, unknown_flow;
  // ns of one point with all sources acting, there and back to rest; 0: nothing is asked. Measured here and now.
  double there_ns = 0.0, back_ns = 0.0;
};

// The scene as an attempt has it.
CaseNeeds needs_of_case(const cases::Case& scene);

}  // namespace seldinger::session
