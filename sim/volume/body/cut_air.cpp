#include "sim/volume/body/cut_air.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <utility>

namespace seldinger::volume {
namespace {

constexpr int kLungAboveHu = -930;         // as decision 0012 tells lung from gas
constexpr double kRimMm = 2.0;             // of a piece, left out when its density is asked
constexpr double kLeastLungMl = 2.0;       // of what is left: less says nothing
constexpr double kRoomTissueShare = 0.35;  // of the line between a run's ends, from which on it is the room's
constexpr double kRoomOuterShare = 0.5;    // of a piece beyond that line: it lies along the body, not in it
constexpr double kClearVote = 3.0;         // against lung
constexpr double kAllDense = 0.9;          // of a sure lung: with some of the room's air it is less, …
constexpr double kLungMeanHu = -900.0;     // … and foam, 0.05 g/cm³ and less, is lighter
constexpr double kSureVote = 20.0;  // against a sure lung: a mattress that lends coarse voxels some of its HU
// Between thighs, or neck and shoulder, air lies in a nook that opens to an end of the CT: its walls are flat or
// bulge into it, so that it is about as large as the triangle that it fills, and it grows all the way to that end.
// What a plane cuts off a round lumen is 1.33 triangles where it is thinnest and π/2 through the middle.
constexpr double kNookTriangles = 1.4, kNookGrows = 1.4, kNookEndPart = 0.9;
// What is smaller than its triangle is no round lumen at all, however it is cut: it may open to both ends, and
// grows from where it is narrowest.
constexpr double kBulgingTriangles = 0.9;
constexpr double kLeastNookMm = 20.0, kLeastNookMl = 5.0;  // less says nothing of a shape
constexpr int kSidesOfTheRoom = 3;  // of the field's box, touched by one run: no lung or bowel is so wide
constexpr double kTogether = 0.3;   // of the smaller of two pieces lies beside the other
constexpr double kBesideBodyShare =
    0.5;  // of a piece's border with tissue: else it lies between a couch and the edge

constexpr std::int32_t kTissue = -1, kPadding = -2, kUnseen = 0;

// Air of one slice that is joined and reaches the edge.
struct EdgePiece {
  std::uint32_t parent = 0;                                         // of those that vote together
  double voxels = 0.0, inner = 0.0, dense = 0.0, sum_hu = 0.0;      // dense, sum_hu: of inner ones
  double room_votes = 0.0, corner_votes = 0.0, inside_votes = 0.0;  // edge voxels
  double by_tissue = 0.0, by_body = 0.0;                            // voxel faces
  double beyond = 0.0, triangles = 0.0;  // voxels: behind the lines between runs' ends, of the triangles there
  int slice = 0;
  void add(const EdgePiece& other) {
    voxels += other.voxels, inner += other.inner, dense += other.dense, sum_hu += other.sum_hu;
    room_votes += other.room_votes, inside_votes += other.inside_votes, corner_votes += other.corner_votes;
    by_tissue += other.by_tissue, by_body += other.by_body;
    beyond += other.beyond, triangles += other.triangles;
  }
};

class EdgeAir {
 public:
  EdgeAir(const Volume& volume, const AxialSlices& slices, const std::vector<std::uint8_t>& tissue,
          const std::vector<std::uint8_t>& body, const std::vector<std::uint8_t>& padding)
      : volume_(volume), slices_(slices), tissue_(tissue), body_(body), padding_(padding) {}

  std::vector<std::uint8_t> find() {
    pieces_.resize(1);  // 0 is kUnseen
    std::vector<std::int32_t> below, all(volume_.hu.size(), kUnseen);
    for (int slice = 0; slice < slices_.count(); ++slice) {
      label(slice);
      vote();
      if (slice > 0) join(below);
      for (int y = 0; y < height(); ++y)
        for (int x = 0; x < width(); ++x) all[slices_.voxel(slice, x, y)] = std::max(map_[at(x, y)], kUnseen);
      below = map_;
    }
    const std::vector<std::uint8_t> inside = judged();
    std::vector<std::uint8_t> air(volume_.hu.size(), 0);
    for (std::size_t voxel = 0; voxel < air.size(); ++voxel)
      air[voxel] = inside[static_cast<std::size_t>(all[voxel])];
    return air;
  }

 private:
  int width() const { return slices_.width(); }
  int height() const { return slices_.height(); }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
  }
  bool in_field(int x, int y) const {
    return x >= 0 && y >= 0 && x < width() && y < height() && map_[at(x, y)] != kPadding;
  }
  bool on_edge(int x, int y) const {
    return in_field(x, y) &&
           !(in_field(x - 1, y) && in_field(x + 1, y) && in_field(x, y - 1) && in_field(x, y + 1));
  }

