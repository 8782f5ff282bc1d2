# What the library needs. Also installed with the package, whose config file includes it.
# Debian keeps FindOpenVDB.cmake beside its library rather than among CMake's own modules.
list(APPEND CMAKE_MODULE_PATH "/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE}/cmake/OpenVDB")

find_package(TBB REQUIRED)
# OpenVDB's module turns BUILD_SHARED_LIBS on for whoever calls it.
set(pdc_saved_build_shared_libs "${BUILD_SHARED_LIBS}")
find_package(OpenVDB REQUIRED COMPONENTS openvdb)
set(BUILD_SHARED_LIBS "${pdc_saved_build_shared_libs}")
unset(pdc_saved_build_shared_libs)
find_package(OpenMesh REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(PNG REQUIRED)
find_package(ZLIB REQUIRED)
find_package(fmt REQUIRED)
find_package(yaml-cpp REQUIRED)
find_package(muparser REQUIRED)

# What can be left out: ON, OFF or, where nothing is said, whether it is there. The installed package says what it has.
set(PDC_TIFF OFF)
if(NOT DEFINED PDC_WITH_TIFF OR PDC_WITH_TIFF STREQUAL "AUTO")
  find_package(TIFF QUIET)
  set(PDC_TIFF ${TIFF_FOUND})
elseif(PDC_WITH_TIFF)
  find_package(TIFF REQUIRED)
  set(PDC_TIFF ON)
endif()
