// The template of packet.h. Included by packet_*.cpp only, each of which names its vector V: lanes of float F, of
// 32-bit integers I and masks M.
#pragma once

#include <algorithm>
#include <cmath>

#include "sim/imaging/xray/projection/packet.h"

namespace seldinger::imaging {
namespace {

constexpr int kBlock = 32;           // slabs from one start found in double to the next
constexpr double kNever = 1e30;      // the next crossing of a ray parallel to the planes
constexpr double kNowhere = 1e9;     // where an idle lane's segment lies
constexpr float kWaterValue = 1000;  // a voxel's value at 0 HU

// The loops over lanes below are plain, so that the compiler turns each into a few vector instructions: one kind of
// number each, and choices by value.

// floor for |x| < 2^51.
inline double floor_of(double x) {
  constexpr double kWhole = 6755399441055744.0;  // 1.5 · 2^52: adding it rounds to whole numbers
  const double near = (x + kWhole) - kWhole;
  return near > x ? near - 1.0 : near;
}

// One minor axis of all lanes, mirrored where the ray runs down.
template <int W>
struct MinorAxis {
  alignas(64) double at_zero[W];  // coordinate where the main coordinate is 0
  alignas(64) double slope[W];    // per slab, ≥ 0
  alignas(64) double inverse[W];
  alignas(64) std::int32_t stride[W];  // of the mirrored index
  double size = 0.0;                   // of the kept box
  alignas(64) double mirrored[W];      // 1 or 0
  // At the start of the block:
  alignas(64) double whole[W];
  alignas(64) std::int32_t index[W];
  alignas(64) float crossing[W];  // in slabs
  alignas(64) float inverse_f[W], slope_f[W], part[W];
};

template <class V>
struct Packet {
  static constexpr int W = V::kLanes;
  MinorAxis<W> minor[2];
  int first_live = W, last_live = -1;
  alignas(64) double enter[W], leave[W];  // main coordinate
  alignas(64) double mm_per_slab[W];
  alignas(64) double total[W], mineral[W];
  // Where a lane's voxel and its neighbour along the first minor axis are read together: the lower of the two, and
  // by how many bits to shift for the one and the other.
  alignas(64) std::int32_t base[W], offset[W], shift[W], shift_next[W];
  alignas(64) float enter_f[W], leave_f[W];
};

// A block's slabs by exact pieces. With `clipped` some lane begins or ends inside the block.
template <class V, bool mineral, bool clipped>
__attribute__((noinline)) void walk_exact(const std::uint16_t* values, Packet<V>& packet, int main_stride,
                                          int slabs) {
  using F = typename V::F;
  using I = typename V::I;
  constexpr int W = V::kLanes;
  const MinorAxis<W>&y = packet.minor[0], &z = packet.minor[1];
  const F y0 = V::load(y.crossing), z0 = V::load(z.crossing);
  const F y_inverse = V::load(y.inverse_f), z_inverse = V::load(z.inverse_f);
  const I y_stride = V::load(y.stride), z_stride = V::load(z.stride);
  const I shift = V::load(packet.shift), shift_next = V::load(packet.shift_next);
  const F one = V::all(1.0F), zero = V::all(0.0F), water = V::all(kWaterValue);
  const F enter = V::load(packet.enter_f), leave = V::load(packet.leave_f);
  const I step = V::all(main_stride);
  I offset = V::load(packet.offset);
  F ny = zero, nz = zero, ty = y0, tz = z0, sum = zero, sum_mineral = zero, begin = zero;
  for (int k = 0; k < slabs; ++k) {
    const F end = V::add(begin, one);
    const F low = clipped ? V::max(begin, enter) : begin;
    const F high = clipped ? V::max(V::min(end, leave), low) : end;
    const auto in_y = V::less(ty, end), in_z = V::less(tz, end);
    const auto live = V::less(low, high);
    if (!clipped || V::any(live)) {
      const auto add = [&](const F& value, const F& from, const F& to) {
        const F length = V::sub(to, from);
        sum = V::add(sum, V::mul(value, length));
        if constexpr (mineral) sum_mineral = V::add(sum_mineral, V::mul(V::positive(V::sub(value, water)), length));
      };
      const F first = V::min(V::max(V::min(ty, tz), low), high);
      F here, next;
      V::template gather_pair<clipped>(values, offset, live, shift, shift_next, here, next);
      add(here, low, first);
      if (!V::any(in_z)) {
        add(next, first, high);
      } else {
        const F second = V::min(V::max(V::max(ty, tz), low), high);
        F here_above, next_above;
        V::template gather_pair<true>(values, V::add(offset, z_stride), V::both(in_z, live), shift, shift_next,
                                      here_above, next_above);
        add(V::select(V::less(tz, ty), here_above, next), first, second);
        add(next_above, second, high);
      }
    }
    offset = V::add(offset, step);
    offset = V::add_where(in_y, offset, y_stride);
    offset = V::add_where(in_z, offset, z_stride);
    ny = V::add_where(in_y, ny, one);
    nz = V::add_where(in_z, nz, one);
    ty = V::add(y0, V::mul(ny, y_inverse));
    tz = V::add(z0, V::mul(nz, z_inverse));
    begin = end;
  }
  V::add_to(packet.total, sum);
  if constexpr (mineral) V::add_to(packet.mineral, sum_mineral);
}

// A block's slabs by one bilinear sample each, in the middle of the ray's piece.
template <class V, bool mineral>
__attribute__((noinline)) void walk_slabs(const std::uint16_t* values, Packet<V>& packet, int main_stride,
                                          const int (&size)[2], int slabs) {
  using F = typename V::F;
  using I = typename V::I;
  constexpr int W = V::kLanes;
  const F zero = V::all(0.0F), one = V::all(1.0F), half = V::all(0.5F), water = V::all(kWaterValue);
  const F enter = V::load(packet.enter_f), leave = V::load(packet.leave_f);
  F part[2], slope[2], lowest[2], highest[2], last[2];
  I stride[2];
  for (int i = 0; i < 2; ++i) {
    const MinorAxis<W>& axis = packet.minor[i];
    part[i] = V::sub(V::load(axis.part), half);
    slope[i] = V::load(axis.slope_f);
    const F index = V::to_float(V::load(axis.index));
    lowest[i] = V::sub(zero, index);
    highest[i] = V::sub(V::all(static_cast<float>(size[i] - 1)), index);
    last[i] = V::sub(V::all(static_cast<float>(std::max(size[i] - 2, 0))), index);
    stride[i] = V::load(axis.stride);
  }
  const I next = size[1] > 1 ? stride[1] : V::all(0);
  const I shift = V::load(packet.shift), shift_next = V::load(packet.shift_next);
  I offset = V::load(packet.offset);
  const I step = V::all(main_stride);
  F sum = zero, sum_mineral = zero, begin = zero;
  for (int k = 0; k < slabs; ++k) {
    const F end = V::add(begin, one);
    const F low = V::max(begin, enter), high = V::max(V::min(end, leave), low);
    const auto live = V::less(low, high);
    if (V::any(live)) {
      const F middle = V::mul(V::add(low, high), half), length = V::sub(high, low);
      I at = offset;
      F weight[2];
      for (int i = 0; i < 2; ++i) {
        const F place = V::min(V::max(V::add(part[i], V::mul(slope[i], middle)), lowest[i]), highest[i]);
        const F whole = V::min(V::floor(place), last[i]);
        weight[i] = V::sub(place, whole);
        at = V::add(at, V::mul(V::to_int(whole), stride[i]));
      }
      const auto lerp = [&](const F& a, const F& b, const F& t) { return V::add(a, V::mul(V::sub(b, a), t)); };
      F v00, v10, v01, v11;
      V::template gather_pair<true>(values, at, live, shift, shift_next, v00, v10);
      V::template gather_pair<true>(values, V::add(at, next), live, shift, shift_next, v01, v11);
      sum = V::add(sum, V::mul(lerp(lerp(v00, v10, weight[0]), lerp(v01, v11, weight[0]), weight[1]), length));
      if constexpr (mineral) {
        const auto above = [&](const F& v) { return V::positive(V::sub(v, water)); };
        sum_mineral = V::add(sum_mineral, V::mul(lerp(lerp(above(v00), above(v10), weight[0]),
                                                      lerp(above(v01), above(v11), weight[0]), weight[1]),
                                                 length));
      }
    }
    offset = V::add(offset, step);
    begin = end;
  }
  V::add_to(packet.total, sum);
  if constexpr (mineral) V::add_to(packet.mineral, sum_mineral);
}

// Where lanes stand at the start of a block, from double.
template <class V>
void start_block(Packet<V>& packet, int block, int main_stride) {
  constexpr int W = V::kLanes;
  const auto start = static_cast<double>(block);
  for (int l = 0; l < W; ++l) packet.enter_f[l] = static_cast<float>(packet.enter[l] - start);
  for (int l = 0; l < W; ++l) packet.leave_f[l] = static_cast<float>(packet.leave[l] - start);
  // Offsets of lanes that have not entered yet may wrap; nothing is read there.
  const auto wrapped = [](std::int32_t a, std::int32_t b, std::int32_t stride) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) +
                                     static_cast<std::uint32_t>(b) * static_cast<std::uint32_t>(stride));
  };
  for (int l = 0; l < W; ++l) packet.offset[l] = wrapped(packet.base[l], block, main_stride);
  for (MinorAxis<W>& axis : packet.minor) {
    for (int l = 0; l < W; ++l) {
      const double at = axis.at_zero[l] + start * axis.slope[l];
      const double whole = floor_of(at);
      const double part = at - whole;
      axis.whole[l] = whole;
      axis.part[l] = static_cast<float>(part);
      axis.crossing[l] = static_cast<float>((1.0 - part) * axis.inverse[l]);
    }
    for (int l = 0; l < W; ++l) axis.index[l] = static_cast<std::int32_t>(axis.whole[l]);
    for (int l = 0; l < W; ++l) packet.offset[l] = wrapped(packet.offset[l], axis.index[l], axis.stride[l]);
  }
}

