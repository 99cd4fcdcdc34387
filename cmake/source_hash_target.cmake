# generated/source_hash.h: what this build was made from. Looked at on every build (a few
# milliseconds), written only when something changed.
string(TOUPPER "${CMAKE_BUILD_TYPE}" _config)
set(_flags "${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${_config}}")
get_target_property(_options rl_options INTERFACE_COMPILE_OPTIONS)
list(FILTER _options INCLUDE REGEX "^-(f|m|O)")
list(FILTER _options EXCLUDE REGEX ">$") # the end of a generator expression: the sanitizers'
if(RESTLAB_SANITIZE)
  list(APPEND _options "-fsanitize=${RESTLAB_SANITIZE}")
endif()
list(JOIN _options " " _options)
string(STRIP "${_flags} ${_options}" _flags)

add_custom_target(rl_source_hash ALL
  COMMAND ${CMAKE_COMMAND}
    -D "SOURCE_DIR=${PROJECT_SOURCE_DIR}"
    -D "OUTPUT=${PROJECT_BINARY_DIR}/generated/source_hash.h"
    -D "COMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}"
    -D "FLAGS=${_flags}"
    -D "BUILD_TYPE=${CMAKE_BUILD_TYPE}"
    -P ${CMAKE_CURRENT_LIST_DIR}/source_hash.cmake
  BYPRODUCTS ${PROJECT_BINARY_DIR}/generated/source_hash.h
  COMMENT "Hashing the sources"
  VERBATIM)
# Whatever is compiled with rl_options may include the header.
add_dependencies(rl_options rl_source_hash)
