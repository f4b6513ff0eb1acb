#version 450 core
// M_p L at every frame of a surface: four invocations or so for each channel of a frame, eight functions each.
layout(local_size_x = 64) in;

// [frame][channel][function of the light][group]: eight functions of the result as half floats.
layout(std430, binding = 0) readonly buffer Matrices { uvec4 matrices[]; };
// [frame][3][group]: eight functions.
layout(std430, binding = 1) writeonly buffer Light { vec4 light[]; };

uniform vec3 source[100];  // the light
uniform int functions, groups, channels;  // of the light; of the result; of the matrices, 1 or 3
uniform int count;                        // invocations

void main() {
  int n = int(gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x + gl_GlobalInvocationID.x);
  if (n >= count) return;
  int group = n % groups, channel = n / groups % 3, frame = n / (3 * groups);
  int from = (frame * channels + (channels == 3 ? channel : 0)) * functions * groups + group;
  vec4 low = vec4(0.0), high = vec4(0.0);
  for (int k = 0; k < functions; ++k) {
    uvec4 halfs = matrices[from + k * groups];
    float arriving = source[k][channel];
    low += arriving * vec4(unpackHalf2x16(halfs.x), unpackHalf2x16(halfs.y));
    high += arriving * vec4(unpackHalf2x16(halfs.z), unpackHalf2x16(halfs.w));
  }
  light[2 * n] = low;
  light[2 * n + 1] = high;
}
