# `hapticwall_version.h` (kVersion, kBuild), written at build time and only when it changes: a commit
# needs no new configuration.

set(version_folder ${CMAKE_BINARY_DIR}/generated/version)
find_package(Git QUIET)
add_custom_target(
  hapticwall_write_version
  COMMAND ${CMAKE_COMMAND} -DGIT=${GIT_EXECUTABLE} -DSOURCE=${PROJECT_SOURCE_DIR}
          -DVERSION=${PROJECT_VERSION} -DOUTPUT=${version_folder}/hapticwall_version.h -P
          ${PROJECT_SOURCE_DIR}/cmake/write_version.cmake
  BYPRODUCTS ${version_folder}/hapticwall_version.h
  COMMENT ""
  VERBATIM)
add_library(hapticwall_version INTERFACE)
add_dependencies(hapticwall_version hapticwall_write_version)
target_include_directories(hapticwall_version INTERFACE ${version_folder})
