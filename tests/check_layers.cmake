# Fails when an #include line goes against the arrows of the house:
#   core <- device <- app/session <- app/ui, app/command; app/file stands on core alone;
#   core, app/file <- app/compare, app/draw, app/table; app/compare, app/draw, app/table <- app/ui; app/compare, app/draw <- app/command;
#   app/table, the data of app/draw <- app/study <- app/ui, app/command;
#   core <- app/sound/signal <- app/command; app/sound/signal, app/session, device <- app/sound/live <- app/ui;
#   core, app/file, app/table <- app/command/report <- app/command; core, app/file, app/session, app/table, app/study <- app/python; app/ui and all below it <- app/web, in the place of app/command.
# Within a layer the rooms have arrows, too:
#   device <- device/link <- device/port; app/session: loop <- the files beside it;
#   app/command: the files beside the rooms <- run, study, map, device; run, study <- compare; run <- replay, identify;
#   app/draw: axis <- plot <- figure, wall, verdict <- film; app/ui: wall, computed <- state <- widget <- panel <- page <- first <- window (a widget knows no wall).
# `core` is pure: the standard library without clocks, files and threads, Eigen and itself;
# core/run/workers.cpp alone spreads scenes over the cores.
# Only app/draw, app/ui and app/web know that there is OpenGL. Usage: cmake -DROOT=FOLDER -P check_layers.cmake
cmake_minimum_required(VERSION 3.25)

set(layers core device app/file app/session app/compare app/table app/draw app/study app/sound/signal app/sound/live app/ui app/command/report app/command app/python app/web app
    tests)
set(may_include_core core)
set(may_include_device core device)
set(may_include_app/file core app/file)
set(may_include_app/session core device app/file app/session)
set(may_include_app/compare core app/file app/compare)
set(may_include_app/table core app/file app/table)
set(may_include_app/draw core app/file app/draw)
set(may_include_app/study core app/file app/table app/draw app/study)
set(may_include_app/sound/signal core app/sound/signal)
set(may_include_app/sound/live core device app/session app/sound/signal app/sound/live)
set(may_include_app/ui core device app/file app/session app/compare app/table app/draw app/study app/sound/live app/ui)
set(may_include_app/command/report core app/file app/table app/command/report)
set(may_include_app/command core device app/file app/session app/compare app/table app/draw app/study app/sound/signal app/command/report app/command)
set(may_include_app/python core app/file app/session app/table app/study app/python)
set(may_include_app/web ${layers})
list(REMOVE_ITEM may_include_app/web device app/command/report app/command app/python app tests)
set(may_include_app ${layers})
set(may_include_tests ${layers})

set(rooms app/draw/axis app/draw/plot app/draw/figure app/draw/wall app/draw/verdict app/draw/film app/ui/wall app/ui/computed app/ui/state app/ui/widget app/ui/panel
    app/ui/page app/ui/first app/ui/window)
set(may_include_app/draw/axis app/draw/axis)
set(may_include_app/draw/plot app/draw/axis app/draw/plot)
set(may_include_app/draw/figure app/draw/axis app/draw/plot app/draw/figure)
set(may_include_app/draw/wall app/draw/axis app/draw/plot app/draw/wall)
set(may_include_app/draw/verdict app/draw/plot app/draw/verdict)
set(may_include_app/draw/film app/draw/axis app/draw/plot app/draw/figure app/draw/wall app/draw/verdict app/draw/film)
set(may_include_app/ui/wall app/ui/wall)
set(may_include_app/ui/computed app/ui/computed)
set(may_include_app/ui/state app/ui/wall app/ui/computed app/ui/state)
set(may_include_app/ui/widget app/ui/computed app/ui/state app/ui/widget)
set(may_include_app/ui/panel app/ui/wall app/ui/computed app/ui/state app/ui/widget app/ui/panel)
set(may_include_app/ui/page app/ui/wall app/ui/computed app/ui/state app/ui/widget app/ui/panel app/ui/page)
set(may_include_app/ui/first app/ui/wall app/ui/computed app/ui/state app/ui/widget app/ui/panel app/ui/page app/ui/first)
set(may_include_app/ui/window app/ui/wall app/ui/computed app/ui/state app/ui/widget app/ui/panel app/ui/page app/ui/first app/ui/window)

