const DEVIATIONS: f32 = 1.5;

const OUTLIER: f32 = 3.0;

const LEAST_WEIGHT: f32 = 0.3;

const LEAST_LIKENESS: f32 = 0.05;

const LUMINANCE_SHARE: f32 = 0.002;

struct Filtered {
	signal: vec4f,
	cover: vec4f
}

@compute @workgroup_size(64, 1, 1)
fn denoise(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	let size = vec2i(textureDimensions(rows__signal));
	let last = size - 1;
	let step = i32(bindings__stride);
	let own = 8 * vec2i(group.xy) + vec2i(i32(lane % 8u), i32(lane / 8u));
	let p = min(own, last);
	var result = Filtered(vec4f(0.0), vec4f(0.0));
	if (bindings__FIRST_PASS) {
		result.signal = without_outlier(p, last);
		if (bindings__HAS_OPACITY) {
			result.cover = cover__estimated_cover(p, last);
		}
	}
	else {
		result = averaged(p, last, step);
	}
	if (bindings__MODULATES) {
		let modulator = modulation__modulator_at(p, last);
		result.signal = vec4f(result.signal.xyz * modulator, 1.0);
		result.cover.x = select(0.0, result.cover.x, modulator.x > 0.0);
	}
	if (all(own < size)) {
		textureStore(bindings__denoised, p, result.signal);
		if (bindings__HAS_OPACITY) {
			textureStore(bindings__covers_out, p, result.cover);
		}
	}
}

fn luminance_of(signal: vec4f, opacity: f32) -> f32 {
	return dot(signal.xyz, tone__LUMINANCE_REC709) / max_f32(opacity, cover__LEAST_OPACITY);
}

fn without_outlier(p: vec2i, last: vec2i) -> vec4f {
	let own = rows__load_signal(p);
	let guide = guide__guide_at(p);
	let own_weight = cover__cover_at(p).x;
	let luminance = luminance_of(own, own_weight);
	var brightest = vec2f(luminance, own_weight);
	var total = 0.0;
	var sum = 0.0;
	var squares = 0.0;
	var variance = 0.0;
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = p + offset;
		let other = rows__load_signal(clamp(q, vec2i(0), last));
		let is_usable = k != 4 && all(q == clamp(q, vec2i(0), last)) && other.w >= 0.0;
		let opacity = cover__cover_at(clamp(q, vec2i(0), last)).x;
		let alike = guide__likeness(guide, guide__guide_at(clamp(q, vec2i(0), last)), 1.0);
		let weight = select(0.0, opacity * alike, is_usable);
		let light = luminance_of(other, opacity);
		brightest = select(brightest, vec2f(light, weight), weight > LEAST_LIKENESS && light > brightest.x);
		total += weight;
		sum += weight * light;
		squares += weight * light * light;
		variance += weight * other.w;
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	let is_known = own.w <= demodulation__MOST_VARIANCE;
	if (own.w < 0.0) {
		return own;
	}
	if (total < LEAST_WEIGHT) {
		return vec4f(own.xyz, cover__packed(cover__Estimate(select(luminance * luminance, own.w, is_known), luminance)));
	}
	let mean = sum / total;
	let spread = max_f32(squares / total - mean * mean, 0.0);
	let most = mean + OUTLIER * sqrt(spread) + LUMINANCE_SHARE * mean;
	let scale = select(1.0, most / luminance, luminance > most);
	let noise = select(spread, (variance + own_weight * scale * scale * own.w) / (total + own_weight), is_known);
	let rest = max_f32(total + own_weight - brightest.y, 1e-30);
	let pilot = (sum + own_weight * luminance - brightest.y * brightest.x) / rest;
	return vec4f(scale * own.xyz, cover__packed(cover__Estimate(noise, pilot)));
}

fn fall_of(pilot: f32, variance: f32) -> f32 {
	return 1.0 / (DEVIATIONS * sqrt(variance) + LUMINANCE_SHARE * pilot + 1e-12);
}

