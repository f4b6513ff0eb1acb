// Build tool: writes a C++ file that holds every shader with its #include lines resolved.
//   prt_embed_shaders OUT.cpp SHADER_DIR NAME...
// Each piece is preceded by "#line LINE FILE", where FILE is the number of the file in a table that is
// written beside the text: that is how a driver's message finds its way back to a file and a line.

#include <algorithm>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Flattened {
  std::string text;
  std::vector<std::string> files;
};

// Appends `name`, following its includes; a file is taken once, so includes need no guards.
void append(const std::string& folder, const std::string& name, Flattened& out) {
  if (std::find(out.files.begin(), out.files.end(), name) != out.files.end()) return;
  const std::size_t number = out.files.size();
  out.files.push_back(name);
  std::ifstream file(folder + "/" + name);
  if (!file) throw std::runtime_error(folder + "/" + name + ": cannot be read");

  const auto place = [&](int line) {
    return "#line " + std::to_string(line) + " " + std::to_string(number) + "\n";
  };
  if (number > 0) out.text += place(1);
  int lineNumber = 0;
  for (std::string line; std::getline(file, line);) {
    ++lineNumber;
    constexpr std::string_view kInclude = "#include \"";
    if (line.starts_with(kInclude)) {
      append(folder, line.substr(kInclude.size(), line.rfind('"') - kInclude.size()), out);
      out.text += place(lineNumber + 1);
    } else {
      out.text += line + "\n";
      if (line.starts_with("#version")) out.text += place(lineNumber + 1);
    }
  }
}

void write(std::ostream& out, const std::string& name, const Flattened& shader) {
  out << "  {\"" << name << "\", {";
  for (const std::string& file : shader.files) out << '"' << file << "\", ";
  out << "},\nR\"glsl(" << shader.text << ")glsl\"},\n";
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 4) throw std::runtime_error("usage: prt_embed_shaders OUT.cpp SHADER_DIR NAME...");
  std::ofstream out(argv[1]);
  out << "// Made from shaders/ by prt_embed_shaders.\n#include \"libprt/gl/program.h\"\n\n"
         "namespace prt::gl {\n\nconst std::vector<ShaderSource>& embeddedShaders() {\n"
         "  static const std::vector<ShaderSource> shaders{\n";
  for (int i = 3; i < argc; ++i) {
    Flattened shader;
    append(argv[2], argv[i], shader);
    write(out, argv[i], shader);
  }
  out << "  };\n  return shaders;\n}\n\n}  // namespace prt::gl\n";
  if (!out.flush()) throw std::runtime_error(std::string(argv[1]) + ": cannot be written");
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
