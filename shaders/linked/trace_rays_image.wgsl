@compute @workgroup_size(64, 1, 1)
fn trace_rays(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	fetch__load_starts();
	stack__take_stack(lane);
	let index = 64u * tile__permuted_group(group.x, bindings__dispatch.group_count, bindings__dispatch.group_stride) + lane;
	let query = query__load_query_ray(index);
	shutter__shutter_time = query.time;
	query__store_hit(index, section_walk__followed(section_walk__walk_from(query.ray, bindings__ANY_HIT, vec4u(types__NONE)), traverse__NO_LIMIT).hit);
	dispatch__report_cut_off();
	groups__count_group(group, lane);
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

fn fetch__load_moving_node(reference: u32, moment: motion__Moment, inv: vec3f) -> tracing__Node {
	let moves = (reference & types__MOVING) != 0u;
	let first = (reference & ~types__MOVING) + select(0u, moment.key, moves);
	let second = first + select(0u, 1u, moves);
	return node__node_between(steps__load_node(first, inv), steps__load_node(second, inv), moment.fraction);
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

fn fetch__load_vertex(index: u32) -> types__PackedVertex {
	let r0 = rows__vertex_row(index);
	return types__PackedVertex(bitcast<vec3f>(r0.xyz), r0.w);
}

@group(1) @binding(0)
var<storage, read> bindings__frame: types__PackedFrame;

@group(1) @binding(1)
var<storage, read_write> bindings__dispatch: types__PackedDispatch;

@group(2) @binding(0)
var<storage, read_write> bindings__hits: array<vec4u>;

override bindings__BRUTE_FORCE: bool = false;

override bindings__HAS_REFRACTION: bool = false;

override bindings__TRIANGLE_TEST: u32 = 0u;

override bindings__HAS_TRIANGLES: bool = false;

override bindings__TRIANGLES_OUTSIDE_TREE: u32 = 0u;

override bindings__SHAPES_OUTSIDE_TREE: bool = false;

override bindings__HAS_SHAPES: bool = false;

override bindings__HAS_PLANES: bool = false;

override bindings__SHAPE_KINDS: u32 = 0u;

override bindings__HAS_INSTANCES: bool = false;

override bindings__STACK_REGISTERS: u32 = 0u;

override bindings__HAS_MOTION: bool = false;

override bindings__HAS_DEFORMATION: bool = false;

override bindings__HAS_CONTACT: bool = false;

override bindings__HAS_SECTION: bool = false;

override bindings__COUNT_STEPS: bool = false;

override bindings__ANY_HIT: bool = false;

const types__NONE: u32 = 4294967295u;

const types__LEAF: u32 = 2147483648u;

const types__SHAPE: u32 = 1073741824u;

const types__LEAF_COUNT_ONE: u32 = 134217728u;

const types__LEAF_COUNT_MASK: u32 = 939524096u;

const types__LEAF_FIRST_MASK: u32 = 134217727u;

const types__INSTANCE: u32 = 4160749568u;

const types__MOVING: u32 = 1073741824u;

const types__STACK_SIZE: u32 = 96u;

const types__NO_INSTANCE: u32 = 1048575u;

const types__CUT_OFF_LOOP: u32 = 1u;

const types__CUT_OFF_STACK: u32 = 2u;

const types__NODE_ROWS: u32 = 4u;

const types__INSTANCE_ROWS: u32 = 10u;

const types__KEY_ROWS: u32 = 4u;

const types__SHAPE_ROWS: u32 = 5u;

const types__IMAGE_WIDTH_LOG2: u32 = 12u;

const types__SHAPE_SPHERE: u32 = 0u;

const types__SHAPE_PLANE: u32 = 1u;

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

struct types__PackedVertex {
	normal: vec3f,
	material: u32
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

const stack__SLOT_BITS: u32 = 6u;

var<private> stack__top: u32;

var<private> stack__entries: array<u32, types__STACK_SIZE>;

var<private> stack__s0: vec4u;

var<private> stack__s1: vec4u;

var<private> stack__s2: vec4u;

var<private> stack__s3: vec4u;

var<private> stack__s4: vec4u;

var<private> stack__s5: vec4u;

fn stack__take_stack(lane: u32) {

}

fn stack__start_stack() {
	if (bindings__STACK_REGISTERS > 0u) {
		stack__s0 = vec4u(traverse__EMPTY);
		stack__s1 = vec4u(traverse__EMPTY);
		stack__s2 = vec4u(traverse__EMPTY);
		stack__s3 = vec4u(traverse__EMPTY);
		stack__s4 = vec4u(traverse__EMPTY);
		stack__s5 = vec4u(traverse__EMPTY);
		return;
	}
	stack__top = 0u;
	stack__entries[0] = traverse__EMPTY;
}

fn stack__top_entry() -> u32 {
	if (bindings__STACK_REGISTERS > 0u) {
		return stack__s0.x;
	}
	return stack__entries[stack__top];
}

fn stack__push(sentinel: u32) {
	stack__move_stack(sentinel, 1);
}

fn stack__popped() -> u32 {
	return stack__taken(true);
}

fn stack__taken(is_taken: bool) -> u32 {
	let entry = stack__top_entry();
	let reference = stack__next_of(entry);
	stack__move_stack(select(entry, stack__rest_of(entry), is_taken), select(0, -1, is_taken & stack__ends_with(entry)));
	return reference;
}

fn stack__next_child(node: u32, keys: vec4u, count: u32) -> u32 {
	let entry = stack__top_entry();
	let goes_down = count > 0u;
	let slots = keys & vec4u(3u);
	let reference = stack__next_of(select(entry, (node << stack__SLOT_BITS) | slots.x, goes_down));
	let third = select(slots.y, slots.z, count > 2u);
	let last = select(third, slots.w, count > 3u);
	let others = (node << stack__SLOT_BITS) | slots.y | (third << 2u) | (last << 4u);
	let after = select(select(stack__rest_of(entry), entry, goes_down), others, count > 1u);
	stack__move_stack(after, select(select(0, -1, !goes_down & stack__ends_with(entry)), 1, count > 1u));
	return reference;
}

fn stack__next_of(entry: u32) -> u32 {
	let children = rows__node_row(types__NODE_ROWS * (entry >> stack__SLOT_BITS) + 3u);
	return select(node__child_of(children, entry), entry, entry >= traverse__RETURN);
}

fn stack__rest_of(entry: u32) -> u32 {
	return (entry & ~15u) | ((entry >> 2u) & 15u);
}

fn stack__ends_with(entry: u32) -> bool {
	return ((entry ^ (entry >> 2u)) & 3u) == 0u;
}

fn stack__move_stack(entry: u32, count: i32) {
	if (bindings__STACK_REGISTERS > 0u) {
		stack__move_registers(entry, count);
		return;
	}
	if (count < 0) {
		stack__top -= select(0u, 1u, stack__entries[stack__top] != traverse__EMPTY);
		return;
	}
	stack__top += u32(count);
	stack__entries[stack__top] = entry;
}

fn stack__move_registers(entry: u32, count: i32) {
	loops__is_stack_full |= (count > 0) & (stack__last_register().w != traverse__EMPTY);
	let m0 = stack__moved(vec4u(entry), stack__s0, stack__s1, count);
	var m1: vec4u;
	if (bindings__STACK_REGISTERS > 1u) {
		m1 = stack__moved(stack__s0, stack__s1, stack__s2, count);
	}
	var m2: vec4u;
	if (bindings__STACK_REGISTERS > 2u) {
		m2 = stack__moved(stack__s1, stack__s2, stack__s3, count);
	}
	var m3: vec4u;
	if (bindings__STACK_REGISTERS > 3u) {
		m3 = stack__moved(stack__s2, stack__s3, stack__s4, count);
	}
	var m4: vec4u;
	if (bindings__STACK_REGISTERS > 4u) {
		m4 = stack__moved(stack__s3, stack__s4, stack__s5, count);
	}
	var m5: vec4u;
	if (bindings__STACK_REGISTERS > 5u) {
		m5 = stack__moved(stack__s4, stack__s5, vec4u(traverse__EMPTY), count);
	}
	stack__s0 = m0;
	stack__s0.x = select(m0.x, entry, count == 0);
	if (bindings__STACK_REGISTERS > 1u) {
		stack__s1 = m1;
	}
	if (bindings__STACK_REGISTERS > 2u) {
		stack__s2 = m2;
	}
	if (bindings__STACK_REGISTERS > 3u) {
		stack__s3 = m3;
	}
	if (bindings__STACK_REGISTERS > 4u) {
		stack__s4 = m4;
	}
	if (bindings__STACK_REGISTERS > 5u) {
		stack__s5 = m5;
	}
}

fn stack__last_register() -> vec4u {
	if (bindings__STACK_REGISTERS == 1u) {
		return stack__s0;
	}
	if (bindings__STACK_REGISTERS == 2u) {
		return stack__s1;
	}
	if (bindings__STACK_REGISTERS == 3u) {
		return stack__s2;
	}
	if (bindings__STACK_REGISTERS == 4u) {
		return stack__s3;
	}
	if (bindings__STACK_REGISTERS == 5u) {
		return stack__s4;
	}
	return stack__s5;
}

fn stack__moved(above: vec4u, here: vec4u, below: vec4u, count: i32) -> vec4u {
	let next = select(here, vec4u(here.yzw, below.x), count < 0);
	return select(next, vec4u(above.w, here.xyz), count > 0);
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

struct tracing__Node {
	lo: vec3f,
	scale: vec3f,
	near_x: vec4f,
	far_x: vec4f,
	near_y: vec4f,
	far_y: vec4f,
	near_z: vec4f,
	far_z: vec4f,
	child_count: u32
}

@group(0) @binding(0)
var rows__nodes: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(1)
var rows__triangles: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(2)
var rows__vertices: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(3)
var rows__rays: texture_storage_2d<rgba32uint, read>;

fn rows__node_row(row: u32) -> vec4u {
	return textureLoad(rows__nodes, rows__texel(row));
}

fn rows__triangle_row(row: u32) -> vec4u {
	return textureLoad(rows__triangles, rows__texel(row));
}

fn rows__vertex_row(row: u32) -> vec4u {
	return textureLoad(rows__vertices, rows__texel(row));
}

fn rows__ray_row(row: u32) -> vec4u {
	return textureLoad(rows__rays, rows__texel(row));
}

fn rows__texel(row: u32) -> vec2u {
	return vec2u(row & ((1u << types__IMAGE_WIDTH_LOG2) - 1u), row >> types__IMAGE_WIDTH_LOG2);
}

var<private> shutter__shutter_time: f32;

var<private> loops__nodes_visited: u32;

var<private> loops__primitives_tested: u32;

var<private> loops__cut_off: bool;

var<private> loops__is_stack_full: bool;

struct section_walk__Crossing {
	stage: u32,
	enters: bool,
	shift: f32,
	leaves: bool,
	way: f32,
	hit: tracing__Hit,
	runner_up: tracing__Hit,
	entered: section_walk__Entered,
	surfaces: u32
}

const section_walk__AHEAD: u32 = 0u;

const section_walk__BEHIND: u32 = 1u;

const section_walk__DONE: u32 = 2u;

var<private> section_walk__crossing: section_walk__Crossing;

const section_walk__MAX_SURFACES: u32 = 32u;

fn section_walk__walk_from(ray: tracing__Ray, any: bool, media: vec4u) -> traverse__Walk {
	if (!bindings__HAS_SECTION) {
		return traverse__walk_of(ray, any);
	}
	var kept = ray;
	section_walk__crossing = section_walk__Crossing();
	let height = dot(bindings__frame.section, ray.origin) - bindings__frame.section_offset;
	let rate = dot(bindings__frame.section, ray.direction);
	let is_toward = height * rate < 0.0;
	let way = select(0.0, -height / select(1.0, rate, is_toward), is_toward);
	let reach = numeric__max_component(abs(ray.origin)) + way + abs(bindings__frame.section_offset);
	let slack = min_f32(way, 16.0 * numeric__ROUNDING * reach / max_f32(abs(rate), 0.001));
	if (height > 0.0 && !is_toward) {
		kept.t_max = min_f32(ray.t_max, 0.0);
	}
	else if (height > 0.0) {
		section_walk__crossing.enters = way < ray.t_max;
		section_walk__crossing.shift = way - slack;
		section_walk__crossing.way = slack;
		kept.origin += section_walk__crossing.shift * ray.direction;
		kept.t_max -= section_walk__crossing.shift;
	}
	else if (rate > 0.0 && way < ray.t_max) {
		section_walk__crossing.leaves = section_walk__any_of(media);
		section_walk__crossing.way = way;
		kept.t_max = min_f32(ray.t_max, way + slack);
	}
	return traverse__walk_of(kept, any);
}

fn section_walk__followed(before: traverse__Walk, rounds: u32) -> traverse__Walk {
	var walk = before;
	loop {
		walk = traverse__walked(walk, rounds);
		if (bindings__HAS_SECTION) {
			if (!traverse__is_walking(walk)) {
				walk = section_walk__searched(walk);
			}
		}
		continuing {
		
			break if !bindings__HAS_SECTION || section_walk__crossing.stage == section_walk__DONE || (section_walk__crossing.stage == section_walk__AHEAD && traverse__is_walking(walk));
		}
	}
	return walk;
}

fn section_walk__any_of(media: vec4u) -> bool {
	return bindings__HAS_REFRACTION && any(media != vec4u(types__NONE));
}

fn section_walk__searched(before: traverse__Walk) -> traverse__Walk {
	var walk = before;
	var hit = walk.hit;
	var is_found = false;
	var goes_on = false;
	if (section_walk__crossing.stage == section_walk__AHEAD) {
		goes_on = section_walk__crossing.enters || (section_walk__crossing.leaves && hit.primitive == types__NONE);
		section_walk__crossing.stage = section_walk__BEHIND;
		section_walk__crossing.hit = hit;
		section_walk__crossing.runner_up = primitive__runner_up;
		let start = walk.ray.origin + select(section_walk__crossing.way, 0.0, section_walk__crossing.enters) * walk.ray.direction;
		walk.ray = tracing__Ray(start, camera__T_FAR, walk.ray.direction, types__NONE, types__NO_INSTANCE);
	}
	else if (section_walk__crossing.stage == section_walk__BEHIND && hit.primitive != types__NONE) {
		let crossed = section_walk__crossed_at(walk.ray, hit);
		is_found = section_walk__is_around(section_walk__crossing.entered, crossed);
		section_walk__crossing.entered = section_walk__after(section_walk__crossing.entered, crossed);
		section_walk__crossing.surfaces += 1u;
		goes_on = !is_found && section_walk__crossing.surfaces < section_walk__MAX_SURFACES;
		primitive__passed = hit;
	}
	if (goes_on) {
		return traverse__walk_of(walk.ray, false);
	}
	if (section_walk__crossing.stage == section_walk__BEHIND) {
		section_walk__crossing.stage = section_walk__DONE;
		primitive__passed = tracing__Hit();
		walk.hit = section_walk__crossing.hit;
		primitive__runner_up = section_walk__crossing.runner_up;
		if (is_found) {
			walk.hit = tracing__Hit(section_walk__crossing.way, hit.primitive, 0.0, section__CAP, hit.instance);
			primitive__runner_up = tracing__Hit(camera__T_FAR, types__NONE, 0.0, 0.0, types__NO_INSTANCE);
		}
		walk.hit.t += section_walk__crossing.shift;
		primitive__runner_up.t += section_walk__crossing.shift;
	}
	return walk;
}

struct section_walk__Crossed {
	solid: u32,
	leaves: bool,
	t: f32
}

struct section_walk__Entered {
	solids: array<u32, section_walk__MOST_ENTERED>,
	count: u32,
	last: section_walk__Crossed
}

const section_walk__MOST_ENTERED: u32 = 16u;

fn section_walk__is_around(entered: section_walk__Entered, crossed: section_walk__Crossed) -> bool {
	let is_open = crossed.solid == types__NONE || !crossed.leaves;
	return !is_open && !section_walk__is_again(entered, crossed) && section_walk__place_of(entered, crossed.solid) == entered.count;
}

fn section_walk__is_again(entered: section_walk__Entered, crossed: section_walk__Crossed) -> bool {
	let last = entered.last;
	let is_near = abs(crossed.t - last.t) <= 1e-6 * crossed.t;
	return last.solid == crossed.solid && last.leaves == crossed.leaves && is_near;
}

fn section_walk__place_of(entered: section_walk__Entered, solid: u32) -> u32 {
	var place = entered.count;
	var k = 0u;
	loop {
		place = select(place, k, k < entered.count && entered.solids[k] == solid);
		continuing {
			k += 1u;
			break if k >= section_walk__MOST_ENTERED;
		}
	}
	loops__cut_off |= k < section_walk__MOST_ENTERED;
	return place;
}

fn section_walk__after(before: section_walk__Entered, crossed: section_walk__Crossed) -> section_walk__Entered {
	var entered = before;
	if (crossed.solid == types__NONE || section_walk__is_again(before, crossed)) {
		return entered;
	}
	entered.last = crossed;
	if (crossed.leaves) {
		let place = section_walk__place_of(before, crossed.solid);
		if (place < before.count) {
			entered.count -= 1u;
			entered.solids[place] = before.solids[entered.count];
		}
	}
	else if ((crossed.solid & types__SHAPE) == 0u) {
		entered.solids[min(before.count, section_walk__MOST_ENTERED - 1u)] = crossed.solid;
		entered.count = min(before.count + 1u, section_walk__MOST_ENTERED);
	}
	return entered;
}

fn section_walk__crossed_at(ray: tracing__Ray, hit: tracing__Hit) -> section_walk__Crossed {
	var instance: types__PackedInstance;
	var local = ray;
	let is_placed = bindings__HAS_INSTANCES && hit.instance != types__NO_INSTANCE;
	if (is_placed) {
		instance = fetch__load_instance(hit.instance);
		local = instance__object_ray(ray, instance__space_of(instance));
	}
	if (bindings__HAS_SHAPES && (!bindings__HAS_TRIANGLES || (hit.primitive & types__SHAPE) != 0u)) {
		let shape = fetch__load_shape(hit.primitive & ~types__SHAPE);
		let reached = local.origin + hit.t * local.direction;
		let leaves = dot(shape_surface__shape_point(shape, reached, hit.b1, local.direction).ng, local.direction) > 0.0;
		return section_walk__Crossed(select(types__NONE, hit.primitive, section__is_closed(shape)), leaves, hit.t);
	}
	if (!bindings__HAS_TRIANGLES || (hit.primitive & types__SHAPE) != 0u) {
		return section_walk__Crossed(types__NONE, false, hit.t);
	}
	let mesh = section__closed_mesh_of(hit.primitive);
	let keys = deforming__keys_of(instance);
	let own = deforming__triangle_now(hit.primitive, keys);
	var normals = mat3x3f(fetch__load_vertex(own.i0).normal, fetch__load_vertex(own.i1).normal, fetch__load_vertex(own.i2).normal);
	if (bindings__HAS_DEFORMATION) {
		if (keys.next != 0u) {
			normals = deforming__normals_now(hit.primitive, keys);
		}
	}
	let n = normals * vec3f(1.0 - hit.b1 - hit.b2, hit.b1, hit.b2);
	let across = cross(own.v1 - own.v0, own.v2 - own.v0);
	let leaves = (dot(n, across) < 0.0) != (dot(across, local.direction) > 0.0);
	let id = mesh + bindings__frame.solid_count * select(0u, hit.instance + 1u, is_placed);
	return section_walk__Crossed(select(types__NONE, id & ~types__SHAPE, mesh != types__NONE), leaves, hit.t);
}

const traverse__EMPTY: u32 = 4294967295u;

const traverse__RETURN: u32 = 4294967232u;

const traverse__CONTACT_RANGE: f32 = 0.0001;

struct traverse__Walk {
	ray: tracing__Ray,
	shear: triangle_watertight__Shear,
	any: bool,
	at: primitive__TraversalRay,
	hit: tracing__Hit,
	current: u32
}

const traverse__NO_LIMIT: u32 = 4294967295u;

fn traverse__search_limit(ray: tracing__Ray, hit: tracing__Hit) -> f32 {
	if (bindings__HAS_CONTACT) {
		return hit.t + traverse__CONTACT_RANGE * (hit.t + numeric__max_component(abs(ray.origin)));
	}
	return hit.t;
}

fn traverse__walk_of(ray: tracing__Ray, any: bool) -> traverse__Walk {
	if (bindings__HAS_CONTACT) {
		primitive__runner_up = tracing__Hit(camera__T_FAR, types__NONE, 0.0, 0.0, types__NO_INSTANCE);
	}
	let shear = triangle_watertight__shear_of(ray.direction);
	var walk = traverse__Walk(ray, shear, any, primitive__traversal_ray(ray, shear, types__NO_INSTANCE, deforming__NO_KEYS), tracing__Hit(ray.t_max, types__NONE, 0.0, 0.0, types__NO_INSTANCE), traverse__EMPTY);
	if (bindings__HAS_PLANES) {
		walk.hit = exhaustive__hit_planes(ray, walk.hit);
	}
	walk.hit = exhaustive__hit_apart(walk.at, walk.hit);
	if (bindings__COUNT_STEPS) {
		loops__primitives_tested += exhaustive__apart_count();
	}
	if (bindings__BRUTE_FORCE) {
		walk.hit = exhaustive__hit_everything(ray, shear, walk.hit);
		return walk;
	}
	if ((bindings__HAS_TRIANGLES || bindings__HAS_SHAPES) && ray.t_max >= 0.0 && !(any && walk.hit.primitive != types__NONE)) {
		stack__start_stack();
		walk.current = 0u;
		if (bindings__HAS_INSTANCES) {
			walk.current = fetch__root;
		}
	}
	return walk;
}

fn traverse__is_walking(walk: traverse__Walk) -> bool {
	return walk.current != traverse__EMPTY;
}

fn traverse__walked(before: traverse__Walk, rounds: u32) -> traverse__Walk {
	var walk = before;
	var round = 0u;
	if (traverse__is_walking(walk)) {
		loop {
			if (bindings__HAS_INSTANCES) {
				walk = traverse__in_its_space(walk);
			}
			let is_node = !bindings__HAS_INSTANCES || (walk.current & types__LEAF) == 0u;
			if (is_node) {
				walk = steps__through_nodes(walk);
				loops__cut_off |= (walk.current & types__LEAF) == 0u;
			}
			let is_leaf = walk.current != traverse__EMPTY && (!bindings__HAS_INSTANCES || walk.current < types__INSTANCE);
			if (is_leaf) {
				walk = steps__through_leaves(walk);
			}
			round += 1u;
			continuing {
			
				break if !traverse__is_walking(walk) | (round >= rounds);
			}
		}
		loops__cut_off |= traverse__is_walking(walk) & (round < rounds);
	}
	return walk;
}

fn traverse__in_its_space(before: traverse__Walk) -> traverse__Walk {
	var walk = before;
	if (walk.current == traverse__RETURN) {
		walk.at = primitive__traversal_ray(walk.ray, walk.shear, types__NO_INSTANCE, deforming__NO_KEYS);
		walk.current = stack__popped();
	}
	if ((walk.current >= types__INSTANCE) & (walk.current != traverse__EMPTY)) {
		let index = walk.current & types__LEAF_FIRST_MASK;
		let instance = fetch__load_instance(index);
		let local = instance__object_ray(walk.ray, instance__space_of(instance));
		walk.at = primitive__traversal_ray(local, triangle_watertight__shear_of(local.direction), index, deforming__keys_of(instance));
		stack__push(traverse__RETURN);
		walk.current = instance.root;
	}
	return walk;
}

fn traverse__load_current_node(reference: u32, at: primitive__TraversalRay) -> tracing__Node {
	if (bindings__HAS_MOTION || bindings__HAS_DEFORMATION) {
		return deforming__node_now(reference, at.keys, at.inv);
	}
	return steps__load_node(reference, at.inv);
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

fn primitive__closer(at: primitive__TraversalRay, hit: tracing__Hit, primitive: u32) -> tracing__Hit {
	return primitive__closer_of(at, hit, primitive__test_primitive(at, primitive), primitive);
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

fn primitive__test_primitive(at: primitive__TraversalRay, primitive: u32) -> tracing__Candidate {
	let has_triangles = bindings__HAS_TRIANGLES && bindings__TRIANGLES_OUTSIDE_TREE == 0u;
	let has_shapes = bindings__HAS_SHAPES && !bindings__SHAPES_OUTSIDE_TREE;
	var candidate = tracing__Candidate(false, 0.0, 0.0, 0.0);
	if (has_triangles && (!has_shapes || (primitive & types__SHAPE) == 0u)) {
		candidate = primitive__test_triangle(at.ray, deforming__triangle_now(primitive, at.keys), at.shear);
	}
	if (has_shapes && (!has_triangles || (primitive & types__SHAPE) != 0u)) {
		candidate = shape__test_shape(at.ray, fetch__load_shape(primitive & ~types__SHAPE));
	}
	return candidate;
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

struct deforming__Keys {
	next: u32,
	stride: u32
}

const deforming__NO_KEYS: deforming__Keys = deforming__Keys(0u, 0u);

fn deforming__keys_of(instance: types__PackedInstance) -> deforming__Keys {
	if (bindings__HAS_DEFORMATION) {
		return deforming__Keys(instance.next_key, instance.count);
	}
	return deforming__NO_KEYS;
}

fn deforming__node_now(reference: u32, keys: deforming__Keys, inv: vec3f) -> tracing__Node {
	var key_count = 2u;
	if (bindings__HAS_DEFORMATION) {
		key_count = select(2u, bindings__frame.deformation_key_count, keys.next != 0u);
	}
	return fetch__load_moving_node(reference, motion__moment_of(shutter__shutter_time, key_count), inv);
}

fn deforming__index_at(primitive: u32, keys: deforming__Keys, key: u32) -> u32 {
	return primitive + select(0u, keys.next + (key - 1u) * keys.stride, key > 0u);
}

fn deforming__triangle_now(primitive: u32, keys: deforming__Keys) -> types__PackedTriangle {
	let first = fetch__load_triangle(primitive);
	if (bindings__HAS_DEFORMATION) {
		if (keys.next != 0u) {
			let moment = motion__moment_of(shutter__shutter_time, bindings__frame.deformation_key_count);
			let a = fetch__load_triangle(deforming__index_at(primitive, keys, moment.key));
			let b = fetch__load_triangle(deforming__index_at(primitive, keys, moment.key + 1u));
			let fraction = vec3f(moment.fraction);
			return types__PackedTriangle(mix(a.v0, b.v0, fraction), first.i0, mix(a.v1, b.v1, fraction), first.i1, mix(a.v2, b.v2, fraction), first.i2);
		}
	}
	return first;
}

fn deforming__normals_now(primitive: u32, keys: deforming__Keys) -> mat3x3f {
	let moment = motion__moment_of(shutter__shutter_time, bindings__frame.deformation_key_count);
	let a = deforming__normals_at(deforming__index_at(primitive, keys, moment.key));
	let b = deforming__normals_at(deforming__index_at(primitive, keys, moment.key + 1u));
	return a * (1.0 - moment.fraction) + b * moment.fraction;
}

fn deforming__normals_at(triangle: u32) -> mat3x3f {
	let own = fetch__load_triangle(triangle);
	return mat3x3f(fetch__load_vertex(own.i0).normal, fetch__load_vertex(own.i1).normal, fetch__load_vertex(own.i2).normal);
}

const numeric__ROUNDING: f32 = 5.9604645e-8;

fn numeric__normalize_or(v: vec3f, fallback: vec3f) -> vec3f {
	let largest = max_f32(abs(v.x), max_f32(abs(v.y), abs(v.z)));
	let usable = largest > 1e-30;
	let shrink = select(1.0, 2.3283064e-10, largest > 1e37);
	let scaled = select(vec3f(1.0, 0.0, 0.0), (shrink * v) / select(1.0, shrink * largest, usable), usable);
	return select(fallback, scaled * inverseSqrt(dot(scaled, scaled)), usable);
}

fn numeric__safe_reciprocal(d: vec3f) -> vec3f {
	let tiny = abs(d) < vec3f(1e-18);
	return 1.0 / select(d, select(vec3f(1e-18), vec3f(-1e-18), d < vec3f(0.0)), tiny);
}

fn numeric__max_component(v: vec3f) -> f32 {
	return max_f32(v.x, max_f32(v.y, v.z));
}

const node__MISS: u32 = 4294967292u;

const node__WIDENING: i32 = 8;

fn node__bytes(word: u32) -> vec4f {
	return vec4f((vec4u(word) >> vec4u(0u, 8u, 16u, 24u)) & vec4u(255u));
}

fn node__decode_node(r0: vec4u, r1: vec4u, r2: vec4u, inv: vec3f) -> tracing__Node {
	let goes_down = inv < vec3f(0.0);
	return tracing__Node(bitcast<vec3f>(r0.xyz), bitcast<vec3f>(vec3u(r0.w, r1.xy)), node__bytes(select(r1.z, r1.w, goes_down.x)), node__bytes(select(r1.w, r1.z, goes_down.x)), node__bytes(select(r2.x, r2.y, goes_down.y)), node__bytes(select(r2.y, r2.x, goes_down.y)), node__bytes(select(r2.z, r2.w, goes_down.z)), node__bytes(select(r2.w, r2.z, goes_down.z)), r0.w & 7u);
}

fn node__node_between(a: tracing__Node, b: tracing__Node, fraction: f32) -> tracing__Node {
	let shift = b.lo - a.lo;
	let s = vec4f(fraction);
	return tracing__Node(a.lo, vec3f(1.0), mix(a.scale.x * a.near_x, b.scale.x * b.near_x + shift.x, s), mix(a.scale.x * a.far_x, b.scale.x * b.far_x + shift.x, s), mix(a.scale.y * a.near_y, b.scale.y * b.near_y + shift.y, s), mix(a.scale.y * a.far_y, b.scale.y * b.far_y + shift.y, s), mix(a.scale.z * a.near_z, b.scale.z * b.near_z + shift.z, s), mix(a.scale.z * a.far_z, b.scale.z * b.far_z + shift.z, s), a.child_count);
}

fn node__child_keys(node: tracing__Node, origin: vec3f, inv: vec3f, t_max: f32) -> vec4u {
	let base = (node.lo - origin) * inv;
	let step = node.scale * inv;
	let x0 = bitcast<vec4i>(node.near_x * step.x + base.x);
	let x1 = bitcast<vec4i>(node.far_x * step.x + base.x);
	let y0 = bitcast<vec4i>(node.near_y * step.y + base.y);
	let y1 = bitcast<vec4i>(node.far_y * step.y + base.y);
	let z0 = bitcast<vec4i>(node.near_z * step.z + base.z);
	let z1 = bitcast<vec4i>(node.far_z * step.z + base.z);
	let exist = vec4u(0u, 1u, 2u, 3u) < vec4u(node.child_count);
	return node__keys_of(max(max(x0, y0), z0), min(min(x1, y1), z1), t_max, exist);
}

fn node__keys_of(enter: vec4i, leave: vec4i, t_max: f32, exist: vec4<bool>) -> vec4u {
	let near = max(enter, vec4i(0));
	let limit = min(leave + node__WIDENING, vec4i(bitcast<i32>(t_max) + node__WIDENING));
	let keys = (bitcast<vec4u>(near) & vec4u(4294967292u)) | vec4u(0u, 1u, 2u, 3u);
	return select(vec4u(node__MISS), keys, (near <= limit) & exist);
}

fn node__sort4(keys: vec4u) -> vec4u {
	let a = vec4u(min(keys.xz, keys.yw), max(keys.xz, keys.yw));
	let lowest = min(a.x, a.y);
	let middle_low = max(a.x, a.y);
	let middle_high = min(a.z, a.w);
	let highest = max(a.z, a.w);
	return vec4u(lowest, min(middle_low, middle_high), max(middle_low, middle_high), highest);
}

fn node__child_of(children: vec4u, key: u32) -> u32 {
	let first = select(children.xz, children.yw, vec2<bool>((key & 1u) != 0u));
	return select(first.x, first.y, (key & 2u) != 0u);
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

fn steps__load_node(index: u32, inv: vec3f) -> tracing__Node {
	let row = types__NODE_ROWS * index;
	return node__decode_node(rows__node_row(row), rows__node_row(row + 1u), rows__node_row(row + 2u), inv);
}

fn steps__through_nodes(before: traverse__Walk) -> traverse__Walk {
	var walk = before;
	loop {
		let node = traverse__load_current_node(walk.current, walk.at);
		let keys = node__sort4(node__child_keys(node, walk.at.ray.origin, walk.at.inv, traverse__search_limit(walk.ray, walk.hit)));
		walk.current = stack__next_child(walk.current, keys, steps__hit_count(keys));
		if (bindings__COUNT_STEPS) {
			loops__nodes_visited += 1u;
		}
		continuing {
		
			break if (walk.current & types__LEAF) != 0u;
		}
	}
	return walk;
}

fn steps__hit_count(keys: vec4u) -> u32 {
	let hits = select(vec4u(0u), vec4u(1u), keys < vec4u(node__MISS));
	return hits.x + hits.y + hits.z + hits.w;
}

fn steps__through_leaves(before: traverse__Walk) -> traverse__Walk {
	var walk = before;
	loop {
		walk.hit = primitive__closer(walk.at, walk.hit, walk.current & (types__SHAPE | types__LEAF_FIRST_MASK));
		let is_last = (walk.current & types__LEAF_COUNT_MASK) == 0u;
		walk.current = select(walk.current - types__LEAF_COUNT_ONE + 1u, stack__taken(is_last), is_last);
		walk.current = select(walk.current, traverse__EMPTY, walk.any & (walk.hit.primitive != types__NONE));
		if (bindings__COUNT_STEPS) {
			loops__primitives_tested += 1u;
		}
		continuing {
		
			break if ((walk.current & types__LEAF) == 0u) | (walk.current >= types__INSTANCE);
		}
	}
	return walk;
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

fn shape__canonical_point(shape: types__PackedShape, reached: vec3f, part: f32) -> canonical__CanonicalPoint {
	let p = canonical__canonical_vector(shape, reached - shape.position);
	var point: canonical__CanonicalPoint;
	if ((bindings__SHAPE_KINDS & shape__DISCS) != 0u && (bindings__SHAPE_KINDS == shape__DISCS || shape.kind == types__SHAPE_DISC)) {
		point = disc__disc_point(p);
	}
	if ((bindings__SHAPE_KINDS & shape__RECTANGLES) != 0u && (bindings__SHAPE_KINDS == shape__RECTANGLES || shape.kind == types__SHAPE_RECTANGLE)) {
		point = rectangle__rectangle_point(p);
	}
	if ((bindings__SHAPE_KINDS & shape__BOXES) != 0u && (bindings__SHAPE_KINDS == shape__BOXES || shape.kind == types__SHAPE_BOX)) {
		point = box__box_point(p, part);
	}
	if ((bindings__SHAPE_KINDS & shape__CONES) != 0u && (bindings__SHAPE_KINDS == shape__CONES || shape.kind == types__SHAPE_CONE)) {
		point = cone__cone_point(p, shape.size0, shape.size1, part);
	}
	if ((bindings__SHAPE_KINDS & shape__TORI) != 0u && (bindings__SHAPE_KINDS == shape__TORI || shape.kind == types__SHAPE_TORUS)) {
		point = torus__torus_point(p, shape.size0);
	}
	if ((bindings__SHAPE_KINDS & shape__ELLIPSOIDS) != 0u && (bindings__SHAPE_KINDS == shape__ELLIPSOIDS || shape.kind == types__SHAPE_ELLIPSOID)) {
		point = ellipsoid__ellipsoid_point(p);
	}
	return point;
}

fn shape__is_round(kind: u32) -> bool {
	if ((bindings__SHAPE_KINDS & (shape__SPHERES | shape__GLOBES)) == 0u) {
		return false;
	}
	return (bindings__SHAPE_KINDS & ~(shape__SPHERES | shape__GLOBES)) == 0u || kind == types__SHAPE_SPHERE || kind == types__SHAPE_GLOBE;
}

fn shape__is_globe(kind: u32) -> bool {
	return (bindings__SHAPE_KINDS & shape__GLOBES) != 0u && (bindings__SHAPE_KINDS == shape__GLOBES || kind == types__SHAPE_GLOBE);
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

fn globe__globe_point(shape: types__PackedShape, reached: vec3f) -> canonical__PlacedPoint {
	let w = reached - shape.position;
	let f = shape.row_y + shape.size0 * w;
	let height = (shape.size0 * dot(w, w) + 2.0 * dot(shape.row_y, w)) / (1.0 + length(f));
	let ng = numeric__normalize_or(f, shape.row_y);
	let p = reached - height * ng;
	return canonical__PlacedPoint(p, ng, 16.0 * numeric__ROUNDING * (abs(p) + abs(shape.position) + 2.0 * length(w)));
}

const canonical__TWO_PI: f32 = 6.2831855;

struct canonical__CanonicalPoint {
	p: vec3f,
	n: vec3f,
	uv: vec2f
}

struct canonical__PlacedPoint {
	p: vec3f,
	ng: vec3f,
	error: vec3f
}

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

fn canonical__placed_point(shape: types__PackedShape, reached: vec3f, point: canonical__CanonicalPoint) -> canonical__PlacedPoint {
	let inv_lengths = 1.0 / vec3f(length(shape.row_x), length(shape.row_y), length(shape.row_z));
	let x = shape.row_x * inv_lengths.x;
	let y = shape.row_y * inv_lengths.y;
	let z = shape.row_z * inv_lengths.z;
	let normal_x = cross(y, z);
	let det = dot(x, normal_x);
	let scale = inv_lengths / select(1.0, det, abs(det) > 1e-20);
	let column_x = scale.x * normal_x;
	let column_y = scale.y * cross(z, x);
	let column_z = scale.z * cross(x, y);
	let q = reached - shape.position;
	let way = point.p - canonical__canonical_vector(shape, q);
	let p = reached + (way.x * column_x + way.y * column_y + way.z * column_z);
	let size = vec3f(dot(abs(shape.row_x), abs(q)), dot(abs(shape.row_y), abs(q)), dot(abs(shape.row_z), abs(q))) + 1.0;
	let reach = size.x * abs(column_x) + size.y * abs(column_y) + size.z * abs(column_z);
	let normal = point.n.x * shape.row_x + point.n.y * shape.row_y + point.n.z * shape.row_z;
	return canonical__PlacedPoint(p, numeric__normalize_or(normal, y), offset__placed_error(p, shape.position, reach));
}

fn canonical__longitude(x: f32, z: f32) -> f32 {
	let on_axis = (x == 0.0) & (z == 0.0);
	return saturate_f32(0.5 + atan2(x, select(z, 1.0, on_axis)) / canonical__TWO_PI);
}

fn canonical__sphere_uv(n: vec3f) -> vec2f {
	let off_axis = length(n.xz);
	let at_center = (off_axis == 0.0) & (n.y == 0.0);
	let latitude = atan2(n.y, select(off_axis, 1.0, at_center));
	return vec2f(canonical__longitude(n.x, n.z), saturate_f32(0.5 + 2.0 * latitude / canonical__TWO_PI));
}

fn canonical__outwards(v: vec2f) -> vec2f {
	let size = length(v);
	let usable = size > 1e-18;
	return select(vec2f(1.0, 0.0), v / select(1.0, size, usable), usable);
}

fn disc__intersect_disc(ray: tracing__Ray, hole: f32) -> tracing__Candidate {
	let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
	let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
	let p = clamp_vec2f(ray.origin.xz + t * ray.direction.xz, vec2f(-2.0), vec2f(2.0));
	let distance = dot(p, p);
	return tracing__Candidate(steep & (t > 0.0) & (distance <= 1.0) & (distance >= hole * hole), t, 0.0, 0.0);
}

fn disc__disc_point(p: vec3f) -> canonical__CanonicalPoint {
	return canonical__CanonicalPoint(vec3f(p.x, 0.0, p.z), vec3f(0.0, 1.0, 0.0), saturate_vec2f(0.5 + 0.5 * vec2f(p.x, -p.z)));
}

fn rectangle__intersect_rectangle(ray: tracing__Ray) -> tracing__Candidate {
	let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
	let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
	let way = t * ray.direction.xz;
	let slack = 4.0 * numeric__ROUNDING * (abs(ray.origin.xz) + abs(way));
	let inside = all(abs(ray.origin.xz + way) <= 1.0 + slack);
	return tracing__Candidate(steep & (t > 0.0) & inside, t, 0.0, 0.0);
}

fn rectangle__rectangle_point(p: vec3f) -> canonical__CanonicalPoint {
	return canonical__CanonicalPoint(vec3f(p.x, 0.0, p.z), vec3f(0.0, 1.0, 0.0), saturate_vec2f(0.5 + 0.5 * vec2f(p.x, -p.z)));
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

fn box__box_point(p: vec3f, side: f32) -> canonical__CanonicalPoint {
	let code = u32(side + 0.5);
	let positive = code >= 3u;
	let axis = code - select(0u, 3u, positive);
	let sign = select(-1.0, 1.0, positive);
	let n = box__box_normal(side);
	let place = select(p, n, n != vec3f(0.0));
	let right = select(select(sign * p.x, p.x, axis == 1u), -sign * p.z, axis == 0u);
	let up = select(p.y, -sign * p.z, axis == 1u);
	return canonical__CanonicalPoint(place, n, saturate_vec2f(0.5 + 0.5 * vec2f(right, up)));
}

fn box__box_normal(side: f32) -> vec3f {
	let code = u32(side + 0.5);
	let axis = code % 3u;
	return select(vec3f(0.0), vec3f(select(-1.0, 1.0, code >= 3u)), vec3<bool>(axis == 0u, axis == 1u, axis == 2u));
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

fn cone__cone_point(p: vec3f, bottom: f32, top: f32, part: f32) -> canonical__CanonicalPoint {
	let slope = top - bottom;
	let out = canonical__outwards(p.xz);
	if (part < 0.5) {
		let y = saturate_f32(p.y);
		let radius = bottom + slope * y;
		return canonical__CanonicalPoint(vec3f(radius * out.x, y, radius * out.y), cone__cone_side_normal(out, slope), vec2f(canonical__longitude(p.x, p.z), y));
	}
	let is_top = part > 1.5;
	let radius = select(bottom, top, is_top);
	let flat = out * min_f32(length(p.xz), radius);
	let sign = select(-1.0, 1.0, is_top);
	let uv = vec2f(flat.x, -sign * flat.y) / max_f32(radius, 1e-18);
	return canonical__CanonicalPoint(vec3f(flat.x, select(0.0, 1.0, is_top), flat.y), vec3f(0.0, sign, 0.0), saturate_vec2f(0.5 + 0.5 * uv));
}

fn cone__cone_side_normal(out: vec2f, slope: f32) -> vec3f {
	return vec3f(out.x, -slope, out.y) * inverseSqrt(1.0 + slope * slope);
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

fn torus__torus_point(p: vec3f, minor: f32) -> canonical__CanonicalPoint {
	let out = canonical__outwards(p.xz);
	let tube = canonical__outwards(vec2f(length(p.xz) - 1.0, p.y));
	let n = vec3f(tube.x * out.x, tube.y, tube.x * out.y);
	let ring = 1.0 + minor * tube.x;
	let place = vec3f(ring * out.x, minor * tube.y, ring * out.y);
	return canonical__CanonicalPoint(place, n, vec2f(canonical__longitude(p.x, p.z), saturate_f32(0.5 + atan2(tube.y, tube.x) / canonical__TWO_PI)));
}

fn ellipsoid__intersect_ellipsoid(ray: tracing__Ray) -> tracing__Candidate {
	let near = canonical__approach(ray, vec3f(0.0), 1.5);
	let found = sphere__intersect_sphere(tracing__Ray(near.origin, ray.t_max, near.direction, types__NONE, ray.leaving_instance), vec3f(0.0), 1.0);
	return tracing__Candidate(near.near & found.hit, canonical__approached_t(near, found.t), 0.0, 0.0);
}

fn ellipsoid__ellipsoid_point(p: vec3f) -> canonical__CanonicalPoint {
	let n = numeric__normalize_or(p, vec3f(0.0, 1.0, 0.0));
	return canonical__CanonicalPoint(n, n, canonical__sphere_uv(n));
}

const camera__T_FAR: f32 = 3e38;

fn shape_surface__shape_point(shape: types__PackedShape, reached: vec3f, part: f32, direction: vec3f) -> canonical__PlacedPoint {
	if (!shape__is_round(shape.kind)) {
		return canonical__placed_point(shape, reached, shape__canonical_point(shape, reached, part));
	}
	return shape_surface__sphere_point(shape, reached, direction);
}

fn shape_surface__sphere_point(shape: types__PackedShape, reached: vec3f, direction: vec3f) -> canonical__PlacedPoint {
	if (shape__is_globe(shape.kind)) {
		return globe__globe_point(shape, reached);
	}
	let ng = numeric__normalize_or(reached - shape.position, -direction);
	return canonical__PlacedPoint(shape.position + shape.size0 * ng, ng, offset__sphere_error(shape.position, shape.size0));
}

fn offset__sphere_error(center: vec3f, radius: f32) -> vec3f {
	return 16.0 * numeric__ROUNDING * (abs(center) + vec3f(radius));
}

fn offset__placed_error(p: vec3f, position: vec3f, reach: vec3f) -> vec3f {
	return 16.0 * numeric__ROUNDING * (abs(p) + abs(position) + reach);
}

const section__CAP: f32 = -1.0;

fn section__closed_mesh_of(triangle: u32) -> u32 {
	if (bindings__frame.solid_count == 0u) {
		return types__NONE;
	}
	let vertex = fetch__load_triangle(triangle).i0;
	var low = 0u;
	var high = bindings__frame.solid_count - 1u;
	loop {
		let middle = (low + high + 1u) / 2u;
		let is_before = section__load_solid(middle).x <= vertex;
		low = select(low, middle, is_before);
		high = select(max(middle, 1u) - 1u, high, is_before);
		continuing {
		
			break if low >= high;
		}
	}
	loops__cut_off |= low < high;
	let range = section__load_solid(low);
	return select(types__NONE, low, range.x <= vertex && vertex < range.y);
}

fn section__is_closed(shape: types__PackedShape) -> bool {
	return shape.kind != types__SHAPE_PLANE && shape.kind != types__SHAPE_DISC && shape.kind != types__SHAPE_RECTANGLE && (shape.kind != types__SHAPE_CONE || (shape.flags & types__SHAPE_CAPPED) != 0u);
}

fn section__load_solid(index: u32) -> vec2u {
	return rows__node_row(bindings__frame.solid_row + index).xy;
}

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

fn exhaustive__hit_everything(ray: tracing__Ray, shear: triangle_watertight__Shear, start: tracing__Hit) -> tracing__Hit {
	let world = primitive__traversal_ray(ray, shear, types__NO_INSTANCE, deforming__NO_KEYS);
	var hit = start;
	if (bindings__HAS_TRIANGLES && bindings__TRIANGLES_OUTSIDE_TREE == 0u) {
		hit = exhaustive__hit_run(world, hit, bindings__frame.first_triangle, bindings__frame.triangle_count);
	}
	if (bindings__HAS_SHAPES && !bindings__SHAPES_OUTSIDE_TREE) {
		hit = exhaustive__hit_run(world, hit, types__SHAPE, bindings__frame.shape_count);
	}
	if (bindings__HAS_INSTANCES) {
		var index = 0u;
		for (; index < bindings__frame.instance_count; index += 1u) {
			let instance = fetch__load_instance(index);
			let local = instance__object_ray(ray, instance__space_of(instance));
			let at = primitive__traversal_ray(local, triangle_watertight__shear_of(local.direction), index, deforming__keys_of(instance));
			hit = exhaustive__hit_run(at, hit, instance.first, instance.count);
		}
		loops__cut_off |= index < bindings__frame.instance_count;
	}
	return hit;
}

fn exhaustive__hit_run(at: primitive__TraversalRay, start: tracing__Hit, first: u32, count: u32) -> tracing__Hit {
	var hit = start;
	var index = 0u;
	for (; index < count; index += 1u) {
		hit = primitive__closer(at, hit, first + index);
	}
	loops__cut_off |= index < count;
	return hit;
}

fn plane__intersect_plane(ray: tracing__Ray, point: vec3f, n: vec3f) -> tracing__Candidate {
	let slope = dot(n, ray.direction);
	let steep = abs(slope) > 1e-12;
	let t = dot(n, point - ray.origin) / select(1.0, slope, steep);
	return tracing__Candidate(steep & (t > 0.0), t, 0.0, 0.0);
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
