const WALKS: u32 = 2u;

@compute @workgroup_size(64, 1, 1)
fn path_trace(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	let batch = dispatch__load_batch();
	stack__take_stack(lane);
	var pixel = pixels__load_pixel(batch, block__load_block(group), lane);
	var sample = batch.first_sample;
	var path = path__camera_path(batch, pixel, sample);
	var walk = path__next_walk(path);
	let most_walks = select(WALKS, 1u, batch.end_sample == 0u);
	loop {
		var walks = 0u;
		loop {
			walk = section_walk__followed(walk, steps__WALK_ROUNDS);
			if (!traverse__is_walking(walk) && path__is_to_lamp(path) && !shadow__may_pass(walk.hit)) {
				path = path__lit(path, shadow__arrived(path.lamp, walk.hit));
				walk = path__next_walk(path);
			}
			walks += 1u;
			continuing {
			
				break if walks >= most_walks;
			}
		}
		loops__cut_off |= walks < most_walks;
		if (!traverse__is_walking(walk) && (!path__is_to_lamp(path) || shadow__may_pass(walk.hit))) {
			if (path__is_going(path)) {
				path = path_vertex__traced(batch, path, walk.hit);
			}
			if (!path__is_going(path)) {
				pixel = pixels__with_sample(pixel, sample, path.radiance);
				sample += 1u;
				path = path__camera_path(batch, pixel, sample);
			}
			walk = path__next_walk(path);
		}
		continuing {
		
			break if sample >= batch.end_sample;
		}
	}
	loops__cut_off |= sample < batch.end_sample;
	pixels__store_pixel(pixel);
	dispatch__add_counts(group, lane);
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

fn dispatch__way_to_far(batch: dispatch__Batch, p: vec3f, direction: vec3f) -> f32 {
	if (!bindings__HAS_CLIP || batch.clip.y == 0.0) {
		return camera__T_FAR;
	}
	let camera = shutter__shutter_camera(batch.camera);
	let depth = dot(p - camera.origin, normalize(camera.forward));
	return camera__along_ray(camera, max_f32(batch.clip.y - depth, 0.0), direction);
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

fn dispatch__count_hit(kind: u32, hit: tracing__Hit) {
	if (bindings__COUNT_RAYS && hit.t >= 0.0) {
		let hits = select(0u, 1u, hit.primitive != types__NONE);
		if (kind == types__RAY_PRIMARY) {
			dispatch__counts.primary += 1u;
			dispatch__counts.primary_hits += hits;
		}
		else if (kind == types__RAY_REFLECTION) {
			dispatch__counts.reflection += 1u;
			dispatch__counts.reflection_hits += hits;
		}
		else {
			dispatch__counts.refraction += 1u;
			dispatch__counts.refraction_hits += hits;
		}
	}
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

const types__SHORT_STACK_SIZE: u32 = 32u;

const types__NO_INSTANCE: u32 = 1048575u;

const types__CUT_OFF_LOOP: u32 = 1u;

const types__CUT_OFF_STACK: u32 = 2u;

const types__FLOAT_NODE_ROWS: u32 = 7u;

const types__INSTANCE_ROWS: u32 = 10u;

const types__KEY_ROWS: u32 = 4u;

const types__LIGHT_ROWS: u32 = 6u;

const types__CLUSTER_ROWS: u32 = 2u;

const types__LIGHT_LEAF: u32 = 2147483648u;

const types__LIGHT_BY_POWER: u32 = 1073741824u;

const types__LIGHT_EMITTERS: u32 = 1073741824u;

const types__LIGHT_TWO_SIDED: u32 = 536870912u;

const types__LIGHT_INDEX_MASK: u32 = 536870911u;

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

const types__LIGHT_DIRECTIONAL: u32 = 1u;

const types__LIGHT_SPOT: u32 = 2u;

const types__LIGHT_RECTANGLE: u32 = 3u;

const types__LIGHT_DISC: u32 = 4u;

const types__LIGHT_SPHERE: u32 = 5u;

const types__MIXED_LIGHTS: u32 = 4294967295u;

const types__ATTENUATION_INVERSE_SQUARE: u32 = 1u;

const types__LARGEST_RADIANCE_BITS: u32 = 1400897536u;

const types__MATERIAL_TWO_SIDED: u32 = 1u;

const types__MATERIAL_FRESNEL: u32 = 2u;

const types__MATERIAL_SCHLICK: u32 = 4u;

const types__MATERIAL_SUM: u32 = 8u;

const types__MATERIAL_COVERAGE: u32 = 32u;

const types__MATERIAL_MASK: u32 = 64u;

const types__MATERIAL_THIN: u32 = 128u;

const types__MATERIAL_METALLIC_ROUGHNESS: u32 = 256u;

const types__MATERIAL_SHADOW_CATCHER: u32 = 512u;

const types__MATERIAL_TWO_SIDED_EMISSION: u32 = 1024u;

const types__MATERIAL_COLORED_MIRROR: u32 = 2048u;

const types__MATERIAL_COLORED_GLASS: u32 = 4096u;

const types__MATERIAL_COLORED_EMISSION: u32 = 8192u;

const types__MATERIAL_ROWS: u32 = 20u;

const types__LAYERS_ROW: u32 = 9u;

const types__SLOT_BASE: u32 = 0u;

const types__SLOT_METALLIC_ROUGHNESS: u32 = 1u;

const types__SLOT_F0: u32 = 2u;

const types__SLOT_TRANSMISSION: u32 = 3u;

const types__SLOT_F90: u32 = 4u;

const types__SLOT_COAT: u32 = 5u;

const types__SLOT_COAT_ROUGHNESS: u32 = 6u;

const types__SLOT_SHEEN: u32 = 7u;

const types__SLOT_SHEEN_ROUGHNESS: u32 = 8u;

const types__SLOT_ANISOTROPY: u32 = 9u;

const types__SLOT_IRIDESCENCE: u32 = 10u;

const types__SLOT_FILM_THICKNESS: u32 = 11u;

const types__SLOT_DIFFUSE_TRANSMISSION: u32 = 12u;

const types__SLOT_DIFFUSE_TRANSMISSION_COLOR: u32 = 13u;

const types__SLOT_REFLECT: u32 = 14u;

const types__SLOT_EMISSION: u32 = 15u;

const types__SLOT_METALLIC: u32 = 16u;

const types__SLOT_ROUGHNESS: u32 = 17u;

const types__SLOT_COAT_NORMAL: u32 = 18u;

const types__TEXTURE_ROWS: u32 = 6u;

const types__NO_TEXTURE: u32 = 65535u;

const types__PATTERN_STRIPES: u32 = 1u;

const types__PATTERN_GRADIENT: u32 = 2u;

const types__PATTERN_NOISE: u32 = 3u;

const types__PATTERN_PICTURE: u32 = 4u;

const types__TEXTURE_UV: u32 = 1u;

const types__TEXTURE_NEAREST: u32 = 2u;

const types__TEXTURE_MINIFY_NEAREST: u32 = 64u;

const types__TEXTURE_LEVELS: u32 = 128u;

const types__TEXTURE_BETWEEN_LEVELS: u32 = 256u;

const types__TEXTURE_SECOND_UV: u32 = 512u;

const types__TEXTURE_WRAP_U_SHIFT: u32 = 2u;

const types__TEXTURE_WRAP_V_SHIFT: u32 = 4u;

const types__WRAP_REPEAT: u32 = 0u;

const types__WRAP_CLAMP: u32 = 1u;

const types__WRAP_MIRROR: u32 = 2u;

const types__PICTURE_HALF: u32 = 2147483648u;

const types__PICTURE_SRGB: u32 = 1073741824u;

const types__PICTURE_FIRST_MASK: u32 = 1073741823u;

const types__BACKGROUND_GRADIENT: u32 = 1u;

const types__BACKGROUND_PICTURE: u32 = 2u;

const types__BACKGROUND_SKY: u32 = 3u;

const types__BACKDROP_BACKGROUND: u32 = 0u;

const types__BACKDROP_TRANSPARENT: u32 = 2u;

const types__FILTER_BOX: u32 = 0u;

const types__FILTER_TENT: u32 = 1u;

const types__FILTER_GAUSSIAN: u32 = 2u;

const types__FILTER_BLACKMAN_HARRIS: u32 = 3u;

const types__FILTER_MITCHELL: u32 = 4u;

const types__TRIANGLE_TEST_PLANE: u32 = 0u;

const types__TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1u;

const types__TRIANGLE_TEST_WATERTIGHT: u32 = 2u;

const types__RAY_PRIMARY: u32 = 0u;

const types__RAY_REFLECTION: u32 = 1u;

const types__RAY_REFRACTION: u32 = 2u;

const types__LOBE_DIFFUSE: u32 = 0u;

const types__LOBE_GLOSSY: u32 = 1u;

const types__LOBE_COAT: u32 = 2u;

const types__LOBE_SHEEN: u32 = 3u;

const types__LOBE_BOUNDARY: u32 = 4u;

const types__SOURCE_LIGHT: u32 = 0u;

const types__SOURCE_EMITTER: u32 = 1u;

const types__SOURCE_ENVIRONMENT: u32 = 2u;

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

struct types__PackedLight {
	position: vec3f,
	kind: u32,
	direction: vec3f,
	attenuation: u32,
	color: vec3f,
	cos_inner: f32,
	edge_u: vec3f,
	cos_outer: f32,
	edge_v: vec3f,
	radius: f32,
	sample_count: u32,
	chance: f32,
	place: u32,
	visible: u32
}

struct types__PackedCluster {
	center: vec3f,
	power: f32,
	radius2: f32,
	child: u32,
	axis: u32,
	cones: u32
}

struct types__PackedEmitter {
	primitive: u32,
	instance: u32,
	end: f32,
	trail: u32
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

fn fetch__load_light(index: u32) -> types__PackedLight {
	let row = fetch__light_row + types__LIGHT_ROWS * index;
	let r0 = rows__node_row(row);
	let r1 = rows__node_row(row + 1u);
	let r2 = rows__node_row(row + 2u);
	let r3 = rows__node_row(row + 3u);
	let r4 = rows__node_row(row + 4u);
	let r5 = rows__node_row(row + 5u);
	return types__PackedLight(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec3f>(r2.xyz), bitcast<f32>(r2.w), bitcast<vec3f>(r3.xyz), bitcast<f32>(r3.w), bitcast<vec3f>(r4.xyz), bitcast<f32>(r4.w), r5.x, bitcast<f32>(r5.y), r5.z, r5.w);
}

fn fetch__load_light_end(index: u32) -> f32 {
	let r5 = rows__node_row(fetch__light_row + types__LIGHT_ROWS * index + 5u);
	return bitcast<f32>(r5.y) + bitcast<f32>(r5.z);
}

fn fetch__load_emitter(index: u32) -> types__PackedEmitter {
	let r0 = rows__node_row(bindings__frame.emitter_row + index);
	return types__PackedEmitter(r0.x, r0.y, bitcast<f32>(r0.z), r0.w);
}

fn fetch__load_emitter_glow(index: u32) -> f32 {
	let row = rows__node_row(bindings__frame.emitter_row + bindings__frame.emitter_count + index / 4u);
	return bitcast<f32>(row[index % 4u]);
}

fn fetch__load_cluster(index: u32) -> types__PackedCluster {
	let row = bindings__frame.cluster_row + types__CLUSTER_ROWS * index;
	let r0 = rows__node_row(row);
	let r1 = rows__node_row(row + 1u);
	return types__PackedCluster(bitcast<vec3f>(r0.xyz), bitcast<f32>(r0.w), bitcast<f32>(r1.x), r1.y, r1.z, r1.w);
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

override bindings__FIXED_OFFSET: f32 = 0.0;

override bindings__STRATIFIED: bool = false;

override bindings__COUNT_RAYS: bool = false;

override bindings__HAS_REFLECTION: bool = false;

override bindings__HAS_REFRACTION: bool = false;

override bindings__HAS_PRIORITIES: bool = false;

override bindings__FILTERED_SHADOWS: bool = false;

override bindings__SOLID_GLASS: bool = false;

override bindings__HAS_LENS: bool = false;

override bindings__HAS_CLIP: bool = false;

override bindings__FILTER: u32 = 0u;

override bindings__FILTER_RADIUS: f32 = 0.0;

override bindings__HAS_TEXTURES: bool = false;

override bindings__HAS_NOISE: bool = false;

override bindings__HAS_PICTURES: bool = false;

override bindings__HAS_OPTICS_TEXTURES: bool = false;

override bindings__HAS_FOOTPRINTS: bool = false;

override bindings__HAS_COVERAGE: bool = false;

override bindings__HAS_TREES: bool = false;

override bindings__HAS_NORMAL_MAPS: bool = false;

override bindings__HAS_COAT_NORMALS: bool = false;

override bindings__HAS_BYTE_TEXELS: bool = false;

override bindings__HAS_HALF_TEXELS: bool = false;

override bindings__HAS_EMISSION: bool = false;

override bindings__HAS_LAYERS: bool = false;

override bindings__CLAMP_INDIRECT: f32 = 0.0;

override bindings__HAS_GLOSS: bool = false;

override bindings__HAS_METALLIC_ROUGHNESS: bool = false;

override bindings__HAS_COATINGS: bool = false;

override bindings__HAS_COATED_EMISSION: bool = false;

override bindings__HAS_ROUGH_GLASS: bool = false;

override bindings__HAS_DISPERSION: bool = false;

override bindings__BSDF_SPEC: bool = false;

override bindings__HAS_LIGHT_TREE: bool = false;

override bindings__HAS_EMITTERS: bool = false;

override bindings__HAS_EMISSIVE_SHAPES: bool = false;

override bindings__HAS_EMITTER_GLOWS: bool = false;

override bindings__HAS_ENVIRONMENT: bool = false;

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

override bindings__OPACITY_ROW: u32 = 0u;

override bindings__HAS_CATCHERS: bool = false;

override bindings__BACKDROP: u32 = 0u;

override bindings__FILM_ROWS: u32 = 0u;

override bindings__SQUARES_ROW: u32 = 0u;

override bindings__FEATURES_ROW: u32 = 0u;

override bindings__TRIANGLE_TEST: u32 = 0u;

override bindings__HAS_TRIANGLES: bool = false;

override bindings__TRIANGLES_OUTSIDE_TREE: u32 = 0u;

override bindings__SHAPES_OUTSIDE_TREE: bool = false;

override bindings__HAS_SHAPES: bool = false;

override bindings__HAS_PLANES: bool = false;

override bindings__SHAPE_KINDS: u32 = 0u;

override bindings__HAS_INSTANCES: bool = false;

override bindings__SHORT_STACK: bool = false;

override bindings__HAS_MOTION: bool = false;

override bindings__HAS_DEFORMATION: bool = false;

override bindings__HAS_CONTACT: bool = false;

override bindings__HAS_SECTION: bool = false;

override bindings__COUNT_STEPS: bool = false;

override bindings__HAS_LIGHTS: bool = false;

override bindings__HAS_AREA_LIGHTS: bool = false;

override bindings__LIGHT_KIND: u32 = 0u;

override bindings__LIGHT_ATTENUATION: u32 = 0u;

override bindings__BACKGROUND: u32 = 0u;

override bindings__HAS_OPACITY: bool = false;

override bindings__WORKGROUP_STACK: bool = false;

var<private> albedo__albedo_first: u32;

fn albedo__ggx_albedo(cos_o: f32, alpha: f32) -> vec2f {
	return albedo__ggx_factors(albedo__blended(albedo__ggx_lookup(cos_o, alpha)), cos_o);
}

fn albedo__stretched_albedo(wo: vec3f, alpha: vec2f) -> vec2f {
	let place = albedo__stretched_slice(wo, alpha);
	let slice = min(vec2u(place), albedo__STRETCHED_SLICES - 2u);
	let part = place - vec2f(slice);
	let at_azimuth = mix(albedo__blended(albedo__stretched_lookup(slice, wo, alpha)), albedo__blended(albedo__stretched_lookup(slice + vec2u(1u, 0u), wo, alpha)), part.x);
	let at_next = mix(albedo__blended(albedo__stretched_lookup(slice + vec2u(0u, 1u), wo, alpha)), albedo__blended(albedo__stretched_lookup(slice + vec2u(1u, 1u), wo, alpha)), part.x);
	return albedo__ggx_factors(mix(at_azimuth, at_next, part.y), wo.z);
}

fn albedo__sheen_albedo(cos_o: f32, alpha: f32) -> vec2f {
	return albedo__blended(albedo__sheen_lookup(cos_o, alpha));
}

fn albedo__glass_albedo(cos_o: f32, alpha: f32, eta: f32) -> vec2f {
	let place = albedo__glass_slice(eta);
	let slice = min(u32(place), albedo__GLASS_SLICES - 2u);
	let entry = mix(albedo__blended(albedo__glass_lookup(slice, cos_o, alpha, eta)), albedo__blended(albedo__glass_lookup(slice + 1u, cos_o, alpha, eta)), place - f32(slice));
	return albedo__glass_factors(entry, cos_o, alpha, eta);
}

fn albedo__blended(place: albedo__AlbedoLookup) -> vec2f {
	let words = place.words + vec4u(albedo__albedo_first);
	return albedo__blended_albedo(vec4u(picture__load_texel_word(words.x), picture__load_texel_word(words.y), picture__load_texel_word(words.z), picture__load_texel_word(words.w)), place.weights);
}

const stack__SHARED_ENTRIES: u32 = 24u;

const stack__LANES: u32 = 64u;

var<private> stack__top: u32;

var<private> stack__entries: array<u32, types__STACK_SIZE>;

var<private> stack__short_entries: array<u32, types__SHORT_STACK_SIZE>;

var<workgroup> stack__shared_entries: array<u32, stack__LANES * stack__SHARED_ENTRIES>;

var<private> stack__shared_lane: u32;

fn stack__take_stack(lane: u32) {
	stack__shared_lane = lane;
}

fn stack__start_stack() {
	stack__top = 0u;
	stack__put_entry(0u, traverse__EMPTY);
}

fn stack__entry_at(index: u32) -> u32 {
	if (bindings__WORKGROUP_STACK) {
		return stack__shared_entries[stack__LANES * index + stack__shared_lane];
	}
	if (bindings__SHORT_STACK) {
		return stack__short_entries[index];
	}
	return stack__entries[index];
}

fn stack__put_entry(index: u32, reference: u32) {
	if (bindings__WORKGROUP_STACK) {
		stack__shared_entries[stack__LANES * index + stack__shared_lane] = reference;
		return;
	}
	if (bindings__SHORT_STACK) {
		stack__short_entries[index] = reference;
		return;
	}
	stack__entries[index] = reference;
}

fn stack__push(reference: u32) {
	if (bindings__WORKGROUP_STACK && stack__top + 1u >= stack__SHARED_ENTRIES) {
		loops__is_stack_full = true;
		return;
	}
	stack__top += 1u;
	stack__put_entry(stack__top, reference);
}

fn stack__popped() -> u32 {
	let reference = stack__entry_at(stack__top);
	if (reference != traverse__EMPTY) {
		stack__top -= 1u;
	}
	return reference;
}

struct pixels__Pixel {
	film_index: u32,
	position: vec2u,
	key: u32,
	sum: film__Sum
}

fn pixels__load_pixel(batch: dispatch__Batch, block: block__Block, place: u32) -> pixels__Pixel {
	let work = block__work_of(block, place);
	var pixel = pixels__Pixel(types__NONE, work.pixel, rng__pixel_key(batch.seed, work.pixel), film__Sum(vec4f(0.0), 0.0));
	if (work.inside) {
		pixel.film_index = work.film_index;
		pixel.sum = film__load_sum(work.film_index, batch.first_sample);
	}
	return pixel;
}

fn pixels__store_pixel(pixel: pixels__Pixel) {
	if (pixel.film_index != types__NONE) {
		film__store_sum(pixel.film_index, pixel.sum);
	}
}

fn pixels__pixel_ray(batch: dispatch__Batch, pixel: pixels__Pixel, sample: u32) -> tracing__Ray {
	var ray = ray_states__DEAD;
	if (pixel.film_index != types__NONE) {
		ray = dispatch__sample_ray(batch, pixel.position, pixel.key, sample);
	}
	return ray;
}

fn pixels__with_sample(before: pixels__Pixel, sample: u32, radiance: vec3f) -> pixels__Pixel {
	var pixel = before;
	if (pixel.film_index != types__NONE) {
		let weight = dispatch__sample_weight(pixel.key, sample);
		pixel.sum = film__add_sample(before.sum, film__Sample(radiance), weight);
		let is_kept = pixel.sum.radiance.w != before.sum.radiance.w;
		if (bindings__HAS_FEATURES && is_kept) {
			features__add_features(bindings__FILM_ROWS * pixel.film_index, sample, weight);
		}
		if (bindings__HAS_OPACITY && is_kept) {
			opacity__add_opacity(bindings__FILM_ROWS * pixel.film_index, weight, radiance);
		}
	}
	return pixel;
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

const path__MAX_PASSES: u32 = 64u;

struct path__Path {
	ray: tracing__Ray,
	radiance: vec3f,
	throughput: vec3f,
	media: vec4u,
	bounces: u32,
	passes: u32,
	kind: u32,
	origin: vec3f,
	normal: vec3f,
	pdf: f32,
	cone: tracing__Cone,
	key: u32,
	index: u32,
	channel: u32,
	lamp: shadow__Passage,
	lamp_light: vec3f,
	lamp_scatterings: u32,
	is_caught: bool
}

const path__ALL_CHANNELS: u32 = 3u;

fn path__camera_path(batch: dispatch__Batch, pixel: pixels__Pixel, sample: u32) -> path__Path {
	features__start_features();
	opacity__start_opacity();
	return path__path_along(batch, pixels__pixel_ray(batch, pixel, sample), pixel.position, sample);
}

fn path__path_along(batch: dispatch__Batch, ray: tracing__Ray, pixel: vec2u, sample: u32) -> path__Path {
	var key = rng__hash(batch.seed);
	var index = batch.shared_samples * sampling__z_order(pixel) + sample;
	if (batch.shared_samples == 0u) {
		key = rng__pixel_key(batch.seed, pixel);
		index = sample;
	}
	var cone = tracing__Cone(0.0, 0.0);
	if (bindings__HAS_FOOTPRINTS) {
		cone = footprint__camera_cone(batch, ray.direction);
	}
	let eye = ray.origin - dispatch__way_to_near(batch, ray.direction) * ray.direction;
	return path__Path(ray, vec3f(0.0), vec3f(1.0), section__camera_media(batch, ray), 0u, 0u, types__RAY_PRIMARY, eye, vec3f(0.0), 0.0, cone, key, index, path__ALL_CHANNELS, shadow__Passage(ray_states__DEAD, vec4u(types__NONE), vec3f(0.0), 0u), vec3f(0.0), 0u, false);
}

fn path__is_going(path: path__Path) -> bool {
	return path.ray.t_max >= 0.0 || path__is_to_lamp(path);
}

fn path__is_to_lamp(path: path__Path) -> bool {
	return path.lamp.ray.t_max >= 0.0;
}

fn path__next_walk(path: path__Path) -> traverse__Walk {
	var ray = path.ray;
	var any = false;
	var media = path.media;
	if (path__is_to_lamp(path)) {
		ray = path.lamp.ray;
		media = path.lamp.media;
		any = !(record__RECORDS || bindings__HAS_COVERAGE || (bindings__HAS_REFRACTION && bindings__FILTERED_SHADOWS));
	}
	return section_walk__walk_from(ray, any, media);
}

fn path__lit(before: path__Path, left: shadow__Passage) -> path__Path {
	var path = before;
	path.lamp = left;
	if (path__is_to_lamp(path)) {
		return path;
	}
	shadow__count_shadow(path.lamp.through);
	record_path__record_passage(path.lamp.through);
	return path__gained(path, path.lamp_light * path.lamp.through, path.lamp_scatterings);
}

fn path__gained(before: path__Path, light: vec3f, scatterings: u32) -> path__Path {
	var path = before;
	var gain = light;
	if (bindings__CLAMP_INDIRECT > 0.0) {
		let brightest = numeric__max_component(gain);
		let is_clamped = scatterings > 1u && brightest > bindings__CLAMP_INDIRECT;
		let scale = select(1.0, bindings__CLAMP_INDIRECT / brightest, is_clamped);
		dispatch__clamped_light += (1.0 - scale) * dot(gain, tone__LUMINANCE_REC709);
		gain *= scale;
		dispatch__kept_light += dot(gain, tone__LUMINANCE_REC709);
	}
	if (path__is_caught(path)) {
		record_path__record_gain(vec3f(0.0));
		let is_direct = scatterings == 1u && path.pdf > 0.0;
		let luminance = dot(gain, tone__LUMINANCE_REC709);
		opacity__clearness.light += select(0.0, luminance, is_direct);
		opacity__clearness.scattered += select(luminance, 0.0, is_direct);
		return path;
	}
	record_path__record_gain(gain);
	features__see_light(gain, scatterings);
	path.radiance += gain;
	return path;
}

fn path__is_caught(path: path__Path) -> bool {
	return bindings__HAS_CATCHERS && path.is_caught;
}

fn path__ended(path: path__Path) -> path__Path {
	var last = path;
	last.ray = ray_states__DEAD;
	return last;
}

fn path__passed(batch: dispatch__Batch, path: path__Path, surface: shading__Surface) -> path__Path {
	var next = path;
	next.ray = leaving__leaving_ray(surface, path.ray.direction, camera__T_FAR);
	if (path.bounces == 0u) {
		next.ray.t_max = dispatch__way_to_far(batch, next.ray.origin, next.ray.direction);
	}
	next.passes += 1u;
	next.kind = types__RAY_REFRACTION;
	return next;
}

fn path__random_1d(path: path__Path, purpose: u32) -> f32 {
	return sampling__stratified_1d(path.index, dimensions__dimension_key(path.key, path.bounces + path.passes, purpose));
}

fn path__random_2d(path: path__Path, purpose: u32) -> vec2f {
	return sampling__stratified_2d(path.index, dimensions__dimension_key(path.key, path.bounces + path.passes, purpose));
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

const shadow__MAX_CROSSINGS: u32 = 64u;

const shadow__NO_WIDTH: tracing__Cone = tracing__Cone(0.0, 0.0);

struct shadow__Passage {
	ray: tracing__Ray,
	media: vec4u,
	through: vec3f,
	crossings: u32
}

fn shadow__passage_of(ray: tracing__Ray, media: vec4u) -> shadow__Passage {
	record__open_shadow(ray.t_max);
	return shadow__Passage(ray, media, vec3f(1.0), 0u);
}

fn shadow__may_pass(hit: tracing__Hit) -> bool {
	return (bindings__HAS_COVERAGE || (bindings__HAS_REFRACTION && bindings__FILTERED_SHADOWS)) && hit.primitive != types__NONE;
}

fn shadow__arrived(before: shadow__Passage, hit: tracing__Hit) -> shadow__Passage {
	var passage = before;
	passage.ray = ray_states__DEAD;
	if (hit.primitive != types__NONE) {
		record__record_met(hit, before.ray.t_max);
		passage.through = vec3f(0.0);
	}
	else if (bindings__HAS_REFRACTION && bindings__FILTERED_SHADOWS) {
		passage.through *= medium__transmittance(medium__medium_of(medium__dominant(before.media)), hit.t);
	}
	return passage;
}

fn shadow__crossed(before: shadow__Passage, hit: tracing__Hit, contact: contact__Contact, coverage: f32) -> shadow__Passage {
	var passage = before;
	passage.ray = ray_states__DEAD;
	record__record_met(contact.hit, before.ray.t_max);
	let surface = contact.surface;
	var through = vec3f(0.0);
	if (bindings__HAS_REFRACTION && bindings__FILTERED_SHADOWS) {
		passage.media = contact__media_behind(before.media, contact);
		through = shadow__passing(before.ray, hit.t, surface, before.media, medium__dominant(passage.media));
	}
	passage.through *= mix(vec3f(1.0), through, coverage);
	passage.crossings += 1u;
	let rest = before.ray.t_max - hit.t;
	if (any(passage.through > vec3f(0.0)) && rest > 0.0) {
		if (passage.crossings < shadow__MAX_CROSSINGS) {
			passage.ray = shadow__rest_of(before.ray, hit.t, surface);
		}
		else {
			passage.through = vec3f(0.0);
		}
	}
	return passage;
}

fn shadow__rest_of(ray: tracing__Ray, distance: f32, surface: shading__Surface) -> tracing__Ray {
	let rest = ray.t_max - distance;
	var next = leaving__leaving_ray(surface, ray.direction, rest);
	let shift = next.origin - (ray.origin + distance * ray.direction);
	let way = ray.direction - shift / rest;
	let is_ahead = dot(way, ray.direction) > 0.0;
	next.direction = numeric__normalize_or(way, ray.direction);
	next.t_max = select(ray_states__DEAD.t_max, rest * length(way), is_ahead);
	return next;
}

fn shadow__count_shadow(through: vec3f) {
	if (bindings__COUNT_RAYS) {
		dispatch__counts.shadow += 1u;
		dispatch__counts.shadow_blocked += select(0u, 1u, all(through == vec3f(0.0)));
	}
}

fn shadow__passing(ray: tracing__Ray, distance: f32, surface: shading__Surface, around: vec4u, behind: u32) -> vec3f {
	let optics = material__load_optics(surface.material);
	let cos_i = min_f32(abs(dot(surface.n, ray.direction)), 1.0);
	if (bindings__SOLID_GLASS) {
		let layers = layers__layers_at(surface, optics);
		let is_window = (optics.flags & types__MATERIAL_THIN) != 0u && layers.boundary_alpha < bsdf_ggx__SMOOTH;
		let medium = medium__medium_of(behind);
		var share = 1.0;
		if ((layers.fresnel & types__MATERIAL_FRESNEL) != 0u) {
			share -= fresnel__boundary_at(layers.fresnel, cos_i, medium.ior / layers.ior).reflectance;
		}
		return select(vec3f(0.0), share * layers.transmit * medium__transmittance(medium, distance), is_window);
	}
	var here = medium__medium_before(around, surface.material, surface.outside);
	var ior_behind = medium__medium_of(behind).ior;
	if ((optics.flags & types__MATERIAL_THIN) != 0u) {
		here = behind;
		ior_behind = optics.ior;
	}
	var through = texture__texture_optics(surface)[1] * vertex_color__transmit_of(surface, optics) * medium__transmittance(medium__medium_of(here), distance);
	if ((optics.flags & types__MATERIAL_FRESNEL) != 0u) {
		let eta = medium__medium_of(here).ior / ior_behind;
		through *= 1.0 - fresnel__fresnel(cos_i, min_f32(eta, 1.0 / eta)).reflectance;
	}
	return through;
}

struct features__Features {
	albedo: vec3f,
	normal: vec3f,
	weight: f32,
	chance: f32,
	direct: vec3f,
	emission: vec3f,
	position: vec3f,
	depth: f32,
	uv: vec2f,
	material: u32,
	primitive: u32,
	instance: u32,
	is_followed: bool
}

const features__LEAST_WEIGHT: f32 = 1.0 / 1024.0;

var<private> features__features: features__Features;

var<private> features__off_centre: f32;

fn features__start_features() {
	if (bindings__HAS_FEATURES) {
		features__features = features__Features();
		features__features.weight = features__LEAST_WEIGHT;
		features__features.chance = 1.0;
		features__features.is_followed = true;
	}
}

fn features__see_first(surface: shading__Surface, hit: tracing__Hit, depth: f32) {
	if (bindings__HAS_FEATURES && features__features.material == 0u) {
		features__features.position = surface.p;
		features__features.depth = depth;
		features__features.uv = surface.uv;
		features__features.material = surface.material + 1u;
		features__features.primitive = hit.primitive;
		features__features.instance = hit.instance;
	}
}

fn features__see_albedo(albedo: vec3f, normal: vec3f) {
	features__see_through(albedo, normal);
	if (bindings__HAS_FEATURES && features__features.is_followed) {
		features__features.weight = 1.0;
		features__features.is_followed = false;
	}
}

fn features__see_through(albedo: vec3f, normal: vec3f) {
	if (bindings__HAS_FEATURES && features__features.is_followed) {
		features__features.albedo = clamp_vec3f(features__features.chance * albedo, vec3f(0.0), vec3f(1.0));
		features__features.normal = normal;
	}
}

fn features__follow_chain(stays: bool, chance: f32) {
	if (bindings__HAS_FEATURES) {
		features__features.chance *= chance;
		features__features.is_followed &= stays;
	}
}

fn features__see_light(light: vec3f, scatterings: u32) {
	if (bindings__HAS_FEATURES) {
		features__features.emission += select(vec3f(0.0), light, scatterings == 0u);
		features__features.direct += select(vec3f(0.0), light, scatterings == 1u);
	}
}

fn features__add_features(first_row: u32, sample: u32, weight: f32) {
	let row = first_row + bindings__FEATURES_ROW;
	let luminance = dot(features__features.albedo, tone__LUMINANCE_REC709);
	let albedo = bindings__film[row] + features__features.weight * weight * vec4f(features__features.albedo, 1.0);
	let normal = bindings__film[row + 1u] + features__features.weight * weight * vec4f(features__features.normal, luminance * luminance);
	if (numeric__is_finite(albedo.xyz) && numeric__is_finite(normal.xyz) && numeric__is_finite(normal.www)) {
		bindings__film[row] = albedo;
		bindings__film[row + 1u] = normal;
	}
	features__add_mean(row + 2u, features__features.direct, weight);
	features__add_mean(row + 3u, features__features.emission, weight);
	let nearness = 1.0 / (1.0 + features__off_centre);
	if (nearness > bindings__film[row + 4u].x) {
		let usable = numeric__is_finite(features__features.position) && numeric__is_finite(vec3f(features__features.uv, features__features.depth));
		bindings__film[row + 4u] = vec4f(nearness, f32(sample), f32(features__features.material), f32(features__features.instance));
		bindings__film[row + 5u] = select(vec4f(0.0), vec4f(features__features.position, features__features.depth), usable);
		bindings__film[row + 6u] = vec4f(select(vec2f(0.0), features__features.uv, usable), f32(features__features.primitive & 65535u), f32(features__features.primitive >> 16u));
	}
}

fn features__add_mean(row: u32, value: vec3f, weight: f32) {
	let next = bindings__film[row] + weight * vec4f(value, 1.0);
	if (numeric__is_finite(next.xyz)) {
		bindings__film[row] = next;
	}
}

const opacity__MOST_SCATTERED: f32 = 8.0;

struct opacity__Clearness {
	nothing: f32,
	catchers: f32,
	light: f32,
	scattered: f32,
	unshadowed: f32
}

var<private> opacity__clearness: opacity__Clearness;

fn opacity__start_opacity() {
	if (bindings__HAS_OPACITY) {
		opacity__clearness = opacity__Clearness();
	}
}

fn opacity__add_opacity(first_row: u32, weight: f32, radiance: vec3f) {
	let row = first_row + bindings__OPACITY_ROW;
	let nothing = opacity__clearness.nothing;
	let unshadowed = opacity__clearness.unshadowed;
	features__add_mean(row, vec3f(nothing, opacity__clearness.catchers, 0.0), weight);
	let catchers = bindings__film[row].y;
	let usual = max_f32((bindings__film[row + 1u].y + weight * unshadowed) / select(catchers, 1e-30, catchers == 0.0), 0.0);
	let most = opacity__MOST_SCATTERED * usual * opacity__clearness.catchers;
	let scattered = select(min_f32(opacity__clearness.scattered, most), opacity__clearness.scattered, usual == 0.0);
	let light = opacity__clearness.light + scattered;
	features__add_mean(row + 1u, vec3f(light, unshadowed, opacity__clearness.scattered - scattered), weight);
	if (bindings__ADAPTIVE) {
		let luminance = dot(radiance, tone__LUMINANCE_REC709);
		let seen = opacity__clearness.catchers;
		let squares = vec3f(nothing * (nothing + 2.0 * luminance), seen * (luminance + nothing), seen * seen);
		features__add_mean(row + 2u, vec3f(light * light, light * unshadowed, unshadowed * unshadowed), weight);
		features__add_mean(row + 3u, squares, weight);
	}
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

fn sampling__z_order(pixel: vec2u) -> u32 {
	var bits = pixel & vec2u(65535u);
	bits = (bits | (bits << vec2u(8u))) & vec2u(16711935u);
	bits = (bits | (bits << vec2u(4u))) & vec2u(252645135u);
	bits = (bits | (bits << vec2u(2u))) & vec2u(858993459u);
	bits = (bits | (bits << vec2u(1u))) & vec2u(1431655765u);
	return bits.x | (bits.y << 1u);
}

fn sampling__stratified_1d(index: u32, key: u32) -> f32 {
	let own = key ^ 1757159915u;
	return rng__unit_float(sampling__owen_scramble(reverseBits(sampling__owen_scramble(index, rng__hash(own))), rng__hash(own ^ 48610963u)));
}

fn sampling__scrambled(point: vec2u, key: u32) -> vec2f {
	return vec2f(rng__unit_float(sampling__owen_scramble(point.x, rng__hash(key ^ 2769414579u))), rng__unit_float(sampling__owen_scramble(point.y, rng__hash(key ^ 1675113877u))));
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

var<private> shutter__shutter_time: f32;

fn shutter__shutter_camera(still: types__PackedCamera) -> types__PackedCamera {
	if (bindings__CAMERA_MOTION) {
		let moment = motion__moment_of(shutter__shutter_time, bindings__frame.camera_key_count);
		return motion__camera_between(fetch__load_camera(moment.key), fetch__load_camera(moment.key + 1u), moment.fraction);
	}
	return still;
}

fn shutter__shutter_light(index: u32, light_count: u32) -> types__PackedLight {
	var light: types__PackedLight;
	if (bindings__LIGHT_MOTION) {
		let moment = motion__moment_of(shutter__shutter_time, bindings__frame.light_key_count);
		let place = moment.key * light_count + index;
		light = motion__light_between(fetch__load_light(place), fetch__load_light(place + light_count), moment.fraction);
	}
	else {
		light = fetch__load_light(index);
	}
	if (bindings__LIGHT_KIND != types__MIXED_LIGHTS) {
		light.kind = bindings__LIGHT_KIND;
	}
	if (bindings__LIGHT_ATTENUATION != types__MIXED_LIGHTS) {
		light.attenuation = bindings__LIGHT_ATTENUATION;
	}
	return light;
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

fn motion__light_between(a: types__PackedLight, b: types__PackedLight, fraction: f32) -> types__PackedLight {
	return types__PackedLight(mix(a.position, b.position, vec3f(fraction)), a.kind, numeric__normalize_or(mix(a.direction, b.direction, vec3f(fraction)), a.direction), a.attenuation, mix(a.color, b.color, vec3f(fraction)), mix(a.cos_inner, b.cos_inner, fraction), mix(a.edge_u, b.edge_u, vec3f(fraction)), mix(a.cos_outer, b.cos_outer, fraction), mix(a.edge_v, b.edge_v, vec3f(fraction)), mix(a.radius, b.radius, fraction), a.sample_count, a.chance, a.place, a.visible);
}

@group(0) @binding(0)
var<storage, read> rows__nodes: array<vec4u>;

@group(0) @binding(1)
var<storage, read> rows__triangles: array<vec4u>;

@group(0) @binding(2)
var<storage, read> rows__vertices: array<vec4u>;

@group(0) @binding(3)
var<storage, read> rows__materials: array<vec4u>;

@group(0) @binding(4)
var rows__texels: texture_2d_array<u32>;

fn rows__node_row(row: u32) -> vec4u {
	return rows__nodes[row];
}

fn rows__triangle_row(row: u32) -> vec4u {
	return rows__triangles[row];
}

fn rows__vertex_row(row: u32) -> vec4u {
	return rows__vertices[row];
}

fn rows__material_row(row: u32) -> vec4u {
	return rows__materials[row];
}

fn rows__texel_word(place: vec2u, layer: u32) -> u32 {
	return textureLoad(rows__texels, place, layer, 0).x;
}

const section__CAP: f32 = -1.0;

fn section__is_cut(p: vec3f) -> bool {
	return bindings__HAS_SECTION && dot(bindings__frame.section, p) > bindings__frame.section_offset;
}

fn section__uncut(p: vec3f, arriving: shading__Incident) -> shading__Incident {
	var kept = arriving;
	if (section__is_cut(p + arriving.distance * arriving.direction)) {
		kept.radiance = vec3f(0.0);
	}
	return kept;
}

fn section__camera_media(batch: dispatch__Batch, ray: tracing__Ray) -> vec4u {
	return select(batch.camera_media, vec4u(types__NONE), vec4<bool>(section__is_cut(ray.origin)));
}

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

const ray_states__DEAD: tracing__Ray = tracing__Ray(vec3f(0.0), -1.0, vec3f(0.0, 0.0, 1.0), types__NONE, types__NO_INSTANCE);

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

fn warp__cone_from_square(u: vec2f, depth: f32) -> vec3f {
	let p = warp__disc_from_square(u);
	let below = min_f32(dot(p, p), 1.0) * depth;
	return vec3f(p * sqrt(max_f32(depth * (2.0 - below), 0.0)), 1.0 - below);
}

fn warp__turn_to(n: vec3f, direction: vec3f) -> vec3f {
	let side = select(-1.0, 1.0, n.z >= 0.0);
	let a = -1.0 / (side + n.z);
	let b = n.x * n.y * a;
	let x = vec3f(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
	let y = vec3f(b, side + n.y * n.y * a, -n.y);
	return direction.x * x + direction.y * y + direction.z * n;
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

const record__RECORDS: bool = false;

fn record__record_surface(surface: shading__Surface, hit: tracing__Hit, arriving: vec3f) {

}

fn record__open_shadow(t_max: f32) {

}

fn record__record_met(hit: tracing__Hit, rest: f32) {

}

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

fn numeric__is_finite(v: vec3f) -> bool {
	let exponents = bitcast<vec3u>(v) & vec3u(2139095040u);
	return all(exponents != vec3u(2139095040u));
}

fn numeric__is_within(v: vec3f, limit: u32) -> bool {
	return all((bitcast<vec3u>(v) & vec3u(2147483647u)) <= vec3u(limit));
}

fn numeric__max_component(v: vec3f) -> f32 {
	return max_f32(v.x, max_f32(v.y, v.z));
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

var<private> loops__nodes_visited: u32;

var<private> loops__primitives_tested: u32;

var<private> loops__cut_off: bool;

var<private> loops__is_stack_full: bool;

var<private> loops__nonfinite_samples: u32;

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

const steps__WALK_ROUNDS: u32 = traverse__NO_LIMIT;

fn steps__load_node(index: u32, inv: vec3f) -> tracing__Node {
	let row = types__FLOAT_NODE_ROWS * index;
	let near = select(vec3u(0u), vec3u(1u), inv < vec3f(0.0));
	let far = vec3u(1u) - near;
	return node__float_node(rows__node_row(row + near.x), rows__node_row(row + far.x), rows__node_row(row + 2u + near.y), rows__node_row(row + 2u + far.y), rows__node_row(row + 4u + near.z), rows__node_row(row + 4u + far.z));
}

fn steps__through_nodes(before: traverse__Walk) -> traverse__Walk {
	var walk = before;
	loop {
		let node = traverse__load_current_node(walk.current, walk.at);
		let children = rows__node_row(types__FLOAT_NODE_ROWS * (walk.current & ~types__MOVING) + 6u);
		let limit = traverse__search_limit(walk.ray, walk.hit);
		let keys = node__sort4(node__float_child_keys(node, walk.at.ray.origin, walk.at.inv, limit));
		if (bindings__COUNT_STEPS) {
			loops__nodes_visited += 1u;
		}
		if (keys.x < node__MISS) {
			steps__push_farther(children, keys);
			walk.current = node__child_of(children, keys.x);
		}
		else {
			walk.current = stack__popped();
		}
		continuing {
		
			break if (walk.current & types__LEAF) != 0u;
		}
	}
	return walk;
}

fn steps__push_farther(children: vec4u, keys: vec4u) {
	if (keys.y < node__MISS) {
		if (keys.z < node__MISS) {
			if (keys.w < node__MISS) {
				stack__push(node__child_of(children, keys.w));
			}
			stack__push(node__child_of(children, keys.z));
		}
		stack__push(node__child_of(children, keys.y));
	}
}

fn steps__through_leaves(before: traverse__Walk) -> traverse__Walk {
	var walk = before;
	loop {
		walk.hit = primitive__closer(walk.at, walk.hit, walk.current & (types__SHAPE | types__LEAF_FIRST_MASK));
		if (bindings__COUNT_STEPS) {
			loops__primitives_tested += 1u;
		}
		if (walk.any && walk.hit.primitive != types__NONE) {
			walk.current = traverse__EMPTY;
		}
		else if ((walk.current & types__LEAF_COUNT_MASK) == 0u) {
			walk.current = stack__popped();
		}
		else {
			walk.current += 1u - types__LEAF_COUNT_ONE;
		}
		continuing {
		
			break if ((walk.current & types__LEAF) == 0u) | (walk.current >= types__INSTANCE);
		}
	}
	return walk;
}

const node__MISS: u32 = 4294967292u;

const node__WIDENING: i32 = 8;

fn node__float_node(near_x: vec4u, far_x: vec4u, near_y: vec4u, far_y: vec4u, near_z: vec4u, far_z: vec4u) -> tracing__Node {
	return tracing__Node(vec3f(0.0), vec3f(1.0), bitcast<vec4f>(near_x), bitcast<vec4f>(far_x), bitcast<vec4f>(near_y), bitcast<vec4f>(far_y), bitcast<vec4f>(near_z), bitcast<vec4f>(far_z), 4u);
}

fn node__node_between(a: tracing__Node, b: tracing__Node, fraction: f32) -> tracing__Node {
	let shift = b.lo - a.lo;
	let s = vec4f(fraction);
	return tracing__Node(a.lo, vec3f(1.0), mix(a.scale.x * a.near_x, b.scale.x * b.near_x + shift.x, s), mix(a.scale.x * a.far_x, b.scale.x * b.far_x + shift.x, s), mix(a.scale.y * a.near_y, b.scale.y * b.near_y + shift.y, s), mix(a.scale.y * a.far_y, b.scale.y * b.far_y + shift.y, s), mix(a.scale.z * a.near_z, b.scale.z * b.near_z + shift.z, s), mix(a.scale.z * a.far_z, b.scale.z * b.far_z + shift.z, s), a.child_count);
}

fn node__float_child_keys(node: tracing__Node, origin: vec3f, inv: vec3f, t_max: f32) -> vec4u {
	let base = -origin * inv;
	let slack = abs(base) * vec3f(1.0 / 4194304.0);
	let early = base - slack;
	let late = base + slack;
	let x0 = bitcast<vec4i>(node.near_x * inv.x + early.x);
	let x1 = bitcast<vec4i>(node.far_x * inv.x + late.x);
	let y0 = bitcast<vec4i>(node.near_y * inv.y + early.y);
	let y1 = bitcast<vec4i>(node.far_y * inv.y + late.y);
	let z0 = bitcast<vec4i>(node.near_z * inv.z + early.z);
	let z1 = bitcast<vec4i>(node.far_z * inv.z + late.z);
	return node__keys_of(max(max(x0, y0), z0), min(min(x1, y1), z1), t_max, vec4<bool>(true));
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

fn offset__clearance(p: vec3f, error: vec3f, ng: vec3f) -> f32 {
	return dot(abs(ng), error + 2.0 * numeric__ROUNDING * abs(p));
}

fn offset__offset_origin(p: vec3f, error: vec3f, ng: vec3f, direction: vec3f) -> vec3f {
	return offset__fixed_origin(p, ng, direction, offset__clearance(p, error, ng));
}

fn offset__fixed_origin(p: vec3f, ng: vec3f, direction: vec3f, distance: f32) -> vec3f {
	return p + select(-distance, distance, dot(ng, direction) > 0.0) * ng;
}

fn record_path__record_ray(path: path__Path, hit: tracing__Hit) {

}

fn record_path__record_gain(light: vec3f) {

}

fn record_path__record_light_density(pdf: f32) {

}

fn record_path__record_found(radiance: vec3f, weight: f32, pdf: f32) {

}

fn record_path__record_source(source: u32, index: u32, chance: f32) {

}

fn record_path__record_light_sample(surface: shading__Surface, ray: tracing__Ray, light: emitters__LightSample, found: bsdf__BsdfValue, weight: f32, unshadowed: vec3f) {

}

fn record_path__record_passage(through: vec3f) {

}

fn record_path__record_boundary(met_here: interface__Interface, bsdf: lobes__Bsdf) {

}

fn record_path__record_lobe(lobe: u32) {

}

fn record_path__record_step(next: bsdf__BsdfSample) {

}

fn record_path__record_passing() {

}

fn record_path__record_limit() {

}

fn record_path__record_roulette(throughput: vec3f, chance: f32, ends: bool) {

}

fn record_path__record_straight(is_straight: bool) {

}

const tone__LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);

const medium__VACUUM: shading__Medium = shading__Medium(vec3f(0.0), 1.0, 0);

fn medium__dominant(media: vec4u) -> u32 {
	if (!bindings__HAS_CONTACT) {
		return media.x;
	}
	if (!bindings__HAS_PRIORITIES) {
		let last = select(media.xz, media.yw, media.yw != vec2u(types__NONE));
		return select(last.x, last.y, last.y != types__NONE);
	}
	var best = media.x;
	best = medium__higher(best, media.y);
	best = medium__higher(best, media.z);
	return medium__higher(best, media.w);
}

fn medium__higher(best: u32, next: u32) -> u32 {
	if (next == types__NONE) {
		return best;
	}
	return select(best, next, material__load_medium(next).priority >= material__load_medium(best).priority);
}

fn medium__medium_of(material: u32) -> shading__Medium {
	if (material == types__NONE) {
		return medium__VACUUM;
	}
	return material__load_medium(material);
}

fn medium__transmittance(medium: shading__Medium, distance: f32) -> vec3f {
	return exp(-min_vec3f(medium.absorption * min_f32(distance, 1000000000000.0), vec3f(80.0)));
}

fn medium__cross_surface(media: vec4u, material: u32, entering: bool) -> vec4u {
	return select(media__left(media, material), media__entered(media, material), vec4<bool>(entering));
}

fn medium__medium_before(media: vec4u, material: u32, entering: bool) -> u32 {
	let started_inside = !entering & !media__contains(media, material);
	return select(medium__dominant(media), material, started_inside);
}

struct shading__Phong {
	diffuse: vec3f,
	specular: vec3f,
	shininess: f32,
	ambient: vec3f,
	reflect: vec3f
}

struct shading__Medium {
	absorption: vec3f,
	ior: f32,
	priority: i32
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

struct shading__Optics {
	transmit: vec3f,
	opacity: f32,
	ior: f32,
	flags: u32
}

struct shading__Incident {
	direction: vec3f,
	distance: f32,
	radiance: vec3f
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

fn material__load_optics(index: u32) -> shading__Optics {
	let row = types__MATERIAL_ROWS * index;
	let r1 = rows__material_row(row + 1u);
	let r2 = rows__material_row(row + 2u);
	let r3 = rows__material_row(row + 3u);
	let r4 = rows__material_row(row + 4u);
	return shading__Optics(bitcast<vec3f>(r4.xyz), bitcast<f32>(r2.w), bitcast<f32>(r3.w), r1.w);
}

fn material__load_flags(index: u32) -> u32 {
	return rows__material_row(types__MATERIAL_ROWS * index + 1u).w;
}

fn material__load_medium(index: u32) -> shading__Medium {
	let row = types__MATERIAL_ROWS * index;
	let r5 = rows__material_row(row + 5u);
	return shading__Medium(bitcast<vec3f>(r5.xyz), bitcast<f32>(rows__material_row(row + 3u).w), bitcast<i32>(rows__material_row(row + 4u).w));
}

fn material__load_emission(index: u32) -> vec3f {
	return bitcast<vec3f>(rows__material_row(types__MATERIAL_ROWS * index + 6u).xyz);
}

fn material__load_texture_indices(index: u32) -> vec4u {
	return rows__material_row(types__MATERIAL_ROWS * index + 7u);
}

struct material__CoverageMaterial {
	alpha: f32,
	flags: u32
}

fn material__load_coverage(index: u32) -> material__CoverageMaterial {
	let row = types__MATERIAL_ROWS * index;
	return material__CoverageMaterial(bitcast<f32>(rows__material_row(row + 5u).w), rows__material_row(row + 1u).w);
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

struct material__Glow {
	light: u32,
	luminance: f32,
	texture: u32
}

fn material__load_glow(index: u32) -> material__Glow {
	let row = types__MATERIAL_ROWS * index;
	let own = rows__material_row(row + types__LAYERS_ROW + 7u);
	let luminance = bitcast<f32>(own.y) * dot(material__load_emission(index), tone__LUMINANCE_REC709);
	return material__Glow(own.x, luminance, rows__material_row(row + types__LAYERS_ROW + 9u).w >> 16u);
}

fn material__must_flip(flags: u32, n_dot_ng: f32, ng_dot_direction: f32) -> bool {
	let faces_away = (n_dot_ng > 0.0) == (ng_dot_direction > 0.0);
	return (flags & types__MATERIAL_TWO_SIDED) != 0u && faces_away;
}

const path_vertex__ROULETTE_START: u32 = 3u;

fn path_vertex__traced(batch: dispatch__Batch, before: path__Path, hit: tracing__Hit) -> path__Path {
	var path = before;
	let is_shadow = path__is_to_lamp(path) && shadow__may_pass(hit);
	if (!is_shadow) {
		dispatch__count_hit(path.kind, hit);
		record_path__record_ray(path, hit);
	}
	if (!is_shadow && hit.primitive == types__NONE) {
		return backdrop__missed(batch, path);
	}
	var ray = path.ray;
	var cone = path.cone;
	if (is_shadow) {
		ray = path.lamp.ray;
		cone = shadow__NO_WIDTH;
	}
	let contact = contact__contact_at(ray, hit, cone);
	let coverage = coverage__coverage_at(contact.surface);
	if (is_shadow) {
		return path__lit(path, shadow__crossed(path.lamp, hit, contact, coverage));
	}
	let surface = contact.surface;
	let optics = material__load_optics(surface.material);
	var met = interface__interface_at(path.media, contact, optics);
	path.cone = ray_cone__cone_at(path.cone, hit.t);
	if (bindings__HAS_REFRACTION) {
		path.throughput *= medium__transmittance(medium__medium_of(met.here), hit.t);
	}
	record__record_surface(surface, contact.hit, path.throughput);
	if (bindings__HAS_COVERAGE && path.passes < path__MAX_PASSES && path__random_1d(path, dimensions__COVERAGE_CHOICE) >= coverage) {
		record_path__record_passing();
		return path__passed(batch, path, surface);
	}
	features__see_first(surface, hit, distance(path.origin, surface.p));
	if (bindings__HAS_CATCHERS && backdrop__is_seen(path) && (optics.flags & types__MATERIAL_SHADOW_CATCHER) != 0u) {
		features__see_albedo(vec3f(1.0), surface.n);
		return shadow_catcher__caught(batch, path, surface);
	}
	if (bindings__HAS_DISPERSION) {
		path = dispersion__colored(path, met);
		met = dispersion__dispersed(met, path.channel);
	}
	let layers = layers__layers_at(surface, optics);
	let start = light_weight__Sender(path.origin, path.normal, shadow_catcher__density_for_lamps(path));
	let weight = light_weight__emission_weight(batch, surface, contact.hit, start, ray.direction);
	let coat = coating__through_coat(surface, abs(dot(ray.direction, surface.ng)));
	let emission = coat * emitters__emitted(surface, optics, layers.glow);
	record_path__record_found(emission, weight, start.pdf);
	let found = path.throughput * (weight * emission);
	shadow_catcher__count_unsampled(path, found);
	path = path__gained(path, found, path.bounces);
	let bsdf = lobes__bsdf_at(surface, optics, layers, met, ray.direction);
	seen__see_surface(path, bsdf, emission);
	record_path__record_boundary(met, bsdf);
	if ((bindings__HAS_LIGHTS || bindings__HAS_EMITTERS || bindings__HAS_ENVIRONMENT) && path.bounces <= batch.max_depth) {
		path = toward_lamp__toward_lamp(batch, path, surface, bsdf, met);
	}
	return path_vertex__scattered(batch, path, surface, bsdf, met);
}

fn path_vertex__scattered(batch: dispatch__Batch, before: path__Path, surface: shading__Surface, bsdf: lobes__Bsdf, met: interface__Interface) -> path__Path {
	var path = before;
	let next = bsdf__bsdf_sample(bsdf, path__random_1d(path, dimensions__SCATTER_CHOICE), path__random_2d(path, dimensions__SCATTER_DIRECTION));
	path.throughput *= next.weight;
	record_path__record_step(next);
	if (path.bounces > batch.max_depth || path.passes > path__MAX_PASSES) {
		dispatch__cut_throughput += select(dot(path.throughput, tone__LUMINANCE_REC709), 0.0, path__is_caught(path));
		record_path__record_limit();
		return path__ended(path);
	}
	let chance = select(1.0, mis__survival_chance(path.throughput), path.bounces >= path_vertex__ROULETTE_START);
	let ends = path__random_1d(path, dimensions__ROULETTE) >= chance || all(path.throughput <= vec3f(0.0));
	record_path__record_roulette(path.throughput, chance, ends);
	if (ends) {
		return path__ended(path);
	}
	path.throughput /= chance;
	seen__see_scattered(bsdf, next.pdf, chance);
	let crosses = dot(next.direction, bsdf.ng) < 0.0;
	let is_straight = crosses && next.pdf == 0.0 && !(bindings__SOLID_GLASS && bsdf.encloses);
	record_path__record_straight(crosses && next.pdf == 0.0 && !bsdf.boundary.bends);
	path.kind = select(types__RAY_REFLECTION, types__RAY_REFRACTION, crosses);
	path.media = select(path.media, met.media, vec4<bool>(crosses));
	path.ray = leaving__leaving_ray(surface, next.direction, camera__T_FAR);
	path.origin = select(surface.p, path.origin, is_straight);
	path.normal = select(bsdf__receiving_normal(bsdf), path.normal, is_straight);
	path.pdf = select(next.pdf, path.pdf, is_straight);
	if (crosses && next.pdf == 0.0) {
		path.passes += 1u;
	}
	else {
		path.bounces += 1u;
	}
	return path;
}

fn backdrop__is_seen(path: path__Path) -> bool {
	return path.bounces == 0u;
}

fn backdrop__radiance_behind(batch: dispatch__Batch, path: path__Path) -> vec3f {
	if (bindings__BACKDROP == types__BACKDROP_BACKGROUND || !backdrop__is_seen(path)) {
		return background__background(batch, path.ray.direction);
	}
	if (bindings__BACKDROP == types__BACKDROP_TRANSPARENT) {
		opacity__clearness.nothing += dot(path.throughput, tone__LUMINANCE_REC709);
		return vec3f(0.0);
	}
	return batch.backdrop;
}

fn backdrop__missed(batch: dispatch__Batch, path: path__Path) -> path__Path {
	let weight = environment__background_weight(batch, path.ray.direction, path.pdf);
	let seen = backdrop__radiance_behind(batch, path);
	record_path__record_found(seen, weight, path.pdf);
	features__see_albedo(path.throughput * seen, vec3f(0.0));
	return path__ended(path__gained(path, path.throughput * (weight * seen), path.bounces));
}

const environment__SUN_DENSITY: f32 = 1.0 / (2.0 * picture__PI * background__SUN_DEPTH);

struct environment__EnvironmentSample {
	direction: vec3f,
	pdf: f32
}

fn environment__sample_environment(batch: dispatch__Batch, u: vec2f) -> environment__EnvironmentSample {
	let width = batch.environment_width;
	var v = u;
	let is_sun = bindings__BACKGROUND == types__BACKGROUND_SKY && u.x < batch.sun_chance;
	if (bindings__BACKGROUND == types__BACKGROUND_SKY) {
		let part = select(1.0 - batch.sun_chance, batch.sun_chance, is_sun);
		v.x = min_f32((u.x - select(batch.sun_chance, 0.0, is_sun)) / part, 0.99999994);
	}
	var place = quad_warp__quad_root(picture__load_texel_word(batch.environment_first), v);
	var first = batch.environment_first + 1u;
	var columns = 2u;
	loop {
		place = quad_warp__quad_step(picture__load_texel_word(first + place.cell.y * columns + place.cell.x), place);
		first += columns * columns / 2u;
		columns *= 2u;
		continuing {
		
			break if columns >= width;
		}
	}
	loops__cut_off |= columns < width;
	let uv = (vec2f(place.cell) + place.u) / vec2f(f32(width), f32(width / 2u));
	let direction = picture__equirectangular_direction(uv, batch.background_rotation);
	let pdf = environment__with_sun(batch, environment__density_at(batch, place.cell, direction), direction);
	if (bindings__BACKGROUND == types__BACKGROUND_SKY) {
		let to_sun = warp__turn_to(batch.sun, warp__cone_from_square(v, background__SUN_DEPTH));
		let of_sun = max_f32(environment__environment_pdf(batch, to_sun), batch.sun_chance * environment__SUN_DENSITY);
		return environment__EnvironmentSample(select(direction, to_sun, is_sun), select(pdf, of_sun, is_sun));
	}
	return environment__EnvironmentSample(direction, pdf);
}

fn environment__environment_pdf(batch: dispatch__Batch, direction: vec3f) -> f32 {
	let size = vec2u(batch.environment_width, batch.environment_width / 2u);
	let uv = picture__equirectangular(direction, batch.background_rotation);
	let place = vec2f(fract(uv.x), clamp_f32(uv.y, 0.0, 1.0)) * vec2f(size);
	return environment__with_sun(batch, environment__density_at(batch, min(vec2u(place), size - 1u), direction), direction);
}

fn environment__with_sun(batch: dispatch__Batch, of_table: f32, direction: vec3f) -> f32 {
	if (bindings__BACKGROUND == types__BACKGROUND_SKY) {
		let of_sun = select(0.0, environment__SUN_DENSITY, background__is_in_sun(batch, direction));
		return mix(of_table, of_sun, batch.sun_chance);
	}
	return of_table;
}

fn environment__background_weight(batch: dispatch__Batch, direction: vec3f, pdf: f32) -> f32 {
	if (!bindings__HAS_ENVIRONMENT || pdf <= 0.0) {
		return 1.0;
	}
	let density = batch.environment_share * environment__environment_pdf(batch, direction);
	record_path__record_light_density(density);
	return mis__power_heuristic(pdf, density);
}

fn environment__density_at(batch: dispatch__Batch, cell: vec2u, direction: vec3f) -> f32 {
	let height = batch.environment_width / 2u;
	let first = batch.environment_first + 1u + 2u * ((height * height - 1u) / 3u);
	let density = bitcast<f32>(picture__load_texel_word(first + cell.y * batch.environment_width + cell.x));
	return density / (2.0 * picture__PI * picture__PI * max_f32(length(direction.xz), 1e-6));
}

const picture__PI: f32 = 3.14159265;

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

fn picture__equirectangular(direction: vec3f, rotation: f32) -> vec2f {
	let level = length(direction.xz);
	let around = atan2(direction.x, select(-direction.z, 1.0, level < 1e-12));
	return vec2f(0.5 + (around + rotation) / (2.0 * picture__PI), 0.5 + atan2(direction.y, level) / picture__PI);
}

fn picture__equirectangular_direction(uv: vec2f, rotation: f32) -> vec3f {
	let around = (uv.x - 0.5) * 2.0 * picture__PI - rotation;
	let up = (uv.y - 0.5) * picture__PI;
	return vec3f(cos(up) * sin(around), sin(up), -cos(up) * cos(around));
}

const background__SUN_DEPTH: f32 = 1.069586e-5;

fn background__background(batch: dispatch__Batch, direction: vec3f) -> vec3f {
	if (bindings__BACKGROUND == types__BACKGROUND_GRADIENT) {
		return mix(batch.background, batch.background_top, 0.5 + 0.5 * direction.y);
	}
	if (bindings__BACKGROUND == types__BACKGROUND_PICTURE || bindings__BACKGROUND == types__BACKGROUND_SKY) {
		let size = batch.background_size;
		let uv = picture__equirectangular(direction, batch.background_rotation);
		let color = picture__blend_texels(batch.background_picture, size.x, size.y, picture__neighbours(uv.x, size.x, false, types__WRAP_REPEAT), picture__neighbours(uv.y, size.y, false, types__WRAP_CLAMP));
		let of_sun = select(vec3f(0.0), batch.background_top, background__is_in_sun(batch, direction));
		return batch.background * color.xyz + of_sun;
	}
	return batch.background;
}

fn background__is_in_sun(batch: dispatch__Batch, direction: vec3f) -> bool {
	let apart = direction - batch.sun;
	return bindings__BACKGROUND == types__BACKGROUND_SKY && dot(apart, apart) < 2.0 * background__SUN_DEPTH;
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

fn mis__power_heuristic(own: f32, other: f32) -> f32 {
	let ratio = other / max_f32(own, 1e-30);
	return select(0.0, 1.0 / (1.0 + min_f32(ratio * ratio, 1e30)), own > 0.0);
}

fn mis__survival_chance(throughput: vec3f) -> f32 {
	return min_f32(max_f32(throughput.x, max_f32(throughput.y, throughput.z)), 1.0);
}

const contact__NEAR: f32 = 1e-5;

const contact__EDGE: f32 = 1e-6;

const contact__VAGUE_EDGE: f32 = 0.0001;

struct contact__Contact {
	surface: shading__Surface,
	hit: tracing__Hit,
	touching: u32,
	enters_touching: bool
}

fn contact__contact_at(ray: tracing__Ray, hit: tracing__Hit, cone: tracing__Cone) -> contact__Contact {
	var contact: contact__Contact;
	contact.hit = hit;
	contact.touching = types__NONE;
	var current = hit;
	var first = true;
	var second_wanted = false;
	var vertices = vec3u(0u);
	loop {
		let surface = surface__surface_at(ray, current, cone);
		if (first) {
			contact.surface = surface;
			vertices = triangle_surface__met_vertices;
			second_wanted = bindings__HAS_REFRACTION && bindings__HAS_CONTACT && contact__is_near(ray, hit, surface);
		}
		else {
			contact = contact__merge(contact, surface, contact__is_same_volume(hit, primitive__runner_up, vertices));
			second_wanted = false;
		}
		first = false;
		current = primitive__runner_up;
		continuing {
		
			break if !second_wanted;
		}
	}
	loops__cut_off |= second_wanted;
	return contact;
}

fn contact__media_behind(media: vec4u, contact: contact__Contact) -> vec4u {
	var behind = media;
	if (!contact__is_thin(contact.surface)) {
		if (contact.surface.outside && !media__has_room(behind)) {
			ray_stack__cut_tree();
		}
		behind = medium__cross_surface(behind, contact.surface.material, contact.surface.outside);
	}
	if (bindings__HAS_CONTACT && contact.touching != types__NONE) {
		if (contact.enters_touching && !media__has_room(behind)) {
			ray_stack__cut_tree();
		}
		behind = medium__cross_surface(behind, contact.touching, contact.enters_touching);
	}
	return behind;
}

fn contact__is_near(ray: tracing__Ray, hit: tracing__Hit, surface: shading__Surface) -> bool {
	let gap = (primitive__runner_up.t - hit.t) * abs(dot(surface.ng, ray.direction));
	let reach = numeric__max_component(abs(surface.p)) + hit.t;
	return primitive__runner_up.primitive != types__NONE && gap <= contact__NEAR * reach && contact__is_transparent(surface);
}

fn contact__is_transparent(surface: shading__Surface) -> bool {
	return any(material__load_optics(surface.material).transmit > vec3f(0.0));
}

fn contact__is_thin(surface: shading__Surface) -> bool {
	return (material__load_optics(surface.material).flags & types__MATERIAL_THIN) != 0u;
}

fn contact__merge(contact: contact__Contact, second: shading__Surface, is_same_volume: bool) -> contact__Contact {
	let is_alike = (second.material == contact.surface.material) & (second.outside == contact.surface.outside);
	let is_other = !(is_alike & is_same_volume);
	let together = is_other & (abs(dot(contact.surface.ng, second.ng)) > 0.99);
	var both = contact;
	if (together && contact__is_transparent(second)) {
		if (!contact__is_thin(second)) {
			both.touching = second.material;
			both.enters_touching = second.outside;
		}
	}
	else if (together) {
		both.surface = second;
		both.hit = primitive__runner_up;
	}
	return both;
}

fn contact__is_same_volume(first: tracing__Hit, second: tracing__Hit, vertices: vec3u) -> bool {
	let are_triangles = bindings__HAS_TRIANGLES && ((first.primitive | second.primitive) & types__SHAPE) == 0u;
	if (!are_triangles || first.instance != second.instance) {
		return false;
	}
	return (contact__is_at_edge(first) && contact__is_at_edge(second)) || contact__is_twin(vertices, triangle_surface__met_vertices);
}

fn contact__is_at_edge(hit: tracing__Hit) -> bool {
	let nearest = min_f32(min_f32(hit.b1, hit.b2), 1.0 - hit.b1 - hit.b2);
	return nearest <= select(contact__VAGUE_EDGE, contact__EDGE, bindings__TRIANGLE_TEST == types__TRIANGLE_TEST_WATERTIGHT);
}

fn contact__is_twin(first: vec3u, second: vec3u) -> bool {
	return any(second == first.xxx) & any(second == first.yyy) & any(second == first.zzz);
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

fn vertex_color__transmit_of(surface: shading__Surface, optics: shading__Optics) -> vec3f {
	if (bindings__HAS_COLORS && (optics.flags & types__MATERIAL_COLORED_GLASS) != 0u) {
		return saturate_vec3f(surface.color.xyz * optics.transmit);
	}
	return optics.transmit;
}

fn vertex_color__emission_of(surface: shading__Surface) -> vec3f {
	var emission = material__load_emission(surface.material);
	if (bindings__HAS_COLORS && (material__load_flags(surface.material) & types__MATERIAL_COLORED_EMISSION) != 0u) {
		emission *= surface.color.xyz;
	}
	return emission;
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

fn texture__texture_optics(surface: shading__Surface) -> mat3x3f {
	if (!(bindings__HAS_TEXTURES && bindings__HAS_OPTICS_TEXTURES)) {
		return mat3x3f(vec3f(1.0), vec3f(1.0), vec3f(1.0));
	}
	let indices = material__load_texture_indices(surface.material);
	var factors = texture__texture_factors(vec3u(indices.y & 65535u, indices.y >> 16u, indices.z >> 16u), surface);
	if (bindings__HAS_SECTION && surface.is_cap) {
		factors[1] *= texture__unmasked(indices.y >> 16u, surface);
		factors[2] *= texture__unmasked(indices.z >> 16u, surface);
	}
	return factors;
}

fn texture__unmasked(index: u32, surface: shading__Surface) -> f32 {
	if (index == types__NO_TEXTURE) {
		return 1.0;
	}
	return select(1.0, 0.0, texture__is_bare(material__load_texture(index), surface));
}

fn texture__texture_factors(wanted: vec3u, surface: shading__Surface) -> mat3x3f {
	var factors = mat3x3f(vec3f(1.0), vec3f(1.0), vec3f(1.0));
	var open = wanted != vec3u(types__NO_TEXTURE);
	loop {
		let index = select(select(select(0u, wanted.z, open.z), wanted.y, open.y), wanted.x, open.x);
		let color = texture__texture_color(material__load_texture(index), surface);
		let found = open & (wanted == vec3u(index));
		factors[0] = select(factors[0], color, found.x);
		factors[1] = select(factors[1], color, found.y);
		factors[2] = select(factors[2], color, found.z);
		open = open & !found;
		continuing {
		
			break if !any(open);
		}
	}
	loops__cut_off |= any(open);
	return factors;
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

fn texture__is_bare(texture: types__PackedTexture, surface: shading__Surface) -> bool {
	return bindings__HAS_SECTION && surface.is_cap && (texture.flags & types__TEXTURE_UV) != 0u;
}

fn texture__place_in_pattern(texture: types__PackedTexture, surface: shading__Surface) -> vec3f {
	let uv = select(surface.uv, surface.second_uv, texture__uses_second_uv(texture));
	let at = select(vec4f(surface.place, 1.0), vec4f(uv, 0.0, 1.0), (texture.flags & types__TEXTURE_UV) != 0u);
	return clamp_vec3f(vec3f(dot(texture.row_x, at), dot(texture.row_y, at), dot(texture.row_z, at)), vec3f(-100000000.0), vec3f(100000000.0));
}

fn texture__texture_alpha(texture: types__PackedTexture, surface: shading__Surface, is_mask: bool) -> f32 {
	if (bindings__HAS_PICTURES && texture.kind == types__PATTERN_PICTURE && !texture__is_bare(texture, surface)) {
		let axes = texture__footprint_in(texture, surface.footprint);
		let size = select(1.0, 0.0, is_mask);
		return texture__picture_color(texture, texture__place_in_pattern(texture, surface).xy, size * axes).w;
	}
	return 1.0;
}

fn texture__texture_color(texture: types__PackedTexture, surface: shading__Surface) -> vec3f {
	return texture__texture_value(texture, surface).xyz;
}

fn texture__texture_value(texture: types__PackedTexture, surface: shading__Surface) -> vec4f {
	if (texture__is_bare(texture, surface)) {
		return vec4f(1.0);
	}
	let q = texture__place_in_pattern(texture, surface);
	if (bindings__HAS_PICTURES && texture.kind == types__PATTERN_PICTURE) {
		return texture__picture_color(texture, q.xy, texture__footprint_in(texture, surface.footprint));
	}
	var weight = pattern__checker(q);
	if (bindings__HAS_NOISE && texture.kind == types__PATTERN_NOISE) {
		let octaves = noise__noise_octaves(q, texture.octaves);
		loops__cut_off |= octaves.count < texture.octaves;
		weight = pattern__clouds(octaves.sum);
	}
	weight = select(weight, pattern__stripes(q), texture.kind == types__PATTERN_STRIPES);
	weight = select(weight, pattern__gradient(q), texture.kind == types__PATTERN_GRADIENT);
	return vec4f(mix(texture.color_a, texture.color_b, weight), 1.0);
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

fn tangent__tangent_along(e1: vec3f, e2: vec3f, d1: vec2f, d2: vec2f, n: vec3f) -> vec4f {
	let area = d1.x * d2.y - d1.y * d2.x;
	let hand = select(1.0, -1.0, area < 0.0);
	let along = hand * (d2.y * e1 - d1.y * e2);
	let axis = select(vec3f(1.0, 0.0, 0.0), vec3f(0.0, 1.0, 0.0), abs(n.x) > 0.7);
	let other = numeric__normalize_or(cross(n, axis), vec3f(1.0, 0.0, 0.0));
	let within = numeric__normalize_or(along, other);
	return vec4f(numeric__normalize_or(within - dot(within, n) * n, other), hand);
}

struct layers__Layers {
	diffuse: vec3f,
	f0: vec3f,
	f90: vec3f,
	metallic: f32,
	over_f0: vec3f,
	over_f90: vec3f,
	alpha: f32,
	reflect: vec3f,
	transmit: vec3f,
	boundary_alpha: f32,
	fresnel: u32,
	ior: f32,
	glow: vec3f,
	coat: f32,
	coat_roughness: f32,
	sheen: vec3f,
	sheen_roughness: f32,
	anisotropy: f32,
	along: vec2f,
	film: f32,
	film_ior: f32,
	film_thickness: f32,
	diffuse_transmission: f32,
	diffuse_transmission_color: vec3f
}

fn layers__layers_at(surface: shading__Surface, optics: shading__Optics) -> layers__Layers {
	var own = material__load_layers(surface.material);
	own.base = surface.phong.diffuse;
	var reflect = surface.phong.reflect;
	var transmit = optics.transmit;
	var glow = vec3f(1.0);
	var thickness = 1.0;
	var along = vec2f(1.0, 0.0);
	if (bindings__HAS_TEXTURES) {
		var rest = own.slots;
		loop {
			let slot = firstTrailingBit(rest | 2147483648u);
			let texture = material__load_texture(select(0u, layers__texture_in(own, slot), rest != 0u));
			let value = texture__texture_value(texture, surface);
			let shown = select(1.0, 0.0, texture__is_bare(texture, surface));
			let share = saturate_vec4f(value);
			own.base *= select(vec3f(1.0), value.xyz, slot == types__SLOT_BASE);
			let is_both = slot == types__SLOT_METALLIC_ROUGHNESS;
			own.roughness *= select(1.0, share.y, is_both || slot == types__SLOT_ROUGHNESS);
			own.metallic *= select(1.0, shown * share.z, is_both || slot == types__SLOT_METALLIC);
			own.f0 *= select(vec3f(1.0), value.xyz, slot == types__SLOT_F0) * select(1.0, share.w, slot == types__SLOT_F90);
			own.f90 *= select(1.0, share.w, slot == types__SLOT_F90);
			own.transmission *= select(1.0, shown * share.x, slot == types__SLOT_TRANSMISSION);
			transmit *= select(vec3f(1.0), shown * value.xyz, slot == types__SLOT_TRANSMISSION);
			reflect *= select(vec3f(1.0), value.xyz, slot == types__SLOT_REFLECT);
			glow *= select(vec3f(1.0), shown * value.xyz, slot == types__SLOT_EMISSION);
			if (bindings__HAS_ANISOTROPY) {
				own.anisotropy *= select(1.0, share.z, slot == types__SLOT_ANISOTROPY);
				along = select(along, 2.0 * value.xy - 1.0, slot == types__SLOT_ANISOTROPY);
			}
			if (bindings__HAS_COATINGS) {
				own.coat *= select(1.0, share.x, slot == types__SLOT_COAT);
				own.coat_roughness *= select(1.0, share.y, slot == types__SLOT_COAT_ROUGHNESS);
				own.sheen *= select(vec3f(1.0), share.xyz, slot == types__SLOT_SHEEN);
				own.sheen_roughness *= select(1.0, share.w, slot == types__SLOT_SHEEN_ROUGHNESS);
				own.iridescence *= select(1.0, share.x, slot == types__SLOT_IRIDESCENCE);
				thickness *= select(1.0, share.y, slot == types__SLOT_FILM_THICKNESS);
				own.diffuse_transmission *= select(1.0, share.w, slot == types__SLOT_DIFFUSE_TRANSMISSION);
				own.diffuse_transmission_color *= select(vec3f(1.0), share.xyz, slot == types__SLOT_DIFFUSE_TRANSMISSION_COLOR);
			}
			rest &= rest - 1u;
			continuing {
			
				break if rest == 0u;
			}
		}
		loops__cut_off |= rest != 0u;
	}
	var layers: layers__Layers;
	if (bindings__HAS_METALLIC_ROUGHNESS && (optics.flags & types__MATERIAL_METALLIC_ROUGHNESS) != 0u) {
		if (bindings__HAS_TEXTURES || bindings__HAS_COLORS) {
			own.base = saturate_vec3f(own.base);
			own.f0 = saturate_vec3f(own.f0);
		}
		layers = layers__metallic_roughness(own);
	}
	else {
		layers.diffuse = own.base;
		layers.f0 = own.f0;
		layers.f90 = own.f0;
		layers.over_f0 = own.f0;
		layers.over_f90 = own.f0;
		layers.alpha = own.roughness * own.roughness;
		layers.reflect = reflect;
		layers.transmit = transmit;
		layers.fresnel = optics.flags & (types__MATERIAL_FRESNEL | types__MATERIAL_SCHLICK);
		layers.ior = own.ior;
	}
	layers.glow = glow;
	if (bindings__HAS_ANISOTROPY) {
		layers.anisotropy = own.anisotropy;
		layers.along = dispersion__anisotropy_tangent(own.anisotropy_rotation, along);
	}
	if (bindings__HAS_COATINGS) {
		layers.coat = own.coat;
		layers.coat_roughness = own.coat_roughness;
		layers.sheen = own.sheen;
		layers.sheen_roughness = own.sheen_roughness;
		layers.film = own.iridescence;
		layers.film_ior = own.iridescence_ior;
		layers.film_thickness = mix(own.film_thinnest, own.film_thickest, thickness);
		layers.diffuse_transmission = own.diffuse_transmission;
		layers.diffuse_transmission_color = own.diffuse_transmission_color;
	}
	return layers;
}

fn layers__metallic_roughness(own: types__PackedLayers) -> layers__Layers {
	var layers: layers__Layers;
	layers.alpha = own.roughness * own.roughness;
	layers.ior = own.ior;
	layers.metallic = own.metallic;
	let body = 1.0 - own.metallic;
	layers.diffuse = body * own.base;
	if ((bindings__HAS_REFLECTION || bindings__HAS_REFRACTION) && own.transmission > 0.0) {
		let ratio = (own.ior - 1.0) / (own.ior + 1.0);
		layers.diffuse *= 1.0 - own.transmission;
		layers.f0 = own.metallic * own.base;
		layers.f90 = vec3f(own.metallic);
		layers.reflect = body * min_vec3f(own.f0 / max_f32(ratio * ratio, 1e-6), vec3f(1.0));
		layers.transmit = (body * own.transmission) * own.base;
		layers.boundary_alpha = layers.alpha;
		layers.fresnel = types__MATERIAL_FRESNEL;
		return layers;
	}
	layers.f0 = mix(own.f0, own.base, own.metallic);
	layers.f90 = vec3f(mix(own.f90, 1.0, own.metallic));
	layers.over_f0 = own.f0;
	layers.over_f90 = vec3f(own.f90);
	return layers;
}

fn layers__textured(own: types__PackedLayers, slot: u32, surface: shading__Surface) -> vec4f {
	if ((own.slots & (1u << slot)) == 0u) {
		return vec4f(1.0);
	}
	return texture__texture_value(material__load_texture(layers__texture_in(own, slot)), surface);
}

fn layers__texture_in(own: types__PackedLayers, slot: u32) -> u32 {
	let late = select(own.more_textures, own.last_textures, vec4<bool>(slot >= 16u));
	let four = select(own.textures, late, vec4<bool>(slot >= 8u));
	let word = (slot >> 1u) & 3u;
	let low = select(four.x, four.y, word == 1u);
	let high = select(four.z, four.w, word == 3u);
	return (select(low, high, word >= 2u) >> (16u * (slot & 1u))) & 65535u;
}

fn coverage__coverage_at(surface: shading__Surface) -> f32 {
	if (!bindings__HAS_COVERAGE) {
		return 1.0;
	}
	let material = material__load_coverage(surface.material);
	if ((material.flags & types__MATERIAL_COVERAGE) == 0u) {
		return 1.0;
	}
	var alpha = material.alpha;
	if (bindings__HAS_TEXTURES) {
		let index = material__load_texture_indices(surface.material).w >> 16u;
		if (index != types__NO_TEXTURE) {
			alpha *= texture__texture_alpha(material__load_texture(index), surface, (material.flags & types__MATERIAL_MASK) != 0u);
		}
	}
	if (bindings__HAS_COLORS) {
		alpha *= surface.color.w;
	}
	let masked = select(0.0, 1.0, alpha >= 0.999999);
	return select(clamp_f32(alpha, 0.0, 1.0), masked, (material.flags & types__MATERIAL_MASK) != 0u);
}

fn media__has_room(media: vec4u) -> bool {
	return media.w == types__NONE;
}

fn media__contains(media: vec4u, material: u32) -> bool {
	return any(media == vec4u(material));
}

fn media__entered(media: vec4u, material: u32) -> vec4u {
	let is_free = media == vec4u(types__NONE);
	let is_first_free = is_free & !vec4<bool>(false, is_free.xyz);
	return select(media, vec4u(material), is_first_free);
}

fn media__left(media: vec4u, material: u32) -> vec4u {
	let is_it = media == vec4u(material);
	let later = vec4<bool>(is_it.y | is_it.z | is_it.w, is_it.z | is_it.w, is_it.w, false);
	let is_last = is_it & !later;
	let x = is_last.x;
	let y = x | is_last.y;
	let z = y | is_last.z;
	let w = z | is_last.w;
	return select(media, vec4u(media.yzw, types__NONE), vec4<bool>(x, y, z, w));
}

var<private> ray_stack__tree_cut_off: u32;

var<private> ray_stack__cut_off_trees: u32;

fn ray_stack__cut_tree() {
	ray_stack__cut_off_trees += 1u - ray_stack__tree_cut_off;
	ray_stack__tree_cut_off = 1u;
}

const pattern__CELL_SHIFT: f32 = 0.00073;

fn pattern__checker(p: vec3f) -> f32 {
	let cell = vec3i(floor(p + pattern__CELL_SHIFT));
	return f32((cell.x + cell.y + cell.z) & 1);
}

fn pattern__stripes(p: vec3f) -> f32 {
	return f32(i32(floor(2.0 * (p.x + pattern__CELL_SHIFT))) & 1);
}

fn pattern__gradient(p: vec3f) -> f32 {
	return clamp_f32(p.x, 0.0, 1.0);
}

fn pattern__clouds(sum: f32) -> f32 {
	return clamp_f32(0.5 + 0.5 * sum, 0.0, 1.0);
}

const noise__NOISE_PERIOD: u32 = 256u;

const noise__OCTAVE_SHIFT = vec3f(0.37, 0.59, 0.83);

struct noise__Octaves {
	sum: f32,
	count: u32
}

fn noise__noise_octaves(p: vec3f, count: u32) -> noise__Octaves {
	let period = f32(noise__NOISE_PERIOD);
	let home = p - period * floor(p / period);
	var octaves = noise__Octaves(0.0, 0u);
	var scale = 1.0;
	loop {
		let q = scale * home + f32(octaves.count) * noise__OCTAVE_SHIFT;
		octaves.sum += noise__gradient_noise(q, noise__NOISE_PERIOD << octaves.count) / scale;
		scale *= 2.0;
		octaves.count += 1u;
		continuing {
		
			break if octaves.count >= count;
		}
	}
	return octaves;
}

fn noise__gradient_noise(p: vec3f, period: u32) -> f32 {
	let cell = floor(p);
	let f = p - cell;
	let low = vec3u(vec3i(cell)) & vec3u(period - 1u);
	let high = (low + 1u) & vec3u(period - 1u);
	let z0 = rng__hash(low.z);
	let z1 = rng__hash(high.z);
	let y00 = rng__hash(low.y + z0);
	let y10 = rng__hash(high.y + z0);
	let y01 = rng__hash(low.y + z1);
	let y11 = rng__hash(high.y + z1);
	let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
	let x = vec4f(mix(noise__corner(low.x + y00, f), noise__corner(high.x + y00, f - vec3f(1.0, 0.0, 0.0)), t.x), mix(noise__corner(low.x + y10, f - vec3f(0.0, 1.0, 0.0)), noise__corner(high.x + y10, f - vec3f(1.0, 1.0, 0.0)), t.x), mix(noise__corner(low.x + y01, f - vec3f(0.0, 0.0, 1.0)), noise__corner(high.x + y01, f - vec3f(1.0, 0.0, 1.0)), t.x), mix(noise__corner(low.x + y11, f - vec3f(0.0, 1.0, 1.0)), noise__corner(high.x + y11, f - vec3f(1.0, 1.0, 1.0)), t.x));
	let y = mix(x.xz, x.yw, t.y);
	return mix(y.x, y.y, t.z);
}

fn noise__corner(key: u32, d: vec3f) -> f32 {
	let h = rng__hash(key) & 15u;
	let u = select(d.y, d.x, h < 8u);
	let v = select(select(d.z, d.x, (h == 12u) | (h == 14u)), d.y, h < 4u);
	return select(u, -u, (h & 1u) != 0u) + select(v, -v, (h & 2u) != 0u);
}

const dispersion__WAVELENGTHS: vec3f = vec3f(611.4, 549.1, 464.2);

fn dispersion__dispersed_ior(ior: f32, dispersion: f32, wavelength: f32) -> f32 {
	let spread = (ior - 1.0) * dispersion / 20.0;
	return max_f32(ior + spread * (523655.0 / (wavelength * wavelength) - 1.5168), 1.0);
}

fn dispersion__anisotropic_alpha(alpha: f32, strength: f32) -> vec2f {
	return vec2f(mix(alpha, 1.0, strength * strength), alpha);
}

fn dispersion__anisotropy_tangent(rotation: f32, texel: vec2f) -> vec2f {
	let own = texel * inverseSqrt(max_f32(dot(texel, texel), 1e-12));
	let turn = vec2f(cos(rotation), sin(rotation));
	return vec2f(own.x * turn.x - own.y * turn.y, own.x * turn.y + own.y * turn.x);
}

const bsdf_ggx__SMOOTH: f32 = 0.0001;

fn bsdf_ggx__ggx_distribution(h: vec3f, alpha: vec2f) -> f32 {
	let scaled = vec3f(h.xy / alpha, h.z);
	let squared = dot(scaled, scaled);
	return select(0.0, 1.0 / (warp__PI * alpha.x * alpha.y * squared * squared), h.z > 0.0);
}

fn bsdf_ggx__ggx_lambda(w: vec3f, alpha: vec2f) -> f32 {
	let slope = alpha * w.xy;
	return 0.5 * (sqrt(1.0 + dot(slope, slope) / max_f32(w.z * w.z, 1e-12)) - 1.0);
}

fn bsdf_ggx__ggx_normal(wo: vec3f, alpha: vec2f, u: vec2f) -> vec3f {
	let stretched = normalize(vec3f(alpha * wo.xy, wo.z));
	let z = (1.0 - u.y) * (1.0 + stretched.z) - stretched.z;
	let radius = sqrt(clamp_f32(1.0 - z * z, 0.0, 1.0));
	let angle = 2.0 * warp__PI * u.x;
	let sum = vec3f(radius * cos(angle), radius * sin(angle), z) + stretched;
	return normalize(vec3f(alpha * sum.xy, max_f32(sum.z, 1e-6)));
}

fn bsdf_ggx__ggx_eval(wo: vec3f, wi: vec3f, alpha: vec2f, separable: bool) -> vec2f {
	let h = normalize(vec3f(wo.xy + wi.xy, max_f32(wo.z, 0.0) + max_f32(wi.z, 1e-6)));
	let seen = 1.0 + bsdf_ggx__ggx_lambda(wo, alpha);
	let lit = 1.0 + bsdf_ggx__ggx_lambda(wi, alpha);
	let facets = bsdf_ggx__ggx_distribution(h, alpha) / (4.0 * max_f32(wo.z, 1e-6));
	let shadowed = select(seen + lit - 1.0, seen * lit, separable);
	return select(vec2f(0.0), vec2f(facets / shadowed, facets / seen), wo.z > 0.0 && wi.z > 0.0);
}

struct fresnel__Boundary {
	reflectance: f32,
	cos_t: f32,
	total: bool
}

fn fresnel__ratio(a: f32, b: f32) -> f32 {
	return a / max_f32(b, 1e-12);
}

fn fresnel__fresnel(cos_i: f32, eta: f32) -> fresnel__Boundary {
	let sin2_t = eta * eta * max_f32(1.0 - cos_i * cos_i, 0.0);
	let total = (sin2_t >= 1.0) & (eta > 1.0);
	let cos_t = sqrt(max_f32(1.0 - sin2_t, 0.0));
	return fresnel__Boundary(select(fresnel__unpolarised(cos_i, cos_t, eta), 1.0, total), cos_t, total);
}

fn fresnel__unpolarised(cos_i: f32, cos_t: f32, eta: f32) -> f32 {
	let r_s = fresnel__ratio(eta * cos_i - cos_t, eta * cos_i + cos_t);
	let r_p = fresnel__ratio(cos_i - eta * cos_t, cos_i + eta * cos_t);
	return 0.5 * (r_s * r_s + r_p * r_p);
}

fn fresnel__schlick(cos_i: f32, eta: f32, exact: fresnel__Boundary) -> f32 {
	let r0 = fresnel__ratio((eta - 1.0) * (eta - 1.0), (eta + 1.0) * (eta + 1.0));
	let grazing = fresnel__schlick_weight(select(cos_i, exact.cos_t, eta > 1.0));
	return select(mix(r0, 1.0, grazing), 1.0, exact.total);
}

fn fresnel__boundary_at(flags: u32, cos_i: f32, eta: f32) -> fresnel__Boundary {
	var boundary = fresnel__fresnel(cos_i, eta);
	if ((flags & types__MATERIAL_SCHLICK) != 0u) {
		boundary.reflectance = fresnel__schlick(cos_i, eta, boundary);
	}
	return boundary;
}

fn fresnel__schlick_weight(cosine: f32) -> f32 {
	let x = 1.0 - clamp_f32(cosine, 0.0, 1.0);
	let x2 = x * x;
	return x2 * x2 * x;
}

fn fresnel__schlick_between(f0: vec3f, f90: vec3f, cosine: f32) -> vec3f {
	return mix(f0, f90, fresnel__schlick_weight(cosine));
}

fn fresnel__mirrored(direction: vec3f, n: vec3f) -> vec3f {
	return normalize(direction - 2.0 * dot(direction, n) * n);
}

fn fresnel__refracted(direction: vec3f, n: vec3f, eta: f32, cos_t: f32) -> vec3f {
	let cos_i = -dot(direction, n);
	return normalize(eta * direction + (eta * cos_i - cos_t) * n);
}

fn leaving__leaving_ray(surface: shading__Surface, direction: vec3f, t_max: f32) -> tracing__Ray {
	if (bindings__FIXED_OFFSET > 0.0) {
		let origin = offset__fixed_origin(surface.p, surface.ng, direction, bindings__FIXED_OFFSET);
		return tracing__Ray(origin, t_max, direction, types__NONE, surface.instance);
	}
	let origin = offset__offset_origin(surface.p, surface.error, surface.ng, direction);
	return tracing__Ray(origin, t_max, direction, surface.leaving, surface.instance);
}

struct interface__Interface {
	here: u32,
	media: vec4u,
	ior: f32,
	ior_behind: f32,
	is_boundary: bool,
	is_transparent: bool,
	encloses: bool
}

fn interface__interface_at(around: vec4u, contact: contact__Contact, optics: shading__Optics) -> interface__Interface {
	let surface = contact.surface;
	let transparent = bindings__HAS_REFRACTION && any(optics.transmit > vec3f(0.0));
	let encloses = transparent && (optics.flags & types__MATERIAL_THIN) == 0u;
	var found = interface__Interface(medium__dominant(around), around, 1.0, optics.ior, true, transparent, encloses);
	if (bindings__HAS_REFRACTION) {
		if (transparent) {
			found.media = contact__media_behind(around, contact);
		}
		if (encloses) {
			found.here = medium__medium_before(around, surface.material, surface.outside);
			let behind = medium__dominant(found.media);
			found.ior_behind = medium__medium_of(behind).ior;
			found.is_boundary = !bindings__HAS_CONTACT || found.here != behind;
		}
		found.ior = medium__medium_of(found.here).ior;
	}
	return found;
}

const dimensions__SCATTER_CHOICE: u32 = 0u;

const dimensions__SCATTER_DIRECTION: u32 = 1u;

const dimensions__LIGHT_CHOICE: u32 = 2u;

const dimensions__LIGHT_POINT_ON: u32 = 3u;

const dimensions__ROULETTE: u32 = 4u;

const dimensions__COVERAGE_CHOICE: u32 = 5u;

const dimensions__CHANNEL_CHOICE: u32 = 6u;

const dimensions__DIMENSIONS: u32 = 8u;

fn dimensions__dimension_key(pixel_key: u32, segment: u32, purpose: u32) -> u32 {
	return rng__hash_combine(pixel_key, dimensions__DIMENSIONS * (segment + 1u) + purpose);
}

const shadow_catcher__LEAST_DENSITY: f32 = 1e-15;

fn shadow_catcher__caught(batch: dispatch__Batch, before: path__Path, surface: shading__Surface) -> path__Path {
	var path = before;
	let share = dot(path.throughput, tone__LUMINANCE_REC709);
	let n = select(surface.n, -surface.n, dot(surface.n, path.ray.direction) > 0.0);
	let wi = bsdf_diffuse__diffuse_sample(path__random_2d(path, dimensions__SCATTER_DIRECTION));
	let direction = warp__turn_to(n, wi);
	let pdf = bsdf_diffuse__diffuse_eval(wi);
	var unshadowed = environment__background_weight(batch, direction, pdf) * background__background(batch, direction);
	if (bindings__HAS_LIGHTS || bindings__HAS_EMITTERS || bindings__HAS_ENVIRONMENT) {
		var light = emitters__sample_light(batch, surface.p, n, path__random_1d(path, dimensions__LIGHT_CHOICE), path__random_2d(path, dimensions__LIGHT_POINT_ON));
		let value = bsdf_diffuse__diffuse_eval(vec3f(0.0, 0.0, dot(n, light.incident.direction)));
		let is_shared = bindings__HAS_ENVIRONMENT && light.pdf > 0.0 && light.incident.distance >= camera__T_FAR;
		light.pdf = select(0.0, light.pdf, is_shared);
		let weight = select(1.0, mis__power_heuristic(light.pdf, value), is_shared);
		let arriving = weight * value * light.incident.radiance;
		if (any(arriving > vec3f(0.0))) {
			path.lamp = shadow__passage_of(direct__shadow_ray(surface, light.incident), path.media);
			path.lamp_light = share * arriving;
			path.lamp_scatterings = 1u;
		}
		record_path__record_light_sample(surface, path.lamp.ray, light, bsdf__BsdfValue(vec3f(value), value), weight, arriving);
		unshadowed += arriving;
	}
	opacity__clearness.catchers += share;
	opacity__clearness.unshadowed += share * dot(unshadowed, tone__LUMINANCE_REC709);
	record_path__record_step(bsdf__BsdfSample(direction, vec3f(share) / max_vec3f(path.throughput, vec3f(1e-30)), pdf));
	path.is_caught = true;
	path.throughput = vec3f(share);
	path.ray = leaving__leaving_ray(surface, direction, camera__T_FAR);
	path.origin = surface.p;
	path.normal = n;
	path.pdf = pdf;
	path.kind = types__RAY_REFLECTION;
	path.bounces += 1u;
	return path;
}

fn shadow_catcher__leaves_catcher(path: path__Path) -> bool {
	return path__is_caught(path) && path.bounces == 1u && path.pdf > 0.0;
}

fn shadow_catcher__density_for_lamps(path: path__Path) -> f32 {
	return select(path.pdf, shadow_catcher__LEAST_DENSITY, shadow_catcher__leaves_catcher(path));
}

fn shadow_catcher__count_unsampled(path: path__Path, light: vec3f) {
	if (bindings__HAS_CATCHERS) {
		opacity__clearness.unshadowed += select(0.0, dot(light, tone__LUMINANCE_REC709), shadow_catcher__leaves_catcher(path));
	}
}

fn bsdf_diffuse__diffuse_eval(wi: vec3f) -> f32 {
	return max_f32(wi.z, 0.0) / warp__PI;
}

fn bsdf_diffuse__diffuse_sample(u: vec2f) -> vec3f {
	let p = warp__disc_from_square(u);
	return vec3f(p, sqrt(max_f32(1.0 - dot(p, p), 0.0)));
}

struct emitters__LightSample {
	incident: shading__Incident,
	pdf: f32
}

fn emitters__sample_light(batch: dispatch__Batch, p: vec3f, n: vec3f, choice: f32, u: vec2f) -> emitters__LightSample {
	if (bindings__HAS_ENVIRONMENT && (!(bindings__HAS_LIGHTS || bindings__HAS_EMITTERS) || choice >= 1.0 - batch.environment_share)) {
		let found = environment__sample_environment(batch, u);
		let pdf = batch.environment_share * found.pdf;
		record_path__record_source(types__SOURCE_ENVIRONMENT, types__NONE, batch.environment_share);
		let radiance = background__background(batch, found.direction) / max_f32(pdf, 1e-30);
		return emitters__LightSample(shading__Incident(found.direction, camera__T_FAR, radiance), pdf);
	}
	let source = light_choice__choose_source(batch, p, n, choice);
	record_path__record_source(select(types__SOURCE_LIGHT, types__SOURCE_EMITTER, source.is_emitter), source.index, source.chance);
	if (bindings__HAS_EMITTERS && (!bindings__HAS_LIGHTS || source.is_emitter)) {
		var emitted = emitters__sample_emitter(p, source, u);
		emitted.incident = section__uncut(p, emitted.incident);
		return emitted;
	}
	let light = shutter__shutter_light(source.index, batch.light_count);
	var found = emitters__sample_lamp(light, p, u);
	if (light.visible != 0u) {
		found.incident = section__uncut(p, found.incident);
	}
	found.incident.radiance *= select(0.0, warp__PI / max_f32(source.chance, 1e-30), source.chance > 0.0);
	found.pdf *= source.chance;
	return found;
}

fn emitters__sample_lamp(light: types__PackedLight, p: vec3f, u: vec2f) -> emitters__LightSample {
	if (!(bindings__HAS_AREA_LIGHTS && light.kind >= types__LIGHT_RECTANGLE)) {
		return emitters__LightSample(light__incident(light, p), 0.0);
	}
	if (light.kind != types__LIGHT_RECTANGLE || light.attenuation != types__ATTENUATION_INVERSE_SQUARE) {
		let arriving = area_light__area_incident(light, p, u);
		let pdf = area_light__area_density(light, p, arriving.direction, arriving.distance);
		return emitters__LightSample(arriving, select(0.0, pdf, light_weight__can_be_hit(light)));
	}
	let found = spherical_rectangle__solid_sample(light, p, u);
	let cosine = -dot(found.direction, light.direction);
	let strength = select(0.0, 1.0 / max_f32(emissive_shape__area_of(light) * found.pdf, 1e-30), cosine > 0.0);
	let reach = numeric__max_component(abs(light.position)) + numeric__max_component(abs(p));
	return emitters__LightSample(shading__Incident(found.direction, area_light__short_of(found.distance, reach, abs(cosine)), strength * light.color), select(0.0, found.pdf, light_weight__can_be_hit(light)));
}

fn emitters__sample_emitter(p: vec3f, source: light_choice__Source, u: vec2f) -> emitters__LightSample {
	let emitter = fetch__load_emitter(source.index);
	if (bindings__HAS_EMISSIVE_SHAPES && (emitter.primitive & types__SHAPE) != 0u) {
		return emitters__sample_shape(p, emitter, source, u);
	}
	var instance: types__PackedInstance;
	let is_placed = bindings__HAS_INSTANCES && emitter.instance != types__NO_INSTANCE;
	if (is_placed) {
		instance = fetch__load_instance(emitter.instance);
	}
	let keys = deforming__keys_of(instance);
	let own = deforming__triangle_now(emitter.primitive, keys);
	let b = warp__triangle_from_square(u);
	let weights = vec3f(1.0 - b.x - b.y, b);
	var surface: shading__Surface;
	surface.material = fetch__load_vertex(own.i0).material;
	surface.place = mat3x3f(own.v0, own.v1, own.v2) * weights;
	var corners = mat3x3f(own.v0 - surface.place, own.v1 - surface.place, own.v2 - surface.place);
	surface.p = surface.place;
	if (is_placed) {
		let space = instance__space_of(instance);
		corners = space.linear * corners;
		surface.p = space.linear * surface.place + space.translation;
		surface.place = instance__pattern_place(instance, surface.place);
	}
	if (bindings__HAS_TEXTURES && bindings__HAS_UVS) {
		let uvs = mat3x4f(fetch__load_uvs(own.i0), fetch__load_uvs(own.i1), fetch__load_uvs(own.i2)) * weights;
		surface.uv = uvs.xy;
		surface.second_uv = select(uvs.xy, uvs.zw, bindings__HAS_SECOND_UVS);
	}
	let material = surface.material;
	let glow = material__load_glow(material);
	if (bindings__HAS_COLORS) {
		surface.color = vertex_color__interpolated_color(own, weights);
	}
	var radiance = vertex_color__emission_of(surface);
	if (bindings__HAS_TEXTURES && glow.texture != types__NO_TEXTURE) {
		radiance *= texture__texture_color(material__load_texture(glow.texture), surface);
	}
	let across = cross(corners[1] - corners[0], corners[2] - corners[0]);
	let to_point = surface.p - p;
	let distance = length(to_point);
	let direction = numeric__normalize_or(to_point, vec3f(0.0, 0.0, 1.0));
	let n = numeric__normalize_or(across, -direction);
	let cosine = -dot(direction, n);
	var normals = mat3x3f(fetch__load_vertex(own.i0).normal, fetch__load_vertex(own.i1).normal, fetch__load_vertex(own.i2).normal);
	if (bindings__HAS_DEFORMATION) {
		if (keys.next != 0u) {
			normals = deforming__normals_now(emitter.primitive, keys);
		}
	}
	var front = normals * weights;
	if (is_placed) {
		front = instance__placed_normal(instance__space_of(instance), front);
	}
	let is_outside = (dot(front, n) < 0.0) == (cosine < 0.0);
	let shines = is_outside || (material__load_flags(material) & types__MATERIAL_TWO_SIDED_EMISSION) != 0u;
	radiance *= coating__through_coat(surface, abs(cosine));
	let facing = select(0.0, abs(cosine), shines && source.chance > 0.0);
	let actual = source.chance / max_f32(0.5 * length(across), 1e-30);
	let fading = 1.0 / max_f32(distance * distance, 1e-30);
	let reach = numeric__max_component(abs(surface.p)) + numeric__max_component(abs(p));
	return emitters__LightSample(shading__Incident(direction, area_light__short_of(distance, reach, abs(cosine)), (facing * fading / max_f32(actual, 1e-30)) * radiance), light_weight__emitter_glow(source.index, glow) * source.rate / max_f32(abs(cosine) * fading, 1e-30));
}

fn emitters__sample_shape(p: vec3f, emitter: types__PackedEmitter, source: light_choice__Source, u: vec2f) -> emitters__LightSample {
	let shape = fetch__load_shape(emitter.primitive & ~types__SHAPE);
	let found = emissive_shape__sample_of_shape(shape, emitter.instance, p, u);
	let glow = material__load_glow(shape.material);
	var radiance = material__load_emission(shape.material);
	if (bindings__HAS_TEXTURES && glow.texture != types__NO_TEXTURE) {
		radiance *= texture__texture_color(material__load_texture(glow.texture), found.surface);
	}
	let cosine = -dot(found.n, found.direction);
	let shines = cosine > 0.0 || (material__load_flags(shape.material) & types__MATERIAL_TWO_SIDED_EMISSION) != 0u;
	radiance *= select(0.0, coating__through_coat(found.surface, abs(cosine)), shines && source.chance > 0.0);
	let reach = numeric__max_component(abs(found.surface.p)) + numeric__max_component(abs(p));
	return emitters__LightSample(shading__Incident(found.direction, area_light__short_of(found.distance, reach, abs(cosine)), radiance / max_f32(source.chance * found.density, 1e-30)), light_weight__emitter_glow(source.index, glow) * source.rate * found.area * found.density);
}

fn emitters__emitted(surface: shading__Surface, optics: shading__Optics, glow: vec3f) -> vec3f {
	if (!bindings__HAS_EMISSION) {
		return vec3f(0.0);
	}
	let shines = surface.outside || (optics.flags & types__MATERIAL_TWO_SIDED_EMISSION) != 0u;
	return select(vec3f(0.0), glow * vertex_color__emission_of(surface), shines);
}

const quad_warp__CHANCE_BITS: u32 = 10u;

const quad_warp__CHANCE_STEPS: f32 = 1023.0;

struct quad_warp__QuadPlace {
	cell: vec2u,
	u: vec2f
}

struct quad_warp__Half {
	index: u32,
	u: f32
}

fn quad_warp__quad_root(word: u32, u: vec2f) -> quad_warp__QuadPlace {
	let column = quad_warp__half_of(quad_warp__chance_of(word, 0u), u.x);
	return quad_warp__QuadPlace(vec2u(column.index, 0u), vec2f(column.u, u.y));
}

fn quad_warp__quad_step(word: u32, place: quad_warp__QuadPlace) -> quad_warp__QuadPlace {
	let row = quad_warp__half_of(quad_warp__chance_of(word, 0u), place.u.y);
	let column = quad_warp__half_of(quad_warp__chance_of(word, 1u + row.index), place.u.x);
	return quad_warp__QuadPlace(2u * place.cell + vec2u(column.index, row.index), vec2f(column.u, row.u));
}

fn quad_warp__chance_of(word: u32, index: u32) -> f32 {
	return f32((word >> (quad_warp__CHANCE_BITS * index)) & 1023u) / quad_warp__CHANCE_STEPS;
}

fn quad_warp__half_of(chance: f32, u: f32) -> quad_warp__Half {
	let is_second = u >= chance;
	let start = select(0.0, chance, is_second);
	let size = select(chance, 1.0 - chance, is_second);
	return quad_warp__Half(select(0u, 1u, is_second), clamp_f32((u - start) / max_f32(size, 1e-9), 0.0, 0.99999994));
}

struct light_choice__Source {
	is_emitter: bool,
	index: u32,
	chance: f32,
	rate: f32
}

fn light_choice__choose_source(batch: dispatch__Batch, p: vec3f, n: vec3f, choice: f32) -> light_choice__Source {
	let share = 1.0 - batch.environment_share;
	if (bindings__HAS_LIGHT_TREE) {
		let leaf = light_tree__choose_leaf(batch, p, n, min_f32(choice / share, 0.99999994));
		let index = select(0u, leaf.reference & types__LIGHT_INDEX_MASK, leaf.chance > 0.0);
		if (bindings__HAS_EMITTERS && (!bindings__HAS_LIGHTS || (leaf.reference & types__LIGHT_EMITTERS) != 0u)) {
			let rate = share * light_choice__emitter_rate(leaf.chance, leaf.power);
			return light_choice__emitter_in(batch, index * batch.emitter_group, share * leaf.chance, rate, leaf.rest);
		}
		return light_choice__Source(false, index, share * leaf.chance, 0.0);
	}
	if (bindings__HAS_EMITTERS && (!bindings__HAS_LIGHTS || choice >= batch.lights_share)) {
		let own = share - batch.lights_share;
		return light_choice__emitter_in(batch, 0u, own, 1.0 / batch.emitter_power, (choice - batch.lights_share) / own);
	}
	let index = light_choice__chosen(choice, 0u, batch.light_count, false);
	return light_choice__Source(false, index, fetch__load_light(index).chance, 0.0);
}

fn light_choice__emitter_rate(chance: f32, power: f32) -> f32 {
	return chance / max_f32(warp__PI * power, 1e-30);
}

fn light_choice__emitter_in(batch: dispatch__Batch, first: u32, chance: f32, rate: f32, choice: f32) -> light_choice__Source {
	let end = min(first + batch.emitter_group, batch.emitter_count);
	let index = light_choice__chosen(choice, first, end, true);
	let start = select(0.0, fetch__load_emitter(max(index, 1u) - 1u).end, index > first);
	return light_choice__Source(true, index, chance * (fetch__load_emitter(index).end - start), rate);
}

fn light_choice__chosen(choice: f32, first: u32, end: u32, among_emitters: bool) -> u32 {
	var low = first;
	var high = end - 1u;
	loop {
		let middle = (low + high) / 2u;
		var sum = 0.0;
		if (among_emitters) {
			sum = fetch__load_emitter(middle).end;
		}
		else {
			sum = fetch__load_light_end(middle);
		}
		let is_below = choice < sum;
		low = select(min(middle + 1u, high), low, is_below);
		high = select(high, middle, is_below);
		continuing {
		
			break if low >= high;
		}
	}
	loops__cut_off |= low < high;
	return low;
}

struct light_tree__LightLeaf {
	reference: u32,
	chance: f32,
	power: f32,
	rest: f32
}

struct light_tree__Fork {
	chances: vec4f,
	powers: vec4f,
	children: vec4u
}

fn light_tree__fork_at(reference: u32, p: vec3f, n: vec3f) -> light_tree__Fork {
	let first = reference & types__LIGHT_INDEX_MASK;
	let c0 = fetch__load_cluster(first);
	let c1 = fetch__load_cluster(first + 1u);
	let c2 = fetch__load_cluster(first + 2u);
	let c3 = fetch__load_cluster(first + 3u);
	let powers = vec4f(c0.power, c1.power, c2.power, c3.power);
	var weights = powers;
	if ((reference & types__LIGHT_BY_POWER) == 0u) {
		weights = vec4f(light_cluster__cluster_importance(c0, p, n), light_cluster__cluster_importance(c1, p, n), light_cluster__cluster_importance(c2, p, n), light_cluster__cluster_importance(c3, p, n));
	}
	let total = (weights.x + weights.y) + (weights.z + weights.w);
	let chances = select(vec4f(0.0), weights / max_f32(total, 1e-37), total > 0.0);
	return light_tree__Fork(chances, powers, vec4u(c0.child, c1.child, c2.child, c3.child));
}

fn light_tree__below(node: light_tree__LightLeaf, fork: light_tree__Fork, slot: u32, before: f32) -> light_tree__LightLeaf {
	let chance = light_tree__component(fork.chances, slot);
	let rest = (node.rest - before) / max_f32(chance, 1e-30);
	return light_tree__LightLeaf(node__child_of(fork.children, slot), node.chance * chance, light_tree__component(fork.powers, slot), clamp_f32(rest, 0.0, 0.99999994));
}

fn light_tree__component(v: vec4f, slot: u32) -> f32 {
	let pair = select(v.xz, v.yw, vec2<bool>((slot & 1u) != 0u));
	return select(pair.x, pair.y, (slot & 2u) != 0u);
}

fn light_tree__is_on_the_way(node: light_tree__LightLeaf) -> bool {
	return (node.reference & types__LIGHT_LEAF) == 0u && node.chance > 0.0;
}

fn light_tree__choose_leaf(batch: dispatch__Batch, p: vec3f, n: vec3f, choice: f32) -> light_tree__LightLeaf {
	var node = light_tree__LightLeaf(batch.light_root, 1.0, 0.0, choice);
	loop {
		let fork = light_tree__fork_at(node.reference, p, n);
		let c = fork.chances;
		let ends = vec3f(c.x, c.x + c.y, c.x + c.y + c.z);
		let has_later = vec3<bool>(c.y + c.z + c.w > 0.0, c.z + c.w > 0.0, c.w > 0.0);
		let is_beyond = (vec3f(node.rest) >= ends) & has_later;
		let steps = select(vec3u(0u), vec3u(1u), is_beyond);
		let slot = steps.x + steps.y + steps.z;
		node = light_tree__below(node, fork, slot, light_tree__component(vec4f(0.0, ends), slot));
		continuing {
		
			break if !light_tree__is_on_the_way(node);
		}
	}
	loops__cut_off |= light_tree__is_on_the_way(node);
	return node;
}

fn light_tree__leaf_at(batch: dispatch__Batch, trail: u32, p: vec3f, n: vec3f) -> light_tree__LightLeaf {
	var node = light_tree__LightLeaf(batch.light_root, 1.0, 0.0, 0.0);
	var left = trail;
	loop {
		node = light_tree__below(node, light_tree__fork_at(node.reference, p, n), left & 3u, 0.0);
		left >>= 2u;
		continuing {
		
			break if !light_tree__is_on_the_way(node);
		}
	}
	loops__cut_off |= light_tree__is_on_the_way(node);
	return node;
}

const light_cluster__SLACK: f32 = 0.001;

fn light_cluster__cos_of_rest(a: vec2f, b: vec2f) -> f32 {
	return select(a.y * b.y + a.x * b.x, 1.0, a.y > b.y);
}

fn light_cluster__sine_of(cosine: f32) -> f32 {
	return sqrt(max_f32(1.0 - cosine * cosine, 0.0));
}

fn light_cluster__octahedral_vector(word: u32) -> vec3f {
	let at = unpack2x16snorm(word);
	let z = 1.0 - abs(at.x) - abs(at.y);
	let fold = max_f32(-z, 0.0);
	return normalize(vec3f(at - select(vec2f(-fold), vec2f(fold), at >= vec2f(0.0)), z));
}

fn light_cluster__cluster_importance(cluster: types__PackedCluster, p: vec3f, n: vec3f) -> f32 {
	let offset = p - cluster.center;
	let d2 = dot(offset, offset);
	let r2 = cluster.radius2;
	let nearest2 = max_f32(max_f32(d2, r2), 1e-30);
	let w = offset / sqrt(max_f32(d2, 1e-30));
	let is_inside = d2 <= r2;
	let sin2_b = r2 / nearest2;
	let b = select(vec2f(sqrt(sin2_b), sqrt(max_f32(1.0 - sin2_b, 0.0))), vec2f(0.0, -1.0), is_inside);
	let cones = unpack2x16snorm(cluster.cones);
	let along = clamp_f32(dot(light_cluster__octahedral_vector(cluster.axis), w), -1.0, 1.0);
	let cos_w = select(along, abs(along), (cluster.child & types__LIGHT_TWO_SIDED) != 0u);
	let cos_x = light_cluster__cos_of_rest(vec2f(light_cluster__sine_of(cos_w), cos_w), vec2f(light_cluster__sine_of(cones.x), cones.x));
	let cos_p = light_cluster__cos_of_rest(vec2f(light_cluster__sine_of(cos_x), cos_x), b);
	var importance = select(max_f32(cos_p, light_cluster__SLACK), 0.0, cos_p + light_cluster__SLACK <= cones.y);
	if (any(n != vec3f(0.0))) {
		let cos_n = clamp_f32(-dot(n, w), -1.0, 1.0);
		let cos_i = light_cluster__cos_of_rest(vec2f(light_cluster__sine_of(cos_n), cos_n), b);
		importance *= select(max_f32(cos_i, light_cluster__SLACK), 0.0, cos_i + light_cluster__SLACK <= 0.0);
	}
	return min_f32(importance * cluster.power / nearest2, 1e30);
}

struct emissive_shape__ShapeSample {
	direction: vec3f,
	distance: f32,
	density: f32,
	area: f32,
	n: vec3f,
	surface: shading__Surface
}

fn emissive_shape__is_lamp_like(shape: types__PackedShape, instance: u32) -> bool {
	return shape.kind == types__SHAPE_RECTANGLE || (shape.kind == types__SHAPE_DISC && shape.size0 == 0.0) || (shape.kind == types__SHAPE_SPHERE && instance == types__NO_INSTANCE);
}

fn emissive_shape__has_others() -> bool {
	return (bindings__SHAPE_KINDS & (shape__BOXES | shape__CONES | shape__DISCS | shape__ELLIPSOIDS | shape__TORI)) != 0u || (bindings__HAS_INSTANCES && (bindings__SHAPE_KINDS & shape__SPHERES) != 0u);
}

fn emissive_shape__sample_of_shape(shape: types__PackedShape, instance: u32, p: vec3f, u: vec2f) -> emissive_shape__ShapeSample {
	var found: emissive_shape__ShapeSample;
	var part = 0.0;
	if (!emissive_shape__has_others() || emissive_shape__is_lamp_like(shape, instance)) {
		let light = emissive_shape__light_of(shape, instance);
		let toward = spherical_rectangle__solid_sample(light, p, u);
		found.direction = toward.direction;
		found.distance = toward.distance;
		found.density = toward.pdf;
		found.area = emissive_shape__area_of(light);
		found.n = light.direction;
		if (light.kind == types__LIGHT_SPHERE) {
			found.n = numeric__normalize_or(p + found.distance * found.direction - light.position, -found.direction);
		}
	}
	else {
		let place = shape_placement__placement_of(shape, instance);
		let areas = shape_placement__areas_of(shape, place);
		let drawn = shape_placement__point_of(shape, areas, u);
		let other = shape_placement__opposite(shape, drawn);
		let faces = shape_placement__faces_point(place, drawn, p);
		let other_faces = shape_placement__faces_point(place, other, p);
		let is_other = !faces && other_faces;
		let n = select(drawn.n, other.n, is_other);
		let across = place.across * n;
		let to_point = place.center + place.columns * select(drawn.p, other.p, is_other) - p;
		part = select(drawn.part, other.part, is_other);
		found.distance = length(to_point);
		found.direction = numeric__normalize_or(to_point, vec3f(0.0, 0.0, 1.0));
		found.n = numeric__normalize_or(across, -found.direction);
		found.area = areas.x + areas.y + areas.z;
		let density = select(1.0, 2.0, faces != other_faces) * drawn.density / max_f32(length(across), 1e-30);
		found.density = emissive_shape__density_toward(density, found.distance, dot(found.n, found.direction));
	}
	found.surface = emissive_shape__surface_of(shape, instance, p + found.distance * found.direction, part);
	return found;
}

fn emissive_shape__shape_density(hit: tracing__Hit, surface: shading__Surface, origin: vec3f, direction: vec3f, distance: f32) -> f32 {
	if (!bindings__HAS_EMISSIVE_SHAPES) {
		return 0.0;
	}
	let shape = fetch__load_shape(hit.primitive & ~types__SHAPE);
	if (shape.kind == types__SHAPE_PLANE || shape.kind == types__SHAPE_GLOBE) {
		return 0.0;
	}
	if (!emissive_shape__has_others() || emissive_shape__is_lamp_like(shape, hit.instance)) {
		let light = emissive_shape__light_of(shape, hit.instance);
		return emissive_shape__area_of(light) * spherical_rectangle__solid_density(light, origin, direction, distance);
	}
	let place = shape_placement__placement_of(shape, hit.instance);
	let areas = shape_placement__areas_of(shape, place);
	let point = shape_placement__point_at(shape, place, areas, surface.p, surface.ng, hit.b1);
	let faces = dot(direction, surface.ng) < 0.0;
	let other_faces = shape_placement__faces_point(place, shape_placement__opposite(shape, point), origin);
	let chance = select(1.0, select(0.0, 2.0, faces), faces != other_faces);
	let density = chance * point.density / max_f32(length(place.across * point.n), 1e-30);
	let all = areas.x + areas.y + areas.z;
	return select(0.0, all * emissive_shape__density_toward(density, distance, dot(direction, surface.ng)), numeric__is_finite(vec3f(all)));
}

fn emissive_shape__density_toward(density: f32, distance: f32, cosine: f32) -> f32 {
	return density * distance * distance / max_f32(abs(cosine), 1e-6);
}

fn emissive_shape__light_of(shape: types__PackedShape, instance: u32) -> types__PackedLight {
	var light: types__PackedLight;
	light.attenuation = types__ATTENUATION_INVERSE_SQUARE;
	light.position = shape.position;
	if (shape.kind == types__SHAPE_SPHERE) {
		light.kind = types__LIGHT_SPHERE;
		light.radius = shape.size0;
		return light;
	}
	light.kind = select(types__LIGHT_DISC, types__LIGHT_RECTANGLE, shape.kind == types__SHAPE_RECTANGLE);
	let place = shape_placement__placement_of(shape, instance);
	light.position = place.center;
	light.edge_u = place.columns[0];
	light.edge_v = place.columns[2];
	light.direction = numeric__normalize_or(place.across[1], vec3f(0.0, 1.0, 0.0));
	return light;
}

fn emissive_shape__area_of(light: types__PackedLight) -> f32 {
	if (light.kind == types__LIGHT_SPHERE) {
		return 4.0 * warp__PI * light.radius * light.radius;
	}
	return select(warp__PI, 4.0, light.kind == types__LIGHT_RECTANGLE) * length(cross(light.edge_u, light.edge_v));
}

fn emissive_shape__surface_of(shape: types__PackedShape, instance: u32, p: vec3f, part: f32) -> shading__Surface {
	var surface: shading__Surface;
	surface.p = p;
	surface.place = p;
	surface.material = shape.material;
	if (!bindings__HAS_TEXTURES) {
		return surface;
	}
	var q = p;
	if (bindings__HAS_INSTANCES && instance != types__NO_INSTANCE) {
		let own: types__PackedInstance = fetch__load_instance(instance);
		let space = instance__space_of(own);
		q = space.inverse * (p - space.translation);
		surface.place = instance__pattern_place(own, q);
	}
	if ((bindings__SHAPE_KINDS & shape__SPHERES) != 0u && shape.kind == types__SHAPE_SPHERE) {
		surface.uv = canonical__sphere_uv(numeric__normalize_or(q - shape.position, vec3f(0.0, 1.0, 0.0)));
	}
	else {
		surface.uv = shape__canonical_point(shape, q, part).uv;
	}
	surface.second_uv = surface.uv;
	return surface;
}

struct shape_placement__Placement {
	center: vec3f,
	columns: mat3x3f,
	across: mat3x3f
}

fn shape_placement__placement_of(shape: types__PackedShape, instance: u32) -> shape_placement__Placement {
	var place: shape_placement__Placement;
	place.center = shape.position;
	if ((bindings__SHAPE_KINDS & shape__SPHERES) != 0u && shape.kind == types__SHAPE_SPHERE) {
		place.columns = mat3x3f(vec3f(shape.size0, 0.0, 0.0), vec3f(0.0, shape.size0, 0.0), vec3f(0.0, 0.0, shape.size0));
	}
	else {
		let x = cross(shape.row_y, shape.row_z);
		let scale = 1.0 / dot(shape.row_x, x);
		place.columns = mat3x3f(scale * x, scale * cross(shape.row_z, shape.row_x), scale * cross(shape.row_x, shape.row_y));
	}
	if (bindings__HAS_INSTANCES && instance != types__NO_INSTANCE) {
		let space = instance__space_of(fetch__load_instance(instance));
		place.center = space.linear * place.center + space.translation;
		place.columns = space.linear * place.columns;
	}
	let columns = place.columns;
	let x = cross(columns[1], columns[2]);
	let side = select(-1.0, 1.0, dot(columns[0], x) > 0.0);
	place.across = mat3x3f(side * x, side * cross(columns[2], columns[0]), side * cross(columns[0], columns[1]));
	return place;
}

fn shape_placement__canonical_place(place: shape_placement__Placement, p: vec3f) -> vec3f {
	return ((p - place.center) * place.across) / dot(place.columns[0], place.across[0]);
}

fn shape_placement__faces_point(place: shape_placement__Placement, point: shape_sampling__ShapePoint, p: vec3f) -> bool {
	return dot(place.across * point.n, p - place.center - place.columns * point.p) > 0.0;
}

fn shape_placement__opposite(shape: types__PackedShape, point: shape_sampling__ShapePoint) -> shape_sampling__ShapePoint {
	var other = shape_sampling__ShapePoint(-point.p, -point.n, point.part, point.density);
	if ((bindings__SHAPE_KINDS & shape__BOXES) != 0u && shape.kind == types__SHAPE_BOX) {
		other.part = select(point.part + 3.0, point.part - 3.0, point.part > 2.5);
	}
	if ((bindings__SHAPE_KINDS & shape__CONES) != 0u && shape.kind == types__SHAPE_CONE) {
		let turn = select(vec3f(1.0), vec3f(-1.0, 1.0, -1.0), (shape.flags & types__SHAPE_CAPPED) != 0u);
		other.p = turn * point.p;
		other.n = turn * point.n;
	}
	if ((bindings__SHAPE_KINDS & shape__DISCS) != 0u && shape.kind == types__SHAPE_DISC) {
		other = point;
	}
	return other;
}

fn shape_placement__areas_of(shape: types__PackedShape, place: shape_placement__Placement) -> vec3f {
	let factors = vec3f(length(place.across[0]), length(place.across[1]), length(place.across[2]));
	var areas = vec3f(shape_sampling__ball_area(factors), 0.0, 0.0);
	if ((bindings__SHAPE_KINDS & shape__DISCS) != 0u && shape.kind == types__SHAPE_DISC) {
		areas.x = shape_sampling__ring_area(shape.size0, factors);
	}
	if ((bindings__SHAPE_KINDS & shape__BOXES) != 0u && shape.kind == types__SHAPE_BOX) {
		areas = shape_sampling__box_areas(factors);
	}
	if ((bindings__SHAPE_KINDS & shape__CONES) != 0u && shape.kind == types__SHAPE_CONE) {
		areas = shape_sampling__cone_areas(shape.size0, shape.size1, (shape.flags & types__SHAPE_CAPPED) != 0u, factors);
	}
	if ((bindings__SHAPE_KINDS & shape__TORI) != 0u && shape.kind == types__SHAPE_TORUS) {
		areas.x = shape_sampling__torus_area(shape.size0, factors);
	}
	return areas;
}

fn shape_placement__point_of(shape: types__PackedShape, areas: vec3f, u: vec2f) -> shape_sampling__ShapePoint {
	var point = shape_sampling__ball_point(u);
	if ((bindings__SHAPE_KINDS & shape__DISCS) != 0u && shape.kind == types__SHAPE_DISC) {
		point = shape_sampling__ring_point(shape.size0, u);
	}
	if ((bindings__SHAPE_KINDS & shape__BOXES) != 0u && shape.kind == types__SHAPE_BOX) {
		point = shape_sampling__box_side_point(areas, u);
	}
	if ((bindings__SHAPE_KINDS & shape__CONES) != 0u && shape.kind == types__SHAPE_CONE) {
		point = shape_sampling__cone_surface_point(shape.size0, shape.size1, areas, u);
	}
	if ((bindings__SHAPE_KINDS & shape__TORI) != 0u && shape.kind == types__SHAPE_TORUS) {
		point = shape_sampling__torus_surface_point(shape.size0, u);
	}
	return point;
}

fn shape_placement__point_at(shape: types__PackedShape, place: shape_placement__Placement, areas: vec3f, p: vec3f, ng: vec3f, part: f32) -> shape_sampling__ShapePoint {
	var n = numeric__normalize_or(ng * place.columns, vec3f(0.0, 1.0, 0.0));
	if ((bindings__SHAPE_KINDS & shape__BOXES) != 0u && shape.kind == types__SHAPE_BOX) {
		n = box__box_normal(part);
	}
	if ((bindings__SHAPE_KINDS & shape__CONES) != 0u && shape.kind == types__SHAPE_CONE && part > 0.5) {
		n = vec3f(0.0, select(-1.0, 1.0, part > 1.5), 0.0);
	}
	return shape_sampling__ShapePoint(shape_placement__canonical_place(place, p), n, part, shape_placement__density_of(shape, areas, part));
}

fn shape_placement__density_of(shape: types__PackedShape, areas: vec3f, part: f32) -> f32 {
	var density = shape_sampling__ball_density();
	if ((bindings__SHAPE_KINDS & shape__DISCS) != 0u && shape.kind == types__SHAPE_DISC) {
		density = shape_sampling__ring_density(shape.size0);
	}
	if ((bindings__SHAPE_KINDS & shape__BOXES) != 0u && shape.kind == types__SHAPE_BOX) {
		density = shape_sampling__box_density(areas, part);
	}
	if ((bindings__SHAPE_KINDS & shape__CONES) != 0u && shape.kind == types__SHAPE_CONE) {
		density = shape_sampling__cone_density(shape.size0, shape.size1, areas, part);
	}
	if ((bindings__SHAPE_KINDS & shape__TORI) != 0u && shape.kind == types__SHAPE_TORUS) {
		density = shape_sampling__torus_density(shape.size0);
	}
	return density;
}

const spherical_rectangle__LEAST_ANGLE: f32 = 0.02;

struct spherical_rectangle__RectangleView {
	x: vec3f,
	y: vec3f,
	z: vec3f,
	low: vec2f,
	high: vec2f,
	height: f32,
	angle: f32
}

struct spherical_rectangle__SolidSample {
	direction: vec3f,
	distance: f32,
	pdf: f32
}

fn spherical_rectangle__rectangle_view(to_center: vec3f, half_u: vec3f, half_v: vec3f) -> spherical_rectangle__RectangleView {
	let half = vec2f(length(half_u), length(half_v));
	let x = half_u / max_f32(half.x, 1e-30);
	let y = half_v / max_f32(half.y, 1e-30);
	let n = cross(x, y);
	let corner = to_center - half_u - half_v;
	let above = dot(corner, n);
	let low = vec2f(dot(corner, x), dot(corner, y));
	let opposite = to_center + half_u + half_v;
	let angle = abs(spherical_rectangle__triangle_angle(corner, corner + 2.0 * half_u, opposite)) + abs(spherical_rectangle__triangle_angle(corner, opposite, corner + 2.0 * half_v));
	let usable = abs(dot(x, y)) < 0.0001 && angle > spherical_rectangle__LEAST_ANGLE && abs(above) > 0.001 * min_f32(half.x, half.y);
	return spherical_rectangle__RectangleView(x, y, select(n, -n, above > 0.0), low, low + 2.0 * half, -abs(above), select(0.0, angle, usable));
}

fn spherical_rectangle__triangle_angle(to_a: vec3f, to_b: vec3f, to_c: vec3f) -> f32 {
	let up = vec3f(0.0, 0.0, 1.0);
	let a = numeric__normalize_or(to_a, up);
	let b = numeric__normalize_or(to_b, up);
	let c = numeric__normalize_or(to_c, up);
	return 2.0 * atan2(dot(a, cross(b, c)), 1.0 + dot(a, b) + dot(b, c) + dot(c, a));
}

fn spherical_rectangle__rectangle_point(view: spherical_rectangle__RectangleView, u: vec2f) -> vec3f {
	let z = view.height;
	let low = view.low * inverseSqrt(view.low * view.low + z * z);
	let high = view.high * inverseSqrt(view.high * view.high + z * z);
	let turn = u.x * view.angle + warp__PI - spherical_rectangle__arc_cosine(low.x * high.y) + spherical_rectangle__arc_cosine(low.x * low.y);
	let sine = sin(turn);
	let slope = (-cos(turn) * low.y - high.y) / select(sine, 1e-7, abs(sine) < 1e-7);
	let cosine = select(-1.0, 1.0, slope > 0.0) * inverseSqrt(max_f32(slope * slope + low.y * low.y, 1e-12));
	let bound = clamp_f32(cosine, -1.0, 1.0);
	let along = clamp_f32(-bound * z * inverseSqrt(max_f32(1.0 - bound * bound, 1e-12)), view.low.x, view.high.x);
	let distance2 = along * along + z * z;
	let ends = vec2f(view.low.y, view.high.y) * inverseSqrt(vec2f(distance2) + vec2f(view.low.y, view.high.y) * vec2f(view.low.y, view.high.y));
	let part = mix(ends.x, ends.y, u.y);
	let across = clamp_f32(part * sqrt(distance2) * inverseSqrt(max_f32(1.0 - part * part, 1e-12)), view.low.y, view.high.y);
	return along * view.x + across * view.y + z * view.z;
}

fn spherical_rectangle__arc_cosine(x: f32) -> f32 {
	return atan2(sqrt(max_f32((1.0 - x) * (1.0 + x), 0.0)), x);
}

fn spherical_rectangle__solid_sample(light: types__PackedLight, p: vec3f, u: vec2f) -> spherical_rectangle__SolidSample {
	if (light.kind == types__LIGHT_SPHERE) {
		let found = area_light__area_incident(light, p, u);
		return spherical_rectangle__SolidSample(found.direction, found.distance, area_light__area_density(light, p, found.direction, found.distance));
	}
	let center = light.position - p;
	var to_point: vec3f;
	var angle = 0.0;
	if (light.kind == types__LIGHT_RECTANGLE) {
		let view = spherical_rectangle__rectangle_view(center, light.edge_u, light.edge_v);
		let within = 2.0 * u - 1.0;
		angle = view.angle;
		to_point = center + within.x * light.edge_u + within.y * light.edge_v;
		if (angle > 0.0) {
			to_point = spherical_rectangle__rectangle_point(view, u);
		}
	}
	else {
		let within = warp__disc_from_square(u);
		to_point = center + within.x * light.edge_u + within.y * light.edge_v;
	}
	let distance = length(to_point);
	let direction = numeric__normalize_or(to_point, -light.direction);
	return spherical_rectangle__SolidSample(direction, distance, select(area_light__area_density(light, p, direction, distance), 1.0 / max_f32(angle, 1e-30), angle > 0.0));
}

fn spherical_rectangle__solid_density(light: types__PackedLight, p: vec3f, direction: vec3f, distance: f32) -> f32 {
	var angle = 0.0;
	if (light.kind == types__LIGHT_RECTANGLE) {
		angle = spherical_rectangle__rectangle_view(light.position - p, light.edge_u, light.edge_v).angle;
	}
	if (angle > 0.0) {
		return 1.0 / angle;
	}
	return area_light__area_density(light, p, direction, distance);
}

fn area_light__area_incident(light: types__PackedLight, p: vec3f, u: vec2f) -> shading__Incident {
	if (light.kind == types__LIGHT_SPHERE) {
		return area_light__sphere_incident(light, p, u);
	}
	return area_light__flat_incident(light, p, u);
}

fn area_light__area_density(light: types__PackedLight, p: vec3f, direction: vec3f, distance: f32) -> f32 {
	if (light.kind == types__LIGHT_SPHERE) {
		let to_center = light.position - p;
		let d2 = dot(to_center, to_center);
		let sin2 = light.radius * light.radius / max_f32(d2, 1e-30);
		let depth = select(sin2 / (1.0 + sqrt(max_f32(1.0 - sin2, 0.0))), 2.0, sin2 >= 1.0);
		return 1.0 / (2.0 * warp__PI * max_f32(depth, 1e-30));
	}
	let sides = length(cross(light.edge_u, light.edge_v));
	let area = select(warp__PI, 4.0, light.kind == types__LIGHT_RECTANGLE) * sides;
	return distance * distance / max_f32(area * abs(dot(direction, light.direction)), 1e-30);
}

fn area_light__flat_incident(light: types__PackedLight, p: vec3f, u: vec2f) -> shading__Incident {
	let within = select(warp__disc_from_square(u), 2.0 * u - 1.0, light.kind == types__LIGHT_RECTANGLE);
	let center = light.position - p;
	let to_light = center + within.x * light.edge_u + within.y * light.edge_v;
	let distance = length(to_light);
	let direction = numeric__normalize_or(to_light, -light.direction);
	let cos_light = -dot(direction, light.direction);
	let fading = max_f32(cos_light, 0.0) / max_f32(distance * distance, 1e-30);
	let strength = select(1.0, fading, light.attenuation == types__ATTENUATION_INVERSE_SQUARE);
	let reach = area_light__max_abs(light.position) + area_light__max_abs(p) + area_light__max_abs(light.edge_u) + area_light__max_abs(light.edge_v);
	let usable = distance > 1e-30;
	return shading__Incident(direction, area_light__short_of(distance, reach, abs(cos_light)), select(0.0, strength, usable) * light.color);
}

fn area_light__sphere_incident(light: types__PackedLight, p: vec3f, u: vec2f) -> shading__Incident {
	let to_center = light.position - p;
	let d2 = dot(to_center, to_center);
	let radius2 = light.radius * light.radius;
	let is_inside = d2 <= radius2;
	let d = sqrt(d2);
	let sin2 = radius2 / max_f32(max_f32(d2, radius2), 1e-30);
	let depth = select(sin2 / (1.0 + sqrt(max_f32(1.0 - sin2, 0.0))), 2.0, is_inside);
	let about = warp__cone_from_square(u, depth);
	let axis = numeric__normalize_or(to_center, vec3f(0.0, 0.0, 1.0));
	let direction = numeric__normalize_or(warp__turn_to(axis, about), axis);
	let chord = sqrt(max_f32(radius2 - d2 * dot(about.xy, about.xy), 0.0));
	let distance = d * about.z + select(-chord, chord, is_inside);
	let outside = 2.0 / ((1.0 + sqrt(max_f32(1.0 - sin2, 0.0))) * max_f32(d2, 1e-30));
	let fading = select(outside, 4.0 / max_f32(radius2, 1e-30), is_inside);
	let strength = select(1.0, fading, light.attenuation == types__ATTENUATION_INVERSE_SQUARE);
	let reach = area_light__max_abs(light.position) + area_light__max_abs(p) + light.radius;
	return shading__Incident(direction, area_light__short_of(distance, reach, chord / max_f32(light.radius, 1e-30)), strength * light.color);
}

fn area_light__short_of(distance: f32, reach: f32, cosine: f32) -> f32 {
	let slack = 32.0 * numeric__ROUNDING * reach / max_f32(cosine, 0.001);
	return max_f32(distance - min_f32(slack, 0.01 * distance), 0.0);
}

fn area_light__max_abs(v: vec3f) -> f32 {
	return max_f32(abs(v.x), max_f32(abs(v.y), abs(v.z)));
}

struct shape_sampling__ShapePoint {
	p: vec3f,
	n: vec3f,
	part: f32,
	density: f32
}

struct shape_sampling__ShapePart {
	index: u32,
	u: vec2f
}

fn shape_sampling__part_of(areas: vec3f, u: vec2f) -> shape_sampling__ShapePart {
	let ends = vec3f(areas.x, areas.x + areas.y, areas.x + areas.y + areas.z);
	let x = u.x * ends.z;
	let index = select(select(2u, 1u, x < ends.y), 0u, x < ends.x);
	let start = ends[index] - areas[index];
	return shape_sampling__ShapePart(index, vec2f(clamp_f32((x - start) / max_f32(areas[index], 1e-30), 0.0, 0.99999994), u.y));
}

fn shape_sampling__part_chance(areas: vec3f, index: u32) -> f32 {
	return areas[index] / max_f32(areas.x + areas.y + areas.z, 1e-30);
}

fn shape_sampling__ball_area(factors: vec3f) -> f32 {
	return 4.0 * warp__PI * sqrt(dot(factors, factors) / 3.0);
}

fn shape_sampling__ball_point(u: vec2f) -> shape_sampling__ShapePoint {
	let n = warp__cone_from_square(u, 2.0);
	return shape_sampling__ShapePoint(n, n, 0.0, shape_sampling__ball_density());
}

fn shape_sampling__ball_density() -> f32 {
	return 0.25 / warp__PI;
}

fn shape_sampling__ring_area(hole: f32, factors: vec3f) -> f32 {
	return warp__PI * (1.0 - hole * hole) * factors.y;
}

fn shape_sampling__ring_point(hole: f32, u: vec2f) -> shape_sampling__ShapePoint {
	let radius = sqrt(mix(hole * hole, 1.0, u.x));
	let angle = 2.0 * warp__PI * u.y;
	let p = vec3f(radius * cos(angle), 0.0, radius * sin(angle));
	return shape_sampling__ShapePoint(p, vec3f(0.0, 1.0, 0.0), 0.0, shape_sampling__ring_density(hole));
}

fn shape_sampling__ring_density(hole: f32) -> f32 {
	return 1.0 / (warp__PI * (1.0 - hole * hole));
}

fn shape_sampling__box_areas(factors: vec3f) -> vec3f {
	return 8.0 * factors;
}

fn shape_sampling__box_side_point(areas: vec3f, u: vec2f) -> shape_sampling__ShapePoint {
	let part = shape_sampling__part_of(areas, u);
	let is_upper = part.u.x >= 0.5;
	let sign = select(-1.0, 1.0, is_upper);
	let within = 2.0 * vec2f(2.0 * part.u.x - select(0.0, 1.0, is_upper), part.u.y) - 1.0;
	let is_axis = vec3<bool>(part.index == 0u, part.index == 1u, part.index == 2u);
	let place = vec3f(within.x, select(within.y, within.x, is_axis.x), within.y);
	let code = f32(part.index) + select(0.0, 3.0, is_upper);
	return shape_sampling__ShapePoint(select(place, vec3f(sign), is_axis), box__box_normal(code), code, shape_sampling__box_density(areas, code));
}

fn shape_sampling__box_density(areas: vec3f, part: f32) -> f32 {
	return 0.125 * shape_sampling__part_chance(areas, u32(part + 0.5) % 3u);
}

fn shape_sampling__cone_areas(bottom: f32, top: f32, is_capped: bool, factors: vec3f) -> vec3f {
	let slope = top - bottom;
	let squares = factors * factors;
	let side = (bottom + top) * sqrt(0.5 * (squares.x + squares.z) + slope * slope * squares.y);
	let ends = select(vec2f(0.0), vec2f(bottom * bottom, top * top), is_capped) * factors.y;
	return warp__PI * vec3f(side, ends);
}

fn shape_sampling__cone_surface_point(bottom: f32, top: f32, areas: vec3f, u: vec2f) -> shape_sampling__ShapePoint {
	let part = shape_sampling__part_of(areas, u);
	let density = shape_sampling__cone_density(bottom, top, areas, f32(part.index));
	if (part.index > 0u) {
		let is_top = part.index == 2u;
		let flat = select(bottom, top, is_top) * warp__disc_from_square(part.u);
		let n = vec3f(0.0, select(-1.0, 1.0, is_top), 0.0);
		return shape_sampling__ShapePoint(vec3f(flat.x, select(0.0, 1.0, is_top), flat.y), n, f32(part.index), density);
	}
	let radius = sqrt(mix(bottom * bottom, top * top, part.u.x));
	let y = part.u.x * (bottom + top) / max_f32(bottom + radius, 1e-30);
	let angle = 2.0 * warp__PI * part.u.y;
	let out = vec2f(cos(angle), sin(angle));
	let p = vec3f(radius * out.x, y, radius * out.y);
	return shape_sampling__ShapePoint(p, cone__cone_side_normal(out, top - bottom), 0.0, density);
}

fn shape_sampling__cone_density(bottom: f32, top: f32, areas: vec3f, part: f32) -> f32 {
	let slope = top - bottom;
	let index = u32(part + 0.5);
	let side = (bottom + top) * sqrt(1.0 + slope * slope);
	let size = vec3f(side, bottom * bottom, top * top);
	return shape_sampling__part_chance(areas, index) / max_f32(warp__PI * size[index], 1e-30);
}

fn shape_sampling__torus_area(minor: f32, factors: vec3f) -> f32 {
	let squares = factors * factors;
	return 4.0 * warp__PI * warp__PI * minor * sqrt(0.25 * (squares.x + squares.z) + 0.5 * squares.y);
}

fn shape_sampling__torus_surface_point(minor: f32, u: vec2f) -> shape_sampling__ShapePoint {
	let half = warp__PI * (u.y - 0.5);
	let outer = 0.5 * (1.0 + minor * cos(half));
	let is_outer = u.x < outer;
	let tube = select(-1.0, 1.0, is_outer) * vec2f(cos(half), sin(half));
	let along = select((u.x - outer) / max_f32(1.0 - outer, 1e-30), u.x / outer, is_outer);
	let out = vec2f(cos(2.0 * warp__PI * along), sin(2.0 * warp__PI * along));
	let ring = 1.0 + minor * tube.x;
	let p = vec3f(ring * out.x, minor * tube.y, ring * out.y);
	return shape_sampling__ShapePoint(p, vec3f(tube.x * out.x, tube.y, tube.x * out.y), 0.0, shape_sampling__torus_density(minor));
}

fn shape_sampling__torus_density(minor: f32) -> f32 {
	return 1.0 / (4.0 * warp__PI * warp__PI * minor);
}

struct coating__Coating {
	coat: f32,
	coat_axis: vec3f,
	coat_alpha: f32,
	sheen: vec3f,
	sheen_alpha: f32,
	below_coat: f32,
	left: f32,
	albedos: vec2f
}

fn coating__coating_at(layers: layers__Layers, wo: vec3f, coat_axis: vec3f) -> coating__Coating {
	let coat_alpha = max_f32(layers.coat_roughness * layers.coat_roughness, bsdf_ggx__SMOOTH);
	let sheen_alpha = max_f32(layers.sheen_roughness * layers.sheen_roughness, 0.001);
	let of_sheen = albedo__sheen_albedo(wo.z, sheen_alpha);
	let coat_albedo = layers.coat * coating__coat_reflectance(dot(wo, coat_axis), coat_alpha);
	let below_coat = 1.0 - coat_albedo;
	let sheen = (below_coat * select(of_sheen.y, 1.0, bindings__BSDF_SPEC)) * layers.sheen;
	return coating__Coating(layers.coat, coat_axis, coat_alpha, sheen, sheen_alpha, below_coat, below_coat * (1.0 - numeric__max_component(layers.sheen) * of_sheen.x), vec2f(coat_albedo, below_coat * of_sheen.x * dot(layers.sheen, tone__LUMINANCE_REC709)));
}

fn coating__coat_reflectance(cos_o: f32, alpha: f32) -> f32 {
	if (bindings__BSDF_SPEC) {
		return bsdf_coat__coat_fresnel(cos_o);
	}
	let albedo = albedo__ggx_albedo(cos_o, alpha);
	return bsdf_coat__COAT_F0 * albedo.x + albedo.y;
}

fn coating__through_coat(surface: shading__Surface, cosine: f32) -> f32 {
	if (!bindings__HAS_COATED_EMISSION) {
		return 1.0;
	}
	let own = material__load_layers(surface.material);
	var coat = own.coat;
	var roughness = own.coat_roughness;
	if (bindings__HAS_TEXTURES) {
		coat *= saturate_f32(layers__textured(own, types__SLOT_COAT, surface).x);
		roughness *= saturate_f32(layers__textured(own, types__SLOT_COAT_ROUGHNESS, surface).y);
	}
	return 1.0 - coat * coating__coat_reflectance(clamp_f32(cosine, 0.0, 1.0), max_f32(roughness * roughness, bsdf_ggx__SMOOTH));
}

fn coating__coating_eval(coating: coating__Coating, wo: vec3f, wi: vec3f) -> vec2f {
	let whole = bsdf_coat__coat_eval(coating__to_coat(coating, wo), coating__to_coat(coating, wi), coating.coat_alpha, bindings__BSDF_SPEC);
	return vec2f(coating.coat * whole.x, whole.y);
}

fn coating__coating_sample(coating: coating__Coating, wo: vec3f, u: vec2f, is_coat: bool) -> vec3f {
	var reflected = bsdf_coat__coat_sample(coating__to_coat(coating, wo), coating.coat_alpha, u);
	if (bindings__HAS_COAT_NORMALS) {
		reflected = warp__turn_to(coating.coat_axis, reflected);
	}
	return select(bsdf_sheen__sheen_sample(u), reflected, is_coat);
}

fn coating__to_coat(coating: coating__Coating, w: vec3f) -> vec3f {
	if (!bindings__HAS_COAT_NORMALS) {
		return w;
	}
	let x = warp__turn_to(coating.coat_axis, vec3f(1.0, 0.0, 0.0));
	let y = warp__turn_to(coating.coat_axis, vec3f(0.0, 1.0, 0.0));
	return vec3f(dot(w, x), dot(w, y), dot(w, coating.coat_axis));
}

const bsdf_coat__COAT_F0: f32 = 0.04;

fn bsdf_coat__coat_fresnel(cosine: f32) -> f32 {
	return mix(bsdf_coat__COAT_F0, 1.0, fresnel__schlick_weight(cosine));
}

fn bsdf_coat__coat_eval(wo: vec3f, wi: vec3f, alpha: f32, separable: bool) -> vec2f {
	let cos_h = dot(wo, numeric__normalize_or(wo + wi, wo));
	let white = bsdf_ggx__ggx_eval(wo, wi, vec2f(alpha), separable);
	return vec2f(bsdf_coat__coat_fresnel(select(cos_h, wo.z, separable)) * white.x, white.y);
}

fn bsdf_coat__coat_sample(wo: vec3f, alpha: f32, u: vec2f) -> vec3f {
	return fresnel__mirrored(-wo, bsdf_ggx__ggx_normal(wo, vec2f(alpha), u));
}

const albedo__ALBEDO_SIDE: u32 = 32u;

const albedo__GGX_ALBEDO: u32 = 0u;

const albedo__SHEEN_ALBEDO: u32 = 1024u;

const albedo__GLASS_ALBEDO: u32 = 2048u;

const albedo__GLASS_ROWS: u32 = 24u;

const albedo__GLASS_SLICES: u32 = 36u;

const albedo__GLASS_CLEAR: f32 = 12.0;

const albedo__STRETCHED_ALBEDO: u32 = 29696u;

const albedo__STRETCHED_SIZE: vec2u = vec2u(24u, 20u);

const albedo__STRETCHED_SLICES: vec2u = vec2u(14u, 5u);

struct albedo__AlbedoLookup {
	words: vec4u,
	weights: vec4f
}

fn albedo__entries_around(first: u32, size: vec2u, place: vec2f) -> albedo__AlbedoLookup {
	let last = vec2f(size - 1u);
	let cell = min_vec2f(floor(last * place), last - 1.0);
	let part = last * place - cell;
	let corner = first + u32(cell.y) * size.x + u32(cell.x);
	let of_rows = vec4f(vec2f(1.0 - part.y), vec2f(part.y));
	return albedo__AlbedoLookup(vec4u(corner, corner + 1u, corner + size.x, corner + size.x + 1u), of_rows * vec4f(1.0 - part.x, part.x, 1.0 - part.x, part.x));
}

fn albedo__facet_place(cos_o: f32, alpha: f32) -> vec2f {
	let c = clamp_f32(cos_o, 0.0, 1.0);
	let wide = 4.0 * clamp_f32(alpha, 0.0, 1.0);
	return sqrt(vec2f(c * (1.0 + wide) / max_f32(c + wide, 1e-9), 0.25 * wide));
}

fn albedo__ggx_lookup(cos_o: f32, alpha: f32) -> albedo__AlbedoLookup {
	return albedo__entries_around(albedo__GGX_ALBEDO, vec2u(albedo__ALBEDO_SIDE), albedo__facet_place(cos_o, alpha));
}

fn albedo__stretched_slice(wo: vec3f, alpha: vec2f) -> vec2f {
	let ratio = sqrt(alpha.y / alpha.x);
	let along = vec2f(abs(wo.x), ratio * sqrt(ratio) * abs(wo.y));
	let away_from_x = 1.0 - along.x / max_f32(length(along), 1e-9);
	return vec2f(albedo__STRETCHED_SLICES - 1u) * clamp_vec2f(vec2f(ratio, away_from_x), vec2f(0.0), vec2f(1.0));
}

fn albedo__stretched_lookup(slice: vec2u, wo: vec3f, alpha: vec2f) -> albedo__AlbedoLookup {
	let first = albedo__STRETCHED_ALBEDO + (slice.y * albedo__STRETCHED_SLICES.x + slice.x) * albedo__STRETCHED_SIZE.x * albedo__STRETCHED_SIZE.y;
	let flat = length(alpha * wo.xy) / alpha.x;
	let tangent = wo.z / max_f32(flat + length(vec2f(flat, wo.z)), 1e-9);
	let place = vec2f(albedo__facet_place(tangent, alpha.x).x, pow(clamp_f32(alpha.x, 0.0, 1.0), 2.0 / 3.0));
	return albedo__entries_around(first, albedo__STRETCHED_SIZE, place);
}

fn albedo__ggx_factors(entry: vec2f, cos_o: f32) -> vec2f {
	let grazing = clamp_f32(entry.x * fresnel__schlick_weight(cos_o) + 2.0 * entry.y - 1.0, 0.0, entry.x);
	return vec2f(entry.x - grazing, grazing);
}

fn albedo__sheen_lookup(cos_o: f32, alpha: f32) -> albedo__AlbedoLookup {
	let place = sqrt(sqrt(clamp_vec2f(vec2f(cos_o, alpha), vec2f(0.0), vec2f(1.0))));
	return albedo__entries_around(albedo__SHEEN_ALBEDO, vec2u(albedo__ALBEDO_SIDE), place);
}

fn albedo__glass_slice(eta: f32) -> f32 {
	let amplitude = (eta - 1.0) / (eta + 1.0);
	let steps = select(-albedo__GLASS_CLEAR, f32(albedo__GLASS_SLICES - 1u) - albedo__GLASS_CLEAR, amplitude > 0.0);
	return clamp_f32(albedo__GLASS_CLEAR + steps * sqrt(2.0 * abs(amplitude)), 0.0, f32(albedo__GLASS_SLICES - 1u));
}

fn albedo__glass_place(cos_o: f32, alpha: f32, eta: f32) -> vec2f {
	let width = clamp_f32(alpha, 1e-5, 1.0);
	let critical = sqrt(max_f32(1.0 - 1.0 / (eta * eta), 0.0));
	let c = vec3f(0.0, clamp_f32(cos_o, 0.0, 1.0), 1.0);
	let edge = asinh(1.5 * (c - vec3f(critical)) / width);
	let place = albedo__facet_place(cos_o, alpha);
	return vec2f(0.5 * (place.x + (edge.y - edge.x) / (edge.z - edge.x)), place.y);
}

fn albedo__glass_lookup(slice: u32, cos_o: f32, alpha: f32, eta: f32) -> albedo__AlbedoLookup {
	let first = albedo__GLASS_ALBEDO + slice * albedo__GLASS_ROWS * albedo__ALBEDO_SIDE;
	return albedo__entries_around(first, vec2u(albedo__ALBEDO_SIDE, albedo__GLASS_ROWS), albedo__glass_place(cos_o, alpha, eta));
}

fn albedo__glass_factors(entry: vec2f, cos_o: f32, alpha: f32, eta: f32) -> vec2f {
	let c = clamp_f32(cos_o, 0.0, 1.0);
	return vec2f(entry.x, clamp_f32(albedo__softened_fresnel(c, alpha, eta) + 2.0 * entry.y - 1.0, 0.0, 1.0));
}

fn albedo__softened_fresnel(cos_i: f32, alpha: f32, eta: f32) -> f32 {
	let smooth_cos2_t = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
	let soft = alpha * sqrt(max_f32(eta * eta - 1.0, 0.0));
	let cos2_t = clamp_f32(0.5 * (smooth_cos2_t + length(vec2f(smooth_cos2_t, soft))), 0.0, 1.0);
	return fresnel__unpolarised(sqrt(max_f32(1.0 - (1.0 - cos2_t) / (eta * eta), 0.0)), sqrt(cos2_t), eta);
}

fn albedo__blended_albedo(entries: vec4u, weights: vec4f) -> vec2f {
	return weights.x * picture__halves(entries.x) + weights.y * picture__halves(entries.y) + weights.z * picture__halves(entries.z) + weights.w * picture__halves(entries.w);
}

fn albedo__multiple_scattering(f0: vec3f, f90: vec3f, albedo: vec2f) -> vec3f {
	let single = clamp_f32(albedo.x + albedo.y, 0.001, 1.0);
	let leaves = sqrt(single);
	let kept = clamp_vec3f(f0 + (f90 - f0) / 21.0, vec3f(0.0), vec3f(1.0));
	return 1.0 + kept * (leaves * (1.0 - single) / single) / (1.0 - kept * (1.0 - leaves));
}

struct light_weight__Sender {
	p: vec3f,
	n: vec3f,
	pdf: f32
}

fn light_weight__emission_weight(batch: dispatch__Batch, surface: shading__Surface, hit: tracing__Hit, sender: light_weight__Sender, direction: vec3f) -> f32 {
	if (!(bindings__HAS_AREA_LIGHTS || bindings__HAS_EMITTERS) || sender.pdf <= 0.0 || section__is_cap(hit)) {
		return 1.0;
	}
	let distance = distance(sender.p, surface.p);
	let glow = material__load_glow(surface.material);
	let is_lamp = bindings__HAS_AREA_LIGHTS && glow.light != types__NONE;
	if (!is_lamp && glow.luminance <= 0.0) {
		return 1.0;
	}
	var density = 0.0;
	var chance = 0.0;
	var trail = 0u;
	var counts = true;
	if (is_lamp) {
		let light = shutter__shutter_light(glow.light, batch.light_count);
		density = spherical_rectangle__solid_density(light, sender.p, direction, distance);
		chance = light.chance;
		trail = light.place;
		counts = light_weight__can_be_hit(light);
	}
	else if (bindings__HAS_EMITTERS) {
		density = light_weight__emitter_density(surface, hit, sender.p, direction, distance);
		chance = 1.0 / batch.emitter_power;
		var luminance = glow.luminance;
		if (bindings__HAS_LIGHT_TREE || bindings__HAS_EMITTER_GLOWS) {
			let own = light_weight__emitter_of(batch, hit.primitive, hit.instance);
			trail = own.trail;
			luminance = select(light_weight__emitter_glow(own.index, glow), 0.0, own.index == types__NONE);
		}
		density *= luminance;
	}
	if (bindings__HAS_LIGHT_TREE && density > 0.0) {
		let leaf = light_tree__leaf_at(batch, trail, sender.p, sender.n);
		chance = (1.0 - batch.environment_share) * select(light_choice__emitter_rate(leaf.chance, leaf.power), leaf.chance, is_lamp);
	}
	density = select(0.0, density * chance, counts);
	record_path__record_light_density(density);
	return select(0.0, mis__power_heuristic(sender.pdf, density), counts);
}

fn light_weight__emitter_density(surface: shading__Surface, hit: tracing__Hit, origin: vec3f, direction: vec3f, distance: f32) -> f32 {
	if ((hit.primitive & types__SHAPE) != 0u) {
		return emissive_shape__shape_density(hit, surface, origin, direction, distance);
	}
	return distance * distance / max_f32(abs(dot(direction, surface.ng)), 1e-30);
}

fn light_weight__can_be_hit(light: types__PackedLight) -> bool {
	return light.visible != 0u && light.attenuation == types__ATTENUATION_INVERSE_SQUARE;
}

fn light_weight__emitter_glow(index: u32, of_material: material__Glow) -> f32 {
	if (!bindings__HAS_EMITTER_GLOWS) {
		return of_material.luminance;
	}
	return fetch__load_emitter_glow(select(index, 0u, index == types__NONE));
}

struct light_weight__FoundEmitter {
	index: u32,
	trail: u32
}

fn light_weight__emitter_of(batch: dispatch__Batch, primitive: u32, instance: u32) -> light_weight__FoundEmitter {
	var low = 0u;
	var high = batch.emitter_count - 1u;
	loop {
		let middle = (low + high) / 2u;
		let emitter = fetch__load_emitter(middle);
		let is_below = emitter.instance < instance || (emitter.instance == instance && emitter.primitive < primitive);
		low = select(low, min(middle + 1u, high), is_below);
		high = select(middle, high, is_below);
		continuing {
		
			break if low >= high;
		}
	}
	loops__cut_off |= low < high;
	let found = fetch__load_emitter(low);
	let is_it = found.instance == instance && found.primitive == primitive;
	return light_weight__FoundEmitter(select(types__NONE, low, is_it), found.trail);
}

fn light__spot_falloff(cos_angle: f32, cos_inner: f32, cos_outer: f32) -> f32 {
	let x = clamp_f32((cos_angle - cos_outer) / max_f32(cos_inner - cos_outer, 1e-6), 0.0, 1.0);
	return x * x * (3.0 - 2.0 * x);
}

fn light__incident(light: types__PackedLight, p: vec3f) -> shading__Incident {
	let to_light = light.position - p;
	let distance = length(to_light);
	let is_directional = light.kind == types__LIGHT_DIRECTIONAL;
	let direction = select(numeric__normalize_or(to_light, -light.direction), -light.direction, is_directional);
	var strength = select(0.0, 1.0, is_directional || distance > 1e-30);
	if (light.attenuation == types__ATTENUATION_INVERSE_SQUARE) {
		strength /= max_f32(distance * distance, 1e-30);
	}
	if (light.kind == types__LIGHT_SPOT) {
		strength *= light__spot_falloff(-dot(direction, light.direction), light.cos_inner, light.cos_outer);
	}
	return shading__Incident(direction, select(distance, camera__T_FAR, is_directional), strength * light.color);
}

fn direct__shadow_ray(surface: shading__Surface, arriving: shading__Incident) -> tracing__Ray {
	var ray = leaving__leaving_ray(surface, arriving.direction, arriving.distance);
	ray.t_max = max_f32(arriving.distance - dot(ray.origin - surface.p, arriving.direction), 0.0);
	return ray;
}

struct bsdf__BsdfValue {
	value: vec3f,
	pdf: f32
}

struct bsdf__BsdfSample {
	direction: vec3f,
	weight: vec3f,
	pdf: f32
}

struct bsdf__Draw {
	wi: vec3f,
	is_on_side: bool,
	is_smooth: bool,
	fraction: vec3f
}

fn bsdf__receiving_normal(bsdf: lobes__Bsdf) -> vec3f {
	let passes = (bindings__HAS_ROUGH_GLASS && bindings__HAS_REFRACTION && bsdf__has_rough_boundary(bsdf)) || (bindings__HAS_COATINGS && any(bsdf.through > vec3f(0.0)));
	let normal = select(bsdf.normal, bsdf.ng, bindings__HAS_COAT_NORMALS && bsdf.coating.coat > 0.0);
	return select(normal, vec3f(0.0), passes);
}

fn bsdf__bsdf_eval(bsdf: lobes__Bsdf, direction: vec3f) -> bsdf__BsdfValue {
	let wi = lobes__to_frame(bsdf, direction);
	var value = vec3f(0.0);
	var pdf = 0.0;
	if (wi.z > 0.0) {
		let diffuse = bsdf_diffuse__diffuse_eval(wi);
		let cos_h = dot(bsdf.wo, normalize(bsdf.wo + wi));
		value = (diffuse * lobes__below_glossy(bsdf, cos_h)) * bsdf.diffuse;
		pdf = bsdf.chances.x * (1.0 - bsdf__through_share(bsdf)) * diffuse;
		if (bindings__HAS_GLOSS) {
			let glossy = bsdf_ggx__ggx_eval(bsdf.wo, wi, bsdf.alpha, bindings__BSDF_SPEC);
			value += glossy.x * (bsdf.gain * lobes__glossy_fresnel(bsdf, cos_h));
			pdf += bsdf.chances.y * glossy.y;
		}
		if (bindings__HAS_COATINGS) {
			let sheen = bsdf_sheen__sheen_eval(bsdf.wo, wi, bsdf.coating.sheen_alpha);
			value += sheen.x * bsdf.coating.sheen;
			pdf += bsdf.coating_chances.y * sheen.y;
		}
	}
	if (bindings__HAS_ROUGH_GLASS && bsdf__has_rough_boundary(bsdf)) {
		let boundary = bsdf_boundary__boundary_eval(bsdf.boundary, bsdf.wo, wi, bindings__BSDF_SPEC);
		value += boundary.value;
		pdf += bsdf.chances.z * boundary.pdf;
	}
	if (bindings__HAS_COATINGS && wi.z < 0.0) {
		let through = bsdf_diffuse__diffuse_eval(-wi);
		value += through * bsdf.through;
		pdf += bsdf.chances.x * bsdf__through_share(bsdf) * through;
	}
	let is_outside = dot(direction, bsdf.ng) > 0.0;
	value = select(vec3f(0.0), value, is_outside == (wi.z > 0.0));
	if (bindings__HAS_COATINGS) {
		let coat = coating__coating_eval(bsdf.coating, bsdf.wo, wi);
		value += select(0.0, coat.x, is_outside);
		pdf += bsdf.coating_chances.x * coat.y;
	}
	return bsdf__BsdfValue(value, pdf);
}

fn bsdf__bsdf_sample(bsdf: lobes__Bsdf, choice: f32, u: vec2f) -> bsdf__BsdfSample {
	let chances = bsdf.chances;
	let first = chances.x + chances.y + bsdf.coating_chances.x + bsdf.coating_chances.y;
	var draw: bsdf__Draw;
	if ((bindings__HAS_REFLECTION || bindings__HAS_REFRACTION) && choice >= first && chances.z > 0.0) {
		record_path__record_lobe(types__LOBE_BOUNDARY);
		draw = bsdf__boundary_draw(bsdf, clamp_f32((choice - first) / chances.z, 0.0, 1.0), u);
	}
	else {
		draw = bsdf__lobe_draw(bsdf, choice, u);
	}
	let direction = lobes__from_frame(bsdf, draw.wi);
	if ((bindings__HAS_REFLECTION || bindings__HAS_REFRACTION) && draw.is_smooth) {
		let stays = (dot(direction, bsdf.ng) > 0.0) == draw.is_on_side;
		return bsdf__BsdfSample(direction, select(vec3f(0.0), draw.fraction / chances.z, stays), 0.0);
	}
	let found = bsdf__bsdf_eval(bsdf, direction);
	let weight = select(vec3f(0.0), found.value / max_f32(found.pdf, 1e-30), draw.is_on_side);
	return bsdf__BsdfSample(direction, weight, found.pdf);
}

fn bsdf__boundary_draw(bsdf: lobes__Bsdf, choice: f32, u: vec2f) -> bsdf__Draw {
	if (!bindings__HAS_ROUGH_GLASS) {
		let drawn = bsdf_boundary__smooth_boundary_sample(bsdf.boundary, bsdf.wo, choice);
		return bsdf__Draw(drawn.wi, drawn.reflects, true, drawn.fraction);
	}
	let drawn = bsdf_boundary__boundary_sample(bsdf.boundary, bsdf.wo, choice, u, bindings__BSDF_SPEC);
	let is_on_side = select((drawn.wi.z > 0.0) == drawn.reflects, drawn.reflects, drawn.is_smooth);
	return bsdf__Draw(drawn.wi, is_on_side, drawn.is_smooth, drawn.fraction);
}

fn bsdf__has_rough_boundary(bsdf: lobes__Bsdf) -> bool {
	return bsdf.chances.z > 0.0 && bsdf.boundary.alpha.x >= bsdf_ggx__SMOOTH;
}

fn bsdf__lobe_draw(bsdf: lobes__Bsdf, choice: f32, u: vec2f) -> bsdf__Draw {
	let chances = bsdf.chances;
	let is_diffuse = choice < chances.x;
	let is_glossy = !is_diffuse && choice < chances.x + chances.y;
	record_path__record_lobe(select(types__LOBE_GLOSSY, types__LOBE_DIFFUSE, is_diffuse));
	var wi = bsdf_diffuse__diffuse_sample(u);
	if (bindings__HAS_GLOSS && !is_diffuse) {
		wi = fresnel__mirrored(-bsdf.wo, bsdf_ggx__ggx_normal(bsdf.wo, bsdf.alpha, u));
	}
	var is_on_side = wi.z > 0.0;
	if (bindings__HAS_COATINGS) {
		if (!is_diffuse && !is_glossy) {
			let is_coat = choice < chances.x + chances.y + bsdf.coating_chances.x;
			record_path__record_lobe(select(types__LOBE_SHEEN, types__LOBE_COAT, is_coat));
			wi = coating__coating_sample(bsdf.coating, bsdf.wo, u, is_coat);
			is_on_side = select(wi.z, coating__to_coat(bsdf.coating, wi).z, is_coat) > 0.0;
		}
		let passes = is_diffuse && choice < chances.x * bsdf__through_share(bsdf);
		wi.z = select(wi.z, -wi.z, passes);
	}
	return bsdf__Draw(wi, is_on_side, false, vec3f(0.0));
}

fn bsdf__through_share(bsdf: lobes__Bsdf) -> f32 {
	if (!bindings__HAS_COATINGS) {
		return 0.0;
	}
	let through = dot(bsdf.through, tone__LUMINANCE_REC709);
	return through / max_f32(through + dot(bsdf.diffuse, tone__LUMINANCE_REC709), 1e-30);
}

fn dispersion__load_dispersion(material: u32) -> f32 {
	let own = select(material, 0u, material == types__NONE);
	let row = rows__material_row(types__MATERIAL_ROWS * own + types__LAYERS_ROW + 5u);
	return select(bitcast<f32>(row.z), 0.0, material == types__NONE);
}

fn dispersion__colored(path: path__Path, met: interface__Interface) -> path__Path {
	let disperses = met.encloses && met.is_boundary && max_f32(dispersion__load_dispersion(met.here), dispersion__load_dispersion(medium__dominant(met.media))) > 0.0;
	if (!disperses || path.channel != path__ALL_CHANNELS) {
		return path;
	}
	var one = path;
	one.channel = min(u32(3.0 * path__random_1d(path, dimensions__CHANNEL_CHOICE)), 2u);
	one.throughput *= select(vec3f(0.0), vec3f(3.0), vec3u(0u, 1u, 2u) == vec3u(one.channel));
	return one;
}

fn dispersion__dispersed(met: interface__Interface, channel: u32) -> interface__Interface {
	if (channel == path__ALL_CHANNELS) {
		return met;
	}
	let wavelength = select(select(dispersion__WAVELENGTHS.z, dispersion__WAVELENGTHS.y, channel == 1u), dispersion__WAVELENGTHS.x, channel == 0u);
	let front = dispersion__load_dispersion(met.here);
	let behind = dispersion__load_dispersion(medium__dominant(met.media));
	var one = met;
	one.ior = select(met.ior, dispersion__dispersed_ior(met.ior, front, wavelength), front > 0.0);
	one.ior_behind = select(met.ior_behind, dispersion__dispersed_ior(met.ior_behind, behind, wavelength), met.encloses && behind > 0.0);
	return one;
}

struct lobes__Bsdf {
	normal: vec3f,
	x: vec3f,
	y: vec3f,
	ng: vec3f,
	wo: vec3f,
	metallic: f32,
	diffuse: vec3f,
	f0: vec3f,
	f90: vec3f,
	gain: vec3f,
	alpha: vec2f,
	boundary: bsdf_boundary__BoundaryLobe,
	encloses: bool,
	through: vec3f,
	over_f0: vec3f,
	over_f90: vec3f,
	film: vec3f,
	base_f0: vec3f,
	coating: coating__Coating,
	chances: vec3f,
	coating_chances: vec2f
}

fn lobes__bsdf_at(surface: shading__Surface, optics: shading__Optics, layers: layers__Layers, met: interface__Interface, direction: vec3f) -> lobes__Bsdf {
	var bsdf: lobes__Bsdf;
	bsdf.ng = select(surface.ng, -surface.ng, dot(surface.ng, direction) > 0.0);
	let n = select(surface.n, -surface.n, dot(surface.n, bsdf.ng) < 0.0);
	bsdf.normal = select(bsdf.ng, n, dot(n, direction) < -0.001);
	bsdf.x = warp__turn_to(bsdf.normal, vec3f(1.0, 0.0, 0.0));
	bsdf.y = warp__turn_to(bsdf.normal, vec3f(0.0, 1.0, 0.0));
	let width = max_f32(layers.alpha, bsdf_ggx__SMOOTH);
	bsdf.alpha = vec2f(width);
	var stretch = vec2f(1.0);
	if (bindings__HAS_ANISOTROPY && surface.tangent.w != 0.0 && layers.anisotropy > 0.0) {
		let bitangent = surface.tangent.w * cross(surface.n, surface.tangent.xyz);
		let along = layers.along.x * surface.tangent.xyz + layers.along.y * bitangent;
		bsdf.x = numeric__normalize_or(along - dot(along, bsdf.normal) * bsdf.normal, bsdf.x);
		bsdf.y = cross(bsdf.normal, bsdf.x);
		bsdf.alpha = dispersion__anisotropic_alpha(width, layers.anisotropy);
		stretch = bsdf.alpha / width;
	}
	bsdf.wo = lobes__to_frame(bsdf, -direction);
	bsdf.metallic = layers.metallic;
	var seen = bsdf_boundary__Split();
	var inside = 1.0;
	if (bindings__HAS_REFLECTION || bindings__HAS_REFRACTION) {
		inside = select(0.0, 1.0, met.is_boundary);
		bsdf.encloses = met.encloses;
		bsdf.boundary = lobes__boundary_lobe(layers, optics, met, stretch);
		seen = bsdf_boundary__boundary_split(bsdf.boundary, bsdf.wo.z);
	}
	bsdf.f0 = inside * layers.f0;
	bsdf.f90 = inside * layers.f90;
	var over = layers.over_f0;
	bsdf.over_f0 = over;
	bsdf.over_f90 = layers.over_f90;
	if (bindings__HAS_COATINGS) {
		bsdf.film = vec3f(layers.film, layers.film_ior, layers.film_thickness);
		bsdf.base_f0 = bsdf.f0;
		let film = lobes__film_f0_at(layers, bsdf.f0, bsdf.wo.z);
		bsdf.f0 = mix(bsdf.f0, inside * film, layers.film);
		over = mix(over, film, layers.film * numeric__max_component(layers.over_f90));
	}
	let gloss = gloss__gloss_at(layers, bsdf.f0, bsdf.f90, over, inside, bsdf.wo, bsdf.alpha);
	if (bindings__HAS_ROUGH_GLASS && !bindings__BSDF_SPEC && bsdf.boundary.alpha.x >= bsdf_ggx__SMOOTH) {
		let glass = albedo__glass_albedo(bsdf.wo.z, sqrt(bsdf.alpha.x * bsdf.alpha.y), bsdf.boundary.eta);
		let wall = max_f32(gloss.albedo.x + gloss.albedo.y, 0.001);
		let share = select(min_f32(glass.x * glass.y / wall, 1.0), glass.y, bsdf.boundary.bends);
		bsdf.boundary.gain = 1.0 / select(wall, max_f32(glass.x, 0.001), bsdf.boundary.bends);
		seen.reflect = share * bsdf.boundary.reflect;
		seen.transmit = (1.0 - share) * bsdf.boundary.transmit;
	}
	var left = 1.0 - numeric__max_component(gloss.over);
	if ((optics.flags & types__MATERIAL_SUM) == 0u) {
		left *= optics.opacity * (1.0 - lobes__beside_metal(bsdf, seen.reflect));
	}
	bsdf.diffuse = (inside * max_f32(left, 0.0)) * layers.diffuse;
	let whole = select(bsdf.diffuse, inside * layers.diffuse, bindings__BSDF_SPEC && (optics.flags & types__MATERIAL_METALLIC_ROUGHNESS) != 0u);
	var scale = 1.0 / max_f32(numeric__max_component(bsdf.diffuse + gloss.whole + seen.reflect + seen.transmit), 1.0);
	if (bindings__HAS_COATINGS) {
		bsdf.coating = coating__coating_at(layers, bsdf.wo, lobes__coat_axis(bsdf, surface));
		bsdf.coating.albedos *= inside;
		scale *= mix(1.0, bsdf.coating.left, inside);
		bsdf.through = scale * layers.diffuse_transmission * whole * layers.diffuse_transmission_color;
		bsdf.diffuse = whole * (1.0 - layers.diffuse_transmission);
	}
	else {
		bsdf.diffuse = whole;
	}
	bsdf.diffuse *= scale;
	bsdf.gain = scale * gloss.boost;
	bsdf.boundary.reflect *= scale;
	bsdf.boundary.transmit *= scale;
	let weights = vec3f(dot(bsdf.diffuse + bsdf.through, tone__LUMINANCE_REC709), scale * dot(gloss.whole, tone__LUMINANCE_REC709), scale * dot(seen.reflect + seen.transmit, tone__LUMINANCE_REC709));
	let total = max_f32(weights.x + weights.y + weights.z + bsdf.coating.albedos.x + bsdf.coating.albedos.y, 1e-30);
	bsdf.chances = weights / total;
	bsdf.coating_chances = bsdf.coating.albedos / total;
	return bsdf;
}

fn lobes__boundary_lobe(layers: layers__Layers, optics: shading__Optics, met: interface__Interface, stretch: vec2f) -> bsdf_boundary__BoundaryLobe {
	let eta = met.ior / select(layers.ior, met.ior_behind, met.encloses);
	let scatters = met.is_boundary && !(met.encloses && abs(eta - 1.0) < 0.0001);
	var flags = select(0u, layers.fresnel | (optics.flags & types__MATERIAL_SUM), met.is_boundary);
	if (bindings__BSDF_SPEC && flags == types__MATERIAL_FRESNEL) {
		flags |= types__MATERIAL_SCHLICK;
	}
	return bsdf_boundary__BoundaryLobe(select(vec3f(0.0), layers.reflect, met.is_boundary), select(vec3f(1.0), layers.transmit, met.is_boundary), select(0.0, layers.boundary_alpha, scatters) * stretch, 1.0, eta, met.is_boundary && met.encloses, flags);
}

fn lobes__beside_metal(bsdf: lobes__Bsdf, reflected: vec3f) -> f32 {
	return min_f32(numeric__max_component(reflected) / max_f32(1.0 - bsdf.metallic, 1e-6), 1.0);
}

fn lobes__coat_axis(bsdf: lobes__Bsdf, surface: shading__Surface) -> vec3f {
	let up = vec3f(0.0, 0.0, 1.0);
	if (!bindings__HAS_COAT_NORMALS) {
		return up;
	}
	let own = lobes__to_frame(bsdf, select(surface.coat_n, -surface.coat_n, dot(surface.coat_n, bsdf.ng) < 0.0));
	return select(up, own, dot(own, bsdf.wo) > 0.001);
}

fn lobes__film_f0_at(layers: layers__Layers, base_f0: vec3f, cos_o: f32) -> vec3f {
	let grazing = min_f32(fresnel__schlick_weight(cos_o), 0.999);
	let film = thin_film__thin_film(cos_o, 1.0, layers.film_ior, layers.film_thickness, min_vec3f(base_f0, vec3f(1.0)));
	return clamp_vec3f((film - grazing) / (1.0 - grazing), vec3f(0.0), vec3f(1.0));
}

fn lobes__glossy_fresnel(bsdf: lobes__Bsdf, cos_h: f32) -> vec3f {
	if (bindings__HAS_COATINGS) {
		let bare = fresnel__schlick_between(bsdf.base_f0, bsdf.f90, cos_h);
		if (bsdf.film.x > 0.0) {
			let film = thin_film__thin_film(clamp_f32(cos_h, 0.0, 1.0), 1.0, bsdf.film.y, bsdf.film.z, min_vec3f(bsdf.base_f0, vec3f(1.0)));
			return mix(bare, film, bsdf.film.x);
		}
		return bare;
	}
	return fresnel__schlick_between(bsdf.f0, bsdf.f90, cos_h);
}

fn lobes__below_glossy(bsdf: lobes__Bsdf, cos_h: f32) -> f32 {
	if (!bindings__BSDF_SPEC) {
		return 1.0;
	}
	var left = 1.0 - numeric__max_component(fresnel__schlick_between(bsdf.over_f0, bsdf.over_f90, cos_h));
	if (bindings__HAS_REFLECTION || bindings__HAS_REFRACTION) {
		left *= 1.0 - lobes__beside_metal(bsdf, bsdf_boundary__boundary_split(bsdf.boundary, cos_h).reflect);
	}
	return left;
}

fn lobes__to_frame(bsdf: lobes__Bsdf, direction: vec3f) -> vec3f {
	return vec3f(dot(direction, bsdf.x), dot(direction, bsdf.y), dot(direction, bsdf.normal));
}

fn lobes__from_frame(bsdf: lobes__Bsdf, w: vec3f) -> vec3f {
	return w.x * bsdf.x + w.y * bsdf.y + w.z * bsdf.normal;
}

const bsdf_boundary__MOST_REDRAWS: u32 = 64u;

struct bsdf_boundary__BoundaryLobe {
	reflect: vec3f,
	transmit: vec3f,
	alpha: vec2f,
	gain: f32,
	eta: f32,
	bends: bool,
	flags: u32
}

struct bsdf_boundary__Split {
	reflect: vec3f,
	transmit: vec3f,
	reflectance: f32,
	cos_t: f32
}

struct bsdf_boundary__BoundarySample {
	wi: vec3f,
	reflects: bool,
	is_smooth: bool,
	fraction: vec3f
}

struct bsdf_boundary__Facet {
	wi: vec3f,
	reflects: bool,
	split: bsdf_boundary__Split,
	chance: f32
}

struct bsdf_boundary__BoundaryValue {
	value: vec3f,
	pdf: f32
}

fn bsdf_boundary__boundary_split(lobe: bsdf_boundary__BoundaryLobe, cos_i: f32) -> bsdf_boundary__Split {
	let boundary = fresnel__boundary_at(lobe.flags, clamp_f32(cos_i, 0.0, 1.0), lobe.eta);
	var split = bsdf_boundary__Split(lobe.reflect, lobe.transmit, boundary.reflectance, boundary.cos_t);
	if ((lobe.flags & types__MATERIAL_FRESNEL) != 0u) {
		split.reflect *= boundary.reflectance;
		split.transmit *= 1.0 - boundary.reflectance;
	}
	else if (boundary.total && lobe.bends) {
		split.reflect += select(lobe.transmit, vec3f(0.0), (lobe.flags & types__MATERIAL_SUM) != 0u);
		split.transmit = vec3f(0.0);
	}
	return split;
}

fn bsdf_boundary__boundary_eval(lobe: bsdf_boundary__BoundaryLobe, wo: vec3f, wi: vec3f, separable: bool) -> bsdf_boundary__BoundaryValue {
	let upper = vec3f(wi.xy, abs(wi.z));
	var facets = bsdf_ggx__ggx_eval(wo, upper, lobe.alpha, separable);
	var h = numeric__normalize_or(wo + upper, wo);
	if (wi.z <= 0.0 && lobe.bends) {
		facets = bsdf_ggx_transmission__ggx_transmission(wo, wi, lobe.alpha, lobe.eta);
		h = bsdf_ggx_transmission__transmission_half(wo, wi, lobe.eta);
	}
	let split = bsdf_boundary__boundary_split(lobe, dot(wo, h));
	let reflected = bsdf_boundary__rough_chance(lobe, split, separable);
	let chance = select(1.0 - reflected, reflected, wi.z > 0.0);
	let fraction = select(split.transmit, split.reflect, wi.z > 0.0);
	let density = select(facets.x * lobe.gain, facets.y, separable);
	return bsdf_boundary__BoundaryValue((facets.x * lobe.gain) * fraction, chance * density);
}

fn bsdf_boundary__boundary_sample(lobe: bsdf_boundary__BoundaryLobe, wo: vec3f, choice: f32, u: vec2f, separable: bool) -> bsdf_boundary__BoundarySample {
	let is_smooth = lobe.alpha.x < bsdf_ggx__SMOOTH;
	let alpha = max_vec2f(lobe.alpha, vec2f(bsdf_ggx__SMOOTH));
	let up = vec3f(0.0, 0.0, 1.0);
	var numbers = vec3f(choice, u);
	var key = rng__hash_combine(bitcast<u32>(choice), rng__hash_combine(bitcast<u32>(u.x), bitcast<u32>(u.y)));
	var draws = select(1u, 1u + bsdf_boundary__MOST_REDRAWS, !separable && !is_smooth);
	var facet: bsdf_boundary__Facet;
	loop {
		let h = select(bsdf_ggx__ggx_normal(wo, alpha, numbers.yz), up, is_smooth);
		let split = bsdf_boundary__boundary_split(lobe, dot(wo, h));
		let chance = select(bsdf_boundary__rough_chance(lobe, split, separable), bsdf_boundary__smooth_chance(split), is_smooth);
		facet = bsdf_boundary__facet_at(lobe, wo, h, split, chance, numbers.x);
		let is_found = rng__unit_float(key) < bsdf_boundary__unshadowed(lobe, wo, facet, alpha);
		draws = select(draws - 1u, 0u, is_found);
		let fresh = vec3u(rng__hash(key ^ 1757159915u), rng__hash(key ^ 48610963u), rng__hash(key ^ 2524612763u));
		numbers = vec3f(rng__unit_float(fresh.x), rng__unit_float(fresh.y), rng__unit_float(fresh.z));
		key = rng__hash_combine(key, fresh.x);
		continuing {
		
			break if draws == 0u;
		}
	}
	return bsdf_boundary__BoundarySample(facet.wi, facet.reflects, is_smooth, bsdf_boundary__fraction_of(facet));
}

fn bsdf_boundary__smooth_boundary_sample(lobe: bsdf_boundary__BoundaryLobe, wo: vec3f, choice: f32) -> bsdf_boundary__BoundarySample {
	let split = bsdf_boundary__boundary_split(lobe, wo.z);
	let facet = bsdf_boundary__facet_at(lobe, wo, vec3f(0.0, 0.0, 1.0), split, bsdf_boundary__smooth_chance(split), choice);
	return bsdf_boundary__BoundarySample(facet.wi, facet.reflects, true, bsdf_boundary__fraction_of(facet));
}

fn bsdf_boundary__facet_at(lobe: bsdf_boundary__BoundaryLobe, wo: vec3f, h: vec3f, split: bsdf_boundary__Split, chance: f32, choice: f32) -> bsdf_boundary__Facet {
	let reflects = choice < chance;
	let reflected = fresnel__mirrored(-wo, h);
	var wi = select(vec3f(reflected.xy, -reflected.z), reflected, reflects);
	if (!reflects && lobe.bends) {
		wi = fresnel__refracted(-wo, h, lobe.eta, split.cos_t);
	}
	return bsdf_boundary__Facet(wi, reflects, split, chance);
}

fn bsdf_boundary__unshadowed(lobe: bsdf_boundary__BoundaryLobe, wo: vec3f, facet: bsdf_boundary__Facet, alpha: vec2f) -> f32 {
	let seen = 1.0 + bsdf_ggx__ggx_lambda(wo, alpha);
	let lit = bsdf_ggx__ggx_lambda(facet.wi, alpha);
	let part = select(seen / (seen + lit), 1.0 / (1.0 + lit), !facet.reflects && lobe.bends);
	return select(0.0, part, (facet.wi.z > 0.0) == facet.reflects);
}

fn bsdf_boundary__fraction_of(facet: bsdf_boundary__Facet) -> vec3f {
	let transmitted = facet.split.transmit / max_f32(1.0 - facet.chance, 1e-6);
	let reflected = facet.split.reflect / max_f32(facet.chance, 1e-6);
	return select(transmitted, reflected, facet.reflects);
}

fn bsdf_boundary__smooth_chance(split: bsdf_boundary__Split) -> f32 {
	let reflected = dot(split.reflect, tone__LUMINANCE_REC709);
	return reflected / max_f32(reflected + dot(split.transmit, tone__LUMINANCE_REC709), 1e-30);
}

fn bsdf_boundary__rough_chance(lobe: bsdf_boundary__BoundaryLobe, split: bsdf_boundary__Split, separable: bool) -> f32 {
	let is_clear = !separable && (lobe.flags & types__MATERIAL_FRESNEL) != 0u;
	return select(bsdf_boundary__smooth_chance(split), split.reflectance, is_clear);
}

const thin_film__XYZ_TO_RGB: mat3x3f = mat3x3f(vec3f(3.2404542, -0.969266, 0.0556434), vec3f(-1.5371385, 1.8760108, -0.2040259), vec3f(-0.4985314, 0.041556, 1.0572252));

fn thin_film__film_f0(n1: vec3f, n2: vec3f) -> vec3f {
	let ratio = (n1 - n2) / (n1 + n2);
	return ratio * ratio;
}

fn thin_film__film_spectrum(path: f32) -> vec3f {
	let phase = 2.0 * warp__PI * path * 1e-9;
	let height = vec3f(5.4856e-13, 4.4201e-13, 5.2481e-13);
	let middle = vec3f(1681000.0, 1795300.0, 2208400.0);
	let variance = vec3f(4327800000.0, 9304600000.0, 6612100000.0);
	let main = height * sqrt(2.0 * warp__PI * variance) * cos(middle * phase) * exp(-phase * phase * variance);
	let blue = 9.747e-14 * sqrt(2.0 * warp__PI * 4528200000.0) * cos(2239900.0 * phase) * exp(-phase * phase * 4528200000.0);
	return thin_film__XYZ_TO_RGB * (main + vec3f(blue, 0.0, 0.0)) / 1.0685e-7;
}

fn thin_film__thin_film(cos_i: f32, outside: f32, film_ior: f32, thickness: f32, base_f0: vec3f) -> vec3f {
	let ior = mix(outside, film_ior, smoothstep(0.0, 0.03, thickness));
	let above = fresnel__fresnel(cos_i, outside / ior);
	let root = sqrt(clamp_vec3f(base_f0, vec3f(0.0), vec3f(0.9999)));
	let base_ior = (1.0 + root) / (1.0 - root);
	let r12 = above.reflectance;
	let r23 = fresnel__schlick_between(thin_film__film_f0(vec3f(ior), base_ior), vec3f(1.0), above.cos_t);
	let once = sqrt(r12 * r23);
	let through = (1.0 - r12) * (1.0 - r23) / max_vec3f(1.0 - r12 * r23, vec3f(1e-6));
	let sign = select(vec3f(1.0), vec3f(-1.0), base_ior < vec3f(ior)) * select(-1.0, 1.0, ior < outside);
	let path = 2.0 * ior * thickness * above.cos_t;
	let harmonics = sign * once * thin_film__film_spectrum(path) + once * once * thin_film__film_spectrum(2.0 * path);
	let reflected = clamp_vec3f(1.0 - through - 2.0 * through * harmonics, vec3f(0.0), vec3f(1.0));
	return select(reflected, vec3f(1.0), above.total);
}

struct gloss__Gloss {
	whole: vec3f,
	over: vec3f,
	boost: vec3f,
	albedo: vec2f
}

fn gloss__gloss_at(layers: layers__Layers, f0: vec3f, f90: vec3f, over: vec3f, inside: f32, wo: vec3f, alpha: vec2f) -> gloss__Gloss {
	if (!bindings__HAS_GLOSS) {
		return gloss__Gloss(vec3f(0.0), vec3f(0.0), vec3f(0.0), vec2f(0.0));
	}
	var albedo = albedo__ggx_albedo(wo.z, alpha.x);
	if (bindings__HAS_ANISOTROPY && alpha.x > alpha.y) {
		albedo = albedo__stretched_albedo(wo, alpha);
	}
	let covering = gloss__scattered_often(over, layers.over_f90, albedo) * (albedo.x * over + albedo.y * layers.over_f90);
	var whole = inside * covering;
	if (bindings__HAS_METALLIC_ROUGHNESS) {
		let covered = inside * (1.0 - layers.metallic);
		let beside = max_vec3f(f0 - covered * over, vec3f(0.0));
		let beside_f90 = max_vec3f(f90 - covered * layers.over_f90, vec3f(0.0));
		let part = 1.0 / max_f32(layers.metallic, 1e-6);
		let of_metal = gloss__scattered_often(min_vec3f(part * beside, vec3f(1.0)), min_vec3f(part * beside_f90, vec3f(1.0)), albedo);
		whole = covered * covering + of_metal * (albedo.x * beside + albedo.y * beside_f90);
	}
	return gloss__Gloss(whole, covering, whole / max_vec3f(albedo.x * f0 + albedo.y * f90, vec3f(1e-9)), albedo);
}

fn gloss__scattered_often(f0: vec3f, f90: vec3f, albedo: vec2f) -> vec3f {
	if (bindings__BSDF_SPEC) {
		return vec3f(1.0);
	}
	return albedo__multiple_scattering(f0, f90, albedo);
}

const seen__CLEAR: f32 = 0.01;

const seen__CLEAR_DENSITY: f32 = 10.0;

const seen__CLEAR_SHARE: f32 = 0.75;

fn seen__see_surface(path: path__Path, bsdf: lobes__Bsdf, glow: vec3f) {
	if (bindings__HAS_FEATURES) {
		let boundary = select(vec3f(0.0), bsdf.boundary.reflect + bsdf.boundary.transmit, seen__is_blurred(bsdf));
		let albedo = bsdf.diffuse + bsdf.through + bsdf.gain * bsdf.f0 + boundary + glow;
		if (seen__clear_share(bsdf) <= seen__CLEAR_SHARE || any(glow > vec3f(0.0))) {
			features__see_albedo(path.throughput * albedo, bsdf.normal);
		}
		else {
			features__see_through(path.throughput * albedo, bsdf.normal);
		}
	}
}

fn seen__see_scattered(bsdf: lobes__Bsdf, pdf: f32, survival: f32) {
	if (bindings__HAS_FEATURES) {
		features__follow_chain(pdf <= 0.0 || pdf >= seen__CLEAR_DENSITY, survival * seen__clear_share(bsdf));
	}
}

fn seen__is_blurred(bsdf: lobes__Bsdf) -> bool {
	return bsdf.boundary.alpha.x >= seen__CLEAR;
}

fn seen__clear_share(bsdf: lobes__Bsdf) -> f32 {
	return select(bsdf.chances.z, 0.0, seen__is_blurred(bsdf)) + select(bsdf.chances.y, 0.0, bsdf.alpha.x >= seen__CLEAR) + select(bsdf.coating_chances.x, 0.0, bsdf.coating.coat_alpha >= seen__CLEAR);
}

fn toward_lamp__toward_lamp(batch: dispatch__Batch, before: path__Path, surface: shading__Surface, bsdf: lobes__Bsdf, met: interface__Interface) -> path__Path {
	var path = before;
	let light = emitters__sample_light(batch, surface.p, bsdf__receiving_normal(bsdf), path__random_1d(path, dimensions__LIGHT_CHOICE), path__random_2d(path, dimensions__LIGHT_POINT_ON));
	let found = bsdf__bsdf_eval(bsdf, light.incident.direction);
	let weight = select(1.0, mis__power_heuristic(light.pdf, found.pdf), light.pdf > 0.0);
	let unshadowed = weight * found.value * light.incident.radiance;
	if (any(unshadowed > vec3f(0.0))) {
		let media = select(path.media, met.media, vec4<bool>(dot(light.incident.direction, bsdf.ng) < 0.0));
		path.lamp = shadow__passage_of(direct__shadow_ray(surface, light.incident), media);
		path.lamp_light = path.throughput * unshadowed;
		path.lamp_scatterings = path.bounces + 1u;
	}
	record_path__record_light_sample(surface, path.lamp.ray, light, found, weight, unshadowed);
	return path;
}

fn bsdf_sheen__charlie_distribution(h: vec3f, alpha: f32) -> f32 {
	let exponent = 1.0 / alpha;
	let sin2 = clamp_f32(dot(h.xy, h.xy), 1e-12, 1.0);
	return (2.0 + exponent) * pow(sin2, 0.5 * exponent) / (2.0 * warp__PI);
}

fn bsdf_sheen__charlie_shape(x: f32, alpha: f32) -> f32 {
	let smooth_part = (1.0 - alpha) * (1.0 - alpha);
	let a = mix(21.5473, 25.3245, smooth_part);
	let b = mix(3.82987, 3.32435, smooth_part);
	let c = mix(0.19823, 0.16801, smooth_part);
	let d = mix(-1.9776, -1.27393, smooth_part);
	let e = mix(-4.32054, -4.85967, smooth_part);
	return a / (1.0 + b * pow(max_f32(x, 1e-9), c)) + d * x + e;
}

fn bsdf_sheen__charlie_lambda(cos_theta: f32, alpha: f32) -> f32 {
	let near = exp(bsdf_sheen__charlie_shape(cos_theta, alpha));
	let far = exp(2.0 * bsdf_sheen__charlie_shape(0.5, alpha) - bsdf_sheen__charlie_shape(1.0 - cos_theta, alpha));
	return select(far, near, cos_theta < 0.5);
}

fn bsdf_sheen__sheen_eval(wo: vec3f, wi: vec3f, alpha: f32) -> vec2f {
	let h = normalize(vec3f(wo.xy + wi.xy, max_f32(wo.z, 0.0) + max_f32(wi.z, 1e-6)));
	let cosines = clamp_vec2f(vec2f(wo.z, wi.z), vec2f(1e-6), vec2f(1.0));
	let lambda = bsdf_sheen__charlie_lambda(cosines.x, alpha) + bsdf_sheen__charlie_lambda(cosines.y, alpha);
	let value = bsdf_sheen__charlie_distribution(h, alpha) / (4.0 * cosines.x * (1.0 + lambda));
	return select(vec2f(0.0), vec2f(value, 0.5 / warp__PI), wo.z > 0.0 && wi.z > 0.0);
}

fn bsdf_sheen__sheen_sample(u: vec2f) -> vec3f {
	return warp__cone_from_square(u, 1.0);
}

fn bsdf_ggx_transmission__transmission_half(wo: vec3f, wi: vec3f, eta: f32) -> vec3f {
	let sum = eta * wo + wi;
	let squared = dot(sum, sum);
	let h = sum * select(1.0, -1.0, sum.z < 0.0) / sqrt(max_f32(squared, 1e-20));
	let refracts = squared > 1e-12 && dot(wo, h) > 0.0 && dot(wi, h) < 0.0;
	return select(vec3f(0.0), h, refracts);
}

fn bsdf_ggx_transmission__ggx_transmission(wo: vec3f, wi: vec3f, alpha: vec2f, eta: f32) -> vec2f {
	let h = bsdf_ggx_transmission__transmission_half(wo, wi, eta);
	let sum = eta * wo + wi;
	let seen = 1.0 + bsdf_ggx__ggx_lambda(wo, alpha);
	let lit = 1.0 + bsdf_ggx__ggx_lambda(wi, alpha);
	let refracted_density = abs(dot(wo, h) * dot(wi, h)) / (max_f32(wo.z, 1e-6) * max_f32(dot(sum, sum), 1e-12));
	let pdf = bsdf_ggx__ggx_distribution(h, alpha) * refracted_density / seen;
	return select(vec2f(0.0), vec2f(pdf / lit, pdf), wo.z > 0.0 && wi.z < 0.0);
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

fn min_vec4f(a: vec4f, b: vec4f) -> vec4f {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a < b);
	}
	return min(a, b);
}

fn max_vec4f(a: vec4f, b: vec4f) -> vec4f {
	if (bindings__EXTREMES_BY_SELECT) {
		return select(b, a, a > b);
	}
	return max(a, b);
}

fn clamp_vec4f(value: vec4f, low: vec4f, high: vec4f) -> vec4f {
	return min_vec4f(max_vec4f(value, low), high);
}

fn saturate_vec4f(value: vec4f) -> vec4f {
	return clamp_vec4f(value, vec4f(0), vec4f(1));
}
