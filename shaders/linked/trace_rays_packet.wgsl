@compute @workgroup_size(16, 1, 1)
fn trace_rays(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32, @builtin(subgroup_invocation_id) packet_lane: u32) {
	lanes__start_packets(packet_lane);
	fetch__load_starts();
	let first = 64u * tile__permuted_group(group.x, bindings__dispatch.group_count, bindings__dispatch.group_stride);
	var rays = rays__dead_rays();
	var k = 0u;
	loop {
		rays = rays__ray_set(rays, k, query__load_query_ray(first + pixels__place_of(lane, k)).ray);
		continuing {
			k += 1u;
			break if k >= rays__RAYS_PER_LANE;
		}
	}
	loops__cut_off |= k < rays__RAYS_PER_LANE;
	let hits = walk__packet_hits(rays, bindings__ANY_HIT);
	k = 0u;
	loop {
		query__store_hit(first + pixels__place_of(lane, k), rays__hit_at(hits, k));
		continuing {
			k += 1u;
			break if k >= rays__RAYS_PER_LANE;
		}
	}
	loops__cut_off |= k < rays__RAYS_PER_LANE;
	dispatch__report_cut_off();
	groups__count_group(group, lane);
}

var<private> lanes__packet_lane: u32;

struct lanes__FourRays {
	r0: primitive__TraversalRay,
	r1: primitive__TraversalRay,
	r2: primitive__TraversalRay,
	r3: primitive__TraversalRay
}

struct lanes__TwoHits {
	hit: tracing__Hit,
	second: tracing__Hit
}

struct lanes__FourHits {
	h0: lanes__TwoHits,
	h1: lanes__TwoHits,
	h2: lanes__TwoHits,
	h3: lanes__TwoHits
}

fn lanes__start_packets(lane: u32) {
	lanes__packet_lane = lane;
}

fn lanes__any_lane_of_packet(condition: bool) -> bool {
	return lanes__or_of_packet(select(0u, 1u, condition)) != 0u;
}

fn lanes__or_of_packet(bits: u32) -> u32 {
	var all = bits;
	all |= subgroupShuffle(all, lanes__packet_lane ^ 1u);
	all |= subgroupShuffle(all, lanes__packet_lane ^ 2u);
	all |= subgroupShuffle(all, lanes__packet_lane ^ 4u);
	if (bindings__PACKET_LANES == 16u) {
		all |= subgroupShuffle(all, lanes__packet_lane ^ 8u);
	}
	return all;
}

fn lanes__closer_two(at: primitive__TraversalRay, before: lanes__TwoHits, candidate: tracing__Candidate, primitive: u32) -> lanes__TwoHits {
	primitive__runner_up = before.second;
	let hit = primitive__closer_of(at, before.hit, candidate, primitive);
	return lanes__TwoHits(hit, primitive__runner_up);
}

var<private> fetch__root: u32;

var<private> fetch__shape_row: u32;

var<private> fetch__light_row: u32;

var<private> fetch__instance_row: u32;

var<private> fetch__key_row: u32;

var<private> fetch__texture_row: u32;

var<private> fetch__uv_row: u32;

var<private> fetch__first_plane: u32;

var<private> fetch__end_plane: u32;

fn fetch__load_starts() {
	fetch__root = bindings__frame.root;
	fetch__shape_row = bindings__frame.shape_row;
	fetch__light_row = bindings__frame.light_row;
	fetch__instance_row = bindings__frame.instance_row;
	fetch__key_row = bindings__frame.key_row;
	fetch__texture_row = types__MATERIAL_ROWS * bindings__frame.material_count;
	fetch__uv_row = bindings__frame.vertex_count;
	fetch__first_plane = bindings__frame.shape_count;
	fetch__end_plane = bindings__frame.shape_count + bindings__frame.plane_count;
}

fn fetch__load_instance(index: u32) -> types__PackedInstance {
	let row = fetch__instance_row + types__INSTANCE_ROWS * index;
	let r0 = rows__node_row(row);
	let r1 = rows__node_row(row + 1u);
	let r2 = rows__node_row(row + 2u);
	let r3 = rows__node_row(row + 3u);
	let r4 = rows__node_row(row + 4u);
	let r5 = rows__node_row(row + 5u);
	let r6 = rows__node_row(row + 6u);
	return types__PackedInstance(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec3f>(r2.xyz), r2.w, bitcast<vec3f>(r3.xyz), r3.w, bitcast<vec3f>(r4.xyz), r4.w, bitcast<vec3f>(r5.xyz), r5.w, bitcast<vec3f>(r6.xyz), r6.w, bitcast<vec4f>(rows__node_row(row + 7u)), bitcast<vec4f>(rows__node_row(row + 8u)), bitcast<vec4f>(rows__node_row(row + 9u)));
}

fn fetch__load_key(index: u32) -> types__PackedKey {
	let row = fetch__key_row + types__KEY_ROWS * index;
	return types__PackedKey(bitcast<vec3f>(rows__node_row(row).xyz), 0u, bitcast<vec4f>(rows__node_row(row + 1u)), bitcast<vec3f>(rows__node_row(row + 2u).xyz), 0u, bitcast<vec3f>(rows__node_row(row + 3u).xyz), 0u);
}

fn fetch__load_triangle(index: u32) -> types__PackedTriangle {
	let row = 3u * index;
	let r0 = rows__triangle_row(row);
	let r1 = rows__triangle_row(row + 1u);
	let r2 = rows__triangle_row(row + 2u);
	return types__PackedTriangle(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec3f>(r2.xyz), r2.w);
}

fn fetch__load_shape(index: u32) -> types__PackedShape {
	let row = fetch__shape_row + types__SHAPE_ROWS * index;
	return fetch__shape_of(rows__triangle_row(row), rows__triangle_row(row + 1u), rows__triangle_row(row + 2u), rows__triangle_row(row + 3u), rows__triangle_row(row + 4u));
}

fn fetch__shape_of(r0: vec4u, r1: vec4u, r2: vec4u, r3: vec4u, r4: vec4u) -> types__PackedShape {
	return types__PackedShape(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), bitcast<f32>(r1.w), bitcast<vec3f>(r2.xyz), bitcast<f32>(r2.w), bitcast<vec3f>(r3.xyz), r3.w, r4.x, r4.y, 0u, 0u);
}

@group(1) @binding(0)
var<storage, read> bindings__frame: types__PackedFrame;

@group(1) @binding(1)
var<storage, read_write> bindings__dispatch: types__PackedDispatch;

@group(2) @binding(0)
var<storage, read_write> bindings__hits: array<vec4u>;

override bindings__TRIANGLE_TEST: u32 = 0u;

override bindings__HAS_TRIANGLES: bool = false;

override bindings__TRIANGLES_OUTSIDE_TREE: u32 = 0u;

override bindings__SHAPES_OUTSIDE_TREE: bool = false;

override bindings__HAS_SHAPES: bool = false;

override bindings__HAS_PLANES: bool = false;

override bindings__MOSTLY_SHAPES: bool = false;

override bindings__SHAPE_KINDS: u32 = 0u;

override bindings__HAS_INSTANCES: bool = false;

override bindings__HAS_MOTION: bool = false;

override bindings__HAS_CONTACT: bool = false;

override bindings__HAS_SECTION: bool = false;

override bindings__COUNT_STEPS: bool = false;

override bindings__ANY_HIT: bool = false;

override bindings__PACKET_LANES: u32 = 0u;

const types__NONE: u32 = 4294967295u;

const types__LEAF: u32 = 2147483648u;

const types__SHAPE: u32 = 1073741824u;

const types__LEAF_COUNT_ONE: u32 = 134217728u;

const types__LEAF_COUNT_MASK: u32 = 939524096u;

const types__LEAF_FIRST_MASK: u32 = 134217727u;

const types__INSTANCE: u32 = 4160749568u;

const types__NO_INSTANCE: u32 = 1048575u;

const types__CUT_OFF_LOOP: u32 = 1u;

const types__CUT_OFF_STACK: u32 = 2u;

const types__INSTANCE_ROWS: u32 = 10u;

const types__KEY_ROWS: u32 = 4u;

const types__SHAPE_ROWS: u32 = 5u;

const types__IMAGE_WIDTH_LOG2: u32 = 12u;

const types__SHAPE_SPHERE: u32 = 0u;

const types__SHAPE_DISC: u32 = 2u;

const types__SHAPE_RECTANGLE: u32 = 3u;

const types__SHAPE_BOX: u32 = 4u;

const types__SHAPE_CONE: u32 = 5u;

const types__SHAPE_TORUS: u32 = 6u;

const types__SHAPE_ELLIPSOID: u32 = 7u;

const types__SHAPE_GLOBE: u32 = 8u;

const types__SHAPE_CAPPED: u32 = 1u;

const types__MATERIAL_ROWS: u32 = 20u;

const types__TRIANGLE_TEST_PLANE: u32 = 0u;

const types__TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1u;

struct types__PackedTriangle {
	v0: vec3f,
	i0: u32,
	v1: vec3f,
	i1: u32,
	v2: vec3f,
	i2: u32
}

