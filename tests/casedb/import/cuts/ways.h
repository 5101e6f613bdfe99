// Sixty ways in which a CT comes cropped, coarse, enhanced, noisy and with metal.
#pragma once

#include <vector>

#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/sim/volume/tissue/enhanced_torso.h"

namespace seldinger::volume {

struct Way {
  Crop crop;
  int spacing_mm = 2;
  TorsoPhase phase = TorsoPhase::none;
  double noise_sd_hu = 0.0;
  bool metal = false;
};

// Every crop once. Spacings (1, 2, 3, 5 mm), phases, noise (6, 12, 20 HU) and metal go round so that each spacing
// meets each phase, each noise and metal, over all kinds of crops.
std::vector<Way> ways();

// The same but for the crop: they are of one patient.
bool alike(const Way& one, const Way& other);

// A real CT seen that way, before it is cropped; its phase is its own. Metal is a pin of 6 mm, 60 mm long, through
// its middle.
Volume seen(const Volume& ct, const Way& way);

// The truth of a field that was cropped of the torso; nothing is known of padding, which is air.
EnhancedTorso cropped(const EnhancedTorso& torso, const std::vector<std::uint8_t>& body, const Crop& crop);

}  // namespace seldinger::volume
