#pragma once
// OpenGL 4.5 without a window (EGL). An engine has its own context: nothing here is of interest to it.

#include <string>

/// Makes a context current that lasts until the program ends. Throws std::runtime_error when there is none.
void makeHeadlessContext();

/// Compiles and links; `prelude` follows the #version line of both. Throws std::runtime_error with the log.
unsigned makeProgram(const std::string& vertexFile, const std::string& fragmentFile,
                     const std::string& prelude);
