# The installed package: find_package(pdc) gives pdc::pdc.
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/pdc)
install(TARGETS pdc EXPORT pdc-targets)
install(DIRECTORY include/pdc TYPE INCLUDE)
install(EXPORT pdc-targets NAMESPACE pdc:: DESTINATION ${package_dir})
configure_package_config_file(cmake/pdc-config.cmake.in pdc-config.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(pdc-config-version.cmake COMPATIBILITY SameMinorVersion)
install(
  FILES
    ${CMAKE_CURRENT_BINARY_DIR}/pdc-config.cmake
    ${CMAKE_CURRENT_BINARY_DIR}/pdc-config-version.cmake
    cmake/dependencies.cmake
  DESTINATION ${package_dir})
if(PDC_BUILD_APPS)
  install(TARGETS pdc_program)
endif()
if(TARGET pdc_dicom)
  install(TARGETS pdc_dicom LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/pdc)
endif()
install(FILES LICENSE TYPE DOC)
