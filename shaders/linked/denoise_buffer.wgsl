const DEVIATIONS: f32 = 1.5;

const OUTLIER: f32 = 3.0;

const LEAST_WEIGHT: f32 = 0.3;

const LEAST_LIKENESS: f32 = 0.05;

const LUMINANCE_SHARE: f32 = 0.002;

fn load_signal(p: vec2i) -> vec4f {
	return textureLoad(bindings__signal, p, 0);
}

struct Estimate {
	variance: f32,
	pilot: f32
}

fn packed(estimate: Estimate) -> f32 {
	let variance = clamp_f32(round(2.0 * log2(max_f32(estimate.variance, 1e-30))) + 128.0, 0.0, 255.0);
	let pilot = clamp_f32(round(512.0 * log2(max_f32(estimate.pilot, 1e-30))) + 32768.0, 0.0, 65535.0);
	return 65536.0 * variance + pilot;
}

fn unpacked(w: f32) -> Estimate {
	let variance = floor(w / 65536.0);
	let pilot = w - 65536.0 * variance;
	return Estimate(exp2(0.5 * (variance - 128.0)), exp2((pilot - 32768.0) / 512.0));
}

@compute @workgroup_size(64, 1, 1)
fn denoise(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
	let size = vec2i(textureDimensions(bindings__signal));
	let last = size - 1;
	let step = i32(bindings__stride);
	let own = 8 * vec2i(group.xy) + vec2i(i32(lane % 8u), i32(lane / 8u));
	let p = min(own, last);
	var result = vec4f(0.0);
	if (bindings__FIRST_PASS) {
		result = without_outlier(p, last);
	}
	else {
		result = averaged(p, last, step);
	}
	if (bindings__MODULATES) {
		result = vec4f(result.xyz * modulation__modulator_at(p, last), 1.0);
	}
	if (all(own < size)) {
		textureStore(bindings__denoised, p, result);
	}
}

fn without_outlier(p: vec2i, last: vec2i) -> vec4f {
	let own = load_signal(p);
	let guide = guide__guide_at(p);
	let luminance = dot(own.xyz, tone__LUMINANCE_REC709);
	var brightest = vec2f(luminance, 1.0);
	var total = 0.0;
	var sum = 0.0;
	var squares = 0.0;
	var variance = 0.0;
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = p + offset;
		let other = load_signal(clamp(q, vec2i(0), last));
		let is_usable = k != 4 && all(q == clamp(q, vec2i(0), last)) && other.w >= 0.0;
		let weight = select(0.0, guide__likeness(guide, guide__guide_at(clamp(q, vec2i(0), last)), 1.0), is_usable);
		let light = dot(other.xyz, tone__LUMINANCE_REC709);
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
		return vec4f(own.xyz, packed(Estimate(select(luminance * luminance, own.w, is_known), luminance)));
	}
	let mean = sum / total;
	let spread = max_f32(squares / total - mean * mean, 0.0);
	let most = mean + OUTLIER * sqrt(spread) + LUMINANCE_SHARE * mean;
	let scale = select(1.0, most / luminance, luminance > most);
	let noise = select(spread, (variance + scale * scale * own.w) / (total + 1.0), is_known);
	let rest = total + 1.0 - brightest.y;
	let pilot = (sum + luminance - brightest.y * brightest.x) / rest;
	return vec4f(scale * own.xyz, packed(Estimate(noise, pilot)));
}

fn averaged(p: vec2i, last: vec2i, step: i32) -> vec4f {
	let own = load_signal(p);
	let guide = guide__guide_at(p);
	let pilot = unpacked(own.w).pilot;
	let width = DEVIATIONS * sqrt(smooth_variance(p, last)) + LUMINANCE_SHARE * pilot + 1e-12;
	let fall = select(0.0, 1.0 / width, own.w >= 0.0);
	var total = 0.0;
	var sum = vec3f(0.0);
	var mean = Estimate(0.0, 0.0);
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = p + step * offset;
		let inside = clamp(q, vec2i(0), last);
		let other = load_signal(inside);
		let estimate = unpacked(other.w);
		let is_usable = all(q == inside) && other.w >= 0.0;
		let apart = fall * (estimate.pilot - pilot);
		let alike = guide__likeness(guide, guide__guide_at(inside), f32(step)) * exp(-min_f32(apart * apart, 80.0));
		let weight = select(0.0, guide__tent(offset) * alike, is_usable);
		total += weight;
		sum += weight * other.xyz;
		mean.variance += weight * weight * estimate.variance;
		mean.pilot += weight * estimate.pilot;
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	if (total <= 0.0) {
		return own;
	}
	return vec4f(sum / total, packed(Estimate(mean.variance / (total * total), mean.pilot / total)));
}