  void label(int slice) {
    slice_ = slice;
    map_.resize(static_cast<std::size_t>(width()) * static_cast<std::size_t>(height()));
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) {
        const std::size_t voxel = slices_.voxel(slice, x, y);
        map_[at(x, y)] = !padding_.empty() && padding_[voxel] != 0 ? kPadding
                         : tissue_[voxel] != 0                     ? kTissue
                                                                   : kUnseen;
      }
    edge_.clear();
    double mean_x = 0.0, mean_y = 0.0, field = 0.0;
    for (int y = 0; y < height(); ++y)
      for (int x = 0; x < width(); ++x) {
        if (!in_field(x, y)) continue;
        mean_x += x, mean_y += y, field += 1.0;
        if (on_edge(x, y)) edge_.emplace_back(x, y);
      }
    first_ = pieces_.size();
    places_.clear();
    for (const glm::ivec2& p : edge_)
      if (map_[at(p.x, p.y)] == kUnseen) grow(p);
    low_ = high_ = edge_.empty() ? glm::ivec2(0) : edge_.front();
    for (const glm::ivec2& p : edge_) {
      low_ = glm::min(low_, p);
      high_ = glm::max(high_, p);
    }
    // The field is convex, so that its edge runs round its middle.
    const glm::dvec2 middle(mean_x / field, mean_y / field);
    std::vector<std::pair<double, glm::ivec2>> by_angle;
    by_angle.reserve(edge_.size());
    for (const glm::ivec2& p : edge_) by_angle.emplace_back(std::atan2(p.y - middle.y, p.x - middle.x), p);
    std::stable_sort(by_angle.begin(), by_angle.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < edge_.size(); ++i) edge_[i] = by_angle[i].second;
  }

  void grow(const glm::ivec2& from) {
    const auto id = static_cast<std::int32_t>(pieces_.size());
    EdgePiece& piece = pieces_.emplace_back();
    piece.parent = static_cast<std::uint32_t>(id);
    piece.slice = slice_;
    map_[at(from.x, from.y)] = id;
    begins_.resize(pieces_.size() - first_);
    begins_.back() = places_.size();
    open_.assign(1, from);
    while (!open_.empty()) {
      const glm::ivec2 p = open_.back();
      open_.pop_back();
      places_.push_back(p);
      piece.voxels += 1.0;
      if (far_from_tissue(p)) {
        piece.inner += 1.0;
        const int hu = volume_.hu[slices_.voxel(slice_, p.x, p.y)];
        piece.dense += hu > kLungAboveHu ? 1.0 : 0.0;
        piece.sum_hu += hu;
      }
      for (const glm::ivec2& q : {glm::ivec2(p.x - 1, p.y), {p.x + 1, p.y}, {p.x, p.y - 1}, {p.x, p.y + 1}}) {
        if (!in_field(q.x, q.y)) continue;
        std::int32_t& other = map_[at(q.x, q.y)];
        if (other == kTissue) {
          piece.by_tissue += 1.0;
          piece.by_body += body_[slices_.voxel(slice_, q.x, q.y)] != 0 ? 1.0 : 0.0;
        }
        if (other != kUnseen) continue;
        other = id;
        open_.push_back(q);
      }
    }
  }

  bool far_from_tissue(const glm::ivec2& p) const {
    const int rx = std::max(1, static_cast<int>(std::lround(kRimMm / slices_.spacing_mm().x))),
              ry = std::max(1, static_cast<int>(std::lround(kRimMm / slices_.spacing_mm().y)));
    for (const glm::ivec2& q : {glm::ivec2(p.x - rx, p.y), {p.x + rx, p.y}, {p.x, p.y - ry}, {p.x, p.y + ry}})
      if (in_field(q.x, q.y) && map_[at(q.x, q.y)] == kTissue) return false;
    return true;
  }

