// Ringing can take radiance below zero; nothing that is not a number reaches the picture.
vec3 sound(vec3 radiance) { return mix(vec3(0.0), min(radiance, vec3(3e38)), greaterThan(radiance, vec3(0.0))); }
