@compute @workgroup_size(64, 1, 1)
fn debug_view(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	let batch = dispatch__load_batch();
	stack__take_stack(lane);
	let work = block__work_of(block__load_block(group), lane);
	let key = rng__pixel_key(batch.seed, work.pixel);
	if (work.inside) {
		var sum = film__load_sum(work.film_index, batch.first_sample);
		var sample = batch.first_sample;
		loop {
			let color = view(batch, dispatch__sample_ray(batch, work.pixel, key, sample));
			sum = film__add_sample(sum, film__Sample(color), dispatch__sample_weight(key, sample));
			continuing {
				sample += 1u;
				break if sample >= batch.end_sample;
			}
		}
		loops__cut_off |= sample < batch.end_sample;
		film__store_sum(work.film_index, sum);
	}
	dispatch__add_counts(group, lane);
}

fn view(batch: dispatch__Batch, ray: tracing__Ray) -> vec3f {
	let before = loops__nodes_visited + loops__primitives_tested;
	let hit = section_walk__closest_hit(ray, batch.camera_media);
	if (bindings__VIEW == types__VIEW_HEAT) {
		return vec3f(f32(loops__nodes_visited + loops__primitives_tested - before));
	}
	if (hit.primitive == types__NONE) {
		return vec3f(0.0);
	}
	if (bindings__VIEW == types__VIEW_DEPTH) {
		return vec3f(dispatch__way_to_near(batch, ray.direction) + hit.t, 1.0, 0.0);
	}
	let surface = surface__surface_at(ray, hit, footprint__camera_cone(batch, ray.direction));
	if (bindings__VIEW == types__VIEW_IDS) {
		return colormap__id_color(surface.id);
	}
	if (bindings__VIEW == types__VIEW_UV) {
		return colormap__uv_color(surface.uv);
	}
	return 0.5 * surface.n + 0.5;
}

struct dispatch__RayCounts {
	primary: u32,
	primary_hits: u32,
	shadow: u32,
	shadow_blocked: u32,
	reflection: u32,
	reflection_hits: u32,
	refraction: u32,
	refraction_hits: u32
}

var<private> dispatch__counts: dispatch__RayCounts;

var<private> dispatch__cut_throughput: f32;

var<private> dispatch__clamped_light: f32;

var<private> dispatch__kept_light: f32;

struct dispatch__Batch {
	camera: types__PackedCamera,
	clip: vec2f,
	background: vec3f,
	background_top: vec3f,
	background_rotation: f32,
	background_picture: u32,
	background_size: vec2u,
	ambient: vec3f,
	light_count: u32,
	picture_size: vec2f,
	seed: u32,
	first_sample: u32,
	end_sample: u32,
	max_depth: u32,
	backdrop: vec3f,
	min_throughput: f32,
	light_samples: f32,
	footprint: f32,
	shared_samples: u32,
	camera_media: vec4u,
	emitter_count: u32,
	emitter_power: f32,
	environment_first: u32,
	environment_width: u32,
	environment_share: f32,
	light_root: u32,
	lights_share: f32,
	emitter_group: u32,
	sun: vec3f,
	sun_chance: f32
}

fn dispatch__load_batch() -> dispatch__Batch {
	fetch__load_starts();
	if (bindings__HAS_LAYERS) {
		albedo__albedo_first = bindings__frame.albedo_first;
	}
	let picture_size = vec2f(vec2u(bindings__dispatch.picture_width, bindings__dispatch.picture_height));
	return dispatch__Batch(bindings__frame.camera, bindings__frame.clip, bindings__frame.background, bindings__frame.background_top, bindings__frame.background_rotation, bindings__frame.background_picture, vec2u(bindings__frame.background_width, bindings__frame.background_height), bindings__frame.ambient, bindings__frame.light_count, picture_size, bindings__dispatch.seed, bindings__dispatch.first_sample, bindings__dispatch.end_sample, bindings__dispatch.max_depth, bindings__dispatch.backdrop, bindings__dispatch.min_throughput, bindings__dispatch.light_samples, bindings__dispatch.footprint, bindings__dispatch.shared_samples, bindings__frame.camera_media, bindings__frame.emitter_count, bindings__frame.emitter_power, bindings__frame.environment_first, bindings__frame.environment_width, bindings__frame.environment_share, bindings__frame.light_root, bindings__frame.lights_share, bindings__frame.emitter_group, bindings__frame.sun, bindings__frame.sun_chance);
}

fn dispatch__sample_ray(batch: dispatch__Batch, pixel: vec2u, key: u32, sample: u32) -> tracing__Ray {
	var within = vec2f(0.5);
	if (bindings__STRATIFIED) {
		within += filter__filter_offset(bindings__FILTER, bindings__FILTER_RADIUS, sampling__stratified_2d(sample, key));
	}
	if (bindings__HAS_FEATURES) {
		features__off_centre = dot(within - 0.5, within - 0.5);
	}
	let position = vec2f(pixel) + within;
	if (bindings__HAS_MOTION || bindings__HAS_DEFORMATION || bindings__CAMERA_MOTION || bindings__LIGHT_MOTION) {
		shutter__shutter_time = dispatch__sample_time(sample, key);
	}
	let camera = shutter__shutter_camera(batch.camera);
	let ray = dispatch__ray_through(camera, position, batch.picture_size, sample, key);
	if (bindings__HAS_CLIP) {
		return camera__clipped_ray(camera, batch.clip, ray);
	}
	return ray;
}

fn dispatch__ray_through(camera: types__PackedCamera, position: vec2f, size: vec2f, sample: u32, key: u32) -> tracing__Ray {
	if (bindings__HAS_LENS && bindings__ORTHOGRAPHIC) {
		return camera__parallel_lens_ray(camera, position, size, sampling__stratified_34(sample, key));
	}
	if (bindings__HAS_LENS) {
		return camera__lens_ray(camera, position, size, sampling__stratified_34(sample, key));
	}
	if (bindings__ORTHOGRAPHIC) {
		return camera__parallel_ray(camera, position, size);
	}
	return camera__camera_ray(camera, position, size);
}

fn dispatch__way_to_near(batch: dispatch__Batch, direction: vec3f) -> f32 {
	if (bindings__HAS_CLIP) {
		return camera__along_ray(shutter__shutter_camera(batch.camera), batch.clip.x, direction);
	}
	return 0.0;
}

fn dispatch__sample_time(sample: u32, key: u32) -> f32 {
	if (bindings__HAS_LENS) {
		return sampling__stratified_1d(sample, key);
	}
	return sampling__stratified_34(sample, key).x;
}

fn dispatch__sample_weight(key: u32, sample: u32) -> f32 {
	if (!bindings__STRATIFIED) {
		return 1.0;
	}
	return filter__filter_sign(bindings__FILTER, sampling__stratified_2d(sample, key));
}

fn dispatch__add_counts(group: vec3u, lane: u32) {
	if (bindings__COUNT_RAYS) {
		atomicAdd(&bindings__dispatch.counters.primary, dispatch__counts.primary);
		atomicAdd(&bindings__dispatch.counters.primary_hits, dispatch__counts.primary_hits);
		atomicAdd(&bindings__dispatch.counters.shadow, dispatch__counts.shadow);
		atomicAdd(&bindings__dispatch.counters.shadow_blocked, dispatch__counts.shadow_blocked);
		if (bindings__HAS_TREES) {
			atomicAdd(&bindings__dispatch.counters.reflection, dispatch__counts.reflection);
			atomicAdd(&bindings__dispatch.counters.reflection_hits, dispatch__counts.reflection_hits);
			atomicAdd(&bindings__dispatch.counters.refraction, dispatch__counts.refraction);
			atomicAdd(&bindings__dispatch.counters.refraction_hits, dispatch__counts.refraction_hits);
		}
	}
	if (bindings__HAS_TREES && ray_stack__cut_off_trees > 0u) {
		atomicAdd(&bindings__dispatch.counters.cut_off_trees, ray_stack__cut_off_trees);
	}
	if (bindings__HAS_LAYERS && dispatch__cut_throughput > 0.0) {
		atomicAdd(&bindings__dispatch.counters.cut_throughput, dispatch__steps_of(256.0 * dispatch__cut_throughput));
	}
	if (bindings__CLAMP_INDIRECT > 0.0) {
		let steps = 16.0 / max_f32(bindings__CLAMP_INDIRECT, 1e-6);
		let clamped = dispatch__steps_of(steps * dispatch__clamped_light);
		let kept = dispatch__steps_of(steps * dispatch__kept_light);
		if (atomicAdd(&bindings__dispatch.counters.clamped_light, clamped) > 4294967295u - clamped) {
			atomicAdd(&bindings__dispatch.counters.clamped_light_high, 1u);
		}
		if (atomicAdd(&bindings__dispatch.counters.kept_light, kept) > 4294967295u - kept) {
			atomicAdd(&bindings__dispatch.counters.kept_light_high, 1u);
		}
	}
	if (loops__nonfinite_samples > 0u) {
		atomicAdd(&bindings__dispatch.counters.nonfinite_samples, loops__nonfinite_samples);
	}
	dispatch__report_cut_off();
	groups__count_group(group, lane);
}

fn dispatch__report_cut_off() {
	let reasons = select(0u, types__CUT_OFF_LOOP, loops__cut_off) | select(0u, types__CUT_OFF_STACK, loops__is_stack_full);
	if (reasons != 0u) {
		atomicOr(&bindings__dispatch.counters.cut_off, reasons);
	}
}

fn dispatch__steps_of(number: f32) -> u32 {
	return u32(min_f32(number, 4000000000.0) + rng__unit_float(rng__hash(bitcast<u32>(number))));
}

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

const types__LIGHT_ROWS: u32 = 6u;

const types__CAMERA_ROWS: u32 = 4u;

const types__SHAPE_ROWS: u32 = 5u;

