# In the place of cmake/Dependencies.cmake for a browser: header-only libraries of the distribution, and
# nothing for the libraries whose users are left out.

set(headers ${CMAKE_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${headers}/linux)
# Folders by name: all of /usr/include would bring the headers of this machine's C library.
foreach(folder eigen3/Eigen eigen3/unsupported toml++ nlohmann fmt glm kissfft readerwriterqueue fast_float)
  get_filename_component(name ${folder} NAME)
  file(CREATE_LINK /usr/include/${folder} ${headers}/${name} SYMBOLIC)
endforeach()
file(CREATE_LINK /usr/include/linux/magic.h ${headers}/linux/magic.h SYMBOLIC)

add_library(hapticwall_headers INTERFACE)
target_include_directories(hapticwall_headers SYSTEM INTERFACE ${headers} ${CMAKE_CURRENT_LIST_DIR}/include)
target_compile_definitions(hapticwall_headers INTERFACE FMT_HEADER_ONLY)
add_library(hapticwall_nothing INTERFACE)
foreach(library Eigen3::Eigen tomlplusplus::tomlplusplus nlohmann_json::nlohmann_json fmt::fmt glm::glm)
  add_library(${library} ALIAS hapticwall_headers)
endforeach()
foreach(name hapticwall_kissfft hapticwall_readerwriterqueue fast_float)
  add_library(${name} INTERFACE)
  target_link_libraries(${name} INTERFACE hapticwall_headers)
endforeach()
add_library(hapticwall_device ALIAS hapticwall_nothing)
foreach(library PNG::PNG PkgConfig::MD PkgConfig::SNDFILE PkgConfig::RTAUDIO PkgConfig::CAIRO PkgConfig::EPOXY
                PkgConfig::HIDAPI Threads::Threads)
  add_library(${library} ALIAS hapticwall_nothing)
endforeach()
add_library(glfw ALIAS hapticwall_nothing)
# A size has 32 bits here.
target_compile_options(hapticwall_common_options INTERFACE $<$<COMPILE_LANGUAGE:CXX>:-fwasm-exceptions
                                                           -Wno-shorten-64-to-32>)
target_link_options(hapticwall_common_options INTERFACE -fwasm-exceptions -sSTACK_SIZE=1MB
                                                        -sALLOW_MEMORY_GROWTH=1)

# These sources use a part of the system that a browser lacks. lacking_*.cpp stands for a few of them.
set(HAPTICWALL_LEFT_OUT
    /run/workers.cpp /file/png.cpp /plugin/plugin_library.cpp
    /draw/film/ /figure/page.cpp /figure/page_painter.cpp /figure/figure_file.cpp /figure/shapes.cpp
    /figure/gui_context.cpp /figure/glyphs.cpp
    /signal/wav.cpp /signal/resampler.cpp /live/rt_audio_card.cpp
    /app/session/line_pipe.cpp /loop/crash_stop.cpp /loop/early_exit.cpp /loop/realtime_setup.cpp /loop/loop_thread.cpp
    /ui/computed/background.cpp /ui/window/window.cpp /ui/window/display_end.cpp)

include(Gui)
