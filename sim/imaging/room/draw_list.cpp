#include "sim/imaging/room/draw_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/case/c_arm.h"
#include "sim/case/gauge.h"
#include "sim/imaging/room/scan_border.h"

namespace seldinger::imaging {
namespace {

const glm::vec4 kSkin(0.56F, 0.32F, 0.23F, 1.0F), kDrape(0.06F, 0.21F, 0.26F, 1.0F);
const glm::vec4 kWheal(0.64F, 0.42F, 0.33F, 1.0F), kWound(0.24F, 0.02F, 0.02F, 1.0F);
const glm::vec4 kGel(0.62F, 0.47F, 0.22F, 1.0F), kTray(0.50F, 0.52F, 0.54F, 1.0F);
const glm::vec4 kFloor(0.17F, 0.19F, 0.21F, 1.0F), kWalls(0.40F, 0.44F, 0.45F, 1.0F);
const glm::vec4 kInside(0.45F, 0.14F, 0.11F, 1.0F), kBone(0.50F, 0.44F, 0.32F, 1.0F);
const glm::vec4 kIntroducerHub(0.75F, 0.55F, 0.10F, 1.0F);
const glm::vec4 kTarget(0.10F, 0.65F, 0.18F, 1.0F);
const glm::vec4 kPlaneLine(0.10F, 0.55F, 0.75F, 0.55F), kNeedleLine(0.85F, 0.70F, 0.10F, 0.55F);
const glm::vec4 kPlanLine(0.10F, 0.65F, 0.18F, 0.55F);
constexpr float kGlass = 0.3F;
constexpr double kGuideMm = 150.0, kLineRadiusMm = 0.6, kEntryRadiusMm = 3.0;
constexpr double kWhealRadiusMm = 5.0, kWhealHeightMm = 1.5;  // a bleb in the skin (design)
// A stab with a pointed blade, 3 to 5 mm long and gaping a little; nobody says which way it is: across the body, as
// skin's lines run on a trunk (design).
constexpr double kNickHalfLengthMm = 2.0, kNickHalfWidthMm = 0.5, kNickHeightMm = 0.3;
constexpr double kBeyondIntroducerMm = 30.0;  // a coaxial set's needle goes some 30 mm beyond its tube (design)
constexpr double kIntroducerHubMm = 10.0, kIntroducerHubRadiusMm = 4.0;
constexpr int kTurnedPieces = 12;  // of an arc whose console was turned

glm::dmat4 pose(const glm::dvec3& x, const glm::dvec3& y, const glm::dvec3& z, const glm::dvec3& origin) {
  return glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(y, 0.0), glm::dvec4(z, 0.0), glm::dvec4(origin, 1.0));
}

glm::dmat4 ball_pose(const glm::dvec3& center, double radius_mm) {
  return pose({radius_mm, 0.0, 0.0}, {0.0, radius_mm, 0.0}, {0.0, 0.0, radius_mm}, center);
}

// Any frame about an axis.
struct Axes {
  glm::dvec3 x, y;
};
Axes across(const glm::dvec3& z, const RoomFrame& frame) {
  const glm::dvec3 aside = std::abs(glm::dot(z, frame.up)) < 0.99 ? frame.up : frame.head;
  const glm::dvec3 x = glm::normalize(glm::cross(z, aside));
  return {x, glm::cross(z, x)};
}

glm::vec4 colour_of(cases::StructureRule rule) {
  switch (rule) {
    case cases::StructureRule::critical:
      return {0.70F, 0.05F, 0.04F, 1.0F};
    case cases::StructureRule::major:
      return {0.75F, 0.30F, 0.05F, 1.0F};
    case cases::StructureRule::organ:
      return {0.42F, 0.16F, 0.12F, 0.5F};
    case cases::StructureRule::must_cross:
      return {0.70F, 0.60F, 0.12F, 0.5F};
    case cases::StructureRule::target:
      return {0.10F, 0.65F, 0.18F, 0.5F};
    case cases::StructureRule::advisory:
      break;
  }
  return {0.40F, 0.42F, 0.45F, 0.5F};
}

class Maker {
 public:
  Maker(const RoomModel& room, const cases::Case& scene, const cases::State& state, const RoomOptions& options,
        DrawList& list)
      : room_(room), scene_(scene), state_(state), options_(options), list_(list) {}