const types__IMAGE_WIDTH_LOG2: u32 = 12u;

const types__LAYER_ROWS_LOG2: u32 = 10u;

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

const types__LARGEST_RADIANCE_BITS: u32 = 1400897536u;

const types__MATERIAL_TWO_SIDED: u32 = 1u;

const types__MATERIAL_COLORED_MIRROR: u32 = 2048u;

const types__MATERIAL_ROWS: u32 = 20u;

const types__LAYERS_ROW: u32 = 9u;

const types__SLOT_COAT_NORMAL: u32 = 18u;

const types__TEXTURE_ROWS: u32 = 6u;

const types__NO_TEXTURE: u32 = 65535u;

const types__TEXTURE_UV: u32 = 1u;

const types__TEXTURE_NEAREST: u32 = 2u;

const types__TEXTURE_MINIFY_NEAREST: u32 = 64u;

const types__TEXTURE_LEVELS: u32 = 128u;

const types__TEXTURE_BETWEEN_LEVELS: u32 = 256u;

const types__TEXTURE_SECOND_UV: u32 = 512u;

const types__TEXTURE_WRAP_U_SHIFT: u32 = 2u;

const types__TEXTURE_WRAP_V_SHIFT: u32 = 4u;

const types__WRAP_REPEAT: u32 = 0u;

const types__WRAP_MIRROR: u32 = 2u;

const types__PICTURE_HALF: u32 = 2147483648u;

const types__PICTURE_SRGB: u32 = 1073741824u;

const types__PICTURE_FIRST_MASK: u32 = 1073741823u;

const types__FILTER_BOX: u32 = 0u;

const types__FILTER_TENT: u32 = 1u;

const types__FILTER_GAUSSIAN: u32 = 2u;

const types__FILTER_BLACKMAN_HARRIS: u32 = 3u;

const types__FILTER_MITCHELL: u32 = 4u;

const types__TRIANGLE_TEST_PLANE: u32 = 0u;

const types__TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1u;

const types__VIEW_DEPTH: u32 = 1u;

const types__VIEW_IDS: u32 = 2u;

const types__VIEW_HEAT: u32 = 3u;

const types__VIEW_UV: u32 = 4u;

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

