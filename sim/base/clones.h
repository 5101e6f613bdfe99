// What is compiled twice, once for processors with AVX2; the loader chooses. Not under ThreadSanitizer, which is
// not there yet when the choice is made.
#pragma once

#ifdef __SANITIZE_THREAD__
#define SELDINGER_FOR_AVX2_TOO
#else
#define SELDINGER_FOR_AVX2_TOO [[gnu::target_clones("avx2", "default")]]
#endif
