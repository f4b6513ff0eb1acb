# `cmake --install`: the library with its CMake package, and the programs.
