// Transferred radiance: three numbers per function, functions per sample. The buffer ends with a few
// numbers to spare, so that groups of four never reach past it.
const int kLightSlots = (3 * kFunctions + 3) / 4;
layout(std430, binding = 3) readonly buffer Radiance { float radiance[]; };
