# What makes a fault in memory an end instead of a way in, for what is shipped: Release, by gcc or clang. tests/repo
# reads it back from the built programs. Sanitizers have checks of their own in the same places.
# OFF only to measure what it costs (tests/bench/hardening.sh).
option(SELDINGER_HARDENED "Compile and link Release as it is shipped" ON)
if(CMAKE_BUILD_TYPE STREQUAL Release AND NOT SELDINGER_SANITIZE AND SELDINGER_HARDENED)
  # FORTIFY 3: lengths of copies and formats, also where the room is known at run time only (gcc 12, glibc 2.35).
  target_compile_options(seldinger_options INTERFACE -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -fstack-protector-strong
                                                    -fstack-clash-protection)
  # Takes effect where start files and every archive are marked too, which Debian 12's are not.
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "^(x86_64|AMD64|i[3-6]86)$")
    target_compile_options(seldinger_options INTERFACE -fcf-protection=full)
  endif()
  # Tables of addresses are written once, before main. --as-needed: a library that nothing calls is not loaded.
  target_link_options(seldinger_options INTERFACE LINKER:-z,relro LINKER:-z,now LINKER:-z,noexecstack LINKER:--as-needed)
endif()
# Position-independent programs, said to the linker too and not left to the compiler's default.
include(CheckPIESupported)
check_pie_supported(LANGUAGES CXX)
