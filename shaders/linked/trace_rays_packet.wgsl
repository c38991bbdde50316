@compute @workgroup_size(16, 1, 1)
fn trace_rays(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32, @builtin(subgroup_invocation_id) packet_lane: u32) {
    package_scene_packet_lanes__1start_packets(packet_lane);
    answer(group, lane);
}

fn answer(group: vec3u, lane: u32) {
    package_scene_fetch__1load_starts();
    let first = 64u * package_lib_tile__1permuted_group(group.x, package_bindings_dispatch.group_count, package_bindings_dispatch.group_stride);
    var rays = package_scene_rays__1dead_rays();
    var k = 0u;
    loop {
        let query = package_scene_query__2load_query_ray(first + package_scene_dispatch__1place_of(lane, k));
        rays = package_scene_rays__1ray_set(rays, k, query.ray);
        package_scene_shutter__1shutter_time = query.time;
        continuing {
            k += 1u;
            break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
        }
    }
    package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
    let hits = trace(rays);
    k = 0u;
    loop {
        package_scene_query__1store_hit(first + package_scene_dispatch__1place_of(lane, k), package_scene_rays__1hit_at(hits, k));
        continuing {
            k += 1u;
            break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
        }
    }
    package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
    if (package_scene_loops__1cut_off) {
        atomicAdd(&package_bindings_dispatch.counters.cut_off_paths, 1u);
    }
    if (lane == 0u) {
        atomicAdd(&package_bindings_dispatch.counters.groups_done, 1u);
    }
}

fn trace(rays: package_scene_rays_Rays) -> package_scene_rays_Hits {
    if (package_bindings__1ANY_HIT) {
        return package_scene_rays__1any_hits(rays);
    }
    return package_scene_rays__1closest_hits(rays);
}

var<private> package_scene_packet_lanes__1packet_lane: u32;

struct package_scene_packet_lanes_FourRays {
    r0: package_scene_primitive_TraversalRay,
    r1: package_scene_primitive_TraversalRay,
    r2: package_scene_primitive_TraversalRay,
    r3: package_scene_primitive_TraversalRay
}

struct package_scene_packet_lanes_TwoHits {
    hit: package_types_Hit,
    second: package_types_Hit
}

struct package_scene_packet_lanes_FourHits {
    h0: package_scene_packet_lanes_TwoHits,
    h1: package_scene_packet_lanes_TwoHits,
    h2: package_scene_packet_lanes_TwoHits,
    h3: package_scene_packet_lanes_TwoHits
}

fn package_scene_packet_lanes__1start_packets(lane: u32) {
    package_scene_packet_lanes__1packet_lane = lane;
}

fn package_scene_packet_lanes__3any_lane_of_packet(condition: bool) -> bool {
    var found = select(0u, 1u, condition);
    found |= subgroupShuffle(found, package_scene_packet_lanes__1packet_lane ^ 1u);
    found |= subgroupShuffle(found, package_scene_packet_lanes__1packet_lane ^ 2u);
    found |= subgroupShuffle(found, package_scene_packet_lanes__1packet_lane ^ 4u);
    return found != 0u;
}

fn package_scene_packet_lanes__1closer_two(at: package_scene_primitive_TraversalRay, before: package_scene_packet_lanes_TwoHits, candidate: package_types_Candidate, primitive: u32) -> package_scene_packet_lanes_TwoHits {
    package_scene_primitive__1runner_up = before.second;
    let hit = package_scene_primitive__1closer_of(at, before.hit, candidate, primitive);
    return package_scene_packet_lanes_TwoHits(hit, package_scene_primitive__1runner_up);
}

var<private> package_scene_fetch__1shape_row: u32;

var<private> package_scene_fetch__1light_row: u32;

fn package_scene_fetch__1load_starts() {
    package_scene_fetch__1shape_row = package_bindings_frame.shape_row;
    package_scene_fetch__1light_row = package_bindings_frame.light_row;
}

fn package_scene_fetch__1load_instance(index: u32) -> package_types_PackedInstance {
    let row = package_bindings_frame.instance_row + package_types__1INSTANCE_ROWS * index;
    let r0 = package_scene_fetch__1node_row(row);
    let r1 = package_scene_fetch__1node_row(row + 1u);
    let r2 = package_scene_fetch__1node_row(row + 2u);
    let r3 = package_scene_fetch__1node_row(row + 3u);
    let r4 = package_scene_fetch__1node_row(row + 4u);
    let r5 = package_scene_fetch__1node_row(row + 5u);
    let r6 = package_scene_fetch__1node_row(row + 6u);
    return package_types_PackedInstance(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec3f>(r2.xyz), r2.w, bitcast<vec3f>(r3.xyz), r3.w, bitcast<vec3f>(r4.xyz), r4.w, bitcast<vec3f>(r5.xyz), r5.w, bitcast<vec3f>(r6.xyz), r6.w, bitcast<vec4f>(package_scene_fetch__1node_row(row + 7u)), bitcast<vec4f>(package_scene_fetch__1node_row(row + 8u)), bitcast<vec4f>(package_scene_fetch__1node_row(row + 9u)));
}

fn package_scene_fetch__1load_key(index: u32) -> package_types_PackedKey {
    let row = package_bindings_frame.key_row + package_types__1KEY_ROWS * index;
    return package_types_PackedKey(bitcast<vec3f>(package_scene_fetch__1node_row(row).xyz), 0u, bitcast<vec4f>(package_scene_fetch__1node_row(row + 1u)), bitcast<vec3f>(package_scene_fetch__1node_row(row + 2u).xyz), 0u, bitcast<vec3f>(package_scene_fetch__1node_row(row + 3u).xyz), 0u);
}

fn package_scene_fetch__1load_shape(index: u32) -> package_types_PackedShape {
    let row = package_scene_fetch__1shape_row + package_types__1SHAPE_ROWS * index;
    return package_scene_fetch__1shape_of(package_scene_fetch__1triangle_row(row), package_scene_fetch__1triangle_row(row + 1u), package_scene_fetch__1triangle_row(row + 2u), package_scene_fetch__1triangle_row(row + 3u), package_scene_fetch__1triangle_row(row + 4u));
}

fn package_scene_fetch__1shape_of(r0: vec4u, r1: vec4u, r2: vec4u, r3: vec4u, r4: vec4u) -> package_types_PackedShape {
    return package_types_PackedShape(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), bitcast<f32>(r1.w), bitcast<vec3f>(r2.xyz), bitcast<f32>(r2.w), bitcast<vec3f>(r3.xyz), r3.w, r4.x, r4.y, 0u, 0u);
}

fn package_scene_fetch_texel(row: u32) -> vec2u {
    return vec2u(row & ((1u << package_types__2IMAGE_WIDTH_LOG2) - 1u), row >> package_types__2IMAGE_WIDTH_LOG2);
}

fn package_scene_fetch__1node_row(row: u32) -> vec4u {
    return textureLoad(package_bindings_nodes, package_scene_fetch_texel(row));
}

fn package_scene_fetch__1triangle_row(row: u32) -> vec4u {
    return textureLoad(package_bindings_triangles, package_scene_fetch_texel(row));
}

@group(0) @binding(0)
var package_bindings_nodes: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(1)
var package_bindings_triangles: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(3)
var package_bindings_rays: texture_storage_2d<rgba32uint, read>;

@group(1) @binding(0)
var<storage, read> package_bindings_frame: package_types_PackedFrame;

@group(1) @binding(1)
var<storage, read_write> package_bindings_dispatch: package_types_PackedDispatch;

@group(2) @binding(0)
var<storage, read_write> package_bindings_hits: array<vec4u>;

override package_bindings__1TRIANGLE_TEST: u32 = package_types__2TRIANGLE_TEST_WATERTIGHT;

override package_bindings__1HAS_TRIANGLES: bool = true;

override package_bindings__1HAS_SHAPES: bool = true;

override package_bindings__1HAS_PLANES: bool = true;

override package_bindings__1MOSTLY_SHAPES: bool = false;

override package_bindings__1COUNT_STEPS: bool = false;

override package_bindings__1ANY_HIT: bool = false;

override package_bindings__1SHAPE_KINDS: u32 = 4294967295u;

override package_bindings__1HAS_CONTACT: bool = true;

override package_bindings__1HAS_INSTANCES: bool = true;

override package_bindings__1HAS_MOTION: bool = true;

const package_types_NONE: u32 = 4294967295u;

const package_types_LEAF: u32 = 2147483648u;

const package_types_SHAPE: u32 = 1073741824u;

const package_types__2LEAF_COUNT_ONE: u32 = 134217728u;

const package_types__2LEAF_COUNT_MASK: u32 = 939524096u;

const package_types__2LEAF_FIRST_MASK: u32 = 134217727u;

const package_types_INSTANCE: u32 = 4160749568u;

const package_types__1NO_INSTANCE: u32 = 1048575u;

const package_types__1INSTANCE_ROWS: u32 = 10u;

const package_types__1KEY_ROWS: u32 = 4u;

const package_types__1SHAPE_ROWS: u32 = 5u;

const package_types__2IMAGE_WIDTH_LOG2: u32 = 12u;

const package_types__1SHAPE_SPHERE: u32 = 0u;

const package_types__1SHAPE_DISC: u32 = 2u;

const package_types__1SHAPE_RECTANGLE: u32 = 3u;

const package_types__1SHAPE_BOX: u32 = 4u;

const package_types__1SHAPE_CONE: u32 = 5u;