// The voxels of a minor axis that live lanes may meet in a block, a voxel more on each side for rounding and
// interpolation. Rays of a row that run the same way along the main axis are a fan: where they meet a plane moves
// one way from lane to lane, so the outermost live ones bound the others.
template <int W>
void reach(const MinorAxis<W>& axis, int first_live, int last_live, int block, int& low, int& high) {
  double least = kNowhere, most = -kNowhere;
  for (const int lane : {first_live, last_live})
    for (const int end : {block, block + kBlock}) {
      const double at = axis.at_zero[lane] + end * axis.slope[lane];
      const double place = axis.mirrored[lane] > 0.0 ? axis.size - at : at;
      least = std::min(least, place);
      most = std::max(most, place);
    }
  low = static_cast<int>(floor_of(least)) - 1;
  high = static_cast<int>(floor_of(most)) + 1;
}

template <class V>
void walk(const PacketJob& job, Packet<V>& packet, int main) {
  constexpr int W = V::kLanes;
  const PacketVolume& volume = *job.volume;
  const int axes[2] = {main == 0 ? 1 : 0, main == 2 ? 1 : 2};
  const int size[2] = {volume.size[axes[0]], volume.size[axes[1]]};
  const PacketVolume::Order& order = volume.order_for(main);
  const std::uint16_t* values = volume.first(order);
  const int main_stride = order.stride[main];
  double first = kNowhere, last = -kNowhere;
  for (int l = 0; l < W; ++l) {
    if (packet.enter[l] >= packet.leave[l]) continue;
    first = std::min(first, packet.enter[l]);
    last = std::max(last, packet.leave[l]);
    packet.first_live = std::min(packet.first_live, l);
    packet.last_live = l;
  }
  if (!(first < last)) return;
  // Blocks begin at multiples of kBlock whatever the packet, so that a ray's arithmetic is its own.
  for (int block = static_cast<int>(floor_of(first)) / kBlock * kBlock; block < last; block += kBlock) {
    glm::ivec3 low_voxel, high_voxel;
    low_voxel[main] = block;
    high_voxel[main] = block + kBlock - 1;
    for (int i = 0; i < 2; ++i)
      reach(packet.minor[i], packet.first_live, packet.last_live, block, low_voxel[axes[i]], high_voxel[axes[i]]);
    if (!volume.any_in(low_voxel, high_voxel)) continue;  // adds nothing to any lane
    start_block(packet, block, main_stride);
    bool inside = true;
    for (int l = 0; l < W; ++l)
      inside = inside && packet.enter_f[l] <= 0.0F && packet.leave_f[l] >= static_cast<float>(kBlock);
    const int slabs = std::min(kBlock, static_cast<int>(floor_of(last)) + 1 - block);
    const bool mineral = job.mineral_mm != nullptr;
    if (job.slab)
      mineral ? walk_slabs<V, true>(values, packet, main_stride, size, slabs)
              : walk_slabs<V, false>(values, packet, main_stride, size, slabs);
    else if (inside)
      mineral ? walk_exact<V, true, false>(values, packet, main_stride, slabs)
              : walk_exact<V, false, false>(values, packet, main_stride, slabs);
    else
      mineral ? walk_exact<V, true, true>(values, packet, main_stride, slabs)
              : walk_exact<V, false, true>(values, packet, main_stride, slabs);
  }
}

