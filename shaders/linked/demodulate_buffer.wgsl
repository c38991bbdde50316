@compute @workgroup_size(64, 1, 1)
fn demodulate(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	let size = vec2i(textureDimensions(bindings__noisy));
	let own = 8 * vec2i(group.xy) + vec2i(i32(lane % 8u), i32(lane / 8u));
	let p = min(own, size - 1);
	let signal = demodulation__signal_at(p);
	let guide = demodulation__packed_guide_at(p, size - 1);
	if (all(own < size)) {
		textureStore(bindings__denoised, p, signal);
		textureStore(bindings__guides_out, p, guide);
	}
}

@group(3) @binding(6)
var bindings__denoised: texture_storage_2d<rgba32float, write>;

@group(3) @binding(7)
var bindings__noisy: texture_2d<f32>;

@group(3) @binding(9)
var bindings__surfaces: texture_2d<f32>;

@group(3) @binding(10)
var bindings__guides_out: texture_storage_2d<rgba32uint, write>;

@group(3) @binding(14)
var bindings__covers: texture_2d<f32>;

override bindings__HAS_OPACITY: bool = false;

const demodulation__LEAST_ALBEDO: f32 = 0.02;

const demodulation__MOST_SIGNAL: f32 = 1000000000000000.0;

const demodulation__MOST_VARIANCE: f32 = 1e30;

const demodulation__UNKNOWN_VARIANCE: f32 = 1e31;

fn demodulation__divisor_of(albedo: vec3f) -> vec3f {
	return clamp_vec3f(albedo, vec3f(demodulation__LEAST_ALBEDO), vec3f(1.0));
}

fn demodulation__signal_at(p: vec2i) -> vec4f {
	let pixel = textureLoad(bindings__noisy, p, 0);
	if (!numeric__is_finite(pixel.xyz) || !numeric__is_finite(pixel.www)) {
		return vec4f(0.0, 0.0, 0.0, -1.0);
	}
	let divisor = demodulation__divisor_of(rows__load_albedo(p).xyz);
	let luminance = dot(divisor, tone__LUMINANCE_REC709);
	let color = clamp_vec3f(pixel.xyz / divisor, vec3f(0.0), vec3f(demodulation__MOST_SIGNAL));
	let variance = clamp_f32(pixel.w / (luminance * luminance), 0.0, demodulation__MOST_VARIANCE);
	return vec4f(color, select(variance, demodulation__UNKNOWN_VARIANCE, pixel.w > demodulation__MOST_VARIANCE));
}

fn demodulation__packed_guide_at(p: vec2i, last: vec2i) -> vec4u {
	let surface = textureLoad(bindings__surfaces, p, 0);
	let slope = max_f32(demodulation__least_step(surface.w, p, last, vec2i(1, 0)), demodulation__least_step(surface.w, p, last, vec2i(0, 1)));
	let normal = vec3u(clamp_vec3f(0.5 + 0.5 * surface.xyz, vec3f(0.0), vec3f(1.0)) * 1023.0 + 0.5);
	let albedo = vec3u(clamp_vec3f(rows__load_albedo(p).xyz, vec3f(0.0), vec3f(1.0)) * vec3f(31.0, 63.0, 31.0) + 0.5);
	return vec4u(normal.x | (normal.y << 10u) | (normal.z << 20u), (bitcast<u32>(slope) & 4294901760u) | albedo.x | (albedo.y << 5u) | (albedo.z << 11u), pack4x8unorm(demodulation__means_at(p, last)), bitcast<u32>(surface.w));
}

fn demodulation__means_at(p: vec2i, last: vec2i) -> vec4f {
	var sum = vec3f(0.0);
	var total = 0.0;
	var opacity = 0.0;
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = clamp(p + offset, vec2i(0), last);
		let albedo = rows__load_albedo(q).xyz;
		let presence = cover__presence_at(q, albedo);
		sum += presence * albedo;
		total += presence;
		opacity += cover__cover_at(q).x;
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	return vec4f(sum / max_f32(total, 1e-6), select(0.0, opacity / 9.0, bindings__HAS_OPACITY));
}

fn demodulation__least_step(depth: f32, p: vec2i, last: vec2i, axis: vec2i) -> f32 {
	let before = abs(textureLoad(bindings__surfaces, max(p - axis, vec2i(0)), 0).w - depth);
	let after = abs(textureLoad(bindings__surfaces, min(p + axis, last), 0).w - depth);
	let has_before = all(p >= axis);
	let has_after = all(p + axis <= last);
	return select(select(0.0, after, has_after), select(before, min_f32(before, after), has_after), has_before);
}

fn numeric__is_finite(v: vec3f) -> bool {
	let exponents = bitcast<vec3u>(v) & vec3u(2139095040u);
	return all(exponents != vec3u(2139095040u));
}

@group(3) @binding(8)
var rows__albedos: texture_2d<f32>;

fn rows__load_albedo(p: vec2i) -> vec4f {
	return textureLoad(rows__albedos, p, 0);
}

const tone__LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);

const cover__LEAST_OPACITY: f32 = 0.0001;

fn cover__cover_at(p: vec2i) -> vec4f {
	if (bindings__HAS_OPACITY) {
		return textureLoad(bindings__covers, p, 0);
	}
	return vec4f(1.0, 0.0, 0.0, 0.0);
}

fn cover__presence_at(p: vec2i, albedo: vec3f) -> f32 {
	return max_f32(cover__cover_at(p).x, select(0.0, cover__LEAST_OPACITY, any(albedo > vec3f(0.0))));
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
