option(RESTLAB_TESTS "Build the tests" ON)
option(RESTLAB_TOGETHER "Compile several sources at once where that is faster" ON)
option(RESTLAB_WERROR "Warnings of our own code are errors" ON)
set(RESTLAB_SANITIZE "" CACHE STRING "Comma-separated -fsanitize= list")
option(RESTLAB_SANITIZE_KERNELS "Sanitize kernels, too: an hour more to compile" OFF)
option(RESTLAB_FUZZ "Build the libFuzzer targets of tests/fuzz, with clang, instead of the other tests" OFF)
if(RESTLAB_FUZZ AND NOT CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  message(FATAL_ERROR "RESTLAB_FUZZ takes libFuzzer, which only clang has: CMAKE_CXX_COMPILER is "
                      "${CMAKE_CXX_COMPILER}; the preset 'fuzz' finds a clang++")
endif()

add_library(rl_options INTERFACE)
target_include_directories(rl_options INTERFACE ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/generated)
target_compile_options(rl_options INTERFACE -Wall -Wextra -Wshadow -Wno-unused-function)
# GCC 12 reports std::string operations as overlapping copies that cannot be (its bug 105651).
target_compile_options(rl_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
# GCC 13 and 14 take a function's result for a part of a temporary that names it: find(scene, "name").
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
  target_compile_options(rl_options INTERFACE -Wno-dangling-reference)
endif()
if(RESTLAB_SANITIZE)
  # GCC 12 takes std::regex for uninitialised where a sanitizer has added its branches.
  target_compile_options(rl_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()
if(RESTLAB_WERROR)
  target_compile_options(rl_options INTERFACE -Werror)
endif()
# Everything may become part of a shared library (librestlab, the Python module); its own functions are
# still called and inlined as in a program.
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
target_compile_options(rl_options INTERFACE $<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>)
# Same seed, same image: no contraction, no fast-math; errno and traps are never read.
target_compile_options(rl_options INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math)
if(RESTLAB_SANITIZE)
  # A target with RL_NOT_SANITIZED is left out.
  set(sanitized $<NOT:$<BOOL:$<TARGET_PROPERTY:RL_NOT_SANITIZED>>>)
  target_compile_options(rl_options INTERFACE
    "$<${sanitized}:-fsanitize=${RESTLAB_SANITIZE};-fno-omit-frame-pointer;-fno-sanitize-recover=all>")
  target_link_options(rl_options INTERFACE -fsanitize=${RESTLAB_SANITIZE})
endif()
string(REGEX MATCH "thread" RESTLAB_TSAN "${RESTLAB_SANITIZE}")
if(RESTLAB_TSAN)
  # The distribution's TBB is not annotated: the CPU backend runs its tiles on std::jthread instead.
  target_compile_definitions(rl_options INTERFACE RESTLAB_JTHREAD_TILES=1)
  # Nor does it know the fences between handlers of Boost.Asio, which our one thread does not need.
  target_compile_definitions(rl_options INTERFACE BOOST_ASIO_DISABLE_FENCED_BLOCK=1)
endif()

# rl_precompile(<target> [header...]): headers that nearly every file of a target includes are
# compiled once, which is a quarter of its compile time. tests/lint compiles each of our headers
# alone, so that none comes to rely on this. GCC takes inlined parts of a precompiled <string> for
# our own code and warns of its bug 105651: only GCC 12 was seen to be quiet here.
function(rl_precompile target)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_GREATER_EQUAL 13)
    return()
  endif()
  target_precompile_headers(${target} PRIVATE
    <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span>
    <string> <utility> <variant> <vector> <fmt/format.h> <glm/glm.hpp> ${ARGN})
  # For ccache.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
endfunction()

# rl_precompile_as(<target> <other>): a target with the options of another uses its precompiled header.
function(rl_precompile_as target other)
  get_target_property(headers ${other} PRECOMPILE_HEADERS)
  if(headers)
    target_precompile_headers(${target} REUSE_FROM ${other})
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>)
  endif()
endfunction()

# rl_compile_lightly(<target>): what parses, prints and serves is as fast with less optimisation, and
# takes a third less to compile. Sources that loop over pixels keep -O3.
function(rl_compile_lightly target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "BUT")
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  if(arg_BUT)
    set_property(SOURCE ${arg_BUT} APPEND PROPERTY COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
    # GCC 12 crashes where a header was precompiled for another optimisation.
    set_property(SOURCE ${arg_BUT} PROPERTY SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# rl_compile_together(<target> <size> [folder...]): compiles up to <size> sources at once, or all of each
# folder. Code of libraries that are headers (CLI11, nlohmann_json, GoogleTest) is then generated once and
# not in each object: that was most of the compile time. Names without linkage must differ within a target.
function(rl_compile_together target size)
  if(NOT RESTLAB_TOGETHER)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
  if(ARGN)
    set_target_properties(${target} PROPERTIES UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    foreach(folder IN LISTS ARGN)
      set(group ${sources})
      list(FILTER group INCLUDE REGEX "(^|/)${folder}/[^/]*$")
      set_property(SOURCE ${group} PROPERTY UNITY_GROUP ${folder})
    endforeach()
  endif()
endfunction()

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # Without CCACHE_SLOPPINESS ccache keeps nothing that has a precompiled header. CCACHE_DEPEND
  # compares files, not preprocessed text: a precompiled header holds hashes of its files. After a
  # change of a comment the text is the same, the hash is not, and '#pragma once' reads a file twice.
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env CCACHE_DEPEND=1 CCACHE_SLOPPINESS=pch_defines,time_macros
      ${CCACHE_PROGRAM})
endif()
