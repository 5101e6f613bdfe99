#include "sim/imaging/xray/projection/packet_walk.h"

namespace seldinger::imaging {
namespace {

struct Scalar {
  static constexpr int kLanes = 1;
  using F = float;
  using I = std::int32_t;
  using M = bool;
  static F load(const float* p) { return *p; }
  static I load(const std::int32_t* p) { return *p; }
  static F all(float x) { return x; }
  static I all(std::int32_t x) { return x; }
  static F add(F a, F b) { return a + b; }
  // Integers wrap, as those of vectors do.
  static I add(I a, I b) { return static_cast<I>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b)); }
  static F sub(F a, F b) { return a - b; }
  static F mul(F a, F b) { return a * b; }
  static I mul(I a, I b) { return static_cast<I>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b)); }
  static F min(F a, F b) { return a < b ? a : b; }
  static F max(F a, F b) { return a > b ? a : b; }
  static F positive(F a) { return 0.5F * (a + std::abs(a)); }  // max(a, 0) without a branch; exact here
  static F floor(F a) {
    const auto whole = static_cast<F>(static_cast<I>(a));
    return whole > a ? whole - 1.0F : whole;
  }
  static I to_int(F a) { return static_cast<I>(a); }
  static F to_float(I a) { return static_cast<F>(a); }
  static M less(F a, F b) { return a < b; }
  static M both(M a, M b) { return a && b; }
  static bool any(M a) { return a; }
  static F select(M m, F yes, F no) { return m ? yes : no; }
  static F add_where(M m, F a, F b) { return m ? a + b : a; }
  static I add_where(M m, I a, I b) { return m ? add(a, b) : a; }
  template <bool masked>
  static void gather_pair(const std::uint16_t* p, I at, M m, I shift, I shift_next, F& here, F& next) {
    here = !masked || m ? static_cast<F>(p[at + (shift >> 4)]) : 0.0F;
    next = !masked || m ? static_cast<F>(p[at + (shift_next >> 4)]) : 0.0F;
  }
  static void add_to(double* sum, F a) { *sum += static_cast<double>(a); }
};

}  // namespace

void project_tile_scalar(const PacketJob& job, int column, int row) {
  project_tile<Scalar>(job, column, row);
}

}  // namespace seldinger::imaging
