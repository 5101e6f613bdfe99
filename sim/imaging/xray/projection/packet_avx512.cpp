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
#pragma clang attribute push(__attribute__((target("avx512f,avx512dq,avx512bw,avx512vl"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx512f,avx512dq,avx512bw,avx512vl")
#endif
#include "sim/imaging/xray/projection/packet_walk.h"

namespace seldinger::imaging {
namespace {

struct Avx512 {
  static constexpr int kLanes = 16;
  using F = __m512;
  using I = __m512i;
  using M = __mmask16;
  static F load(const float* p) { return _mm512_load_ps(p); }
  static I load(const std::int32_t* p) { return _mm512_load_si512(p); }
  static F all(float x) { return _mm512_set1_ps(x); }
  static I all(std::int32_t x) { return _mm512_set1_epi32(x); }
  static F add(F a, F b) { return _mm512_add_ps(a, b); }
  static I add(I a, I b) { return _mm512_add_epi32(a, b); }
  static F sub(F a, F b) { return _mm512_sub_ps(a, b); }
  static F mul(F a, F b) { return _mm512_mul_ps(a, b); }
  static I mul(I a, I b) { return _mm512_mullo_epi32(a, b); }
  static F min(F a, F b) { return _mm512_min_ps(a, b); }
  static F max(F a, F b) { return _mm512_max_ps(a, b); }
  static F positive(F a) { return _mm512_max_ps(a, _mm512_setzero_ps()); }
  static F floor(F a) { return _mm512_roundscale_ps(a, _MM_FROUND_TO_NEG_INF | _MM_FROUND_NO_EXC); }
  static I to_int(F a) { return _mm512_cvttps_epi32(a); }
  static F to_float(I a) { return _mm512_cvtepi32_ps(a); }
  static M less(F a, F b) { return _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ); }
  static M both(M a, M b) { return _kand_mask16(a, b); }
  static bool any(M a) { return a != 0; }
  static F select(M m, F yes, F no) { return _mm512_mask_blend_ps(m, no, yes); }
  static F add_where(M m, F a, F b) { return _mm512_mask_add_ps(a, m, a, b); }
  static I add_where(M m, I a, I b) { return _mm512_mask_add_epi32(a, m, a, b); }
  // Two neighbours in 32 bits from an even address.
  template <bool masked>
  static void gather_pair(const std::uint16_t* p, I at, M m, I shift, I shift_next, F& here, F& next) {
    const I both = masked ? _mm512_mask_i32gather_epi32(_mm512_setzero_si512(), m, at, p, 2)
                          : _mm512_i32gather_epi32(at, p, 2);
    const I low = _mm512_set1_epi32(0xffff);
    here = _mm512_cvtepi32_ps(_mm512_and_si512(_mm512_srlv_epi32(both, shift), low));
    next = _mm512_cvtepi32_ps(_mm512_and_si512(_mm512_srlv_epi32(both, shift_next), low));
  }
  static void add_to(double* sum, F a) {
    _mm512_store_pd(sum, _mm512_add_pd(_mm512_load_pd(sum), _mm512_cvtps_pd(_mm512_castps512_ps256(a))));
    _mm512_store_pd(sum + 8, _mm512_add_pd(_mm512_load_pd(sum + 8), _mm512_cvtps_pd(_mm512_extractf32x8_ps(a, 1))));
  }
};

}  // namespace

void project_tile_avx512(const PacketJob& job, int column, int row) {
  project_tile<Avx512>(job, column, row);
}

}  // namespace seldinger::imaging
#if defined(__clang__)
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

#endif