const package_types__1SHAPE_TORUS: u32 = 6u;

const package_types__1SHAPE_ELLIPSOID: u32 = 7u;

const package_types__1SHAPE_GLOBE: u32 = 8u;

const package_types__1SHAPE_CAPPED: u32 = 1u;

const package_types__2TRIANGLE_TEST_PLANE: u32 = 0u;

const package_types__3TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1u;

const package_types__2TRIANGLE_TEST_WATERTIGHT: u32 = 2u;

struct package_types_PackedTriangle {
    v0: vec3f,
    i0: u32,
    v1: vec3f,
    i1: u32,
    v2: vec3f,
    i2: u32
}

struct package_types_PackedShape {
    position: vec3f,
    kind: u32,
    row_x: vec3f,
    size0: f32,
    row_y: vec3f,
    size1: f32,
    row_z: vec3f,
    flags: u32,
    material: u32,
    id: u32,
    _pad0: u32,
    _pad1: u32
}

struct package_types_PackedInstance {
    translation: vec3f,
    root: u32,
    inverse_x: vec3f,
    first: u32,
    inverse_y: vec3f,
    count: u32,
    inverse_z: vec3f,
    key_count: u32,
    linear_x: vec3f,
    first_key: u32,
    linear_y: vec3f,
    id: u32,
    linear_z: vec3f,
    _pad: u32,
    pattern_x: vec4f,
    pattern_y: vec4f,
    pattern_z: vec4f
}

struct package_types_PackedKey {
    translation: vec3f,
    _pad0: u32,
    rotation: vec4f,
    stretch: vec3f,
    _pad1: u32,
    shear: vec3f,
    _pad2: u32
}

struct package_types_PackedCamera {
    origin: vec3f,
    lens_radius: f32,
    forward: vec3f,
    focus_distance: f32,
    right: vec3f,
    blade_rotation: f32,
    up: vec3f,
    blade_count: u32
}

struct package_types_PackedFrame {
    camera: package_types_PackedCamera,
    background: vec3f,
    light_count: u32,
    ambient: vec3f,
    triangle_count: u32,
    shape_count: u32,
    plane_count: u32,
    vertex_count: u32,
    material_count: u32,
    background_top: vec3f,
    background_rotation: f32,
    background_first_texel: u32,
    background_width: u32,
    background_height: u32,
    root: u32,
    camera_media: vec4u,
    instance_row: u32,
    instance_count: u32,
    key_row: u32,
    light_row: u32,
    camera_key_count: u32,
    light_key_count: u32,
    first_triangle: u32,
    shape_row: u32
}

struct package_types_PackedDispatch {
    picture_width: u32,
    picture_height: u32,
    tile_x: u32,
    tile_y: u32,
    tile_width: u32,
    tile_height: u32,
    group_columns: u32,
    group_count: u32,
    group_stride: u32,
    first_group: u32,
    end_group: u32,
    grid_width: u32,
    first_sample: u32,
    end_sample: u32,
    seed: u32,
    max_depth: u32,
    min_throughput: f32,
    light_samples: f32,
    counters: package_types_PackedCounters
}

struct package_types_PackedCounters {
    groups_done: atomic<u32>,
    nonfinite_samples: atomic<u32>,
    cut_off_paths: atomic<u32>,
    cut_off_trees: atomic<u32>,
    primary: atomic<u32>,
    primary_hits: atomic<u32>,
    shadow: atomic<u32>,
    shadow_blocked: atomic<u32>,
    reflection: atomic<u32>,
    reflection_hits: atomic<u32>,
    refraction: atomic<u32>,
    refraction_hits: atomic<u32>
}

struct package_types_Ray {
    origin: vec3f,
    t_max: f32,
    direction: vec3f,
    leaving: u32,
    leaving_instance: u32
}

struct package_types_Candidate {
    hit: bool,
    t: f32,
    b1: f32,
    b2: f32
}

struct package_types_Hit {
    t: f32,
    primitive: u32,
    b1: f32,
    b2: f32,
    instance: u32
}

fn package_lib_tile__1permuted_group(index: u32, group_count: u32, stride: u32) -> u32 {
    return (index * stride) % group_count;
}

struct package_scene_rays_Rays {
    origin: package_scene_wide_Vectors,
    direction: package_scene_wide_Vectors,
    t_max: package_scene_wide_Floats,
    leaving: package_scene_wide_Words,
    leaving_instance: package_scene_wide_Words
}

struct package_scene_rays_Hits {
    t: package_scene_wide_Floats,
    primitive: package_scene_wide_Words,
    b1: package_scene_wide_Floats,
    b2: package_scene_wide_Floats,
    instance: package_scene_wide_Words
}

fn package_scene_rays__1dead_rays() -> package_scene_rays_Rays {
    return package_scene_rays_Rays(package_scene_wide_Vectors(package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0)), package_scene_wide_Vectors(package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0), package_scene_wide_Floats(1.0)), package_scene_wide_Floats(-1.0), package_scene_wide_Words(package_types_NONE), package_scene_wide_Words(package_types__1NO_INSTANCE));
}

fn package_scene_rays__1ray_at(rays: package_scene_rays_Rays, k: u32) -> package_types_Ray {
    return package_types_Ray(package_scene_wide__1vector_at(rays.origin, k), package_scene_wide__1float_at(rays.t_max, k), package_scene_wide__1vector_at(rays.direction, k), package_scene_wide__1word_at(rays.leaving, k), package_scene_wide__1word_at(rays.leaving_instance, k));
}

fn package_scene_rays__1ray_set(rays: package_scene_rays_Rays, k: u32, ray: package_types_Ray) -> package_scene_rays_Rays {
    return package_scene_rays_Rays(package_scene_wide__1vector_set(rays.origin, k, ray.origin), package_scene_wide__1vector_set(rays.direction, k, ray.direction), package_scene_wide__1float_set(rays.t_max, k, ray.t_max), package_scene_wide__1word_set(rays.leaving, k, ray.leaving), package_scene_wide__1word_set(rays.leaving_instance, k, ray.leaving_instance));
}

fn package_scene_rays__1hit_at(hits: package_scene_rays_Hits, k: u32) -> package_types_Hit {
    return package_types_Hit(package_scene_wide__1float_at(hits.t, k), package_scene_wide__1word_at(hits.primitive, k), package_scene_wide__1float_at(hits.b1, k), package_scene_wide__1float_at(hits.b2, k), package_scene_wide__1word_at(hits.instance, k));
}

fn package_scene_rays__1closest_hits(rays: package_scene_rays_Rays) -> package_scene_rays_Hits {
    {
        return package_scene_packet_walk__1packet_hits(rays, false);
    }
}

fn package_scene_rays__1any_hits(rays: package_scene_rays_Rays) -> package_scene_rays_Hits {
    {
        return package_scene_packet_walk__1packet_hits(rays, true);
    }
}

const package_scene_wide__2RAYS_PER_LANE: u32 = 4u;

const package_scene_wide__1ONE_RAY: bool = package_scene_wide__2RAYS_PER_LANE == 1u;

alias package_scene_wide_Floats = vec4f;

alias package_scene_wide_Words = vec4u;

struct package_scene_wide_Vectors {
    x: package_scene_wide_Floats,
    y: package_scene_wide_Floats,
    z: package_scene_wide_Floats
}

fn package_scene_wide__1float_at(all: package_scene_wide_Floats, k: u32) -> f32 {
    return all[k];
}

fn package_scene_wide__1word_at(all: package_scene_wide_Words, k: u32) -> u32 {
    return all[k];
}

fn package_scene_wide__1vector_at(all: package_scene_wide_Vectors, k: u32) -> vec3f {
    return vec3f(package_scene_wide__1float_at(all.x, k), package_scene_wide__1float_at(all.y, k), package_scene_wide__1float_at(all.z, k));
}