struct types__PackedShape {
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

struct types__PackedInstance {
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
	next_key: u32,
	pattern_x: vec4f,
	pattern_y: vec4f,
	pattern_z: vec4f
}

struct types__PackedKey {
	translation: vec3f,
	_pad0: u32,
	rotation: vec4f,
	stretch: vec3f,
	_pad1: u32,
	shear: vec3f,
	_pad2: u32
}

struct types__PackedCamera {
	origin: vec3f,
	lens_radius: f32,
	forward: vec3f,
	focus_distance: f32,
	right: vec3f,
	blade_rotation: f32,
	up: vec3f,
	blade_count: u32
}

struct types__PackedFrame {
	camera: types__PackedCamera,
	clip: vec2f,
	solid_row: u32,
	solid_count: u32,
	section: vec3f,
	section_offset: f32,
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
	background_picture: u32,
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
	shape_row: u32,
	deformation_key_count: u32,
	emitter_row: u32,
	emitter_count: u32,
	emitter_power: f32,
	environment_first: u32,
	environment_width: u32,
	environment_share: f32,
	albedo_first: u32,
	cluster_row: u32,
	light_root: u32,
	lights_share: f32,
	emitter_group: u32,
	sun: vec3f,
	sun_chance: f32
}

struct types__PackedDispatch {
	picture_width: u32,
	picture_height: u32,
	tile_x: u32,
	tile_y: u32,
	tile_width: u32,
	tile_height: u32,
	group_count: u32,
	group_stride: u32,
	first_group: u32,
	end_group: u32,
	grid_width: u32,
	first_sample: u32,
	end_sample: u32,
	seed: u32,
	shared_samples: u32,
	max_depth: u32,
	backdrop: vec3f,
	min_throughput: f32,
	light_samples: f32,
	footprint: f32,
	blocks: u32,
	_pad0: u32,
	counters: types__PackedCounters
}

struct types__PackedCounters {
	nonfinite_samples: atomic<u32>,
	cut_off: atomic<u32>,
	cut_off_trees: atomic<u32>,
	cut_throughput: atomic<u32>,
	clamped_light: atomic<u32>,
	clamped_light_high: atomic<u32>,
	kept_light: atomic<u32>,
	kept_light_high: atomic<u32>,
	primary: atomic<u32>,
	primary_hits: atomic<u32>,
	shadow: atomic<u32>,
	shadow_blocked: atomic<u32>,
	reflection: atomic<u32>,
	reflection_hits: atomic<u32>,
	refraction: atomic<u32>,
	refraction_hits: atomic<u32>,
	groups_done: array<array<atomic<u32>, 16>, 8>
}

fn tile__divided(dividend: u32, divisor: u32) -> vec2u {
	let quotient = u32(f32(dividend) / f32(divisor));
	let rest = bitcast<i32>(dividend - quotient * divisor);
	let correction = select(0, 1, rest >= i32(divisor)) - select(0, 1, rest < 0);
	return vec2u(quotient + bitcast<u32>(correction), bitcast<u32>(rest - correction * i32(divisor)));
}

fn tile__permuted_group(index: u32, group_count: u32, stride: u32) -> u32 {
	return tile__divided(index * stride, group_count).y;
}

const rays__RAYS_PER_LANE: u32 = 4u;

struct rays__Rays {
	origin: wide__Vectors,
	direction: wide__Vectors,
	t_max: vec4f,
	leaving: vec4u,
	leaving_instance: vec4u
}

struct rays__Hits {
	t: vec4f,
	primitive: vec4u,
	b1: vec4f,
	b2: vec4f,
	instance: vec4u
}

fn rays__dead_rays() -> rays__Rays {
	return rays__Rays(wide__Vectors(vec4f(0.0), vec4f(0.0), vec4f(0.0)), wide__Vectors(vec4f(0.0), vec4f(0.0), vec4f(1.0)), vec4f(-1.0), vec4u(types__NONE), vec4u(types__NO_INSTANCE));
}

fn rays__ray_at(rays: rays__Rays, k: u32) -> tracing__Ray {
	return tracing__Ray(wide__vector_at(rays.origin, k), rays.t_max[k], wide__vector_at(rays.direction, k), rays.leaving[k], rays.leaving_instance[k]);
}

fn rays__ray_set(rays: rays__Rays, k: u32, ray: tracing__Ray) -> rays__Rays {
	return rays__Rays(wide__vector_set(rays.origin, k, ray.origin), wide__vector_set(rays.direction, k, ray.direction), wide__float_set(rays.t_max, k, ray.t_max), wide__word_set(rays.leaving, k, ray.leaving), wide__word_set(rays.leaving_instance, k, ray.leaving_instance));
}

fn rays__hit_at(hits: rays__Hits, k: u32) -> tracing__Hit {
	return tracing__Hit(hits.t[k], hits.primitive[k], hits.b1[k], hits.b2[k], hits.instance[k]);
}

struct wide__Vectors {
	x: vec4f,
	y: vec4f,
	z: vec4f
}

fn wide__vector_at(all: wide__Vectors, k: u32) -> vec3f {
	return vec3f(all.x[k], all.y[k], all.z[k]);
}

fn wide__float_set(all: vec4f, k: u32, value: f32) -> vec4f {
	return select(all, vec4f(value), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
}

fn wide__word_set(all: vec4u, k: u32, value: u32) -> vec4u {
	return select(all, vec4u(value), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
}

fn wide__vector_set(all: wide__Vectors, k: u32, value: vec3f) -> wide__Vectors {
	return wide__Vectors(wide__float_set(all.x, k, value.x), wide__float_set(all.y, k, value.y), wide__float_set(all.z, k, value.z));
}

struct tracing__Ray {
	origin: vec3f,
	t_max: f32,
	direction: vec3f,
	leaving: u32,
	leaving_instance: u32
}

struct tracing__Candidate {
	hit: bool,
	t: f32,
	b1: f32,
	b2: f32
}

struct tracing__Hit {
	t: f32,
	primitive: u32,
	b1: f32,
	b2: f32,
	instance: u32
}

struct query__QueryRay {
	ray: tracing__Ray,
	time: f32
}

fn query__load_query_ray(index: u32) -> query__QueryRay {
	let r0 = rows__ray_row(2u * index);
	let r1 = rows__ray_row(2u * index + 1u);
	let ray = tracing__Ray(bitcast<vec3f>(r0.xyz), bitcast<f32>(r0.w), bitcast<vec3f>(r1.xyz), types__NONE, types__NO_INSTANCE);
	return query__QueryRay(ray, bitcast<f32>(r1.w));
}

fn query__store_hit(index: u32, hit: tracing__Hit) {
	var rest = vec2u(hit.instance, pack2x16unorm(vec2f(hit.b1, hit.b2)));
	if (bindings__COUNT_STEPS) {
		rest = vec2u(loops__nodes_visited, loops__primitives_tested);
	}
	bindings__hits[index] = vec4u(bitcast<u32>(hit.t), hit.primitive, rest);
}

@group(0) @binding(0)
var rows__nodes: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(1)
var rows__triangles: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(3)
var rows__rays: texture_storage_2d<rgba32uint, read>;

fn rows__node_row(row: u32) -> vec4u {
	return textureLoad(rows__nodes, rows__texel(row));
}

fn rows__triangle_row(row: u32) -> vec4u {
	return textureLoad(rows__triangles, rows__texel(row));
}

fn rows__ray_row(row: u32) -> vec4u {
	return textureLoad(rows__rays, rows__texel(row));
}

fn rows__texel(row: u32) -> vec2u {
	return vec2u(row & ((1u << types__IMAGE_WIDTH_LOG2) - 1u), row >> types__IMAGE_WIDTH_LOG2);
}

fn pixels__place_of(lane: u32, k: u32) -> u32 {
	let within = lane & (bindings__PACKET_LANES - 1u);
	return 4u * (lane - within) + bindings__PACKET_LANES * k + within;
}

var<private> loops__nodes_visited: u32;

var<private> loops__primitives_tested: u32;

var<private> loops__cut_off: bool;

var<private> loops__is_stack_full: bool;

var<private> walk__seconds: lanes__FourHits;

fn walk__packet_hits(rays: rays__Rays, any: bool) -> rays__Hits {
	let found = walk__walk(rays__ray_at(rays, 0u), rays__ray_at(rays, 1u), rays__ray_at(rays, 2u), rays__ray_at(rays, 3u), any);
	walk__seconds = found;
	return rays__Hits(vec4f(found.h0.hit.t, found.h1.hit.t, found.h2.hit.t, found.h3.hit.t), vec4u(found.h0.hit.primitive, found.h1.hit.primitive, found.h2.hit.primitive, found.h3.hit.primitive), vec4f(found.h0.hit.b1, found.h1.hit.b1, found.h2.hit.b1, found.h3.hit.b1), vec4f(found.h0.hit.b2, found.h1.hit.b2, found.h2.hit.b2, found.h3.hit.b2), vec4u(found.h0.hit.instance, found.h1.hit.instance, found.h2.hit.instance, found.h3.hit.instance));
}

fn walk__first_hit(at: primitive__TraversalRay) -> lanes__TwoHits {
	var hit = tracing__Hit(at.ray.t_max, types__NONE, 0.0, 0.0, types__NO_INSTANCE);
	primitive__runner_up = tracing__Hit(camera__T_FAR, types__NONE, 0.0, 0.0, types__NO_INSTANCE);
	if (bindings__HAS_PLANES) {
		hit = exhaustive__hit_planes(at.ray, hit);
	}
	hit = exhaustive__hit_apart(at, hit);
	return lanes__TwoHits(hit, primitive__runner_up);
}

fn walk__world_ray(ray: tracing__Ray) -> primitive__TraversalRay {
	return primitive__traversal_ray(ray, triangle_watertight__shear_of(ray.direction), types__NO_INSTANCE, deforming__NO_KEYS);
}

fn walk__placed_ray(ray: tracing__Ray, instance: u32) -> primitive__TraversalRay {
	return primitive__traversal_ray(ray, triangle_watertight__shear_of(ray.direction), instance, deforming__NO_KEYS);
}

fn walk__walk(ray0: tracing__Ray, ray1: tracing__Ray, ray2: tracing__Ray, ray3: tracing__Ray, any: bool) -> lanes__FourHits {
	var rays = lanes__FourRays(walk__world_ray(ray0), walk__world_ray(ray1), walk__world_ray(ray2), walk__world_ray(ray3));
	var hits = lanes__FourHits(walk__first_hit(rays.r0), walk__first_hit(rays.r1), walk__first_hit(rays.r2), walk__first_hit(rays.r3));
	if (bindings__COUNT_STEPS) {
		loops__primitives_tested += exhaustive__apart_count();
	}
	if (!(bindings__HAS_TRIANGLES || bindings__HAS_SHAPES)) {
		return hits;
	}
	var stack = shared_stack__Stack(traverse__EMPTY, traverse__EMPTY, traverse__EMPTY, traverse__EMPTY, traverse__EMPTY, traverse__EMPTY);
	var current = 0u;
	if (bindings__HAS_INSTANCES) {
		current = fetch__root;
	}
	loop {
		loop {
			if (bindings__HAS_INSTANCES) {
				if (current == traverse__RETURN) {
					rays = lanes__FourRays(walk__world_ray(ray0), walk__world_ray(ray1), walk__world_ray(ray2), walk__world_ray(ray3));
					current = shared_stack__top_of(stack);
					stack = shared_stack__popped(stack);
				}
				if ((current >= types__INSTANCE) & (current != traverse__EMPTY)) {
					let index = current & types__LEAF_FIRST_MASK;
					let instance = fetch__load_instance(index);
					let space = instance__space_of(instance);
					let o0 = instance__object_ray(ray0, space);
					let o1 = instance__object_ray(ray1, space);
					let o2 = instance__object_ray(ray2, space);
					let o3 = instance__object_ray(ray3, space);
					rays = lanes__FourRays(walk__placed_ray(o0, index), walk__placed_ray(o1, index), walk__placed_ray(o2, index), walk__placed_ray(o3, index));
					stack = shared_stack__pushed(stack, traverse__RETURN, 1u);
					current = instance.root;
				}
			}
			if ((current & types__LEAF) == 0u) {
				let limits = vec4i(walk__limit_of(ray0, hits.h0.hit, any), walk__limit_of(ray1, hits.h1.hit, any), walk__limit_of(ray2, hits.h2.hit, any), walk__limit_of(ray3, hits.h3.hit, any));
				loop {
					let node = node__load_shared_node(current);
					let children = node__order_children(node, rays, limits);
					current = select(shared_stack__top_of(stack), subgroupShuffle(children.reference, 0u), children.count > 0u);
					stack = shared_stack__pushed(stack, subgroupShuffle(children.reference, (lanes__packet_lane + 1u) & 3u), children.count - 1u);
					if (bindings__COUNT_STEPS) {
						loops__nodes_visited += 1u;
					}
					continuing {
					
						break if (current & types__LEAF) != 0u;
					}
				}
			}
			loop {
				let is_here = leaf__is_common(current);
				let next = leaf__after(current, shared_stack__top_of(stack));
				if (is_here) {
					hits = leaf__meet_common(rays, hits, current);
					stack = shared_stack__pushed(stack, traverse__EMPTY, select(0u, shared_stack__POP, next.is_last));
					current = next.reference;
					if (any) {
						current = select(traverse__EMPTY, current, walk__is_open(hits, ray0, ray1, ray2, ray3));
					}
				}
				continuing {
				
					break if !leaf__is_common(current);
				}
			}
			continuing {
			
				break if (current == traverse__EMPTY) | leaf__is_rare(current);
			}
		}
		if (bindings__HAS_SHAPES && bindings__HAS_TRIANGLES && bindings__TRIANGLES_OUTSIDE_TREE == 0u && !bindings__SHAPES_OUTSIDE_TREE) {
			let next = leaf__after(current, shared_stack__top_of(stack));
			if (leaf__is_rare(current)) {
				hits = leaf__meet_rare(rays, hits, current);
				stack = shared_stack__pushed(stack, traverse__EMPTY, select(0u, shared_stack__POP, next.is_last));
				current = next.reference;
				if (any) {
					current = select(traverse__EMPTY, current, walk__is_open(hits, ray0, ray1, ray2, ray3));
				}
			}
		}
		continuing {
		
			break if current == traverse__EMPTY;
		}
	}
	loops__cut_off |= shared_stack__is_full | (current != traverse__EMPTY);
	return hits;
}

fn walk__is_open(hits: lanes__FourHits, ray0: tracing__Ray, ray1: tracing__Ray, ray2: tracing__Ray, ray3: tracing__Ray) -> bool {
	return lanes__any_lane_of_packet(walk__is_unoccluded(ray0, hits.h0.hit) | walk__is_unoccluded(ray1, hits.h1.hit) | walk__is_unoccluded(ray2, hits.h2.hit) | walk__is_unoccluded(ray3, hits.h3.hit));
}

fn walk__is_unoccluded(ray: tracing__Ray, hit: tracing__Hit) -> bool {
	return (hit.primitive == types__NONE) & (ray.t_max >= 0.0);
}

fn walk__limit_of(ray: tracing__Ray, hit: tracing__Hit, any: bool) -> i32 {
	let limit = bitcast<i32>(traverse__search_limit(ray, hit)) + node__WIDENING;
	return select(limit, -1, any & (hit.primitive != types__NONE));
}

var<private> primitive__runner_up: tracing__Hit;

var<private> primitive__passed: tracing__Hit;

struct primitive__TraversalRay {
	ray: tracing__Ray,
	inv: vec3f,
	shear: triangle_watertight__Shear,
	instance: u32,
	keys: deforming__Keys
}

fn primitive__traversal_ray(ray: tracing__Ray, shear: triangle_watertight__Shear, instance: u32, keys: deforming__Keys) -> primitive__TraversalRay {
	return primitive__TraversalRay(ray, numeric__safe_reciprocal(ray.direction), shear, instance, keys);
}

fn primitive__closer_of(at: primitive__TraversalRay, hit: tracing__Hit, candidate: tracing__Candidate, primitive: u32) -> tracing__Hit {
	var is_lower = primitive < hit.primitive;
	var is_left = primitive == at.ray.leaving;
	if (bindings__HAS_INSTANCES) {
		is_lower = (at.instance < hit.instance) | ((at.instance == hit.instance) & is_lower);
		is_left = is_left & (at.instance == at.ray.leaving_instance);
	}
	let ties = (candidate.t == hit.t) & is_lower & (hit.primitive != types__NONE);
	let counts = candidate.hit & !is_left & !primitive__is_passed(candidate.t, primitive, at.instance);
	let wins = counts & ((candidate.t < hit.t) | ties);
	if (bindings__HAS_CONTACT) {
		let found = tracing__Hit(candidate.t, primitive, candidate.b1, candidate.b2, at.instance);
		primitive__keep_runner_up(hit, found, counts, wins);
	}
	return tracing__Hit(select(hit.t, candidate.t, wins), select(hit.primitive, primitive, wins), select(hit.b1, candidate.b1, wins), select(hit.b2, candidate.b2, wins), select(hit.instance, at.instance, wins));
}

fn primitive__is_passed(t: f32, primitive: u32, instance: u32) -> bool {
	if (!bindings__HAS_SECTION) {
		return false;
	}
	let is_later = instance > primitive__passed.instance || (instance == primitive__passed.instance && primitive > primitive__passed.primitive);
	return t < primitive__passed.t || (t == primitive__passed.t && !is_later);
}

fn primitive__keep_runner_up(hit: tracing__Hit, found: tracing__Hit, counts: bool, wins: bool) {
	let is_same = (found.primitive == hit.primitive) & (found.instance == hit.instance);
	if (wins) {
		primitive__runner_up = hit;
	}
	else if (counts & !is_same & (found.t < primitive__runner_up.t)) {
		primitive__runner_up = found;
	}
}

fn primitive__test_triangle(ray: tracing__Ray, corners: types__PackedTriangle, shear: triangle_watertight__Shear) -> tracing__Candidate {
	if (bindings__TRIANGLE_TEST == types__TRIANGLE_TEST_PLANE) {
		return triangle_plane__intersect_triangle_plane(ray, corners.v0, corners.v1, corners.v2);
	}
	if (bindings__TRIANGLE_TEST == types__TRIANGLE_TEST_MOLLER_TRUMBORE) {
		return triangle_moller_trumbore__intersect_triangle_moller_trumbore(ray, corners.v0, corners.v1, corners.v2);
	}
	return triangle_watertight__intersect_triangle_watertight(ray.origin, shear, corners.v0, corners.v1, corners.v2);
}

struct triangle_watertight__Shear {
	x: vec3f,
	y: vec3f,
	z: vec3f
}

fn triangle_watertight__shear_of(direction: vec3f) -> triangle_watertight__Shear {
	let size = abs(direction);
	let is_x = (size.x >= size.y) & (size.x >= size.z);
	let is_y = !is_x & (size.y >= size.z);
	let axis_z = select(select(vec3f(0.0, 0.0, 1.0), vec3f(0.0, 1.0, 0.0), is_y), vec3f(1.0, 0.0, 0.0), is_x);
	let axis_x = axis_z.zxy;
	let axis_y = axis_z.yzx;
	let scale = 1.0 / dot(direction, axis_z);
	return triangle_watertight__Shear(axis_x - dot(direction, axis_x) * scale * axis_z, axis_y - dot(direction, axis_y) * scale * axis_z, scale * axis_z);
}

fn triangle_watertight__intersect_triangle_watertight(origin: vec3f, shear: triangle_watertight__Shear, v0: vec3f, v1: vec3f, v2: vec3f) -> tracing__Candidate {
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
	return tracing__Candidate(usable & (t > 0.0), t, edges.y * inv_det, edges.z * inv_det);
}

struct deforming__Keys {
	next: u32,
	stride: u32
}

const deforming__NO_KEYS: deforming__Keys = deforming__Keys(0u, 0u);

const numeric__ROUNDING: f32 = 5.9604645e-8;

fn numeric__safe_reciprocal(d: vec3f) -> vec3f {
	let tiny = abs(d) < vec3f(1e-18);
	return 1.0 / select(d, select(vec3f(1e-18), vec3f(-1e-18), d < vec3f(0.0)), tiny);
}

fn numeric__max_component(v: vec3f) -> f32 {
	return max_f32(v.x, max_f32(v.y, v.z));
}

const camera__T_FAR: f32 = 3e38;

fn exhaustive__hit_planes(ray: tracing__Ray, start: tracing__Hit) -> tracing__Hit {
	var hit = start;
	var index = fetch__first_plane;
	loop {
		let shape = fetch__load_shape(index);
		let candidate = plane__intersect_plane(ray, shape.position, shape.row_y);
		let primitive = types__SHAPE | index;
		let counts = candidate.hit & (primitive != ray.leaving) & !primitive__is_passed(candidate.t, primitive, types__NO_INSTANCE);
		let wins = counts & (candidate.t < hit.t);
		let found = tracing__Hit(candidate.t, primitive, 0.0, 0.0, types__NO_INSTANCE);
		if (bindings__HAS_CONTACT) {
			primitive__keep_runner_up(hit, found, counts, wins);
		}
		if (wins) {
			hit = found;
		}
		continuing {
			index += 1u;
			break if index >= fetch__end_plane;
		}
	}
	loops__cut_off |= index < fetch__end_plane;
	return hit;
}

fn exhaustive__hit_apart(at: primitive__TraversalRay, start: tracing__Hit) -> tracing__Hit {
	if (bindings__TRIANGLES_OUTSIDE_TREE > 0u) {
		return exhaustive__hit_triangles(at, start);
	}
	if (bindings__SHAPES_OUTSIDE_TREE) {
		return exhaustive__hit_shapes(at, start);
	}
	return start;
}

fn exhaustive__apart_count() -> u32 {
	return bindings__TRIANGLES_OUTSIDE_TREE + select(0u, fetch__first_plane, bindings__SHAPES_OUTSIDE_TREE);
}

fn exhaustive__hit_triangles(at: primitive__TraversalRay, start: tracing__Hit) -> tracing__Hit {
	var hit = start;
	var index = 0u;
	loop {
		hit = primitive__closer_of(at, hit, primitive__test_triangle(at.ray, fetch__load_triangle(index), at.shear), index);
		continuing {
			index += 1u;
			break if index >= bindings__TRIANGLES_OUTSIDE_TREE;
		}
	}
	loops__cut_off |= index < bindings__TRIANGLES_OUTSIDE_TREE;
	return hit;
}

fn exhaustive__hit_shapes(at: primitive__TraversalRay, start: tracing__Hit) -> tracing__Hit {
	var hit = start;
	var index = 0u;
	loop {
		hit = primitive__closer_of(at, hit, shape__test_shape(at.ray, fetch__load_shape(index)), types__SHAPE | index);
		continuing {
			index += 1u;
			break if index >= fetch__first_plane;
		}
	}
	loops__cut_off |= index < fetch__first_plane;
	return hit;
}

fn plane__intersect_plane(ray: tracing__Ray, point: vec3f, n: vec3f) -> tracing__Candidate {
	let slope = dot(n, ray.direction);
	let steep = abs(slope) > 1e-12;
	let t = dot(n, point - ray.origin) / select(1.0, slope, steep);
	return tracing__Candidate(steep & (t > 0.0), t, 0.0, 0.0);
}

fn triangle_plane__intersect_triangle_plane(ray: tracing__Ray, v0: vec3f, v1: vec3f, v2: vec3f) -> tracing__Candidate {
	let e1 = v1 - v0;
	let e2 = v2 - v0;
	let n = cross(e1, e2);
	let slope = dot(n, ray.direction);
	let area = dot(n, n);
	let usable = (abs(slope) > 4.0 * numeric__ROUNDING * length(e1) * length(e2)) & (area > 1e-36);
	let t = dot(n, v0 - ray.origin) / select(1.0, slope, usable);
	let w = ray.origin + t * ray.direction - v0;
	let b1 = dot(cross(w, e2), n) / select(1.0, area, usable);
	let b2 = dot(cross(e1, w), n) / select(1.0, area, usable);
	let inside = (b1 >= 0.0) & (b2 >= 0.0) & (b1 + b2 <= 1.0);
	return tracing__Candidate(usable & inside & (t > 0.0), t, b1, b2);
}

fn triangle_moller_trumbore__intersect_triangle_moller_trumbore(ray: tracing__Ray, v0: vec3f, v1: vec3f, v2: vec3f) -> tracing__Candidate {
	let e1 = v1 - v0;
	let e2 = v2 - v0;
	let p = cross(ray.direction, e2);
	let det = dot(e1, p);
	let usable = abs(det) > 4.0 * numeric__ROUNDING * length(e1) * length(e2);
	let inv_det = 1.0 / select(1.0, det, usable);
	let s = ray.origin - v0;
	let b1 = inv_det * dot(s, p);
	let q = cross(s, e1);
	let b2 = inv_det * dot(ray.direction, q);
	let t = inv_det * dot(e2, q);
	let inside = (b1 >= 0.0) & (b2 >= 0.0) & (b1 + b2 <= 1.0);
	return tracing__Candidate(usable & inside & (t > 0.0), t, b1, b2);
}

const shape__SPHERES: u32 = 1u << types__SHAPE_SPHERE;

const shape__DISCS: u32 = 1u << types__SHAPE_DISC;

const shape__RECTANGLES: u32 = 1u << types__SHAPE_RECTANGLE;

const shape__BOXES: u32 = 1u << types__SHAPE_BOX;

const shape__CONES: u32 = 1u << types__SHAPE_CONE;

const shape__TORI: u32 = 1u << types__SHAPE_TORUS;

const shape__ELLIPSOIDS: u32 = 1u << types__SHAPE_ELLIPSOID;

const shape__GLOBES: u32 = 1u << types__SHAPE_GLOBE;

fn shape__test_shape(ray: tracing__Ray, shape: types__PackedShape) -> tracing__Candidate {
	if (bindings__SHAPE_KINDS == shape__SPHERES) {
		return sphere__intersect_sphere(ray, shape.position, shape.size0);
	}
	var candidate = tracing__Candidate(false, 0.0, 0.0, 0.0);
	if ((bindings__SHAPE_KINDS & shape__SPHERES) != 0u && shape.kind == types__SHAPE_SPHERE) {
		candidate = sphere__intersect_sphere(ray, shape.position, shape.size0);
	}
	if ((bindings__SHAPE_KINDS & shape__GLOBES) != 0u && (bindings__SHAPE_KINDS == shape__GLOBES || shape.kind == types__SHAPE_GLOBE)) {
		candidate = globe__intersect_globe(ray, shape.position, shape.row_y, shape.size0);
	}
	let local = canonical__canonical_ray(ray, shape);
	if ((bindings__SHAPE_KINDS & shape__DISCS) != 0u && (bindings__SHAPE_KINDS == shape__DISCS || shape.kind == types__SHAPE_DISC)) {
		candidate = disc__intersect_disc(local, shape.size0);
	}
	if ((bindings__SHAPE_KINDS & shape__RECTANGLES) != 0u && (bindings__SHAPE_KINDS == shape__RECTANGLES || shape.kind == types__SHAPE_RECTANGLE)) {
		candidate = rectangle__intersect_rectangle(local);
	}
	if ((bindings__SHAPE_KINDS & shape__BOXES) != 0u && (bindings__SHAPE_KINDS == shape__BOXES || shape.kind == types__SHAPE_BOX)) {
		candidate = box__intersect_box(local);
	}
	if ((bindings__SHAPE_KINDS & shape__CONES) != 0u && (bindings__SHAPE_KINDS == shape__CONES || shape.kind == types__SHAPE_CONE)) {
		candidate = cone__intersect_cone(local, shape.size0, shape.size1, (shape.flags & types__SHAPE_CAPPED) != 0u);
	}
	if ((bindings__SHAPE_KINDS & shape__TORI) != 0u && (bindings__SHAPE_KINDS == shape__TORI || shape.kind == types__SHAPE_TORUS)) {
		candidate = torus__intersect_torus(local, shape.size0);
	}
	if ((bindings__SHAPE_KINDS & shape__ELLIPSOIDS) != 0u && (bindings__SHAPE_KINDS == shape__ELLIPSOIDS || shape.kind == types__SHAPE_ELLIPSOID)) {
		candidate = ellipsoid__intersect_ellipsoid(local);
	}
	return candidate;
}

fn sphere__intersect_sphere(ray: tracing__Ray, center: vec3f, radius: f32) -> tracing__Candidate {
	let f = ray.origin - center;
	let a = dot(ray.direction, ray.direction);
	let b = -dot(f, ray.direction);
	let nearest = f + (b / a) * ray.direction;
	let discriminant = radius * radius - dot(nearest, nearest);
	if (discriminant < 0.0) {
		return tracing__Candidate(false, 0.0, 0.0, 0.0);
	}
	let c = dot(f, f) - radius * radius;
	let q = b + select(-1.0, 1.0, b >= 0.0) * sqrt(a * discriminant);
	let t0 = select(0.0, c / select(1.0, q, abs(q) > 1e-30), abs(q) > 1e-30);
	let t1 = q / a;
	let near = min_f32(t0, t1);
	let t = select(max_f32(t0, t1), near, near > 0.0);
	return tracing__Candidate(t > 0.0, t, 0.0, 0.0);
}

fn globe__intersect_globe(ray: tracing__Ray, anchor: vec3f, n: vec3f, curvature: f32) -> tracing__Candidate {
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
		return tracing__Candidate(false, 0.0, 0.0, 0.0);
	}
	let q = b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant);
	let t0 = select(0.0, c / select(1.0, q, abs(q) > 1e-30), abs(q) > 1e-30);
	let t1 = q / a;
	let near = min_f32(t0, t1);
	let t = select(max_f32(t0, t1), near, near > 0.0);
	return tracing__Candidate(t > 0.0, t, 0.0, 0.0);
}

const canonical__TWO_PI: f32 = 6.2831855;

struct canonical__Approach {
	origin: vec3f,
	start: f32,
	direction: vec3f,
	t_per_length: f32,
	near: bool
}

fn canonical__canonical_vector(shape: types__PackedShape, v: vec3f) -> vec3f {
	return vec3f(dot(shape.row_x, v), dot(shape.row_y, v), dot(shape.row_z, v));
}

fn canonical__canonical_ray(ray: tracing__Ray, shape: types__PackedShape) -> tracing__Ray {
	return tracing__Ray(canonical__canonical_vector(shape, ray.origin - shape.position), ray.t_max, canonical__canonical_vector(shape, ray.direction), ray.leaving, ray.leaving_instance);
}

fn canonical__approach(ray: tracing__Ray, center: vec3f, reach: f32) -> canonical__Approach {
	let size = abs(ray.direction);
	let largest = max_f32(max_f32(size.x, max_f32(size.y, size.z)), 1e-30);
	let scaled = ray.direction / largest;
	let inv_length = inverseSqrt(max_f32(dot(scaled, scaled), 1e-30));
	let direction = scaled * inv_length;
	let start = max_f32(dot(center - ray.origin, direction) - reach, 0.0);
	let origin = ray.origin + start * direction;
	let off = abs(origin - center);
	let near = max_f32(off.x, max_f32(off.y, off.z)) <= 2.0 * reach;
	return canonical__Approach(select(center + reach, origin, near), start, direction, inv_length / largest, near);
}

fn canonical__approached_t(near: canonical__Approach, s: f32) -> f32 {
	return (near.start + s) * near.t_per_length;
}

fn disc__intersect_disc(ray: tracing__Ray, hole: f32) -> tracing__Candidate {
	let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
	let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
	let p = clamp_vec2f(ray.origin.xz + t * ray.direction.xz, vec2f(-2.0), vec2f(2.0));
	let distance = dot(p, p);
	return tracing__Candidate(steep & (t > 0.0) & (distance <= 1.0) & (distance >= hole * hole), t, 0.0, 0.0);
}

fn rectangle__intersect_rectangle(ray: tracing__Ray) -> tracing__Candidate {
	let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
	let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
	let way = t * ray.direction.xz;
	let slack = 4.0 * numeric__ROUNDING * (abs(ray.origin.xz) + abs(way));
	let inside = all(abs(ray.origin.xz + way) <= 1.0 + slack);
	return tracing__Candidate(steep & (t > 0.0) & inside, t, 0.0, 0.0);
}

fn box__intersect_box(ray: tracing__Ray) -> tracing__Candidate {
	let size = abs(ray.direction);
	let largest = max_f32(max_f32(size.x, max_f32(size.y, size.z)), 1e-30);
	let inv = numeric__safe_reciprocal(ray.direction / largest);
	let origin = clamp_vec3f(ray.origin, vec3f(-1e18), vec3f(1e18));
	let t0 = (-1.0 - origin) * inv;
	let t1 = (1.0 - origin) * inv;
	let enters = min_vec3f(t0, t1);
	let leaves = max_vec3f(t0, t1);
	let enter = max_f32(enters.x, max_f32(enters.y, enters.z));
	let leave = min_f32(leaves.x, min_f32(leaves.y, leaves.z));
	let from_outside = enter > 0.0;
	let s = select(leave, enter, from_outside);
	let planes = select(leaves, enters, from_outside);
	let axis = select(select(2u, 1u, planes.y == s), 0u, planes.x == s);
	let positive = (inv[axis] < 0.0) == from_outside;
	let side = f32(axis) + select(0.0, 3.0, positive);
	let hit = (enter <= leave) & (s > 0.0);
	return tracing__Candidate(hit, select(0.0, s, hit) / largest, side, 0.0);
}

const cone__FAR: f32 = 1e30;

const cone__SIDE: f32 = 0.0;

const cone__BOTTOM: f32 = 1.0;

const cone__TOP: f32 = 2.0;

fn cone__intersect_cone(ray: tracing__Ray, bottom: f32, top: f32, capped: bool) -> tracing__Candidate {
	let near = canonical__approach(ray, vec3f(0.0, 0.5, 0.0), 1.5);
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
	let root = sqrt(max_f32(discriminant, 0.0));
	let q = -(b + select(-root, root, b >= 0.0));
	let usable = abs(q) > 1e-20;
	let r1 = q / a;
	let r2 = select(0.0, c / select(1.0, q, usable), usable);
	let low = min_f32(r1, r2);
	let high = max_f32(r1, r2);
	let steep = a < 0.0;
	let widens = slope * d.y > 0.0;
	let side_in = select(low, select(-cone__FAR, high, widens), steep);
	let side_out = select(high, select(low, cone__FAR, widens), steep);
	let level = abs(d.y) < 1e-18;
	let inv_y = 1.0 / select(d.y, select(1e-18, -1e-18, d.y < 0.0), level);
	let y0 = -o.y * inv_y;
	let y1 = (1.0 - o.y) * inv_y;
	let slab_in = min_f32(y0, y1);
	let slab_out = max_f32(y0, y1);
	let enter = max_f32(slab_in, side_in);
	let leave = min_f32(slab_out, side_out);
	let enters_side = side_in >= slab_in;
	let leaves_side = side_out <= slab_out;
	let takes_enter = (near.start + enter > 0.0) & (enters_side | capped);
	let takes_leave = (near.start + leave > 0.0) & (leaves_side | capped);
	let met = (steep | (discriminant >= 0.0)) & (enter <= leave);
	let hit = near.near & met & (takes_enter | takes_leave);
	let rough = select(0.0, select(leave, enter, takes_enter), hit);
	let is_side = select(leaves_side, enters_side, takes_enter);
	let end = select(cone__BOTTOM, cone__TOP, (d.y > 0.0) != takes_enter);
	let s = select(rough, cone__polish(o, d, bottom, slope, rough), is_side);
	let t = canonical__approached_t(near, s);
	return tracing__Candidate(hit & (t > 0.0), t, select(end, cone__SIDE, is_side), 0.0);
}

fn cone__polish(o: vec3f, d: vec3f, bottom: f32, slope: f32, s: f32) -> f32 {
	let p = o + s * d;
	let off_axis = length(p.xz);
	let rate = dot(p.xz, d.xz) / max_f32(off_axis, 1e-18) - slope * d.y;
	let usable = abs(rate) > 0.001;
	let step = (off_axis - (bottom + slope * p.y)) / select(1.0, rate, usable);
	return s - clamp_f32(select(0.0, step, usable), -0.001, 0.001);
}

const torus__MOST_ROUNDS: u32 = 40u;

const torus__NARROW: f32 = 1.2e-7;

fn torus__torus_distance(p: vec3f, minor: f32) -> f32 {
	return length(vec2f(length(p.xz) - 1.0, p.y)) - minor;
}

fn torus__polish(s: f32, p: f32, q: f32) -> f32 {
	let slope = 3.0 * s * s + p;
	let steep = abs(slope) > 0.001;
	return s - clamp_f32(select(0.0, ((s * s + p) * s + q) / select(1.0, slope, steep), steep), -0.02, 0.02);
}

fn torus__cubic_zeros(p: f32, q: f32) -> vec3f {
	let third = p / 3.0;
	let half = 0.5 * q;
	let discriminant = half * half + third * third * third;
	let cube = abs(half) + sqrt(max_f32(discriminant, 0.0));
	let large = -select(-1.0, 1.0, half >= 0.0) * select(0.0, exp2(log2(max_f32(cube, 1e-30)) / 3.0), cube > 1e-30);
	let small = select(0.0, -third / select(1.0, large, large != 0.0), large != 0.0);
	let one = torus__polish(large + small, p, q);
	let size = sqrt(max_f32(-third, 0.0));
	let usable = size > 1e-10;
	let cosine = clamp_f32(select(0.0, -half / select(1.0, size * size * size, usable), usable), -1.0, 1.0);
	let angle = acos(cosine) / 3.0;
	let a = torus__polish(2.0 * size * cos(angle + canonical__TWO_PI / 3.0), p, q);
	let b = torus__polish(2.0 * size * cos(angle - canonical__TWO_PI / 3.0), p, q);
	let c = torus__polish(2.0 * size * cos(angle), p, q);
	let three = vec3f(min_f32(a, min_f32(b, c)), max_f32(min_f32(a, b), min_f32(max_f32(a, b), c)), max_f32(a, max_f32(b, c)));
	return select(three, vec3f(one), discriminant > 0.0);
}

fn torus__intersect_torus(ray: tracing__Ray, minor: f32) -> tracing__Candidate {
	let outer = 1.0 + minor;
	let near = canonical__approach(ray, vec3f(0.0), 1.5 * outer);
	let o = near.origin;
	let d = near.direction;
	let middle = -dot(o, d);
	let nearest = o + middle * d;
	let apart = dot(nearest, nearest);
	let ball = 1.0001 * outer;
	let half_chord = sqrt(max_f32(ball * ball - apart, 0.0));
	let start = max_f32(middle - half_chord, 0.0);
	let end = middle + half_chord;
	let zeros = middle + torus__cubic_zeros(apart - 1.0 - minor * minor + 2.0 * d.y * d.y, 2.0 * nearest.y * d.y);
	let cuts = vec4f(clamp_vec3f(zeros, vec3f(start), vec3f(max_f32(end, start))), end);
	let outside = torus__torus_distance(o + start * d, minor) >= 0.0;
	let changes = vec4<bool>((torus__torus_distance(o + cuts.x * d, minor) >= 0.0) != outside, (torus__torus_distance(o + cuts.y * d, minor) >= 0.0) != outside, (torus__torus_distance(o + cuts.z * d, minor) >= 0.0) != outside, (torus__torus_distance(o + cuts.w * d, minor) >= 0.0) != outside);
	let found = near.near & (apart <= ball * ball) & (end > start) & any(changes);
	let last = select(select(select(cuts.w, cuts.z, changes.z), cuts.y, changes.y), cuts.x, changes.x);
	let first = select(select(select(cuts.z, cuts.y, changes.z), cuts.x, changes.y), start, changes.x);
	let s = torus__root_between(o, d, minor, select(last, first, found), last, outside);
	let t = canonical__approached_t(near, s);
	return tracing__Candidate(found & (t > 0.0), t, 0.0, 0.0);
}

fn torus__root_between(o: vec3f, d: vec3f, minor: f32, first: f32, last: f32, outside: bool) -> f32 {
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
		let ring_slope = dot(p.xz, d.xz) / max_f32(ring, 1e-20);
		let slope = dot(from_ring, vec2f(ring_slope, d.y)) / max_f32(to_middle, 1e-20);
		let usable = abs(slope) > 1e-6;
		let newton = s - distance / select(1.0, slope, usable);
		let takes_newton = usable & (newton > low) & (newton < high) & (abs(newton - s) < 0.5 * moved);
		let next = select(0.5 * (low + high), newton, takes_newton);
		moved = abs(next - s);
		s = next;
		rounds += 1u;
		continuing {
		
			break if (moved <= torus__NARROW * (1.0 + abs(s))) | (rounds >= torus__MOST_ROUNDS);
		}
	}
	return s;
}

