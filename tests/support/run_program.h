#pragma once
// Runs a program of this build as a user would, and looks at what it prints and returns.

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace prt::test {

struct ProgramResult {
  int status = -1;  ///< exit status; 128 + signal when it was killed
  std::string out;
  std::string err;

  /// Lines on stderr.
  int errorLines() const { return int(std::count(err.begin(), err.end(), '\n')); }
};

/// A program that may still be running.
class Program {
 public:
  /// `arguments[0]` is a program of this build ("prt") or an absolute path.
  explicit Program(const std::vector<std::string>& arguments, const std::filesystem::path& folder = ".") {
    const std::string stem = (std::filesystem::temp_directory_path() /
                              ("prt-run-" + std::to_string(::getpid()) + "-" + std::to_string(counter()++)))
                                 .string();
    out_ = stem + ".out";
    err_ = stem + ".err";
    const std::filesystem::path bin = std::filesystem::read_symlink("/proc/self/exe").parent_path();
    std::vector<std::string> words = arguments;
    if (words[0][0] != '/') words[0] = (bin / words[0]).string();
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    pid_ = ::fork();
    if (pid_ != 0) return;
    redirect(out_, STDOUT_FILENO);
    redirect(err_, STDERR_FILENO);
    if (::chdir(folder.c_str()) == 0) ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ~Program() {
    if (pid_ > 0) ::kill(pid_, SIGKILL), ::waitpid(pid_, nullptr, 0);
    std::error_code ignored;
    std::filesystem::remove(out_, ignored);
    std::filesystem::remove(err_, ignored);
  }
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  void send(int signal) {
    if (pid_ > 0) ::kill(pid_, signal);  // kill(-1) would reach every process there is
  }
  bool running() {
    int status = 0;
    if (pid_ > 0 && ::waitpid(pid_, &status, WNOHANG) == pid_) ended(status);
    return pid_ > 0;
  }
  /// Waits for the end.
  ProgramResult wait() {
    int status = 0;
    if (pid_ > 0) {
      ::waitpid(pid_, &status, 0);
      ended(status);
    }
    return {status_, text(out_), text(err_)};
  }

 private:
  static int& counter() {
    static int value = 0;
    return value;
  }
  static void redirect(const std::string& file, int descriptor) {
    const int opened = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    ::dup2(opened, descriptor);
    ::close(opened);
  }
  static std::string text(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void ended(int status) {
    pid_ = -1;
    status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }

  pid_t pid_ = -1;
  int status_ = -1;
  std::string out_, err_;
};

inline ProgramResult run(const std::vector<std::string>& arguments,
                         const std::filesystem::path& folder = ".") {
  return Program(arguments, folder).wait();
}

}  // namespace prt::test