  // Each run of air along the edge, between two pieces of tissue, votes with its length.
  void vote() {
    const auto is_tissue = [&](std::size_t i) { return map_[at(edge_[i].x, edge_[i].y)] == kTissue; };
    const std::size_t count = edge_.size();
    std::size_t first = 0;
    while (first < count && !is_tissue(first)) ++first;
    if (first == count) {  // no tissue at the edge: whatever is around is the room's
      for (const glm::ivec2& p : edge_) piece_at(p).room_votes += 1.0;
      return;
    }
    for (std::size_t step = 1; step <= count; ++step) {
      const std::size_t begin = step;
      while (step <= count && !is_tissue((first + step) % count)) ++step;
      if (step == begin) continue;
      const glm::ivec2 a = edge_[(first + begin) % count], b = edge_[(first + step - 1) % count];
      std::array<bool, 4> touched{};
      for (std::size_t i = begin; i < step; ++i) {
        const glm::ivec2 p = edge_[(first + i) % count];
        touched[0] |= p.x == low_.x, touched[1] |= p.x == high_.x;
        touched[2] |= p.y == low_.y, touched[3] |= p.y == high_.y;
      }
      const auto sides = std::count(touched.begin(), touched.end(), true);
      const Shape shape = shape_of(a, b);
      const bool room = sides >= kSidesOfTheRoom || tissue_share(a, b) >= kRoomTissueShare ||
                        shape.outer_share >= kRoomOuterShare;
      if (!room) piece_at(a).beyond += shape.beyond, piece_at(a).triangles += shape.triangle;
      for (std::size_t i = begin; i < step; ++i) {
        EdgePiece& piece = piece_at(edge_[(first + i) % count]);
        (room ? piece.room_votes : sides >= 2 ? piece.corner_votes : piece.inside_votes) += 1.0;
      }
    }
  }

  EdgePiece& piece_at(const glm::ivec2& p) { return pieces_[static_cast<std::size_t>(map_[at(p.x, p.y)])]; }

  // Of the straight line from a to b; air of another piece between them counts as tissue does: the line leaves the
  // air that it began in.
  double tissue_share(const glm::ivec2& a, const glm::ivec2& b) const {
    const int steps = std::max({std::abs(b.x - a.x), std::abs(b.y - a.y), 1});
    const std::int32_t own = map_[at(a.x, a.y)];
    double other = 0.0;
    for (int i = 0; i <= steps; ++i) {
      const double part = static_cast<double>(i) / steps;
      const int x = static_cast<int>(std::lround(a.x + part * (b.x - a.x))),
                y = static_cast<int>(std::lround(a.y + part * (b.y - a.y)));
      other += in_field(x, y) && map_[at(x, y)] != own ? 1.0 : 0.0;
    }
    return other / (steps + 1);
  }

  // Of the piece that a and b are of.
  struct Shape {
    double outer_share = 0.0;             // what lies between the straight line from a to b and the edge
    double beyond = 0.0, triangle = 0.0;  // voxels beyond that line; of the triangle from a and b to the farthest
  };
  Shape shape_of(const glm::ivec2& a, const glm::ivec2& b) const {
    const std::size_t which = static_cast<std::size_t>(map_[at(a.x, a.y)]) - first_, begin = begins_[which],
                      end = which + 1 < begins_.size() ? begins_[which + 1] : places_.size();
    const glm::ivec2 way = b - a;
    double outer = 0.0;
    int farthest = 0;  // from the line, times its length
    for (std::size_t i = begin; i < end; ++i) {
      const glm::ivec2& p = places_[i];
      const int off = way.x * (p.y - a.y) - way.y * (p.x - a.x);
      outer += off < 0 ? 1.0 : 0.0;
      farthest = std::max(farthest, off);
    }
    const auto voxels = static_cast<double>(end - begin);
    const double length = glm::length(glm::dvec2(way));  // both ends are half a voxel farther out
    return {outer / voxels, voxels - outer, 0.5 * (length + 1.0) * (length > 0.0 ? farthest / length + 1.0 : 1.0)};
  }

  void join(const std::vector<std::int32_t>& below) {
    std::vector<std::pair<std::int32_t, std::int32_t>> beside;
    for (std::size_t i = 0; i < map_.size(); ++i)
      if (map_[i] > kUnseen && below[i] > kUnseen) beside.emplace_back(below[i], map_[i]);
    std::sort(beside.begin(), beside.end());
    for (std::size_t i = 0; i < beside.size();) {
      std::size_t end = i;
      while (end < beside.size() && beside[end] == beside[i]) ++end;
      const auto [one, other] = beside[i];
      const double smaller =
          std::min(pieces_[static_cast<std::size_t>(one)].voxels, pieces_[static_cast<std::size_t>(other)].voxels);
      if (static_cast<double>(end - i) >= kTogether * smaller) {
        const std::uint32_t root_one = root(static_cast<std::uint32_t>(one)),
                            root_other = root(static_cast<std::uint32_t>(other));
        pieces_[std::max(root_one, root_other)].parent = std::min(root_one, root_other);
      }
      i = end;
    }
  }

  std::uint32_t root(std::uint32_t piece) {
    while (pieces_[piece].parent != piece) piece = pieces_[piece].parent = pieces_[pieces_[piece].parent].parent;
    return piece;
  }

