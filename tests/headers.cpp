// Nothing: a target must have a source. tests/CMakeLists.txt says which headers it precompiles.
