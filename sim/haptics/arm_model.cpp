#include "sim/haptics/arm_model.h"

#include <algorithm>
#include <cstring>

namespace seldinger::haptics {
namespace {

// Viscous friction 0.005 N s/m and one tick of delay everywhere (our judgement). "Recalled": from memory of
// makers' sheets or of what is named, not checked against it.
constexpr ArmModel kDevices[] = {
    {"omni", 0.045, 5e-6, 0.26, 0.055, 3.3, 0.88, 1, "maker's sheet (recalled); forces: thesis §5.3.2"},
    {"desktop", 0.045, 5e-6, 0.06, 0.023, 7.9, 1.75, 1, "forces: thesis §5.3.2; rest recalled, friction 0.06 N"},
    {"premium", 0.075, 5e-6, 0.04, 0.030, 8.5, 1.4, 1,
     "peak: CHAI3D 3.3's limit for it; rest maker's sheet (recalled)"},
    {"inverse3", 0.100, 5e-6, 0.10, 0.010, 10.0, 5.0, 1, "(design): no measured figure is at hand"},
};

// The sets span fingertip to wrist, 0.006-0.2 kg, 1-15 N s/m, 100-1000 N/m (recalled).
constexpr Hand kHands[] = {
    {"none", 0.0, 0.0, 0.0, "the user lets go"},
    {"fingertip", 0.006, 0.004, 0.3, "the range's light end (Hajian and Howe 1997, recalled)"},
    {"light", 0.05, 0.001, 0.1, "within the range (design)"},
    {"medium", 0.15, 0.005, 0.3, "within the range (design)"},
    {"firm", 0.2, 0.015, 1.0, "the range's heavy end (recalled)"},
};

template <typename Row, std::size_t N>
const Row* find(const Row (&rows)[N], const char* name) {
  for (const Row& row : rows)
    if (std::strcmp(row.name, name) == 0) return &row;
  return nullptr;
}

}  // namespace

std::span<const ArmModel> arm_models() {
  return kDevices;
}

std::span<const Hand> hands() {
  return kHands;
}

const ArmModel* find_arm_model(const char* name) {
  return find(kDevices, name);
}

const Hand* find_hand(const char* name) {
  return find(kHands, name);
}

double stiffness_n_mm(const ArmModel& device) {
  const double bound_n_mm =
      stiffness_bound_n_mm(device.damping_n_s_mm + kWallDampingNSMm, kTickS, device.delay_ticks * kTickS);
  return std::min(bound_n_mm / kStiffnessMargin, kMostStiffnessNMm);
}

NeedleSettings needle_settings(const ArmModel& device) {
  NeedleSettings settings;
  settings.stiffness_n_mm = stiffness_n_mm(device);
  return settings;
}

}  // namespace seldinger::haptics
