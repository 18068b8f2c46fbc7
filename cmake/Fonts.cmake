# hapticwall_find_fonts(OUT): the font files that the window carries. Their licence is the SIL Open
# Font License (assets/fonts/OFL.txt).
function(hapticwall_find_fonts out)
  set(fonts)
  foreach(name Inter-Regular.otf Inter-SemiBold.otf JetBrainsMono-Regular.ttf)
    find_file(
      HAPTICWALL_FONT_${name} ${name}
      PATHS /usr/share/fonts /usr/local/share/fonts
      PATH_SUFFIXES opentype/inter truetype/inter opentype/jetbrains-mono truetype/jetbrains-mono
      REQUIRED NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
    mark_as_advanced(HAPTICWALL_FONT_${name})
    list(APPEND fonts ${HAPTICWALL_FONT_${name}})
  endforeach()
  set(${out} ${fonts} PARENT_SCOPE)
endfunction()
