# A library as it is installed: its file, its public headers, its component of nilasConfig.cmake, its pkg-config file.
#
#     nilas_library(COMPONENT SOURCES ... HEADERS ... LINK ... [PRIVATE_LINK ...]
#       DESCRIPTION "..." PKG_REQUIRES "..." [PKG_LIBS "..."])
#
# makes the target nilas_COMPONENT (with _ for -), nilas::COMPONENT to others. HEADERS: the public ones; what they declare
# between `#pragma GCC visibility push(default)` and `pop` is what a shared library exports.
include(GNUInstallDirs)

set(nilas_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nilas)
file(RELATIVE_PATH nilas_prefix_from_pc /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)

function(nilas_library component)
  cmake_parse_arguments(arg "" "DESCRIPTION;PKG_REQUIRES;PKG_LIBS" "SOURCES;HEADERS;LINK;PRIVATE_LINK" ${ARGN})
  string(REPLACE - _ target nilas_${component})
  add_library(${target} ${arg_SOURCES})
  add_library(nilas::${component} ALIAS ${target})
  list(TRANSFORM arg_HEADERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  target_sources(${target} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${arg_LINK} PRIVATE ${arg_PRIVATE_LINK})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${component}
    DEFINE_SYMBOL "" VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} INSTALL_RPATH "\$ORIGIN")

  install(TARGETS ${target} EXPORT nilas-${component}-targets FILE_SET HEADERS DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/nilas)
  install(EXPORT nilas-${component}-targets NAMESPACE nilas:: DESTINATION ${nilas_cmake_dir})
  set(pc ${PROJECT_BINARY_DIR}/nilas-${component}.pc)
  configure_file(${PROJECT_SOURCE_DIR}/.install/library.pc.in ${pc} @ONLY)
  install(FILES ${pc} DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