fn package_scene_wide__1float_set(all: package_scene_wide_Floats, k: u32, value: f32) -> package_scene_wide_Floats {
    {
        return select(all, vec4f(value), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
    }
}

fn package_scene_wide__1word_set(all: package_scene_wide_Words, k: u32, value: u32) -> package_scene_wide_Words {
    {
        return select(all, vec4u(value), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
    }
}

fn package_scene_wide__1vector_set(all: package_scene_wide_Vectors, k: u32, value: vec3f) -> package_scene_wide_Vectors {
    return package_scene_wide_Vectors(package_scene_wide__1float_set(all.x, k, value.x), package_scene_wide__1float_set(all.y, k, value.y), package_scene_wide__1float_set(all.z, k, value.z));
}

struct package_scene_query_QueryRay {
    ray: package_types_Ray,
    time: f32
}

fn package_scene_query__2load_query_ray(index: u32) -> package_scene_query_QueryRay {
    let r0 = package_scene_query__1ray_row(2u * index);
    let r1 = package_scene_query__1ray_row(2u * index + 1u);
    let ray = package_types_Ray(bitcast<vec3f>(r0.xyz), bitcast<f32>(r0.w), bitcast<vec3f>(r1.xyz), package_types_NONE, package_types__1NO_INSTANCE);
    return package_scene_query_QueryRay(ray, bitcast<f32>(r1.w));
}

fn package_scene_query__1store_hit(index: u32, hit: package_types_Hit) {
    var rest = vec2u(hit.instance, pack2x16unorm(vec2f(hit.b1, hit.b2)));
    if (package_bindings__1COUNT_STEPS) {
        rest = vec2u(package_scene_loops__1nodes_visited, package_scene_loops__1primitives_tested);
    }
    package_bindings_hits[index] = vec4u(bitcast<u32>(hit.t), hit.primitive, rest);
}

fn package_scene_query__1ray_row(row: u32) -> vec4u {
    return textureLoad(package_bindings_rays, package_scene_fetch_texel(row));
}

fn package_scene_dispatch__1place_of(lane: u32, k: u32) -> u32 {
    {
        return ((lane & 4294967288u) << 2u) | (k << 3u) | (lane & 7u);
    }
}

var<private> package_scene_shutter__1shutter_time: f32 = 0.0;

var<private> package_scene_loops__1nodes_visited: u32 = 0u;

var<private> package_scene_loops__1primitives_tested: u32 = 0u;

var<private> package_scene_loops__1cut_off: bool = false;

var<private> package_scene_packet_walk_seconds: package_scene_packet_lanes_FourHits;

fn package_scene_packet_walk__1packet_hits(rays: package_scene_rays_Rays, any: bool) -> package_scene_rays_Hits {
    let found = package_scene_packet_walk_walk(package_scene_rays__1ray_at(rays, 0u), package_scene_rays__1ray_at(rays, 1u), package_scene_rays__1ray_at(rays, 2u), package_scene_rays__1ray_at(rays, 3u), any);
    package_scene_packet_walk_seconds = found;
    return package_scene_rays_Hits(package_scene_wide_Floats(found.h0.hit.t, found.h1.hit.t, found.h2.hit.t, found.h3.hit.t), package_scene_wide_Words(found.h0.hit.primitive, found.h1.hit.primitive, found.h2.hit.primitive, found.h3.hit.primitive), package_scene_wide_Floats(found.h0.hit.b1, found.h1.hit.b1, found.h2.hit.b1, found.h3.hit.b1), package_scene_wide_Floats(found.h0.hit.b2, found.h1.hit.b2, found.h2.hit.b2, found.h3.hit.b2), package_scene_wide_Words(found.h0.hit.instance, found.h1.hit.instance, found.h2.hit.instance, found.h3.hit.instance));
}

fn package_scene_packet_walk__1first_hit(ray: package_types_Ray) -> package_scene_packet_lanes_TwoHits {
    var hit = package_types_Hit(ray.t_max, package_types_NONE, 0.0, 0.0, package_types__1NO_INSTANCE);
    package_scene_primitive__1runner_up = package_types_Hit(package_lib_camera__1T_FAR, package_types_NONE, 0.0, 0.0, package_types__1NO_INSTANCE);
    if (package_bindings__1HAS_PLANES) {
        hit = package_scene_exhaustive__1hit_planes(ray, hit);
    }
    return package_scene_packet_lanes_TwoHits(hit, package_scene_primitive__1runner_up);
}

fn package_scene_packet_walk__1world_ray(ray: package_types_Ray) -> package_scene_primitive_TraversalRay {
    return package_scene_primitive__1traversal_ray(ray, package_lib_intersect__1triangle_watertight__1shear_of(ray.direction), package_types__1NO_INSTANCE);
}

fn package_scene_packet_walk_walk(ray0: package_types_Ray, ray1: package_types_Ray, ray2: package_types_Ray, ray3: package_types_Ray, any: bool) -> package_scene_packet_lanes_FourHits {
    var hits = package_scene_packet_lanes_FourHits(package_scene_packet_walk__1first_hit(ray0), package_scene_packet_walk__1first_hit(ray1), package_scene_packet_walk__1first_hit(ray2), package_scene_packet_walk__1first_hit(ray3));
    if (!(package_bindings__1HAS_TRIANGLES || package_bindings__1HAS_SHAPES)) {
        return hits;
    }
    var rays = package_scene_packet_lanes_FourRays(package_scene_packet_walk__1world_ray(ray0), package_scene_packet_walk__1world_ray(ray1), package_scene_packet_walk__1world_ray(ray2), package_scene_packet_walk__1world_ray(ray3));
    var stack = package_scene_packet_stack_Stack(package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY);
    var current = 0u;
    if (package_bindings__1HAS_INSTANCES) {
        current = package_bindings_frame.root;
    }
    loop {
        loop {
            if (package_bindings__1HAS_INSTANCES) {
                if (current == package_scene_traverse_RETURN) {
                    rays = package_scene_packet_lanes_FourRays(package_scene_packet_walk__1world_ray(ray0), package_scene_packet_walk__1world_ray(ray1), package_scene_packet_walk__1world_ray(ray2), package_scene_packet_walk__1world_ray(ray3));
                    current = package_scene_packet_stack__1top_of(stack);
                    stack = package_scene_packet_stack_popped(stack);
                }
                if ((current >= package_types_INSTANCE) & (current != package_scene_traverse_EMPTY)) {
                    let index = current & package_types__2LEAF_FIRST_MASK;
                    let instance = package_scene_fetch__1load_instance(index);
                    let space = package_scene_instance__1space_of(instance);
                    let o0 = package_scene_instance__1object_ray(ray0, space);
                    let o1 = package_scene_instance__1object_ray(ray1, space);
                    let o2 = package_scene_instance__1object_ray(ray2, space);
                    let o3 = package_scene_instance__1object_ray(ray3, space);
                    rays = package_scene_packet_lanes_FourRays(package_scene_primitive__1traversal_ray(o0, package_lib_intersect__1triangle_watertight__1shear_of(o0.direction), index), package_scene_primitive__1traversal_ray(o1, package_lib_intersect__1triangle_watertight__1shear_of(o1.direction), index), package_scene_primitive__1traversal_ray(o2, package_lib_intersect__1triangle_watertight__1shear_of(o2.direction), index), package_scene_primitive__1traversal_ray(o3, package_lib_intersect__1triangle_watertight__1shear_of(o3.direction), index));
                    stack = package_scene_packet_stack_pushed(stack, package_scene_traverse_RETURN, 1u);
                    current = instance.root;
                }
            }
            if ((current & package_types_LEAF) == 0u) {
                let limits = vec4i(package_scene_packet_walk__1limit_of(ray0, hits.h0.hit, any), package_scene_packet_walk__1limit_of(ray1, hits.h1.hit, any), package_scene_packet_walk__1limit_of(ray2, hits.h2.hit, any), package_scene_packet_walk__1limit_of(ray3, hits.h3.hit, any));
                loop {
                    let node = package_scene_packet_node__2load_shared_node(current);
                    let children = package_scene_packet_node__1order_children(node, rays, limits);
                    current = select(package_scene_packet_stack__1top_of(stack), subgroupShuffle(children.reference, 0u), children.count > 0u);
                    stack = package_scene_packet_stack_pushed(stack, subgroupShuffle(children.reference, (package_scene_packet_lanes__1packet_lane + 1u) & 3u), children.count - 1u);
                    if (package_bindings__1COUNT_STEPS) {
                        package_scene_loops__1nodes_visited += 1u;
                    }
                    continuing {
                    
                        break if (current & package_types_LEAF) != 0u;
                    }
                }
            }
            loop {
                let is_here = package_scene_packet_leaf__1is_common(current);
                let next = package_scene_packet_leaf_after(current, package_scene_packet_stack__1top_of(stack));
                if (is_here) {
                    hits = package_scene_packet_leaf__1meet_common(rays, hits, current);
                    stack = package_scene_packet_stack_pushed(stack, package_scene_traverse_EMPTY, select(0u, package_scene_packet_stack_POP, next.is_last));
                    current = next.reference;
                    if (any) {
                        current = select(package_scene_traverse_EMPTY, current, package_scene_packet_walk__1is_open(hits, ray0, ray1, ray2, ray3));
                    }
                }
                continuing {
                
                    break if !package_scene_packet_leaf__1is_common(current);
                }
            }
            continuing {
            
                break if (current == package_scene_traverse_EMPTY) | package_scene_packet_leaf__1is_rare(current);
            }
        }
        if (package_bindings__1HAS_SHAPES && package_bindings__1HAS_TRIANGLES) {
            let next = package_scene_packet_leaf_after(current, package_scene_packet_stack__1top_of(stack));
            if (package_scene_packet_leaf__1is_rare(current)) {
                hits = package_scene_packet_leaf__1meet_rare(rays, hits, current);
                stack = package_scene_packet_stack_pushed(stack, package_scene_traverse_EMPTY, select(0u, package_scene_packet_stack_POP, next.is_last));
                current = next.reference;
                if (any) {
                    current = select(package_scene_traverse_EMPTY, current, package_scene_packet_walk__1is_open(hits, ray0, ray1, ray2, ray3));
                }
            }
        }
        continuing {
        
            break if current == package_scene_traverse_EMPTY;
        }
    }
    package_scene_loops__1cut_off |= package_scene_packet_stack__1is_full | (current != package_scene_traverse_EMPTY);
    return hits;
}

fn package_scene_packet_walk__1is_open(hits: package_scene_packet_lanes_FourHits, ray0: package_types_Ray, ray1: package_types_Ray, ray2: package_types_Ray, ray3: package_types_Ray) -> bool {
    return package_scene_packet_lanes__3any_lane_of_packet(package_scene_packet_walk__1is_unoccluded(ray0, hits.h0.hit) | package_scene_packet_walk__1is_unoccluded(ray1, hits.h1.hit) | package_scene_packet_walk__1is_unoccluded(ray2, hits.h2.hit) | package_scene_packet_walk__1is_unoccluded(ray3, hits.h3.hit));
}

fn package_scene_packet_walk__1is_unoccluded(ray: package_types_Ray, hit: package_types_Hit) -> bool {
    return (hit.primitive == package_types_NONE) & (ray.t_max >= 0.0);
}

fn package_scene_packet_walk__1limit_of(ray: package_types_Ray, hit: package_types_Hit, any: bool) -> i32 {
    let limit = bitcast<i32>(package_scene_traverse__1search_limit(ray, hit)) + package_lib_intersect_node_WIDENING;
    return select(limit, -1, any & (hit.primitive != package_types_NONE));
}

var<private> package_scene_primitive__1runner_up: package_types_Hit;

struct package_scene_primitive_TraversalRay {
    ray: package_types_Ray,
    inv: vec3f,
    shear: package_lib_intersect__1triangle_watertight_Shear,
    instance: u32
}

fn package_scene_primitive__1traversal_ray(ray: package_types_Ray, shear: package_lib_intersect__1triangle_watertight_Shear, instance: u32) -> package_scene_primitive_TraversalRay {
    return package_scene_primitive_TraversalRay(ray, package_lib_numeric__1safe_reciprocal(ray.direction), shear, instance);
}

fn package_scene_primitive__1closer_of(at: package_scene_primitive_TraversalRay, hit: package_types_Hit, candidate: package_types_Candidate, primitive: u32) -> package_types_Hit {
    var is_lower = primitive < hit.primitive;
    var is_left = primitive == at.ray.leaving;
    if (package_bindings__1HAS_INSTANCES) {
        is_lower = (at.instance < hit.instance) | ((at.instance == hit.instance) & is_lower);
        is_left = is_left & (at.instance == at.ray.leaving_instance);
    }
    let ties = (candidate.t == hit.t) & is_lower & (hit.primitive != package_types_NONE);
    let counts = candidate.hit & !is_left;
    let wins = counts & ((candidate.t < hit.t) | ties);
    if (package_bindings__1HAS_CONTACT) {
        let found = package_types_Hit(candidate.t, primitive, candidate.b1, candidate.b2, at.instance);
        package_scene_primitive__2keep_runner_up(hit, found, counts, wins);
    }
    return package_types_Hit(select(hit.t, candidate.t, wins), select(hit.primitive, primitive, wins), select(hit.b1, candidate.b1, wins), select(hit.b2, candidate.b2, wins), select(hit.instance, at.instance, wins));
}

fn package_scene_primitive__2keep_runner_up(hit: package_types_Hit, found: package_types_Hit, counts: bool, wins: bool) {
    let is_same = (found.primitive == hit.primitive) & (found.instance == hit.instance);
    if (wins) {
        package_scene_primitive__1runner_up = hit;
    }
    else if (counts & !is_same & (found.t < package_scene_primitive__1runner_up.t)) {
        package_scene_primitive__1runner_up = found;
    }
}

fn package_scene_primitive__1test_triangle(ray: package_types_Ray, corners: package_types_PackedTriangle, shear: package_lib_intersect__1triangle_watertight_Shear) -> package_types_Candidate {
    if (package_bindings__1TRIANGLE_TEST == package_types__2TRIANGLE_TEST_PLANE) {
        return package_lib_intersect__1triangle_plane__2intersect_triangle_plane(ray, corners.v0, corners.v1, corners.v2);
    }
    if (package_bindings__1TRIANGLE_TEST == package_types__3TRIANGLE_TEST_MOLLER_TRUMBORE) {
        return package_lib_intersect__2triangle_moller_trumbore__3intersect_triangle_moller_trumbore(ray, corners.v0, corners.v1, corners.v2);
    }
    return package_lib_intersect__1triangle_watertight__2intersect_triangle_watertight(ray.origin, shear, corners.v0, corners.v1, corners.v2);
}

const package_lib_camera__1T_FAR: f32 = 3e38;

fn package_scene_exhaustive__1hit_planes(ray: package_types_Ray, start: package_types_Hit) -> package_types_Hit {
    var hit = start;
    let end = package_bindings_frame.shape_count + package_bindings_frame.plane_count;
    var index = package_bindings_frame.shape_count;
    loop {
        let shape = package_scene_fetch__1load_shape(index);
        let candidate = package_lib_intersect_plane__1intersect_plane(ray, shape.position, shape.row_y);
        let primitive = package_types_SHAPE | index;
        let counts = candidate.hit & (primitive != ray.leaving);
        let wins = counts & (candidate.t < hit.t);
        let found = package_types_Hit(candidate.t, primitive, 0.0, 0.0, package_types__1NO_INSTANCE);
        if (package_bindings__1HAS_CONTACT) {
            package_scene_primitive__2keep_runner_up(hit, found, counts, wins);
        }
        if (wins) {
            hit = found;
        }
        continuing {
            index += 1u;
            break if index >= end;
        }
    }
    package_scene_loops__1cut_off |= index < end;
    return hit;
}

fn package_lib_intersect_plane__1intersect_plane(ray: package_types_Ray, point: vec3f, n: vec3f) -> package_types_Candidate {
    let slope = dot(n, ray.direction);
    let steep = abs(slope) > 1e-12;
    let t = dot(n, point - ray.origin) / select(1.0, slope, steep);
    return package_types_Candidate(steep & (t > 0.0), t, 0.0, 0.0);
}

struct package_lib_intersect__1triangle_watertight_Shear {
    x: vec3f,
    y: vec3f,
    z: vec3f
}

fn package_lib_intersect__1triangle_watertight__1shear_of(direction: vec3f) -> package_lib_intersect__1triangle_watertight_Shear {
    let size = abs(direction);
    let is_x = (size.x >= size.y) & (size.x >= size.z);
    let is_y = !is_x & (size.y >= size.z);
    let axis_z = select(select(vec3f(0.0, 0.0, 1.0), vec3f(0.0, 1.0, 0.0), is_y), vec3f(1.0, 0.0, 0.0), is_x);
    let axis_x = axis_z.zxy;
    let axis_y = axis_z.yzx;
    let scale = 1.0 / dot(direction, axis_z);
    return package_lib_intersect__1triangle_watertight_Shear(axis_x - dot(direction, axis_x) * scale * axis_z, axis_y - dot(direction, axis_y) * scale * axis_z, scale * axis_z);
}

fn package_lib_intersect__1triangle_watertight__2intersect_triangle_watertight(origin: vec3f, shear: package_lib_intersect__1triangle_watertight_Shear, v0: vec3f, v1: vec3f, v2: vec3f) -> package_types_Candidate {
    let a = v0 - origin;
    let b = v1 - origin;
    let c = v2 - origin;
    let ax = dot(shear.x, a);
    let ay = dot(shear.y, a);
    let bx = dot(shear.x, b);
    let by = dot(shear.y, b);
    let cx = dot(shear.x, c);
    let cy = dot(shear.y, c);
    let left = vec3f(cx * by, ax * cy, bx * ay);
    let right = vec3f(cy * bx, ay * cx, by * ax);
    let inside = all(left >= right) | all(left <= right);
    let edges = left - right;
    let det = edges.x + edges.y + edges.z;
    let usable = inside & (abs(det) > 1e-36);
    let inv_det = 1.0 / select(1.0, det, usable);
    let depths = vec3f(dot(shear.z, a), dot(shear.z, b), dot(shear.z, c));
    let t = dot(edges, depths) * inv_det;
    return package_types_Candidate(usable & (t > 0.0), t, edges.y * inv_det, edges.z * inv_det);
}

const package_lib_numeric_ROUNDING: f32 = 5.9604645e-8;

fn package_lib_numeric__1safe_reciprocal(d: vec3f) -> vec3f {
    let tiny = abs(d) < vec3f(1e-18);
    return 1.0 / select(d, select(vec3f(1e-18), vec3f(-1e-18), d < vec3f(0.0)), tiny);
}

fn package_lib_numeric__1max_component(v: vec3f) -> f32 {
    return max(v.x, max(v.y, v.z));
}

const package_scene_packet_stack_POP: u32 = 4294967295u;

var<private> package_scene_packet_stack__1is_full: bool = false;

struct package_scene_packet_stack_Stack {
    s0: u32,
    s1: u32,
    s2: u32,
    s3: u32,
    s4: u32,
    s5: u32
}

fn package_scene_packet_stack__1top_of(stack: package_scene_packet_stack_Stack) -> u32 {
    return subgroupShuffle(stack.s0, 0u);
}

fn package_scene_packet_stack_pushed(stack: package_scene_packet_stack_Stack, reference: u32, count: u32) -> package_scene_packet_stack_Stack {
    let source = (package_scene_packet_lanes__1packet_lane - count) & 7u;
    let is_pop = count == package_scene_packet_stack_POP;
    let is_new = !is_pop & (package_scene_packet_lanes__1packet_lane < count);
    let is_last = is_pop & (package_scene_packet_lanes__1packet_lane == 7u);
    package_scene_packet_stack__1is_full |= !is_pop & (package_scene_packet_lanes__1packet_lane + count >= 8u) & (stack.s5 != package_scene_traverse_EMPTY);
    let m0 = subgroupShuffle(stack.s0, source);
    let m1 = subgroupShuffle(stack.s1, source);
    let m2 = subgroupShuffle(stack.s2, source);
    let m3 = subgroupShuffle(stack.s3, source);
    let m4 = subgroupShuffle(stack.s4, source);
    let m5 = subgroupShuffle(stack.s5, source);
    return package_scene_packet_stack_Stack(select(select(m0, reference, is_new), m1, is_last), select(select(m1, m0, is_new), m2, is_last), select(select(m2, m1, is_new), m3, is_last), select(select(m3, m2, is_new), m4, is_last), select(select(m4, m3, is_new), m5, is_last), select(select(m5, m4, is_new), package_scene_traverse_EMPTY, is_last));
}

fn package_scene_packet_stack_popped(stack: package_scene_packet_stack_Stack) -> package_scene_packet_stack_Stack {
    return package_scene_packet_stack_pushed(stack, package_scene_traverse_EMPTY, package_scene_packet_stack_POP);
}

const package_scene_traverse_EMPTY: u32 = 4294967295u;

const package_scene_traverse_RETURN: u32 = 4294967294u;

const package_scene_traverse__1CONTACT_RANGE: f32 = 0.0001;

fn package_scene_traverse__1search_limit(ray: package_types_Ray, hit: package_types_Hit) -> f32 {
    if (package_bindings__1HAS_CONTACT) {
        return hit.t + package_scene_traverse__1CONTACT_RANGE * (hit.t + package_lib_numeric__1max_component(abs(ray.origin)));
    }
    return hit.t;
}

fn package_scene_instance__1space_of(instance: package_types_PackedInstance) -> package_lib_motion_Space {
    if (package_bindings__1HAS_MOTION) {
        if (instance.key_count > 1u) {
            let moment = package_lib_motion__1moment_of(package_scene_shutter__1shutter_time, instance.key_count);
            let key = instance.first_key + moment.key;
            return package_lib_motion__1space_between(package_scene_fetch__1load_key(key), package_scene_fetch__1load_key(key + 1u), moment.fraction);
        }
    }
    return package_lib_motion_Space(instance.translation, transpose(mat3x3f(instance.linear_x, instance.linear_y, instance.linear_z)), transpose(mat3x3f(instance.inverse_x, instance.inverse_y, instance.inverse_z)));
}

fn package_scene_instance__1object_ray(ray: package_types_Ray, space: package_lib_motion_Space) -> package_types_Ray {
    return package_types_Ray(space.inverse * (ray.origin - space.translation), ray.t_max, space.inverse * ray.direction, ray.leaving, ray.leaving_instance);
}

struct package_lib_motion_Moment {
    key: u32,
    fraction: f32
}

fn package_lib_motion__1moment_of(time: f32, key_count: u32) -> package_lib_motion_Moment {
    let intervals = max(key_count, 2u) - 1u;
    let at = time * f32(intervals);
    let key = min(u32(at), intervals - 1u);
    return package_lib_motion_Moment(key, at - f32(key));
}

struct package_lib_motion_Space {
    translation: vec3f,
    linear: mat3x3f,
    inverse: mat3x3f
}

fn package_lib_motion__1space_between(a: package_types_PackedKey, b: package_types_PackedKey, fraction: f32) -> package_lib_motion_Space {
    let q = mix(a.rotation, b.rotation, vec4f(fraction));
    let rotation = package_lib_motion__1rotation_matrix(q * inverseSqrt(max(dot(q, q), 1e-30)));
    let d = mix(a.stretch, b.stretch, vec3f(fraction));
    let s = mix(a.shear, b.shear, vec3f(fraction));
    let size = max(max(abs(d.x), abs(d.y)), max(abs(d.z), 1e-30));
    let e = d / size;
    let f = s / size;
    let adjugate = mat3x3f(vec3f(e.y * e.z - f.x * f.x, f.y * f.x - f.z * e.z, f.z * f.x - e.y * f.y), vec3f(f.y * f.x - f.z * e.z, e.x * e.z - f.y * f.y, f.z * f.y - e.x * f.x), vec3f(f.z * f.x - e.y * f.y, f.z * f.y - e.x * f.x, e.x * e.y - f.z * f.z));
    let determinant = dot(vec3f(e.x, f.z, f.y), adjugate[0]);
    let usable = abs(determinant) > 1e-30;
    let inverse_stretch = adjugate * (1.0 / (select(1.0, determinant, usable) * size));
    let stretch = mat3x3f(vec3f(d.x, s.z, s.y), vec3f(s.z, d.y, s.x), vec3f(s.y, s.x, d.z));
    return package_lib_motion_Space(mix(a.translation, b.translation, vec3f(fraction)), rotation * stretch, inverse_stretch * transpose(rotation));
}

fn package_lib_motion__1rotation_matrix(q: vec4f) -> mat3x3f {
    let d = 2.0 * q.xyz * q.xyz;
    let xy = 2.0 * q.x * q.y;
    let xz = 2.0 * q.x * q.z;
    let yz = 2.0 * q.y * q.z;
    let w = 2.0 * q.w * q.xyz;
    return mat3x3f(vec3f(1.0 - d.y - d.z, xy + w.z, xz - w.y), vec3f(xy - w.z, 1.0 - d.x - d.z, yz + w.x), vec3f(xz + w.y, yz - w.x, 1.0 - d.x - d.y));
}

const package_lib_intersect_node_WIDENING: i32 = 8;

const package_scene_packet_node_MISS: u32 = 2147483644u;

struct package_scene_packet_node_SharedNode {
    lo: vec3f,
    scale: vec3f,
    plane: vec3f,
    reference: u32
}

fn package_scene_packet_node__2load_shared_node(index: u32) -> package_scene_packet_node_SharedNode {
    let child = package_scene_packet_lanes__1packet_lane & 3u;
    let is_max = package_scene_packet_lanes__1packet_lane >= 4u;
    let row = package_scene_fetch__1node_row(4u * index + child);
    let words = vec3u(select(subgroupShuffle(row.z, 1u), subgroupShuffle(row.w, 1u), is_max), select(subgroupShuffle(row.x, 2u), subgroupShuffle(row.y, 2u), is_max), select(subgroupShuffle(row.z, 2u), subgroupShuffle(row.w, 2u), is_max));
    let is_even = (child & 1u) == 0u;
    let c01 = select(subgroupShuffle(row.y, 3u), subgroupShuffle(row.x, 3u), is_even);
    let c23 = select(subgroupShuffle(row.w, 3u), subgroupShuffle(row.z, 3u), is_even);
    return package_scene_packet_node_SharedNode(bitcast<vec3f>(vec3u(subgroupShuffle(row.x, 0u), subgroupShuffle(row.y, 0u), subgroupShuffle(row.z, 0u))), bitcast<vec3f>(vec3u(subgroupShuffle(row.w, 0u), subgroupShuffle(row.x, 1u), subgroupShuffle(row.y, 1u))), vec3f((words >> vec3u(8u * child)) & vec3u(255u)), select(c23, c01, child < 2u));
}

struct package_scene_packet_node_Children {
    reference: u32,
    count: u32
}

fn package_scene_packet_node__1order_children(node: package_scene_packet_node_SharedNode, rays: package_scene_packet_lanes_FourRays, limits: vec4i) -> package_scene_packet_node_Children {
    let lane = package_scene_packet_lanes__1packet_lane;
    let is_even = (lane & 1u) == 0u;
    let is_low = (lane & 2u) == 0u;
    let v0 = package_scene_packet_node__1closest_entry(node, rays, limits, 0u);
    let v1 = package_scene_packet_node__1closest_entry(node, rays, limits, 1u);
    let v2 = package_scene_packet_node__1closest_entry(node, rays, limits, 2u);
    let v3 = package_scene_packet_node__1closest_entry(node, rays, limits, 3u);
    let a = min(select(v1, v0, is_even), subgroupShuffle(select(v0, v1, is_even), lane ^ 1u));
    let b = min(select(v3, v2, is_even), subgroupShuffle(select(v2, v3, is_even), lane ^ 1u));
    let c = min(select(b, a, is_low), subgroupShuffle(select(a, b, is_low), lane ^ 2u));
    let closest = min(c, subgroupShuffle(c, lane ^ 4u));
    var key = (select(closest, package_scene_packet_node_MISS, node.reference == 0u) & 4294967292u) | (lane & 3u);
    var other = subgroupShuffle(key, lane ^ 1u);
    key = select(max(key, other), min(key, other), is_even == is_low);
    other = subgroupShuffle(key, lane ^ 2u);
    key = select(max(key, other), min(key, other), is_low);
    other = subgroupShuffle(key, lane ^ 1u);
    key = select(max(key, other), min(key, other), is_even);
    var count = select(0u, 1u, key < package_scene_packet_node_MISS);
    count += subgroupShuffle(count, lane ^ 1u);
    count += subgroupShuffle(count, lane ^ 2u);
    return package_scene_packet_node_Children(subgroupShuffle(node.reference, key & 3u), count);
}

fn package_scene_packet_node__1closest_entry(node: package_scene_packet_node_SharedNode, rays: package_scene_packet_lanes_FourRays, limits: vec4i, child: u32) -> u32 {
    let low = vec3f(subgroupShuffle(node.plane.x, child), subgroupShuffle(node.plane.y, child), subgroupShuffle(node.plane.z, child));
    let high = vec3f(subgroupShuffle(node.plane.x, child + 4u), subgroupShuffle(node.plane.y, child + 4u), subgroupShuffle(node.plane.z, child + 4u));
    return min(min(package_scene_packet_node_entry(node, low, high, rays.r0, limits.x), package_scene_packet_node_entry(node, low, high, rays.r1, limits.y)), min(package_scene_packet_node_entry(node, low, high, rays.r2, limits.z), package_scene_packet_node_entry(node, low, high, rays.r3, limits.w)));
}

fn package_scene_packet_node_entry(node: package_scene_packet_node_SharedNode, low: vec3f, high: vec3f, at: package_scene_primitive_TraversalRay, limit: i32) -> u32 {
    let base = (node.lo - at.ray.origin) * at.inv;
    let step = node.scale * at.inv;
    let t0 = bitcast<vec3i>(low * step + base);
    let t1 = bitcast<vec3i>(high * step + base);
    let first = min(t0, t1);
    let last = max(t0, t1);
    let near = max(max(first.x, first.y), max(first.z, 0));
    let far = min(min(last.x, last.y), last.z);
    return select(package_scene_packet_node_MISS, bitcast<u32>(near), near <= min(far + package_lib_intersect_node_WIDENING, limit));
}

fn package_scene_packet_leaf__1is_common(reference: u32) -> bool {
    return (reference & package_types_LEAF) != 0u && reference < package_types_INSTANCE && package_scene_packet_leaf__1has_shapes(reference) == package_bindings__1MOSTLY_SHAPES;
}

fn package_scene_packet_leaf__1is_rare(reference: u32) -> bool {
    return (reference & package_types_LEAF) != 0u && reference < package_types_INSTANCE && package_scene_packet_leaf__1has_shapes(reference) != package_bindings__1MOSTLY_SHAPES;
}

fn package_scene_packet_leaf__1has_shapes(reference: u32) -> bool {
    return (reference & package_types_SHAPE) != 0u;
}

struct package_scene_packet_leaf_Next {
    reference: u32,
    is_last: bool
}

fn package_scene_packet_leaf_after(reference: u32, top: u32) -> package_scene_packet_leaf_Next {
    let left = (reference & package_types__2LEAF_COUNT_MASK) / package_types__2LEAF_COUNT_ONE;
    let tested = select(package_scene_packet_leaf__1tested_triangles(reference), 1u, package_scene_packet_leaf__1has_shapes(reference));
    let is_last = left < tested;
    return package_scene_packet_leaf_Next(select(reference - tested * (package_types__2LEAF_COUNT_ONE - 1u), top, is_last), is_last);
}

fn package_scene_packet_leaf__1tested_triangles(reference: u32) -> u32 {
    return min((reference & package_types__2LEAF_COUNT_MASK) / package_types__2LEAF_COUNT_ONE + 1u, 2u);
}

fn package_scene_packet_leaf__1meet_common(rays: package_scene_packet_lanes_FourRays, hits: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    if (package_bindings__1MOSTLY_SHAPES) {
        return package_scene_packet_leaf__1meet_shape(rays, hits, reference);
    }
    return package_scene_packet_leaf__1meet_triangles(rays, hits, reference);
}

fn package_scene_packet_leaf__1meet_rare(rays: package_scene_packet_lanes_FourRays, hits: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    if (package_bindings__1MOSTLY_SHAPES) {
        return package_scene_packet_leaf__1meet_triangles(rays, hits, reference);
    }
    return package_scene_packet_leaf__1meet_shape(rays, hits, reference);
}

fn package_scene_packet_leaf__1meet_triangles(rays: package_scene_packet_lanes_FourRays, before: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    let count = package_scene_packet_leaf__1tested_triangles(reference);
    let first = select(reference & package_types__2LEAF_FIRST_MASK, 0u, package_scene_packet_leaf__1has_shapes(reference));
    let row = package_scene_fetch__1triangle_row(3u * first + package_scene_packet_lanes__1packet_lane);
    if (package_bindings__1COUNT_STEPS) {
        package_scene_loops__1primitives_tested += count;
    }
    let hits = package_scene_packet_leaf__1meet_triangle(rays, before, package_scene_packet_leaf__1triangle_of(row, 0u), first, true);
    return package_scene_packet_leaf__1meet_triangle(rays, hits, package_scene_packet_leaf__1triangle_of(row, 3u), first + 1u, count > 1u);
}

fn package_scene_packet_leaf__1triangle_of(row: vec4u, lane: u32) -> package_types_PackedTriangle {
    return package_types_PackedTriangle(package_scene_packet_leaf__1corner_of(row, lane), 0u, package_scene_packet_leaf__1corner_of(row, lane + 1u), 0u, package_scene_packet_leaf__1corner_of(row, lane + 2u), 0u);
}

fn package_scene_packet_leaf__1row_of(row: vec4u, lane: u32) -> vec4u {
    return vec4u(subgroupShuffle(row.x, lane), subgroupShuffle(row.y, lane), subgroupShuffle(row.z, lane), subgroupShuffle(row.w, lane));
}

fn package_scene_packet_leaf__1corner_of(row: vec4u, lane: u32) -> vec3f {
    return bitcast<vec3f>(vec3u(subgroupShuffle(row.x, lane), subgroupShuffle(row.y, lane), subgroupShuffle(row.z, lane)));
}

fn package_scene_packet_leaf__1meet_triangle(rays: package_scene_packet_lanes_FourRays, before: package_scene_packet_lanes_FourHits, triangle: package_types_PackedTriangle, primitive: u32, is_there: bool) -> package_scene_packet_lanes_FourHits {
    return package_scene_packet_lanes_FourHits(package_scene_packet_lanes__1closer_two(rays.r0, before.h0, package_scene_packet_leaf__1candidate_of(rays.r0, triangle, is_there), primitive), package_scene_packet_lanes__1closer_two(rays.r1, before.h1, package_scene_packet_leaf__1candidate_of(rays.r1, triangle, is_there), primitive), package_scene_packet_lanes__1closer_two(rays.r2, before.h2, package_scene_packet_leaf__1candidate_of(rays.r2, triangle, is_there), primitive), package_scene_packet_lanes__1closer_two(rays.r3, before.h3, package_scene_packet_leaf__1candidate_of(rays.r3, triangle, is_there), primitive));
}

fn package_scene_packet_leaf__1candidate_of(at: package_scene_primitive_TraversalRay, triangle: package_types_PackedTriangle, is_there: bool) -> package_types_Candidate {
    let candidate = package_scene_primitive__1test_triangle(at.ray, triangle, at.shear);
    return package_types_Candidate(candidate.hit & is_there, candidate.t, candidate.b1, candidate.b2);
}

fn package_scene_packet_leaf__1meet_shape(rays: package_scene_packet_lanes_FourRays, before: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    let index = select(0u, reference & package_types__2LEAF_FIRST_MASK, package_scene_packet_leaf__1has_shapes(reference));
    let primitive = package_types_SHAPE | index;
    let row = package_scene_fetch__1triangle_row(package_scene_fetch__1shape_row + package_types__1SHAPE_ROWS * index + package_scene_packet_lanes__1packet_lane);
    if (package_bindings__1COUNT_STEPS) {
        package_scene_loops__1primitives_tested += 1u;
    }
    let shape = package_scene_fetch__1shape_of(package_scene_packet_leaf__1row_of(row, 0u), package_scene_packet_leaf__1row_of(row, 1u), package_scene_packet_leaf__1row_of(row, 2u), package_scene_packet_leaf__1row_of(row, 3u), package_scene_packet_leaf__1row_of(row, 4u));
    return package_scene_packet_lanes_FourHits(package_scene_packet_lanes__1closer_two(rays.r0, before.h0, package_scene_shape__1test_shape(rays.r0.ray, shape), primitive), package_scene_packet_lanes__1closer_two(rays.r1, before.h1, package_scene_shape__1test_shape(rays.r1.ray, shape), primitive), package_scene_packet_lanes__1closer_two(rays.r2, before.h2, package_scene_shape__1test_shape(rays.r2.ray, shape), primitive), package_scene_packet_lanes__1closer_two(rays.r3, before.h3, package_scene_shape__1test_shape(rays.r3.ray, shape), primitive));
}

const package_scene_shape_SPHERES: u32 = 1u << package_types__1SHAPE_SPHERE;

const package_scene_shape_DISCS: u32 = 1u << package_types__1SHAPE_DISC;

const package_scene_shape_RECTANGLES: u32 = 1u << package_types__1SHAPE_RECTANGLE;

const package_scene_shape_BOXES: u32 = 1u << package_types__1SHAPE_BOX;

const package_scene_shape_CONES: u32 = 1u << package_types__1SHAPE_CONE;

const package_scene_shape_TORI: u32 = 1u << package_types__1SHAPE_TORUS;

const package_scene_shape_ELLIPSOIDS: u32 = 1u << package_types__1SHAPE_ELLIPSOID;

const package_scene_shape_GLOBES: u32 = 1u << package_types__1SHAPE_GLOBE;

fn package_scene_shape__1test_shape(ray: package_types_Ray, shape: package_types_PackedShape) -> package_types_Candidate {
    if (package_bindings__1SHAPE_KINDS == package_scene_shape_SPHERES) {
        return package_lib_intersect_sphere__1intersect_sphere(ray, shape.position, shape.size0);
    }
    var candidate = package_types_Candidate(false, 0.0, 0.0, 0.0);
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_SPHERES) != 0u && shape.kind == package_types__1SHAPE_SPHERE) {
        candidate = package_lib_intersect_sphere__1intersect_sphere(ray, shape.position, shape.size0);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_GLOBES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_GLOBES || shape.kind == package_types__1SHAPE_GLOBE)) {
        candidate = package_lib_intersect_globe__1intersect_globe(ray, shape.position, shape.row_y, shape.size0);
    }
    let local = package_lib_canonical__1canonical_ray(ray, shape);
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_DISCS) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_DISCS || shape.kind == package_types__1SHAPE_DISC)) {
        candidate = package_lib_intersect_disc__1intersect_disc(local, shape.size0);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_RECTANGLES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_RECTANGLES || shape.kind == package_types__1SHAPE_RECTANGLE)) {
        candidate = package_lib_intersect_rectangle__1intersect_rectangle(local);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_BOXES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_BOXES || shape.kind == package_types__1SHAPE_BOX)) {
        candidate = package_lib_intersect_box__1intersect_box(local);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_CONES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_CONES || shape.kind == package_types__1SHAPE_CONE)) {
        candidate = package_lib_intersect_cone__1intersect_cone(local, shape.size0, shape.size1, (shape.flags & package_types__1SHAPE_CAPPED) != 0u);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_TORI) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_TORI || shape.kind == package_types__1SHAPE_TORUS)) {
        candidate = package_lib_intersect_torus__1intersect_torus(local, shape.size0);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_ELLIPSOIDS) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_ELLIPSOIDS || shape.kind == package_types__1SHAPE_ELLIPSOID)) {
        candidate = package_lib_intersect_ellipsoid__1intersect_ellipsoid(local);
    }
    return candidate;
}

