#include "libprt/core/file.h"

#include "libprt/core/error.h"
#include "libprt/core/job.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

namespace prt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCheckPath = "check the path and its permissions";

[[noreturn]] void failWithErrno(const std::string& what, const fs::path& path) {
  throw FileError(what + ": " + std::strerror(errno), path.string(), kCheckPath);
}

/// An open file descriptor.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  bool valid() const { return fd_ >= 0; }
  int get() const { return fd_; }

 private:
  int fd_;
};

void readAll(int fd, const fs::path& path, std::span<std::byte> bytes, Job* job) {
  constexpr std::size_t kChunk = std::size_t(16) << 20;
  for (std::size_t done = 0; done < bytes.size();) {
    if (job) job->checkCancelled();
    const ssize_t got = ::read(fd, bytes.data() + done, std::min(kChunk, bytes.size() - done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) failWithErrno("cannot read it", path);
    if (got == 0) throw FileError("became shorter while it was read", path.string(), "try again");
    done += std::size_t(got);
  }
}

void writeAll(int fd, const fs::path& path, std::span<const std::byte> bytes) {
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t put = ::write(fd, bytes.data() + done, bytes.size() - done);
    if (put < 0 && errno == EINTR) continue;
    if (put < 0) failWithErrno("cannot write it", path);
    done += std::size_t(put);
  }
}

void sync(const fs::path& path, int flags, const fs::path& target) {
  const Descriptor file(path, flags);
  // Some file systems cannot sync folders and say so with EINVAL: nothing is lost by going on.
  if (!file.valid() || (::fsync(file.get()) != 0 && errno != EINVAL))
    failWithErrno("cannot write it", target);
}

fs::path temporaryBeside(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  fs::path name = ".";
  name += target.filename();
  name += ".tmp" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return target.parent_path() / name;
}

}  // namespace

std::vector<std::byte> readFile(const fs::path& path, std::size_t maxBytes, Job* job) {
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);  // never waits for the writer of a pipe
  if (!file.valid()) failWithErrno("cannot open it", path);
  struct stat info {};
  if (::fstat(file.get(), &info) != 0) failWithErrno("cannot open it", path);
  if (S_ISDIR(info.st_mode)) throw FileError("is a folder, not a file", path.string(), "give a file");
  if (!S_ISREG(info.st_mode)) throw FileError("is not a regular file", path.string(), "give a file");
  if (std::uint64_t(info.st_size) > maxBytes)
    throw FileError("is larger than the limit of " + std::to_string(maxBytes) + " bytes", path.string(),
                    "give a smaller file");
  std::vector<std::byte> bytes(std::size_t(info.st_size));
  readAll(file.get(), path, bytes, job);
  return bytes;
}

AtomicFile::AtomicFile(const fs::path& target) : target_(target) {
  std::error_code ignored;
  if (fs::is_symlink(target_, ignored)) target_ = fs::weakly_canonical(target_, ignored);
  if (target_.filename().empty()) throw FileError("is not a file name", target.string(), "give a file");
  const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    throw FileError("its folder does not exist", target.string(),
                    "make the folder " + folder.string() + " first");
  if (fs::exists(target_, ignored) && !fs::is_regular_file(target_, ignored))
    throw FileError("is not a regular file", target.string(), "choose another name");
  temporary_ = temporaryBeside(target_);
  const Descriptor file(temporary_, O_WRONLY | O_CREAT | O_EXCL);
  if (!file.valid()) failWithErrno("cannot write it", target);
  struct stat info {};
  if (::stat(target_.c_str(), &info) == 0) ::fchmod(file.get(), info.st_mode & 07777);
}

AtomicFile::~AtomicFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::commit() {
  sync(temporary_, O_RDONLY, target_);
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) failWithErrno("cannot write it", target_);
  temporary_.clear();
  sync(target_.has_parent_path() ? target_.parent_path() : fs::path("."), O_RDONLY | O_DIRECTORY, target_);
}

void writeFile(const fs::path& path, std::span<const std::byte> bytes) {
  AtomicFile file(path);
  {
    const Descriptor out(file.path(), O_WRONLY | O_TRUNC);
    if (!out.valid()) failWithErrno("cannot write it", path);
    writeAll(out.get(), path, bytes);
  }
  file.commit();
}

void writeFile(const fs::path& path, std::string_view text) {
  writeFile(path, std::as_bytes(std::span(text)));
}

}  // namespace prt
