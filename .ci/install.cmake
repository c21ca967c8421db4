# SPDX-License-Identifier: GPL-3.0-only
# cmake --install BUILD --prefix PREFIX, and cpack in the build folder for a Debian package. Both programs stand in libexec, where one
# finds the other; what one calls is linked into bin.
include(GNUInstallDirs)
set(data ${CMAKE_INSTALL_DATAROOTDIR}/sprag)
install(TARGETS sprag sprag-models DESTINATION libexec/sprag)
install(DIRECTORY meshes params postprocess DESTINATION ${data}
  FILES_MATCHING PATTERN "*.geo" PATTERN "*.prm" PATTERN "__pycache__" EXCLUDE PATTERN "pictures" EXCLUDE)
install(DIRECTORY postprocess DESTINATION ${data} USE_SOURCE_PERMISSIONS
  FILES_MATCHING PATTERN "*.py" PATTERN "py.typed" PATTERN "*.html" PATTERN "__pycache__" EXCLUDE)
install(FILES .ci/completion.bash DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions RENAME sprag)
install(FILES .ci/sprag.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(FILES README.md CHANGELOG.md LICENSE CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY meshes params postprocess DESTINATION ${CMAKE_INSTALL_DOCDIR}
  FILES_MATCHING PATTERN "*.md" PATTERN "*.ipynb" PATTERN "*.png" PATTERN "*.svg" PATTERN "__pycache__" EXCLUDE)
install(CODE "
  file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin\")
  file(CREATE_LINK ../libexec/sprag/sprag \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin/sprag\" SYMBOLIC)
  file(CREATE_LINK ../${data}/postprocess/plot.py \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/bin/sprag-plot\" SYMBOLIC)
  file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/python3/dist-packages\")
  file(CREATE_LINK ../../../${data}/postprocess/sprag \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/lib/python3/dist-packages/sprag\" SYMBOLIC)")

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "the authors of sprag <sprag@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Finite-element contact of the linear friction damper")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "python3, python3-numpy, python3-h5py, python3-jinja2, python3-matplotlib, libopenblas0-serial, openmpi-bin")
find_program(SHLIBDEPS dpkg-shlibdeps)
if(SHLIBDEPS)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
include(CPack)
