# Our targets take every source file of their folder; the next build sees a new file.

# hapticwall_sources(OUT FOLDER...): the .cpp files below the folders of this source folder, less those of
# HAPTICWALL_LEFT_OUT, regular expressions of what a platform lacks.
function(hapticwall_sources out)
  set(patterns)
  foreach(folder ${ARGN})
    list(APPEND patterns ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  endforeach()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${patterns})
  foreach(left_out ${HAPTICWALL_LEFT_OUT})
    list(FILTER sources EXCLUDE REGEX ${left_out})
  endforeach()
  if(NOT sources)
    message(FATAL_ERROR "no source file in ${patterns}")
  endif()
  set(${out} ${sources} PARENT_SCOPE)
endfunction()

# hapticwall_library(NAME FOLDER LIBRARIES...): the static library of one folder.
function(hapticwall_library name folder)
  hapticwall_sources(sources ${folder})
  add_library(${name} STATIC ${sources})
  target_link_libraries(${name} PUBLIC hapticwall_options ${ARGN})
endfunction()
