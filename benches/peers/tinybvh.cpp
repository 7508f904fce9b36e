// tinybvh's eight-wide kernel behind functions of C. The header comes from its repository:
//   g++ -std=c++20 -O3 -march=native -shared -fPIC -I TINYBVH benches/peers/tinybvh.cpp -o libtinybvh.so
//   TINYBVH=./libtinybvh.so cargo bench --bench peers
#define TINYBVH_IMPLEMENTATION
#include "tiny_bvh.h"

using namespace tinybvh;

struct NarrowRay {
    float origin[3], t_min, direction[3], t_max;
};

static Ray ray_of(const NarrowRay &from) {
    Ray ray;
    ray.O = bvhvec3(from.origin[0], from.origin[1], from.origin[2]);
    ray.D = bvhvec3(from.direction[0], from.direction[1], from.direction[2]);
    ray.rD = tinybvh_rcp(ray.D);
    ray.mask = RAY_MASK_INTERSECT_ALL;
    ray.hit.t = from.t_max < BVH_FAR ? from.t_max : BVH_FAR;
    ray.hit.prim = ~0u;
    return ray;
}

extern "C" {
// The vertices, four numbers each, must stay where they are.
void *tinybvh_build(const float *vertices, uint32_t triangles) {
    auto *tree = new BVH8_CPU();
    tree->BuildHQ((const bvhvec4 *)vertices, triangles);
    return tree;
}

// Writes the distance and the number of the closest triangle; ~0 without one.
void tinybvh_closest(const void *tree, const NarrowRay *rays, size_t count, float *t, uint32_t *triangle) {
    for (size_t i = 0; i < count; i++) {
        Ray ray = ray_of(rays[i]);
        ((const BVH8_CPU *)tree)->Intersect(ray);
        t[i] = ray.hit.t, triangle[i] = ray.hit.prim;
    }
}

void tinybvh_any(const void *tree, const NarrowRay *rays, size_t count, bool *blocked) {
    for (size_t i = 0; i < count; i++) {
        blocked[i] = ((const BVH8_CPU *)tree)->IsOccluded(ray_of(rays[i]));
    }
}
}
