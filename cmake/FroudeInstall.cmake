# `cmake --install` puts libraries, public headers, the programs and a package that find_package(Froude) finds.
include(CMakePackageConfigHelpers)
set(froude_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Froude)

install(TARGETS froude_hydro froude_dynamics froude_fit froude_compile froude_scene EXPORT FroudeTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
# The grammar's headers are called "scene/…", a name that is taken too easily for the common folder.
install(TARGETS froude_grammar EXPORT FroudeTargets
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/froude)
install(TARGETS froude RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
if(TARGET froude-film)
  install(TARGETS froude-film RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET froude-ranks)
  install(TARGETS froude-ranks RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET froude-validate)
  install(TARGETS froude-validate RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
# The manual page and what shells complete by, which the program itself writes, where Debian looks for them.
install(CODE "
  set(described \"${PROJECT_BINARY_DIR}/described\")
  file(MAKE_DIRECTORY \"\${described}\")
  foreach(words IN ITEMS \"froude.1|man|man/man1\" \"froude|completion;bash|bash-completion/completions\"
                         \"_froude|completion;zsh|zsh/vendor-completions\")
    string(REPLACE \"|\" \";\" parts \"\${words}\")
    list(POP_FRONT parts name)
    list(POP_BACK parts folder)
    execute_process(COMMAND \"$<TARGET_FILE:froude>\" \${parts} OUTPUT_FILE \"\${described}/\${name}\"
      COMMAND_ERROR_IS_FATAL ANY)
    file(INSTALL DESTINATION \"\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}/\${folder}\" TYPE FILE
      FILES \"\${described}/\${name}\")
  endforeach()")
install(EXPORT FroudeTargets NAMESPACE froude:: DESTINATION ${froude_package_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/FroudeConfig.cmake.in ${PROJECT_BINARY_DIR}/FroudeConfig.cmake
  INSTALL_DESTINATION ${froude_package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/FroudeConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/FroudeConfig.cmake ${PROJECT_BINARY_DIR}/FroudeConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/FroudeDependencies.cmake DESTINATION ${froude_package_dir})

# What the programs read at run time, and what a person wants beside it.
install(DIRECTORY ${PROJECT_SOURCE_DIR}/validation ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/froude
  PATTERN CMakeLists.txt EXCLUDE PATTERN "*.cpp" EXCLUDE PATTERN "*.hpp" EXCLUDE)
install(FILES ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/LICENSE
  DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs)
