struct Material {
  vec4 albedo;    // w: 1 when back faces reflect too
  vec4 specular;  // w: which table of the responses, -1 when not glossy
  vec4 emission;
};
layout(std430, binding = 0) readonly buffer Materials { Material materials[]; };
