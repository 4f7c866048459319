# Tests that other projects can use the packages: from the build tree, installed, and as a subfolder.

set(prefix ${CMAKE_CURRENT_BINARY_DIR}/installed)
if(QUADRILLE_INSTALL)
  add_test(NAME install COMMAND ${CMAKE_COMMAND} --install ${PROJECT_BINARY_DIR} --prefix ${prefix})
  set_tests_properties(install PROPERTIES FIXTURES_SETUP installed)
endif()

function(quadrille_add_consumer name)
  add_test(NAME consumer_${name}
    COMMAND ${CMAKE_CTEST_COMMAND}
      --build-and-test ${CMAKE_CURRENT_SOURCE_DIR}/consumer ${CMAKE_CURRENT_BINARY_DIR}/consumer_${name}
      --build-generator ${CMAKE_GENERATOR}
      --build-options ${ARGN} -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} -DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}
      --test-command consumer)
endfunction()

quadrille_add_consumer(build_tree -DQuadrille_DIR=${PROJECT_BINARY_DIR})
quadrille_add_consumer(subfolder -DQUADRILLE_SOURCE=${PROJECT_SOURCE_DIR})
if(QUADRILLE_INSTALL)
  quadrille_add_consumer(installed -DQuadrille_DIR=${prefix}/${QUADRILLE_CMAKE_DIR})
  set_tests_properties(consumer_installed PROPERTIES FIXTURES_REQUIRED installed)
endif()
