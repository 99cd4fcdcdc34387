# rl_shared: librestlab.so, for programs that hold a Session and for the Python module. It has all methods and
# kernels, scenes, references, metrics and statistics. The program and the tests are linked from the same objects.
add_library(rl_shared SHARED)
# Of these a program may call anything. Of the others the linker takes what rl_methods names.
foreach(part IN ITEMS rl_methods rl_core rl_runner rl_report rl_statistics rl_truths)
  target_sources(rl_shared PRIVATE $<TARGET_OBJECTS:${part}>)
  if(NOT part STREQUAL "rl_methods")
    target_link_libraries(rl_shared PRIVATE ${part}) # for the libraries that it needs itself
  endif()
endforeach()
target_link_libraries(rl_shared
  PRIVATE rl_integrators rl_caches rl_denoise rl_kernels
  PUBLIC glm::glm # in public headers
  INTERFACE $<BUILD_INTERFACE:rl_options> $<BUILD_INTERFACE:fmt::fmt> $<BUILD_INTERFACE:nlohmann_json::nlohmann_json>)
set(_map ${CMAKE_CURRENT_LIST_DIR}/librestlab.map)
# A call from one part of the library to another does not look for a function of the same name elsewhere.
target_link_options(rl_shared PRIVATE LINKER:--version-script=${_map} LINKER:-Bsymbolic-functions LINKER:-z,defs)
set_target_properties(rl_shared PROPERTIES
  OUTPUT_NAME restlab
  EXPORT_NAME restlab
  LINKER_LANGUAGE CXX
  VERSION ${PROJECT_VERSION}
  SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} # before 1.0 each minor version may differ
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
  LINK_DEPENDS ${_map})