fn ellipsoid__intersect_ellipsoid(ray: tracing__Ray) -> tracing__Candidate {
	let near = canonical__approach(ray, vec3f(0.0), 1.5);
	let found = sphere__intersect_sphere(tracing__Ray(near.origin, ray.t_max, near.direction, types__NONE, ray.leaving_instance), vec3f(0.0), 1.0);
	return tracing__Candidate(near.near & found.hit, canonical__approached_t(near, found.t), 0.0, 0.0);
}

const shared_stack__POP: u32 = 4294967295u;

var<private> shared_stack__is_full: bool;

struct shared_stack__Stack {
	s0: u32,
	s1: u32,
	s2: u32,
	s3: u32,
	s4: u32,
	s5: u32
}

fn shared_stack__top_of(stack: shared_stack__Stack) -> u32 {
	return subgroupShuffle(stack.s0, 0u);
}

fn shared_stack__pushed(stack: shared_stack__Stack, reference: u32, count: u32) -> shared_stack__Stack {
	if (bindings__PACKET_LANES == 16u) {
		return shared_stack__pushed16(stack, reference, count);
	}
	return shared_stack__pushed8(stack, reference, count);
}

fn shared_stack__pushed16(stack: shared_stack__Stack, reference: u32, count: u32) -> shared_stack__Stack {
	let is_pop = count == shared_stack__POP;
	let moves_one = !is_pop & ((count & 1u) != 0u);
	let moves_two = !is_pop & (count >= 2u);
	shared_stack__is_full |= !is_pop & (lanes__packet_lane + count >= 16u) & (stack.s2 != traverse__EMPTY);
	let one_up = (lanes__packet_lane - 1u) & 15u;
	let u0 = subgroupShuffle(stack.s0, one_up);
	let u1 = subgroupShuffle(stack.s1, one_up);
	let u2 = subgroupShuffle(stack.s2, one_up);
	let one_down = (lanes__packet_lane + 1u) & 15u;
	let d0 = subgroupShuffle(stack.s0, one_down);
	let d1 = subgroupShuffle(stack.s1, one_down);
	let d2 = subgroupShuffle(stack.s2, one_down);
	let is_first = lanes__packet_lane == 0u;
	let is_last = lanes__packet_lane == 15u;
	let m0 = select(select(stack.s0, u0, moves_one), select(d0, d1, is_last), is_pop);
	let m1 = select(select(stack.s1, select(u1, u0, is_first), moves_one), select(d1, d2, is_last), is_pop);
	let m2 = select(select(stack.s2, select(u2, u1, is_first), moves_one), select(d2, traverse__EMPTY, is_last), is_pop);
	let two_up = (lanes__packet_lane - 2u) & 15u;
	let w0 = subgroupShuffle(m0, two_up);
	let w1 = subgroupShuffle(m1, two_up);
	let w2 = subgroupShuffle(m2, two_up);
	let is_low = lanes__packet_lane < 2u;
	return shared_stack__Stack(select(select(m0, w0, moves_two), reference, !is_pop & (lanes__packet_lane < count)), select(m1, select(w1, w0, is_low), moves_two), select(m2, select(w2, w1, is_low), moves_two), traverse__EMPTY, traverse__EMPTY, traverse__EMPTY);
}

