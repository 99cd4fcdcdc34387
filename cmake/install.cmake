# cmake --install: the program, its suites, scenes, pages and documents, and librestlab.so with the headers of
# Session and a CMake package. Nothing of it knows where it lies, so that the tree may be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

# All that is installed; what other folders install joins here.
add_custom_target(rl_installed)
foreach(part IN ITEMS restlab rl_shared rl_python)
  if(TARGET ${part})
    add_dependencies(rl_installed ${part})
  endif()
endforeach()

install(TARGETS restlab RUNTIME)
install(DIRECTORY experiments/suites experiments/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/restlab)
# Documents, and what they link to, as they lie here: a test follows every link.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md LICENSE CITATION.cff TYPE DOC)
install(DIRECTORY docs TYPE DOC)
install(DIRECTORY experiments/example DESTINATION ${CMAKE_INSTALL_DOCDIR}/experiments)
foreach(file IN ITEMS core/caches/README.md core/radiance_cache/README.md core/dialect/lanes.h tests/README.md
                      experiments/python/restlab.pyi)
  cmake_path(GET file PARENT_PATH folder)
  install(FILES ${file} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()
# Pages of the manual and the completion of bash: the program itself writes them.
install(CODE "set(data \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_DATADIR}\")
  set(restlab \"$<TARGET_FILE:restlab>\")" )
install(CODE [[
  execute_process(COMMAND "${restlab}" list man -o "${data}/man/man1" COMMAND_ERROR_IS_FATAL ANY)
  set(completion "${data}/bash-completion/completions/restlab")
  file(WRITE "${completion}" "")
  execute_process(COMMAND "${restlab}" list completion OUTPUT_FILE "${completion}" COMMAND_ERROR_IS_FATAL ANY)
  message(STATUS "Installing: ${data}/man/man1, ${completion}")]])

if(TARGET rl_shared)
  # core/frame/session.h, CompiledScene and Error, and what they include: a test compiles each alone.
  set(RL_PUBLIC_HEADERS
    core/backend/kernel_choice.h
    core/base/error.h
    core/dialect/dialect.h
    core/dialect/features.h
    core/dialect/types.h
    core/frame/drawn_lights.h
    core/frame/feature_names.h
    core/frame/integrator.h
    core/frame/part.h
    core/frame/schema.h
    core/frame/session.h
    core/frame/transport_settings.h
    core/image/image.h
    core/scene/closure_table/closure_table.h
    core/scene/compiled/bvh.h
    core/scene/compiled/compiled_scene.h
    core/scene/scene.h)
  set(includes ${CMAKE_INSTALL_INCLUDEDIR}/restlab)
  foreach(header IN LISTS RL_PUBLIC_HEADERS)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${header} DESTINATION ${includes}/${folder})
  endforeach()
  foreach(header IN ITEMS closures/list.h shapes/list.h)
    cmake_path(GET header PARENT_PATH folder)
    install(FILES ${RL_GENERATED_DIR}/${header} DESTINATION ${includes}/${folder})
  endforeach()
  target_include_directories(rl_shared INTERFACE $<INSTALL_INTERFACE:${includes}>)
  target_compile_features(rl_shared INTERFACE cxx_std_20)
  install(TARGETS rl_shared EXPORT restlab LIBRARY)
  set(package ${CMAKE_INSTALL_LIBDIR}/cmake/restlab)
  install(EXPORT restlab NAMESPACE restlab:: FILE restlabTargets.cmake DESTINATION ${package})
  file(CONFIGURE OUTPUT restlabConfig.cmake @ONLY CONTENT [[# find_package(restlab): the target restlab::restlab, librestlab.so.
include(CMakeFindDependencyMacro)
find_dependency(glm CONFIG) # in the headers
include(${CMAKE_CURRENT_LIST_DIR}/restlabTargets.cmake)
]])
  write_basic_package_version_file(restlabConfigVersion.cmake COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/restlabConfig.cmake ${PROJECT_BINARY_DIR}/restlabConfigVersion.cmake
          DESTINATION ${package})
endif()
