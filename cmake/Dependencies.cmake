# Everything that is not ours. docs/dependencies.md lists it with versions and licences; `./dev setup`
# installs it.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)  # core: matrix exponential at set-up
find_package(tomlplusplus REQUIRED)  # app/file
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(PNG REQUIRED)
pkg_check_modules(MD REQUIRED IMPORTED_TARGET libmd)  # app/file: SHA-256
if(NOT HAPTICWALL_PROGRAM)
  return()
endif()

pkg_check_modules(CAIRO REQUIRED IMPORTED_TARGET cairo-ft cairo-svg cairo-pdf freetype2)  # app/draw
pkg_check_modules(HIDAPI REQUIRED IMPORTED_TARGET hidapi-${HAPTICWALL_HIDAPI})  # device
pkg_check_modules(SNDFILE REQUIRED IMPORTED_TARGET sndfile)  # app/sound
pkg_check_modules(RTAUDIO REQUIRED IMPORTED_TARGET rtaudio)
find_package(CLI11 REQUIRED)  # app/command
find_package(glfw3 REQUIRED)  # app/ui
find_package(glm REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)

# Header-only, without a CMake file.
find_path(HAPTICWALL_READERWRITERQUEUE_DIR readerwriterqueue/readerwriterqueue.h REQUIRED)
mark_as_advanced(HAPTICWALL_READERWRITERQUEUE_DIR)
add_library(hapticwall_readerwriterqueue INTERFACE)
target_include_directories(hapticwall_readerwriterqueue SYSTEM
                           INTERFACE ${HAPTICWALL_READERWRITERQUEUE_DIR})
find_path(HAPTICWALL_KISSFFT_DIR kissfft/kissfft.hh REQUIRED)  # app/draw
mark_as_advanced(HAPTICWALL_KISSFFT_DIR)
add_library(hapticwall_kissfft INTERFACE)
target_include_directories(hapticwall_kissfft SYSTEM INTERFACE ${HAPTICWALL_KISSFFT_DIR})

if(HAPTICWALL_TESTS)
  find_package(OpenGL REQUIRED COMPONENTS EGL)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  find_package(benchmark REQUIRED)
endif()

include(Gui)