fn shared_stack__pushed8(stack: shared_stack__Stack, reference: u32, count: u32) -> shared_stack__Stack {
	let source = (lanes__packet_lane - count) & 7u;
	let is_pop = count == shared_stack__POP;
	let is_new = !is_pop & (lanes__packet_lane < count);
	let is_last = is_pop & (lanes__packet_lane == 7u);
	shared_stack__is_full |= !is_pop & (lanes__packet_lane + count >= 8u) & (stack.s5 != traverse__EMPTY);
	let m0 = subgroupShuffle(stack.s0, source);
	let m1 = subgroupShuffle(stack.s1, source);
	let m2 = subgroupShuffle(stack.s2, source);
	let m3 = subgroupShuffle(stack.s3, source);
	let m4 = subgroupShuffle(stack.s4, source);
	let m5 = subgroupShuffle(stack.s5, source);
	return shared_stack__Stack(select(select(m0, reference, is_new), m1, is_last), select(select(m1, m0, is_new), m2, is_last), select(select(m2, m1, is_new), m3, is_last), select(select(m3, m2, is_new), m4, is_last), select(select(m4, m3, is_new), m5, is_last), select(select(m5, m4, is_new), traverse__EMPTY, is_last));
}

fn shared_stack__popped(stack: shared_stack__Stack) -> shared_stack__Stack {
	return shared_stack__pushed(stack, traverse__EMPTY, shared_stack__POP);
}

