# Dear ImGui and ImPlot, which no distribution packages both. Their sources come from the folder where
# `./dev` keeps them, or from HAPTICWALL_GUI_SOURCES.
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
set(gui_files imgui/imgui.h implot/implot.h)
if(HAPTICWALL_TESTS)
  list(APPEND gui_files imgui_test_engine/imgui_te_engine.h)
endif()
foreach(file ${gui_files})
  if(NOT EXISTS ${HAPTICWALL_GUI_SOURCES}/${file})
    message(FATAL_ERROR "${HAPTICWALL_GUI_SOURCES} has no ${file}. `./dev setup` fetches the sources of "
                        "Dear ImGui, ImPlot and the Test Engine; -DHAPTICWALL_GUI_SOURCES=DIR points at "
                        "other copies.")
  endif()
endforeach()

set(imgui ${HAPTICWALL_GUI_SOURCES}/imgui)
set(implot ${HAPTICWALL_GUI_SOURCES}/implot)
# The headers for our code. A program links one of the two libraries below.
add_library(hapticwall_imgui_headers INTERFACE)
target_include_directories(hapticwall_imgui_headers SYSTEM INTERFACE ${imgui} ${imgui}/backends
                                                                     ${implot})
target_link_libraries(hapticwall_imgui_headers INTERFACE glfw)
# Both combine flags of different enumerations, which C++20 deprecates.
target_compile_options(hapticwall_imgui_headers INTERFACE -Wno-deprecated-enum-enum-conversion)

# The files that Dear ImGui Test Engine has no hooks in: compiled once for both libraries below.
add_library(
  hapticwall_imgui_common OBJECT
  ${imgui}/imgui_demo.cpp ${imgui}/imgui_draw.cpp ${imgui}/backends/imgui_impl_glfw.cpp
  ${imgui}/backends/imgui_impl_opengl3.cpp ${implot}/implot.cpp ${implot}/implot_items.cpp)
if(EXISTS ${imgui}/imgui_stacklayout.cpp)  # an addition of the copies that `./dev` fetches
  target_sources(hapticwall_imgui_common PRIVATE ${imgui}/imgui_stacklayout.cpp)
endif()
# Only plots of floats and doubles, which takes a third of the time to compile, and no demo window.
target_compile_definitions(
  hapticwall_imgui_common PRIVATE "IMPLOT_CUSTOM_NUMERIC_TYPES=(float)(double)" IMGUI_DISABLE_DEMO_WINDOWS)
set_target_properties(hapticwall_imgui_common PROPERTIES UNITY_BUILD OFF)  # their names collide
target_link_libraries(hapticwall_imgui_common PRIVATE hapticwall_imgui_headers
                                                      hapticwall_third_party_options)

# hapticwall_gui_library(NAME SOURCES...): Dear ImGui, ImPlot and SOURCES.
function(hapticwall_gui_library name)
  add_library(${name} STATIC ${imgui}/imgui.cpp ${imgui}/imgui_tables.cpp ${imgui}/imgui_widgets.cpp
                             $<TARGET_OBJECTS:hapticwall_imgui_common> ${ARGN})
  set_target_properties(${name} PROPERTIES UNITY_BUILD OFF)
  # The program never starts another program.
  target_compile_definitions(${name} PRIVATE IMGUI_DISABLE_DEFAULT_SHELL_FUNCTIONS)
  target_link_libraries(
    ${name}
    PUBLIC hapticwall_imgui_headers
    PRIVATE hapticwall_third_party_options ${CMAKE_DL_LIBS})
endfunction()

hapticwall_gui_library(hapticwall_imgui)

# The same with hooks for Dear ImGui Test Engine, and the engine: only for the tests of the window. The
# hooks are in functions and change no type, so our code is compiled once.
if(HAPTICWALL_TESTS)
  set(engine ${HAPTICWALL_GUI_SOURCES}/imgui_test_engine)
  file(GLOB engine_sources ${engine}/*.cpp)
  hapticwall_gui_library(hapticwall_imgui_tested ${engine_sources})
  target_include_directories(hapticwall_imgui_tested SYSTEM PUBLIC ${engine})
  target_compile_definitions(
    hapticwall_imgui_tested
    PUBLIC IMGUI_USER_CONFIG="imgui_te_imconfig.h" IMGUI_TEST_ENGINE_ENABLE_COROUTINE_STDTHREAD_IMPL=1
           IMGUI_TEST_ENGINE_ENABLE_STD_FUNCTION=1 IMGUI_TEST_ENGINE_ENABLE_CAPTURE=0)
  target_compile_options(hapticwall_imgui_tested PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
  target_link_libraries(hapticwall_imgui_tested PUBLIC Threads::Threads)
endif()
