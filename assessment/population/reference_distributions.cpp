#include "assessment/population/reference_distributions.h"

namespace seldinger::assessment::population {
namespace {

constexpr std::string_view kKeri = "Keri et al., Can. J. Anesth. 62, 2015, 777";
constexpr std::string_view kXia2018 = "Xia et al., Proc. SPIE 2018, 10.1117/12.2293789";
constexpr std::string_view kMokhtar = "Mokhtar et al., BMC Med. Educ. 24, 2024, 1350, PMC11583760";
constexpr std::string_view kGuidance = "Needle guidance in porcine phantoms, PMC5318157";
constexpr std::string_view kGriffiths = "Griffiths et al., Crit. Ultrasound J. 9, 2017, 9, PMC5376999";
constexpr std::string_view kFulton = "Fulton et al., AJR 207, 2016, 1329";
constexpr std::string_view kMiyazaki = "Miyazaki et al., BMJ Open 15, 2025, e095803";
constexpr std::string_view kGreiner = "Greiner et al., BMC Med. Educ. 25, 2025, 551, PMC12004677";
constexpr std::string_view kPhal = "Phal et al., AJR 184, 2005, 1652";
constexpr std::string_view kLaser = "Free hand and laser guide, Br. J. Radiol. 86, 2013, 20130026, PMC3755392";
constexpr std::string_view kHayward = "Hayward et al., 10.1177/11297298251315237";
constexpr std::string_view kSpeer = "Speer et al., Reg. Anesth. Pain Med. 38, 2013, 350";

constexpr std::string_view kPlusMinus =
    "time to reach the target; the abstract says ±, taken as one standard deviation";
constexpr std::string_view kOfPhantoms = "performance time of a biopsy of a phantom";
constexpr std::string_view kBothGroups = "in both groups";

struct Whose {
  std::string_view source, group, level;
  std::size_t n;
  std::string_view counted = "people";
};
struct Measured {
  std::string_view metric, unit;
};
constexpr Measured kTotal{"time_total", "s"}, kToTarget{"time_puncture_to_target", "s"},
    kPathInTissue{"path_in_tissue", "mm"}, kInefficiency{"path_inefficiency", "%"}, kSwept{"swept_area", "mm²"},
    kDistance{"tip_target_dist", "mm"}, kPunctures{"skin_punctures", "count"},
    kWithdrawals{"withdrawals_partial", "count"}, kFirstPass{"first_pass_success", "share"};

constexpr ReferenceDistribution lone(const Whose& whose, const Measured& what, Centre centre, double value,
                                     std::string_view how) {
  return {whose.source, whose.group, what.metric, whose.level, centre,        value, Spread::none,
          0.0,          0.0,         what.unit,   whose.n,     whose.counted, how};
}
constexpr ReferenceDistribution mean_and_sd(const Whose& whose, const Measured& what, double mean, double sd,
                                            std::string_view how) {
  ReferenceDistribution row = lone(whose, what, Centre::mean, mean, how);
  row.spread = Spread::standard_deviation;
  row.low = mean - sd;
  row.high = mean + sd;
  return row;
}
constexpr ReferenceDistribution median_and_quartiles(const Whose& whose, const Measured& what, double median,
                                                     double q1, double q3, std::string_view how,
                                                     double unit = 1.0) {
  ReferenceDistribution row = lone(whose, what, Centre::median, unit * median, how);
  row.spread = Spread::quartiles;
  row.low = unit * q1;
  row.high = unit * q3;
  return row;
}

// Of 24 residents in two groups; how many were in each the abstract does not say.
constexpr Whose kKeriControl{kKeri, "residents at a spine model", "intermediate", 24, kBothGroups};
constexpr Whose kKeriTrained{kKeri, "the same, after training with Perk Tutor", "intermediate", 24, kBothGroups};
constexpr Whose kXiaFirst{kXia2018, "novices, first vascular access", "novice", 19};
constexpr Whose kXiaLast{kXia2018, "the same novices after practice", "novice", 19};
constexpr Whose kBluePhantom{kMokhtar, "novices at a phantom block", "novice", 47};
constexpr Whose kNeedleTrainer{kMokhtar, "the same novices at NeedleTrainer", "novice", 47};
constexpr Whose kResidents{kFulton, "radiology residents, first biopsy of a phantom", "intermediate", 20};
constexpr std::string_view kPath =
    "needle's path, in plane; whether a mean or a median what was read does not say. Too short for one with the "
    "way "
    "outside the body, so held against the path in tissue";

constexpr double kSquareMmOfSquareCm = 100.0, kSecondsOfMinutes = 60.0;

constexpr ReferenceDistribution kDistributions[] = {
    lone(kResidents, kTotal, Centre::mean, 92.3 / 0.68,
         "the drop after training over the share that it is of the first value: 92.3 s are 68 %"),
    median_and_quartiles({kMiyazaki, "residents, jugular vein of a simulator", "intermediate", 20}, kTotal, 30.0,
                         20.4, 95.4, "from the probe on the field until the vein is punctured; out of plane"),
    median_and_quartiles({kGreiner, "students, breast biopsy, cart-based scanner", "novice", 16}, kTotal, 0.60,
                         0.30, 2.09, kOfPhantoms, kSecondsOfMinutes),
    median_and_quartiles({kGreiner, "students, breast biopsy, handheld scanner", "novice", 16}, kTotal, 0.63, 0.37,
                         1.08, kOfPhantoms, kSecondsOfMinutes),
    lone({kPhal, "physicians of all levels, liver phantom, free hand", "intermediate", 10}, kTotal, Centre::median,
         32.0, "from the needle in the hand to firing; a maker of guides gives a mean of 50 s for the same study"),
    lone({kLaser, "students, olive in turkey breast, free hand", "novice", 82, kBothGroups}, kTotal, Centre::mean,
         45.5, "in brackets 23.0 s; 7.0-55.0 s, which the abstract does not explain"),
    median_and_quartiles({kHayward, "advanced users, vein of a tofu model", "expert", 80, "in all four groups"},
                         kTotal, 28.5, 24.0, 40.0, "dynamic technique; how many were in each group is not told"),
    mean_and_sd(kBluePhantom, kToTarget, 16.0, 8.0, kPlusMinus),
    mean_and_sd(kNeedleTrainer, kToTarget, 8.0, 3.0, kPlusMinus),
    lone({kGriffiths, "students, vein of a model, in plane", "novice", 30}, kToTarget, Centre::mean, 52.8,
         "from the first puncture of the skin to aspiration"),
    lone({kSpeer, "novices, pork phantom, along the line of sight", "novice", 24}, kToTarget, Centre::mean, 35.7,
         "time to guide the needle to the target"),
    median_and_quartiles(kKeriControl, kPathInTissue, 629.7, 306.4, 2879.1, "needle's path inside the tissue"),
    median_and_quartiles(kKeriTrained, kPathInTissue, 426.0, 164.9, 571.6, "needle's path inside the tissue"),
    lone(kXiaFirst, kPathInTissue, Centre::not_told, 58.0, kPath),
    lone(kXiaLast, kPathInTissue, Centre::not_told, 41.1, kPath),
    lone(kXiaFirst, kInefficiency, Centre::not_told, 127.1,
         "whether a mean or a median what was read does not say"),
    lone(kXiaLast, kInefficiency, Centre::not_told, 45.8, "whether a mean or a median what was read does not say"),
    median_and_quartiles(kKeriControl, kSwept, 128.3, 50.3, 208.2, "potential tissue damage, from cm²",
                         kSquareMmOfSquareCm),
    median_and_quartiles(kKeriTrained, kSwept, 39.7, 21.3, 42.7, "potential tissue damage, from cm²",
                         kSquareMmOfSquareCm),
    mean_and_sd({kGuidance, "anesthesiologists and residents", "intermediate", 140, "attempts of 35 people"},
                kDistance, 2.6, 2.8,
                "in plane, conventional ultrasound; the abstract says ±, taken as one standard deviation"),
    lone({kGriffiths, "students, vein of a model, in plane", "novice", 30}, kPunctures, Centre::mean, 1.30,
         "attempts needed"),
    lone(kResidents, kPunctures, Centre::mean, 1.1 / 0.50,
         "the drop after training over the share that it is of the first value: 1.1 are 50 %"),
    lone(kResidents, kWithdrawals, Centre::mean, 2.5 / 0.66,
         "gross needle adjustments: the drop after training over the share that it is of the first value: 2.5 are "
         "66 %"),
    median_and_quartiles({kHayward, "novices, vein of a tofu model", "novice", 80, "in all four groups"},
                         kWithdrawals, 1.0, 0.0, 2.75,
                         "needle passes, 2 (1 to 3.75), less the first; dynamic technique; how many were in each "
                         "group is not told"),
    lone(kBluePhantom, kFirstPass, Centre::share, 1.0, "first pass, of 100 %"),
    lone(kNeedleTrainer, kFirstPass, Centre::share, 0.809, "first pass, of 80.9 %"),
    lone({kGuidance, "anesthesiologists and residents", "intermediate", 280, "attempts of 35 people"}, kFirstPass,
         Centre::share, 214.0 / 280.0,
         "done on the first pass: 214 of 280, conventional ultrasound, in and out of plane"),
};

}  // namespace

std::span<const ReferenceDistribution> reference_distributions() {
  return kDistributions;
}

std::optional<statistics::Interval> spread_of(const ReferenceDistribution& row) {
  if (row.spread == Spread::none) return std::nullopt;
  return statistics::Interval{row.low, row.high};
}

const char* words(Centre centre) noexcept {
  switch (centre) {
    case Centre::mean:
      return "mean";
    case Centre::median:
      return "median";
    case Centre::share:
      return "share";
    case Centre::not_told:
      return "mean or median";
  }
  return "";
}

const char* words(Spread spread) noexcept {
  switch (spread) {
    case Spread::none:
      return "no spread reported";
    case Spread::standard_deviation:
      return "SD";
    case Spread::quartiles:
      return "quartiles";
  }
  return "";
}

}  // namespace seldinger::assessment::population
