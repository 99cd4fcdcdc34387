# Every library comes from the distribution; ./lab installs the packages of packages.txt, which has the versions.
include(libraries)
set(CMAKE_FIND_PACKAGE_SORT_ORDER NATURAL) # of several versions side by side the newest
set(CMAKE_FIND_PACKAGE_SORT_DIRECTION DEC)

rl_need_compiler()
find_package(Threads REQUIRED)
rl_need_library(Vulkan libvulkan-dev)
rl_need_library(embree libembree-dev BELOW 5 CONFIG)
rl_need_library(TBB libtbb-dev CONFIG)
rl_need_library(glm libglm-dev CONFIG)
rl_need_library(OpenEXR libopenexr-dev CONFIG)
rl_need_library(TinyGLTF libtinygltf-dev CONFIG)
rl_need_library(draco libdraco-dev CONFIG)
rl_need_library(meshoptimizer libmeshoptimizer-dev CONFIG)
rl_need_library(tomlplusplus libtomlplusplus-dev CONFIG)
rl_need_library(CLI11 libcli11-dev CONFIG)
rl_need_library(nlohmann_json nlohmann-json3-dev CONFIG)
rl_need_library(fmt libfmt-dev CONFIG)
rl_need_library(Boost libboost-dev CONFIG) # header-only Boost.Math distributions
rl_need_library(pugixml libpugixml-dev CONFIG)
rl_need_library(ZLIB zlib1g-dev)
rl_need_library(LibArchive libarchive-dev)
rl_need_library(OpenSSL libssl-dev COMPONENTS Crypto)
# The package files of glslang end the configuring where these two are missing.
rl_need_program(GLSLANG_VALIDATOR glslang-tools glslangValidator)
rl_need_program(SPIRV_VAL spirv-tools spirv-val)
if(GLSLANG_VALIDATOR AND SPIRV_VAL)
  rl_need_library(glslang glslang-dev CONFIG)
  rl_need_library(SPIRV-Tools-opt spirv-tools CONFIG)
endif()
rl_need_file(XXHASH_INCLUDE_DIR xxhash.h libxxhash-dev)
rl_need_file(STB_INCLUDE_DIR stb_image.h libstb-dev PATH_SUFFIXES stb)
rl_need_file(SPNG_INCLUDE_DIR spng.h libspng-dev)
rl_need_archive(SPNG_LIBRARY spng libspng-dev)
rl_need_file(TURBOJPEG_INCLUDE_DIR turbojpeg.h libturbojpeg0-dev)
rl_need_archive(TURBOJPEG_LIBRARY turbojpeg libturbojpeg0-dev)
if(RESTLAB_TESTS)
  rl_need_library(GTest libgtest-dev)
  rl_need_program(RL_PATCH patch patch)
  rl_need_program(RESTLAB_CLANGXX clang-16 clang++-16 clang++-19 clang++-18 clang++-17 clang++) # tests/lint
endif()
rl_stop_for_libraries()

# core/backend/embree.h is the one file that asks.
string(REGEX MATCH "^[0-9]+" RESTLAB_EMBREE_MAJOR "${embree_VERSION}")
target_compile_definitions(rl_options INTERFACE RESTLAB_EMBREE_MAJOR=${RESTLAB_EMBREE_MAJOR})
# Neither Debian 12 nor 13 packages it: where it is installed there is the denoiser oidn. 2.3 brought its quality "fast".
find_package(OpenImageDenoise 2.3 QUIET CONFIG)
