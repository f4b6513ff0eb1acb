// prt verify: checks every checksum of a project.

#include "app/cli/progress_bar.h"
#include "app/cli/session.h"
#include "libprt/project/project_file.h"

#include <fmt/format.h>

namespace prt::cli {
namespace {

void verify(Session& session, const std::string& file) {
  const ProjectFile::Verified v = ProjectFile::verify(file, session.job());
  session.say(fmt::format("{} is sound: {} products, {} arrays, {} chunks, {} checked", file, v.products,
                          v.arrays, v.chunks, byteCount(double(v.bytes))));
  session.result({{"file", file},
                  {"sound", true},
                  {"products", v.products},
                  {"arrays", v.arrays},
                  {"chunks", v.chunks},
                  {"bytes", v.bytes}});
}

}  // namespace

void addVerify(CLI::App& app, Action& action) {
  auto file = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("verify", "Check every checksum of a project");
  command->add_option("PROJECT", *file, "Project (.prt)")->required();
  command->footer("Example:\n  prt verify bunny.prt");
  command->callback([file, &action] { action = [file](Session& s) { verify(s, *file); }; });
}

}  // namespace prt::cli
