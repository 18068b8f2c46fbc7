# How our own code is compiled: the interface library `hapticwall_options`. Third-party code is
# compiled with `hapticwall_third_party_options` instead: no warnings, no debug information.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)

if(NOT EMSCRIPTEN)  # WebAssembly has no addresses of code
  include(CheckPIESupported)
  check_pie_supported()
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()

add_library(hapticwall_common_options INTERFACE)
# Results are the same on every machine: no FMA contraction, no -ffast-math, no -march=native.
target_compile_options(hapticwall_common_options INTERFACE -ffp-contract=off)
if(NOT EMSCRIPTEN)  # WebAssembly keeps its stack and its code apart
  target_compile_options(hapticwall_common_options INTERFACE -fstack-protector-strong
                                                             -fstack-clash-protection)
  include(CheckCXXCompilerFlag)
  check_cxx_compiler_flag(-fcf-protection HAPTICWALL_HAS_CF_PROTECTION)  # x86
  if(HAPTICWALL_HAS_CF_PROTECTION)
    target_compile_options(hapticwall_common_options INTERFACE -fcf-protection)
  endif()
  # Links only libraries that are used; some distributions make that the default.
  target_link_options(hapticwall_common_options INTERFACE -Wl,-z,relro,-z,now -Wl,--as-needed)
endif()
if(HAPTICWALL_SANITIZE)
  # Third-party code is checked for memory and threads, not for arithmetic.
  string(REPLACE "," ";" sanitizers "${HAPTICWALL_SANITIZE}")
  list(FILTER sanitizers EXCLUDE REGEX "undefined|fuzzer")
  list(JOIN sanitizers "," for_all)
  target_compile_options(hapticwall_common_options INTERFACE -fno-omit-frame-pointer)
  if(for_all)
    target_compile_options(hapticwall_common_options INTERFACE -fsanitize=${for_all})
  endif()
  target_link_options(hapticwall_common_options INTERFACE -fsanitize=${HAPTICWALL_SANITIZE})
else()
  target_compile_options(
    hapticwall_common_options
    INTERFACE $<$<CONFIG:Release,RelWithDebInfo,MinSizeRel>:-U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=2
              -D_GLIBCXX_ASSERTIONS>)
endif()

add_library(hapticwall_options INTERFACE)
target_link_libraries(hapticwall_options INTERFACE hapticwall_common_options)
target_include_directories(hapticwall_options INTERFACE ${PROJECT_SOURCE_DIR})
if(HAPTICWALL_SANITIZE)
  target_compile_options(hapticwall_options INTERFACE -fsanitize=${HAPTICWALL_SANITIZE})
  if(HAPTICWALL_SANITIZE MATCHES "undefined")
    target_compile_options(hapticwall_options INTERFACE -fno-sanitize-recover=undefined)
  endif()
endif()
target_compile_options(
  hapticwall_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wshadow -Wconversion>
                               $<$<AND:$<COMPILE_LANGUAGE:CXX>,$<BOOL:${HAPTICWALL_WERROR}>>:-Werror>)

# Warnings of GCC's optimiser depend on what it happens to inline. These are wrong about std::sort,
# std::string (GCC bug 105651) and pointers to members; `./dev test --asan` finds what they are meant for.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(
    hapticwall_options INTERFACE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow
                                 -Wno-error=maybe-uninitialized)
endif()

add_library(hapticwall_third_party_options INTERFACE)
target_link_libraries(hapticwall_third_party_options INTERFACE hapticwall_common_options)
target_compile_options(hapticwall_third_party_options INTERFACE -w -g0)