template <class V>
void project_packet(const PacketJob& job, const double (&column)[V::kLanes], double row,
                    double (&water_mm)[V::kLanes], double (&mineral_mm)[V::kLanes]) {
  constexpr int W = V::kLanes;
  const PacketView& view = *job.view;
  const PacketVolume& volume = *job.volume;
  // Each lane's ray from source to pixel, in voxels, and the share of it that lies in the box, axis by axis.
  alignas(64) double from[3][W], along[3][W], enter[W], leave[W], length_mm[W], per_main[W];
  for (int l = 0; l < W; ++l) {
    enter[l] = 0.0;
    leave[l] = 1.0;
  }
  for (int axis = 0; axis < 3; ++axis) {
    const double from_0 = view.from[axis], from_c = view.from_per_column[axis], from_r = view.from_per_row[axis];
    const double to_0 = view.to[axis], to_c = view.to_per_column[axis], to_r = view.to_per_row[axis];
    const double size = volume.size[axis];
    for (int l = 0; l < W; ++l) {
      const double a = from_0 + column[l] * from_c + row * from_r;
      const double b = to_0 + column[l] * to_c + row * to_r;
      const double d = b - a;
      from[axis][l] = a;
      along[axis][l] = d;
      // A ray parallel to the axis is inside all along or not at all; the lower face belongs to the box, the upper
      // does not.
      const bool parallel = d == 0.0, within = (a >= 0.0) & (a < size);
      const double inverse = 1.0 / (parallel ? 1.0 : d);
      const double one = (0.0 - a) * inverse, other = (size - a) * inverse;
      const double near = one < other ? one : other, far = one < other ? other : one;
      const double t_in = parallel ? (within ? 0.0 : 2.0) : near, t_out = parallel ? 1.0 : far;
      enter[l] = enter[l] < t_in ? t_in : enter[l];
      leave[l] = leave[l] < t_out ? leave[l] : t_out;
    }
  }
  // Nothing to do where no lane meets the box.
  bool any = false;
  for (int l = 0; l < W; ++l) any |= enter[l] < leave[l];
  for (int l = 0; l < W; ++l) water_mm[l] = mineral_mm[l] = 0.0;
  if (!any) return;
  const glm::dmat3& m = view.mm_from_voxel;
  // Each lane's length in millimetres, and its way: its steepest axis and the direction along it, 0–2 upwards, 3–5
  // downwards.
  constexpr int kWays = 6;
  alignas(64) double way[W];
  bool used[kWays] = {};
  for (int l = 0; l < W; ++l) {
    const double x = along[0][l], y = along[1][l], z = along[2][l];
    const double mm_x = m[0][0] * x + m[1][0] * y + m[2][0] * z, mm_y = m[0][1] * x + m[1][1] * y + m[2][1] * z,
                 mm_z = m[0][2] * x + m[1][2] * y + m[2][2] * z;
    length_mm[l] = std::sqrt(mm_x * mm_x + mm_y * mm_y + mm_z * mm_z);
    const double size_x = std::abs(x), size_y = std::abs(y), size_z = std::abs(z);
    const double y_way = y < 0.0 ? 4.0 : 1.0, z_way = z < 0.0 ? 5.0 : 2.0, x_way = x < 0.0 ? 3.0 : 0.0;
    const double rest = size_y >= size_z ? y_way : z_way;
    way[l] = ((size_x >= size_y) & (size_x >= size_z)) ? x_way : rest;
  }
  for (int l = 0; l < W; ++l) used[static_cast<int>(way[l])] |= enter[l] < leave[l];
  // Lanes that run the same way walk together, the others idle.
  for (int one_way = 0; one_way < kWays; ++one_way) {
    if (!used[one_way]) continue;
    const int main = one_way % 3;
    const double way_number = one_way;
    Packet<V> packet;
    // Where each lane enters and leaves along the main axis, and the millimetres of one slab.
    for (int l = 0; l < W; ++l) {
      const double a = from[main][l], d = along[main][l];
      const bool live = (way[l] == way_number) & (enter[l] < leave[l]);
      const double one = a + enter[l] * d, other = a + leave[l] * d;
      packet.enter[l] = live ? (one < other ? one : other) : kNowhere;
      packet.leave[l] = live ? (one < other ? other : one) : -kNowhere;
      per_main[l] = live ? 1.0 / (d == 0.0 ? 1.0 : d) : 0.0;
      packet.mm_per_slab[l] = length_mm[l] * std::abs(per_main[l]);
      packet.total[l] = packet.mineral[l] = 0.0;
    }
    for (int l = 0; l < W; ++l) {
      packet.base[l] = packet.shift[l] = 0;
      packet.shift_next[l] = 16;
    }
    // The two minor axes as lines over the main axis. Exact rays that fall along one are mirrored: all rise.
    for (int i = 0; i < 2; ++i) {
      MinorAxis<W>& axis = packet.minor[i];
      const int which = i == 0 ? (main == 0 ? 1 : 0) : (main == 2 ? 1 : 2);
      const double size = volume.size[which], mirroring = job.slab ? 0.0 : 1.0;
      const int stride = volume.order_for(main).stride[which], last = volume.size[which] - 1;
      axis.size = size;
      for (int l = 0; l < W; ++l) {
        const double slope = along[which][l] * per_main[l];
        // An idle lane may stand anywhere that fits a 32-bit index.
        const double at_zero = per_main[l] != 0.0 ? from[which][l] - from[main][l] * slope : 0.0;
        const double mirrored = slope < 0.0 ? mirroring : 0.0;
        const double steep = mirrored > 0.0 ? -slope : slope;
        const double inverse = 1.0 / (steep > 1.0 / kNever ? steep : 1.0 / kNever);
        axis.mirrored[l] = mirrored;
        axis.at_zero[l] = mirrored > 0.0 ? size - at_zero : at_zero;
        axis.slope[l] = steep;
        axis.inverse[l] = inverse;
        axis.inverse_f[l] = static_cast<float>(inverse);
        axis.slope_f[l] = static_cast<float>(steep);
      }
      // Where a mirrored lane's voxels begin, and in which half of a 32-bit word of two its value lies.
      for (int l = 0; l < W; ++l) {
        const auto mirrored = static_cast<std::int32_t>(axis.mirrored[l]);
        axis.stride[l] = stride - 2 * mirrored * stride;
        packet.base[l] += mirrored * last * stride;
        if (i == 0) {  // neighbours are read in pairs, from the lower one
          packet.base[l] -= mirrored;
          packet.shift[l] = 16 * mirrored;
          packet.shift_next[l] = 16 - 16 * mirrored;
        }
      }
    }
    walk(job, packet, main);
    for (int l = 0; l < W; ++l) {
      const double scale = packet.mm_per_slab[l] / kWaterValue;
      water_mm[l] += (packet.total[l] - packet.mineral[l]) * scale;
      mineral_mm[l] += packet.mineral[l] * scale;
    }
  }
}

// A packet lies along a row: seen from a C-arm its rays then cross slices together.
template <class V>
void project_tile(const PacketJob& job, int first_column, int first_row) {
  constexpr int W = V::kLanes;
  const PacketView& view = *job.view;
  const int end_column = std::min(first_column + kTilePx, view.width_px);
  const int end_row = std::min(first_row + kTilePx, view.height_px);
  for (int r = first_row; r < end_row; ++r)
    for (int c = first_column; c < end_column; c += W) {
      double column[W], water_mm[W], mineral_mm[W];
      for (int l = 0; l < W; ++l) column[l] = c + l;
      project_packet<V>(job, column, r, water_mm, mineral_mm);
      const std::ptrdiff_t pixel = std::ptrdiff_t{r} * view.width_px + c;
      for (int l = 0; l < std::min(W, end_column - c); ++l) {
        job.water_mm[pixel + l] = static_cast<float>(water_mm[l]);
        if (job.mineral_mm != nullptr) job.mineral_mm[pixel + l] = static_cast<float>(mineral_mm[l]);
      }
    }
}

}  // namespace
}  // namespace seldinger::imaging