  void patient() {
    RoomItem skin;
    skin.part = RoomPart::skin;
    skin.mesh = room_.skin;
    const bool phantom = scene_.subject == cases::Subject::phantom;  // its walls are a tray's
    skin.colour = phantom ? kGel : kSkin;
    skin.roughness = phantom ? 0.35F : 0.52F;
    skin.light_under_skin = {0.16F, 0.08F, 0.05F};
    skin.casts = Casts::still;
    skin.displaced = scene_.yields || scene_.breathing.has_value();
    skin.cut = skin.both_sides = options_.mentor && !options_.glass;
    if (glass()) skin.colour.a = kGlass;
    if (!glass()) add(skin);  // else over what it shows
    RoomItem ends = skin;
    ends.part = RoomPart::cut_end;
    ends.mesh = room_.cut_ends;
    ends.colour = phantom ? kTray : options_.mentor ? kInside : kDrape;
    ends.roughness = phantom ? 0.5F : 0.9F;
    ends.light_under_skin = glm::vec3(0.0F);
    if (glass()) {
      glass_ = {skin, ends};
      return;
    }
    add(ends);
    if (options_.mentor) return;  // he looks at the body
    RoomItem drape = ends;
    drape.part = RoomPart::drape;
    drape.mesh = room_.drapes;
    drape.both_sides = true;
    add(drape);
  }

  // What an anaesthetic raises: a flat, pale dome on the skin, which goes with it.
  void wheals() {
    for (const glm::dvec3& place : options_.numb_lps_mm) {
      const glm::dvec3 z = scene_.skin_index.normal(scene_.skin_index.closest_skin(place).triangle);
      const Axes axes = across(z, room_.frame);
      RoomItem wheal;
      wheal.part = RoomPart::wheal;
      wheal.mesh = room_.ball;
      wheal.lps_from_mesh = pose(kWhealRadiusMm * axes.x, kWhealRadiusMm * axes.y, kWhealHeightMm * z, place);
      wheal.colour = kWheal;
      wheal.displaced = scene_.yields || scene_.breathing.has_value();
      add(wheal);
    }
  }

  // A dark slit that rises no higher than it has to, to be seen on a skin of triangles.
  void nicks() {
    for (const glm::dvec3& place : options_.nicks_lps_mm) {
      const auto skin = scene_.skin_index.closest_skin(place);
      const glm::dvec3 z = scene_.skin_index.normal(skin.triangle);
      const Axes axes = across(z, room_.frame);
      const glm::dvec3 along_skin = room_.frame.across - glm::dot(room_.frame.across, z) * z;
      const double length = glm::length(along_skin);
      const glm::dvec3 x = length > 0.1 ? along_skin / length : axes.x;
      RoomItem nick;
      nick.part = RoomPart::nick;
      nick.mesh = room_.ball;
      nick.lps_from_mesh =
          pose(kNickHalfLengthMm * x, kNickHalfWidthMm * glm::cross(z, x), kNickHeightMm * z, skin.point_lps_mm);
      nick.colour = kWound;
      nick.roughness = 0.25F;  // wet
      nick.displaced = scene_.yields || scene_.breathing.has_value();
      nick.least_half_px = 0.75;
      add(nick);
    }
  }

  // A thrown core needle has gone on, its handle has not.
  void needle() {
    const glm::dvec3 z = state_.needle.direction, tip = state_.needle.tip_lps_mm;
    const Axes axes = across(z, room_.frame);
    RoomItem shaft;
    shaft.part = RoomPart::needle_shaft;
    shaft.mesh = room_.shaft;
    shaft.lps_from_mesh = pose(room_.shaft_radius_mm * axes.x, room_.shaft_radius_mm * axes.y, z, tip);
    shaft.roughness = 0.28F;
    shaft.metal = 0.9F;
    shaft.casts = Casts::tools;
    shaft.least_half_px = 0.75;
    add(shaft);
    RoomItem hub;
    hub.part = RoomPart::needle_hub;
    hub.mesh = room_.hub;
    hub.lps_from_mesh = pose(axes.x, axes.y, z, tip - z * (state_.fire.fired ? room_.throw_mm : 0.0));
    hub.roughness = 0.4F;
    hub.casts = Casts::tools;
    add(hub);
  }

