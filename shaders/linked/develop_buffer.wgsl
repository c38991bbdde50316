@compute @workgroup_size(64, 1, 1)
fn develop(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32) {
    let work = package_scene_dispatch__1work_of(group, lane);
    if (work.inside) {
        let mean = package_lib_filter__1weighted_mean(package_scene_film__2load_weighted_sum(work, package_bindings_tone));
        let position = work.pixel - vec2u(package_bindings_dispatch.tile_x, package_bindings_dispatch.tile_y);
        package_bindings_developed[position.y * package_bindings_dispatch.tile_width + position.x] = vec4f(package_lib_quantity_shown(mean, package_bindings_tone), 1.0);
    }
    if (lane == 0u) {
        atomicAdd(&package_bindings_dispatch.counters.groups_done, 1u);
    }
}

struct package_scene_dispatch_Work {
    inside: bool,
    film_index: u32,
    pixel: vec2u
}

fn package_scene_dispatch__1work_of(group: vec3u, lane: u32) -> package_scene_dispatch_Work {
    let index = package_bindings_dispatch.first_group + group.y * package_bindings_dispatch.grid_width + group.x;
    let visited = package_lib_tile__1permuted_group(min(index, package_bindings_dispatch.group_count - 1u), package_bindings_dispatch.group_count, package_bindings_dispatch.group_stride);
    let pixel = package_lib_tile__1tile_pixel(visited, lane, package_bindings_dispatch.group_columns);
    if (package_bindings_ADAPTIVE) {
        let entry = package_bindings_film[package_bindings__1FILM_ROWS * (index * 64u + lane) + package_bindings__1SQUARES_ROW];
        return package_scene_dispatch_Work(index < package_bindings_dispatch.end_group && entry.w > 0.0, index * 64u + lane, vec2u(entry.yz));
    }
    let inside = index < package_bindings_dispatch.end_group && pixel.x < package_bindings_dispatch.tile_width && pixel.y < package_bindings_dispatch.tile_height;
    return package_scene_dispatch_Work(inside, index * 64u + lane, pixel + vec2u(package_bindings_dispatch.tile_x, package_bindings_dispatch.tile_y));
}

@group(1) @binding(1)
var<storage, read_write> package_bindings_dispatch: package_types_PackedDispatch;

@group(2) @binding(0)
var<storage, read_write> package_bindings_film: array<vec4f>;

@group(3) @binding(0)
var<storage, read> package_bindings_tone: package_types_PackedTone;

@group(3) @binding(1)
var<storage, read_write> package_bindings_developed: array<vec4f>;

override package_bindings_ADAPTIVE: bool = false;

override package_bindings__1FILM_ROWS: u32 = 1u;

override package_bindings__1SQUARES_ROW: u32 = 1u;

const package_types__1VIEW_DEPTH: u32 = 1u;

const package_types__1VIEW_HEAT: u32 = 3u;

const package_types__1TONE_NONE: u32 = 0u;

const package_types__1TONE_ACES: u32 = 1u;

const package_types__1TONE_AGX: u32 = 2u;

const package_types__1TONE_REINHARD: u32 = 3u;

const package_types__1TRANSFER_SRGB: u32 = 0u;

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

struct package_types_PackedTone {
    exposure_scale: f32,
    curve: u32,
    transfer: u32,
    view: u32,
    range: vec2f,
    has_range: u32,
    film_rows: u32
}

const package_lib_tile__1GROUP_SIDE: u32 = 8u;

fn package_lib_tile__1permuted_group(index: u32, group_count: u32, stride: u32) -> u32 {
    return (index * stride) % group_count;
}

fn package_lib_tile__1morton_8x8(lane: u32) -> vec2u {
    let x = (lane & 1u) | ((lane >> 1u) & 2u) | ((lane >> 2u) & 4u);
    let y = ((lane >> 1u) & 1u) | ((lane >> 2u) & 2u) | ((lane >> 3u) & 4u);
    return vec2u(x, y);
}

fn package_lib_tile__1tile_pixel(group: u32, lane: u32, group_columns: u32) -> vec2u {
    return package_lib_tile__1GROUP_SIDE * vec2u(group % group_columns, group / group_columns) + package_lib_tile__1morton_8x8(lane);
}

fn package_lib_filter__1weighted_mean(sum: vec4f) -> vec3f {
    let usable = abs(sum.w) > 0.5;
    return select(vec3f(0.0), max(sum.xyz / select(1.0, sum.w, usable), vec3f(0.0)), usable);
}

fn package_scene_film__2load_weighted_sum(work: package_scene_dispatch_Work, tone: package_types_PackedTone) -> vec4f {
    return package_bindings_film[tone.film_rows * work.film_index];
}

const package_lib_quantity__1FAR_LEVEL: f32 = 0.1;

