# Every outside library, in one place. The installed package's config file includes this file too, so a consumer
# finds exactly what the build found. Debian's package names are in scripts/apt-packages.txt.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(fmt REQUIRED)
find_package(HDF5 1.10 REQUIRED COMPONENTS C HL)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(NETCDF REQUIRED IMPORTED_TARGET netcdf)
if(FROUDE_BUILD_BENCHMARKS)
  find_package(benchmark 1.7 REQUIRED)
endif()

# SuiteSparse 5.12 ships neither a CMake config nor a pkg-config file.
if(NOT TARGET froude::suitesparse)
  find_path(SUITESPARSE_INCLUDE_DIR klu.h PATH_SUFFIXES suitesparse REQUIRED)
  add_library(froude::suitesparse INTERFACE IMPORTED)
  target_include_directories(froude::suitesparse SYSTEM INTERFACE ${SUITESPARSE_INCLUDE_DIR})
  foreach(part spqr klu btf amd colamd cholmod suitesparseconfig)
    find_library(SUITESPARSE_${part}_LIBRARY ${part} REQUIRED)
    target_link_libraries(froude::suitesparse INTERFACE ${SUITESPARSE_${part}_LIBRARY})
  endforeach()
endif()
