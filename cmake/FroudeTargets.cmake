# What every target of this project shares: the language, the warnings, the sanitizers. Targets only, no global flags.
add_library(froude_options INTERFACE)
add_library(froude::options ALIAS froude_options)
target_compile_features(froude_options INTERFACE cxx_std_20)
target_compile_options(froude_options INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual -Wdouble-promotion
  $<$<BOOL:${FROUDE_WARNINGS_AS_ERRORS}>:-Werror>)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  # GCC 12 warns of Eigen's vectors as freed before they are used, where none is; the address sanitizer looks itself.
  target_compile_options(froude_options INTERFACE -Wno-use-after-free)
  # A compiler that may keep what it has read, instead of looking for what it can forget, is done a fifth sooner; it then takes
  # up to 2.2 GB, and ninja runs one or two more than there are cores. (GCC's manual, --param ggc-min-expand and
  # ggc-min-heapsize)
  cmake_host_system_information(RESULT froude_megabytes QUERY TOTAL_PHYSICAL_MEMORY)
  cmake_host_system_information(RESULT froude_cores QUERY NUMBER_OF_LOGICAL_CORES)
  math(EXPR froude_share "${froude_megabytes} / ${froude_cores}")
  if(froude_share GREATER 3500)
    target_compile_options(froude_options INTERFACE --param=ggc-min-expand=300 --param=ggc-min-heapsize=1048576)
  endif()
endif()
if(FROUDE_SANITIZE)
  # The three checks left out look at every access to memory, as the address sanitizer does, and double the time of a build.
  target_compile_options(froude_options INTERFACE -fsanitize=${FROUDE_SANITIZE}
    -fno-sanitize=null,alignment,pointer-overflow -fno-omit-frame-pointer)
  target_link_options(froude_options INTERFACE -fsanitize=${FROUDE_SANITIZE})
  # GCC's manual: with sanitizers this warning is often false. Builds without them keep it.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(froude_options INTERFACE -Wno-maybe-uninitialized)
  endif()
  # Under the address sanitizer Eigen takes an allocator of its own, which does not go with code that was compiled
  # without it: Debian's Ceres is a static library. malloc is aligned to 16 bytes there too.
  target_compile_definitions(froude_options INTERFACE EIGEN_MALLOC_ALREADY_ALIGNED=1)
endif()

include(FroudePrecompile)
if(FROUDE_PRECOMPILED_HEADERS)
  # What the standard library and Eigen bring to most files.
  set(froude_wide_headers algorithm array chrono cmath complex filesystem functional limits map memory numbers optional span
    string variant vector Eigen/Geometry)
  froude_common_headers(froude_library_headers PIC HEADERS Eigen/Core fmt/format.h MERGED ${froude_wide_headers})
endif()

# froude_merge(TARGET [BATCH COUNT] [APART FILE…] [ALONE FILE…]): compiles ten files of a target, or COUNT, as one, which halves the
# time of a build: a template that several use is made once. APART are files that name private things as others do; they are one
# unit of their own. ALONE are files that would make theirs longer than a core should be waited for. To be called when all files
# of the target are known.
function(froude_merge target)
  cmake_parse_arguments(M "" "BATCH" "APART;ALONE" ${ARGN})
  if(NOT FROUDE_MERGED_SOURCES)
    return()
  endif()
  if(NOT M_BATCH)
    set(M_BATCH 10)
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    target_compile_options(${target} PRIVATE -Wno-subobject-linkage)  # no file of one target is a header
  endif()
  get_target_property(folder ${target} SOURCE_DIR)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "\\.cpp$")
  list(TRANSFORM M_APART PREPEND "${folder}/")
  list(TRANSFORM M_ALONE PREPEND "${folder}/")
  set(count 0)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE)
    if(source IN_LIST M_ALONE)
      continue()
    elseif(source IN_LIST M_APART)
      set(unit apart)
    else()
      math(EXPR unit "${count} / ${M_BATCH}")
      math(EXPR count "${count} + 1")
    endif()
    set_source_files_properties(${source} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${unit})
  endforeach()
endfunction()

# froude_parts(TARGET LIST PATTERN NAME…): for each NAME the file whose name is PATTERN with it in place of *, added to TARGET,
# and FROUDE_PART(NAME) in LIST.inc, which the owner of the list includes: one more part of a kind is a file and its name. A
# static object that enters itself would be lost where nothing else of its file is used.
function(froude_parts target list pattern)
  set(lines)
  foreach(name IN LISTS ARGN)
    string(REPLACE "*" "${name}" file "${pattern}")
    target_sources(${target} PRIVATE ${file})
    string(APPEND lines "FROUDE_PART(${name})\n")
  endforeach()
  file(CONFIGURE OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/parts/${list}.inc CONTENT "${lines}" @ONLY)
  target_include_directories(${target} PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/parts)
endfunction()

# froude_library(NAME [HEADERS]): a library froude_NAME with alias froude::NAME and the common options, not exported with them;
# its files read the set HEADERS precompiled, or that of the libraries.
function(froude_library name)
  set(headers ${ARGN} froude_library_headers)
  list(GET headers 0 headers)
  add_library(froude_${name})
  add_library(froude::${name} ALIAS froude_${name})
  set_target_properties(froude_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(froude_${name} PUBLIC cxx_std_20)
  target_link_libraries(froude_${name} PRIVATE $<BUILD_INTERFACE:froude::options>)
  froude_precompile(froude_${name} ${headers})
  if(FROUDE_AUDIT)
    target_compile_definitions(froude_${name} PUBLIC FROUDE_AUDIT)
  endif()
endfunction()

# froude_test(NAME SOURCES… LIBRARIES…): one GoogleTest program; each TEST becomes a CTest entry named NAME.Suite.Test. The
# files are compiled together, so each has a namespace of its own, named after it. With sanitizers a program takes longer to
# begin than most tests take, so there the entries are NAME.1 to NAME.4, each a quarter of the program's tests in one process,
# with the label of their part (tests/CMakeLists.txt). What tests themselves say is compiled with -O1: libraries and programs
# take nearly all of their time, and a third of the time of compiling them goes.
set(froude_test_optimisation $<$<CONFIG:Release,RelWithDebInfo>:-O1>)
function(froude_test name)
  cmake_parse_arguments(T "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(test_${name} ${T_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${T_LIBRARIES} froude_test_folders froude::options GTest::gmock GTest::gtest_main)
  target_compile_options(test_${name} PRIVATE ${froude_test_optimisation})
  froude_precompile(test_${name} froude_test_headers)
  froude_merge(test_${name})
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  add_dependencies(tests_of_${froude_part} test_${name})
  if(NOT FROUDE_SANITIZE)
    gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
    return()
  endif()
  foreach(quarter RANGE 1 4)
    math(EXPR index "${quarter} - 1")
    add_test(NAME ${name}.${quarter} COMMAND test_${name} --gtest_brief=1)
    set_tests_properties(${name}.${quarter} PROPERTIES TIMEOUT 900 COST 50 LABELS ${froude_part}
      ENVIRONMENT "GTEST_TOTAL_SHARDS=4;GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()
