@compute @workgroup_size(64, 1, 1)
fn show(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	let work = block__work_of(block__load_block(group), lane);
	let tone = film__load_tone();
	let corner = vec2u(bindings__dispatch.tile_x, bindings__dispatch.tile_y);
	if (work.inside) {
		let sum = film__load_weighted_sum(work, tone);
		let position = work.pixel - corner;
		var mean = vec3f(0.0);
		if (bindings__SHOWS_DENOISED) {
			mean = rows__load_signal(vec2i(position)).xyz;
		}
		else {
			mean = filter__weighted_mean(sum);
		}
		let color = clamp_vec3f(quantity__shown(mean, tone), vec3f(0.0), vec3f(1.0));
		let shown = vec4f(floor(color * 255.0 + 0.5) / 255.0, 1.0);
		textureStore(bindings__screen, position, select(vec4f(0.0), shown, sum.w != 0.0));
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

@group(3) @binding(0)
var<storage, read> bindings__tone: types__PackedTone;

@group(3) @binding(2)
var bindings__screen: texture_storage_2d<rgba8unorm, write>;

override bindings__ADAPTIVE: bool = false;

override bindings__FILM_ROWS: u32 = 0u;

override bindings__SQUARES_ROW: u32 = 0u;

override bindings__TONE_CURVE: u32 = 0u;

override bindings__TONE_TRANSFER: u32 = 0u;

override bindings__VIEW: u32 = 0u;

override bindings__SHOWS_DENOISED: bool = false;

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

const types__VIEW_DEPTH: u32 = 1u;

const types__VIEW_HEAT: u32 = 3u;

const types__TONE_NONE: u32 = 0u;

const types__TONE_ACES: u32 = 1u;

const types__TONE_AGX: u32 = 2u;

const types__TONE_REINHARD: u32 = 3u;

const types__TONE_NEUTRAL: u32 = 4u;

const types__TRANSFER_SRGB: u32 = 0u;

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

struct types__PackedTone {
	exposure_scale: f32,
	curve: u32,
	transfer: u32,
	view: u32,
	range: vec2f,
	has_range: u32,
	film_rows: u32
}

fn film__load_tone() -> types__PackedTone {
	var chosen = bindings__tone;
	chosen.curve = bindings__TONE_CURVE;
	chosen.transfer = bindings__TONE_TRANSFER;
	chosen.view = bindings__VIEW;
	return chosen;
}

fn film__load_weighted_sum(work: block__Work, tone: types__PackedTone) -> vec4f {
	return bindings__film[tone.film_rows * work.film_index];
}

@group(3) @binding(4)
var rows__signal: texture_2d<f32>;

fn rows__load_signal(p: vec2i) -> vec4f {
	return textureLoad(rows__signal, p, 0);
}

fn filter__weighted_mean(sum: vec4f) -> vec3f {
	let usable = abs(sum.w) > 0.5;
	return select(vec3f(0.0), max_vec3f(sum.xyz / select(1.0, sum.w, usable), vec3f(0.0)), usable);
}

const quantity__FAR_LEVEL: f32 = 0.1;

const quantity__LEAST_COVERAGE: f32 = 0.01;

fn quantity__shown(mean: vec3f, tone: types__PackedTone) -> vec3f {
	var color = mean;
	if (tone.view == types__VIEW_DEPTH || tone.view == types__VIEW_HEAT) {
		color = quantity__quantity_color(quantity__quantity(mean, tone.view), tone);
	}
	return tone__develop(color, tone);
}

fn quantity__quantity_color(value: f32, tone: types__PackedTone) -> vec3f {
	if (tone.has_range == 0u) {
		return vec3f(value);
	}
	if (tone.view == types__VIEW_HEAT) {
		return colormap__heat(quantity__position_in_range(value, tone.range));
	}
	let far = quantity__position_in_range(log2(max_f32(value, 1e-30)), log2(max_vec2f(tone.range, vec2f(1e-30))));
	return vec3f(select(0.0, mix(1.0, quantity__FAR_LEVEL, far), value > 0.0));
}

fn quantity__quantity(mean: vec3f, view: u32) -> f32 {
	if (view == types__VIEW_DEPTH) {
		return select(0.0, mean.x / max_f32(mean.y, quantity__LEAST_COVERAGE), mean.y >= quantity__LEAST_COVERAGE);
	}
	return mean.x;
}

fn quantity__position_in_range(value: f32, range: vec2f) -> f32 {
	let extent = range.y - range.x;
	return select(0.5, clamp_f32((value - range.x) / max_f32(extent, 1e-30), 0.0, 1.0), extent > 0.0);
}

fn colormap__heat(x: f32) -> vec3f {
	let s = clamp_f32(x, 0.0, 1.0) * 5.0;
	let red = clamp_f32(s - 2.0, 0.0, 1.0);
	let green = clamp_f32(s - 1.0, 0.0, 1.0) - clamp_f32(s - 3.0, 0.0, 1.0) + clamp_f32(s - 4.0, 0.0, 1.0);
	let blue = clamp_f32(s, 0.0, 1.0) - clamp_f32(s - 1.0, 0.0, 1.0) + clamp_f32(s - 4.0, 0.0, 1.0);
	return vec3f(red, green, blue);
}

const tone__LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);

fn tone__aces(x: vec3f) -> vec3f {
	return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
}

fn tone__reinhard(x: vec3f) -> vec3f {
	return x / (1.0 + dot(x, tone__LUMINANCE_REC709));
}

fn tone__agx(x: vec3f) -> vec3f {
	let inset = mat3x3f(vec3f(0.842479062253094, 0.0423282422610123, 0.0423756549057051), vec3f(0.0784335999999992, 0.878468636469772, 0.0784336), vec3f(0.0792237451477643, 0.0791661274605434, 0.879142973793104));
	let outset = mat3x3f(vec3f(1.19687900512017, -0.0528968517574562, -0.0529716355144438), vec3f(-0.0980208811401368, 1.15190312990417, -0.0980434501171241), vec3f(-0.0990297440797205, -0.0989611768448433, 1.15107367264116));
	let stops = clamp_vec3f(log2(max_vec3f(inset * x, vec3f(1e-10))), vec3f(-12.47393), vec3f(4.026069));
	let v = (stops + 12.47393) / 16.5;
	let v2 = v * v;
	let v4 = v2 * v2;
	let curve = 15.5 * v4 * v2 - 40.14 * v4 * v + 31.96 * v4 - 6.868 * v2 * v + 0.4298 * v2 + 0.1191 * v - 0.00232;
	return pow(max_vec3f(outset * curve, vec3f(0.0)), vec3f(2.2));
}

fn tone__neutral(x: vec3f) -> vec3f {
	let reflected = 0.04;
	let knee = 0.8 - reflected;
	let desaturation = 0.15;
	let least = max_f32(min_f32(x.r, min_f32(x.g, x.b)), 0.0);
	let offset = select(reflected, least - least * least / (4.0 * reflected), least < 2.0 * reflected);
	let color = x - offset;
	let peak = max_f32(color.r, max_f32(color.g, color.b));
	if (peak < knee) {
		return color;
	}
	let room = 1.0 - knee;
	let shown = 1.0 - room * room / (peak + room - knee);
	let saturation = 1.0 / (desaturation * (peak - shown) + 1.0);
	return mix(vec3f(shown), color * (shown / peak), saturation);
}

fn tone__srgb_from_linear(x: vec3f) -> vec3f {
	let power = 1.055 * pow(max_vec3f(x, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
	return select(power, 12.92 * x, x <= vec3f(0.0031308));
}

fn tone__develop(radiance: vec3f, tone: types__PackedTone) -> vec3f {
	var color = radiance * tone.exposure_scale;
	if (tone.curve != types__TONE_NONE) {
		color = min_vec3f(color, vec3f(1000000000.0));
	}
	if (tone.curve == types__TONE_ACES) {
		color = tone__aces(color);
	}
	else if (tone.curve == types__TONE_AGX) {
		color = tone__agx(color);
	}
	else if (tone.curve == types__TONE_NEUTRAL) {
		color = tone__neutral(color);
	}
	else if (tone.curve == types__TONE_REINHARD) {
		color = tone__reinhard(color);
	}
	if (tone.transfer == types__TRANSFER_SRGB) {
		color = tone__srgb_from_linear(clamp_vec3f(color, vec3f(0.0), vec3f(1.0)));
	}
	return color;
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
