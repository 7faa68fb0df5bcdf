# The install tree: libraries, headers, the program, and what find_package(libdsc) and pkg-config read.
# Its components are the packages of cmake/Packages.cmake: program, images (dsc-image-reader), openvdb
# (dsc-vdb-reader), library
# (shared ones, for the program to run) and development.
include(CMakePackageConfigHelpers)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)

set(_dsc_package ${CMAKE_INSTALL_LIBDIR}/cmake/libdsc)

install(TARGETS dsc EXPORT libdscTargets
  ARCHIVE COMPONENT development LIBRARY COMPONENT library NAMELINK_COMPONENT development)
install(EXPORT libdscTargets NAMESPACE dsc:: DESTINATION ${_dsc_package})
if(DSC_WITH_CHOLMOD)
  install(TARGETS dsc_cholmod EXPORT libdscCholmodTargets
    ARCHIVE COMPONENT development LIBRARY COMPONENT library NAMELINK_COMPONENT development)
  install(EXPORT libdscCholmodTargets NAMESPACE dsc:: DESTINATION ${_dsc_package})
  install(FILES cmake/FindCHOLMOD.cmake DESTINATION ${_dsc_package})
endif()
if(DSC_WITH_CGAL)
  install(TARGETS dsc_truth EXPORT libdscTruthTargets
    ARCHIVE COMPONENT development LIBRARY COMPONENT library NAMELINK_COMPONENT development)
  install(EXPORT libdscTruthTargets NAMESPACE dsc:: DESTINATION ${_dsc_package})
  install(DIRECTORY libdsc/truth DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/libdsc
    FILES_MATCHING PATTERN "*.h")
endif()
if(DSC_WITH_PICTURES)
  install(TARGETS dsc_render EXPORT libdscRenderTargets
    ARCHIVE COMPONENT development LIBRARY COMPONENT library NAMELINK_COMPONENT development)
  install(EXPORT libdscRenderTargets NAMESPACE dsc:: DESTINATION ${_dsc_package})
  install(DIRECTORY libdsc/render DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/libdsc
    FILES_MATCHING PATTERN "*.h")
endif()
install(DIRECTORY libdsc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h" PATTERN cli EXCLUDE PATTERN truth EXCLUDE PATTERN render EXCLUDE)

get_target_property(_dsc_type dsc TYPE)
if(DSC_WITH_CGAL)
  get_target_property(_dsc_truth_type dsc_truth TYPE)
endif()
if(DSC_WITH_PICTURES)
  get_target_property(_dsc_render_type dsc_render TYPE)
endif()
configure_package_config_file(cmake/libdscConfig.cmake.in ${PROJECT_BINARY_DIR}/libdscConfig.cmake
  INSTALL_DESTINATION ${_dsc_package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/libdscConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/libdscConfig.cmake
              ${PROJECT_BINARY_DIR}/libdscConfigVersion.cmake cmake/FindMETIS.cmake
        DESTINATION ${_dsc_package})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# pkg-config: of a static library the user links what it needs inside too.
set(_dsc_pc_requires "")
set(_dsc_pc_libs "")
if(_dsc_type STREQUAL "STATIC_LIBRARY")
  set(_dsc_pc_requires ", zlib, expat, muparser, fmt")
  set(_dsc_pc_libs "-lmetis -lpthread")
  if(DSC_PARALLEL STREQUAL "TBB")
    string(APPEND _dsc_pc_requires ", tbb")
  endif()
endif()
configure_file(cmake/libdsc.pc.in ${PROJECT_BINARY_DIR}/libdsc.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/libdsc.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(DSC_BUILD_CLI)  # the texts that the program has of itself
  set(_dsc_texts ${PROJECT_BINARY_DIR}/texts)
  add_custom_command(OUTPUT ${_dsc_texts}/dsc.1 ${_dsc_texts}/dsc.bash ${_dsc_texts}/_dsc
    COMMAND ${CMAKE_COMMAND} -E make_directory ${_dsc_texts}
    COMMAND dsc_program --manual > ${_dsc_texts}/dsc.1
    COMMAND dsc_program --completion bash > ${_dsc_texts}/dsc.bash
    COMMAND dsc_program --completion zsh > ${_dsc_texts}/_dsc
    DEPENDS dsc_program VERBATIM)
  add_custom_target(dsc_texts ALL DEPENDS ${_dsc_texts}/dsc.1)
  install(FILES ${_dsc_texts}/dsc.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
  install(FILES ${_dsc_texts}/dsc.bash RENAME dsc COMPONENT program
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${_dsc_texts}/_dsc COMPONENT program
    DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/dsc COMPONENT program)
endif()

include(Packages)
