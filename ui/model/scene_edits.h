#pragma once
// Edits of the list of objects, as functions from recipe to recipe: what the scene dock does, without a
// window. Indices must be those of objects.

#include "libprt/mesh/mesh.h"
#include "libprt/project/recipe.h"

#include <string>

namespace prt::ui {

/// A name for a new object: that of the mesh ("chair.obj", "builtin:vase"), with a number if it is taken.
std::string freeObjectName(const Recipe& recipe, const std::string& wanted);
/// The name of a mesh as people call it: file stem, or what follows "builtin:".
std::string meshName(const std::string& path);

/// Appends an object with this mesh, file relative to the recipe or builtin:NAME.
Recipe withObject(Recipe recipe, const std::string& path);
Recipe withoutObject(Recipe recipe, int object);
/// A copy right behind the object, moved aside by `aside` along x so that both can be seen.
Recipe withDuplicate(Recipe recipe, int object, float aside);

/// Bounds of a mesh under a transform, exact.
Box3 boundsOf(const TriMesh& mesh, const Mat4& transform);

/// Moved up or down until the lowest point lies at this height.
Recipe restingOn(Recipe recipe, int object, const TriMesh& mesh, float height);
/// Moved sideways until the middle of its bounds stands on the vertical axis.
Recipe centred(Recipe recipe, int object, const TriMesh& mesh);
/// How large the transform makes things: the cube root of what it does to a volume.
float sizeOf(const TransformRecipe& transform);
/// Scaled to that size, proportions and mirroring kept. Sizes that are not above 0 change nothing.
Recipe resized(Recipe recipe, int object, float size);

/// The object that the ground switch made, or any that has the ground as its mesh; -1 when there is none.
int groundObject(const Recipe& recipe);
/// Height of that ground; 0 when there is none.
float groundHeight(const Recipe& recipe);
/// Adds a ground plane under the scene, wide enough for its shadows.
Recipe withGround(Recipe recipe, const Box3& scene);

}  // namespace prt::ui
