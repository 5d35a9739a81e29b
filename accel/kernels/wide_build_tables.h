#pragma once

#include "accel/wide/wide_build_kernels.h"

namespace encore::accel::ENCORE_ISA {

// What WideBuildKernels holds, from several files.
void build_bounds(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
                  WideBox& box);
void build_items(const scene::Triangle* triangles, std::size_t begin, std::size_t end, float scale,
                 WideItem* items, WideBox& centers);
void build_clear(const WideBox& centers, std::uint32_t count, WideBinning& binning, WideBins& bins);
void build_bin(const WideItem* items, std::size_t begin, std::size_t end,
               const WideBinning& binning, WideBins& bins);
void build_merge(WideBins& into, const WideBins& from, std::uint32_t count);
void build_split(const WideBins& bins, const WideBinning& binning, WideSplit& split);
void build_part(const WideItem* items, std::size_t begin, std::size_t end,
                const WideBinning& binning, const WideSplit& split, WideItem* left, WideItem* right,
                WideBox centers[2]);
void build_fit_items(const WideItem* items, std::size_t begin, std::size_t end, WideBox& box,
                     WideBox& centers);
void build_sah_subtree(const WideBuildArrays& arrays, WideSubtree& subtree);
void build_keys(const scene::Triangle* triangles, std::size_t begin, std::size_t end,
                const WideMorton& morton, std::uint64_t* keys);
void build_centers(const scene::Triangle* triangles, const std::uint64_t* keys, std::size_t count,
                   float unit, WideBox& centers);
void build_refine(const scene::Triangle* triangles, const std::uint64_t* keys, std::size_t count,
                  const WideMorton& morton, std::uint64_t* fine);
void build_morton_subtree(const WideBuildArrays& arrays, WideSubtree& subtree);
void build_fit(const scene::Triangle* triangles, const std::uint32_t* ids, TriangleBlock* blocks,
               gpu::WideNode* nodes, const WideFit& fit);

}  // namespace encore::accel::ENCORE_ISA