  // As much shorter than its needle as that goes beyond it.
  void introducer(const RoomIntroducer& its) {
    const Axes axes = across(its.axis, room_.frame);
    const double length_mm = std::max(kIntroducerHubMm, scene_.instrument.length_mm - kBeyondIntroducerMm);
    const auto turned = [&](double radius_mm, double from_mm, double to_mm) {
      RoomItem item;
      item.part = RoomPart::introducer;
      item.mesh = room_.rod;
      item.lps_from_mesh = pose(radius_mm * axes.x, radius_mm * axes.y, (to_mm - from_mm) * its.axis,
                                its.end_lps_mm + from_mm * its.axis);
      item.casts = Casts::tools;
      item.least_half_px = 0.75;
      return item;
    };
    RoomItem tube = turned(room_.shaft_radius_mm + cases::kIntroducerWallMm, -length_mm, 0.0);
    tube.roughness = 0.28F;
    tube.metal = 0.9F;
    add(tube);
    RoomItem hub = turned(kIntroducerHubRadiusMm, -length_mm, kIntroducerHubMm - length_mm);
    hub.colour = kIntroducerHub;
    hub.roughness = 0.4F;
    add(hub);
  }

  void probe() {
    RoomItem probe;
    probe.part = RoomPart::probe;
    probe.mesh = room_.probe;
    probe.lps_from_mesh = probe_pose();
    probe.roughness = 0.45F;
    probe.casts = Casts::tools;
    add(probe);
  }

  void c_arm() {
    if (room_.c_arm_tube == kNoMesh) return;
    // Before the first tick the machine stands as the case says.
    const cases::CArm& arm = state_.fluoroscopy.in_use ? state_.fluoroscopy.arm : scene_.fluoroscope.start;
    const cases::BeamFrame beam = cases::beam_frame(scene_.fluoroscope, arm, scene_.position);
    RoomItem tube;
    tube.part = RoomPart::tube;
    tube.mesh = room_.c_arm_tube;
    tube.lps_from_mesh = pose(beam.u, -beam.v, beam.direction, arm.isocentre_lps_mm);
    tube.roughness = 0.5F;
    tube.casts = Casts::still;
    add(tube);
    RoomItem detector = tube;
    detector.part = RoomPart::detector;
    detector.mesh = room_.c_arm_detector;
    detector.lps_from_mesh = pose(beam.u, -beam.v, beam.direction, beam.detector_center_lps_mm);
    add(detector);
  }

  void surroundings() {
    RoomItem table;
    table.part = RoomPart::table;
    table.mesh = room_.table;
    table.roughness = 0.7F;
    table.casts = Casts::still;
    add(table);
    RoomItem floor;
    floor.part = RoomPart::floor;
    floor.mesh = room_.floor;
    floor.colour = kFloor;
    floor.shadowed = false;
    add(floor);
    RoomItem walls = floor;
    walls.part = RoomPart::walls;
    walls.mesh = room_.walls;
    walls.colour = kWalls;
    add(walls);
  }

  void inside() {
    const glm::dvec3 through =
        scene_.lesions.empty() ? room_.frame.middle_lps_mm() : scene_.lesions[0].center_lps_mm;
    // The half on the operator's side is gone.
    const glm::dvec3 normal = room_.frame.across * operator_side(room_.frame, scene_);
    if (!glass()) list_.cut = CutPlane{normal, glm::dot(normal, through)};
    RoomItem bone;
    bone.part = RoomPart::bone;
    bone.mesh = room_.bone;
    bone.colour = kBone;
    bone.roughness = 0.7F;
    add(bone);
    if (!scene_.lesions.empty()) {
      RoomItem target;
      target.part = RoomPart::target;
      target.mesh = room_.ball;
      target.lps_from_mesh = ball_pose(scene_.lesions[0].center_lps_mm, scene_.lesions[0].radius_mm);
      target.colour = kTarget;
      add(target);
    }
    for (std::size_t i = 0; i < room_.structures.size() && i < scene_.structures.size(); ++i) {
      RoomItem structure;
      structure.part = RoomPart::structure;
      structure.mesh = room_.structures[i];
      structure.colour = colour_of(scene_.structures[i].rule);
      structure.roughness = 0.5F;
      add(structure);
    }
    for (RoomItem& item : list_.items)
      if (glass() &&
          (item.part == RoomPart::bone || item.part == RoomPart::target || item.part == RoomPart::structure))
        item.shadowed = false;  // light comes through
    for (const RoomItem& item : glass_) add(item);
  }

