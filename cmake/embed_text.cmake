# rl_embed_text(<target> <name> HEADER <header> {FUNCTION <function> FILES <file>...}...)
# Adds generated/<name>.cpp to the target: for each FUNCTION a `std::string_view function()` of
# namespace restlab, declared in <header>, that returns the text of its files one after the other.
# Files are relative to the calling folder; the program holds them as they are when it is built.
function(rl_embed_text target name header_word header)
  if(NOT header_word STREQUAL "HEADER")
    message(FATAL_ERROR "usage: rl_embed_text(<target> <name> HEADER <header> FUNCTION <f> FILES ...)")
  endif()
  set(spec "")
  set(paths "")
  foreach(word IN LISTS ARGN)
    if(word MATCHES "^(FUNCTION|FILES)$")
      set(kind ${word})
    elseif(kind STREQUAL "FUNCTION")
      list(APPEND spec "function:${word}")
    else()
      set(path ${CMAKE_CURRENT_SOURCE_DIR}/${word})
      list(APPEND spec "file:${path}")
      list(APPEND paths ${path})
    endif()
  endforeach()
  list(JOIN spec "," spec)
  set(output ${RL_GENERATED_DIR}/${name}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_text_script.cmake)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${output} -D HEADER=${header} -D "SPEC=${spec}" -P ${script}
    DEPENDS ${paths} ${script}
    COMMENT "Embedding ${name}" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()