fn smooth_variance(p: vec2i, last: vec2i) -> f32 {
	var sum = 0.0;
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let w = load_signal(clamp(p + offset, vec2i(0), last)).w;
		sum += select(0.0, guide__tent(offset) * unpacked(w).variance, w >= 0.0);
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	return sum / 16.0;
}

@group(3) @binding(3)
var<storage, read> bindings__stride: u32;

@group(3) @binding(4)
var bindings__signal: texture_2d<f32>;

@group(3) @binding(5)
var bindings__guides: texture_2d<u32>;

@group(3) @binding(6)
var bindings__denoised: texture_storage_2d<rgba32float, write>;

@group(3) @binding(8)
var bindings__albedos: texture_2d<f32>;

override bindings__FIRST_PASS: bool = false;

override bindings__MODULATES: bool = false;

const guide__NORMAL_FALL: f32 = 16.0;

const guide__ALBEDO_WIDTH: f32 = 0.3;

const guide__MEAN_ALBEDO_WIDTH: f32 = 0.09;

const guide__DEPTH_SHARE: f32 = 0.01;

struct guide__Guide {
	normal: vec3f,
	albedo: vec3f,
	mean_albedo: vec3f,
	depth: f32,
	slope: f32
}

fn guide__load_guide(p: vec2i) -> vec4u {
	return textureLoad(bindings__guides, p, 0);
}

fn guide__guide_at(p: vec2i) -> guide__Guide {
	let packed = guide__load_guide(p);
	let normal = vec3f((vec3u(packed.x) >> vec3u(0u, 10u, 20u)) & vec3u(1023u)) * (2.0 / 1023.0) - 1.0;
	let albedo = vec3f((vec3u(packed.y) >> vec3u(0u, 5u, 11u)) & vec3u(31u, 63u, 31u)) / vec3f(31.0, 63.0, 31.0);
	let slope = bitcast<f32>(packed.y & 4294901760u);
	return guide__Guide(normal, albedo, unpack4x8unorm(packed.z).xyz, bitcast<f32>(packed.w), slope);
}

fn guide__likeness(own: guide__Guide, other: guide__Guide, steps: f32) -> f32 {
	let n = own.normal - other.normal;
	let a = own.albedo - other.albedo;
	let m = own.mean_albedo - other.mean_albedo;
	let albedos = dot(a, a) / guide__ALBEDO_WIDTH + dot(m, m) / guide__MEAN_ALBEDO_WIDTH;
	let depth = abs(own.depth - other.depth) / (own.slope * steps + guide__DEPTH_SHARE * own.depth + 1e-9);
	return exp(-(guide__NORMAL_FALL * dot(n, n) + albedos + depth));
}

fn guide__tent(offset: vec2i) -> f32 {
	return f32((2 - abs(offset.x)) * (2 - abs(offset.y)));
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

fn modulation__load_albedo(p: vec2i) -> vec4f {
	return textureLoad(bindings__albedos, p, 0);
}

fn modulation__modulator_at(p: vec2i, last: vec2i) -> vec3f {
	let own = modulation__load_albedo(p);
	let mean = guide__guide_at(p).mean_albedo;
	var total = 0.0;
	var sum = vec3f(0.0);
	var k = 0;
	loop {
		let offset = vec2i(k % 3, k / 3) - 1;
		let q = clamp(p + offset, vec2i(0), last);
		let other = modulation__load_albedo(q);
		let noise = min_f32(own.w, other.w);
		let means = modulation__far(guide__guide_at(q).mean_albedo - mean, modulation__MEAN_DEVIATIONS * modulation__MEAN_DEVIATIONS * noise + modulation__MEAN_NOISE);
		let pixels = modulation__far(other.xyz - own.xyz, modulation__PIXEL_DEVIATIONS * modulation__PIXEL_DEVIATIONS * noise + modulation__PIXEL_NOISE);
		let weight = guide__tent(offset) * exp(-min_f32(means + pixels, 80.0));
		total += weight;
		sum += weight * other.xyz;
		continuing {
			k += 1;
			break if k >= 9;
		}
	}
	return demodulation__divisor_of(sum / total);
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
