# The install tree: libraries, headers, the program, and what find_package(libdsc) reads.
include(CMakePackageConfigHelpers)

set(_dsc_package ${CMAKE_INSTALL_LIBDIR}/cmake/libdsc)

install(TARGETS dsc EXPORT libdscTargets)
install(EXPORT libdscTargets NAMESPACE dsc:: DESTINATION ${_dsc_package})
if(DSC_WITH_CHOLMOD)
  install(TARGETS dsc_cholmod EXPORT libdscCholmodTargets)
  install(EXPORT libdscCholmodTargets NAMESPACE dsc:: DESTINATION ${_dsc_package})
  install(FILES cmake/FindCHOLMOD.cmake DESTINATION ${_dsc_package})
endif()
if(DSC_WITH_CGAL)
  install(TARGETS dsc_truth EXPORT libdscTruthTargets)
  install(EXPORT libdscTruthTargets NAMESPACE dsc:: DESTINATION ${_dsc_package})
  install(DIRECTORY libdsc/truth DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/libdsc
    FILES_MATCHING PATTERN "*.h")
endif()
install(DIRECTORY libdsc DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN "*.h" PATTERN cli EXCLUDE PATTERN truth EXCLUDE)

get_target_property(_dsc_type dsc TYPE)
if(DSC_WITH_CGAL)
  get_target_property(_dsc_truth_type dsc_truth TYPE)
endif()
configure_package_config_file(cmake/libdscConfig.cmake.in ${PROJECT_BINARY_DIR}/libdscConfig.cmake
  INSTALL_DESTINATION ${_dsc_package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/libdscConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/libdscConfig.cmake
              ${PROJECT_BINARY_DIR}/libdscConfigVersion.cmake cmake/FindMETIS.cmake
        DESTINATION ${_dsc_package})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