const traverse__EMPTY: u32 = 4294967295u;

const traverse__RETURN: u32 = 4294967232u;

const traverse__CONTACT_RANGE: f32 = 0.0001;

fn traverse__search_limit(ray: tracing__Ray, hit: tracing__Hit) -> f32 {
	if (bindings__HAS_CONTACT) {
		return hit.t + traverse__CONTACT_RANGE * (hit.t + numeric__max_component(abs(ray.origin)));
	}
	return hit.t;
}

fn instance__space_of(instance: types__PackedInstance) -> motion__Space {
	if (bindings__HAS_MOTION) {
		if (instance.key_count > 1u) {
			let moment = motion__moment_of(shutter__shutter_time, instance.key_count);
			let key = instance.first_key + moment.key;
			return motion__space_between(fetch__load_key(key), fetch__load_key(key + 1u), moment.fraction);
		}
	}
	return motion__Space(instance.translation, transpose(mat3x3f(instance.linear_x, instance.linear_y, instance.linear_z)), transpose(mat3x3f(instance.inverse_x, instance.inverse_y, instance.inverse_z)));
}

fn instance__object_ray(ray: tracing__Ray, space: motion__Space) -> tracing__Ray {
	return tracing__Ray(space.inverse * (ray.origin - space.translation), ray.t_max, space.inverse * ray.direction, ray.leaving, ray.leaving_instance);
}

