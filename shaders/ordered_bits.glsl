// Floats handled as bits and compared as whole numbers, so that no device's way with denormal
// numbers or with the sign of zero can change a box.

// A whole number in the order of the floats with these bits; both zeros give 0.
int ordered(uint bits) {
  int whole = int(bits);
  return whole < 0 ? int(0x80000000u) - whole : whole;
}

// Where equal, the second one, as on the CPU: it matters for the sign of zero.
uint lower_of(uint a, uint b) {
  return ordered(a) < ordered(b) ? a : b;
}
uint upper_of(uint a, uint b) {
  return ordered(a) > ordered(b) ? a : b;
}
uvec3 lower_of(uvec3 a, uvec3 b) {
  return uvec3(lower_of(a.x, b.x), lower_of(a.y, b.y), lower_of(a.z, b.z));
}
uvec3 upper_of(uvec3 a, uvec3 b) {
  return uvec3(upper_of(a.x, b.x), upper_of(a.y, b.y), upper_of(a.z, b.z));
}
// The bits of ordered().
uint bits_of_ordered(int whole) {
  return whole < 0 ? uint(int(0x80000000u) - whole) : uint(whole);
}