  void help() {
    if (options_.help >= 1 && options_.probe) scan_plane();
    if (options_.help >= 2) {
      if (scene_.planned_entry_lps_mm)
        overlay(RoomPart::planned_entry, room_.ball, ball_pose(*scene_.planned_entry_lps_mm, kEntryRadiusMm),
                kPlanLine);
      if (options_.needle)
        line(RoomPart::guide_line, state_.needle.tip_lps_mm,
             state_.needle.tip_lps_mm + state_.needle.direction * kGuideMm, kNeedleLine);
    }
    if (options_.help >= 3 && !scene_.lesions.empty()) {
      const cases::Lesion& target = scene_.lesions[0];
      if (!options_.mentor)
        overlay(RoomPart::target, room_.ball, ball_pose(target.center_lps_mm, target.radius_mm), kPlanLine);
      if (scene_.planned_entry_lps_mm)
        line(RoomPart::planned_path, *scene_.planned_entry_lps_mm, target.center_lps_mm, kPlanLine);
    }
  }

 private:
  bool glass() const { return options_.mentor && options_.glass; }
  void add(const RoomItem& item) {
    if (item.mesh == kNoMesh) return;
    list_.items.push_back(item);
    list_.needs_displacement = list_.needs_displacement || item.displaced;
  }
  void overlay(RoomPart part, MeshHandle mesh, const glm::dmat4& lps_from_mesh, const glm::vec4& colour) {
    RoomItem item;
    item.part = part;
    item.mesh = mesh;
    item.lps_from_mesh = lps_from_mesh;
    item.colour = colour;
    item.shadowed = false;
    item.over_all = true;
    add(item);
  }
  void scan_plane() {
    const cases::ConsoleSetting& console = state_.probe.console;
    if (room_.scan_plane == kNoMesh || console == cases::ConsoleSetting{})
      return overlay(RoomPart::scan_plane, room_.scan_plane, probe_pose(), kPlaneLine);
    const std::vector<glm::dvec3> border = scan_border(scene_.picture, console, kTurnedPieces);
    const auto place = [pose = probe_pose()](const glm::dvec3& p) { return glm::dvec3(pose * glm::dvec4(p, 1.0)); };
    for (std::size_t i = 0; i + 1 < border.size(); ++i)
      line(RoomPart::scan_plane, place(border[i]), place(border[i + 1]), kPlaneLine);
  }
  void line(RoomPart part, const glm::dvec3& from, const glm::dvec3& to, const glm::vec4& colour) {
    const double length_mm = glm::distance(from, to);
    if (!(length_mm > 1e-6)) return;
    const glm::dvec3 z = (to - from) / length_mm;
    const Axes axes = across(z, room_.frame);
    overlay(part, room_.rod, pose(kLineRadiusMm * axes.x, kLineRadiusMm * axes.y, length_mm * z, from), colour);
    if (!list_.items.empty()) list_.items.back().least_half_px = 0.75;
  }
  glm::dmat4 probe_pose() const {
    const cases::ProbeState& probe = state_.probe;
    return pose(probe.lateral, glm::cross(probe.axial, probe.lateral), probe.axial, probe.origin_lps_mm);
  }

  const RoomModel& room_;
  const cases::Case& scene_;
  const cases::State& state_;
  const RoomOptions& options_;
  DrawList& list_;
  std::array<RoomItem, 2> glass_{};  // skin and ends, where they can be looked through
};

}  // namespace

void make_draw_list(const RoomModel& room, const cases::Case& scene, const cases::State& state,
                    const RoomOptions& options, DrawList& list) {
  list.items.clear();
  list.cut.reset();
  list.needs_displacement = false;
  Maker make(room, scene, state, options, list);
  make.patient();
  make.wheals();
  make.nicks();
  if (options.needle) make.needle();
  if (options.introducer) make.introducer(*options.introducer);
  if (options.probe) make.probe();
  make.c_arm();
  make.surroundings();
  if (options.mentor) make.inside();
  make.help();
}

}  // namespace seldinger::imaging