struct motion__Moment {
	key: u32,
	fraction: f32
}

fn motion__moment_of(time: f32, key_count: u32) -> motion__Moment {
	let intervals = max(key_count, 2u) - 1u;
	let at = time * f32(intervals);
	let key = min(u32(at), intervals - 1u);
	return motion__Moment(key, at - f32(key));
}

struct motion__Space {
	translation: vec3f,
	linear: mat3x3f,
	inverse: mat3x3f
}

fn motion__space_between(a: types__PackedKey, b: types__PackedKey, fraction: f32) -> motion__Space {
	let q = mix(a.rotation, b.rotation, vec4f(fraction));
	let rotation = motion__rotation_matrix(q * inverseSqrt(max_f32(dot(q, q), 1e-30)));
	let d = mix(a.stretch, b.stretch, vec3f(fraction));
	let s = mix(a.shear, b.shear, vec3f(fraction));
	let size = max_f32(max_f32(abs(d.x), abs(d.y)), max_f32(abs(d.z), 1e-30));
	let e = d / size;
	let f = s / size;
	let adjugate = mat3x3f(vec3f(e.y * e.z - f.x * f.x, f.y * f.x - f.z * e.z, f.z * f.x - e.y * f.y), vec3f(f.y * f.x - f.z * e.z, e.x * e.z - f.y * f.y, f.z * f.y - e.x * f.x), vec3f(f.z * f.x - e.y * f.y, f.z * f.y - e.x * f.x, e.x * e.y - f.z * f.z));
	let determinant = dot(vec3f(e.x, f.z, f.y), adjugate[0]);
	let usable = abs(determinant) > 1e-30;
	let inverse_stretch = adjugate * (1.0 / (select(1.0, determinant, usable) * size));
	let stretch = mat3x3f(vec3f(d.x, s.z, s.y), vec3f(s.z, d.y, s.x), vec3f(s.y, s.x, d.z));
	return motion__Space(mix(a.translation, b.translation, vec3f(fraction)), rotation * stretch, inverse_stretch * transpose(rotation));
}