fn package_lib_intersect_sphere__1intersect_sphere(ray: package_types_Ray, center: vec3f, radius: f32) -> package_types_Candidate {
    let f = ray.origin - center;
    let a = dot(ray.direction, ray.direction);
    let b = -dot(f, ray.direction);
    let nearest = f + (b / a) * ray.direction;
    let discriminant = radius * radius - dot(nearest, nearest);
    if (discriminant < 0.0) {
        return package_types_Candidate(false, 0.0, 0.0, 0.0);
    }
    let c = dot(f, f) - radius * radius;
    let q = b + select(-1.0, 1.0, b >= 0.0) * sqrt(a * discriminant);
    let t0 = select(0.0, c / select(1.0, q, abs(q) > 1e-30), abs(q) > 1e-30);
    let t1 = q / a;
    let near = min(t0, t1);
    let t = select(max(t0, t1), near, near > 0.0);
    return package_types_Candidate(t > 0.0, t, 0.0, 0.0);
}

fn package_lib_intersect_globe__1intersect_globe(ray: package_types_Ray, anchor: vec3f, n: vec3f, curvature: f32) -> package_types_Candidate {
    let w = ray.origin - anchor;
    let f = n + curvature * w;
    let c = curvature * dot(w, w) + 2.0 * dot(n, w);
    let length2 = dot(ray.direction, ray.direction);
    let a = curvature * length2;
    let b = -dot(f, ray.direction);
    let nearest = f + (b / length2) * ray.direction;
    let is_near = abs(curvature * c) < 1.0;
    let discriminant = select(length2 * (1.0 - dot(nearest, nearest)), b * b - a * c, is_near);
    if (discriminant < 0.0) {
        return package_types_Candidate(false, 0.0, 0.0, 0.0);
    }
    let q = b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant);
    let t0 = select(0.0, c / select(1.0, q, abs(q) > 1e-30), abs(q) > 1e-30);
    let t1 = q / a;
    let near = min(t0, t1);
    let t = select(max(t0, t1), near, near > 0.0);
    return package_types_Candidate(t > 0.0, t, 0.0, 0.0);
}

