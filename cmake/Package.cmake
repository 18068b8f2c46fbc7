# `cpack` in the build folder, or `./dev package`: the installed program as a package of Debian.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Haptic Wall developers")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
# dpkg-shlibdeps finds the linked libraries. The window loads OpenGL by name.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS libgl1)
include(CPack)
