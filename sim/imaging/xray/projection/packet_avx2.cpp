// Everything that is not ours is included before the instruction set is raised: no inline function of a library may
// come out of this file in instructions that another processor lacks.
#if defined(__x86_64__)

#include <immintrin.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "sim/imaging/xray/projection/packet.h"

#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#include "sim/imaging/xray/projection/packet_walk.h"

namespace seldinger::imaging {
namespace {

struct Avx2 {
  static constexpr int kLanes = 8;
  using F = __m256;
  using I = __m256i;
  using M = __m256;  // all bits of a lane
  static F load(const float* p) { return _mm256_load_ps(p); }
  static I load(const std::int32_t* p) { return _mm256_load_si256(reinterpret_cast<const __m256i*>(p)); }
  static F all(float x) { return _mm256_set1_ps(x); }
  static I all(std::int32_t x) { return _mm256_set1_epi32(x); }
  static F add(F a, F b) { return _mm256_add_ps(a, b); }
  static I add(I a, I b) { return _mm256_add_epi32(a, b); }
  static F sub(F a, F b) { return _mm256_sub_ps(a, b); }
  static F mul(F a, F b) { return _mm256_mul_ps(a, b); }
  static I mul(I a, I b) { return _mm256_mullo_epi32(a, b); }
  static F min(F a, F b) { return _mm256_min_ps(a, b); }
  static F max(F a, F b) { return _mm256_max_ps(a, b); }
  static F positive(F a) { return _mm256_max_ps(a, _mm256_setzero_ps()); }
  static F floor(F a) { return _mm256_floor_ps(a); }
  static I to_int(F a) { return _mm256_cvttps_epi32(a); }
  static F to_float(I a) { return _mm256_cvtepi32_ps(a); }
  static M less(F a, F b) { return _mm256_cmp_ps(a, b, _CMP_LT_OQ); }
  static M both(M a, M b) { return _mm256_and_ps(a, b); }
  static bool any(M a) { return _mm256_movemask_ps(a) != 0; }
  static F select(M m, F yes, F no) { return _mm256_blendv_ps(no, yes, m); }
  static F add_where(M m, F a, F b) { return _mm256_add_ps(a, _mm256_and_ps(m, b)); }
  static I add_where(M m, I a, I b) { return _mm256_add_epi32(a, _mm256_and_si256(_mm256_castps_si256(m), b)); }
  // Two neighbours in 32 bits from an even address.
  template <bool masked>
  static void gather_pair(const std::uint16_t* p, I at, M m, I shift, I shift_next, F& here, F& next) {
    const int* from = reinterpret_cast<const int*>(p);
    const I both = masked ? _mm256_mask_i32gather_epi32(_mm256_setzero_si256(), from, at, _mm256_castps_si256(m), 2)
                          : _mm256_i32gather_epi32(from, at, 2);
    const I low = _mm256_set1_epi32(0xffff);
    here = _mm256_cvtepi32_ps(_mm256_and_si256(_mm256_srlv_epi32(both, shift), low));
    next = _mm256_cvtepi32_ps(_mm256_and_si256(_mm256_srlv_epi32(both, shift_next), low));
  }
  static void add_to(double* sum, F a) {
    _mm256_store_pd(sum, _mm256_add_pd(_mm256_load_pd(sum), _mm256_cvtps_pd(_mm256_castps256_ps128(a))));
    _mm256_store_pd(sum + 4, _mm256_add_pd(_mm256_load_pd(sum + 4), _mm256_cvtps_pd(_mm256_extractf128_ps(a, 1))));
  }
};

}  // namespace

void project_tile_avx2(const PacketJob& job, int column, int row) {
  project_tile<Avx2>(job, column, row);
}

}  // namespace seldinger::imaging
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
