# The files that the binary carries, so that it runs from any folder.

if(EMSCRIPTEN)
  set(embedded_section ".section .rodata.embedded,\"\",@")
  set(embedded_end "")
else()
  set(embedded_section ".section .rodata")
  set(embedded_end ".section .note.GNU-stack,\"\",@progbits")
endif()
set(embedded_folder ${CMAKE_BINARY_DIR}/generated/embedded)
file(CONFIGURE OUTPUT ${embedded_folder}/embedded_file.h @ONLY
     CONTENT [[// Generated: a file that the binary carries.
#pragma once

#include <string_view>

namespace hapticwall {

struct EmbeddedFile {
  std::string_view name;   // without folder
  std::string_view bytes;  // followed by a zero byte
};

}  // namespace hapticwall
]])

# hapticwall_embed(TARGET GROUP FILES...): gives TARGET the files and the header "embedded_GROUP.h" with
#   std::span<const EmbeddedFile> hapticwall::embedded_GROUP();
# in the order of FILES, each under its name without folder. The assembler includes the bytes (.incbin),
# which takes no time; the next build sees a changed file.
function(hapticwall_embed target group)
  set(folder ${embedded_folder}/${group})
  set(assembly "")
  set(declarations "")
  set(entries "")
  set(index 0)
  foreach(file ${ARGN})
    get_filename_component(name ${file} NAME)
    set(symbol hapticwall_embedded_${group}_${index})
    # WebAssembly wants type and size of each symbol.
    string(APPEND assembly ".global ${symbol}\n.global ${symbol}_end\n"
                           ".type ${symbol},@object\n.type ${symbol}_end,@object\n${symbol}:\n"
                           ".incbin \"${file}\"\n.size ${symbol}, .-${symbol}\n"
                           "${symbol}_end:\n.byte 0\n.size ${symbol}_end, 1\n")
    string(APPEND declarations "extern const char ${symbol}[];\nextern const char ${symbol}_end[];\n")
    string(APPEND entries "      {\"${name}\", {${symbol}, ${symbol}_end}},\n")
    math(EXPR index "${index} + 1")
  endforeach()

  file(CONFIGURE OUTPUT ${folder}/embedded_${group}.S @ONLY
       CONTENT "@embedded_section@\n@assembly@@embedded_end@\n")
  file(CONFIGURE OUTPUT ${folder}/embedded_${group}.h @ONLY
       CONTENT [[// Generated: the files of the group "@group@", for the life of the program.
#pragma once

#include <span>

#include "embedded_file.h"

namespace hapticwall {

std::span<const EmbeddedFile> embedded_@group@();

}  // namespace hapticwall
]])
  file(CONFIGURE OUTPUT ${folder}/embedded_${group}.cpp @ONLY
       CONTENT [[#include "embedded_@group@.h"

#include <array>

extern "C" {
@declarations@}

namespace hapticwall {

std::span<const EmbeddedFile> embedded_@group@() {
  static const std::array<EmbeddedFile, @index@> kFiles{{
@entries@  }};
  return kFiles;
}

}  // namespace hapticwall
]])
  set_source_files_properties(${folder}/embedded_${group}.S PROPERTIES OBJECT_DEPENDS "${ARGN}")
  target_sources(${target} PRIVATE ${folder}/embedded_${group}.S ${folder}/embedded_${group}.cpp)
  target_include_directories(${target} PUBLIC ${embedded_folder} ${folder})
endfunction()
