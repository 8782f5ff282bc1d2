# Debian packages and an archive, by cpack: `./dev package`.
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_PACKAGE_CONTACT "pdc contributors <pdc@lists.example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)

set(CPACK_COMPONENTS_ALL program library)
if(PDC_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME pdc)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
  "volumes to meshes by probabilistic dual contouring
 Turns OpenVDB grids, dense volumes, implicit scenes, points and meshes in need
 of repair into meshes that are closed, manifold and free of
 self-intersections, with sharp edges and corners where the volume has them.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libpdc-dev)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_DEPENDS
  "libopenvdb-dev, libboost-iostreams-dev, zlib1g-dev, libtbb-dev, libopenmesh-dev, libembree-dev, libpng-dev, libtiff-dev, libfmt-dev, libyaml-cpp-dev, libmuparser-dev")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION
  "library of probabilistic dual contouring
 Headers, the static library and the package for CMake: samples implicit
 functions and grids, contours them, and simplifies, smooths, refines, checks
 and draws meshes.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-pdc)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
  "volumes to meshes by probabilistic dual contouring, for Python
 Arrays, grids, scenes, functions, points and files become meshes whose arrays
 are views of memory, without a copy.")

# What Debian wants beside each package's files.
set(papers ${PROJECT_BINARY_DIR}/package)
file(MAKE_DIRECTORY ${papers})
configure_file(CHANGELOG.md ${papers}/changelog COPYONLY)
execute_process(COMMAND gzip -9nkf ${papers}/changelog COMMAND_ERROR_IS_FATAL ANY)
foreach(component ${CPACK_COMPONENTS_ALL})
  string(TOUPPER ${component} upper)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES LICENSE RENAME copyright DESTINATION ${folder} COMPONENT ${component})
  install(FILES ${papers}/changelog.gz DESTINATION ${folder} COMPONENT ${component})
endforeach()
include(CPack)
