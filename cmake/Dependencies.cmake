# Everything that is not ours. docs/dependencies.md lists it with versions and licences; `./dev setup`
# installs it.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)  # core: matrix exponential at set-up
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)  # core/batch: lanes, cores
find_package(TBB REQUIRED)
pkg_check_modules(HIDAPI REQUIRED IMPORTED_TARGET hidapi-${HAPTICWALL_HIDAPI})  # device
find_package(tomlplusplus REQUIRED)  # app/file
find_package(nlohmann_json REQUIRED)
find_package(fmt REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
find_package(CLI11 REQUIRED)  # app/command
find_package(glfw3 REQUIRED)  # app/ui
find_package(glm REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)

# Header only and without a file for CMake.
find_path(HAPTICWALL_READERWRITERQUEUE_DIR readerwriterqueue/readerwriterqueue.h REQUIRED)
mark_as_advanced(HAPTICWALL_READERWRITERQUEUE_DIR)
add_library(hapticwall_readerwriterqueue INTERFACE)
target_include_directories(hapticwall_readerwriterqueue SYSTEM
                           INTERFACE ${HAPTICWALL_READERWRITERQUEUE_DIR})

if(HAPTICWALL_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  find_package(benchmark REQUIRED)
endif()

# Dear ImGui and ImPlot: no distribution packages both, so their sources come from the folder where
# `./dev` keeps them, or from wherever a packager says.
file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/gui-sources.txt pin REGEX "^imgui-bundle==")
string(REGEX REPLACE "^imgui-bundle==([0-9.]+).*" "imgui-bundle-\\1" pin "${pin}")
set(cache "$ENV{XDG_CACHE_HOME}")
if(NOT cache)
  set(cache "$ENV{HOME}/.cache")
endif()
set(HAPTICWALL_GUI_SOURCES "${cache}/hapticwall/${pin}"
    CACHE PATH "Folder that holds imgui/ and implot/ (sources)")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
                                       ${PROJECT_SOURCE_DIR}/cmake/gui-sources.txt)
foreach(file imgui/imgui.h implot/implot.h)
  if(NOT EXISTS ${HAPTICWALL_GUI_SOURCES}/${file})
    message(FATAL_ERROR "${HAPTICWALL_GUI_SOURCES} has no ${file}. `./dev setup` fetches the sources of "
                        "Dear ImGui and ImPlot; -DHAPTICWALL_GUI_SOURCES=DIR points at other copies.")
  endif()
endforeach()

set(imgui ${HAPTICWALL_GUI_SOURCES}/imgui)
set(implot ${HAPTICWALL_GUI_SOURCES}/implot)
add_library(
  hapticwall_imgui STATIC
  ${imgui}/imgui.cpp ${imgui}/imgui_demo.cpp ${imgui}/imgui_draw.cpp ${imgui}/imgui_tables.cpp
  ${imgui}/imgui_widgets.cpp ${imgui}/backends/imgui_impl_glfw.cpp
  ${imgui}/backends/imgui_impl_opengl3.cpp ${implot}/implot.cpp ${implot}/implot_items.cpp)
if(EXISTS ${imgui}/imgui_stacklayout.cpp)  # an addition of the copies that `./dev` fetches
  target_sources(hapticwall_imgui PRIVATE ${imgui}/imgui_stacklayout.cpp)
endif()
target_include_directories(hapticwall_imgui SYSTEM PUBLIC ${imgui} ${imgui}/backends ${implot})
# Plots of floats and doubles only: a third of the time to compile.
target_compile_definitions(hapticwall_imgui PRIVATE "IMPLOT_CUSTOM_NUMERIC_TYPES=(float)(double)")
target_link_libraries(
  hapticwall_imgui
  PUBLIC glfw
  PRIVATE hapticwall_third_party_options ${CMAKE_DL_LIBS})
# Both combine flags of different enumerations by design, which C++20 deprecates.
target_compile_options(hapticwall_imgui INTERFACE -Wno-deprecated-enum-enum-conversion)