struct types__PackedTangent {
	direction: vec3f,
	handedness: f32
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

struct types__PackedLayers {
	base: vec3f,
	metallic: f32,
	f0: vec3f,
	f90: f32,
	roughness: f32,
	transmission: f32,
	coat: f32,
	coat_roughness: f32,
	sheen: vec3f,
	sheen_roughness: f32,
	anisotropy: f32,
	anisotropy_rotation: f32,
	iridescence: f32,
	iridescence_ior: f32,
	film_thinnest: f32,
	film_thickest: f32,
	dispersion: f32,
	diffuse_transmission: f32,
	diffuse_transmission_color: vec3f,
	ior: f32,
	light: u32,
	glow: f32,
	slots: u32,
	coat_normal_scale: f32,
	textures: vec4u,
	more_textures: vec4u,
	last_textures: vec4u
}

struct types__PackedTexture {
	color_a: vec3f,
	kind: u32,
	color_b: vec3f,
	flags: u32,
	row_x: vec4f,
	row_y: vec4f,
	row_z: vec4f,
	picture: u32,
	width: u32,
	height: u32,
	octaves: u32
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

fn fetch__load_camera(key: u32) -> types__PackedCamera {
	let row = fetch__light_row + types__LIGHT_ROWS * bindings__frame.light_count * bindings__frame.light_key_count + types__CAMERA_ROWS * key;
	let r0 = rows__node_row(row);
	let r1 = rows__node_row(row + 1u);
	let r2 = rows__node_row(row + 2u);
	let r3 = rows__node_row(row + 3u);
	return types__PackedCamera(bitcast<vec3f>(r0.xyz), bitcast<f32>(r0.w), bitcast<vec3f>(r1.xyz), bitcast<f32>(r1.w), bitcast<vec3f>(r2.xyz), bitcast<f32>(r2.w), bitcast<vec3f>(r3.xyz), r3.w);
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

fn fetch__load_uvs(index: u32) -> vec4f {
	return bitcast<vec4f>(rows__vertex_row(fetch__uv_row + index));
}

fn fetch__load_tangent(index: u32) -> types__PackedTangent {
	return fetch__tangent_of(rows__vertex_row(2u * fetch__uv_row + index));
}

fn fetch__load_key_tangent(index: u32) -> types__PackedTangent {
	return fetch__tangent_of(rows__vertex_row(index + 1u));
}

fn fetch__load_color(index: u32) -> vec4f {
	let parts = 1u + select(0u, 1u, bindings__HAS_UVS) + select(0u, 1u, bindings__HAS_TANGENTS);
	return bitcast<vec4f>(rows__vertex_row(parts * fetch__uv_row + index));
}

fn fetch__tangent_of(r0: vec4u) -> types__PackedTangent {
	return types__PackedTangent(bitcast<vec3f>(r0.xyz), bitcast<f32>(r0.w));
}

@group(1) @binding(0)
var<storage, read> bindings__frame: types__PackedFrame;

@group(1) @binding(1)
var<storage, read_write> bindings__dispatch: types__PackedDispatch;

@group(2) @binding(0)
var<storage, read_write> bindings__film: array<vec4f>;

override bindings__MIXED_MATERIALS: bool = false;

override bindings__BRUTE_FORCE: bool = false;

override bindings__STRATIFIED: bool = false;

override bindings__COUNT_RAYS: bool = false;

override bindings__HAS_REFLECTION: bool = false;

override bindings__HAS_REFRACTION: bool = false;

override bindings__HAS_LENS: bool = false;

override bindings__HAS_CLIP: bool = false;

override bindings__FILTER: u32 = 0u;

override bindings__FILTER_RADIUS: f32 = 0.0;

override bindings__HAS_TEXTURES: bool = false;

override bindings__HAS_FOOTPRINTS: bool = false;

override bindings__HAS_TREES: bool = false;

override bindings__HAS_NORMAL_MAPS: bool = false;

override bindings__HAS_COAT_NORMALS: bool = false;

override bindings__HAS_BYTE_TEXELS: bool = false;

override bindings__HAS_HALF_TEXELS: bool = false;

override bindings__HAS_LAYERS: bool = false;

override bindings__CLAMP_INDIRECT: f32 = 0.0;

override bindings__ADAPTIVE: bool = false;

override bindings__CAMERA_MOTION: bool = false;

override bindings__LIGHT_MOTION: bool = false;

override bindings__ORTHOGRAPHIC: bool = false;

override bindings__HAS_UVS: bool = false;

override bindings__HAS_SECOND_UVS: bool = false;

override bindings__HAS_COLORS: bool = false;

override bindings__HAS_TANGENTS: bool = false;

override bindings__HAS_ANISOTROPY: bool = false;

override bindings__HAS_FEATURES: bool = false;

override bindings__FILM_ROWS: u32 = 0u;

override bindings__SQUARES_ROW: u32 = 0u;

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

override bindings__VIEW: u32 = 0u;

var<private> albedo__albedo_first: u32;

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

struct block__Work {
	inside: bool,
	film_index: u32,
	pixel: vec2u
}

struct block__Block {
	index: u32,
	end_index: u32,
	corner: vec2u,
	end: vec2u,
	is_inside: bool,
	tile: vec2u,
	size: vec2u,
	step: vec2u
}

fn block__load_block(group: vec3u) -> block__Block {
	let workgroup = group.y * bindings__dispatch.grid_width + group.x;
	let index = bindings__dispatch.first_group + bindings__dispatch.blocks * workgroup;
	let visited = tile__permuted_group(min(index, bindings__dispatch.group_count - 1u), bindings__dispatch.group_count, bindings__dispatch.group_stride);
	let tile = vec2u(bindings__dispatch.tile_x, bindings__dispatch.tile_y);
	let columns = (bindings__dispatch.tile_width + tile__GROUP_SIDE - 1u) / tile__GROUP_SIDE;
	return block__Block(index, min(index + bindings__dispatch.blocks, bindings__dispatch.end_group), tile + tile__group_corner(visited, columns), tile + vec2u(bindings__dispatch.tile_width, bindings__dispatch.tile_height), index < bindings__dispatch.end_group, tile, vec2u(columns, tile__divided(bindings__dispatch.group_count, columns).x), tile__divided(bindings__dispatch.group_stride, columns).yx);
}

fn block__work_of(block: block__Block, place: u32) -> block__Work {
	let film_index = 64u * block.index + place;
	if (bindings__ADAPTIVE) {
		let entry = bindings__film[bindings__FILM_ROWS * film_index + bindings__SQUARES_ROW];
		return block__Work(block.is_inside & (entry.w > 0.0), film_index, vec2u(entry.yz));
	}
	let pixel = block.corner + tile__morton_8x8(place);
	return block__Work(block.is_inside & all(pixel < block.end), film_index, pixel);
}

const tile__GROUP_SIDE: u32 = 8u;

fn tile__divided(dividend: u32, divisor: u32) -> vec2u {
	let quotient = u32(f32(dividend) / f32(divisor));
	let rest = bitcast<i32>(dividend - quotient * divisor);
	let correction = select(0, 1, rest >= i32(divisor)) - select(0, 1, rest < 0);
	return vec2u(quotient + bitcast<u32>(correction), bitcast<u32>(rest - correction * i32(divisor)));
}

fn tile__permuted_group(index: u32, group_count: u32, stride: u32) -> u32 {
	return tile__divided(index * stride, group_count).y;
}

fn tile__morton_8x8(lane: u32) -> vec2u {
	let x = (lane & 1u) | ((lane >> 1u) & 2u) | ((lane >> 2u) & 4u);
	let y = ((lane >> 1u) & 1u) | ((lane >> 2u) & 2u) | ((lane >> 3u) & 4u);
	return vec2u(x, y);
}

fn tile__group_corner(group: u32, group_columns: u32) -> vec2u {
	return tile__GROUP_SIDE * tile__divided(group, group_columns).yx;
}

fn rng__hash(x: u32) -> u32 {
	let a = (x ^ (x >> 16u)) * 2146121005u;
	let b = (a ^ (a >> 15u)) * 2221713035u;
	return b ^ (b >> 16u);
}

fn rng__hash_combine(a: u32, b: u32) -> u32 {
	return rng__hash(a ^ (rng__hash(b) + 2654435769u + (a << 6u) + (a >> 2u)));
}

fn rng__pixel_key(seed: u32, pixel: vec2u) -> u32 {
	return rng__hash_combine(rng__hash_combine(rng__hash(seed), pixel.x), pixel.y);
}

fn rng__unit_float(x: u32) -> f32 {
	return f32(x >> 8u) * 5.9604645e-8;
}

struct film__Sample {
	radiance: vec3f
}

struct film__Sum {
	radiance: vec4f,
	squares: f32
}

fn film__load_sum(film_index: u32, sample: u32) -> film__Sum {
	let row = bindings__FILM_ROWS * film_index;
	var sum: film__Sum;
	if (sample > 0u) {
		sum.radiance = bindings__film[row];
		if (bindings__ADAPTIVE || bindings__HAS_FEATURES) {
			sum.squares = bindings__film[row + bindings__SQUARES_ROW].x;
		}
	}
	return sum;
}

fn film__store_sum(film_index: u32, sum: film__Sum) {
	let row = bindings__FILM_ROWS * film_index;
	bindings__film[row] = sum.radiance;
	if (bindings__ADAPTIVE || bindings__HAS_FEATURES) {
		bindings__film[row + bindings__SQUARES_ROW].x = sum.squares;
	}
}

fn film__add_sample(sum: film__Sum, sample: film__Sample, weight: f32) -> film__Sum {
	if (!numeric__is_within(sample.radiance, types__LARGEST_RADIANCE_BITS)) {
		loops__nonfinite_samples += 1u;
		return sum;
	}
	let luminance = dot(sample.radiance, tone__LUMINANCE_REC709);
	var next = sum;
	next.radiance += weight * vec4f(sample.radiance, 1.0);
	next.squares += luminance * luminance;
	return next;
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

struct tracing__Cone {
	width: f32,
	spread: f32
}

var<private> loops__nodes_visited: u32;

var<private> loops__primitives_tested: u32;

var<private> loops__cut_off: bool;

var<private> loops__is_stack_full: bool;

var<private> loops__nonfinite_samples: u32;

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

fn section_walk__closest_hit(ray: tracing__Ray, media: vec4u) -> tracing__Hit {
	return section_walk__followed(section_walk__walk_from(ray, false, media), traverse__NO_LIMIT).hit;
}

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

fn deforming__tangents_now(primitive: u32, keys: deforming__Keys) -> mat3x4f {
	if (bindings__HAS_DEFORMATION) {
		if (keys.next != 0u) {
			let moment = motion__moment_of(shutter__shutter_time, bindings__frame.deformation_key_count);
			let a = deforming__tangents_at(deforming__index_at(primitive, keys, moment.key), moment.key > 0u);
			let b = deforming__tangents_at(deforming__index_at(primitive, keys, moment.key + 1u), true);
			return a * (1.0 - moment.fraction) + b * moment.fraction;
		}
	}
	return deforming__tangents_at(primitive, false);
}

fn deforming__tangents_at(triangle: u32, is_later: bool) -> mat3x4f {
	let own = fetch__load_triangle(triangle);
	return mat3x4f(deforming__tangent_at(own.i0, is_later), deforming__tangent_at(own.i1, is_later), deforming__tangent_at(own.i2, is_later));
}

fn deforming__tangent_at(vertex: u32, is_later: bool) -> vec4f {
	var tangent = fetch__load_tangent(vertex);
	if (bindings__HAS_DEFORMATION) {
		if (is_later) {
			tangent = fetch__load_key_tangent(vertex);
		}
	}
	return vec4f(tangent.direction, tangent.handedness);
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

fn numeric__is_within(v: vec3f, limit: u32) -> bool {
	return all((bitcast<vec3u>(v) & vec3u(2147483647u)) <= vec3u(limit));
}

fn numeric__max_component(v: vec3f) -> f32 {
	return max_f32(v.x, max_f32(v.y, v.z));
}

@group(0) @binding(0)
var rows__nodes: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(1)
var rows__triangles: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(2)
var rows__vertices: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(3)
var rows__materials: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(4)
var rows__texels: texture_storage_2d_array<r32uint, read>;

fn rows__node_row(row: u32) -> vec4u {
	return textureLoad(rows__nodes, rows__texel(row));
}

fn rows__triangle_row(row: u32) -> vec4u {
	return textureLoad(rows__triangles, rows__texel(row));
}

fn rows__vertex_row(row: u32) -> vec4u {
	return textureLoad(rows__vertices, rows__texel(row));
}

fn rows__material_row(row: u32) -> vec4u {
	return textureLoad(rows__materials, rows__texel(row));
}

fn rows__texel_word(place: vec2u, layer: u32) -> u32 {
	return textureLoad(rows__texels, place, layer).x;
}

fn rows__texel(row: u32) -> vec2u {
	return vec2u(row & ((1u << types__IMAGE_WIDTH_LOG2) - 1u), row >> types__IMAGE_WIDTH_LOG2);
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

fn instance__placed_normal(space: motion__Space, n: vec3f) -> vec3f {
	return n * space.inverse;
}

fn instance__placement_error(space: motion__Space, p: vec3f, q: vec3f) -> vec3f {
	let from_p = instance__abs_times(space.inverse, abs(p) + abs(space.translation));
	return 16.0 * numeric__ROUNDING * (abs(p) + abs(space.translation) + instance__abs_times(space.linear, abs(q) + from_p));
}

fn instance__abs_times(m: mat3x3f, v: vec3f) -> vec3f {
	return abs(m[0]) * v.x + abs(m[1]) * v.y + abs(m[2]) * v.z;
}

fn instance__pattern_place(instance: types__PackedInstance, q: vec3f) -> vec3f {
	let at = vec4f(q, 1.0);
	return vec3f(dot(instance.pattern_x, at), dot(instance.pattern_y, at), dot(instance.pattern_z, at));
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

fn motion__camera_between(a: types__PackedCamera, b: types__PackedCamera, fraction: f32) -> types__PackedCamera {
	return types__PackedCamera(mix(a.origin, b.origin, vec3f(fraction)), mix(a.lens_radius, b.lens_radius, fraction), mix(a.forward, b.forward, vec3f(fraction)), mix(a.focus_distance, b.focus_distance, fraction), mix(a.right, b.right, vec3f(fraction)), mix(a.blade_rotation, b.blade_rotation, fraction), mix(a.up, b.up, vec3f(fraction)), a.blade_count);
}

var<private> shutter__shutter_time: f32;

fn shutter__shutter_camera(still: types__PackedCamera) -> types__PackedCamera {
	if (bindings__CAMERA_MOTION) {
		let moment = motion__moment_of(shutter__shutter_time, bindings__frame.camera_key_count);
		return motion__camera_between(fetch__load_camera(moment.key), fetch__load_camera(moment.key + 1u), moment.fraction);
	}
	return still;
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

fn shape__is_flat(kind: u32) -> bool {
	return (bindings__SHAPE_KINDS & (shape__DISCS | shape__RECTANGLES)) != 0u && (kind == types__SHAPE_DISC || kind == types__SHAPE_RECTANGLE);
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

fn camera__camera_ray(camera: types__PackedCamera, position: vec2f, size: vec2f) -> tracing__Ray {
	return tracing__Ray(camera.origin, camera__T_FAR, normalize(camera__through(camera, position, size)), types__NONE, types__NO_INSTANCE);
}

fn camera__through(camera: types__PackedCamera, position: vec2f, size: vec2f) -> vec3f {
	let x = 2.0 * position.x / size.x - 1.0;
	let y = 1.0 - 2.0 * position.y / size.y;
	return camera.forward + x * camera.right + y * camera.up;
}

fn camera__parallel_ray(camera: types__PackedCamera, position: vec2f, size: vec2f) -> tracing__Ray {
	let origin = camera.origin + camera__across(camera, position, size);
	return tracing__Ray(origin, camera__T_FAR, normalize(camera.forward), types__NONE, types__NO_INSTANCE);
}

fn camera__across(camera: types__PackedCamera, position: vec2f, size: vec2f) -> vec3f {
	let x = 2.0 * position.x / size.x - 1.0;
	let y = 1.0 - 2.0 * position.y / size.y;
	return x * camera.right + y * camera.up;
}

fn camera__lens_ray(camera: types__PackedCamera, position: vec2f, size: vec2f, u: vec2f) -> tracing__Ray {
	let off_axis = camera__aperture_point(camera, u);
	let direction = camera__through(camera, position, size) - off_axis / camera.focus_distance;
	return tracing__Ray(camera.origin + off_axis, camera__T_FAR, normalize(direction), types__NONE, types__NO_INSTANCE);
}

fn camera__parallel_lens_ray(camera: types__PackedCamera, position: vec2f, size: vec2f, u: vec2f) -> tracing__Ray {
	let off_axis = camera__aperture_point(camera, u);
	let origin = camera.origin + camera__across(camera, position, size) + off_axis;
	let direction = normalize(camera.forward) - off_axis / camera.focus_distance;
	return tracing__Ray(origin, camera__T_FAR, normalize(direction), types__NONE, types__NO_INSTANCE);
}

fn camera__clipped_ray(camera: types__PackedCamera, clip: vec2f, ray: tracing__Ray) -> tracing__Ray {
	let start = ray.origin + camera__along_ray(camera, clip.x, ray.direction) * ray.direction;
	let length = camera__along_ray(camera, clip.y - clip.x, ray.direction);
	return tracing__Ray(start, select(length, camera__T_FAR, clip.y == 0.0), ray.direction, ray.leaving, ray.leaving_instance);
}

fn camera__along_ray(camera: types__PackedCamera, distance: f32, direction: vec3f) -> f32 {
	return distance / dot(normalize(camera.forward), direction);
}

fn camera__aperture_point(camera: types__PackedCamera, u: vec2f) -> vec3f {
	var aperture = warp__disc_from_square(u);
	if (camera.blade_count >= 3u) {
		aperture = warp__polygon_from_square(u, camera.blade_count, camera.blade_rotation);
	}
	let p = camera.lens_radius * aperture;
	return p.x * normalize(camera.right) + p.y * normalize(camera.up);
}

fn shape_surface__shape_surface(ray: tracing__Ray, hit: tracing__Hit) -> shading__Surface {
	let shape = fetch__load_shape(hit.primitive & ~types__SHAPE);
	let reached = ray.origin + hit.t * ray.direction;
	let material = material__load_material(shape.material);
	if (bindings__HAS_PLANES && (!bindings__HAS_SHAPES || shape.kind == types__SHAPE_PLANE)) {
		let ng = shape.row_y;
		let p = reached - dot(reached - shape.position, ng) * ng;
		let outside = dot(ng, ray.direction) <= 0.0;
		var plane_uv = vec2f(0.0);
		if (bindings__HAS_TEXTURES) {
			plane_uv = vec2f(dot(shape.row_x, p) + shape.size0, dot(shape.row_z, p) + shape.size1);
		}
		return shading__Surface(p, select(ng, -ng, material__must_flip(material.flags, 1.0, dot(ng, ray.direction))), ng, offset__plane_error(p, shape.position), hit.primitive, outside, plane_uv, plane_uv, shape.material, material.phong, shape.id, p, types__NO_INSTANCE, footprint__NO_FOOTPRINT, 0.0, vec4f(), vec3f(), vec4f(1.0), false);
	}
	if (!shape__is_round(shape.kind)) {
		let point = shape__canonical_point(shape, reached, hit.b1);
		let placed = canonical__placed_point(shape, reached, point);
		let ng = placed.ng;
		return shading__Surface(placed.p, select(ng, -ng, material__must_flip(material.flags, 1.0, dot(ng, ray.direction))), ng, placed.error, select(types__NONE, hit.primitive, shape__is_flat(shape.kind)), dot(ng, ray.direction) <= 0.0, point.uv, point.uv, shape.material, material.phong, shape.id, placed.p, types__NO_INSTANCE, footprint__NO_FOOTPRINT, 0.0, vec4f(), vec3f(), vec4f(1.0), false);
	}
	let placed = shape_surface__sphere_point(shape, reached, ray.direction);
	let ng = placed.ng;
	let outside = dot(ng, ray.direction) <= 0.0;
	var uv = vec2f(0.0);
	if (bindings__HAS_TEXTURES) {
		uv = canonical__sphere_uv(ng);
	}
	return shading__Surface(placed.p, select(ng, -ng, material__must_flip(material.flags, 1.0, dot(ng, ray.direction))), ng, placed.error, types__NONE, outside, uv, uv, shape.material, material.phong, shape.id, placed.p, types__NO_INSTANCE, footprint__NO_FOOTPRINT, 0.0, vec4f(), vec3f(), vec4f(1.0), false);
}

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

fn offset__triangle_error(v0: vec3f, v1: vec3f, v2: vec3f, b1: f32, b2: f32) -> vec3f {
	let b0 = abs(1.0 - b1 - b2);
	return 16.0 * numeric__ROUNDING * (b0 * abs(v0) + abs(b1 * v1) + abs(b2 * v2));
}

fn offset__sphere_error(center: vec3f, radius: f32) -> vec3f {
	return 16.0 * numeric__ROUNDING * (abs(center) + vec3f(radius));
}

fn offset__plane_error(p: vec3f, point: vec3f) -> vec3f {
	return 16.0 * numeric__ROUNDING * (abs(p) + abs(point));
}

fn offset__placed_error(p: vec3f, position: vec3f, reach: vec3f) -> vec3f {
	return 16.0 * numeric__ROUNDING * (abs(p) + abs(position) + reach);
}

const section__CAP: f32 = -1.0;

fn section__is_cap(hit: tracing__Hit) -> bool {
	return bindings__HAS_SECTION && hit.b2 == section__CAP;
}

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

fn section__cap_surface(ray: tracing__Ray, local: tracing__Ray, hit: tracing__Hit) -> shading__Surface {
	var index = 0u;
	if (bindings__HAS_SHAPES && (!bindings__HAS_TRIANGLES || (hit.primitive & types__SHAPE) != 0u)) {
		index = fetch__load_shape(hit.primitive & ~types__SHAPE).material;
	}
	else {
		index = fetch__load_vertex(fetch__load_triangle(hit.primitive).i0).material;
	}
	let material = material__load_material(index);
	let ng = bindings__frame.section;
	let reached = ray.origin + hit.t * ray.direction;
	let p = reached - (dot(ng, reached) - bindings__frame.section_offset) * ng;
	let side = dot(ng, ray.direction);
	return shading__Surface(p, select(ng, -ng, material__must_flip(material.flags, 1.0, side)), ng, offset__plane_error(p, bindings__frame.section_offset * ng), types__NONE, side <= 0.0, vec2f(0.0), vec2f(0.0), index, material.phong, 2246822507u * (index + 1u), local.origin + hit.t * local.direction, types__NO_INSTANCE, footprint__NO_FOOTPRINT, 0.0, vec4f(), vec3f(), vec4f(1.0), true);
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

fn surface__surface_at(ray: tracing__Ray, hit: tracing__Hit, cone: tracing__Cone) -> shading__Surface {
	var instance: types__PackedInstance;
	var space: motion__Space;
	var local = ray;
	let is_placed = bindings__HAS_INSTANCES && hit.instance != types__NO_INSTANCE;
	if (is_placed) {
		instance = fetch__load_instance(hit.instance);
		space = instance__space_of(instance);
		local = instance__object_ray(ray, space);
	}
	var surface: shading__Surface;
	if (section__is_cap(hit)) {
		surface = section__cap_surface(ray, local, hit);
	}
	else if (bindings__HAS_TRIANGLES && (!(bindings__HAS_SHAPES || bindings__HAS_PLANES) || (hit.primitive & types__SHAPE) == 0u)) {
		surface = triangle_surface__triangle_surface(ray, hit, triangle_surface__Placing(space, is_placed, deforming__keys_of(instance)), cone);
	}
	else if ((bindings__HAS_SHAPES || bindings__HAS_PLANES) && (!bindings__HAS_TRIANGLES || (hit.primitive & types__SHAPE) != 0u)) {
		surface = shape_surface__shape_surface(local, hit);
		let p = surface.p;
		if (is_placed) {
			surface = surface__placed_surface(ray, surface, space);
		}
		if (bindings__HAS_FOOTPRINTS) {
			surface = footprint__with_shape_footprint(surface, ray, hit, p, space, is_placed, cone);
		}
	}
	if (is_placed) {
		let q = surface.place;
		surface.error += instance__placement_error(space, surface.p, q);
		surface.id += 2654435761u * instance.id;
		surface.place = instance__pattern_place(instance, q);
		surface.instance = hit.instance;
		if (bindings__HAS_FOOTPRINTS) {
			let own = mat2x3f(space.inverse * surface.footprint.place[0], space.inverse * surface.footprint.place[1]);
			surface.footprint.place = footprint__instance_footprint(instance, own);
		}
	}
	return surface;
}

fn surface__placed_surface(ray: tracing__Ray, own: shading__Surface, space: motion__Space) -> shading__Surface {
	var surface = own;
	surface.p = space.linear * own.p + space.translation;
	surface.ng = numeric__normalize_or(instance__placed_normal(space, own.ng), -ray.direction);
	surface.n = numeric__normalize_or(instance__placed_normal(space, own.n), surface.ng);
	surface.error = instance__abs_times(space.linear, own.error);
	return surface;
}

struct shading__Phong {
	diffuse: vec3f,
	specular: vec3f,
	shininess: f32,
	ambient: vec3f,
	reflect: vec3f
}

struct shading__Surface {
	p: vec3f,
	n: vec3f,
	ng: vec3f,
	error: vec3f,
	leaving: u32,
	outside: bool,
	uv: vec2f,
	second_uv: vec2f,
	material: u32,
	phong: shading__Phong,
	id: u32,
	place: vec3f,
	instance: u32,
	footprint: shading__Footprint,
	curvature: f32,
	tangent: vec4f,
	coat_n: vec3f,
	color: vec4f,
	is_cap: bool
}

struct shading__Footprint {
	uv: mat2x2f,
	second_uv: mat2x2f,
	place: mat2x3f
}

struct material__PhongMaterial {
	phong: shading__Phong,
	flags: u32
}

fn material__load_material(index: u32) -> material__PhongMaterial {
	let row = types__MATERIAL_ROWS * index;
	let r0 = rows__material_row(row + select(0u, types__LAYERS_ROW, bindings__HAS_LAYERS));
	let r1 = rows__material_row(row + 1u);
	let r2 = rows__material_row(row + 2u);
	var reflect = vec3f(0.0);
	if (bindings__HAS_REFLECTION) {
		reflect = bitcast<vec3f>(rows__material_row(row + 3u).xyz);
	}
	let phong = shading__Phong(bitcast<vec3f>(r0.xyz), bitcast<vec3f>(r1.xyz), bitcast<f32>(r0.w), bitcast<vec3f>(r2.xyz), reflect);
	return material__PhongMaterial(phong, r1.w);
}

fn material__load_texture_indices(index: u32) -> vec4u {
	return rows__material_row(types__MATERIAL_ROWS * index + 7u);
}

fn material__load_normal_scale(index: u32) -> f32 {
	return bitcast<f32>(rows__material_row(types__MATERIAL_ROWS * index + 6u).w);
}

fn material__load_texture(index: u32) -> types__PackedTexture {
	let row = fetch__texture_row + types__TEXTURE_ROWS * index;
	let r0 = rows__material_row(row);
	let r1 = rows__material_row(row + 1u);
	let r5 = rows__material_row(row + 5u);
	return types__PackedTexture(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec4f>(rows__material_row(row + 2u)), bitcast<vec4f>(rows__material_row(row + 3u)), bitcast<vec4f>(rows__material_row(row + 4u)), r5.x, r5.y, r5.z, r5.w);
}

fn material__load_layers(index: u32) -> types__PackedLayers {
	let row = types__MATERIAL_ROWS * index + types__LAYERS_ROW;
	let r0 = rows__material_row(row);
	let r1 = rows__material_row(row + 1u);
	let r2 = bitcast<vec4f>(rows__material_row(row + 2u));
	let r3 = rows__material_row(row + 3u);
	let r4 = bitcast<vec4f>(rows__material_row(row + 4u));
	let r5 = bitcast<vec4f>(rows__material_row(row + 5u));
	let r6 = rows__material_row(row + 6u);
	let r7 = rows__material_row(row + 7u);
	return types__PackedLayers(bitcast<vec3f>(r0.xyz), bitcast<f32>(r0.w), bitcast<vec3f>(r1.xyz), bitcast<f32>(r1.w), r2.x, r2.y, r2.z, r2.w, bitcast<vec3f>(r3.xyz), bitcast<f32>(r3.w), r4.x, r4.y, r4.z, r4.w, r5.x, r5.y, r5.z, r5.w, bitcast<vec3f>(r6.xyz), bitcast<f32>(r6.w), r7.x, bitcast<f32>(r7.y), r7.z, bitcast<f32>(r7.w), rows__material_row(row + 8u), rows__material_row(row + 9u), rows__material_row(row + 10u));
}

fn material__must_flip(flags: u32, n_dot_ng: f32, ng_dot_direction: f32) -> bool {
	let faces_away = (n_dot_ng > 0.0) == (ng_dot_direction > 0.0);
	return (flags & types__MATERIAL_TWO_SIDED) != 0u && faces_away;
}

const footprint__NO_FOOTPRINT: shading__Footprint = shading__Footprint(mat2x2f(), mat2x2f(), mat2x3f());

fn footprint__camera_cone(batch: dispatch__Batch, direction: vec3f) -> tracing__Cone {
	let camera = batch.camera;
	let sides = 2.0 * vec2f(length(camera.right), length(camera.up)) / batch.picture_size;
	let side = batch.footprint * max_f32(sides.x, sides.y);
	if (bindings__ORTHOGRAPHIC) {
		return tracing__Cone(side, 0.0);
	}
	let spread = side * max_f32(dot(direction, camera.forward), 0.0);
	return tracing__Cone(spread * dispatch__way_to_near(batch, direction), spread);
}

fn footprint__triangle_uv_footprint(axes: mat2x3f, corners: mat3x3f, uvs: mat3x2f) -> mat2x2f {
	let e1 = corners[1] - corners[0];
	let e2 = corners[2] - corners[0];
	let d1 = uvs[1] - uvs[0];
	let d2 = uvs[2] - uvs[0];
	return mat2x2f(ray_cone__uv_along(axes[0], e1, e2, d1, d2), ray_cone__uv_along(axes[1], e1, e2, d1, d2));
}

fn footprint__shape_uv_footprint(shape: types__PackedShape, p: vec3f, axes: mat2x3f, part: f32) -> mat2x2f {
	if (bindings__HAS_PLANES && (!bindings__HAS_SHAPES || shape.kind == types__SHAPE_PLANE)) {
		return mat2x2f(vec2f(dot(shape.row_x, axes[0]), dot(shape.row_z, axes[0])), vec2f(dot(shape.row_x, axes[1]), dot(shape.row_z, axes[1])));
	}
	var first = vec2f(0.0);
	var ends = mat2x2f(first, first);
	var k = 0u;
	loop {
		let at = select(select(p + axes[1], p + axes[0], k == 1u), p, k == 0u);
		let uv = footprint__shape_uv(shape, at, part);
		let way = uv - first - round(uv - first);
		first = select(first, uv, k == 0u);
		ends = mat2x2f(select(ends[0], way, k == 1u), select(ends[1], way, k == 2u));
		continuing {
			k += 1u;
			break if k > 2u;
		}
	}
	loops__cut_off |= k <= 2u;
	return ends;
}

fn footprint__shape_uv(shape: types__PackedShape, p: vec3f, part: f32) -> vec2f {
	if (!shape__is_round(shape.kind)) {
		return shape__canonical_point(shape, p, part).uv;
	}
	if (shape__is_globe(shape.kind)) {
		return canonical__sphere_uv(globe__globe_point(shape, p).ng);
	}
	return canonical__sphere_uv(numeric__normalize_or(p - shape.position, vec3f(0.0, 1.0, 0.0)));
}

fn footprint__instance_footprint(instance: types__PackedInstance, own: mat2x3f) -> mat2x3f {
	let rows = transpose(mat3x3f(instance.pattern_x.xyz, instance.pattern_y.xyz, instance.pattern_z.xyz));
	return mat2x3f(rows * own[0], rows * own[1]);
}

fn footprint__with_shape_footprint(own: shading__Surface, ray: tracing__Ray, hit: tracing__Hit, p: vec3f, space: motion__Space, is_placed: bool, cone: tracing__Cone) -> shading__Surface {
	var surface = own;
	let axes = ray_cone__footprint_axes(ray.direction, own.ng, ray_cone__cone_at(cone, hit.t).width);
	var local = axes;
	var scale = 1.0;
	if (bindings__HAS_INSTANCES && is_placed) {
		local = mat2x3f(space.inverse * axes[0], space.inverse * axes[1]);
		scale = length(instance__placed_normal(space, own.ng));
	}
	let shape = fetch__load_shape(hit.primitive & ~types__SHAPE);
	let in_uv = footprint__shape_uv_footprint(shape, p, local, hit.b1);
	surface.footprint = shading__Footprint(in_uv, in_uv, axes);
	if (shape__is_round(shape.kind)) {
		let curvature = scale * select(1.0 / shape.size0, shape.size0, shape__is_globe(shape.kind));
		surface.curvature = select(-curvature, curvature, own.outside);
	}
	return surface;
}

fn footprint__triangle_curvature(corners: mat3x3f, normals: mat3x3f, side: f32) -> f32 {
	if (!(bindings__HAS_FOOTPRINTS && (bindings__HAS_REFLECTION || bindings__HAS_REFRACTION))) {
		return 0.0;
	}
	let bend = ray_cone__curvature_along(corners[1] - corners[0], normals[1] - normals[0]) + ray_cone__curvature_along(corners[2] - corners[1], normals[2] - normals[1]) + ray_cone__curvature_along(corners[0] - corners[2], normals[0] - normals[2]);
	return select(-bend, bend, side < 0.0) / 3.0;
}

var<private> triangle_surface__met_vertices: vec3u;

struct triangle_surface__Placing {
	space: motion__Space,
	is_placed: bool,
	keys: deforming__Keys
}

fn triangle_surface__triangle_surface(ray: tracing__Ray, hit: tracing__Hit, placing: triangle_surface__Placing, cone: tracing__Cone) -> shading__Surface {
	let space = placing.space;
	let keys = placing.keys;
	let own = deforming__triangle_now(hit.primitive, keys);
	triangle_surface__met_vertices = vec3u(own.i0, own.i1, own.i2);
	let v0 = fetch__load_vertex(own.i0);
	let v1 = fetch__load_vertex(own.i1);
	let v2 = fetch__load_vertex(own.i2);
	let b1 = hit.b1;
	let b2 = hit.b2;
	let b0 = 1.0 - b1 - b2;
	var corners = mat3x3f(own.v0, own.v1, own.v2);
	var normals = mat3x3f(v0.normal, v1.normal, v2.normal);
	if (bindings__HAS_DEFORMATION) {
		if (keys.next != 0u) {
			normals = deforming__normals_now(hit.primitive, keys);
		}
	}
	let place = corners * vec3f(b0, b1, b2);
	if (bindings__HAS_INSTANCES && placing.is_placed) {
		corners = space.linear * corners + mat3x3f(space.translation, space.translation, space.translation);
		normals = mat3x3f(numeric__normalize_or(instance__placed_normal(space, normals[0]), -ray.direction), numeric__normalize_or(instance__placed_normal(space, normals[1]), -ray.direction), numeric__normalize_or(instance__placed_normal(space, normals[2]), -ray.direction));
	}
	let weights = vec3f(b0, b1, b2);
	var frame = mat3x3f();
	if (bindings__HAS_TANGENTS) {
		var tangents = deforming__tangents_now(hit.primitive, keys);
		if (bindings__HAS_INSTANCES && placing.is_placed) {
			tangents = tangent_space__placed_tangents(space, tangents);
		}
		frame = tangent_space__vertex_frame(tangents, normals, weights);
	}
	let material = material__load_material(v0.material);
	var phong = material.phong;
	if (bindings__MIXED_MATERIALS) {
		phong = triangle_surface__mix_phong(phong, material__load_material(v1.material).phong, material__load_material(v2.material).phong, b0, b1, b2);
	}
	var color = vec4f(1.0);
	if (bindings__HAS_COLORS) {
		color = vertex_color__interpolated_color(own, weights);
		phong = vertex_color__colored_phong(phong, color.xyz, material.flags);
	}
	let ng = numeric__normalize_or(cross(corners[1] - corners[0], corners[2] - corners[0]), -ray.direction);
	let n = numeric__normalize_or(normals * weights, ng);
	var shading_normal = n;
	var coat_normal = vec3f(0.0);
	if (bindings__HAS_COAT_NORMALS) {
		coat_normal = n;
	}
	var uv = vec2f(b1, b2);
	if (bindings__HAS_TEXTURES) {
		uv = vec2f(0.0);
	}
	var second_uv = uv;
	var footprint = footprint__NO_FOOTPRINT;
	if (bindings__HAS_FOOTPRINTS) {
		footprint.place = ray_cone__footprint_axes(ray.direction, ng, ray_cone__cone_at(cone, hit.t).width);
	}
	if (bindings__HAS_TEXTURES && bindings__HAS_UVS) {
		let rows = mat3x4f(fetch__load_uvs(own.i0), fetch__load_uvs(own.i1), fetch__load_uvs(own.i2));
		let uvs = mat3x2f(rows[0].xy, rows[1].xy, rows[2].xy);
		let second_uvs = mat3x2f(rows[0].zw, rows[1].zw, rows[2].zw);
		uv = uvs * weights;
		second_uv = select(uv, second_uvs * weights, bindings__HAS_SECOND_UVS);
		if (bindings__HAS_FOOTPRINTS) {
			footprint.uv = footprint__triangle_uv_footprint(footprint.place, corners, uvs);
			if (bindings__HAS_SECOND_UVS) {
				footprint.second_uv = footprint__triangle_uv_footprint(footprint.place, corners, second_uvs);
			}
		}
		if (bindings__HAS_NORMAL_MAPS) {
			shading_normal = normal_map__mapped_normal(normal_map__normal_map_of(v0.material), frame, n, corners, rows, weights, footprint);
		}
		if (bindings__HAS_COAT_NORMALS) {
			coat_normal = normal_map__mapped_normal(normal_map__coat_map_of(v0.material), frame, n, corners, rows, weights, footprint);
		}
	}
	let flips = material__must_flip(material.flags, dot(n, ng), dot(ng, ray.direction));
	return shading__Surface(corners * weights, select(shading_normal, -shading_normal, flips), ng, offset__triangle_error(corners[0], corners[1], corners[2], b1, b2), hit.primitive, (dot(n, ng) < 0.0) == (dot(ng, ray.direction) > 0.0), uv, second_uv, v0.material, phong, own.i0 ^ (own.i1 << 10u) ^ (own.i2 << 20u), place, types__NO_INSTANCE, footprint, footprint__triangle_curvature(corners, normals, dot(ng, n) * dot(ng, ray.direction)), tangent_space__surface_tangent(frame, shading_normal, flips), select(coat_normal, -coat_normal, flips), color, false);
}

fn triangle_surface__mix_phong(p0: shading__Phong, p1: shading__Phong, p2: shading__Phong, b0: f32, b1: f32, b2: f32) -> shading__Phong {
	return shading__Phong(b0 * p0.diffuse + b1 * p1.diffuse + b2 * p2.diffuse, b0 * p0.specular + b1 * p1.specular + b2 * p2.specular, b0 * p0.shininess + b1 * p1.shininess + b2 * p2.shininess, b0 * p0.ambient + b1 * p1.ambient + b2 * p2.ambient, b0 * p0.reflect + b1 * p1.reflect + b2 * p2.reflect);
}

fn tangent_space__placed_tangents(space: motion__Space, own: mat3x4f) -> mat3x4f {
	let mirrors = select(1.0, -1.0, determinant(space.linear) < 0.0);
	return mat3x4f(tangent_space__placed_tangent(space, own[0], mirrors), tangent_space__placed_tangent(space, own[1], mirrors), tangent_space__placed_tangent(space, own[2], mirrors));
}

fn tangent_space__placed_tangent(space: motion__Space, own: vec4f, mirrors: f32) -> vec4f {
	return vec4f(numeric__normalize_or(space.linear * own.xyz, vec3f(0.0)), mirrors * own.w);
}

fn tangent_space__vertex_frame(tangents: mat3x4f, normals: mat3x3f, weights: vec3f) -> mat3x3f {
	let is_whole = tangents[0].w * tangents[1].w * tangents[2].w != 0.0;
	let tangent = tangents * weights;
	let n = normals * weights;
	let frame = mat3x3f(tangent.xyz, sign(tangent.w) * cross(n, tangent.xyz), n);
	return frame * select(0.0, 1.0, is_whole);
}

fn tangent_space__surface_tangent(frame: mat3x3f, n: vec3f, flips: bool) -> vec4f {
	if (!bindings__HAS_ANISOTROPY) {
		return vec4f(0.0);
	}
	let along = numeric__normalize_or(frame[0] - dot(frame[0], n) * n, vec3f(0.0));
	let hand = select(-1.0, 1.0, (dot(cross(n, along), frame[1]) >= 0.0) != flips);
	return vec4f(along, select(hand, 0.0, dot(along, along) == 0.0));
}

fn vertex_color__interpolated_color(triangle: types__PackedTriangle, weights: vec3f) -> vec4f {
	return mat3x4f(fetch__load_color(triangle.i0), fetch__load_color(triangle.i1), fetch__load_color(triangle.i2)) * weights;
}

fn vertex_color__colored_phong(phong: shading__Phong, color: vec3f, flags: u32) -> shading__Phong {
	let is_mirror = (flags & types__MATERIAL_COLORED_MIRROR) != 0u;
	return shading__Phong(color * phong.diffuse, select(phong.specular, saturate_vec3f(color * phong.specular), is_mirror), phong.shininess, color * phong.ambient, select(phong.reflect, saturate_vec3f(color * phong.reflect), is_mirror));
}

const ray_cone__MOST_TAPS: f32 = 8.0;

const ray_cone__WIDEST: f32 = 1000000000000000.0;

struct ray_cone__Filtering {
	level: f32,
	tap_count: u32,
	way: vec2f
}

fn ray_cone__cone_at(cone: tracing__Cone, distance: f32) -> tracing__Cone {
	return tracing__Cone(clamp_f32(cone.width + distance * cone.spread, -ray_cone__WIDEST, ray_cone__WIDEST), cone.spread);
}

fn ray_cone__footprint_axes(direction: vec3f, n: vec3f, width: f32) -> mat2x3f {
	let cosine = dot(n, direction);
	let axis = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(n.x) > 0.7);
	let other = numeric__normalize_or(cross(n, axis), vec3f(0.0, 0.0, 1.0));
	let slope = direction - cosine * n;
	let along = select(other, numeric__normalize_or(slope, other), dot(slope, slope) > 1e-8);
	let size = abs(width);
	return mat2x3f((size / max_f32(abs(cosine), 0.001)) * along, size * cross(n, along));
}

fn ray_cone__uv_along(v: vec3f, e1: vec3f, e2: vec3f, d1: vec2f, d2: vec2f) -> vec2f {
	let normal = cross(e1, e2);
	let n = numeric__normalize_or(normal, vec3f(0.0));
	let area = max_f32(dot(normal, n), 1e-30);
	return (dot(cross(v, e2), n) / area) * d1 + (dot(cross(e1, v), n) / area) * d2;
}

fn ray_cone__curvature_along(edge: vec3f, bend: vec3f) -> f32 {
	return dot(edge, bend) / max_f32(dot(edge, edge), 1e-30);
}

fn ray_cone__filtering(a: vec2f, b: vec2f) -> ray_cone__Filtering {
	let is_first = dot(a, a) >= dot(b, b);
	let way = select(b, a, is_first);
	let long = length(way);
	let short = length(select(a, b, is_first));
	let count = clamp_f32(round(long / max_f32(short, 1.0)), 1.0, ray_cone__MOST_TAPS);
	let width = max_f32(max_f32(short, long / count), 1e-9);
	return ray_cone__Filtering(log2(width), u32(count), select(vec2f(0.0), way, count > 1.0));
}

struct normal_map__NormalMap {
	index: u32,
	scale: f32
}

fn normal_map__normal_map_of(material: u32) -> normal_map__NormalMap {
	return normal_map__NormalMap(material__load_texture_indices(material).w & 65535u, material__load_normal_scale(material));
}

fn normal_map__coat_map_of(material: u32) -> normal_map__NormalMap {
	let layers = material__load_layers(material);
	return normal_map__NormalMap(layers__texture_in(layers, types__SLOT_COAT_NORMAL), layers.coat_normal_scale);
}

fn normal_map__mapped_normal(map: normal_map__NormalMap, frame: mat3x3f, n: vec3f, corners: mat3x3f, uvs: mat3x4f, weights: vec3f, footprint: shading__Footprint) -> vec3f {
	if (map.index == types__NO_TEXTURE) {
		return n;
	}
	let texture = material__load_texture(map.index);
	let q0 = normal_map__in_picture(texture, uvs[0]);
	let q1 = normal_map__in_picture(texture, uvs[1]);
	let q2 = normal_map__in_picture(texture, uvs[2]);
	let q = weights.x * q0 + weights.y * q1 + weights.z * q2;
	let code = texture__picture_color(texture, q, texture__footprint_in(texture, footprint)).xyz;
	let tilt = map.scale * (2.0 * code.xy - vec2f(1.0));
	let up = max_f32(2.0 * code.z - 1.0, 0.0);
	if (bindings__HAS_TANGENTS) {
		if (dot(frame[2], frame[2]) > 0.0) {
			return numeric__normalize_or(frame * vec3f(tilt, up), n);
		}
	}
	let tangent = tangent__tangent_along(corners[1] - corners[0], corners[2] - corners[0], q1 - q0, q2 - q0, n);
	let bitangent = tangent.w * cross(n, tangent.xyz);
	return numeric__normalize_or(tilt.x * tangent.xyz + tilt.y * bitangent + up * n, n);
}

fn normal_map__in_picture(texture: types__PackedTexture, uvs: vec4f) -> vec2f {
	let is_second = bindings__HAS_SECOND_UVS && (texture.flags & types__TEXTURE_SECOND_UV) != 0u;
	let at = vec4f(select(uvs.xy, uvs.zw, is_second), 0.0, 1.0);
	return vec2f(dot(texture.row_x, at), dot(texture.row_y, at));
}

fn texture__picture_color(texture: types__PackedTexture, q: vec2f, axes: mat2x2f) -> vec4f {
	if (bindings__HAS_FOOTPRINTS) {
		return mipmap__mipmap_color(texture, q, axes);
	}
	let nearest = (texture.flags & types__TEXTURE_NEAREST) != 0u;
	let wrap_u = (texture.flags >> types__TEXTURE_WRAP_U_SHIFT) & 3u;
	let wrap_v = (texture.flags >> types__TEXTURE_WRAP_V_SHIFT) & 3u;
	return picture__blend_texels(texture.picture, texture.width, texture.height, picture__neighbours(q.x, texture.width, nearest, wrap_u), picture__neighbours(q.y, texture.height, nearest, wrap_v));
}

fn texture__uses_second_uv(texture: types__PackedTexture) -> bool {
	return bindings__HAS_SECOND_UVS && (texture.flags & types__TEXTURE_SECOND_UV) != 0u;
}

fn texture__footprint_in(texture: types__PackedTexture, footprint: shading__Footprint) -> mat2x2f {
	if (!bindings__HAS_FOOTPRINTS) {
		return mat2x2f();
	}
	let is_uv = (texture.flags & types__TEXTURE_UV) != 0u;
	var in_uv = footprint.uv;
	if (texture__uses_second_uv(texture)) {
		in_uv = footprint.second_uv;
	}
	let a = select(footprint.place[0], vec3f(in_uv[0], 0.0), is_uv);
	let b = select(footprint.place[1], vec3f(in_uv[1], 0.0), is_uv);
	return mat2x2f(vec2f(dot(texture.row_x.xyz, a), dot(texture.row_y.xyz, a)), vec2f(dot(texture.row_x.xyz, b), dot(texture.row_y.xyz, b)));
}

fn mipmap__mipmap_color(texture: types__PackedTexture, q: vec2f, axes: mat2x2f) -> vec4f {
	let size = vec2f(vec2u(texture.width, texture.height));
	let plan = ray_cone__filtering(size * axes[0], size * axes[1]);
	let has_levels = (texture.flags & types__TEXTURE_LEVELS) != 0u;
	let last = select(0.0, f32(31u - countLeadingZeros(max(texture.width, texture.height))), has_levels);
	let exact = clamp_f32(plan.level, 0.0, last);
	let level = select(round(exact), exact, (texture.flags & types__TEXTURE_BETWEEN_LEVELS) != 0u);
	let tap_count = select(1u, plan.tap_count, has_levels);
	let way = select(vec2f(0.0), plan.way / size, has_levels);
	let nearest_bit = select(types__TEXTURE_NEAREST, types__TEXTURE_MINIFY_NEAREST, plan.level > 0.0);
	let nearest = (texture.flags & nearest_bit) != 0u;
	let wrap_u = (texture.flags >> types__TEXTURE_WRAP_U_SHIFT) & 3u;
	let wrap_v = (texture.flags >> types__TEXTURE_WRAP_V_SHIFT) & 3u;
	let below = u32(level);
	let weight = fract(level);
	let end = select(tap_count, 2u * tap_count, weight > 0.0);
	var color = vec4f(0.0);
	var k = 0u;
	loop {
		let is_above = k >= tap_count;
		let tap = f32(k - select(0u, tap_count, is_above));
		let at = q + ((tap + 0.5) / f32(tap_count) - 0.5) * way;
		let own = below + select(0u, 1u, is_above);
		let width = max(texture.width >> own, 1u);
		let height = max(texture.height >> own, 1u);
		let sample = picture__blend_texels(mipmap__level_of(texture.picture, own), width, height, picture__neighbours(at.x, width, nearest, wrap_u), picture__neighbours(at.y, height, nearest, wrap_v));
		color += select(1.0 - weight, weight, is_above) * sample;
		continuing {
			k += 1u;
			break if k >= end;
		}
	}
	loops__cut_off |= k < end;
	return color / f32(tap_count);
}

fn mipmap__level_of(picture: u32, level: u32) -> u32 {
	if (level == 0u) {
		return picture;
	}
	return picture + picture__load_texel_word((picture & types__PICTURE_FIRST_MASK) - level);
}

fn picture__blend_texels(picture: u32, width: u32, height: u32, columns: picture__Neighbours, rows: picture__Neighbours) -> vec4f {
	let lower = (height - 1u - rows.first) * width;
	let upper = (height - 1u - rows.second) * width;
	return mix(mix(picture__texel_at(picture, lower + columns.first), picture__texel_at(picture, lower + columns.second), columns.weight), mix(picture__texel_at(picture, upper + columns.first), picture__texel_at(picture, upper + columns.second), columns.weight), rows.weight);
}

fn picture__texel_at(picture: u32, index: u32) -> vec4f {
	let first = picture & types__PICTURE_FIRST_MASK;
	if (bindings__HAS_HALF_TEXELS && (!bindings__HAS_BYTE_TEXELS || (picture & types__PICTURE_HALF) != 0u)) {
		let low = picture__load_texel_word(first + 2u * index);
		let high = picture__load_texel_word(first + 2u * index + 1u);
		return vec4f(picture__halves(low), picture__halves(high));
	}
	let values = unpack4x8unorm(picture__load_texel_word(first + index));
	return vec4f(select(values.xyz, picture__linear_from_srgb(values.xyz), (picture & types__PICTURE_SRGB) != 0u), values.w);
}

fn picture__load_texel_word(index: u32) -> u32 {
	let row = index >> types__IMAGE_WIDTH_LOG2;
	let place = vec2u(index & ((1u << types__IMAGE_WIDTH_LOG2) - 1u), row & ((1u << types__LAYER_ROWS_LOG2) - 1u));
	return rows__texel_word(place, row >> types__LAYER_ROWS_LOG2);
}

struct picture__Neighbours {
	first: u32,
	second: u32,
	weight: f32
}

fn picture__neighbours(at: f32, count: u32, nearest: bool, wrap: u32) -> picture__Neighbours {
	let mirrored = 1.0 - abs(1.0 - 2.0 * fract(0.5 * at));
	let inside = select(select(clamp_f32(at, 0.0, 1.0), mirrored, wrap == types__WRAP_MIRROR), fract(at), wrap == types__WRAP_REPEAT);
	let place = f32(count) * inside + select(-0.5, 0.0, nearest);
	let below = floor(place);
	let last = i32(count) - 1;
	let index = min(i32(below), last);
	let first = picture__within(index, last, wrap == types__WRAP_REPEAT);
	let second = picture__within(index + 1, last, wrap == types__WRAP_REPEAT);
	return picture__Neighbours(u32(first), u32(second), select(place - below, 0.0, nearest));
}

fn picture__within(index: i32, last: i32, repeats: bool) -> i32 {
	let before = select(0, last, repeats);
	let after = select(last, 0, repeats);
	return select(select(index, before, index < 0), after, index > last);
}

fn picture__halves(bits: u32) -> vec2f {
	let codes = vec2u(bits & 65535u, bits >> 16u);
	let normal = bitcast<vec2f>(codes << vec2u(13u)) * 5.192296858534828e33;
	return select(normal, vec2f(codes) * 5.960464477539063e-8, codes < vec2u(1024u));
}

fn picture__linear_from_srgb(encoded: vec3f) -> vec3f {
	var power = vec3f(-0.1110666543);
	power = power * encoded + vec3f(0.5140681863);
	power = power * encoded + vec3f(-1.0304795504);
	power = power * encoded + vec3f(1.2059204578);
	power = power * encoded + vec3f(-0.9925410748);
	power = power * encoded + vec3f(0.8972986937);
	power = power * encoded + vec3f(0.4803068042);
	power = power * encoded + vec3f(0.0356449671);
	power = power * encoded + vec3f(0.0008464342);
	return select(power, encoded / 12.92, encoded <= vec3f(0.04045));
}

fn tangent__tangent_along(e1: vec3f, e2: vec3f, d1: vec2f, d2: vec2f, n: vec3f) -> vec4f {
	let area = d1.x * d2.y - d1.y * d2.x;
	let hand = select(1.0, -1.0, area < 0.0);
	let along = hand * (d2.y * e1 - d1.y * e2);
	let axis = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(n.x) > 0.7);
	let other = numeric__normalize_or(cross(n, axis), vec3f(1.0, 0.0, 0.0));
	let within = numeric__normalize_or(along, other);
	return vec4f(numeric__normalize_or(within - dot(within, n) * n, other), hand);
}

fn layers__texture_in(own: types__PackedLayers, slot: u32) -> u32 {
	let late = select(own.more_textures, own.last_textures, vec4<bool>(slot >= 16u));
	let four = select(own.textures, late, vec4<bool>(slot >= 8u));
	let word = (slot >> 1u) & 3u;
	let low = select(four.x, four.y, word == 1u);
	let high = select(four.z, four.w, word == 3u);
	return (select(low, high, word >= 2u) >> (16u * (slot & 1u))) & 65535u;
}

fn colormap__id_color(id: u32) -> vec3f {
	let h = rng__hash(id);
	return 0.15 + 0.85 * vec3f(rng__unit_float(h), rng__unit_float(rng__hash(h)), rng__unit_float(rng__hash(h ^ 1540483477u)));
}

fn colormap__uv_color(uv: vec2f) -> vec3f {
	let field = vec2i(floor(fract(uv) * 8.0));
	let shade = select(0.7, 1.0, ((field.x + field.y) & 1) == 0);
	return vec3f(fract(uv) * shade, 0.0);
}

const filter__PI: f32 = 3.14159265;

const filter__SIGMA: f32 = 0.5;

const filter__ROUNDS: u32 = 22u;

const filter__BLACKMAN_HARRIS_1: f32 = 0.48829 / (filter__PI * 0.35875);

const filter__BLACKMAN_HARRIS_2: f32 = 0.14128 / (filter__PI * 0.35875);

const filter__BLACKMAN_HARRIS_3: f32 = 0.01168 / (3.0 * filter__PI * 0.35875);

const filter__MITCHELL_ZERO: f32 = 1.14285714;

const filter__MITCHELL_POSITIVE: f32 = 0.51749271;

const filter__MITCHELL_TOTAL: f32 = 0.53498542;

fn filter__filter_offset(kind: u32, radius: f32, u: vec2f) -> vec2f {
	let centred = 2.0 * u - 1.0;
	if (kind == types__FILTER_BOX) {
		return 2.0 * radius * (u - 0.5);
	}
	let side = select(vec2f(-1.0), vec2f(1.0), centred >= vec2f(0.0));
	let fraction = abs(centred);
	if (kind == types__FILTER_TENT) {
		return radius * side * (1.0 - sqrt(max_vec2f(1.0 - fraction, vec2f(0.0))));
	}
	if (kind == types__FILTER_GAUSSIAN) {
		let scale = filter__SIGMA * sqrt(2.0);
		return scale * side * min_vec2f(filter__inverse_erf(fraction * filter__erf(radius / scale)), vec2f(radius / scale));
	}
	return radius * side * filter__searched(kind, fraction);
}

fn filter__filter_sign(kind: u32, u: vec2f) -> f32 {
	let negative = abs(2.0 * u - 1.0) > vec2f(filter__MITCHELL_POSITIVE / filter__MITCHELL_TOTAL);
	return select(1.0, -1.0, (kind == types__FILTER_MITCHELL) & (negative.x != negative.y));
}

fn filter__searched(kind: u32, fraction: vec2f) -> vec2f {
	var low = vec2f(0.0);
	var width = 1.0;
	var done = 0u;
	loop {
		width *= 0.5;
		let middle = low + width;
		low = select(low, middle, filter__cumulated(kind, middle) <= fraction);
		continuing {
			done += 1u;
			break if done >= filter__ROUNDS;
		}
	}
	return low + 0.5 * width;
}

fn filter__cumulated(kind: u32, x: vec2f) -> vec2f {
	if (kind == types__FILTER_BLACKMAN_HARRIS) {
		let s = sin(filter__PI * x);
		let c = cos(filter__PI * x);
		return x + s * (filter__BLACKMAN_HARRIS_1 + filter__BLACKMAN_HARRIS_2 * c + filter__BLACKMAN_HARRIS_3 * (4.0 * c * c - 1.0));
	}
	let t = 2.0 * x;
	let inner = t * (16.0 / 3.0 + t * t * (-4.0 + t * 1.75)) / 6.0;
	let e = 2.0 - t;
	let outer = e * e * e * (7.0 / 12.0 * e - 2.0 / 3.0) / 6.0;
	let signed = select(0.5 - outer, inner, t < vec2f(1.0));
	let absolute = select(signed, 2.0 * filter__MITCHELL_POSITIVE - signed, t > vec2f(filter__MITCHELL_ZERO));
	return absolute / filter__MITCHELL_TOTAL;
}

fn filter__erf(x: f32) -> f32 {
	let t = 1.0 / (1.0 + 0.3275911 * x);
	let series = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
	return 1.0 - series * exp(-min_f32(x * x, 80.0));
}

fn filter__inverse_erf(y: vec2f) -> vec2f {
	let w = -log(max_vec2f((1.0 - y) * (1.0 + y), vec2f(1e-7)));
	let a = w - 2.5;
	let b = sqrt(max_vec2f(w, vec2f(0.0))) - 3.0;
	let near = 1.50140941 + a * (0.246640727 + a * (-0.00417768164 + a * (-0.00125372503 + a * (0.00021858087 + a * (-4.39150654e-6 + a * (-3.5233877e-6 + a * (3.43273939e-7 + a * 2.81022636e-8)))))));
	let far = 2.83297682 + b * (1.00167406 + b * (0.00943887047 + b * (-0.0076224613 + b * (0.00573950773 + b * (-0.00367342844 + b * (0.00134934322 + b * (0.000100950558 - b * 0.000200214257)))))));
	return y * select(far, near, w < vec2f(5.0));
}

fn sampling__sobol(index: u32) -> vec2u {
	let a = index ^ ((index >> 1u) & 1431655765u);
	let b = a ^ ((a >> 2u) & 858993459u);
	let c = b ^ ((b >> 4u) & 252645135u);
	let d = c ^ ((c >> 8u) & 16711935u);
	let e = d ^ ((d >> 16u) & 65535u);
	return vec2u(reverseBits(index), reverseBits(e));
}

fn sampling__owen_scramble(fraction: u32, seed: u32) -> u32 {
	let a = reverseBits(fraction) + seed;
	let b = a ^ (a * 1817228412u);
	let c = b ^ (b * 3090095698u);
	let d = c ^ (c * 3350193720u);
	return reverseBits(d ^ (d * 2367878886u));
}

fn sampling__sobol_34(index: u32) -> vec2u {
	return sampling__columns(index, vec4u(2147483648u, 3221225472u, 1610612736u, 2415919104u), vec4u(2147483648u, 3221225472u, 536870912u, 1342177280u)) ^ sampling__columns(index >> 4u, vec4u(3892314112u, 1543503872u, 2382364672u, 3305111552u), vec4u(4160749568u, 1946157056u, 2717908992u, 2466250752u)) ^ sampling__columns(index >> 8u, vec4u(1753219072u, 2629828608u, 3999268864u, 1435500544u), vec4u(3632267264u, 624951296u, 1507852288u, 3872391168u)) ^ sampling__columns(index >> 12u, vec4u(2154299392u, 3231449088u, 1626210304u, 2421489664u), vec4u(2013790208u, 3020685312u, 2181169152u, 3271884800u)) ^ sampling__columns(index >> 16u, vec4u(3900735488u, 1556135936u, 2388680704u, 3314585600u), vec4u(546275328u, 1363623936u, 4226424832u, 1977167872u)) ^ sampling__columns(index >> 20u, vec4u(1751705600u, 2627492864u, 4008611328u, 1431684352u), vec4u(2693105664u, 2437829632u, 3689389568u, 635137280u)) ^ sampling__columns(index >> 24u, vec4u(2147543168u, 3221249216u, 1610649184u, 2415969680u), vec4u(1484783744u, 3846176960u, 2044723232u, 3067084880u)) ^ sampling__columns(index >> 28u, vec4u(3892340840u, 1543543964u, 2382425838u, 3305133397u), vec4u(2148008184u, 3222012020u, 537002146u, 1342505107u));
}

fn sampling__columns(index: u32, third: vec4u, fourth: vec4u) -> vec2u {
	let is_chosen = (vec4u(index) & vec4u(1u, 2u, 4u, 8u)) != vec4u(0u);
	let z = select(vec4u(0u), third, is_chosen);
	let w = select(vec4u(0u), fourth, is_chosen);
	return vec2u(z.x ^ z.y ^ z.z ^ z.w, w.x ^ w.y ^ w.z ^ w.w);
}

fn sampling__stratified_2d(index: u32, key: u32) -> vec2f {
	return sampling__scrambled(sampling__sobol(sampling__owen_scramble(index, rng__hash(key))), key);
}

fn sampling__stratified_34(index: u32, key: u32) -> vec2f {
	return sampling__scrambled(sampling__sobol_34(sampling__owen_scramble(index, rng__hash(key))), key ^ 2654435769u);
}

fn sampling__stratified_1d(index: u32, key: u32) -> f32 {
	let own = key ^ 1757159915u;
	return rng__unit_float(sampling__owen_scramble(reverseBits(sampling__owen_scramble(index, rng__hash(own))), rng__hash(own ^ 48610963u)));
}

fn sampling__scrambled(point: vec2u, key: u32) -> vec2f {
	return vec2f(rng__unit_float(sampling__owen_scramble(point.x, rng__hash(key ^ 2769414579u))), rng__unit_float(sampling__owen_scramble(point.y, rng__hash(key ^ 1675113877u))));
}

var<private> features__off_centre: f32;

const warp__PI: f32 = 3.14159265;

fn warp__disc_from_square(u: vec2f) -> vec2f {
	let p = 2.0 * u - 1.0;
	let by_x = abs(p.x) > abs(p.y);
	let radius = select(p.y, p.x, by_x);
	let ratio = select(p.x, p.y, by_x) / select(1.0, radius, abs(radius) > 0.0);
	let angle = select(0.5 * warp__PI - 0.25 * warp__PI * ratio, 0.25 * warp__PI * ratio, by_x);
	return radius * vec2f(cos(angle), sin(angle));
}

fn warp__triangle_from_square(u: vec2f) -> vec2f {
	let s = sqrt(u.y);
	return vec2f(s * (1.0 - u.x), s * u.x);
}

fn warp__polygon_from_square(u: vec2f, count: u32, rotation: f32) -> vec2f {
	let edge = min_f32(floor(u.x * f32(count)), f32(count) - 1.0);
	let b = warp__triangle_from_square(vec2f(clamp_f32(u.x * f32(count) - edge, 0.0, 1.0), u.y));
	let step = 2.0 * warp__PI / f32(count);
	let angles = rotation + step * vec2f(edge, edge + 1.0);
	return b.x * vec2f(cos(angles.x), sin(angles.x)) + b.y * vec2f(cos(angles.y), sin(angles.y));
}

const tone__LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);

var<private> ray_stack__cut_off_trees: u32;

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