fn motion__rotation_matrix(q: vec4f) -> mat3x3f {
	let d = 2.0 * q.xyz * q.xyz;
	let xy = 2.0 * q.x * q.y;
	let xz = 2.0 * q.x * q.z;
	let yz = 2.0 * q.y * q.z;
	let w = 2.0 * q.w * q.xyz;
	return mat3x3f(vec3f(1.0 - d.y - d.z, xy + w.z, xz - w.y), vec3f(xy - w.z, 1.0 - d.x - d.z, yz + w.x), vec3f(xz + w.y, yz - w.x, 1.0 - d.x - d.y));
}

var<private> shutter__shutter_time: f32;

const node__WIDENING: i32 = 8;

const node__MISS: u32 = 2147483644u;

struct node__SharedNode {
	lo: vec3f,
	scale: vec3f,
	plane: vec3f,
	reference: u32
}

fn node__load_shared_node(index: u32) -> node__SharedNode {
	let child = lanes__packet_lane & 3u;
	let is_max = (lanes__packet_lane & 4u) != 0u;
	let row = rows__node_row(4u * index + child);
	let words = vec3u(select(subgroupShuffle(row.z, 1u), subgroupShuffle(row.w, 1u), is_max), select(subgroupShuffle(row.x, 2u), subgroupShuffle(row.y, 2u), is_max), select(subgroupShuffle(row.z, 2u), subgroupShuffle(row.w, 2u), is_max));
	let is_even = (child & 1u) == 0u;
	let c01 = select(subgroupShuffle(row.y, 3u), subgroupShuffle(row.x, 3u), is_even);
	let c23 = select(subgroupShuffle(row.w, 3u), subgroupShuffle(row.z, 3u), is_even);
	return node__SharedNode(bitcast<vec3f>(vec3u(subgroupShuffle(row.x, 0u), subgroupShuffle(row.y, 0u), subgroupShuffle(row.z, 0u))), bitcast<vec3f>(vec3u(subgroupShuffle(row.w, 0u), subgroupShuffle(row.x, 1u), subgroupShuffle(row.y, 1u))), vec3f((words >> vec3u(8u * child)) & vec3u(255u)), select(c23, c01, child < 2u));
}

struct node__Children {
	reference: u32,
	count: u32
}

fn node__order_children(node: node__SharedNode, rays: lanes__FourRays, limits: vec4i) -> node__Children {
	let lane = lanes__packet_lane;
	let is_even = (lane & 1u) == 0u;
	let is_low = (lane & 2u) == 0u;
	let v0 = node__closest_entry(node, rays, limits, 0u);
	let v1 = node__closest_entry(node, rays, limits, 1u);
	let v2 = node__closest_entry(node, rays, limits, 2u);
	let v3 = node__closest_entry(node, rays, limits, 3u);
	let a = min(select(v1, v0, is_even), subgroupShuffle(select(v0, v1, is_even), lane ^ 1u));
	let b = min(select(v3, v2, is_even), subgroupShuffle(select(v2, v3, is_even), lane ^ 1u));
	let c = min(select(b, a, is_low), subgroupShuffle(select(a, b, is_low), lane ^ 2u));
	var closest = min(c, subgroupShuffle(c, lane ^ 4u));
	if (bindings__PACKET_LANES == 16u) {
		closest = min(closest, subgroupShuffle(closest, lane ^ 8u));
	}
	var key = (select(closest, node__MISS, node.reference == 0u) & 4294967292u) | (lane & 3u);
	var sorted = node__Entry(key, node.reference);
	sorted = node__exchanged(sorted, 1u, is_even == is_low);
	sorted = node__exchanged(sorted, 2u, is_low);
	sorted = node__exchanged(sorted, 1u, is_even);
	key = sorted.key;
	var count = select(0u, 1u, key < node__MISS);
	count += subgroupShuffle(count, lane ^ 1u);
	count += subgroupShuffle(count, lane ^ 2u);
	return node__Children(sorted.reference, count);
}

struct node__Entry {
	key: u32,
	reference: u32
}

fn node__exchanged(own: node__Entry, distance: u32, takes_lower: bool) -> node__Entry {
	let key = subgroupShuffle(own.key, lanes__packet_lane ^ distance);
	let reference = subgroupShuffle(own.reference, lanes__packet_lane ^ distance);
	let is_own = (own.key < key) == takes_lower;
	return node__Entry(select(key, own.key, is_own), select(reference, own.reference, is_own));
}

