// bench --stage ultrasound: what a picture costs with artefacts, clutter, compounding and colour beside one without
// any of it, by turns, one thread, by processor time.
#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>
#include <glm/geometric.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/measure/bench/bench.h"
#include "sim/imaging/ultrasound/colour_screen.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/organs.h"
#include "sim/imaging/ultrasound/view/view.h"
#include "sim/tissue/blood_flow.h"
#include "sim/volume/phantom.h"
#include "sim/volume/tissue/find_tissue.h"

namespace seldinger::measure {
namespace {

using imaging::UltrasoundView;

double thread_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

struct OrgansShown {
  volume::Volume volume;
  std::vector<volume::TissueClass> classes;
  std::vector<std::uint8_t> levels;
  imaging::TissueVolume tissue() const { return {&volume, classes, levels}; }
};

OrgansShown torso_with_organs() {
  volume::Phantom made = volume::make_phantom();
  OrgansShown patient{std::move(made.volume), {}, {}};
  patient.classes = volume::tissue_classes(patient.volume, &made.labels);
  patient.levels = imaging::echogenicity(patient.volume, patient.classes);
  imaging::show_organs(patient.volume, patient.classes, patient.levels);
  return patient;
}

enum class On { nothing, artefacts_and_clutter, compounding_too, colour_too, a_beat_too };
constexpr std::array<const char*, 5> kOnNames = {"nothing of it", "artefacts, clutter", "compounded, too",
                                                 "colour, too", "an artery that beats, too"};

// A picture as the window has it: the envelope by the CPU, the screen, and of a compounded view one look a picture.
class Pictures {
 public:
  Pictures(const OrgansShown& patient, const UltrasoundView& view, On on)
      : patient_(patient), on_(on), view_(view), converter_(view, {800, 700}), compounder_(compounded(view)) {
    view_.threads = 1;
    view_.sight_law = on == On::nothing ? cases::SightLaw::echo : cases::kNewestSightLaw;
    if (on >= On::compounding_too) view_ = compounded(view_);
    const glm::dvec3 target = imaging::point_of(view_, 0.5 * view_.beams, 0.5 * view_.depth_mm);
    inserted_.needle = imaging::NeedlePose{target, glm::normalize(view_.axial + view_.lateral)};
    inserted_.lesions.push_back({target, 5.0, 10.0});
    cases::Structure vessel;
    vessel.name = on == On::a_beat_too ? "carotid" : "portal_vein";
    vessel.tissue = volume::TissueClass::vessel;
    vessel.shape = cases::Tube{{target - 40.0 * view_.lateral, target + 40.0 * view_.lateral}, 4.0};
    flow_ = tissue::BloodFlow(std::span(&vessel, 1));
    for (int i = 0; i < imaging::kLooks; ++i) draw();
  }
  double next_ms() {
    const double begun = thread_ms();
    draw();
    return thread_ms() - begun;
  }

 private:
  static UltrasoundView compounded(UltrasoundView view) {
    view.compound_deg = imaging::kCompoundDeg;
    return view;
  }
  void draw() {
    const std::size_t number = frame_ % imaging::kLooks;
    const bool mixed = on_ >= On::compounding_too;
    const UltrasoundView look = imaging::look_of(view_, mixed ? static_cast<int>(number) : 0);
    const double t_s = 0.02 * static_cast<double>(frame_);
    const tissue::Displacement moved =
        on_ == On::a_beat_too ? flow_.with_pulse({}, imaging::point_of(view_, 0.5 * view_.beams, 60.0), t_s)
                              : tissue::Displacement{};
    imaging::PolarPicture& received = mixed ? looks_[number].picture : picture_;
    imaging::ultrasound_polar(patient_.tissue(), look, inserted_, {}, received, moved);
    clutter_.add(look, {}, received);
    imaging::add_receiver_noise(view_.seed, frame_, received);
    if (mixed && looks_.back().picture.envelope.size() == received.envelope.size())
      compounder_.mean(view_, looks_, picture_);
    if (!picture_.envelope.empty()) converter_.grey(view_, {}, picture_, grey_);
    if (on_ >= On::colour_too) {
      cases::ConsoleSetting asked;
      asked.colour_mm_s = 200.0;
      imaging::colour_polar(patient_.tissue(), view_, inserted_, {}, flow_, asked, t_s, colour_, moved);
      imaging::colour_numbers(colour_screen_, converter_, {}, colour_, numbers_);
    }
    ++frame_;
  }

  const OrgansShown& patient_;
  On on_;
  UltrasoundView view_;
  imaging::ScanConverter converter_;
  std::optional<imaging::ColourScreen> colour_screen_;
  imaging::Compounder compounder_;
  imaging::Clutter clutter_;
  imaging::Inserted inserted_;
  tissue::BloodFlow flow_;
  std::array<imaging::Look, imaging::kLooks> looks_;
  imaging::PolarPicture picture_;
  imaging::ColourPicture colour_;
  std::vector<unsigned char> grey_, numbers_;
  std::uint64_t frame_ = 0;
};

BenchRow row_of(const OrgansShown& patient, const UltrasoundView& view, On on, std::vector<double> ms,
                std::vector<double> ratios) {
  BenchRow row{"ultrasound",
               std::string("picture with ") + kOnNames[static_cast<std::size_t>(on)],
               std::string(view.probe.name) + " 128x1024, processor time",
               "cpu",
               "1 thread",
               bench_size(patient.volume),
               static_cast<int>(ms.size()),
               0,
               0,
               0,
               "",
               "",
               ""};
  std::sort(ms.begin(), ms.end());
  std::sort(ratios.begin(), ratios.end());
  row.ms_median = ms[ms.size() / 2];
  row.ms_min = ms.front();
  row.ms_max = ms.back();
  if (on != On::nothing) {
    row.error = bench_number(100.0 * (ratios[ratios.size() / 2] - 1.0));
    row.error_unit = "% more than with nothing of it";
    row.reference = "the same scene, by turns in this run";
  }
  return row;
}

}  // namespace

void bench_everything_on(bool quick, std::vector<BenchRow>& rows) {
  const OrgansShown patient = torso_with_organs();
  for (const imaging::Probe& probe : {imaging::kC52v, imaging::kL115v}) {
    UltrasoundView view;
    view.probe = probe;
    view.depth_mm = probe.radius_mm > 0.0 ? 150.0 : 50.0;
    // As docs/scenes/us_liver.json, the liver below the ribs.
    view.origin_lps_mm = {-104.0, -79.8, 0.0};
    view.axial = glm::normalize(glm::dvec3(0.3993, 0.7685, 0.5));
    view.lateral = glm::normalize(glm::cross(view.axial, glm::dvec3(0.0, 0.0, 1.0)));
    std::vector<Pictures> pictures;
    pictures.reserve(kOnNames.size());
    for (std::size_t on = 0; on < kOnNames.size(); ++on) pictures.emplace_back(patient, view, static_cast<On>(on));
    std::array<std::vector<double>, kOnNames.size()> ms, ratios;
    for (int i = 0; i < (quick ? 9 : 25); ++i)
      for (std::size_t on = 0; on < pictures.size(); ++on) {
        ms[on].push_back(pictures[on].next_ms());
        ratios[on].push_back(ms[on].back() / ms[0].back());
      }
    for (std::size_t on = 0; on < pictures.size(); ++on)
      rows.push_back(row_of(patient, view, static_cast<On>(on), ms[on], ratios[on]));
  }
}

}  // namespace seldinger::measure
