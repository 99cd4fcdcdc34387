# rl_embed_dialect: writes <output> when it is built, which registers the tables of
# core/backend/dialect_sources.h. After the last rl_add_kernel.
function(rl_embed_dialect output)
  set(patterns "")
  foreach(folder IN ITEMS core/dialect core/geometry core/shading core/transport core/gbuffer core/raster core/bench core/resampling core/path_sample core/reuse core/caches core/radiance_cache core/temporal_gradients integrators denoise)
    list(APPEND patterns ${PROJECT_SOURCE_DIR}/${folder}/*.glsl ${PROJECT_SOURCE_DIR}/${folder}/*.h)
  endforeach()
  list(APPEND patterns ${PROJECT_SOURCE_DIR}/core/backend/*.glsl) # of devices alone
  foreach(file IN ITEMS cpu_kernel.inl cpu_trace.inl cpu_kernel.h embree.h trace_callbacks.h) # of units alone
    list(APPEND patterns ${PROJECT_SOURCE_DIR}/core/backend/${file})
  endforeach()
  file(GLOB_RECURSE files CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR} ${patterns})
  list(SORT files)
  list(TRANSFORM files PREPEND ${PROJECT_SOURCE_DIR}/ OUTPUT_VARIABLE paths)
  get_property(kernels GLOBAL PROPERTY RL_KERNEL_ROWS)
  list(JOIN files "," files)
  set(generated ${RL_CLOSURE_SOURCES} ${RL_SHAPE_SOURCES})
  list(TRANSFORM generated PREPEND ${RL_GENERATED_DIR}/ OUTPUT_VARIABLE generated_paths)
  list(JOIN generated "," generated)
  list(JOIN kernels "," kernels)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D SOURCE_DIR=${PROJECT_SOURCE_DIR} -D GENERATED_DIR=${RL_GENERATED_DIR}
      -D OUTPUT=${output} -D "FILES=${files}" -D "GENERATED=${generated}" -D "KERNELS=${kernels}"
      -P ${PROJECT_SOURCE_DIR}/cmake/embed_sources.cmake
    DEPENDS ${paths} ${generated_paths} ${PROJECT_SOURCE_DIR}/cmake/embed_sources.cmake
    COMMENT "Embedding the dialect" VERBATIM)
endfunction()
