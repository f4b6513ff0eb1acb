#pragma once
// What the scene dock does to the document: every call is one named step of undo.

#include "libprt/mesh/defect_list.h"
#include "libprt/mesh/mesh.h"
#include "libprt/project/products.h"
#include "libprt/project/recipe.h"

#include <QObject>
#include <QStringList>

#include <memory>

namespace prt::ui {

class Session;

/// The mesh of an object as it was last read, and what was found in its file.
struct ObjectMesh {
  std::shared_ptr<const MeshProduct> product;
  std::size_t index = 0;  ///< in the product

  explicit operator bool() const { return product != nullptr; }
  const TriMesh& mesh() const { return *product->meshes[index]; }
  const std::vector<DefectLine>& defects() const { return product->defects[index]; }
};

class SceneEditor : public QObject {
  Q_OBJECT
 public:
  explicit SceneEditor(Session& session, QObject* parent = nullptr);

  /// Adds an object for each mesh file or builtin:NAME, and selects the last. Files are read first, behind
  /// the interface: when one cannot be, it is told in the scene dock and nothing is added.
  void add(const QStringList& meshes);
  /// Whether this can be added: a mesh by its ending.
  static bool isMesh(const QString& file);
  static QStringList builtinMeshes();

  bool canRemove(int object) const;  ///< a scene shows one object at least
  void remove(int object);
  void duplicate(int object);
  void rename(int object, const QString& name);
  bool visible(int object) const;
  /// One object stays visible at least.
  bool canHide(int object) const;
  void setVisible(int object, bool visible);
  void restOnGround(int object);
  void centre(int object);
  void resize(int object, double size);

  bool hasGround() const;
  void setGround(bool on);

  /// Nothing while it is not read yet.
  ObjectMesh meshOf(int object) const;
  /// Bounds of the object in the scene; empty while its mesh is not known.
  Box3 boundsOf(int object) const;

 private:
  const ObjectRecipe* objectAt(int object) const;
  QString documentPath(const QString& file) const;
  void edit(const QString& name, const Recipe& next);
  void append(const QStringList& paths);

  Session& session_;
};

}  // namespace prt::ui
