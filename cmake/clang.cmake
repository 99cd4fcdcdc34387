# Toolchain of the preset fuzz: the clang++ that ./lab test installs, whichever version the system has.
find_program(RESTLAB_CLANGXX NAMES clang++-16 clang++-19 clang++-18 clang++-17 clang++)
if(NOT RESTLAB_CLANGXX)
  message(FATAL_ERROR "missing program: clang++ 16 to 19 (package clang-16, clang-19, clang-18 or clang-17)")
endif()
set(CMAKE_CXX_COMPILER ${RESTLAB_CLANGXX})
