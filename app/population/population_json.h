// What is answered about surrogates and simulated studies, as JSON; all of it says that it is synthetic.
#pragma once

#include <string>
#include <vector>

#include "app/population/agreement_text.h"
#include "app/population/distributions.h"
#include "app/population/effects_text.h"
#include "assessment/population/studies/dose_response.h"
#include "assessment/population/studies/simulated_study.h"

namespace seldinger::app {

std::string json_of_fit(const assessment::population::Surrogate& surrogate);
std::string json_of_agreement(const SurrogateAgreement& agreement);
std::string json_of_effects(const SimulatedEffects& effects);
std::string json_of_distributions(const SimulatedDistributions& made);
std::string json_of_doses(const std::vector<assessment::population::MetricDose>& doses,
                          const std::vector<double>& shifts, const assessment::population::DoseOptions& options);
std::string json_of_studies(const assessment::population::StudiesSum& sum,
                            const assessment::population::World& world);

}  // namespace seldinger::app
