# The target check_headers compiles every public header on its own, against its package's declared dependencies only.
# Not part of the default build: a header takes seconds.

add_custom_target(check_headers)
foreach(package IN LISTS QUADRILLE_PACKAGES)
  set(include ${PROJECT_SOURCE_DIR}/${package}/include)
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${include} ${include}/Quadrille/*.h)
  set(sources "")
  foreach(header IN LISTS headers)
    set(source ${CMAKE_CURRENT_BINARY_DIR}/check_headers/${package}/${header}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "#include <${header}>\n#include <${header}>\n")
    list(APPEND sources ${source})
  endforeach()
  if(sources)
    add_library(check_headers_${package} OBJECT EXCLUDE_FROM_ALL ${sources})
    target_link_libraries(check_headers_${package} PRIVATE Quadrille::${package} quadrille_warnings)
    add_dependencies(check_headers check_headers_${package})
  endif()
endforeach()