const package_lib_canonical__1TWO_PI: f32 = 6.2831855;

struct package_lib_canonical_Approach {
    origin: vec3f,
    start: f32,
    direction: vec3f,
    t_per_length: f32,
    near: bool
}

fn package_lib_canonical__1canonical_vector(shape: package_types_PackedShape, v: vec3f) -> vec3f {
    return vec3f(dot(shape.row_x, v), dot(shape.row_y, v), dot(shape.row_z, v));
}

fn package_lib_canonical__1canonical_ray(ray: package_types_Ray, shape: package_types_PackedShape) -> package_types_Ray {
    return package_types_Ray(package_lib_canonical__1canonical_vector(shape, ray.origin - shape.position), ray.t_max, package_lib_canonical__1canonical_vector(shape, ray.direction), ray.leaving, ray.leaving_instance);
}

fn package_lib_canonical_approach(ray: package_types_Ray, center: vec3f, reach: f32) -> package_lib_canonical_Approach {
    let size = abs(ray.direction);
    let largest = max(max(size.x, max(size.y, size.z)), 1e-30);
    let scaled = ray.direction / largest;
    let inv_length = inverseSqrt(max(dot(scaled, scaled), 1e-30));
    let direction = scaled * inv_length;
    let start = max(dot(center - ray.origin, direction) - reach, 0.0);
    let origin = ray.origin + start * direction;
    let off = abs(origin - center);
    let near = max(off.x, max(off.y, off.z)) <= 2.0 * reach;
    return package_lib_canonical_Approach(select(center + reach, origin, near), start, direction, inv_length / largest, near);
}