fn averaged(p: vec2i, last: vec2i, step: i32) -> Filtered {
	let own = rows__load_signal(p);
	let guide = guide__guide_at(p);
	let pilot = cover__unpacked(own.w).pilot;
	let own_cover = cover__cover_at(p);
	let coverage = cover__unpacked(own_cover.w).pilot;
	let variances = smooth_variances(p, last);
	let fall = select(0.0, fall_of(pilot, variances.x), own.w >= 0.0);
	let cover_fall = fall_of(coverage, variances.y);
	var total = 0.0;
	var sum = vec3f(0.0);
	var covered = 0.0;
	var mean = cover__Estimate(0.0, 0.0);
	var cover_mean = cover__Estimate(0.0, 0.0);
	var shares = 0.0;
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = p + step * offset;
		let inside = clamp(q, vec2i(0), last);
		let other = rows__load_signal(inside);
		let estimate = cover__unpacked(other.w);
		let is_usable = all(q == inside) && other.w >= 0.0;
		var apart = fall * (estimate.pilot - pilot);
		var squares = apart * apart;
		let cover = cover__cover_at(inside);
		var cover_estimate = cover__Estimate(0.0, 1.0);
		if (bindings__HAS_OPACITY) {
			cover_estimate = cover__unpacked(cover.w);
			apart *= min_f32(coverage, cover_estimate.pilot);
			let cover_apart = cover_fall * (cover_estimate.pilot - coverage);
			squares = apart * apart + cover_apart * cover_apart;
		}
		let alike = guide__likeness(guide, guide__guide_at(inside), f32(step)) * exp(-min_f32(squares, 80.0));
		let weight = select(0.0, guide__tent(offset) * alike, is_usable);
		let share = weight * cover_estimate.pilot;
		total += weight;
		sum += weight * other.xyz;
		covered += weight * cover.x;
		cover_mean.variance += weight * weight * cover_estimate.variance;
		cover_mean.pilot += weight * cover_estimate.pilot;
		shares += share;
		mean.variance += share * share * estimate.variance;
		mean.pilot += share * estimate.pilot;
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	if (total <= 0.0) {
		return Filtered(own, own_cover);
	}
	let all_shares = select(shares, max_f32(shares, 1e-15), bindings__HAS_OPACITY);
	let estimate = cover__Estimate(mean.variance / (all_shares * all_shares), mean.pilot / all_shares);
	let cover_estimate = cover__Estimate(cover_mean.variance / (total * total), cover_mean.pilot / total);
	return Filtered(vec4f(sum / total, cover__packed(estimate)), vec4f(covered / total, 0.0, 0.0, cover__packed(cover_estimate)));
}

fn smooth_variances(p: vec2i, last: vec2i) -> vec2f {
	var sum = vec2f(0.0);
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = clamp(p + offset, vec2i(0), last);
		let w = rows__load_signal(q).w;
		sum.x += select(0.0, guide__tent(offset) * cover__unpacked(w).variance, w >= 0.0);
		if (bindings__HAS_OPACITY) {
			sum.y += guide__tent(offset) * cover__unpacked(cover__cover_at(q).w).variance;
		}
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	return sum / 16.0;
}

@group(3) @binding(4)
var rows__signal: texture_2d<f32>;

@group(3) @binding(5)
var rows__guides: texture_2d<u32>;

@group(3) @binding(8)
var rows__albedos: texture_2d<f32>;

fn rows__load_signal(p: vec2i) -> vec4f {
	return textureLoad(rows__signal, p, 0);
}

fn rows__load_guide(p: vec2i) -> vec4u {
	return textureLoad(rows__guides, p, 0);
}

fn rows__load_albedo(p: vec2i) -> vec4f {
	return textureLoad(rows__albedos, p, 0);
}

@group(3) @binding(3)
var<storage, read> bindings__stride: u32;

@group(3) @binding(6)
var bindings__denoised: texture_storage_2d<rgba32float, write>;

@group(3) @binding(14)
var bindings__covers: texture_2d<f32>;

@group(3) @binding(15)
var bindings__covers_out: texture_storage_2d<rgba32float, write>;

override bindings__HAS_OPACITY: bool = false;

override bindings__FIRST_PASS: bool = false;

override bindings__MODULATES: bool = false;

const guide__NORMAL_FALL: f32 = 16.0;

const guide__ALBEDO_WIDTH: f32 = 0.3;

const guide__MEAN_ALBEDO_WIDTH: f32 = 0.09;

const guide__OPACITY_WIDTH: f32 = 0.03;

const guide__DEPTH_SHARE: f32 = 0.01;

struct guide__Guide {
	normal: vec3f,
	albedo: vec3f,
	mean_albedo: vec3f,
	opacity: f32,
	depth: f32,
	slope: f32
}

fn guide__guide_at(p: vec2i) -> guide__Guide {
	let packed = rows__load_guide(p);
	let normal = vec3f((vec3u(packed.x) >> vec3u(0u, 10u, 20u)) & vec3u(1023u)) * (2.0 / 1023.0) - 1.0;
	let albedo = vec3f((vec3u(packed.y) >> vec3u(0u, 5u, 11u)) & vec3u(31u, 63u, 31u)) / vec3f(31.0, 63.0, 31.0);
	let slope = bitcast<f32>(packed.y & 4294901760u);
	let means = unpack4x8unorm(packed.z);
	return guide__Guide(normal, albedo, means.xyz, means.w, bitcast<f32>(packed.w), slope);
}

