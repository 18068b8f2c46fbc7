# The check of the layers must find what it is there for: every line below is wrong in its folder.
# Usage: cmake -DCHECK=check_layers.cmake -DWORK=FOLDER -P check_layers_test.cmake
cmake_minimum_required(VERSION 3.25)

# expect_refused(FILE LINE): a house that holds nothing but this line is refused, with its name.
function(expect_refused file line)
  check("${file}" "${line}" status output)
  if(status EQUAL 0 OR NOT output MATCHES "${file}: ")
    message(SEND_ERROR "not found: ${line} in ${file}")
  endif()
endfunction()

function(expect_fine file line)
  check("${file}" "${line}" status output)
  if(NOT status EQUAL 0)
    message(SEND_ERROR "wrongly refused: ${line} in ${file}\n${output}")
  endif()
endfunction()

function(check file line out_status out_output)
  file(REMOVE_RECURSE ${WORK})
  file(WRITE ${WORK}/${file} "#pragma once\n${line}\n")
  execute_process(
    COMMAND ${CMAKE_COMMAND} -DROOT=${WORK} -P ${CHECK}
    RESULT_VARIABLE status
    OUTPUT_VARIABLE output
    ERROR_VARIABLE output)
  set(${out_status} ${status} PARENT_SCOPE)
  set(${out_output} "${output}" PARENT_SCOPE)
endfunction()

expect_refused(core/a.h "#include <fmt/format.h>")
expect_refused(core/a.h "#include <thread>")
expect_refused(core/batch/a.cpp "#include <thread>")
expect_refused(core/a.h "#include <unistd.h>")
expect_refused(core/plant/a.cpp "#include <oneapi/tbb/parallel_for.h>")
expect_refused(core/batch/a.cpp "#include <mutex>")
expect_refused(core/stabiliser/a.cpp "#include \"device/device.h\"")
expect_refused(core/a.cpp "  #  include \"app/file/scene_file.h\"  // why")
expect_refused(device/a.cpp "#include \"app/runtime/session.h\"")
expect_refused(device/a.cpp "#include \"../app/main.h\"")
expect_refused(app/file/a.cpp "#include \"device/device.h\"")
expect_refused(app/runtime/a.cpp "#include \"app/ui/window.h\"")
expect_refused(app/runtime/a.cpp "#include <imgui.h>")
expect_refused(app/command/a.cpp "#include <GLFW/glfw3.h>")
expect_refused(app/ui/a.cpp "#include \"app/command/run.h\"")
expect_refused(app/main.cpp "#include \"implot.h\"")
expect_refused(tests/app/a.cpp "#include <epoxy/gl.h>")

expect_fine(core/a.h "#include <unsupported/Eigen/MatrixFunctions>")
expect_fine(core/a.h "#include <cmath>")
expect_fine(core/plant/a.cpp "#include \"core/scene.h\"")
expect_fine(core/batch/a.cpp "#include <hwy/highway.h>")
expect_fine(core/batch/a.cpp "#include <oneapi/tbb/parallel_for.h>")
expect_fine(core/batch/workers.cpp "#include <thread>")
expect_fine(device/a.cpp "#include \"core/scene.h\"")
expect_fine(app/file/a.cpp "#include <toml++/toml.h>")
expect_fine(app/ui/a.cpp "#include <glm/glm.hpp>")
expect_fine(app/command/a.cpp "#include \"app/ui/window.h\"")
expect_fine(tests/ui/a.cpp "#include <imgui.h>")
