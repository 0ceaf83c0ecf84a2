# nilasConfig.cmake and its version.
include(CMakePackageConfigHelpers)
configure_package_config_file(${PROJECT_SOURCE_DIR}/.install/nilasConfig.cmake.in ${PROJECT_BINARY_DIR}/nilasConfig.cmake
  INSTALL_DESTINATION ${nilas_cmake_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nilasConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nilasConfig.cmake ${PROJECT_BINARY_DIR}/nilasConfigVersion.cmake
  DESTINATION ${nilas_cmake_dir})