fn package_lib_canonical__1approached_t(near: package_lib_canonical_Approach, s: f32) -> f32 {
    return (near.start + s) * near.t_per_length;
}

fn package_lib_intersect_disc__1intersect_disc(ray: package_types_Ray, hole: f32) -> package_types_Candidate {
    let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
    let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
    let p = clamp(ray.origin.xz + t * ray.direction.xz, vec2f(-2.0), vec2f(2.0));
    let distance = dot(p, p);
    return package_types_Candidate(steep & (t > 0.0) & (distance <= 1.0) & (distance >= hole * hole), t, 0.0, 0.0);
}

fn package_lib_intersect_rectangle__1intersect_rectangle(ray: package_types_Ray) -> package_types_Candidate {
    let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
    let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
    let way = t * ray.direction.xz;
    let slack = 4.0 * package_lib_numeric_ROUNDING * (abs(ray.origin.xz) + abs(way));
    let inside = all(abs(ray.origin.xz + way) <= 1.0 + slack);
    return package_types_Candidate(steep & (t > 0.0) & inside, t, 0.0, 0.0);
}

fn package_lib_intersect_box__1intersect_box(ray: package_types_Ray) -> package_types_Candidate {
    let size = abs(ray.direction);
    let largest = max(max(size.x, max(size.y, size.z)), 1e-30);
    let inv = package_lib_numeric__1safe_reciprocal(ray.direction / largest);
    let origin = clamp(ray.origin, vec3f(-1e18), vec3f(1e18));
    let t0 = (-1.0 - origin) * inv;
    let t1 = (1.0 - origin) * inv;
    let enters = min(t0, t1);
    let leaves = max(t0, t1);
    let enter = max(enters.x, max(enters.y, enters.z));
    let leave = min(leaves.x, min(leaves.y, leaves.z));
    let from_outside = enter > 0.0;
    let s = select(leave, enter, from_outside);
    let planes = select(leaves, enters, from_outside);
    let axis = select(select(2u, 1u, planes.y == s), 0u, planes.x == s);
    let positive = (inv[axis] < 0.0) == from_outside;
    let side = f32(axis) + select(0.0, 3.0, positive);
    let hit = (enter <= leave) & (s > 0.0);
    return package_types_Candidate(hit, select(0.0, s, hit) / largest, side, 0.0);
}

