# rl_glsl: kernels as GLSL and their compilation.
add_library(rl_glsl STATIC
  ${CMAKE_CURRENT_LIST_DIR}/glsl_compiler.cpp
  ${CMAKE_CURRENT_LIST_DIR}/spirv_fold.cpp
  ${CMAKE_CURRENT_LIST_DIR}/glsl_preamble.cpp
)
if(RESTLAB_SANITIZE MATCHES "undefined")
  # The distribution builds glslang without the type information that this check reads.
  set_source_files_properties(${CMAKE_CURRENT_LIST_DIR}/glsl_compiler.cpp PROPERTIES COMPILE_OPTIONS
                              -fno-sanitize=vptr)
endif()
target_link_libraries(rl_glsl PUBLIC rl_options glm::glm fmt::fmt
                      PRIVATE glslang::glslang glslang::SPIRV glslang::glslang-default-resource-limits
                              SPIRV-Tools-opt)
