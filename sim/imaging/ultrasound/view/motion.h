// What an ultrasound picture needs of tissue that moves: where the tissue along its beams was at rest, and where
// the scatterers about its plane, which are told at rest, are now. Made for each picture of one displacement; a
// still patient has none of it (docs/decisions/0025).
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/tissue/moved_slab.h"

namespace seldinger::imaging {

struct SideBySide;

// A beam's way through tissue at rest. Without nodes tissue lies still, and it is straight.
class BeamPath {
 public:
  BeamPath(const glm::dvec3& start_lps_mm, const glm::dvec3& direction)
      : start_lps_mm_(start_lps_mm), direction_(direction) {}
  // How X goes on, a mm, across the beam and out of the plane: what tells which way an interface faces.
  struct Aside {
    glm::dvec3 across{0.0}, out{0.0};
  };
  // At nodes evenly down the beam, `per_mm` of them. `aside` may be empty where no interface is asked for.
  BeamPath(const glm::dvec3& start_lps_mm, const glm::dvec3& direction, std::vector<glm::dvec3> back_mm,
           std::vector<Aside> aside, double per_mm)
      : start_lps_mm_(start_lps_mm),
        direction_(direction),
        back_mm_(std::move(back_mm)),
        aside_(std::move(aside)),
        per_mm_(per_mm) {}

  // Cosine of the angle between the beam and an interface's normal, which is told at rest.
  double facing(double depth_mm, const glm::dvec3& normal) const noexcept;

  // X of the tissue at a depth.
  glm::dvec3 at(double depth_mm) const noexcept {
    const glm::dvec3 p = start_lps_mm_ + depth_mm * direction_;
    if (back_mm_.empty()) return p;
    const double nodes = depth_mm * per_mm_;
    const std::size_t node = node_at(nodes);
    return p + back_mm_[node] + (nodes - static_cast<double>(node)) * (back_mm_[node + 1] - back_mm_[node]);
  }
  void at(SideBySide& depths) const noexcept;  // of many depths (tissue_along.h)
  // How X goes on with depth, mm a mm.
  glm::dvec3 along(double depth_mm) const noexcept {
    if (back_mm_.empty()) return direction_;
    const std::size_t node = node_at(depth_mm * per_mm_);
    return direction_ + per_mm_ * (back_mm_[node + 1] - back_mm_[node]);
  }

 private:
  std::size_t node_at(double nodes) const noexcept {
    return nodes > 0.0 ? std::min(static_cast<std::size_t>(nodes), back_mm_.size() - 2) : 0;
  }
  glm::dvec3 start_lps_mm_, direction_;
  std::vector<glm::dvec3> back_mm_;  // X − x
  std::vector<Aside> aside_;
  double per_mm_ = 0.0;  // nodes
};

// The way back for all of a picture: X − x at nodes of beams and depths, between them straight in either.
class RestFan {
 public:
  // rest_of(x, guess) → X. `beside`: beams beyond the first and the last that are asked for, too.
  using RestOf = std::function<glm::dvec3(const glm::dvec3& at_lps_mm, const glm::dvec3& guess_lps_mm)>;
  RestFan(const UltrasoundView& view, double spacing_mm, double beside, const RestOf& rest_of);
  // For a few beams of it: nodes are found when they are first asked for, those of one question together. One
  // thread's; without back_mm().
  using RestOfMany = std::function<void(std::span<const glm::dvec3> at_lps_mm, std::span<glm::dvec3> rest_lps_mm)>;
  static RestFan when_asked(const UltrasoundView& view, double spacing_mm, double beside, RestOfMany rest_of);
  // Asks at once for all that rest_of() will be asked for between these beams and depths, and path_down_to() where
  // they begin at the face.
  struct Box {
    double first_beam, last_beam, first_mm, last_mm;
  };
  void ask(std::span<const Box> boxes) const;

