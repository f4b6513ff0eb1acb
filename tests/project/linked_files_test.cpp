#include "libprt/project/linked_files.h"

#include "libprt/core/error.h"
#include "libprt/project/project_file.h"
#include "tests/support/temporary_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace prt {
namespace {

namespace fs = std::filesystem;

struct LinkedFiles : testing::Test {
  LinkedFiles() {
    recipe.objects[0].mesh.path = "meshes/a.obj";
    recipe.objects.push_back(recipe.objects[0]);
    recipe.objects.push_back({});
    recipe.lights[0].path = "sky.hdr";
    write("meshes/a.obj", "mesh a");
    write("sky.hdr", "sky");
  }
  fs::path write(const std::string& name, const std::string& text) {
    const fs::path file = folder / name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
    return file;
  }
  std::vector<LinkedFile> look(ProductStore* store = nullptr) {
    return linkedFiles(recipe, folder.path(), store, job);
  }
  std::unique_ptr<ProjectFile> remembered() {
    auto project = ProjectFile::openForWork(folder / "p.prt");
    rememberSources(recipe, folder.path(), *project, job);
    return project;
  }

  test::TemporaryFolder folder;
  Recipe recipe;
  Job job;
};

TEST_F(LinkedFiles, AreListedOnceWithAllTheirPlaces) {
  const auto files = look();
  ASSERT_EQ(files.size(), 2u) << "built-in ones are no files";
  EXPECT_EQ(files[0].path, "meshes/a.obj");
  EXPECT_EQ(files[0].places, (std::vector<std::string>{"objects[0].mesh.path", "objects[1].mesh.path"}));
  EXPECT_EQ(files[0].state, LinkState::Present);
  EXPECT_EQ(files[1].places, (std::vector<std::string>{"lights[0].path"}));
  recipe.lights[0].kind = LightKind::Constant;
  EXPECT_EQ(look().size(), 1u) << "nobody reads the path of a constant light";
}

TEST_F(LinkedFiles, MissingAndChangedOnesAreTold) {
  const auto project = remembered();
  EXPECT_EQ(look(project.get())[0].state, LinkState::Present);
  write("meshes/a.obj", "another mesh");
  fs::remove(folder / "sky.hdr");
  const auto files = look(project.get());
  EXPECT_EQ(files[0].state, LinkState::Changed);
  EXPECT_EQ(files[1].state, LinkState::Missing);
  EXPECT_FALSE(files[1].hash.empty());
}

TEST_F(LinkedFiles, MovedOnesAreFoundByNameAndContents) {
  const auto project = remembered();
  fs::create_directories(folder / "new/deep/er");
  fs::rename(folder / "meshes/a.obj", folder / "new/deep/er/a.obj");
  fs::rename(folder / "sky.hdr", folder / "new/sky.hdr");
  write("new/a.obj", "another of that name");
  const auto found = findMoved(look(project.get()), folder / "new", job);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found.at("meshes/a.obj").file, folder / "new/deep/er/a.obj") << "contents count more than depth";
  EXPECT_TRUE(found.at("meshes/a.obj").sameContents);
  fs::remove(folder / "new/deep/er/a.obj");
  const auto other = findMoved(look(project.get()), folder / "new", job);
  EXPECT_FALSE(other.at("meshes/a.obj").sameContents);
  relink(recipe, "meshes/a.obj", "new/a.obj");
  EXPECT_EQ(recipe.objects[0].mesh.path, "new/a.obj");
  EXPECT_EQ(recipe.objects[1].mesh.path, "new/a.obj");
  EXPECT_EQ(recipe.lights[0].path, "sky.hdr");
}

TEST_F(LinkedFiles, PathsBecomeRelativeToWhereTheProjectIs) {
  recipe.lights[0].path = (folder / "sky.hdr").string();
  makePathsRelative(recipe, folder.path(), folder / "projects/one");
  EXPECT_EQ(recipe.lights[0].path, "../../sky.hdr");
  EXPECT_EQ(recipe.objects[0].mesh.path, "../../meshes/a.obj");
  EXPECT_EQ(recipe.objects[2].mesh.path, "builtin:vase");
  makePathsRelative(recipe, folder / "projects/one", "/");
  EXPECT_EQ("/" + recipe.lights[0].path, (folder / "sky.hdr").lexically_normal().string());
}

TEST_F(LinkedFiles, AreCollectedBesideTheProject) {
  recipe.objects[1].mesh.path = "others/a.obj";
  write("others/a.obj", "of the same name");
  recipe.objects[2].mesh.path = "scene.gltf";
  write("scene.gltf", R"({"buffers":[{"uri":"scene.bin"}]})");
  write("scene.bin", "bytes");
  collectFiles(recipe, folder.path(), folder / "moved/p_files", folder / "moved", job);
  EXPECT_EQ(recipe.objects[0].mesh.path, "p_files/a.obj");
  EXPECT_EQ(recipe.objects[1].mesh.path, "p_files/a-2.obj");
  EXPECT_EQ(recipe.lights[0].path, "p_files/sky.hdr");
  EXPECT_TRUE(fs::exists(folder / "moved/p_files/scene.bin"));
  for (const LinkedFile& each : linkedFiles(recipe, folder / "moved", nullptr, job))
    EXPECT_EQ(each.state, LinkState::Present) << each.path;
}

TEST_F(LinkedFiles, NothingIsCollectedWhenOneIsMissing) {
  fs::remove(folder / "sky.hdr");
  const Recipe before = recipe;
  EXPECT_THROW(collectFiles(recipe, folder.path(), folder / "c", folder.path(), job), FileError);
  EXPECT_EQ(recipe, before);
  EXPECT_FALSE(fs::exists(folder / "c"));
}

}  // namespace
}  // namespace prt
