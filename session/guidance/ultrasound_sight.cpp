#include "session/guidance/ultrasound_sight.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "assessment/operators/probe_over.h"
#include "sim/base/check.h"
#include "sim/imaging/ultrasound/colour_screen.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/console.h"
#include "sim/imaging/ultrasound/mirror.h"

namespace seldinger::session {
namespace {

constexpr double kLinearToMm = 35.0;
constexpr double kTargetShare = 0.6, kDepthStepMm = 5.0, kLeastDepthMm = 30.0;
constexpr double kScreenHz = 60.0;
// A hand presses the face in until its ends touch too: a curved one's rise 10 mm above its middle (design). Where
// tissue does not yield the picture begins so much deeper.
constexpr double kPressCurvedMm = 10.0, kPressStraightMm = 3.0;
constexpr double kStaleLooksS = 1.0;   // looks that old are not laid over a new one; no slow picture takes so long
constexpr double kBesideFaceMm = 3.0;  // room for the needle
constexpr double kWayStepMm = 4.0, kNearSkinMm = 12.0, kNearSkinStepMm = 1.0;

const imaging::Probe& probe_of(const cases::Picture& picture) {
  const imaging::Probe* probe = imaging::probe_named(picture.probe);
  CHECK(probe != nullptr);
  return *probe;
}

double half_face_mm(const imaging::Probe& probe) {
  const double half_mm = 0.5 * probe.elements * probe.pitch_mm;
  return probe.radius_mm > 0.0 ? probe.radius_mm * std::sin(half_mm / probe.radius_mm) : half_mm;
}

double press_mm(const imaging::Probe& probe) {
  return probe.radius_mm > 0.0 ? kPressCurvedMm : kPressStraightMm;
}

double sound_rate_hz(double depth_mm) {
  return std::min(kScreenHz, imaging::frame_rate_hz(depth_mm, imaging::UltrasoundView{}.beams));
}

imaging::UltrasoundView held(imaging::UltrasoundView view, const cases::ToolPose& probe) {
  view.origin_lps_mm = probe.position_lps_mm;
  view.axial = probe.axis;
  view.lateral = probe.side;
  return view;
}

}  // namespace

std::vector<float> element_depths(const cases::MeshIndex& skin, const imaging::UltrasoundView& view, int stride,
                                  const tissue::Displacement& displacement) {
  const imaging::Probe& probe = view.probe;
  std::vector<float> depths(static_cast<std::size_t>(probe.elements), -1e3F);
  if (skin.empty()) return depths;
  CHECK(stride >= 1);
  std::uint32_t hint = 0;
  const tissue::Displacement moving = tissue::without_presses(displacement);
  const bool moves = tissue::count_sources(moving) > 0;
  const auto depth_of = [&](int element) {
    const double beam = probe.elements > 1 ? element * (view.beams - 1.0) / (probe.elements - 1.0) : 0.0;
    const glm::dvec3 at = imaging::point_of(view, beam, 0.0);
    const cases::Closest near = skin.closest(moves ? tissue::rest_of(moving, at) : at, hint);
    hint = near.triangle;
    return static_cast<float>(-near.distance_mm);
  };
  const int last = probe.elements - 1;
  float before = depth_of(0);
  depths[0] = before;
  for (int from = 0; from < last; from += stride) {
    const int to = std::min(last, from + stride);
    const float next = depth_of(to);
    for (int element = from + 1; element <= to; ++element)
      depths[static_cast<std::size_t>(element)] =
          before + (next - before) * static_cast<float>(element - from) / static_cast<float>(to - from);
    before = next;
  }
  return depths;
}

namespace {

cases::Picture picture_by(const imaging::Probe& probe, double target_below_skin_mm) {
  cases::Picture picture;
  picture.modality = cases::Modality::ultrasound;
  picture.probe = std::string(probe.name);
  const double deep_mm = (target_below_skin_mm - press_mm(probe)) / kTargetShare;
  picture.depth_mm = std::max(kLeastDepthMm, kDepthStepMm * std::round(deep_mm / kDepthStepMm));
  picture.width_mm = 0.0;
  picture.rate_hz = sound_rate_hz(picture.depth_mm);
  return picture;
}

// Where a tip is asked for, from the target at that depth to the skin.
std::vector<double> way_back_mm(double depth_mm) {
  std::vector<double> way_mm{depth_mm};
  while (way_mm.back() > 0.0) {
    const double at_mm = way_mm.back();
    way_mm.push_back(std::max(0.0, at_mm - (at_mm > kNearSkinMm ? kWayStepMm : kNearSkinStepMm)));
  }
  return way_mm;
}

}  // namespace

cases::Picture ultrasound_picture(double target_below_skin_mm) {
  return picture_by(target_below_skin_mm <= kLinearToMm ? imaging::kL115v : imaging::kC52v, target_below_skin_mm);
}

std::array<const imaging::Probe*, 2> offered_probes() noexcept {
  return {&imaging::kC52v, &imaging::kL115v};
}

cases::Picture by_probe(const cases::Picture& picture, const imaging::Probe& probe) {
  const imaging::Probe& now = probe_of(picture);
  if (&now == &probe) return picture;
  cases::Picture other = picture_by(probe, kTargetShare * picture.depth_mm + press_mm(now));
  other.depth_mm = std::clamp(other.depth_mm, probe.least_depth_mm, probe.most_depth_mm);
  other.rate_hz = sound_rate_hz(other.depth_mm);
  return other;
}

imaging::UltrasoundView console_view(const cases::Picture& picture, const cases::ConsoleSetting& console) {
  imaging::UltrasoundView view;
  view.probe = probe_of(picture);
  view.depth_mm = picture.depth_mm;
  imaging::set_view(console, view);
  return view;
}

double picture_rate_hz(const cases::Picture& picture, const cases::ConsoleSetting& console) noexcept {
  if (!(console.depth_mm > 0.0)) return picture.rate_hz;
  return sound_rate_hz(console_view(picture, console).depth_mm);
}

UltrasoundSight::UltrasoundSight(const cases::Case& scene)
    : scene_(scene), tissue_{&scene.volume, scene.classes, scene.echogenicity}, flow_(scene.structures) {
  CHECK(scene.classes.size() == scene.volume.hu.size());
}

imaging::UltrasoundView UltrasoundSight::view_of(const cases::Picture& picture,
                                                 const cases::ConsoleSetting& console) const {
  imaging::UltrasoundView view = console_view(picture, console);
  view.sight_law = scene_.sight_law;
  return view;
}

imaging::UltrasoundVisible UltrasoundSight::see(const imaging::UltrasoundView& view,
                                                const imaging::Inserted& inserted,
                                                const tissue::Displacement& displacement) const {
  return imaging::ultrasound_visible(
      tissue_, view, inserted, element_depths(scene_.skin_index, view, kContactStride, displacement), displacement);
}

imaging::UltrasoundVisible UltrasoundSight::see(const cases::ToolPose& probe, const cases::ConsoleSetting& console,
                                                const imaging::NeedlePose& needle,
                                                const tissue::Displacement& displacement) const {
  return see(held(view_of(scene_.picture, console), probe), {needle, scene_.lesions}, displacement);
}

std::optional<assessment::ProbeView> UltrasoundSight::looks_from(const assessment::PuncturePlan& plan,
                                                                 const assessment::WorthTaking& worth,
                                                                 const cases::Lesion& target) const {
  const cases::ToolPose& touching = plan.probe;
  const cases::Picture picture =
      ultrasound_picture(glm::dot(target.center_lps_mm - touching.position_lps_mm, touching.axis));
  const imaging::Probe& probe = probe_of(picture);
  const double beside_mm = std::abs(glm::dot(plan.entry_lps_mm - touching.position_lps_mm, touching.side));
  if (plan.approach == cases::Approach::in_plane && beside_mm < half_face_mm(probe) + kBesideFaceMm)
    return std::nullopt;
  assessment::PuncturePlan pressed = plan;
  const double deep_mm = press_mm(probe) + plan.pressed_mm;
  pressed.probe.position_lps_mm += deep_mm * pressed.probe.axis;
  pressed.probe_first.position_lps_mm += deep_mm * pressed.probe_first.axis;
  const auto needle = [&](double inserted_mm) {
    return imaging::needle_pose(scene_.instrument, plan.entry_lps_mm + inserted_mm * plan.direction,
                                plan.direction);
  };
  const imaging::UltrasoundView unheld = view_of(picture, {}), view = held(unheld, pressed.probe);
  const std::vector<float> depths = element_depths(scene_.skin_index, view, kContactStride);
  const imaging::Visible seen =
      imaging::ultrasound_visible(tissue_, view, {needle(plan.depth_mm), {target}}, depths).visible;
  if (!seen.joint) return std::nullopt;
  if (plan.approach == cases::Approach::in_plane && pressed.probe_first.axis != pressed.probe.axis &&
      !see(held(unheld, pressed.probe_first), {std::nullopt, {target}}, {}).visible.target)
    return std::nullopt;
  assessment::ProbeView seen_from;
  seen_from.probe = pressed.probe;
  seen_from.probe_first = pressed.probe_first;
  seen_from.picture = picture;
  seen_from.needle_mm = seen.needle_length_mm;
  const imaging::TargetLevel level = imaging::target_level(tissue_, view, {std::nullopt, {target}}, depths);
  seen_from.shadow_db = std::max(0.0, -level.transmission_db);

  const auto tip_shows = [&](double inserted_mm) {
    const imaging::UltrasoundView there = held(unheld, assessment::probe_over(pressed, inserted_mm));
    const imaging::Inserted inserted{needle(inserted_mm), {}};
    if (plan.approach == cases::Approach::out_of_plane) return see(there, inserted, {}).visible.needle_tip;
    const bool still =
        there.origin_lps_mm == view.origin_lps_mm && there.axial == view.axial && there.lateral == view.lateral;
    return imaging::needle_level(tissue_, there, inserted,
                                 still ? depths : element_depths(scene_.skin_index, there, kContactStride), 0.0)
        .stands_out();
  };
  // From the target back to the skin; first how far back it has to be seen for the place to be worth taking, where
  // it is likeliest not to be.
  const std::vector<double> way_mm = way_back_mm(plan.depth_mm);
  const auto is_worth = [&](double from_mm) {
    seen_from.tip_shows_from_mm = from_mm;
    return !worth || worth(seen_from);
  };
  const auto needed = std::find_if(way_mm.begin(), way_mm.end(), is_worth);
  if (needed == way_mm.end()) return std::nullopt;
  for (auto at = needed; at != way_mm.begin(); --at)
    if (!tip_shows(*at)) return std::nullopt;
  const auto unseen = std::find_if_not(needed + 1, way_mm.end(), tip_shows);
  seen_from.tip_shows_from_mm = *(unseen - 1);
  return seen_from;
}

void UltrasoundSight::draw_on(gpu::Context& context) {
  const bool moves = scene_.yields || scene_.breathing.has_value() || flow_.pulsates();
  gpu_ = std::make_shared<imaging::UltrasoundGpu>(context, tissue_, imaging::LinesBy::machine,
                                                  moves ? imaging::TissueMoves::yes : imaging::TissueMoves::no);
}

struct UltrasoundSight::Screen {
  explicit Screen(const imaging::UltrasoundView& view) : converter(view, {}), depth_mm(view.depth_mm) {}
  imaging::ScanConverter converter;
  std::optional<imaging::ColourScreen> colour;
  double depth_mm;
  imaging::PolarPicture polar;
};

struct UltrasoundSight::Compounded {
  explicit Compounded(const imaging::UltrasoundView& view) : compounder(view) {}
  imaging::Compounder compounder;
  std::array<imaging::Look, imaging::kLooks> looks;
  double t_s = 0.0;    // of the newest
  bool whole = false;  // there are all of them
};

imaging::UltrasoundView UltrasoundSight::polar(const cases::ToolPose& probe, const cases::ConsoleSetting& console,
                                               const imaging::NeedlePose& needle, std::uint64_t seed,
                                               std::uint64_t frame, imaging::PolarPicture& picture,
                                               const tissue::Displacement& displacement, double t_s,
                                               LooksOf looks) {
  imaging::UltrasoundView view = held(view_of(scene_.picture, console), probe);
  view.method = method_;
  const std::vector<float> depths = element_depths(scene_.skin_index, view, 1, displacement);
  const tissue::Displacement moved = drawn(view, displacement, t_s);
  const auto receive = [&](const imaging::UltrasoundView& look, std::uint64_t number,
                           imaging::PolarPicture& received) {
    if (gpu_)
      gpu_->polar(look, {needle, scene_.lesions}, depths, received, moved);
    else
      imaging::ultrasound_polar(tissue_, look, {needle, scene_.lesions}, depths, received, moved);
    clutter_.add(look, depths, received);
    imaging::add_receiver_noise(seed, number, received);
  };
  if (!(view.compound_deg > 0.0)) {
    compounded_.reset();
    receive(view, frame, picture);
    return view;
  }
  bool all = looks == LooksOf::one_moment;
  if (!compounded_ || !compounded_->compounder.is_of(view)) compounded_ = std::make_shared<Compounded>(view);
  // After a leap, or a picture that could not be made, all are of one moment.
  const double since_s = t_s - compounded_->t_s;
  all = all || !std::exchange(compounded_->whole, false) || !(since_s >= 0.0 && since_s < kStaleLooksS);
  for (std::size_t i = 0; i < compounded_->looks.size(); ++i)
    if (all || frame % imaging::kLooks == i) {
      compounded_->looks[i].depth_below_skin_mm = depths;
      receive(imaging::look_of(view, static_cast<int>(i)), frame * imaging::kLooks + i,
              compounded_->looks[i].picture);
    }
  compounded_->whole = true;
  compounded_->t_s = t_s;
  compounded_->compounder.mean(view, compounded_->looks, picture);
  return view;
}

tissue::Displacement UltrasoundSight::drawn(const imaging::UltrasoundView& view,
                                            const tissue::Displacement& displacement, double t_s) const {
  if (!imaging::shows_artefacts(view)) return displacement;
  return flow_.with_pulse(displacement, view.origin_lps_mm + 0.5 * view.depth_mm * view.axial, t_s);
}

std::optional<imaging::ColourPicture> UltrasoundSight::colour(const cases::ToolPose& probe,
                                                              const cases::ConsoleSetting& console,
                                                              const imaging::NeedlePose& needle, double t_s,
                                                              const tissue::Displacement& displacement) const {
  if (!(console.colour_mm_s > 0.0)) return std::nullopt;
  const imaging::UltrasoundView view = held(view_of(scene_.picture, console), probe);
  imaging::ColourPicture colour;
  imaging::colour_polar(tissue_, view, {needle, scene_.lesions},
                        element_depths(scene_.skin_index, view, 1, displacement), flow_, console, t_s, colour,
                        drawn(view, displacement, t_s));
  return colour;
}

GreyPicture UltrasoundSight::picture(const cases::ToolPose& probe, const cases::ConsoleSetting& console,
                                     const imaging::NeedlePose& needle, std::uint64_t seed, std::uint64_t frame,
                                     const tissue::Displacement& displacement, double t_s) {
  const imaging::UltrasoundView asked = console_view(scene_.picture, console);
  if (!screen_ || screen_->depth_mm != asked.depth_mm) screen_ = std::make_shared<Screen>(asked);
  const imaging::ScanConverter& converter = screen_->converter;
  GreyPicture picture;
  const imaging::UltrasoundView view =
      polar(probe, console, needle, seed, frame, screen_->polar, displacement, t_s);
  converter.grey(view, {}, screen_->polar, picture.grey);
  if (const auto flow = colour(probe, console, needle, t_s, displacement))
    imaging::colour_numbers(screen_->colour, converter, {}, *flow, picture.colour);
  picture.width_px = converter.width_px();
  picture.height_px =
      std::min(converter.height_px(),
               static_cast<int>(std::ceil((view.depth_mm - converter.top_mm()) / converter.pixel_mm())));
  picture.grey.resize(static_cast<std::size_t>(picture.height_px) * static_cast<std::size_t>(picture.width_px));
  if (!picture.colour.empty()) picture.colour.resize(picture.grey.size());
  return picture;
}

}  // namespace seldinger::session
