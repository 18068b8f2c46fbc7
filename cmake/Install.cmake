# An installed program: `cmake --install build/release --prefix DIR`.

include(GNUInstallDirs)
set(pages ${CMAKE_BINARY_DIR}/generated/pages)
file(MAKE_DIRECTORY ${pages})

install(CODE "set(CMAKE_INSTALL_DO_STRIP TRUE)" CONFIGURATIONS Release)
install(TARGETS hapticwall RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
# The program embeds its files. Only the udev rule must be in a folder that udev reads.
install(FILES assets/70-hapticwall.rules DESTINATION lib/udev/rules.d)

# Pages that the program and the build's libraries give, made when it is installed.
set(generate_pages "")
foreach(page man bash zsh fish)
  string(APPEND generate_pages "execute_process(COMMAND \"$<TARGET_FILE:hapticwall>\" --generate ${page}
    OUTPUT_FILE \"${pages}/${page}\" COMMAND_ERROR_IS_FATAL ANY)\n")
endforeach()
install(
  CODE "${generate_pages}
        execute_process(COMMAND \"${CMAKE_COMMAND}\" -DROOT=${PROJECT_SOURCE_DIR}
                                -DGUI=${HAPTICWALL_GUI_SOURCES} -DOUTPUT=${pages}/copyright
                                -P ${PROJECT_SOURCE_DIR}/cmake/write_copyright.cmake
                        COMMAND_ERROR_IS_FATAL ANY)")
install(FILES ${pages}/man DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 RENAME hapticwall.1)
install(FILES ${pages}/bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME hapticwall)
install(FILES ${pages}/fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d RENAME hapticwall.fish)
# Debian's zsh reads another folder below /usr than below /usr/local.
install(CODE "set(zsh_folder site-functions)
              if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
                set(zsh_folder vendor-completions)
              endif()")
install(FILES ${pages}/zsh DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/\${zsh_folder}" RENAME _hapticwall)

set(documents ${CMAKE_INSTALL_DATADIR}/doc/hapticwall)
install(FILES ${pages}/copyright README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE
        DESTINATION ${documents})
install(DIRECTORY core/algorithm/plugin/include/hapticwall device/port/include/hapticwall
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY docs DESTINATION ${documents})
# Places of the source tree, so that links of the pages lead somewhere and the examples build.
install(DIRECTORY assets/devices assets/examples assets/fonts assets/hands assets/scenes assets/schemas
        DESTINATION ${documents}/assets)
install(FILES assets/70-hapticwall.rules DESTINATION ${documents}/assets)
install(DIRECTORY core/algorithm/plugin/include DESTINATION ${documents}/core/algorithm/plugin)
install(DIRECTORY device/port/include DESTINATION ${documents}/device/port)

# The id that the desktop knows the program by; kApplicationId in app/ui/window/window.h is the same.
set(desktop_id org.hapticwall.hapticwall)
install(FILES assets/desktop/${desktop_id}.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
install(FILES assets/desktop/${desktop_id}.svg
        DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
install(FILES assets/desktop/${desktop_id}.metainfo.xml
        DESTINATION ${CMAKE_INSTALL_DATADIR}/metainfo)