  glm::dvec3 rest_of(double beam, double depth_mm) const { return rest_of(fan_.way(beam), beam, depth_mm); }
  glm::dvec3 rest_of(const Fan::Way& way, double beam, double depth_mm) const;      // that beam's
  BeamPath path(double beam) const { return path(fan_.way(beam), beam, depths_); }  // without Asides
  BeamPath path_down_to(const Fan::Way& way, double beam, double depth_mm) const;   // not to be asked below that
  std::vector<glm::dvec3> back_of(double beam) const { return back_of(beam, depths_); }
  glm::dvec3 start_lps_mm(double beam) const noexcept { return fan_.start_lps_mm(beam); }
  glm::dvec3 direction(double beam) const noexcept { return fan_.direction(beam); }

  // Node d of row r is at beam beam_of(r), d / depths_per_mm() deep: back_mm()[r · depths() + d].
  int rows() const noexcept { return rows_; }
  int depths() const noexcept { return depths_; }
  double beam_of(int row) const noexcept { return first_beam_ + row / rows_per_beam_; }
  double depths_per_mm() const noexcept { return depths_per_mm_; }
  std::span<const glm::dvec3> back_mm() const noexcept { return back_mm_; }

  // The rows beside a beam: this one and the next, `part` of the way between them.
  struct Between {
    int row;
    double part;
  };
  Between between(double beam) const noexcept;

 private:
  RestFan(const UltrasoundView& view, double spacing_mm, double beside);
  struct Nodes {
    int first_row, end_row, first_depth, end_depth;
  };
  void note_missing(const Nodes& nodes) const;
  void find_missing() const;
  void find(const Nodes& nodes) const;
  const glm::dvec3& node(int row, int depth) const noexcept { return back_mm_[index(row, depth)]; }
  std::size_t index(int row, int depth) const noexcept {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(depths_) + static_cast<std::size_t>(depth);
  }
  int depth_above(double depth_mm) const noexcept {
    const double at = depth_mm * depths_per_mm_;
    return at > 0.0 ? static_cast<int>(std::min(at, depths_ - 2.0)) : 0;
  }
  BeamPath path(const Fan::Way& way, double beam, int depths) const;
  std::vector<glm::dvec3> back_of(double beam, int depths) const;

  Fan fan_;
  int rows_, depths_;  // nodes
  double first_beam_, rows_per_beam_, depths_per_mm_;
  std::vector<Fan::Way> ways_;               // of the rows
  RestOfMany when_asked_;                    // none: all nodes are there
  mutable std::vector<glm::dvec3> back_mm_;  // NaN: not asked for yet
  mutable std::vector<std::size_t> missing_;
  mutable std::vector<glm::dvec3> at_mm_, rest_mm_;  // of the missing
};

class PictureMotion {
 public:
  enum class Asides { found, left_out };  // whoever asks for no interface need not wait for it
  PictureMotion(const UltrasoundView& view, const tissue::Displacement& displacement,
                Asides asides = Asides::found);

  const tissue::MovedSlab& slab() const noexcept { return slab_; }
  BeamPath path(double beam) const;

  // For a shader that does the same: for each beam its nodes, X − x, then across and out of the plane (Aside).
  int path_nodes() const noexcept { return fan_.depths(); }
  double nodes_per_mm() const noexcept { return fan_.depths_per_mm(); }
  void append_path(double beam, std::vector<glm::vec4>& list) const;

 private:
  void find_aside(const UltrasoundView& view);
  std::vector<BeamPath::Aside> aside_of(double beam) const;

  tissue::MovedSlab slab_;
  RestFan fan_;
  std::vector<BeamPath::Aside> aside_;  // at the fan's nodes, or none
};

// Nothing where nothing moves.
std::optional<PictureMotion> motion_of(const UltrasoundView& view, const tissue::Displacement& displacement,
                                       PictureMotion::Asides asides = PictureMotion::Asides::found);

inline BeamPath path_of(const Fan& fan, const PictureMotion* motion, double beam) {
  return motion == nullptr ? BeamPath(fan.start_lps_mm(beam), fan.direction(beam)) : motion->path(beam);
}

}  // namespace seldinger::imaging
