# Fails when an #include line goes against the arrows of the house:
#   core <- device <- app/runtime <- app/ui, app/command; app/file stands on core alone.
# `core` is pure: the standard library without clocks, files and threads, Eigen, Highway and itself;
# core/batch alone spreads scenes over the cores, with oneTBB.
# Only app/ui knows that there is OpenGL. Usage: cmake -DROOT=FOLDER -P check_layers.cmake
cmake_minimum_required(VERSION 3.25)

set(layers core device app/file app/runtime app/ui app/command app tests)
set(may_include_core core)
set(may_include_device core device)
set(may_include_app/file core app/file)
set(may_include_app/runtime core device app/file app/runtime)
set(may_include_app/ui core device app/file app/runtime app/ui)
set(may_include_app/command core device app/file app/runtime app/ui app/command)
set(may_include_app ${layers})
set(may_include_tests ${layers})

set(graphics "^(imgui|implot|backends/imgui_|GLFW/|epoxy/|GL/|GLES|EGL/|KHR/|glm/)")
set(may_draw app/ui)
set(impure "^(chrono|condition_variable|ctime|filesystem|fstream|future|iostream|mutex|semaphore|shared_mutex|stop_token|syncstream|thread)$")

# The first layer whose folder holds `path`; empty when there is none.
function(layer_of path out)
  foreach(layer ${layers})
    string(FIND "${path}" "${layer}/" position)
    if(position EQUAL 0)
      set(${out} ${layer} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${out} "" PARENT_SCOPE)
endfunction()

# Why `file` of `layer` may not include `header`, or nothing.
function(objection file layer header out)
  set(${out} "" PARENT_SCOPE)
  layer_of("${header}" target)
  if(header MATCHES "^\\.\\.?/")
    set(${out} "is not named from the root of the repository" PARENT_SCOPE)
  elseif(header MATCHES "${graphics}" AND NOT layer IN_LIST may_draw AND NOT file MATCHES "^tests/(ui|window|window_benchmark)/")
    set(${out} "draws, and only app/ui may" PARENT_SCOPE)
  elseif(target AND NOT target IN_LIST may_include_${layer})
    set(${out} "is of ${target}, which ${layer} must not know" PARENT_SCOPE)
  elseif(layer STREQUAL "core" AND NOT target)
    if(header STREQUAL "thread" AND file STREQUAL "core/batch/workers.cpp")
      return()  # what ThreadSanitizer gets instead of oneTBB
    elseif(header MATCHES "${impure}")
      set(${out} "has a clock, files or threads, and core is pure" PARENT_SCOPE)
    elseif(NOT header MATCHES "^((unsupported/)?Eigen/.*|hwy/.*|[a-z_0-9]+)$"
           AND NOT (file MATCHES "^core/batch/" AND header MATCHES "^oneapi/tbb/"))
      set(${out} "is neither the standard library, Eigen, Highway nor core" PARENT_SCOPE)
    endif()
  endif()
endfunction()

set(failures 0)
set(checked 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/core/* ${ROOT}/device/* ${ROOT}/app/* ${ROOT}/tests/*)
list(FILTER files INCLUDE REGEX "\\.(h|cpp)$")
foreach(file ${files})
  layer_of("${file}" layer)
  file(STRINGS ${ROOT}/${file} lines REGEX "^[ \t]*#[ \t]*include[ \t]*[<\"]")
  foreach(line IN LISTS lines)
    string(REGEX REPLACE "^[ \t]*#[ \t]*include[ \t]*[<\"]([^>\"]*)[>\"].*" "\\1" header "${line}")
    objection("${file}" "${layer}" "${header}" why)
    if(why)
      message("${file}: ${header} ${why}")
      math(EXPR failures "${failures} + 1")
    endif()
  endforeach()
  math(EXPR checked "${checked} + 1")
endforeach()

if(checked EQUAL 0)
  message(FATAL_ERROR "no source file below ${ROOT}")
elseif(failures)
  message(FATAL_ERROR "${failures} includes against the arrows")
endif()
message("${checked} files keep to the arrows")
