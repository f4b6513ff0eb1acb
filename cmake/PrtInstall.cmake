# `cmake --install`: the library with its CMake package (find_package(prt) gives prt::prt), the programs and data.
include(CMakePackageConfigHelpers)

set(PRT_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/prt)
install(TARGETS prt EXPORT prtTargets)
install(DIRECTORY libprt/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/libprt FILES_MATCHING PATTERN "*.h")
install(EXPORT prtTargets NAMESPACE prt:: DESTINATION ${PRT_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/prtConfig.cmake.in ${PROJECT_BINARY_DIR}/prtConfig.cmake
  INSTALL_DESTINATION ${PRT_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/prtConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/prtConfig.cmake ${PROJECT_BINARY_DIR}/prtConfigVersion.cmake
  cmake/PrtDependencies.cmake DESTINATION ${PRT_PACKAGE_DIR})
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(TARGETS prt_cli)
if(TARGET prt-studio)
  install(TARGETS prt-studio)
  install(FILES resources/desktop/prt-studio.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications)
  install(FILES resources/theme/prt-studio.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps)
endif()

set(CPACK_PACKAGE_NAME prt-studio)
set(CPACK_PACKAGE_VENDOR "PRT Studio")
set(CPACK_PACKAGE_CONTACT "PRT Studio maintainers")
set(CPACK_PACKAGE_FILE_NAME prt-studio-${PROJECT_VERSION}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_STRIP_FILES ON)
include(CPack)
