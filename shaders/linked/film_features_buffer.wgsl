@compute @workgroup_size(64, 1, 1)
fn film_features(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	let work = block__work_of(block__load_block(group), lane);
	if (work.inside) {
		let row = bindings__FILM_ROWS * work.film_index;
		let first = row + bindings__FEATURES_ROW;
		let sum = bindings__film[row];
		let mean = filter__weighted_mean(sum);
		let samples = select(abs(sum.w), f32(bindings__dispatch.end_sample), bindings__dispatch.end_sample > 0u);
		let squares = bindings__film[row + bindings__SQUARES_ROW].x / max_f32(samples, 1.0);
		let variance = features__mean_variance(mean, squares, samples);
		let p = work.pixel - vec2u(bindings__dispatch.tile_x, bindings__dispatch.tile_y);
		textureStore(bindings__noisy_out, p, vec4f(mean, select(variance, demodulation__UNKNOWN_VARIANCE, samples == 1.0)));
		let weight = bindings__film[first].w;
		let albedo = features__feature_mean(bindings__film[first], weight).xyz;
		let normal = features__feature_mean(bindings__film[first + 1u], weight);
		let shown = samples * weight / select(1.0, sum.w, sum.w != 0.0);
		textureStore(bindings__albedos_out, p, vec4f(albedo, features__mean_variance(albedo, normal.w, shown)));
		textureStore(bindings__surfaces_out, p, vec4f(normal.xyz, bindings__film[first + 5u].w));
	}
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

@group(1) @binding(1)
var<storage, read_write> bindings__dispatch: types__PackedDispatch;

@group(2) @binding(0)
var<storage, read_write> bindings__film: array<vec4f>;

@group(3) @binding(11)
var bindings__noisy_out: texture_storage_2d<rgba32float, write>;

@group(3) @binding(12)
var bindings__albedos_out: texture_storage_2d<rgba32float, write>;

@group(3) @binding(13)
var bindings__surfaces_out: texture_storage_2d<rgba32float, write>;

override bindings__ADAPTIVE: bool = false;

override bindings__FILM_ROWS: u32 = 0u;

override bindings__SQUARES_ROW: u32 = 0u;

override bindings__FEATURES_ROW: u32 = 0u;

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

fn filter__weighted_mean(sum: vec4f) -> vec3f {
	let usable = abs(sum.w) > 0.5;
	return select(vec3f(0.0), max_vec3f(sum.xyz / select(1.0, sum.w, usable), vec3f(0.0)), usable);
}

const features__LEAST_WEIGHT: f32 = 1.0 / 1024.0;

fn features__feature_mean(sum: vec4f, weight: f32) -> vec4f {
	let usable = abs(weight) > 0.5 * features__LEAST_WEIGHT;
	return select(vec4f(0.0), clamp_vec4f(sum / select(1.0, weight, usable), vec4f(-1.0), vec4f(1.0)), usable);
}

fn features__mean_variance(mean: vec3f, squares: f32, samples: f32) -> f32 {
	let luminance = dot(mean, tone__LUMINANCE_REC709);
	return max_f32(squares - luminance * luminance, 0.0) / max_f32(samples - 1.0, 1.0);
}

const tone__LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);

const demodulation__UNKNOWN_VARIANCE: f32 = 1e31;

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
