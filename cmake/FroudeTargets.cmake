# What every target of this project shares: the language, the warnings, the sanitizers. Targets only, no global flags.
add_library(froude_options INTERFACE)
add_library(froude::options ALIAS froude_options)
target_compile_features(froude_options INTERFACE cxx_std_20)
target_compile_options(froude_options INTERFACE
  -Wall -Wextra -Wshadow -Wnon-virtual-dtor -Wold-style-cast -Wcast-align -Woverloaded-virtual -Wdouble-promotion
  $<$<BOOL:${FROUDE_WARNINGS_AS_ERRORS}>:-Werror>)
if(FROUDE_SANITIZE)
  target_compile_options(froude_options INTERFACE -fsanitize=${FROUDE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(froude_options INTERFACE -fsanitize=${FROUDE_SANITIZE})
endif()

# froude_library(NAME): a library froude_NAME with alias froude::NAME and the common options, not exported with them.
function(froude_library name)
  add_library(froude_${name})
  add_library(froude::${name} ALIAS froude_${name})
  set_target_properties(froude_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(froude_${name} PUBLIC cxx_std_20)
  target_link_libraries(froude_${name} PRIVATE $<BUILD_INTERFACE:froude::options>)
  if(FROUDE_AUDIT)
    target_compile_definitions(froude_${name} PUBLIC FROUDE_AUDIT)
  endif()
endfunction()

# froude_test(NAME SOURCES… LIBRARIES… [DATA]): one GoogleTest program; each TEST becomes a CTest entry named NAME.Suite.Test.
function(froude_test name)
  cmake_parse_arguments(T "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(test_${name} ${T_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${T_LIBRARIES} froude::options GTest::gmock GTest::gtest_main)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(test_${name} PRIVATE
    FROUDE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" FROUDE_REFERENCE_DATA_DEFAULT="${PROJECT_SOURCE_DIR}/../shared/data")
  gtest_discover_tests(test_${name} TEST_PREFIX ${name}. DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
