# `cmake --install` puts libraries, public headers, the program and a package that find_package(Froude) finds.
include(CMakePackageConfigHelpers)
