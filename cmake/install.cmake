# What is installed, in three components: the program, the library with its package for find_package(pdc), and, from
# python/, the Python package.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pdc)
install(TARGETS pdc EXPORT pdc-targets COMPONENT library)
install(DIRECTORY include/pdc TYPE INCLUDE COMPONENT library)
install(EXPORT pdc-targets NAMESPACE pdc:: DESTINATION ${package_dir} COMPONENT library)
configure_package_config_file(cmake/pdc-config.cmake.in pdc-config.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(pdc-config-version.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES
    ${CMAKE_CURRENT_BINARY_DIR}/pdc-config.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/pdc-config-version.cmake
    cmake/dependencies.cmake
  DESTINATION ${package_dir} COMPONENT library)
if(PDC_BUILD_APPS)
  install(TARGETS pdc_program COMPONENT program)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/manual/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program
    FILES_MATCHING PATTERN "*.1.gz")
  install(FILES ${PROJECT_BINARY_DIR}/manual/pdc.bash RENAME pdc
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
endif()
if(TARGET pdc_dicom)
  install(TARGETS pdc_dicom LIBRARY DESTINATION lib/pdc COMPONENT program)
endif()
