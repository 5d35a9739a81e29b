// gpu::WideNode as words, for those who write it: along each axis eight lower ends and eight upper
// ends with the sign turned, then the children (accel/wide/wide_tree.h).
const uint kWideWords = 64u;
const uint kWideAxisWords = 16u;
const uint kWideChildWords = 48u;  // before the first child
const uint kWideNoChild = 0xFFFFFFFFu;
const uint kWideLeafBit = 0x80000000u;
const uint kWideBlockSize = 4u;

layout(std430, binding = ENCORE_BINDING_NODES) coherent buffer Nodes {
  uint node_words[];
};

uint wide_child_of(uint node, uint place) {
  return node_words[kWideWords * node + kWideChildWords + place];
}
