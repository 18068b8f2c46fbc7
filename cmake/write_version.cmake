# Run at build time by cmake/Version.cmake: VERSION, SOURCE and GIT in, the header OUTPUT out.
cmake_minimum_required(VERSION 3.25)

set(build unknown)
if(GIT)
  execute_process(
    COMMAND ${GIT} -C ${SOURCE} describe --always --dirty --abbrev=10 --exclude=*
    OUTPUT_VARIABLE described
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
    RESULT_VARIABLE status)
  if(status EQUAL 0 AND described)
    set(build ${described})
  endif()
endif()

file(
  CONFIGURE
  OUTPUT ${OUTPUT}
  CONTENT
    [[// Generated: the version of the program and the commit that it was built from.
#pragma once

#include <string_view>

namespace hapticwall {

inline constexpr std::string_view kVersion = "@VERSION@";
inline constexpr std::string_view kBuild = "@build@";

}  // namespace hapticwall
]]
  @ONLY)
