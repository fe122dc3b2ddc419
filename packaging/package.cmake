# What is installed beside the library, and what `cpack` and tools/package make of it. Two components: the program and the library.
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME program)
install(TARGETS cnctrans RUNTIME COMPONENT program)

# The manual page and the completions are what the command says of itself.
set(spoken ${CMAKE_BINARY_DIR}/spoken)
file(MAKE_DIRECTORY ${spoken})
add_custom_command(TARGET cnctrans POST_BUILD
  COMMAND cnctrans man > ${spoken}/cnctrans.1
  COMMAND cnctrans completion bash > ${spoken}/cnctrans
  COMMAND cnctrans completion zsh > ${spoken}/_cnctrans
  COMMAND cnctrans completion fish > ${spoken}/cnctrans.fish VERBATIM)
find_program(CNCTRANS_GZIP gzip)
if(CNCTRANS_GZIP)
  add_custom_command(TARGET cnctrans POST_BUILD COMMAND ${CNCTRANS_GZIP} -9nf ${spoken}/cnctrans.1 VERBATIM)
  set(man_page cnctrans.1.gz)
else()
  set(man_page cnctrans.1)
endif()
install(FILES ${spoken}/${man_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES ${spoken}/cnctrans DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
install(FILES ${spoken}/_cnctrans DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT program)
install(FILES ${spoken}/cnctrans.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT program)
file(READ ${CMAKE_SOURCE_DIR}/LICENSE licence)
file(READ ${CMAKE_SOURCE_DIR}/packaging/THIRD-PARTY-NOTICES notices)
file(WRITE ${spoken}/copyright "${licence}\n\n${notices}")
install(FILES ${spoken}/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES README.md CHANGELOG.md LICENSE packaging/THIRD-PARTY-NOTICES DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT program FILES_MATCHING PATTERN "*.md" PATTERN "*.png")
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DATADIR}/cnctrans COMPONENT program)
install(FILES machine/profile.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/cnctrans COMPONENT program)

# cnctrans_static: the program without any shared library, for the tarball and the image. libfmt and polyclipping have no archives
# in Debian: the one is compiled from its headers, the other from its source, which CNCTRANS_POLYCLIPPING_SOURCE names.
set(CNCTRANS_POLYCLIPPING_SOURCE "" CACHE FILEPATH "clipper.cpp, for the static program")
if(CNCTRANS_POLYCLIPPING_SOURCE AND NOT CNCTRANS_SHARED)
  add_executable(cnctrans_static EXCLUDE_FROM_ALL $<TARGET_OBJECTS:cnctrans> packaging/fmt_static.cpp ${CNCTRANS_POLYCLIPPING_SOURCE})
  add_dependencies(cnctrans_static cnctrans_library cnc_lsp)
  target_include_directories(cnctrans_static SYSTEM PRIVATE ${CNCTRANS_POLYCLIPPING_INCLUDE}/polyclipping)
  target_link_libraries(cnctrans_static PRIVATE $<TARGET_FILE:cnc_lsp> ${CMAKE_BINARY_DIR}/lib/libcnctrans.a -static)
endif()

set(CPACK_PACKAGE_NAME cnctrans)
set(CPACK_PACKAGE_VENDOR "cnctrans")
set(CPACK_PACKAGE_CONTACT "The cnctrans authors <cnctrans@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "translate CNC part programs between controls, with a proof")
set(CPACK_PACKAGE_DESCRIPTION "Translates part programs between the languages of CNC controllers
(Fagor 8055, NUM 760/1060, Sinumerik 840D, Heidenhain iTNC 530) and
replays both programs to show that the machine moves alike.")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME cnctrans)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libcnctrans-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS "libfmt-dev, libpolyclipping-dev")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS OFF)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "The engine of cnctrans for programs in C and C++
Headers, a static library, a CMake package and a pkg-config file.")
set(CPACK_COMPONENTS_ALL program library)
include(CPack)