fn guide__likeness(own: guide__Guide, other: guide__Guide, steps: f32) -> f32 {
	let n = own.normal - other.normal;
	let a = own.albedo - other.albedo;
	let m = own.mean_albedo - other.mean_albedo;
	let o = own.opacity - other.opacity;
	let albedos = dot(a, a) / guide__ALBEDO_WIDTH + dot(m, m) / guide__MEAN_ALBEDO_WIDTH + o * o / guide__OPACITY_WIDTH;
	let depth = abs(own.depth - other.depth) / (own.slope * steps + guide__DEPTH_SHARE * own.depth + 1e-9);
	return exp(-(guide__NORMAL_FALL * dot(n, n) + albedos + depth));
}

fn guide__tent(offset: vec2i) -> f32 {
	return f32((2 - abs(offset.x)) * (2 - abs(offset.y)));
}

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

struct cover__Estimate {
	variance: f32,
	pilot: f32
}

fn cover__packed(estimate: cover__Estimate) -> f32 {
	let variance = clamp_f32(round(2.0 * log2(max_f32(estimate.variance, 1e-30))) + 128.0, 0.0, 255.0);
	let pilot = clamp_f32(round(512.0 * log2(max_f32(estimate.pilot, 1e-30))) + 32768.0, 0.0, 65535.0);
	return 65536.0 * variance + pilot;
}

fn cover__unpacked(w: f32) -> cover__Estimate {
	let variance = floor(w / 65536.0);
	let pilot = w - 65536.0 * variance;
	return cover__Estimate(exp2(0.5 * (variance - 128.0)), exp2((pilot - 32768.0) / 512.0));
}

fn cover__estimated_cover(p: vec2i, last: vec2i) -> vec4f {
	let own = cover__cover_at(p);
	let guide = guide__guide_at(p);
	var total = 0.0;
	var mean = cover__Estimate(0.0, 0.0);
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = p + offset;
		let inside = clamp(q, vec2i(0), last);
		let other = cover__cover_at(inside);
		let weight = select(0.0, guide__likeness(guide, guide__guide_at(inside), 1.0), all(q == inside));
		total += weight;
		mean.variance += weight * other.w;
		mean.pilot += weight * other.x;
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	return vec4f(own.x, 0.0, 0.0, cover__packed(cover__Estimate(mean.variance / total, mean.pilot / total)));
}

const tone__LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);

const demodulation__LEAST_ALBEDO: f32 = 0.02;

const demodulation__MOST_VARIANCE: f32 = 1e30;

fn demodulation__divisor_of(albedo: vec3f) -> vec3f {
	return clamp_vec3f(albedo, vec3f(demodulation__LEAST_ALBEDO), vec3f(1.0));
}

const modulation__MEAN_DEVIATIONS: f32 = 1.5;

const modulation__PIXEL_DEVIATIONS: f32 = 4.0;

const modulation__MEAN_NOISE: f32 = 4e-6;

const modulation__PIXEL_NOISE: f32 = 1e-12;

fn modulation__modulator_at(p: vec2i, last: vec2i) -> vec3f {
	let own = rows__load_albedo(p);
	let mean = guide__guide_at(p).mean_albedo;
	let is_covered = cover__presence_at(p, own.xyz) > 0.0;
	var total = 0.0;
	var sum = vec3f(0.0);
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = clamp(p + offset, vec2i(0), last);
		let other = rows__load_albedo(q);
		let noise = min_f32(own.w, other.w);
		let means = modulation__far(guide__guide_at(q).mean_albedo - mean, modulation__MEAN_DEVIATIONS * modulation__MEAN_DEVIATIONS * noise + modulation__MEAN_NOISE);
		let pixels = modulation__far(other.xyz - own.xyz, modulation__PIXEL_DEVIATIONS * modulation__PIXEL_DEVIATIONS * noise + modulation__PIXEL_NOISE);
		let alike = select(1.0, exp(-min_f32(means + pixels, 80.0)), is_covered);
		let weight = guide__tent(offset) * cover__presence_at(q, other.xyz) * alike;
		total += weight;
		sum += weight * other.xyz;
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	return select(vec3f(0.0), demodulation__divisor_of(sum / max_f32(total, 1e-30)), total > 0.0);
}

fn modulation__far(difference: vec3f, variance: f32) -> f32 {
	return dot(difference, difference) / (3.0 * variance);
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
