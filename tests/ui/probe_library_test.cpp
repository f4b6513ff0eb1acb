#include "ui/model/probe_library.h"

#include "libprt/core/image_io.h"
#include "tests/ui/wait.h"

#include <gtest/gtest.h>

#include <QFile>
#include <QTemporaryDir>

#include <algorithm>

namespace prt::ui {
namespace {

using test::waitFor;

class ProbeLibraryTest : public testing::Test {
 protected:
  QString write(const char* name) {
    const QString path = folder.filePath(QLatin1String(name));
    Image image(32, 16, 3);
    std::fill(image.data.begin(), image.data.end(), 0.5f);
    writeImage(path.toStdString(), image);
    return path;
  }
  const Probe* find(const QString& path) const {
    const auto& all = library.probes();
    const auto found = std::find_if(all.begin(), all.end(), [&](const Probe& p) { return p.path == path; });
    return found == all.end() ? nullptr : &*found;
  }
  bool pictured() const {
    return std::all_of(library.probes().begin(), library.probes().end(),
                       [](const Probe& p) { return p.picture || !p.error.isEmpty(); });
  }

  QTemporaryDir folder;
  JobRunner jobs;
  ProbeLibrary library{jobs};
};

TEST_F(ProbeLibraryTest, BeginsWithTheBuiltInOnesAndReadsNothingUntilAsked) {
  ASSERT_EQ(library.probes().size(), 4u);
  EXPECT_TRUE(find(QStringLiteral("builtin:orientation")));
  EXPECT_TRUE(jobs.idle());
  library.wantPictures();
  ASSERT_TRUE(waitFor([&] { return pictured(); }));
  const auto picture = find(QStringLiteral("builtin:orientation"))->picture;
  ASSERT_TRUE(picture);
  EXPECT_EQ(picture->width, ProbeLibrary::kPictureWidth);
  const Rgb left = picture->rgb(picture->width / 8, picture->height / 2),
            middle = picture->rgb(picture->width * 3 / 7, picture->height * 5 / 8);
  EXPECT_GT(left.z, left.x) << "+Z at the border is blue, or -X cyan";
  EXPECT_GT(middle.x, middle.z) << "-Z in the middle is yellow";
}

TEST_F(ProbeLibraryTest, ListsTheProjectsAndRecentFilesOnceEach) {
  const QString a = write("a.exr"), b = write("b.exr");
  library.setProject({a, QStringLiteral("builtin:studio")});
  library.note(b);
  library.note(a);
  EXPECT_EQ(library.recent(), QStringList({a, b}));
  EXPECT_EQ(library.probes().size(), 6u);
  library.wantPictures();
  ASSERT_TRUE(waitFor([&] { return pictured(); }));
  EXPECT_TRUE(find(a)->picture);
  EXPECT_EQ(find(a)->name, QStringLiteral("a.exr"));
  const auto kept = find(b)->picture;
  library.note(a);
  ASSERT_TRUE(waitFor([&] { return pictured(); }));
  EXPECT_EQ(find(b)->picture, kept) << "made once";
}

TEST_F(ProbeLibraryTest, AFileThatCannotBeReadSaysSoAndOneThatIsGoneIsLeftOut) {
  const QString bad = folder.filePath(QStringLiteral("bad.hdr"));
  QFile file(bad);
  ASSERT_TRUE(file.open(QIODevice::WriteOnly));
  file.write("#?RADIANCE\nnonsense");
  file.close();
  library.setRecent({bad, folder.filePath(QStringLiteral("gone.hdr"))});
  EXPECT_EQ(library.probes().size(), 5u);
  library.wantPictures();
  ASSERT_TRUE(waitFor([&] { return pictured(); }));
  EXPECT_TRUE(find(bad)->error.contains(QStringLiteral("bad.hdr")));
}

TEST_F(ProbeLibraryTest, RemembersTheLastFew) {
  for (int i = 0; i < 12; ++i) library.note(QStringLiteral("/nowhere/%1.hdr").arg(i));
  EXPECT_EQ(library.recent().size(), ProbeLibrary::kRecent);
  EXPECT_EQ(library.recent().front(), QStringLiteral("/nowhere/11.hdr"));
  library.note(QStringLiteral("builtin:studio"));
  EXPECT_EQ(library.recent().front(), QStringLiteral("/nowhere/11.hdr")) << "built-in ones are always there";
}

}  // namespace
}  // namespace prt::ui
