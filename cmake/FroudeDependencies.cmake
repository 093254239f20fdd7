# Every outside library, in one place. The installed package's config file includes this file too, so a consumer
# finds exactly what the build found. Debian's package names are in scripts/apt-packages.txt.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Ceres 2.1 REQUIRED)
find_package(glog 0.6 REQUIRED)  # by which Ceres writes messages
find_package(fmt REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(HDF5 1.10 REQUIRED COMPONENTS C HL)
find_package(LAPACK REQUIRED)  # OpenBLAS where it is installed: the reference's own takes ten times as long
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFTW3 REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(NETCDF REQUIRED IMPORTED_TARGET netcdf)
find_package(SQLite3 3.37 REQUIRED)
# By hand: Debian's CMake package of SUNDIALS asks for PETSc, Trilinos and MPI, of which nothing is used here.
if(FROUDE_SUNDIALS AND NOT TARGET froude::sundials)
  find_path(SUNDIALS_INCLUDE_DIR cvode/cvode.h REQUIRED)
  add_library(froude::sundials INTERFACE IMPORTED)
  target_include_directories(froude::sundials SYSTEM INTERFACE ${SUNDIALS_INCLUDE_DIR})
  foreach(part cvode nvecserial sunmatrixdense sunlinsoldense generic)
    find_library(SUNDIALS_${part}_LIBRARY sundials_${part} REQUIRED)
    target_link_libraries(froude::sundials INTERFACE ${SUNDIALS_${part}_LIBRARY})
  endforeach()
endif()
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
