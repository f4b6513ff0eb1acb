#include "libprt/project/recipe_table.h"

#include <nlohmann/json.hpp>

#include <type_traits>

namespace prt {
namespace {

/// One line of the table: the parameter and how to reach its value in a struct of type T.
template <class T>
struct Row {
  const char* name;
  FieldRef (*reach)(T&);
  ParameterType type;
  const char* unit;
  double low, high;
  std::vector<std::string> choices;
  const char* cost;
  const char* doc;
};

template <class Enum>
FieldRef choice(Enum& value) {
  return ChoiceRef{[&value] { return int(value); }, [&value](int index) { value = Enum(index); }};
}

/// A string that must be one of the names.
FieldRef namedChoice(std::string& value, const std::vector<std::string>& names) {
  return ChoiceRef{[&value, names] {
                     for (std::size_t i = 0; i < names.size(); ++i)
                       if (names[i] == value) return int(i);
                     return 0;
                   },
                   [&value, names](int index) { value = names[std::size_t(index)]; }};
}

constexpr double kFar = 1e9;                     // of positions; beyond, float has no millimetres left anyway
constexpr double kMaxSeed = 9007199254740992.0;  // 2^53: what JSON numbers carry exactly

const char* const kCostMesh = "rebakes everything";
const char* const kCostDirect = "rebakes transfer";
const char* const kCostBounces = "rebakes the bounces only";
const char* const kCostLight = "none: relights";

const std::vector<std::string> kMappings{"auto",    "latlong", "vcross", "hcross",
                                         "angular", "hstrip",  "vstrip"};
const std::vector<std::string> kMethods{"auto", "diffuse", "glossy"};
const std::vector<std::string> kWindows{"none", "hann", "lanczos", "fejer", "dering"};

const std::vector<Row<ObjectRecipe>> kObject{
    {"name",
     [](ObjectRecipe& o) -> FieldRef { return &o.name; },
     ParameterType::Text,
     "",
     0,
     0,
     {},
     "none",
     "Name of the object in lists and exports."},
    {"visible",
     [](ObjectRecipe& o) -> FieldRef { return &o.visible; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     kCostDirect,
     "Off, the object takes no part in scene, rays and pictures but keeps its settings."},
};

const std::vector<Row<MeshRecipe>> kMesh{
    {"path",
     [](MeshRecipe& m) -> FieldRef { return &m.path; },
     ParameterType::File,
     "",
     0,
     0,
     {},
     kCostMesh,
     "OBJ, PLY, OFF, STL, glTF or GLB file relative to the recipe, or builtin:NAME."},
    {"detail",
     [](MeshRecipe& m) -> FieldRef { return &m.detail; },
     ParameterType::Number,
     "times",
     0.05,
     16,
     {},
     kCostMesh,
     "Resolution of a built-in mesh relative to its usual one; vertices grow with the square."},
    {"seed",
     [](MeshRecipe& m) -> FieldRef { return &m.seed; },
     ParameterType::Integer,
     "",
     0,
     4294967295.0,
     {},
     kCostMesh,
     "Seed of a built-in mesh that is made from noise (rock)."},
    {"weld",
     [](MeshRecipe& m) -> FieldRef { return &m.weld; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     kCostMesh,
     "Merge vertices at exactly one position; off, the file's vertices are kept as they are."},
    {"orientation",
     [](MeshRecipe& m) -> FieldRef { return choice(m.orientation); },
     ParameterType::Choice,
     "",
     0,
     0,
     {"keep", "consistent", "outward"},
     kCostMesh,
     "Which way faces look: as in the file, neighbours alike, or alike and closed parts outwards."},
    {"splitNonManifold",
     [](MeshRecipe& m) -> FieldRef { return &m.splitNonManifold; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     kCostMesh,
     "Cut the surface where more than two faces meet in an edge."},
    {"keepNormals",
     [](MeshRecipe& m) -> FieldRef { return &m.keepNormals; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     kCostMesh,
     "Use the normals in the file where it has usable ones."},
    {"crease",
     [](MeshRecipe& m) -> FieldRef { return &m.crease; },
     ParameterType::Number,
     "degrees",
     0,
     180,
     {},
     kCostMesh,
     "Edges sharper than this stay sharp where normals are computed; 180 smooths everything."},
};

const std::vector<Row<TransformRecipe>> kTransform{
    {"translate",
     [](TransformRecipe& t) -> FieldRef { return &t.translate; },
     ParameterType::Vector,
     "scene units",
     -kFar,
     kFar,
     {},
     kCostMesh,
     "Moves the object, after scaling and turning it."},
    {"rotate",
     [](TransformRecipe& t) -> FieldRef { return &t.rotate; },
     ParameterType::Vector,
     "degrees",
     -kFar,
     kFar,
     {},
     kCostMesh,
     "Turns about the x, then the y, then the z axis."},
    {"scale",
     [](TransformRecipe& t) -> FieldRef { return &t.scale; },
     ParameterType::Vector,
     "times",
     -kFar,
     kFar,
     {},
     kCostMesh,
     "Scales along the axes; negative values mirror, zero is an error."},
};

const std::vector<Row<Material>> kMaterial{
    {"name",
     [](Material& m) -> FieldRef { return &m.name; },
     ParameterType::Text,
     "",
     0,
     0,
     {},
     "none",
     "Name of the material in lists."},
    {"model",
     [](Material& m) -> FieldRef { return choice(m.model); },
     ParameterType::Choice,
     "",
     0,
     0,
     {"lambert", "phong"},
     "rebakes transfer when it changes the form that is needed",
     "Reflection model: lambert, or phong = diffuse + normalised Phong lobe."},
    {"albedo",
     [](Material& m) -> FieldRef { return &m.albedo; },
     ParameterType::Color,
     "",
     0,
     1,
     {},
     kCostBounces,
     "Diffuse reflectance, linear Rec.709."},
    {"specular",
     [](Material& m) -> FieldRef { return &m.specular; },
     ParameterType::Color,
     "",
     0,
     1,
     {},
     kCostBounces,
     "Reflectance of the Phong lobe at normal incidence."},
    {"exponent",
     [](Material& m) -> FieldRef { return &m.exponent; },
     ParameterType::Number,
     "",
     1,
     10000,
     {},
     kCostLight,
     "Sharpness of the Phong lobe."},
    {"twoSided",
     [](Material& m) -> FieldRef { return &m.twoSided; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     kCostDirect,
     "Back faces reflect too; otherwise they only block light."},
};

const std::vector<Row<LightRecipe>> kLight{
    {"name",
     [](LightRecipe& l) -> FieldRef { return &l.name; },
     ParameterType::Text,
     "",
     0,
     0,
     {},
     "none",
     "Name of the light in lists."},
    {"kind",
     [](LightRecipe& l) -> FieldRef { return choice(l.kind); },
     ParameterType::Choice,
     "",
     0,
     0,
     {"environment", "circle", "directional", "constant"},
     kCostLight,
     "What shines: an image, a disc, a direction or a constant sky."},
    {"on",
     [](LightRecipe& l) -> FieldRef { return &l.on; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     kCostLight,
     "Off, the light does not shine but keeps its settings."},
    {"path",
     [](LightRecipe& l) -> FieldRef { return &l.path; },
     ParameterType::File,
     "",
     0,
     0,
     {},
     kCostLight,
     "Environment: EXR, HDR or PNG file relative to the recipe, or builtin:NAME."},
    {"mapping", [](LightRecipe& l) -> FieldRef { return namedChoice(l.mapping, kMappings); },
     ParameterType::Choice, "", 0, 0, kMappings, kCostLight,
     "Environment: layout of the image; auto judges by its shape."},
    {"sunAzimuth",
     [](LightRecipe& l) -> FieldRef { return &l.sunAzimuth; },
     ParameterType::Number,
     "degrees",
     -360,
     360,
     {},
     kCostLight,
     "builtin:clear-sky: where the sun stands, from -Z counter-clockwise seen from above; the light's "
     "rotation is added."},
    {"sunElevation",
     [](LightRecipe& l) -> FieldRef { return &l.sunElevation; },
     ParameterType::Number,
     "degrees",
     1,
     90,
     {},
     kCostLight,
     "builtin:clear-sky: height of the sun above the horizon; low suns are weaker and redder."},
    {"rotation",
     [](LightRecipe& l) -> FieldRef { return &l.rotation; },
     ParameterType::Number,
     "degrees",
     -kFar,
     kFar,
     {},
     kCostLight,
     "Turns the light about +Y, counter-clockwise seen from above."},
    {"intensity",
     [](LightRecipe& l) -> FieldRef { return &l.intensity; },
     ParameterType::Number,
     "times",
     0,
     1e6,
     {},
     kCostLight,
     "Factor on everything that this light sends."},
    {"direction",
     [](LightRecipe& l) -> FieldRef { return &l.direction; },
     ParameterType::Vector,
     "",
     -kFar,
     kFar,
     {},
     kCostLight,
     "Circle and directional: towards the light; any length but zero."},
    {"angle",
     [](LightRecipe& l) -> FieldRef { return &l.angle; },
     ParameterType::Number,
     "degrees",
     0.01,
     360,
     {},
     kCostLight,
     "Circle: how far across it is seen, edge to edge; the sun is 0.53."},
    {"radiance",
     [](LightRecipe& l) -> FieldRef { return &l.radiance; },
     ParameterType::Color,
     "",
     0,
     1e9,
     {},
     kCostLight,
     "Radiance of a circle or constant sky; for directional, irradiance on a surface that faces it."},
};

const std::vector<Row<CameraRecipe>> kCamera{
    {"name",
     [](CameraRecipe& c) -> FieldRef { return &c.name; },
     ParameterType::Text,
     "",
     0,
     0,
     {},
     "none",
     "Name that --camera takes."},
    {"eye",
     [](CameraRecipe& c) -> FieldRef { return &c.eye; },
     ParameterType::Vector,
     "scene units",
     -kFar,
     kFar,
     {},
     "none",
     "Where the camera is."},
    {"target",
     [](CameraRecipe& c) -> FieldRef { return &c.target; },
     ParameterType::Vector,
     "scene units",
     -kFar,
     kFar,
     {},
     "none",
     "What it looks at."},
    {"up",
     [](CameraRecipe& c) -> FieldRef { return &c.up; },
     ParameterType::Vector,
     "",
     -kFar,
     kFar,
     {},
     "none",
     "Direction that points up in the picture."},
    {"vfov_deg",
     [](CameraRecipe& c) -> FieldRef { return &c.verticalFov; },
     ParameterType::Number,
     "degrees",
     1,
     170,
     {},
     "none",
     "Vertical field of view, full angle."},
    {"orthographic",
     [](CameraRecipe& c) -> FieldRef { return &c.orthographic; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     "none",
     "Parallel rays: the picture is as high as the field of view is at the target."},
};

const std::vector<Row<TransferRecipe>> kTransfer{
    {"kind",
     [](TransferRecipe& t) -> FieldRef { return choice(t.kind); },
     ParameterType::Choice,
     "",
     0,
     0,
     {"auto", "none", "diffuse", "visibility", "matrix"},
     kCostDirect,
     "What is stored per sample; auto takes the cheapest form that holds all. Visibility holds no bounces, "
     "diffuse no highlights."},
    {"bands",
     [](TransferRecipe& t) -> FieldRef { return &t.bands; },
     ParameterType::Integer,
     "bands",
     1,
     10,
     {},
     "rebakes transfer; size grows with bands^2 (diffuse) to bands^4 (matrix)",
     "Spherical-harmonic bands; n bands have n^2 functions, 5 have 25."},
    {"rays",
     [](TransferRecipe& t) -> FieldRef { return &t.rays; },
     ParameterType::Integer,
     "rays per sample",
     16,
     1048576,
     {},
     "bake time grows in proportion; more rays extend what is there",
     "Rays traced from every sample."},
    {"bounces",
     [](TransferRecipe& t) -> FieldRef { return &t.bounces; },
     ParameterType::Integer,
     "bounces",
     0,
     64,
     {},
     kCostBounces,
     "Interreflections; 0 = shadows only."},
    {"shadows",
     [](TransferRecipe& t) -> FieldRef { return &t.shadows; },
     ParameterType::Boolean,
     "",
     0,
     0,
     {},
     kCostDirect,
     "Off, nothing blocks light and nothing is baked."},
    {"threshold",
     [](TransferRecipe& t) -> FieldRef { return &t.threshold; },
     ParameterType::Number,
     "",
     0,
     1,
     {},
     kCostBounces,
     "Bounces end early once one adds less than this fraction of the direct light."},
    {"storage",
     [](TransferRecipe& t) -> FieldRef { return choice(t.storage); },
     ParameterType::Choice,
     "",
     0,
     0,
     {"auto", "float", "half"},
     "converts what is baked",
     "Number format of the result; its error is printed."},
    {"seed",
     [](TransferRecipe& t) -> FieldRef { return &t.seed; },
     ParameterType::Integer,
     "",
     0,
     kMaxSeed,
     {},
     kCostDirect,
     "Seed of the ray directions; the same seed gives the same bits."},
};

const std::vector<Row<MethodRecipe>> kMethod{
    {"name", [](MethodRecipe& m) -> FieldRef { return namedChoice(m.name, kMethods); }, ParameterType::Choice,
     "", 0, 0, kMethods, kCostLight, "How pictures are made: auto takes what the materials ask for."},
    {"window", [](MethodRecipe& m) -> FieldRef { return namedChoice(m.window, kWindows); },
     ParameterType::Choice, "", 0, 0, kWindows, kCostLight,
     "Damps the light's upper bands against ringing; dering damps as little as leaves no negative light."},
};

/// The rows of one struct under the pattern path of its section.
template <class T>
void list(const std::vector<Row<T>>& rows, const std::string& section, std::vector<Parameter>& out) {
  T defaults{};
  for (const Row<T>& row : rows) {
    Parameter p{
        section + "." + row.name, row.type, row.unit, row.low, row.high, row.choices, {}, row.cost, row.doc};
    p.defaultText = fieldToJson(row.reach(defaults), p).dump();
    out.push_back(std::move(p));
  }
}

std::vector<Parameter> listParameters() {
  std::vector<Parameter> all;
  list(kObject, "objects[]", all);
  list(kMesh, "objects[].mesh", all);
  list(kTransform, "objects[].transform", all);
  list(kMaterial, "objects[].material", all);
  list(kLight, "lights[]", all);
  list(kCamera, "cameras[]", all);
  list(kTransfer, "transfer", all);
  list(kMethod, "method", all);
  return all;
}

/// Visits the fields of one struct; `next` is where its rows begin in parameters().
template <class T>
std::size_t visitRows(const std::vector<Row<T>>& rows, T& value, const std::string& section, std::size_t next,
                      const std::function<void(const FieldPlace&, const FieldRef&)>& visit) {
  for (const Row<T>& row : rows) visit({section, row.name, parameters()[next++]}, row.reach(value));
  return next;
}

std::string indexed(const char* array, std::size_t i) {
  return std::string(array) + "[" + std::to_string(i) + "]";
}

}  // namespace

const std::vector<Parameter>& parameters() {
  static const std::vector<Parameter> all = listParameters();
  return all;
}

void forEachField(Recipe& r, const std::function<void(const FieldPlace&, const FieldRef&)>& visit) {
  const std::size_t objectRows = kObject.size() + kMesh.size() + kTransform.size() + kMaterial.size();
  for (std::size_t i = 0; i < r.objects.size(); ++i) {
    const std::string section = indexed("objects", i);
    std::size_t next = visitRows(kObject, r.objects[i], section, 0, visit);
    next = visitRows(kMesh, r.objects[i].mesh, section + ".mesh", next, visit);
    next = visitRows(kTransform, r.objects[i].transform, section + ".transform", next, visit);
    visitRows(kMaterial, r.objects[i].material, section + ".material", next, visit);
  }
  const std::size_t lightRows = objectRows, cameraRows = lightRows + kLight.size();
  for (std::size_t i = 0; i < r.lights.size(); ++i)
    visitRows(kLight, r.lights[i], indexed("lights", i), lightRows, visit);
  for (std::size_t i = 0; i < r.cameras.size(); ++i)
    visitRows(kCamera, r.cameras[i], indexed("cameras", i), cameraRows, visit);
  const std::size_t next = visitRows(kTransfer, r.transfer, "transfer", cameraRows + kCamera.size(), visit);
  visitRows(kMethod, r.method, "method", next, visit);
}

std::vector<RecipeArray> recipeArrays(Recipe& r) {
  return {{"objects", r.objects.size(), [&r](std::size_t n) { r.objects.resize(n); }},
          {"lights", r.lights.size(), [&r](std::size_t n) { r.lights.resize(n); }},
          {"cameras", r.cameras.size(), [&r](std::size_t n) { r.cameras.resize(n); }}};
}

}  // namespace prt
