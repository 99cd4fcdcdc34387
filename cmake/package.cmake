# cpack -G DEB: a package of what cmake --install copies, for the Debian that it was built on.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME restlab)
set(CPACK_PACKAGE_VENDOR "The restlab maintainers")
set(CPACK_PACKAGE_CONTACT "The restlab maintainers <maintainers@restlab.invalid>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "measures ReSTIR-style path tracing against converged references")
set(CPACK_PACKAGE_DESCRIPTION "Renders scenes by path tracing and by resampling (ReSTIR DI, GI and PT), and measures
time, error and bias of each method against a converged reference, with intervals. Holds the program, its suites,
librestlab.so and a CMake package for programs that embed a session.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}) # librestlab.so is in the package itself
# Kernels are compiled for a scene by the compiler of the build, with these headers; without them built-in ones run.
# mesa-vulkan-drivers has lavapipe, a Vulkan device where there is no GPU.
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, libembree-dev, libglm-dev, mesa-vulkan-drivers")
if(TARGET rl_python)
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS python3-numpy)
endif()
include(CPack)
