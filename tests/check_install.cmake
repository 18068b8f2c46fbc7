# Installs the build to a folder of its own and fails when a file is missing or wrong.
# Usage: cmake -DBUILD=DIR -DROOT=DIR -DWORK=DIR -DVERSION=X -DCONFIG=NAME -DREADELF=FILE -P check_install.cmake
cmake_minimum_required(VERSION 3.25)

function(run out)
  execute_process(
    COMMAND ${ARGN}
    WORKING_DIRECTORY ${WORK}
    OUTPUT_VARIABLE text
    ERROR_VARIABLE text
    RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${ARGN}: ${status}\n${text}")
  endif()
  set(${out} "${text}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(ignored ${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG} --prefix ${WORK}/root)

# The entry, the icon, the window and the description of the program find each other by one id.
file(STRINGS ${ROOT}/app/ui/window/window.h desktop_id REGEX "kApplicationId = ")
string(REGEX REPLACE ".*\"(.+)\".*" "\\1" desktop_id "${desktop_id}")

file(GLOB_RECURSE found RELATIVE ${WORK}/root ${WORK}/root/*)
list(FILTER found EXCLUDE REGEX "/docs/")
file(GLOB_RECURSE copied RELATIVE ${ROOT} ${ROOT}/assets/devices/* ${ROOT}/assets/examples/* ${ROOT}/assets/hands/*
     ${ROOT}/assets/scenes/* ${ROOT}/assets/schemas/*)
list(TRANSFORM copied PREPEND share/doc/hapticwall/)
set(expected
    ${copied}
    bin/hapticwall
    include/hapticwall/device_plugin.h
    include/hapticwall/environment.h
    include/hapticwall/plugin.h
    lib/udev/rules.d/70-hapticwall.rules
    share/applications/${desktop_id}.desktop
    share/bash-completion/completions/hapticwall
    share/doc/hapticwall/CHANGELOG.md
    share/doc/hapticwall/CITATION.cff
    share/doc/hapticwall/CONTRIBUTING.md
    share/doc/hapticwall/LICENSE
    share/doc/hapticwall/README.md
    share/doc/hapticwall/assets/70-hapticwall.rules
    share/doc/hapticwall/assets/fonts/OFL.txt
    share/doc/hapticwall/copyright
    share/doc/hapticwall/core/algorithm/plugin/include/hapticwall/environment.h
    share/doc/hapticwall/core/algorithm/plugin/include/hapticwall/plugin.h
    share/doc/hapticwall/device/port/include/hapticwall/device_plugin.h
    share/fish/vendor_completions.d/hapticwall.fish
    share/icons/hicolor/scalable/apps/${desktop_id}.svg
    share/man/man1/hapticwall.1
    share/metainfo/${desktop_id}.metainfo.xml
    share/zsh/site-functions/_hapticwall)
list(SORT found)
list(SORT expected)
if(NOT found STREQUAL expected)
  message(SEND_ERROR "installed:\n${found}\nexpected:\n${expected}")
endif()

function(expect file text)
  file(READ ${WORK}/root/${file} content)
  string(FIND "${content}" "${text}" at)
  if(at EQUAL -1)
    message(SEND_ERROR "${file} does not contain '${text}'")
  endif()
endfunction()

# Every part of the program with its licence text.
file(READ ${ROOT}/docs/dependencies.md page)
string(REGEX REPLACE "\n## Building.*" "" page "${page}")
string(REGEX MATCHALL "\n\\| \\[[^]]+\\]" parts "${page}")
list(LENGTH parts count)
if(count LESS 20)
  message(SEND_ERROR "docs/dependencies.md lists only ${count} parts")
endif()
foreach(part IN LISTS parts)
  string(REGEX REPLACE ".*\\[(.+)\\]" "\\1, http" part "${part}")
  expect(share/doc/hapticwall/copyright "\n${part}")
endforeach()
foreach(owner "The Haptic Wall developers" "Omar Cornut" "Evan Pezent")
  expect(share/doc/hapticwall/copyright "${owner}")
endforeach()

expect(share/doc/hapticwall/CITATION.cff "\nversion: ${VERSION}\n")
expect(share/man/man1/hapticwall.1 ".TH HAPTICWALL 1")
expect(share/bash-completion/completions/hapticwall "complete -o default -F _hapticwall hapticwall\n")
expect(share/zsh/site-functions/_hapticwall "#compdef hapticwall\n")
expect(share/fish/vendor_completions.d/hapticwall.fish "\ncomplete -c hapticwall ")

# Every link of a page leads to a file.
set(checked_links 0)
file(GLOB_RECURSE pages ${WORK}/root/share/doc/hapticwall/*.md)
foreach(page IN LISTS pages)
  file(READ ${page} text)
  cmake_path(GET page PARENT_PATH folder)
  # A quoted change of a table is about another page.
  string(REGEX REPLACE "\n[+ ]\\|[^\n]*" "" text "${text}")
  # CMake splits no list inside of square brackets.
  string(REPLACE "](" "<link>" text "${text}")
  string(REGEX MATCHALL "<link>[^)#<[ \n]+" links "${text}")
  list(TRANSFORM links REPLACE "^<link>" "")
  list(FILTER links EXCLUDE REGEX "^([a-z]+:|const$)")  # const: a lambda in a block of C++
  foreach(link IN LISTS links)
    math(EXPR checked_links "${checked_links} + 1")
    if(NOT EXISTS ${folder}/${link})
      message(SEND_ERROR "${page}: there is no ${link}")
    endif()
  endforeach()
endforeach()
if(checked_links LESS 200)
  message(SEND_ERROR "found only ${checked_links} links in the pages")
endif()

# Without the emulator, as after `./dev run`.
file(READ ${BUILD}/cmake_install.cmake script)
string(REPLACE "${BUILD}/hapticwall-emulator" "${WORK}/not-built" script "${script}")
file(WRITE ${WORK}/install.cmake "${script}")
run(ignored ${CMAKE_COMMAND} -DCMAKE_INSTALL_PREFIX=${WORK}/alone -P ${WORK}/install.cmake)
if(NOT EXISTS ${WORK}/alone/bin/hapticwall OR EXISTS ${WORK}/alone/bin/hapticwall-emulator)
  message(SEND_ERROR "without hapticwall-emulator not exactly hapticwall is installed")
endif()

# Debian's zsh reads no site-functions below /usr.
run(ignored ${CMAKE_COMMAND} -E env DESTDIR=${WORK}/staged ${CMAKE_COMMAND} --install ${BUILD} --config ${CONFIG}
    --prefix /usr)
if(NOT EXISTS ${WORK}/staged/usr/share/zsh/vendor-completions/_hapticwall)
  message(SEND_ERROR "below /usr zsh does not find its completion")
endif()

set(installed ${WORK}/root/bin/hapticwall)
run(ignored ${installed} run press --duration 0.1 --csv a.csv)
if(CONFIG STREQUAL "Release" AND READELF)
  run(sections ${READELF} -WS ${installed})
  if(NOT sections MATCHES "\\.dynsym" OR sections MATCHES "\\.symtab")
    message(SEND_ERROR "${installed} is not stripped")
  endif()
endif()

expect(share/applications/${desktop_id}.desktop "\nIcon=${desktop_id}\n")
expect(share/applications/${desktop_id}.desktop "\nStartupWMClass=${desktop_id}\n")
expect(share/metainfo/${desktop_id}.metainfo.xml "<id>${desktop_id}</id>")
expect(share/metainfo/${desktop_id}.metainfo.xml "<launchable type=\"desktop-id\">${desktop_id}.desktop<")

# The judgement of the desktop's own tools.
find_program(DESKTOP_FILE_VALIDATE desktop-file-validate)
if(DESKTOP_FILE_VALIDATE)
  run(ignored ${DESKTOP_FILE_VALIDATE} ${WORK}/root/share/applications/${desktop_id}.desktop)
endif()
find_program(APPSTREAMCLI appstreamcli)
if(APPSTREAMCLI)
  run(ignored ${APPSTREAMCLI} validate --no-net ${WORK}/root/share/metainfo/${desktop_id}.metainfo.xml)
endif()