fn node__closest_entry(node: node__SharedNode, rays: lanes__FourRays, limits: vec4i, child: u32) -> u32 {
	let low = vec3f(subgroupShuffle(node.plane.x, child), subgroupShuffle(node.plane.y, child), subgroupShuffle(node.plane.z, child));
	let high = vec3f(subgroupShuffle(node.plane.x, child + 4u), subgroupShuffle(node.plane.y, child + 4u), subgroupShuffle(node.plane.z, child + 4u));
	return min(min(node__entry(node, low, high, rays.r0, limits.x), node__entry(node, low, high, rays.r1, limits.y)), min(node__entry(node, low, high, rays.r2, limits.z), node__entry(node, low, high, rays.r3, limits.w)));
}

fn node__entry(node: node__SharedNode, low: vec3f, high: vec3f, at: primitive__TraversalRay, limit: i32) -> u32 {
	let base = (node.lo - at.ray.origin) * at.inv;
	let step = node.scale * at.inv;
	let t0 = bitcast<vec3i>(low * step + base);
	let t1 = bitcast<vec3i>(high * step + base);
	let first = min(t0, t1);
	let last = max(t0, t1);
	let near = max(max(first.x, first.y), max(first.z, 0));
	let far = min(min(last.x, last.y), last.z);
	return select(node__MISS, bitcast<u32>(near), near <= min(far + node__WIDENING, limit));
}

fn leaf__is_common(reference: u32) -> bool {
	return ((reference & types__LEAF) != 0u) & (reference < types__INSTANCE) & (leaf__has_shapes(reference) == bindings__MOSTLY_SHAPES);
}

fn leaf__is_rare(reference: u32) -> bool {
	return ((reference & types__LEAF) != 0u) & (reference < types__INSTANCE) & (leaf__has_shapes(reference) != bindings__MOSTLY_SHAPES);
}

fn leaf__has_shapes(reference: u32) -> bool {
	return (reference & types__SHAPE) != 0u;
}

struct leaf__Next {
	reference: u32,
	is_last: bool
}

fn leaf__after(reference: u32, top: u32) -> leaf__Next {
	let left = (reference & types__LEAF_COUNT_MASK) / types__LEAF_COUNT_ONE;
	let tested = select(leaf__tested_triangles(reference), 1u, leaf__has_shapes(reference));
	let is_last = left < tested;
	return leaf__Next(select(reference - tested * (types__LEAF_COUNT_ONE - 1u), top, is_last), is_last);
}

fn leaf__tested_triangles(reference: u32) -> u32 {
	return min((reference & types__LEAF_COUNT_MASK) / types__LEAF_COUNT_ONE + 1u, 2u);
}

fn leaf__meet_common(rays: lanes__FourRays, hits: lanes__FourHits, reference: u32) -> lanes__FourHits {
	if (bindings__MOSTLY_SHAPES) {
		return leaf__meet_shape(rays, hits, reference);
	}
	return leaf__meet_triangles(rays, hits, reference);
}

fn leaf__meet_rare(rays: lanes__FourRays, hits: lanes__FourHits, reference: u32) -> lanes__FourHits {
	if (bindings__MOSTLY_SHAPES) {
		return leaf__meet_triangles(rays, hits, reference);
	}
	return leaf__meet_shape(rays, hits, reference);
}

fn leaf__meet_triangles(rays: lanes__FourRays, before: lanes__FourHits, reference: u32) -> lanes__FourHits {
	let count = leaf__tested_triangles(reference);
	let first = select(reference & types__LEAF_FIRST_MASK, 0u, leaf__has_shapes(reference));
	var row = rows__triangle_row(3u * first + lanes__packet_lane);
	if (bindings__COUNT_STEPS) {
		loops__primitives_tested += count;
	}
	var hits = before;
	var index = 0u;
	loop {
		hits = leaf__meet_triangle(rays, hits, leaf__triangle_of(row), first + index);
		continuing {
			index += 1u;
			row = leaf__three_lanes_down(row);
			break if index >= count;
		}
	}
	loops__cut_off |= index < count;
	return hits;
}

fn leaf__triangle_of(row: vec4u) -> types__PackedTriangle {
	return types__PackedTriangle(leaf__corner_of(row, 0u), 0u, leaf__corner_of(row, 1u), 0u, leaf__corner_of(row, 2u), 0u);
}

fn leaf__three_lanes_down(row: vec4u) -> vec4u {
	let lane = (lanes__packet_lane + 3u) & (bindings__PACKET_LANES - 1u);
	return vec4u(subgroupShuffle(row.x, lane), subgroupShuffle(row.y, lane), subgroupShuffle(row.z, lane), 0u);
}

fn leaf__row_of(row: vec4u, lane: u32) -> vec4u {
	return vec4u(subgroupShuffle(row.x, lane), subgroupShuffle(row.y, lane), subgroupShuffle(row.z, lane), subgroupShuffle(row.w, lane));
}

fn leaf__corner_of(row: vec4u, lane: u32) -> vec3f {
	return bitcast<vec3f>(vec3u(subgroupShuffle(row.x, lane), subgroupShuffle(row.y, lane), subgroupShuffle(row.z, lane)));
}

fn leaf__meet_triangle(rays: lanes__FourRays, before: lanes__FourHits, triangle: types__PackedTriangle, primitive: u32) -> lanes__FourHits {
	return lanes__FourHits(lanes__closer_two(rays.r0, before.h0, primitive__test_triangle(rays.r0.ray, triangle, rays.r0.shear), primitive), lanes__closer_two(rays.r1, before.h1, primitive__test_triangle(rays.r1.ray, triangle, rays.r1.shear), primitive), lanes__closer_two(rays.r2, before.h2, primitive__test_triangle(rays.r2.ray, triangle, rays.r2.shear), primitive), lanes__closer_two(rays.r3, before.h3, primitive__test_triangle(rays.r3.ray, triangle, rays.r3.shear), primitive));
}

fn leaf__meet_shape(rays: lanes__FourRays, before: lanes__FourHits, reference: u32) -> lanes__FourHits {
	let index = select(0u, reference & types__LEAF_FIRST_MASK, leaf__has_shapes(reference));
	let primitive = types__SHAPE | index;
	let row = rows__triangle_row(fetch__shape_row + types__SHAPE_ROWS * index + lanes__packet_lane);
	if (bindings__COUNT_STEPS) {
		loops__primitives_tested += 1u;
	}
	let shape = fetch__shape_of(leaf__row_of(row, 0u), leaf__row_of(row, 1u), leaf__row_of(row, 2u), leaf__row_of(row, 3u), leaf__row_of(row, 4u));
	return lanes__FourHits(lanes__closer_two(rays.r0, before.h0, shape__test_shape(rays.r0.ray, shape), primitive), lanes__closer_two(rays.r1, before.h1, shape__test_shape(rays.r1.ray, shape), primitive), lanes__closer_two(rays.r2, before.h2, shape__test_shape(rays.r2.ray, shape), primitive), lanes__closer_two(rays.r3, before.h3, shape__test_shape(rays.r3.ray, shape), primitive));
}

fn dispatch__report_cut_off() {
	let reasons = select(0u, types__CUT_OFF_LOOP, loops__cut_off) | select(0u, types__CUT_OFF_STACK, loops__is_stack_full);
	if (reasons != 0u) {
		atomicOr(&bindings__dispatch.counters.cut_off, reasons);
	}
}

fn groups__count_group(group: vec3u, lane: u32) {
	let run = 8u * group.y + (group.x >> 5u);
	let counter = (run * 2654435761u) >> 29u;
	if (lane == 0u) {
		atomicAdd(&bindings__dispatch.counters.groups_done[counter][0], 1u);
	}
}

override bindings__EXTREMES_BY_SELECT: bool = false;

fn min_f32(a: f32, b: f32) -> f32 {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a < b);
	}
	return min(a, b);
}

fn max_f32(a: f32, b: f32) -> f32 {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a > b);
	}
	return max(a, b);
}

fn clamp_f32(value: f32, low: f32, high: f32) -> f32 {
	return min_f32(max_f32(value, low), high);
}

fn saturate_f32(value: f32) -> f32 {
	return clamp_f32(value, f32(0), f32(1));
}

fn min_vec2f(a: vec2f, b: vec2f) -> vec2f {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a < b);
	}
	return min(a, b);
}

fn max_vec2f(a: vec2f, b: vec2f) -> vec2f {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a > b);
	}
	return max(a, b);
}

fn clamp_vec2f(value: vec2f, low: vec2f, high: vec2f) -> vec2f {
	return min_vec2f(max_vec2f(value, low), high);
}

fn saturate_vec2f(value: vec2f) -> vec2f {
	return clamp_vec2f(value, vec2f(0), vec2f(1));
}

fn min_vec3f(a: vec3f, b: vec3f) -> vec3f {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a < b);
	}
	return min(a, b);
}

fn max_vec3f(a: vec3f, b: vec3f) -> vec3f {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a > b);
	}
	return max(a, b);
}

fn clamp_vec3f(value: vec3f, low: vec3f, high: vec3f) -> vec3f {
	return min_vec3f(max_vec3f(value, low), high);
}

fn saturate_vec3f(value: vec3f) -> vec3f {
	return clamp_vec3f(value, vec3f(0), vec3f(1));
}