# A folder after its rooms stands for the files beside them.
list(APPEND rooms device/link device/port device app/session/loop app/session)
set(may_include_device/link device device/link)
set(may_include_device/port device device/link device/port)
set(may_include_app/session/loop app/session/loop)
list(APPEND may_include_app/session app/session/loop)
foreach(room run study compare map replay device identify)
  list(APPEND rooms app/command/${room})
  set(may_include_app/command/${room} app/command app/command/${room})
endforeach()
list(APPEND rooms app/command)
list(APPEND may_include_app/command/compare app/command/run app/command/study)
list(APPEND may_include_app/command/replay app/command/run)
list(APPEND may_include_app/command/identify app/command/run)

set(graphics "^(imgui|implot|backends/imgui_|GLFW/|epoxy/|GL/|GLES|EGL/|KHR/|glm/)")
set(may_draw app/draw app/ui app/web)
set(impure "^(chrono|condition_variable|ctime|filesystem|fstream|future|iostream|mutex|semaphore|shared_mutex|stop_token|syncstream|thread)$")

# The first of these folders that holds `path`; empty when there is none.
function(folder_of path out)
  foreach(folder ${ARGN})
    string(FIND "${path}" "${folder}/" position)
    if(position EQUAL 0)
      set(${out} ${folder} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  set(${out} "" PARENT_SCOPE)
endfunction()

# Why `file` of `layer` may not include `header`, or nothing.
function(objection file layer header out)
  set(${out} "" PARENT_SCOPE)
  folder_of("${header}" target ${layers})
  folder_of("${file}" room ${rooms})
  folder_of("${header}" target_room ${rooms})
  string(FIND "${target_room}/" "${layer}/" same_layer)
  if(header MATCHES "^\\.\\.?/")
    set(${out} "is not named from the root of the repository" PARENT_SCOPE)
  elseif(header MATCHES "${graphics}" AND NOT layer IN_LIST may_draw AND NOT file MATCHES "^tests/(app/draw|app/ui|offscreen|web|window|window_benchmark)/")
    set(${out} "draws, and only app/draw and app/ui may" PARENT_SCOPE)
  elseif(target AND NOT target IN_LIST may_include_${layer})
    set(${out} "is of ${target}, which ${layer} must not know" PARENT_SCOPE)
  elseif(room AND same_layer EQUAL 0 AND NOT target_room IN_LIST may_include_${room})
    set(${out} "is of ${target_room}, which ${room} must not know" PARENT_SCOPE)
  elseif(layer STREQUAL "core" AND NOT target)
    if(header MATCHES "^(thread|sched\\.h)$" AND file STREQUAL "core/run/workers.cpp")
      return()  # it shares scenes out
    elseif(header STREQUAL plugin.h AND file MATCHES "/include/hapticwall/")
      return()  # beside it, where a user has both
    elseif(header MATCHES "${impure}")
      set(${out} "has a clock, files or threads, and core is pure" PARENT_SCOPE)
    elseif(NOT header MATCHES "^((unsupported/)?Eigen/.*|[a-z_0-9]+|stdint\\.h)$")
      set(${out} "is neither the standard library, Eigen nor core" PARENT_SCOPE)
    endif()
  endif()
endfunction()

set(failures 0)
set(checked 0)
file(GLOB_RECURSE files RELATIVE ${ROOT} ${ROOT}/core/* ${ROOT}/device/* ${ROOT}/app/* ${ROOT}/tests/*)
list(FILTER files INCLUDE REGEX "\\.(h|cpp)$")
foreach(file ${files})
  folder_of("${file}" layer ${layers})
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