const package_lib_intersect_cone_FAR: f32 = 1e30;

const package_lib_intersect_cone_SIDE: f32 = 0.0;

const package_lib_intersect_cone_BOTTOM: f32 = 1.0;

const package_lib_intersect_cone_TOP: f32 = 2.0;

fn package_lib_intersect_cone__1intersect_cone(ray: package_types_Ray, bottom: f32, top: f32, capped: bool) -> package_types_Candidate {
    let near = package_lib_canonical_approach(ray, vec3f(0.0, 0.5, 0.0), 1.5);
    let o = near.origin;
    let d = near.direction;
    let slope = top - bottom;
    let radius = bottom + slope * o.y;
    let exact_a = dot(d.xz, d.xz) - slope * slope * d.y * d.y;
    let a = select(1e-12, exact_a, abs(exact_a) > 1e-12);
    let b = dot(o.xz, d.xz) - slope * radius * d.y;
    let c = dot(o.xz, o.xz) - radius * radius;
    let turn = o.x * d.z - o.z * d.x;
    let lean = radius * d.xz - slope * d.y * o.xz;
    let by_determinants = dot(lean, lean) - turn * turn - (a - exact_a) * c;
    let discriminant = select(by_determinants, b * b - a * c, a * c <= 0.0);
    let root = sqrt(max(discriminant, 0.0));
    let q = -(b + select(-root, root, b >= 0.0));
    let usable = abs(q) > 1e-20;
    let r1 = q / a;
    let r2 = select(0.0, c / select(1.0, q, usable), usable);
    let low = min(r1, r2);
    let high = max(r1, r2);
    let steep = a < 0.0;
    let widens = slope * d.y > 0.0;
    let side_in = select(low, select(-package_lib_intersect_cone_FAR, high, widens), steep);
    let side_out = select(high, select(low, package_lib_intersect_cone_FAR, widens), steep);
    let level = abs(d.y) < 1e-18;
    let inv_y = 1.0 / select(d.y, select(1e-18, -1e-18, d.y < 0.0), level);
    let y0 = -o.y * inv_y;
    let y1 = (1.0 - o.y) * inv_y;
    let slab_in = min(y0, y1);
    let slab_out = max(y0, y1);
    let enter = max(slab_in, side_in);
    let leave = min(slab_out, side_out);
    let enters_side = side_in >= slab_in;
    let leaves_side = side_out <= slab_out;
    let takes_enter = (near.start + enter > 0.0) & (enters_side | capped);
    let takes_leave = (near.start + leave > 0.0) & (leaves_side | capped);
    let met = (steep | (discriminant >= 0.0)) & (enter <= leave);
    let hit = near.near & met & (takes_enter | takes_leave);
    let rough = select(0.0, select(leave, enter, takes_enter), hit);
    let is_side = select(leaves_side, enters_side, takes_enter);
    let end = select(package_lib_intersect_cone_BOTTOM, package_lib_intersect_cone_TOP, (d.y > 0.0) != takes_enter);
    let s = select(rough, package_lib_intersect_cone_polish(o, d, bottom, slope, rough), is_side);
    let t = package_lib_canonical__1approached_t(near, s);
    return package_types_Candidate(hit & (t > 0.0), t, select(end, package_lib_intersect_cone_SIDE, is_side), 0.0);
}