const package_lib_quantity__1LEAST_COVERAGE: f32 = 0.01;

fn package_lib_quantity_shown(mean: vec3f, tone: package_types_PackedTone) -> vec3f {
    if (tone.view != package_types__1VIEW_DEPTH && tone.view != package_types__1VIEW_HEAT) {
        return package_lib_tone_develop(mean, tone);
    }
    let value = package_lib_quantity_quantity(mean, tone.view);
    if (tone.has_range == 0u) {
        return package_lib_tone_develop(vec3f(value), tone);
    }
    if (tone.view == package_types__1VIEW_HEAT) {
        return package_lib_tone_develop(package_lib_colormap_heat(package_lib_quantity__2position_in_range(value, tone.range)), tone);
    }
    let far = package_lib_quantity__2position_in_range(log2(max(value, 1e-30)), log2(max(tone.range, vec2f(1e-30))));
    return package_lib_tone_develop(vec3f(select(0.0, mix(1.0, package_lib_quantity__1FAR_LEVEL, far), value > 0.0)), tone);
}

fn package_lib_quantity_quantity(mean: vec3f, view: u32) -> f32 {
    if (view == package_types__1VIEW_DEPTH) {
        return select(0.0, mean.x / max(mean.y, package_lib_quantity__1LEAST_COVERAGE), mean.y >= package_lib_quantity__1LEAST_COVERAGE);
    }
    return mean.x;
}

fn package_lib_quantity__2position_in_range(value: f32, range: vec2f) -> f32 {
    let extent = range.y - range.x;
    return select(0.5, clamp((value - range.x) / max(extent, 1e-30), 0.0, 1.0), extent > 0.0);
}

const package_lib_tone__1LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);

fn package_lib_tone_aces(x: vec3f) -> vec3f {
    return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
}

fn package_lib_tone_reinhard(x: vec3f) -> vec3f {
    return x / (1.0 + dot(x, package_lib_tone__1LUMINANCE_REC709));
}

fn package_lib_tone_agx(x: vec3f) -> vec3f {
    let inset = mat3x3f(vec3f(0.842479062253094, 0.0423282422610123, 0.0423756549057051), vec3f(0.0784335999999992, 0.878468636469772, 0.0784336), vec3f(0.0792237451477643, 0.0791661274605434, 0.879142973793104));
    let outset = mat3x3f(vec3f(1.19687900512017, -0.0528968517574562, -0.0529716355144438), vec3f(-0.0980208811401368, 1.15190312990417, -0.0980434501171241), vec3f(-0.0990297440797205, -0.0989611768448433, 1.15107367264116));
    let stops = clamp(log2(max(inset * x, vec3f(1e-10))), vec3f(-12.47393), vec3f(4.026069));
    let v = (stops + 12.47393) / 16.5;
    let v2 = v * v;
    let v4 = v2 * v2;
    let curve = 15.5 * v4 * v2 - 40.14 * v4 * v + 31.96 * v4 - 6.868 * v2 * v + 0.4298 * v2 + 0.1191 * v - 0.00232;
    return pow(max(outset * curve, vec3f(0.0)), vec3f(2.2));
}

fn package_lib_tone__2srgb_from_linear(x: vec3f) -> vec3f {
    let power = 1.055 * pow(max(x, vec3f(0.0031308)), vec3f(1.0 / 2.4)) - 0.055;
    return select(power, 12.92 * x, x <= vec3f(0.0031308));
}

fn package_lib_tone_develop(radiance: vec3f, tone: package_types_PackedTone) -> vec3f {
    var color = radiance * tone.exposure_scale;
    if (tone.curve != package_types__1TONE_NONE) {
        color = min(color, vec3f(1000000000.0));
    }
    if (tone.curve == package_types__1TONE_ACES) {
        color = package_lib_tone_aces(color);
    }
    else if (tone.curve == package_types__1TONE_AGX) {
        color = package_lib_tone_agx(color);
    }
    else if (tone.curve == package_types__1TONE_REINHARD) {
        color = package_lib_tone_reinhard(color);
    }
    if (tone.transfer == package_types__1TRANSFER_SRGB) {
        color = package_lib_tone__2srgb_from_linear(clamp(color, vec3f(0.0), vec3f(1.0)));
    }
    return color;
}

fn package_lib_colormap_heat(x: f32) -> vec3f {
    let s = clamp(x, 0.0, 1.0) * 5.0;
    let red = clamp(s - 2.0, 0.0, 1.0);
    let green = clamp(s - 1.0, 0.0, 1.0) - clamp(s - 3.0, 0.0, 1.0) + clamp(s - 4.0, 0.0, 1.0);
    let blue = clamp(s, 0.0, 1.0) - clamp(s - 1.0, 0.0, 1.0) + clamp(s - 4.0, 0.0, 1.0);
    return vec3f(red, green, blue);
}
