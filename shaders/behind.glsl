layout(std430, binding = 4) readonly buffer Behind { uint behind[]; };  // sample on the back of each front one
const uint kNone = 0xffffffffu;
