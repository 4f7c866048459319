# Declares the packages: header-only targets Quadrille::<Package>, their install rules and the package configuration.

include(CMakePackageConfigHelpers)

set(QUADRILLE_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Quadrille)

# quadrille_add_package()
#
# Makes the folder of the calling CMakeLists.txt the package Quadrille::<folder>. Its package_info/dependencies has one
# dependency per line: a package of Quadrille or a library of QuadrilleDependencies.cmake. A library marked "optional"
# is used where it was found, with the compile definition QUADRILLE_WITH_<NAME>.
function(quadrille_add_package)
  get_filename_component(name ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  set(target quadrille_${name})

  add_library(${target} INTERFACE)
  add_library(Quadrille::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} INTERFACE cxx_std_17)
  target_include_directories(${target} INTERFACE
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS package_info/dependencies)
  file(STRINGS package_info/dependencies lines)
  set(packages "")
  set(finds "")
  foreach(line IN LISTS lines)
    separate_arguments(line)
    list(POP_FRONT line dependency)
    if(dependency IN_LIST QUADRILLE_PACKAGES)
      target_link_libraries(${target} INTERFACE Quadrille::${dependency})
      list(APPEND packages ${dependency})
    elseif(QUADRILLE_${dependency}_TARGET)
      target_link_libraries(${target} INTERFACE ${QUADRILLE_${dependency}_TARGET})
      list(APPEND finds "${QUADRILLE_${dependency}_FIND}")
      if(line STREQUAL "optional")
        string(TOUPPER ${dependency} upper)
        target_compile_definitions(${target} INTERFACE QUADRILLE_WITH_${upper})
      endif()
    elseif(NOT line STREQUAL "optional")
      message(FATAL_ERROR "${name}/package_info/dependencies: unknown dependency \"${dependency}\"")
    endif()
  endforeach()

  export(TARGETS ${target} NAMESPACE Quadrille:: FILE ${PROJECT_BINARY_DIR}/QuadrilleTargets-${name}.cmake)
  if(QUADRILLE_INSTALL)
    install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
    install(TARGETS ${target} EXPORT QuadrilleTargets-${name})
    install(EXPORT QuadrilleTargets-${name} NAMESPACE Quadrille:: DESTINATION ${QUADRILLE_CMAKE_DIR})
  endif()

  set_property(GLOBAL APPEND_STRING PROPERTY QUADRILLE_PACKAGE_TABLE
    "set(_quadrille_${name}_depends \"${packages}\")\nset(_quadrille_${name}_finds \"${finds}\")\n")
endfunction()

# Writes and installs QuadrilleConfig.cmake, once all packages are declared.
function(quadrille_finish_packages)
  get_property(QUADRILLE_PACKAGE_TABLE GLOBAL PROPERTY QUADRILLE_PACKAGE_TABLE)
  configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/QuadrilleConfig.cmake.in
    ${PROJECT_BINARY_DIR}/QuadrilleConfig.cmake
    INSTALL_DESTINATION ${QUADRILLE_CMAKE_DIR}
    NO_SET_AND_CHECK_MACRO)
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/QuadrilleConfigVersion.cmake
    COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
  file(GLOB find_modules ${PROJECT_SOURCE_DIR}/cmake/Find*.cmake)
  file(COPY ${find_modules} DESTINATION ${PROJECT_BINARY_DIR}/modules)
  if(QUADRILLE_INSTALL)
    install(FILES ${find_modules} DESTINATION ${QUADRILLE_CMAKE_DIR}/modules)
    install(FILES ${PROJECT_BINARY_DIR}/QuadrilleConfig.cmake ${PROJECT_BINARY_DIR}/QuadrilleConfigVersion.cmake
      DESTINATION ${QUADRILLE_CMAKE_DIR})
  endif()
endfunction()
