// What is answered about surrogates and simulated studies, as JSON; all of it says that it is synthetic.
#pragma once

#include <string>
#include <vector>

#include "app/population/effects_text.h"
#include "assessment/population/agreement.h"
#include "assessment/population/studies/simulated_study.h"

namespace seldinger::app {

struct LevelAgreement {
  std::string group;
  assessment::population::Agreement agreement;
};

std::string json_of_fit(const assessment::population::Surrogate& surrogate);
std::string json_of_agreement(const std::vector<LevelAgreement>& levels);
std::string json_of_effects(const SimulatedEffects& effects);
std::string json_of_studies(const assessment::population::StudiesSum& sum,
                            const assessment::population::World& world);

}  // namespace seldinger::app