  // Voxels of what votes together, slice after slice.
  struct Growth {
    int first = 0;
    std::vector<double> voxels;
  };
  std::vector<Growth> growth() {
    std::vector<Growth> made(pieces_.size());
    for (std::uint32_t piece = 1; piece < pieces_.size(); ++piece) {
      Growth& of = made[root(piece)];
      if (of.voxels.empty()) of.first = pieces_[piece].slice;
      of.voxels.resize(static_cast<std::size_t>(pieces_[piece].slice - of.first + 1), 0.0);
      of.voxels.back() += pieces_[piece].voxels;
    }
    return made;
  }

  bool is_nook(const EdgePiece& sum, const Growth& of) const {
    const glm::dvec3 mm = volume_.spacing_mm;
    const double voxel_mm3 = mm.x * mm.y * mm.z,
                 slice_mm = voxel_mm3 / (slices_.spacing_mm().x * slices_.spacing_mm().y);
    if (sum.beyond > kNookTriangles * sum.triangles || sum.voxels * voxel_mm3 < kLeastNookMl * 1000.0 ||
        static_cast<double>(of.voxels.size()) * slice_mm < kLeastNookMm)
      return false;
    const auto [least, largest] = std::minmax_element(of.voxels.begin(), of.voxels.end());
    const bool bulging = sum.beyond <= kBulgingTriangles * sum.triangles;
    const auto opens = [&, least_voxels = *least, most_voxels = *largest](double at_end, double at_other) {
      return at_end >= kNookEndPart * most_voxels && at_end >= kNookGrows * (bulging ? least_voxels : at_other);
    };
    const bool to_first = of.first == 0, to_last = of.first + static_cast<int>(of.voxels.size()) == slices_.count();
    return (to_first && opens(of.voxels.front(), of.voxels.back())) ||
           (to_last && opens(of.voxels.back(), of.voxels.front()));
  }

  // By piece: 1 where it is the body's.
  std::vector<std::uint8_t> judged() {
    std::vector<EdgePiece> sums(pieces_.size());
    for (std::uint32_t piece = 1; piece < pieces_.size(); ++piece) sums[root(piece)].add(pieces_[piece]);
    const std::vector<Growth> grown = growth();
    const glm::dvec3 mm = volume_.spacing_mm;
    const double least_inner = kLeastLungMl * 1000.0 / (mm.x * mm.y * mm.z);
    std::vector<std::uint8_t> inside(pieces_.size(), 0);
    for (std::uint32_t piece = 1; piece < pieces_.size(); ++piece) {
      if (root(piece) != piece) continue;
      const EdgePiece& sum = sums[piece];
      const bool dense = sum.dense * 3.0 > sum.inner * 2.0, lung = dense && sum.inner >= least_inner;
      const bool sure = lung && sum.dense >= kAllDense * sum.inner && sum.sum_hu >= kLungMeanHu * sum.inner;
      // Lung fills corners of a field; what is as thin as gas there is the room's beside a round body.
      const double against = sure ? kSureVote : kClearVote;
      const bool votes = lung ? (sum.inside_votes + sum.corner_votes) * against > sum.room_votes
                              : sum.inside_votes > sum.room_votes + sum.corner_votes;
      inside[piece] =
          votes && sum.by_body >= kBesideBodyShare * sum.by_tissue && (dense || !is_nook(sum, grown[piece]));
    }
    for (std::uint32_t piece = 1; piece < pieces_.size(); ++piece) inside[piece] = inside[root(piece)];
    return inside;
  }

  const Volume& volume_;
  const AxialSlices& slices_;
  const std::vector<std::uint8_t>&tissue_, &body_, &padding_;
  int slice_ = 0;
  std::vector<std::int32_t> map_;  // of the slice: kTissue, kPadding, a piece's number, or kUnseen
  std::vector<glm::ivec2> edge_, open_;
  std::size_t first_ = 0;            // piece of this slice
  std::vector<glm::ivec2> places_;   // of its pieces, one after the other, …
  std::vector<std::size_t> begins_;  // … each from here
  glm::ivec2 low_{0}, high_{0};      // of the edge
  std::vector<EdgePiece> pieces_;
};

}  // namespace

std::vector<std::uint8_t> air_cut_by_edge(const Volume& volume, const AxialSlices& slices,
                                          const std::vector<std::uint8_t>& tissue,
                                          const std::vector<std::uint8_t>& body,
                                          const std::vector<std::uint8_t>& padding) {
  return EdgeAir(volume, slices, tissue, body, padding).find();
}

}  // namespace seldinger::volume
