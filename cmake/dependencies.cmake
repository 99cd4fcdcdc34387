# Every library comes from the distribution; ./lab installs the packages of packages.txt.
find_package(Threads REQUIRED)
find_package(embree 3.13 REQUIRED)
find_package(TBB REQUIRED)
find_package(glm REQUIRED)
find_package(OpenEXR REQUIRED CONFIG)
find_package(TinyGLTF REQUIRED CONFIG)
find_package(tomlplusplus REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(fmt REQUIRED CONFIG)
find_package(Boost REQUIRED) # header-only Boost.Math distributions
find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
find_path(STB_INCLUDE_DIR stb_image.h PATH_SUFFIXES stb REQUIRED)