fn package_lib_intersect_cone_polish(o: vec3f, d: vec3f, bottom: f32, slope: f32, s: f32) -> f32 {
    let p = o + s * d;
    let off_axis = length(p.xz);
    let rate = dot(p.xz, d.xz) / max(off_axis, 1e-18) - slope * d.y;
    let usable = abs(rate) > 0.001;
    let step = (off_axis - (bottom + slope * p.y)) / select(1.0, rate, usable);
    return s - clamp(select(0.0, step, usable), -0.001, 0.001);
}

const package_lib_intersect_torus__1MOST_ROUNDS: u32 = 40u;

const package_lib_intersect_torus_NARROW: f32 = 1.2e-7;

fn package_lib_intersect_torus__1torus_distance(p: vec3f, minor: f32) -> f32 {
    return length(vec2f(length(p.xz) - 1.0, p.y)) - minor;
}

fn package_lib_intersect_torus_polish(s: f32, p: f32, q: f32) -> f32 {
    let slope = 3.0 * s * s + p;
    let steep = abs(slope) > 0.001;
    return s - clamp(select(0.0, ((s * s + p) * s + q) / select(1.0, slope, steep), steep), -0.02, 0.02);
}

fn package_lib_intersect_torus__1cubic_zeros(p: f32, q: f32) -> vec3f {
    let third = p / 3.0;
    let half = 0.5 * q;
    let discriminant = half * half + third * third * third;
    let cube = abs(half) + sqrt(max(discriminant, 0.0));
    let large = -select(-1.0, 1.0, half >= 0.0) * select(0.0, exp2(log2(max(cube, 1e-30)) / 3.0), cube > 1e-30);
    let small = select(0.0, -third / select(1.0, large, large != 0.0), large != 0.0);
    let one = package_lib_intersect_torus_polish(large + small, p, q);
    let size = sqrt(max(-third, 0.0));
    let usable = size > 1e-10;
    let cosine = clamp(select(0.0, -half / select(1.0, size * size * size, usable), usable), -1.0, 1.0);
    let angle = acos(cosine) / 3.0;
    let a = package_lib_intersect_torus_polish(2.0 * size * cos(angle + package_lib_canonical__1TWO_PI / 3.0), p, q);
    let b = package_lib_intersect_torus_polish(2.0 * size * cos(angle - package_lib_canonical__1TWO_PI / 3.0), p, q);
    let c = package_lib_intersect_torus_polish(2.0 * size * cos(angle), p, q);
    let three = vec3f(min(a, min(b, c)), max(min(a, b), min(max(a, b), c)), max(a, max(b, c)));
    return select(three, vec3f(one), discriminant > 0.0);
}

fn package_lib_intersect_torus__1intersect_torus(ray: package_types_Ray, minor: f32) -> package_types_Candidate {
    let outer = 1.0 + minor;
    let near = package_lib_canonical_approach(ray, vec3f(0.0), 1.5 * outer);
    let o = near.origin;
    let d = near.direction;
    let middle = -dot(o, d);
    let nearest = o + middle * d;
    let apart = dot(nearest, nearest);
    let ball = 1.0001 * outer;
    let half_chord = sqrt(max(ball * ball - apart, 0.0));
    let start = max(middle - half_chord, 0.0);
    let end = middle + half_chord;
    let zeros = middle + package_lib_intersect_torus__1cubic_zeros(apart - 1.0 - minor * minor + 2.0 * d.y * d.y, 2.0 * nearest.y * d.y);
    let cuts = vec4f(clamp(zeros, vec3f(start), vec3f(max(end, start))), end);
    let outside = package_lib_intersect_torus__1torus_distance(o + start * d, minor) >= 0.0;
    let changes = vec4<bool>((package_lib_intersect_torus__1torus_distance(o + cuts.x * d, minor) >= 0.0) != outside, (package_lib_intersect_torus__1torus_distance(o + cuts.y * d, minor) >= 0.0) != outside, (package_lib_intersect_torus__1torus_distance(o + cuts.z * d, minor) >= 0.0) != outside, (package_lib_intersect_torus__1torus_distance(o + cuts.w * d, minor) >= 0.0) != outside);
    let found = near.near & (apart <= ball * ball) & (end > start) & any(changes);
    let last = select(select(select(cuts.w, cuts.z, changes.z), cuts.y, changes.y), cuts.x, changes.x);
    let first = select(select(select(cuts.z, cuts.y, changes.z), cuts.x, changes.y), start, changes.x);
    let s = package_lib_intersect_torus__1root_between(o, d, minor, select(last, first, found), last, outside);
    let t = package_lib_canonical__1approached_t(near, s);
    return package_types_Candidate(found & (t > 0.0), t, 0.0, 0.0);
}

fn package_lib_intersect_torus__1root_between(o: vec3f, d: vec3f, minor: f32, first: f32, last: f32, outside: bool) -> f32 {
    var low = first;
    var high = last;
    var s = 0.5 * (first + last);
    var moved = high - low;
    var rounds = 0u;
    loop {
        let p = o + s * d;
        let ring = length(p.xz);
        let from_ring = vec2f(ring - 1.0, p.y);
        let to_middle = length(from_ring);
        let distance = to_middle - minor;
        let before = (distance >= 0.0) == outside;
        low = select(low, s, before);
        high = select(s, high, before);
        let ring_slope = dot(p.xz, d.xz) / max(ring, 1e-20);
        let slope = dot(from_ring, vec2f(ring_slope, d.y)) / max(to_middle, 1e-20);
        let usable = abs(slope) > 1e-6;
        let newton = s - distance / select(1.0, slope, usable);
        let takes_newton = usable & (newton > low) & (newton < high) & (abs(newton - s) < 0.5 * moved);
        let next = select(0.5 * (low + high), newton, takes_newton);
        moved = abs(next - s);
        s = next;
        rounds += 1u;
        continuing {
        
            break if (moved <= package_lib_intersect_torus_NARROW * (1.0 + abs(s))) | (rounds >= package_lib_intersect_torus__1MOST_ROUNDS);
        }
    }
    return s;
}

fn package_lib_intersect_ellipsoid__1intersect_ellipsoid(ray: package_types_Ray) -> package_types_Candidate {
    let near = package_lib_canonical_approach(ray, vec3f(0.0), 1.5);
    let found = package_lib_intersect_sphere__1intersect_sphere(package_types_Ray(near.origin, ray.t_max, near.direction, package_types_NONE, ray.leaving_instance), vec3f(0.0), 1.0);
    return package_types_Candidate(near.near & found.hit, package_lib_canonical__1approached_t(near, found.t), 0.0, 0.0);
}

fn package_lib_intersect__1triangle_plane__2intersect_triangle_plane(ray: package_types_Ray, v0: vec3f, v1: vec3f, v2: vec3f) -> package_types_Candidate {
    let e1 = v1 - v0;
    let e2 = v2 - v0;
    let n = cross(e1, e2);
    let slope = dot(n, ray.direction);
    let area = dot(n, n);
    let usable = (abs(slope) > 4.0 * package_lib_numeric_ROUNDING * length(e1) * length(e2)) & (area > 1e-36);
    let t = dot(n, v0 - ray.origin) / select(1.0, slope, usable);
    let w = ray.origin + t * ray.direction - v0;
    let b1 = dot(cross(w, e2), n) / select(1.0, area, usable);
    let b2 = dot(cross(e1, w), n) / select(1.0, area, usable);
    let inside = (b1 >= 0.0) & (b2 >= 0.0) & (b1 + b2 <= 1.0);
    return package_types_Candidate(usable & inside & (t > 0.0), t, b1, b2);
}

fn package_lib_intersect__2triangle_moller_trumbore__3intersect_triangle_moller_trumbore(ray: package_types_Ray, v0: vec3f, v1: vec3f, v2: vec3f) -> package_types_Candidate {
    let e1 = v1 - v0;
    let e2 = v2 - v0;
    let p = cross(ray.direction, e2);
    let det = dot(e1, p);
    let usable = abs(det) > 4.0 * package_lib_numeric_ROUNDING * length(e1) * length(e2);
    let inv_det = 1.0 / select(1.0, det, usable);
    let s = ray.origin - v0;
    let b1 = inv_det * dot(s, p);
    let q = cross(s, e1);
    let b2 = inv_det * dot(ray.direction, q);
    let t = inv_det * dot(e2, q);
    let inside = (b1 >= 0.0) & (b2 >= 0.0) & (b1 + b2 <= 1.0);
    return package_types_Candidate(usable & inside & (t > 0.0), t, b1, b2);
}
