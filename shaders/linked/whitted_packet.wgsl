@compute @workgroup_size(16, 1, 1)
fn whitted(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_index) lane: u32, @builtin(subgroup_invocation_id) packet_lane: u32) {
    package_scene_packet_lanes__1start_packets(packet_lane);
    package_scene__1ray_stack__1stack_lane = lane;
    render(group, lane);
}

fn render(group: vec3u, lane: u32) {
    let batch = package_scene_dispatch__1load_batch();
    var sample = batch.first_sample;
    loop {
        var rays = package_scene_rays__1dead_rays();
        var keys = package_scene_wide_Words(0u);
        var k = 0u;
        loop {
            let work = package_scene_dispatch__1work_of(group, package_scene_dispatch__1place_of(lane, k));
            if (work.inside) {
                rays = package_scene_rays__1ray_set(rays, k, package_scene_dispatch__1sample_ray(batch, work.pixel, sample));
            }
            keys = package_scene_wide__1word_set(keys, k, package_lib_rng__1pixel_key(batch.seed, work.pixel));
            continuing {
                k += 1u;
                break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
            }
        }
        package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
        let radiance = trace(batch, rays, keys, sample);
        k = 0u;
        loop {
            let work = package_scene_dispatch__1work_of(group, package_scene_dispatch__1place_of(lane, k));
            if (work.inside) {
                let weight = package_scene_dispatch__1sample_weight(batch, work.pixel, sample);
                package_scene_film__1store_sum(work, package_scene_film__1add_sample(package_scene_film__1load_sum(work), package_scene_film_Sample(package_scene_wide__1vector_at(radiance, k)), weight));
            }
            continuing {
                k += 1u;
                break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
            }
        }
        package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
        continuing {
            sample += 1u;
            break if sample >= batch.end_sample;
        }
    }
    package_scene_loops__1cut_off |= sample < batch.end_sample;
    package_scene_dispatch__1add_counts(lane);
}

fn trace(batch: package_scene_dispatch_Batch, rays: package_scene_rays_Rays, keys: package_scene_wide_Words, sample: u32) -> package_scene_wide_Vectors {
    var radiance = package_scene_wide__1no_vectors();
    var states = package_scene__1ray_stack__1camera_states(rays, batch.camera_media);
    var is_unfinished = false;
    loop {
        let hits = package_scene_rays__1closest_hits(states.rays);
        var next = states;
        var receivers = package_scene_direct__1no_receivers();
        var arriving = package_scene_wide__1no_vectors();
        var color = package_scene_wide__1no_vectors();
        is_unfinished = false;
        var k = 0u;
        loop {
            package_scene__1ray_stack__1current_tree = k;
            let state = package_scene__1ray_stack__1state_at(states, k);
            let hit = package_scene_rays__1hit_at(hits, k);
            var event = package_scene_optics_ScatterEvent(state.throughput, vec3f(1.0), vec3f(1.0), package_scene__1ray_stack__1no_ray(), package_scene__1ray_stack__1no_ray());
            if (state.ray.t_max >= 0.0) {
                package_scene_dispatch__1count_hit(state.kind, hit);
                if (hit.primitive == package_types_NONE) {
                    let seen = escaping_throughput(state) * package_scene_background_background(batch, state.ray.direction);
                    radiance = package_scene_wide__1vector_set(radiance, k, package_scene_wide__1vector_at(radiance, k) + seen);
                }
                else {
                    let contact = package_scene_contact__1contact_at(state.ray, hit);
                    var surface = contact.surface;
                    if (package_bindings__1HAS_TEXTURES) {
                        surface.phong = package_scene_texture__1textured_phong(surface.phong, surface.material, surface.place, surface.uv);
                    }
                    let factors = package_scene_texture__1texture_optics(surface);
                    if (package_bindings__1HAS_REFLECTION || package_bindings__1HAS_REFRACTION) {
                        event = package_scene_optics_scatter(batch, state, hit.t, contact, factors);
                        surface.phong.diffuse *= event.diffuse;
                        surface.phong.ambient *= event.diffuse;
                        surface.phong.specular *= event.highlight;
                    }
                    var key = package_types_SampleKey(package_scene_wide__1word_at(keys, k), sample, 1.0);
                    if (state.node > 1u) {
                        key.hash = package_lib_rng__1hash_combine(key.hash, state.node);
                        key.weight = package_lib_numeric__1max_component(event.arriving);
                    }
                    receivers = package_scene_direct__1receiver_set(receivers, k, surface, -state.ray.direction, key);
                    arriving = package_scene_wide__1vector_set(arriving, k, event.arriving);
                    color = package_scene_wide__1vector_set(color, k, own_light(batch, surface, factors[2]));
                }
            }
            if (package_bindings__1HAS_REFLECTION || package_bindings__1HAS_REFRACTION) {
                let following = package_scene__1ray_stack__1next_ray(event.reflected, event.refracted);
                next = package_scene__1ray_stack__1state_set(next, k, following);
                is_unfinished |= package_scene__1ray_stack__1is_alive(following);
            }
            continuing {
                k += 1u;
                break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
            }
        }
        package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
        let direct = package_scene_direct__1direct_light(batch, receivers, states.media, sample);
        radiance.x += arriving.x * (color.x + direct.x);
        radiance.y += arriving.y * (color.y + direct.y);
        radiance.z += arriving.z * (color.z + direct.z);
        states = next;
        continuing {
        
            break if !package_scene_rays__1any_lane(is_unfinished);
        }
    }
    package_scene_loops__1cut_off |= is_unfinished;
    return radiance;
}

fn escaping_throughput(state: package_scene__1ray_stack_RayState) -> vec3f {
    var throughput = state.throughput;
    if (package_bindings__1HAS_REFRACTION) {
        throughput *= package_scene_medium_transmittance(package_scene_medium__1medium_of(package_scene_medium_dominant(state.media)), state.ray.t_max);
    }
    return throughput;
}

fn own_light(batch: package_scene_dispatch_Batch, surface: package_types_Surface, glow: vec3f) -> vec3f {
    var color = batch.ambient * surface.phong.ambient;
    if (package_bindings__1HAS_EMISSION) {
        let shines = surface.outside || (package_scene_fetch__1load_optics(surface.material).flags & package_types__2MATERIAL_TWO_SIDED) != 0u;
        let emission = select(vec3f(0.0), glow * package_scene_fetch__1load_emission(surface.material), shines);
        color += emission;
    }
    return color;
}

var<private> package_scene_packet_lanes__1packet_lane: u32;

struct package_scene_packet_lanes_FourRays {
    r0: package_scene_primitive_TraversalRay,
    r1: package_scene_primitive_TraversalRay,
    r2: package_scene_primitive_TraversalRay,
    r3: package_scene_primitive_TraversalRay
}

struct package_scene_packet_lanes_TwoHits {
    hit: package_types_Hit,
    second: package_types_Hit
}

struct package_scene_packet_lanes_FourHits {
    h0: package_scene_packet_lanes_TwoHits,
    h1: package_scene_packet_lanes_TwoHits,
    h2: package_scene_packet_lanes_TwoHits,
    h3: package_scene_packet_lanes_TwoHits
}

fn package_scene_packet_lanes__1start_packets(lane: u32) {
    package_scene_packet_lanes__1packet_lane = lane;
}

fn package_scene_packet_lanes__3any_lane_of_packet(condition: bool) -> bool {
    var found = select(0u, 1u, condition);
    found |= subgroupShuffle(found, package_scene_packet_lanes__1packet_lane ^ 1u);
    found |= subgroupShuffle(found, package_scene_packet_lanes__1packet_lane ^ 2u);
    found |= subgroupShuffle(found, package_scene_packet_lanes__1packet_lane ^ 4u);
    return found != 0u;
}

fn package_scene_packet_lanes__1closer_two(at: package_scene_primitive_TraversalRay, before: package_scene_packet_lanes_TwoHits, candidate: package_types_Candidate, primitive: u32) -> package_scene_packet_lanes_TwoHits {
    package_scene_primitive__1runner_up = before.second;
    let hit = package_scene_primitive__1closer_of(at, before.hit, candidate, primitive);
    return package_scene_packet_lanes_TwoHits(hit, package_scene_primitive__1runner_up);
}

const package_scene__1ray_stack__1KIND_PRIMARY: u32 = 0u;

const package_scene__1ray_stack__1KIND_REFLECTED: u32 = 1u;

const package_scene__1ray_stack__1KIND_REFRACTED: u32 = 2u;

struct package_scene__1ray_stack_RayState {
    ray: package_types_Ray,
    throughput: vec3f,
    media: vec4u,
    depth: u32,
    kind: u32,
    node: u32
}

struct package_scene__1ray_stack_Media {
    x: package_scene_wide_Words,
    y: package_scene_wide_Words,
    z: package_scene_wide_Words,
    w: package_scene_wide_Words
}

struct package_scene__1ray_stack_RayStates {
    rays: package_scene_rays_Rays,
    throughput: package_scene_wide_Vectors,
    media: package_scene__1ray_stack_Media,
    step: package_scene_wide_Words,
    node: package_scene_wide_Words
}

const package_scene__1ray_stack__2RAY_STACK_SIZE: u32 = 9u;

const package_scene__1ray_stack__2MAX_TREE_RAYS: u32 = 1024u;

const package_scene__1ray_stack__1ENTRY_WORDS: u32 = 14u;

var<workgroup> package_scene__1ray_stack__1ray_stack: array<u32, 8064>;

var<private> package_scene__1ray_stack__1stack_lane: u32;

var<private> package_scene__1ray_stack__1stack_counts: package_scene_wide_Words;

var<private> package_scene__1ray_stack__1tree_rays: package_scene_wide_Words;

var<private> package_scene__1ray_stack__1current_tree: u32;

var<private> package_scene__1ray_stack__2trees_cut_off: package_scene_wide_Words;

var<private> package_scene__1ray_stack__2cut_off_trees: u32 = 0u;

fn package_scene__1ray_stack__1is_alive(state: package_scene__1ray_stack_RayState) -> bool {
    return any(state.throughput > vec3f(0.0));
}

fn package_scene__1ray_stack__1camera_states(rays: package_scene_rays_Rays, media: vec4u) -> package_scene__1ray_stack_RayStates {
    package_scene__1ray_stack__1stack_counts = package_scene_wide_Words(0u);
    package_scene__1ray_stack__1tree_rays = package_scene_wide_Words(0u);
    package_scene__1ray_stack__2trees_cut_off = package_scene_wide_Words(0u);
    let all = package_scene_wide_Floats(1.0);
    return package_scene__1ray_stack_RayStates(rays, package_scene_wide_Vectors(all, all, all), package_scene__1ray_stack_Media(package_scene_wide_Words(media.x), package_scene_wide_Words(media.y), package_scene_wide_Words(media.z), package_scene_wide_Words(media.w)), package_scene_wide_Words(package_scene__1ray_stack__1KIND_PRIMARY), package_scene_wide_Words(1u));
}

fn package_scene__1ray_stack__1state_at(states: package_scene__1ray_stack_RayStates, k: u32) -> package_scene__1ray_stack_RayState {
    let step = package_scene_wide__1word_at(states.step, k);
    return package_scene__1ray_stack_RayState(package_scene_rays__1ray_at(states.rays, k), package_scene_wide__1vector_at(states.throughput, k), package_scene__1ray_stack__1media_at(states.media, k), step >> 2u, step & 3u, package_scene_wide__1word_at(states.node, k));
}

fn package_scene__1ray_stack__1state_set(states: package_scene__1ray_stack_RayStates, k: u32, state: package_scene__1ray_stack_RayState) -> package_scene__1ray_stack_RayStates {
    return package_scene__1ray_stack_RayStates(package_scene_rays__1ray_set(states.rays, k, state.ray), package_scene_wide__1vector_set(states.throughput, k, state.throughput), package_scene__1ray_stack__1media_set(states.media, k, state.media), package_scene_wide__1word_set(states.step, k, (state.depth << 2u) | state.kind), package_scene_wide__1word_set(states.node, k, state.node));
}

fn package_scene__1ray_stack__1media_at(all: package_scene__1ray_stack_Media, k: u32) -> vec4u {
    return vec4u(package_scene_wide__1word_at(all.x, k), package_scene_wide__1word_at(all.y, k), package_scene_wide__1word_at(all.z, k), package_scene_wide__1word_at(all.w, k));
}

fn package_scene__1ray_stack__1media_set(all: package_scene__1ray_stack_Media, k: u32, media: vec4u) -> package_scene__1ray_stack_Media {
    return package_scene__1ray_stack_Media(package_scene_wide__1word_set(all.x, k, media.x), package_scene_wide__1word_set(all.y, k, media.y), package_scene_wide__1word_set(all.z, k, media.z), package_scene_wide__1word_set(all.w, k, media.w));
}

fn package_scene__1ray_stack__1no_ray() -> package_scene__1ray_stack_RayState {
    return package_scene__1ray_stack_RayState(package_scene_rays_DEAD, vec3f(0.0), vec4u(package_types_NONE), 0u, 0u, 0u);
}

fn package_scene__1ray_stack__1next_ray(reflected: package_scene__1ray_stack_RayState, refracted: package_scene__1ray_stack_RayState) -> package_scene__1ray_stack_RayState {
    let k = package_scene__1ray_stack__1current_tree;
    let count = package_scene_wide__1word_at(package_scene__1ray_stack__1stack_counts, k);
    let rays = package_scene_wide__1word_at(package_scene__1ray_stack__1tree_rays, k) + 1u;
    package_scene__1ray_stack__1tree_rays = package_scene_wide__1word_set(package_scene__1ray_stack__1tree_rays, k, rays);
    let sends_both = package_scene__1ray_stack__1is_alive(reflected) && package_scene__1ray_stack__1is_alive(refracted);
    let goes_on = package_scene__1ray_stack__1is_alive(reflected) || package_scene__1ray_stack__1is_alive(refracted) || count > 0u;
    if (goes_on && rays >= package_scene__1ray_stack__2MAX_TREE_RAYS) {
        package_scene__1ray_stack__1cut_tree();
        package_scene__1ray_stack__1stack_counts = package_scene_wide__1word_set(package_scene__1ray_stack__1stack_counts, k, 0u);
        return package_scene__1ray_stack__1no_ray();
    }
    if (sends_both) {
        let reflected_is_weaker = package_scene__1ray_stack_strength(reflected) < package_scene__1ray_stack_strength(refracted);
        if (count == package_scene__1ray_stack__2RAY_STACK_SIZE) {
            package_scene__1ray_stack__1cut_tree();
            return package_scene__1ray_stack_choose(reflected, refracted, !reflected_is_weaker);
        }
        package_scene__1ray_stack_push(k, package_scene__1ray_stack_choose(reflected, refracted, !reflected_is_weaker));
        return package_scene__1ray_stack_choose(reflected, refracted, reflected_is_weaker);
    }
    if (package_scene__1ray_stack__1is_alive(refracted)) {
        return refracted;
    }
    if (package_scene__1ray_stack__1is_alive(reflected)) {
        return reflected;
    }
    return package_scene__1ray_stack_pop(k);
}

fn package_scene__1ray_stack__1cut_tree() {
    package_scene__1ray_stack__2cut_off_trees += 1u - package_scene_wide__1word_at(package_scene__1ray_stack__2trees_cut_off, package_scene__1ray_stack__1current_tree);
    package_scene__1ray_stack__2trees_cut_off = package_scene_wide__1word_set(package_scene__1ray_stack__2trees_cut_off, package_scene__1ray_stack__1current_tree, 1u);
}

fn package_scene__1ray_stack_choose(reflected: package_scene__1ray_stack_RayState, refracted: package_scene__1ray_stack_RayState, first: bool) -> package_scene__1ray_stack_RayState {
    if (first) {
        return reflected;
    }
    return refracted;
}

fn package_scene__1ray_stack_strength(state: package_scene__1ray_stack_RayState) -> f32 {
    return dot(state.throughput, vec3f(1.0));
}

fn package_scene__1ray_stack__1place_of(state: package_scene__1ray_stack_RayState) -> u32 {
    return (state.ray.leaving_instance << 12u) | (state.depth << 2u) | state.kind;
}

fn package_scene__1ray_stack_stored(origin: vec3f, leaving: u32, direction: vec3f, place: u32, throughput: vec3f, node: u32, media: vec4u) -> package_scene__1ray_stack_RayState {
    return package_scene__1ray_stack_RayState(package_types_Ray(origin, package_lib_camera__1T_FAR, direction, leaving, place >> 12u), throughput, media, (place >> 2u) & 1023u, place & 3u, node);
}

fn package_scene__1ray_stack__1entry_start(k: u32, index: u32) -> u32 {
    return package_scene__1ray_stack__1ENTRY_WORDS * ((package_scene_wide__2RAYS_PER_LANE * package_scene__1ray_stack__1stack_lane + k) * package_scene__1ray_stack__2RAY_STACK_SIZE + index);
}

fn package_scene__1ray_stack_push(k: u32, state: package_scene__1ray_stack_RayState) {
    let count = package_scene_wide__1word_at(package_scene__1ray_stack__1stack_counts, k);
    let at = package_scene__1ray_stack__1entry_start(k, count);
    package_scene__1ray_stack__1ray_stack[at] = bitcast<u32>(state.ray.origin.x);
    package_scene__1ray_stack__1ray_stack[at + 1u] = bitcast<u32>(state.ray.origin.y);
    package_scene__1ray_stack__1ray_stack[at + 2u] = bitcast<u32>(state.ray.origin.z);
    package_scene__1ray_stack__1ray_stack[at + 3u] = state.ray.leaving;
    package_scene__1ray_stack__1ray_stack[at + 4u] = bitcast<u32>(state.ray.direction.x);
    package_scene__1ray_stack__1ray_stack[at + 5u] = bitcast<u32>(state.ray.direction.y);
    package_scene__1ray_stack__1ray_stack[at + 6u] = bitcast<u32>(state.ray.direction.z);
    package_scene__1ray_stack__1ray_stack[at + 7u] = package_scene__1ray_stack__1place_of(state);
    package_scene__1ray_stack__1ray_stack[at + 8u] = bitcast<u32>(state.throughput.x);
    package_scene__1ray_stack__1ray_stack[at + 9u] = bitcast<u32>(state.throughput.y);
    package_scene__1ray_stack__1ray_stack[at + 10u] = bitcast<u32>(state.throughput.z);
    package_scene__1ray_stack__1ray_stack[at + 11u] = state.node;
    package_scene__1ray_stack__1ray_stack[at + 12u] = (state.media.x & 65535u) | (state.media.y << 16u);
    package_scene__1ray_stack__1ray_stack[at + 13u] = (state.media.z & 65535u) | (state.media.w << 16u);
    package_scene__1ray_stack__1stack_counts = package_scene_wide__1word_set(package_scene__1ray_stack__1stack_counts, k, count + 1u);
}

fn package_scene__1ray_stack_pop(k: u32) -> package_scene__1ray_stack_RayState {
    let count = package_scene_wide__1word_at(package_scene__1ray_stack__1stack_counts, k);
    if (count == 0u) {
        return package_scene__1ray_stack__1no_ray();
    }
    package_scene__1ray_stack__1stack_counts = package_scene_wide__1word_set(package_scene__1ray_stack__1stack_counts, k, count - 1u);
    let at = package_scene__1ray_stack__1entry_start(k, count - 1u);
    let media = vec4u(package_scene__1ray_stack__1ray_stack[at + 12u] & 65535u, package_scene__1ray_stack__1ray_stack[at + 12u] >> 16u, package_scene__1ray_stack__1ray_stack[at + 13u] & 65535u, package_scene__1ray_stack__1ray_stack[at + 13u] >> 16u);
    return package_scene__1ray_stack_stored(bitcast<vec3f>(vec3u(package_scene__1ray_stack__1ray_stack[at], package_scene__1ray_stack__1ray_stack[at + 1u], package_scene__1ray_stack__1ray_stack[at + 2u])), package_scene__1ray_stack__1ray_stack[at + 3u], bitcast<vec3f>(vec3u(package_scene__1ray_stack__1ray_stack[at + 4u], package_scene__1ray_stack__1ray_stack[at + 5u], package_scene__1ray_stack__1ray_stack[at + 6u])), package_scene__1ray_stack__1ray_stack[at + 7u], bitcast<vec3f>(vec3u(package_scene__1ray_stack__1ray_stack[at + 8u], package_scene__1ray_stack__1ray_stack[at + 9u], package_scene__1ray_stack__1ray_stack[at + 10u])), package_scene__1ray_stack__1ray_stack[at + 11u], select(media, vec4u(package_types_NONE), media == vec4u(65535u)));
}

struct package_scene_dispatch_Work {
    inside: bool,
    film_index: u32,
    pixel: vec2u
}

struct package_scene_dispatch_RayCounts {
    primary: u32,
    primary_hits: u32,
    shadow: u32,
    shadow_blocked: u32,
    reflection: u32,
    reflection_hits: u32,
    refraction: u32,
    refraction_hits: u32
}

var<private> package_scene_dispatch_counts: package_scene_dispatch_RayCounts;

fn package_scene_dispatch__1place_of(lane: u32, k: u32) -> u32 {
    {
        return ((lane & 4294967288u) << 2u) | (k << 3u) | (lane & 7u);
    }
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

struct package_scene_dispatch_Batch {
    camera: package_types_PackedCamera,
    background: vec3f,
    background_top: vec3f,
    background_rotation: f32,
    background_first_texel: u32,
    background_size: vec2u,
    ambient: vec3f,
    light_count: u32,
    picture_size: vec2f,
    seed: u32,
    first_sample: u32,
    end_sample: u32,
    max_depth: u32,
    min_throughput: f32,
    light_samples: f32,
    camera_media: vec4u
}

fn package_scene_dispatch__1load_batch() -> package_scene_dispatch_Batch {
    package_scene_fetch__1load_starts();
    let picture_size = vec2f(vec2u(package_bindings_dispatch.picture_width, package_bindings_dispatch.picture_height));
    return package_scene_dispatch_Batch(package_bindings_frame.camera, package_bindings_frame.background, package_bindings_frame.background_top, package_bindings_frame.background_rotation, package_bindings_frame.background_first_texel, vec2u(package_bindings_frame.background_width, package_bindings_frame.background_height), package_bindings_frame.ambient, package_bindings_frame.light_count, picture_size, package_bindings_dispatch.seed, package_bindings_dispatch.first_sample, package_bindings_dispatch.end_sample, package_bindings_dispatch.max_depth, package_bindings_dispatch.min_throughput, package_bindings_dispatch.light_samples, package_bindings_frame.camera_media);
}

fn package_scene_dispatch__1sample_ray(batch: package_scene_dispatch_Batch, pixel: vec2u, sample: u32) -> package_types_Ray {
    let key = package_lib_rng__1pixel_key(batch.seed, pixel);
    var within = vec2f(0.5);
    if (package_bindings_STRATIFIED) {
        within += package_lib_filter__1filter_offset(package_bindings_FILTER, package_bindings__1FILTER_RADIUS, package_lib_sampling__1stratified_2d(sample, key));
    }
    let position = vec2f(pixel) + within;
    if (package_bindings__1HAS_MOTION || package_bindings__1CAMERA_MOTION || package_bindings__1LIGHT_MOTION) {
        package_scene_shutter__1shutter_time = package_scene_dispatch__1sample_time(sample, key);
    }
    let camera = package_scene_shutter__1shutter_camera(batch.camera);
    if (package_bindings__1HAS_LENS && package_bindings_ORTHOGRAPHIC) {
        return package_lib_camera__2parallel_lens_ray(camera, position, batch.picture_size, package_lib_sampling__1stratified_34(sample, key));
    }
    if (package_bindings__1HAS_LENS) {
        return package_lib_camera__1lens_ray(camera, position, batch.picture_size, package_lib_sampling__1stratified_34(sample, key));
    }
    if (package_bindings_ORTHOGRAPHIC) {
        return package_lib_camera__1parallel_ray(camera, position, batch.picture_size);
    }
    return package_lib_camera__1camera_ray(camera, position, batch.picture_size);
}

fn package_scene_dispatch__1sample_time(sample: u32, key: u32) -> f32 {
    if (package_bindings__1HAS_LENS) {
        return package_lib_sampling__1stratified_1d(sample, key);
    }
    return package_lib_sampling__1stratified_34(sample, key).x;
}

fn package_scene_dispatch__1sample_weight(batch: package_scene_dispatch_Batch, pixel: vec2u, sample: u32) -> f32 {
    if (!package_bindings_STRATIFIED) {
        return 1.0;
    }
    return package_lib_filter__1filter_sign(package_bindings_FILTER, package_lib_sampling__1stratified_2d(sample, package_lib_rng__1pixel_key(batch.seed, pixel)));
}

fn package_scene_dispatch__1count_hit(kind: u32, hit: package_types_Hit) {
    if (package_bindings__1COUNT_RAYS) {
        let hits = select(0u, 1u, hit.primitive != package_types_NONE);
        if (kind == package_scene__1ray_stack__1KIND_PRIMARY) {
            package_scene_dispatch_counts.primary += 1u;
            package_scene_dispatch_counts.primary_hits += hits;
        }
        else if (kind == package_scene__1ray_stack__1KIND_REFLECTED) {
            package_scene_dispatch_counts.reflection += 1u;
            package_scene_dispatch_counts.reflection_hits += hits;
        }
        else {
            package_scene_dispatch_counts.refraction += 1u;
            package_scene_dispatch_counts.refraction_hits += hits;
        }
    }
}

fn package_scene_dispatch__1add_counts(lane: u32) {
    if (package_bindings__1COUNT_RAYS) {
        atomicAdd(&package_bindings_dispatch.counters.primary, package_scene_dispatch_counts.primary);
        atomicAdd(&package_bindings_dispatch.counters.primary_hits, package_scene_dispatch_counts.primary_hits);
        atomicAdd(&package_bindings_dispatch.counters.shadow, package_scene_dispatch_counts.shadow);
        atomicAdd(&package_bindings_dispatch.counters.shadow_blocked, package_scene_dispatch_counts.shadow_blocked);
        if (package_bindings__1HAS_REFLECTION || package_bindings__1HAS_REFRACTION) {
            atomicAdd(&package_bindings_dispatch.counters.reflection, package_scene_dispatch_counts.reflection);
            atomicAdd(&package_bindings_dispatch.counters.reflection_hits, package_scene_dispatch_counts.reflection_hits);
            atomicAdd(&package_bindings_dispatch.counters.refraction, package_scene_dispatch_counts.refraction);
            atomicAdd(&package_bindings_dispatch.counters.refraction_hits, package_scene_dispatch_counts.refraction_hits);
        }
    }
    if ((package_bindings__1HAS_REFLECTION || package_bindings__1HAS_REFRACTION) && package_scene__1ray_stack__2cut_off_trees > 0u) {
        atomicAdd(&package_bindings_dispatch.counters.cut_off_trees, package_scene__1ray_stack__2cut_off_trees);
    }
    if (package_scene_loops__1cut_off) {
        atomicAdd(&package_bindings_dispatch.counters.cut_off_paths, 1u);
    }
    if (lane == 0u) {
        atomicAdd(&package_bindings_dispatch.counters.groups_done, 1u);
    }
}

const package_types_NONE: u32 = 4294967295u;

const package_types_LEAF: u32 = 2147483648u;

const package_types_SHAPE: u32 = 1073741824u;

const package_types__2LEAF_COUNT_ONE: u32 = 134217728u;

const package_types__2LEAF_COUNT_MASK: u32 = 939524096u;

const package_types__2LEAF_FIRST_MASK: u32 = 134217727u;

const package_types_INSTANCE: u32 = 4160749568u;

const package_types__1NO_INSTANCE: u32 = 1048575u;

const package_types__1INSTANCE_ROWS: u32 = 10u;

const package_types__1KEY_ROWS: u32 = 4u;

const package_types__1LIGHT_ROWS: u32 = 6u;

const package_types__1CAMERA_ROWS: u32 = 4u;

const package_types__1SHAPE_ROWS: u32 = 5u;

const package_types__2IMAGE_WIDTH_LOG2: u32 = 12u;

const package_types__1SHAPE_SPHERE: u32 = 0u;

const package_types__1SHAPE_PLANE: u32 = 1u;

const package_types__1SHAPE_DISC: u32 = 2u;

const package_types__1SHAPE_RECTANGLE: u32 = 3u;

const package_types__1SHAPE_BOX: u32 = 4u;

const package_types__1SHAPE_CONE: u32 = 5u;

const package_types__1SHAPE_TORUS: u32 = 6u;

const package_types__1SHAPE_ELLIPSOID: u32 = 7u;

const package_types__1SHAPE_GLOBE: u32 = 8u;

const package_types__1SHAPE_CAPPED: u32 = 1u;

const package_types__1LIGHT_DIRECTIONAL: u32 = 1u;

const package_types__1LIGHT_SPOT: u32 = 2u;

const package_types__1LIGHT_RECTANGLE: u32 = 3u;

const package_types__1LIGHT_SPHERE: u32 = 5u;

const package_types__2ATTENUATION_INVERSE_SQUARE: u32 = 1u;

const package_types__2MATERIAL_TWO_SIDED: u32 = 1u;

const package_types__1MATERIAL_FRESNEL: u32 = 2u;

const package_types__1MATERIAL_SCHLICK: u32 = 4u;

const package_types__1MATERIAL_SUM: u32 = 8u;

const package_types__1MATERIAL_BLEND: u32 = 16u;

const package_types__1MATERIAL_ROWS: u32 = 8u;

const package_types__1TEXTURE_ROWS: u32 = 6u;

const package_types__1NO_TEXTURE: u32 = 65535u;

const package_types__1PATTERN_STRIPES: u32 = 1u;

const package_types__1PATTERN_GRADIENT: u32 = 2u;

const package_types__1PATTERN_NOISE: u32 = 3u;

const package_types__1PATTERN_PICTURE: u32 = 4u;

const package_types__1TEXTURE_UV: u32 = 1u;

const package_types__1TEXTURE_NEAREST: u32 = 2u;

const package_types__1BACKGROUND_COLOR: u32 = 0u;

const package_types__1BACKGROUND_GRADIENT: u32 = 1u;

const package_types__1BACKGROUND_PICTURE: u32 = 2u;

const package_types__1FILTER_BOX: u32 = 0u;

const package_types__1FILTER_TENT: u32 = 1u;

const package_types__1FILTER_GAUSSIAN: u32 = 2u;

const package_types__2FILTER_BLACKMAN_HARRIS: u32 = 3u;

const package_types__1FILTER_MITCHELL: u32 = 4u;

const package_types__2TRIANGLE_TEST_PLANE: u32 = 0u;

const package_types__3TRIANGLE_TEST_MOLLER_TRUMBORE: u32 = 1u;

const package_types__2TRIANGLE_TEST_WATERTIGHT: u32 = 2u;

struct package_types_PackedTriangle {
    v0: vec3f,
    i0: u32,
    v1: vec3f,
    i1: u32,
    v2: vec3f,
    i2: u32
}

struct package_types_PackedVertex {
    normal: vec3f,
    material: u32
}

struct package_types_PackedShape {
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

struct package_types_PackedInstance {
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
    _pad: u32,
    pattern_x: vec4f,
    pattern_y: vec4f,
    pattern_z: vec4f
}

struct package_types_PackedKey {
    translation: vec3f,
    _pad0: u32,
    rotation: vec4f,
    stretch: vec3f,
    _pad1: u32,
    shear: vec3f,
    _pad2: u32
}

struct package_types_PackedTexture {
    color_a: vec3f,
    kind: u32,
    color_b: vec3f,
    flags: u32,
    row_x: vec4f,
    row_y: vec4f,
    row_z: vec4f,
    first_texel: u32,
    width: u32,
    height: u32,
    octaves: u32
}

struct package_types_PackedLight {
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
    _pad0: u32,
    _pad1: u32,
    _pad2: u32
}

struct package_types_PackedCamera {
    origin: vec3f,
    lens_radius: f32,
    forward: vec3f,
    focus_distance: f32,
    right: vec3f,
    blade_rotation: f32,
    up: vec3f,
    blade_count: u32
}

struct package_types_PackedFrame {
    camera: package_types_PackedCamera,
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
    background_first_texel: u32,
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
    shape_row: u32
}

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

struct package_types_Ray {
    origin: vec3f,
    t_max: f32,
    direction: vec3f,
    leaving: u32,
    leaving_instance: u32
}

struct package_types_Candidate {
    hit: bool,
    t: f32,
    b1: f32,
    b2: f32
}

struct package_types_Hit {
    t: f32,
    primitive: u32,
    b1: f32,
    b2: f32,
    instance: u32
}

struct package_types_Phong {
    diffuse: vec3f,
    specular: vec3f,
    shininess: f32,
    ambient: vec3f,
    reflect: vec3f
}

struct package_types_Medium {
    absorption: vec3f,
    ior: f32,
    priority: i32
}

struct package_types_Surface {
    p: vec3f,
    n: vec3f,
    ng: vec3f,
    error: vec3f,
    leaving: u32,
    outside: bool,
    uv: vec2f,
    material: u32,
    phong: package_types_Phong,
    id: u32,
    place: vec3f,
    instance: u32
}

struct package_types_Optics {
    transmit: vec3f,
    opacity: f32,
    ior: f32,
    flags: u32
}

struct package_types_Incident {
    direction: vec3f,
    distance: f32,
    radiance: vec3f
}

struct package_types_SampleKey {
    hash: u32,
    index: u32,
    weight: f32
}

var<private> package_scene_fetch__1shape_row: u32;

var<private> package_scene_fetch__1light_row: u32;

fn package_scene_fetch__1load_starts() {
    package_scene_fetch__1shape_row = package_bindings_frame.shape_row;
    package_scene_fetch__1light_row = package_bindings_frame.light_row;
}

fn package_scene_fetch__1load_instance(index: u32) -> package_types_PackedInstance {
    let row = package_bindings_frame.instance_row + package_types__1INSTANCE_ROWS * index;
    let r0 = package_scene_fetch__1node_row(row);
    let r1 = package_scene_fetch__1node_row(row + 1u);
    let r2 = package_scene_fetch__1node_row(row + 2u);
    let r3 = package_scene_fetch__1node_row(row + 3u);
    let r4 = package_scene_fetch__1node_row(row + 4u);
    let r5 = package_scene_fetch__1node_row(row + 5u);
    let r6 = package_scene_fetch__1node_row(row + 6u);
    return package_types_PackedInstance(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec3f>(r2.xyz), r2.w, bitcast<vec3f>(r3.xyz), r3.w, bitcast<vec3f>(r4.xyz), r4.w, bitcast<vec3f>(r5.xyz), r5.w, bitcast<vec3f>(r6.xyz), r6.w, bitcast<vec4f>(package_scene_fetch__1node_row(row + 7u)), bitcast<vec4f>(package_scene_fetch__1node_row(row + 8u)), bitcast<vec4f>(package_scene_fetch__1node_row(row + 9u)));
}

fn package_scene_fetch__1load_key(index: u32) -> package_types_PackedKey {
    let row = package_bindings_frame.key_row + package_types__1KEY_ROWS * index;
    return package_types_PackedKey(bitcast<vec3f>(package_scene_fetch__1node_row(row).xyz), 0u, bitcast<vec4f>(package_scene_fetch__1node_row(row + 1u)), bitcast<vec3f>(package_scene_fetch__1node_row(row + 2u).xyz), 0u, bitcast<vec3f>(package_scene_fetch__1node_row(row + 3u).xyz), 0u);
}

fn package_scene_fetch__1load_light(index: u32) -> package_types_PackedLight {
    let row = package_scene_fetch__1light_row + package_types__1LIGHT_ROWS * index;
    let r0 = package_scene_fetch__1node_row(row);
    let r1 = package_scene_fetch__1node_row(row + 1u);
    let r2 = package_scene_fetch__1node_row(row + 2u);
    let r3 = package_scene_fetch__1node_row(row + 3u);
    let r4 = package_scene_fetch__1node_row(row + 4u);
    return package_types_PackedLight(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec3f>(r2.xyz), bitcast<f32>(r2.w), bitcast<vec3f>(r3.xyz), bitcast<f32>(r3.w), bitcast<vec3f>(r4.xyz), bitcast<f32>(r4.w), package_scene_fetch__1node_row(row + 5u).x, 0u, 0u, 0u);
}

fn package_scene_fetch__1load_camera(key: u32) -> package_types_PackedCamera {
    let row = package_scene_fetch__1light_row + package_types__1LIGHT_ROWS * package_bindings_frame.light_count * package_bindings_frame.light_key_count + package_types__1CAMERA_ROWS * key;
    let r0 = package_scene_fetch__1node_row(row);
    let r1 = package_scene_fetch__1node_row(row + 1u);
    let r2 = package_scene_fetch__1node_row(row + 2u);
    let r3 = package_scene_fetch__1node_row(row + 3u);
    return package_types_PackedCamera(bitcast<vec3f>(r0.xyz), bitcast<f32>(r0.w), bitcast<vec3f>(r1.xyz), bitcast<f32>(r1.w), bitcast<vec3f>(r2.xyz), bitcast<f32>(r2.w), bitcast<vec3f>(r3.xyz), r3.w);
}

fn package_scene_fetch__1load_triangle(index: u32) -> package_types_PackedTriangle {
    let row = 3u * index;
    let r0 = package_scene_fetch__1triangle_row(row);
    let r1 = package_scene_fetch__1triangle_row(row + 1u);
    let r2 = package_scene_fetch__1triangle_row(row + 2u);
    return package_types_PackedTriangle(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec3f>(r2.xyz), r2.w);
}

fn package_scene_fetch__1load_shape(index: u32) -> package_types_PackedShape {
    let row = package_scene_fetch__1shape_row + package_types__1SHAPE_ROWS * index;
    return package_scene_fetch__1shape_of(package_scene_fetch__1triangle_row(row), package_scene_fetch__1triangle_row(row + 1u), package_scene_fetch__1triangle_row(row + 2u), package_scene_fetch__1triangle_row(row + 3u), package_scene_fetch__1triangle_row(row + 4u));
}

fn package_scene_fetch__1shape_of(r0: vec4u, r1: vec4u, r2: vec4u, r3: vec4u, r4: vec4u) -> package_types_PackedShape {
    return package_types_PackedShape(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), bitcast<f32>(r1.w), bitcast<vec3f>(r2.xyz), bitcast<f32>(r2.w), bitcast<vec3f>(r3.xyz), r3.w, r4.x, r4.y, 0u, 0u);
}

fn package_scene_fetch__1load_vertex(index: u32) -> package_types_PackedVertex {
    let r0 = package_scene_fetch__1vertex_row(index);
    return package_types_PackedVertex(bitcast<vec3f>(r0.xyz), r0.w);
}

struct package_scene_fetch_PhongMaterial {
    phong: package_types_Phong,
    flags: u32
}

fn package_scene_fetch__1load_material(index: u32) -> package_scene_fetch_PhongMaterial {
    let row = package_types__1MATERIAL_ROWS * index;
    let r0 = package_scene_fetch__1material_row(row);
    let r1 = package_scene_fetch__1material_row(row + 1u);
    let r2 = package_scene_fetch__1material_row(row + 2u);
    var reflect = vec3f(0.0);
    if (package_bindings__1HAS_REFLECTION) {
        reflect = bitcast<vec3f>(package_scene_fetch__1material_row(row + 3u).xyz);
    }
    let phong = package_types_Phong(bitcast<vec3f>(r0.xyz), bitcast<vec3f>(r1.xyz), bitcast<f32>(r0.w), bitcast<vec3f>(r2.xyz), reflect);
    return package_scene_fetch_PhongMaterial(phong, r1.w);
}

fn package_scene_fetch__1load_optics(index: u32) -> package_types_Optics {
    let row = package_types__1MATERIAL_ROWS * index;
    let r1 = package_scene_fetch__1material_row(row + 1u);
    let r2 = package_scene_fetch__1material_row(row + 2u);
    let r3 = package_scene_fetch__1material_row(row + 3u);
    let r4 = package_scene_fetch__1material_row(row + 4u);
    return package_types_Optics(bitcast<vec3f>(r4.xyz), bitcast<f32>(r2.w), bitcast<f32>(r3.w), r1.w);
}

fn package_scene_fetch__1load_medium(index: u32) -> package_types_Medium {
    let row = package_types__1MATERIAL_ROWS * index;
    let r5 = package_scene_fetch__1material_row(row + 5u);
    return package_types_Medium(bitcast<vec3f>(r5.xyz), bitcast<f32>(package_scene_fetch__1material_row(row + 3u).w), bitcast<i32>(package_scene_fetch__1material_row(row + 4u).w));
}

fn package_scene_fetch__1load_emission(index: u32) -> vec3f {
    return bitcast<vec3f>(package_scene_fetch__1material_row(package_types__1MATERIAL_ROWS * index + 6u).xyz);
}

fn package_scene_fetch__2load_texture_indices(index: u32) -> vec3u {
    return package_scene_fetch__1material_row(package_types__1MATERIAL_ROWS * index + 7u).xyz;
}

fn package_scene_fetch__1load_texture(index: u32) -> package_types_PackedTexture {
    let row = package_types__1MATERIAL_ROWS * package_bindings_frame.material_count + package_types__1TEXTURE_ROWS * index;
    let r0 = package_scene_fetch__1material_row(row);
    let r1 = package_scene_fetch__1material_row(row + 1u);
    let r5 = package_scene_fetch__1material_row(row + 5u);
    return package_types_PackedTexture(bitcast<vec3f>(r0.xyz), r0.w, bitcast<vec3f>(r1.xyz), r1.w, bitcast<vec4f>(package_scene_fetch__1material_row(row + 2u)), bitcast<vec4f>(package_scene_fetch__1material_row(row + 3u)), bitcast<vec4f>(package_scene_fetch__1material_row(row + 4u)), r5.x, r5.y, r5.z, r5.w);
}

fn package_scene_fetch__1load_uv(index: u32) -> vec2f {
    return bitcast<vec2f>(package_scene_fetch__1vertex_row(package_bindings_frame.vertex_count + index).xy);
}

fn package_scene_fetch__1load_texel(index: u32) -> vec3f {
    let place = vec2u(index & ((1u << package_types__2IMAGE_WIDTH_LOG2) - 1u), index >> package_types__2IMAGE_WIDTH_LOG2);
    return textureLoad(package_bindings_texels, place, 0).xyz;
}

fn package_scene_fetch_texel(row: u32) -> vec2u {
    return vec2u(row & ((1u << package_types__2IMAGE_WIDTH_LOG2) - 1u), row >> package_types__2IMAGE_WIDTH_LOG2);
}

fn package_scene_fetch__1node_row(row: u32) -> vec4u {
    return textureLoad(package_bindings_nodes, package_scene_fetch_texel(row));
}

fn package_scene_fetch__1triangle_row(row: u32) -> vec4u {
    return textureLoad(package_bindings_triangles, package_scene_fetch_texel(row));
}

fn package_scene_fetch__1vertex_row(row: u32) -> vec4u {
    return textureLoad(package_bindings_vertices, package_scene_fetch_texel(row));
}

fn package_scene_fetch__1material_row(row: u32) -> vec4u {
    return textureLoad(package_bindings_materials, package_scene_fetch_texel(row));
}

@group(0) @binding(0)
var package_bindings_nodes: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(1)
var package_bindings_triangles: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(2)
var package_bindings_vertices: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(3)
var package_bindings_materials: texture_storage_2d<rgba32uint, read>;

@group(0) @binding(4)
var package_bindings_texels: texture_2d<f32>;

@group(1) @binding(0)
var<storage, read> package_bindings_frame: package_types_PackedFrame;

@group(1) @binding(1)
var<storage, read_write> package_bindings_dispatch: package_types_PackedDispatch;

@group(2) @binding(0)
var<storage, read_write> package_bindings_film: array<vec4f>;

override package_bindings__1TRIANGLE_TEST: u32 = package_types__2TRIANGLE_TEST_WATERTIGHT;

override package_bindings__1HAS_TRIANGLES: bool = true;

override package_bindings__1HAS_SHAPES: bool = true;

override package_bindings__1HAS_PLANES: bool = true;

override package_bindings__1MOSTLY_SHAPES: bool = false;

override package_bindings__1MIXED_MATERIALS: bool = true;

override package_bindings__1FIXED_OFFSET: f32 = 0.0;

override package_bindings_STRATIFIED: bool = false;

override package_bindings__1COUNT_RAYS: bool = false;

override package_bindings__1COUNT_STEPS: bool = false;

override package_bindings__1HAS_LIGHTS: bool = true;

override package_bindings__1SHAPE_KINDS: u32 = 4294967295u;

override package_bindings__1HAS_REFLECTION: bool = true;

override package_bindings__1HAS_REFRACTION: bool = true;

override package_bindings__1HAS_CONTACT: bool = true;

override package_bindings__1FILTERED_SHADOWS: bool = false;

override package_bindings__2HAS_AREA_LIGHTS: bool = true;

override package_bindings__1HAS_LENS: bool = true;

override package_bindings_FILTER: u32 = package_types__1FILTER_BOX;

override package_bindings__1FILTER_RADIUS: f32 = 0.5;

override package_bindings_BACKGROUND: u32 = package_types__1BACKGROUND_COLOR;

override package_bindings__1HAS_TEXTURES: bool = true;

override package_bindings__1HAS_EMISSION: bool = true;

override package_bindings_ADAPTIVE: bool = false;

override package_bindings__1HAS_INSTANCES: bool = true;

override package_bindings__1HAS_MOTION: bool = true;

override package_bindings__1CAMERA_MOTION: bool = true;

override package_bindings__1LIGHT_MOTION: bool = true;

override package_bindings_ORTHOGRAPHIC: bool = false;

override package_bindings__1HAS_UVS: bool = true;

override package_bindings__1FILM_ROWS: u32 = 1u;

override package_bindings__1SQUARES_ROW: u32 = 1u;

struct package_scene_rays_Rays {
    origin: package_scene_wide_Vectors,
    direction: package_scene_wide_Vectors,
    t_max: package_scene_wide_Floats,
    leaving: package_scene_wide_Words,
    leaving_instance: package_scene_wide_Words
}

struct package_scene_rays_Hits {
    t: package_scene_wide_Floats,
    primitive: package_scene_wide_Words,
    b1: package_scene_wide_Floats,
    b2: package_scene_wide_Floats,
    instance: package_scene_wide_Words
}

const package_scene_rays_DEAD: package_types_Ray = package_types_Ray(vec3f(0.0), -1.0, vec3f(0.0, 0.0, 1.0), package_types_NONE, package_types__1NO_INSTANCE);

fn package_scene_rays__1dead_rays() -> package_scene_rays_Rays {
    return package_scene_rays_Rays(package_scene_wide_Vectors(package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0)), package_scene_wide_Vectors(package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0), package_scene_wide_Floats(1.0)), package_scene_wide_Floats(-1.0), package_scene_wide_Words(package_types_NONE), package_scene_wide_Words(package_types__1NO_INSTANCE));
}

fn package_scene_rays__1ray_at(rays: package_scene_rays_Rays, k: u32) -> package_types_Ray {
    return package_types_Ray(package_scene_wide__1vector_at(rays.origin, k), package_scene_wide__1float_at(rays.t_max, k), package_scene_wide__1vector_at(rays.direction, k), package_scene_wide__1word_at(rays.leaving, k), package_scene_wide__1word_at(rays.leaving_instance, k));
}

fn package_scene_rays__1ray_set(rays: package_scene_rays_Rays, k: u32, ray: package_types_Ray) -> package_scene_rays_Rays {
    return package_scene_rays_Rays(package_scene_wide__1vector_set(rays.origin, k, ray.origin), package_scene_wide__1vector_set(rays.direction, k, ray.direction), package_scene_wide__1float_set(rays.t_max, k, ray.t_max), package_scene_wide__1word_set(rays.leaving, k, ray.leaving), package_scene_wide__1word_set(rays.leaving_instance, k, ray.leaving_instance));
}

fn package_scene_rays__1hit_at(hits: package_scene_rays_Hits, k: u32) -> package_types_Hit {
    return package_types_Hit(package_scene_wide__1float_at(hits.t, k), package_scene_wide__1word_at(hits.primitive, k), package_scene_wide__1float_at(hits.b1, k), package_scene_wide__1float_at(hits.b2, k), package_scene_wide__1word_at(hits.instance, k));
}

fn package_scene_rays__1closest_hits(rays: package_scene_rays_Rays) -> package_scene_rays_Hits {
    {
        return package_scene_packet_walk__1packet_hits(rays, false);
    }
}

fn package_scene_rays__1any_hits(rays: package_scene_rays_Rays) -> package_scene_rays_Hits {
    {
        return package_scene_packet_walk__1packet_hits(rays, true);
    }
}

fn package_scene_rays__1any_lane(condition: bool) -> bool {
    {
        return package_scene_packet_lanes__3any_lane_of_packet(condition);
    }
}

const package_scene_wide__2RAYS_PER_LANE: u32 = 4u;

const package_scene_wide__1ONE_RAY: bool = package_scene_wide__2RAYS_PER_LANE == 1u;

alias package_scene_wide_Floats = vec4f;

alias package_scene_wide_Words = vec4u;

struct package_scene_wide_Vectors {
    x: package_scene_wide_Floats,
    y: package_scene_wide_Floats,
    z: package_scene_wide_Floats
}

fn package_scene_wide__1no_vectors() -> package_scene_wide_Vectors {
    return package_scene_wide_Vectors(package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0), package_scene_wide_Floats(0.0));
}

fn package_scene_wide__1float_at(all: package_scene_wide_Floats, k: u32) -> f32 {
    return all[k];
}

fn package_scene_wide__1word_at(all: package_scene_wide_Words, k: u32) -> u32 {
    return all[k];
}

fn package_scene_wide__1vector_at(all: package_scene_wide_Vectors, k: u32) -> vec3f {
    return vec3f(package_scene_wide__1float_at(all.x, k), package_scene_wide__1float_at(all.y, k), package_scene_wide__1float_at(all.z, k));
}

fn package_scene_wide__1float_set(all: package_scene_wide_Floats, k: u32, value: f32) -> package_scene_wide_Floats {
    {
        return select(all, vec4f(value), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
    }
}

fn package_scene_wide__1word_set(all: package_scene_wide_Words, k: u32, value: u32) -> package_scene_wide_Words {
    {
        return select(all, vec4u(value), vec4u(0u, 1u, 2u, 3u) == vec4u(k));
    }
}

fn package_scene_wide__1vector_set(all: package_scene_wide_Vectors, k: u32, value: vec3f) -> package_scene_wide_Vectors {
    return package_scene_wide_Vectors(package_scene_wide__1float_set(all.x, k, value.x), package_scene_wide__1float_set(all.y, k, value.y), package_scene_wide__1float_set(all.z, k, value.z));
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

fn package_lib_rng_hash(x: u32) -> u32 {
    var h = x;
    h ^= h >> 16u;
    h *= 2146121005u;
    h ^= h >> 15u;
    h *= 2221713035u;
    h ^= h >> 16u;
    return h;
}

fn package_lib_rng__1hash_combine(a: u32, b: u32) -> u32 {
    return package_lib_rng_hash(a ^ (package_lib_rng_hash(b) + 2654435769u + (a << 6u) + (a >> 2u)));
}

fn package_lib_rng__1pixel_key(seed: u32, pixel: vec2u) -> u32 {
    return package_lib_rng__1hash_combine(package_lib_rng__1hash_combine(package_lib_rng_hash(seed), pixel.x), pixel.y);
}

fn package_lib_rng__1unit_float(x: u32) -> f32 {
    return f32(x >> 8u) * 5.9604645e-8;
}

const package_lib_filter_PI: f32 = 3.14159265;

const package_lib_filter_SIGMA: f32 = 0.5;

const package_lib_filter_ROUNDS: u32 = 22u;

const package_lib_filter__2BLACKMAN_HARRIS_1: f32 = 0.48829 / (package_lib_filter_PI * 0.35875);

const package_lib_filter__2BLACKMAN_HARRIS_2: f32 = 0.14128 / (package_lib_filter_PI * 0.35875);

const package_lib_filter__2BLACKMAN_HARRIS_3: f32 = 0.01168 / (3.0 * package_lib_filter_PI * 0.35875);

const package_lib_filter__1MITCHELL_ZERO: f32 = 1.14285714;

const package_lib_filter__1MITCHELL_POSITIVE: f32 = 0.51749271;

const package_lib_filter__1MITCHELL_TOTAL: f32 = 0.53498542;

fn package_lib_filter__1filter_offset(kind: u32, radius: f32, u: vec2f) -> vec2f {
    let centred = 2.0 * u - 1.0;
    if (kind == package_types__1FILTER_BOX) {
        return 2.0 * radius * (u - 0.5);
    }
    let side = select(vec2f(-1.0), vec2f(1.0), centred >= vec2f(0.0));
    let fraction = abs(centred);
    if (kind == package_types__1FILTER_TENT) {
        return radius * side * (1.0 - sqrt(max(1.0 - fraction, vec2f(0.0))));
    }
    if (kind == package_types__1FILTER_GAUSSIAN) {
        let scale = package_lib_filter_SIGMA * sqrt(2.0);
        return scale * side * min(package_lib_filter__1inverse_erf(fraction * package_lib_filter_erf(radius / scale)), vec2f(radius / scale));
    }
    return radius * side * package_lib_filter_searched(kind, fraction);
}

fn package_lib_filter__1filter_sign(kind: u32, u: vec2f) -> f32 {
    let negative = abs(2.0 * u - 1.0) > vec2f(package_lib_filter__1MITCHELL_POSITIVE / package_lib_filter__1MITCHELL_TOTAL);
    return select(1.0, -1.0, (kind == package_types__1FILTER_MITCHELL) & (negative.x != negative.y));
}

fn package_lib_filter_searched(kind: u32, fraction: vec2f) -> vec2f {
    var low = vec2f(0.0);
    var width = 1.0;
    var done = 0u;
    loop {
        width *= 0.5;
        let middle = low + width;
        low = select(low, middle, package_lib_filter_cumulated(kind, middle) <= fraction);
        continuing {
            done += 1u;
            break if done >= package_lib_filter_ROUNDS;
        }
    }
    return low + 0.5 * width;
}

fn package_lib_filter_cumulated(kind: u32, x: vec2f) -> vec2f {
    if (kind == package_types__2FILTER_BLACKMAN_HARRIS) {
        let s = sin(package_lib_filter_PI * x);
        let c = cos(package_lib_filter_PI * x);
        return x + s * (package_lib_filter__2BLACKMAN_HARRIS_1 + package_lib_filter__2BLACKMAN_HARRIS_2 * c + package_lib_filter__2BLACKMAN_HARRIS_3 * (4.0 * c * c - 1.0));
    }
    let t = 2.0 * x;
    let inner = t * (16.0 / 3.0 + t * t * (-4.0 + t * 1.75)) / 6.0;
    let e = 2.0 - t;
    let outer = e * e * e * (7.0 / 12.0 * e - 2.0 / 3.0) / 6.0;
    let signed = select(0.5 - outer, inner, t < vec2f(1.0));
    let absolute = select(signed, 2.0 * package_lib_filter__1MITCHELL_POSITIVE - signed, t > vec2f(package_lib_filter__1MITCHELL_ZERO));
    return absolute / package_lib_filter__1MITCHELL_TOTAL;
}

fn package_lib_filter_erf(x: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.3275911 * x);
    let series = t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
    return 1.0 - series * exp(-min(x * x, 80.0));
}

fn package_lib_filter__1inverse_erf(y: vec2f) -> vec2f {
    let w = -log(max((1.0 - y) * (1.0 + y), vec2f(1e-7)));
    let a = w - 2.5;
    let b = sqrt(max(w, vec2f(0.0))) - 3.0;
    let near = 1.50140941 + a * (0.246640727 + a * (-0.00417768164 + a * (-0.00125372503 + a * (0.00021858087 + a * (-4.39150654e-6 + a * (-3.5233877e-6 + a * (3.43273939e-7 + a * 2.81022636e-8)))))));
    let far = 2.83297682 + b * (1.00167406 + b * (0.00943887047 + b * (-0.0076224613 + b * (0.00573950773 + b * (-0.00367342844 + b * (0.00134934322 + b * (0.000100950558 - b * 0.000200214257)))))));
    return y * select(far, near, w < vec2f(5.0));
}

fn package_lib_sampling_sobol(index: u32) -> vec2u {
    var x = index;
    x ^= (x >> 1u) & 1431655765u;
    x ^= (x >> 2u) & 858993459u;
    x ^= (x >> 4u) & 252645135u;
    x ^= (x >> 8u) & 16711935u;
    x ^= (x >> 16u) & 65535u;
    return vec2u(reverseBits(index), reverseBits(x));
}

fn package_lib_sampling__1owen_scramble(fraction: u32, seed: u32) -> u32 {
    var x = reverseBits(fraction);
    x += seed;
    x ^= x * 1817228412u;
    x ^= x * 3090095698u;
    x ^= x * 3350193720u;
    x ^= x * 2367878886u;
    return reverseBits(x);
}

fn package_lib_sampling__1sobol_34(index: u32) -> vec2u {
    var z = vec2u(2147483648u, 3221225472u);
    var w = vec3u(2147483648u, 3221225472u, 536870912u);
    var point = vec2u(0u);
    var bit = 0u;
    loop {
        point ^= select(vec2u(0u), vec2u(z.x, w.x), ((index >> bit) & 1u) != 0u);
        z = vec2u(z.y, z.y ^ z.x ^ (z.x >> 2u));
        w = vec3u(w.yz, w.y ^ w.x ^ (w.x >> 3u));
        continuing {
            bit += 1u;
            break if bit >= 32u;
        }
    }
    return point;
}

fn package_lib_sampling__1stratified_2d(index: u32, key: u32) -> vec2f {
    return package_lib_sampling_scrambled(package_lib_sampling_sobol(package_lib_sampling__1owen_scramble(index, package_lib_rng_hash(key))), key);
}

fn package_lib_sampling__1stratified_34(index: u32, key: u32) -> vec2f {
    return package_lib_sampling_scrambled(package_lib_sampling__1sobol_34(package_lib_sampling__1owen_scramble(index, package_lib_rng_hash(key))), key ^ 2654435769u);
}

fn package_lib_sampling__1stratified_1d(index: u32, key: u32) -> f32 {
    let own = key ^ 1757159915u;
    return package_lib_rng__1unit_float(package_lib_sampling__1owen_scramble(reverseBits(package_lib_sampling__1owen_scramble(index, package_lib_rng_hash(own))), package_lib_rng_hash(own ^ 48610963u)));
}

fn package_lib_sampling_scrambled(point: vec2u, key: u32) -> vec2f {
    return vec2f(package_lib_rng__1unit_float(package_lib_sampling__1owen_scramble(point.x, package_lib_rng_hash(key ^ 2769414579u))), package_lib_rng__1unit_float(package_lib_sampling__1owen_scramble(point.y, package_lib_rng_hash(key ^ 1675113877u))));
}

var<private> package_scene_shutter__1shutter_time: f32 = 0.0;

fn package_scene_shutter__1shutter_camera(still: package_types_PackedCamera) -> package_types_PackedCamera {
    if (package_bindings__1CAMERA_MOTION) {
        let moment = package_lib_motion__1moment_of(package_scene_shutter__1shutter_time, package_bindings_frame.camera_key_count);
        return package_lib_motion__1camera_between(package_scene_fetch__1load_camera(moment.key), package_scene_fetch__1load_camera(moment.key + 1u), moment.fraction);
    }
    return still;
}

fn package_scene_shutter__1shutter_light(index: u32, light_count: u32) -> package_types_PackedLight {
    if (package_bindings__1LIGHT_MOTION) {
        let moment = package_lib_motion__1moment_of(package_scene_shutter__1shutter_time, package_bindings_frame.light_key_count);
        let place = moment.key * light_count + index;
        return package_lib_motion__1light_between(package_scene_fetch__1load_light(place), package_scene_fetch__1load_light(place + light_count), moment.fraction);
    }
    return package_scene_fetch__1load_light(index);
}

struct package_lib_motion_Moment {
    key: u32,
    fraction: f32
}

fn package_lib_motion__1moment_of(time: f32, key_count: u32) -> package_lib_motion_Moment {
    let intervals = max(key_count, 2u) - 1u;
    let at = time * f32(intervals);
    let key = min(u32(at), intervals - 1u);
    return package_lib_motion_Moment(key, at - f32(key));
}

struct package_lib_motion_Space {
    translation: vec3f,
    linear: mat3x3f,
    inverse: mat3x3f
}

fn package_lib_motion__1space_between(a: package_types_PackedKey, b: package_types_PackedKey, fraction: f32) -> package_lib_motion_Space {
    let q = mix(a.rotation, b.rotation, vec4f(fraction));
    let rotation = package_lib_motion__1rotation_matrix(q * inverseSqrt(max(dot(q, q), 1e-30)));
    let d = mix(a.stretch, b.stretch, vec3f(fraction));
    let s = mix(a.shear, b.shear, vec3f(fraction));
    let size = max(max(abs(d.x), abs(d.y)), max(abs(d.z), 1e-30));
    let e = d / size;
    let f = s / size;
    let adjugate = mat3x3f(vec3f(e.y * e.z - f.x * f.x, f.y * f.x - f.z * e.z, f.z * f.x - e.y * f.y), vec3f(f.y * f.x - f.z * e.z, e.x * e.z - f.y * f.y, f.z * f.y - e.x * f.x), vec3f(f.z * f.x - e.y * f.y, f.z * f.y - e.x * f.x, e.x * e.y - f.z * f.z));
    let determinant = dot(vec3f(e.x, f.z, f.y), adjugate[0]);
    let usable = abs(determinant) > 1e-30;
    let inverse_stretch = adjugate * (1.0 / (select(1.0, determinant, usable) * size));
    let stretch = mat3x3f(vec3f(d.x, s.z, s.y), vec3f(s.z, d.y, s.x), vec3f(s.y, s.x, d.z));
    return package_lib_motion_Space(mix(a.translation, b.translation, vec3f(fraction)), rotation * stretch, inverse_stretch * transpose(rotation));
}

fn package_lib_motion__1rotation_matrix(q: vec4f) -> mat3x3f {
    let d = 2.0 * q.xyz * q.xyz;
    let xy = 2.0 * q.x * q.y;
    let xz = 2.0 * q.x * q.z;
    let yz = 2.0 * q.y * q.z;
    let w = 2.0 * q.w * q.xyz;
    return mat3x3f(vec3f(1.0 - d.y - d.z, xy + w.z, xz - w.y), vec3f(xy - w.z, 1.0 - d.x - d.z, yz + w.x), vec3f(xz + w.y, yz - w.x, 1.0 - d.x - d.y));
}

fn package_lib_motion__1camera_between(a: package_types_PackedCamera, b: package_types_PackedCamera, fraction: f32) -> package_types_PackedCamera {
    return package_types_PackedCamera(mix(a.origin, b.origin, vec3f(fraction)), mix(a.lens_radius, b.lens_radius, fraction), mix(a.forward, b.forward, vec3f(fraction)), mix(a.focus_distance, b.focus_distance, fraction), mix(a.right, b.right, vec3f(fraction)), mix(a.blade_rotation, b.blade_rotation, fraction), mix(a.up, b.up, vec3f(fraction)), a.blade_count);
}

fn package_lib_motion__1light_between(a: package_types_PackedLight, b: package_types_PackedLight, fraction: f32) -> package_types_PackedLight {
    return package_types_PackedLight(mix(a.position, b.position, vec3f(fraction)), a.kind, package_lib_numeric__1normalize_or(mix(a.direction, b.direction, vec3f(fraction)), a.direction), a.attenuation, mix(a.color, b.color, vec3f(fraction)), mix(a.cos_inner, b.cos_inner, fraction), mix(a.edge_u, b.edge_u, vec3f(fraction)), mix(a.cos_outer, b.cos_outer, fraction), mix(a.edge_v, b.edge_v, vec3f(fraction)), mix(a.radius, b.radius, fraction), a.sample_count, 0u, 0u, 0u);
}

const package_lib_camera__1T_FAR: f32 = 3e38;

fn package_lib_camera__1camera_ray(camera: package_types_PackedCamera, position: vec2f, size: vec2f) -> package_types_Ray {
    return package_types_Ray(camera.origin, package_lib_camera__1T_FAR, normalize(package_lib_camera_through(camera, position, size)), package_types_NONE, package_types__1NO_INSTANCE);
}

fn package_lib_camera_through(camera: package_types_PackedCamera, position: vec2f, size: vec2f) -> vec3f {
    let x = 2.0 * position.x / size.x - 1.0;
    let y = 1.0 - 2.0 * position.y / size.y;
    return camera.forward + x * camera.right + y * camera.up;
}

fn package_lib_camera__1parallel_ray(camera: package_types_PackedCamera, position: vec2f, size: vec2f) -> package_types_Ray {
    let origin = camera.origin + package_lib_camera_across(camera, position, size);
    return package_types_Ray(origin, package_lib_camera__1T_FAR, normalize(camera.forward), package_types_NONE, package_types__1NO_INSTANCE);
}

fn package_lib_camera_across(camera: package_types_PackedCamera, position: vec2f, size: vec2f) -> vec3f {
    let x = 2.0 * position.x / size.x - 1.0;
    let y = 1.0 - 2.0 * position.y / size.y;
    return x * camera.right + y * camera.up;
}

fn package_lib_camera__1lens_ray(camera: package_types_PackedCamera, position: vec2f, size: vec2f, u: vec2f) -> package_types_Ray {
    let off_axis = package_lib_camera__1aperture_point(camera, u);
    let direction = package_lib_camera_through(camera, position, size) - off_axis / camera.focus_distance;
    return package_types_Ray(camera.origin + off_axis, package_lib_camera__1T_FAR, normalize(direction), package_types_NONE, package_types__1NO_INSTANCE);
}

fn package_lib_camera__2parallel_lens_ray(camera: package_types_PackedCamera, position: vec2f, size: vec2f, u: vec2f) -> package_types_Ray {
    let off_axis = package_lib_camera__1aperture_point(camera, u);
    let origin = camera.origin + package_lib_camera_across(camera, position, size) + off_axis;
    let direction = normalize(camera.forward) - off_axis / camera.focus_distance;
    return package_types_Ray(origin, package_lib_camera__1T_FAR, normalize(direction), package_types_NONE, package_types__1NO_INSTANCE);
}

fn package_lib_camera__1aperture_point(camera: package_types_PackedCamera, u: vec2f) -> vec3f {
    var aperture = package_lib_warp__2disc_from_square(u);
    if (camera.blade_count >= 3u) {
        aperture = package_lib_warp__2polygon_from_square(u, camera.blade_count, camera.blade_rotation);
    }
    let p = camera.lens_radius * aperture;
    return p.x * normalize(camera.right) + p.y * normalize(camera.up);
}

const package_lib_warp_PI: f32 = 3.14159265;

fn package_lib_warp__2disc_from_square(u: vec2f) -> vec2f {
    let p = 2.0 * u - 1.0;
    let by_x = abs(p.x) > abs(p.y);
    let radius = select(p.y, p.x, by_x);
    let ratio = select(p.x, p.y, by_x) / select(1.0, radius, abs(radius) > 0.0);
    let angle = select(0.5 * package_lib_warp_PI - 0.25 * package_lib_warp_PI * ratio, 0.25 * package_lib_warp_PI * ratio, by_x);
    return radius * vec2f(cos(angle), sin(angle));
}

fn package_lib_warp__2triangle_from_square(u: vec2f) -> vec2f {
    let s = sqrt(u.y);
    return vec2f(s * (1.0 - u.x), s * u.x);
}

fn package_lib_warp__2polygon_from_square(u: vec2f, count: u32, rotation: f32) -> vec2f {
    let edge = min(floor(u.x * f32(count)), f32(count) - 1.0);
    let b = package_lib_warp__2triangle_from_square(vec2f(clamp(u.x * f32(count) - edge, 0.0, 1.0), u.y));
    let step = 2.0 * package_lib_warp_PI / f32(count);
    let angles = rotation + step * vec2f(edge, edge + 1.0);
    return b.x * vec2f(cos(angles.x), sin(angles.x)) + b.y * vec2f(cos(angles.y), sin(angles.y));
}

fn package_lib_warp__2cone_from_square(u: vec2f, depth: f32) -> vec3f {
    let p = package_lib_warp__2disc_from_square(u);
    let below = min(dot(p, p), 1.0) * depth;
    return vec3f(p * sqrt(max(depth * (2.0 - below), 0.0)), 1.0 - below);
}

fn package_lib_warp__1turn_to(n: vec3f, direction: vec3f) -> vec3f {
    let side = select(-1.0, 1.0, n.z >= 0.0);
    let a = -1.0 / (side + n.z);
    let b = n.x * n.y * a;
    let x = vec3f(1.0 + side * n.x * n.x * a, side * b, -side * n.x);
    let y = vec3f(b, side + n.y * n.y * a, -n.y);
    return direction.x * x + direction.y * y + direction.z * n;
}

var<private> package_scene_loops__1nodes_visited: u32 = 0u;

var<private> package_scene_loops__1primitives_tested: u32 = 0u;

var<private> package_scene_loops__1cut_off: bool = false;

var<private> package_scene_packet_walk_seconds: package_scene_packet_lanes_FourHits;

fn package_scene_packet_walk__1second_hit(k: u32) -> package_types_Hit {
    if (k == 0u) {
        return package_scene_packet_walk_seconds.h0.second;
    }
    if (k == 1u) {
        return package_scene_packet_walk_seconds.h1.second;
    }
    if (k == 2u) {
        return package_scene_packet_walk_seconds.h2.second;
    }
    return package_scene_packet_walk_seconds.h3.second;
}

fn package_scene_packet_walk__1packet_hits(rays: package_scene_rays_Rays, any: bool) -> package_scene_rays_Hits {
    let found = package_scene_packet_walk_walk(package_scene_rays__1ray_at(rays, 0u), package_scene_rays__1ray_at(rays, 1u), package_scene_rays__1ray_at(rays, 2u), package_scene_rays__1ray_at(rays, 3u), any);
    package_scene_packet_walk_seconds = found;
    return package_scene_rays_Hits(package_scene_wide_Floats(found.h0.hit.t, found.h1.hit.t, found.h2.hit.t, found.h3.hit.t), package_scene_wide_Words(found.h0.hit.primitive, found.h1.hit.primitive, found.h2.hit.primitive, found.h3.hit.primitive), package_scene_wide_Floats(found.h0.hit.b1, found.h1.hit.b1, found.h2.hit.b1, found.h3.hit.b1), package_scene_wide_Floats(found.h0.hit.b2, found.h1.hit.b2, found.h2.hit.b2, found.h3.hit.b2), package_scene_wide_Words(found.h0.hit.instance, found.h1.hit.instance, found.h2.hit.instance, found.h3.hit.instance));
}

fn package_scene_packet_walk__1first_hit(ray: package_types_Ray) -> package_scene_packet_lanes_TwoHits {
    var hit = package_types_Hit(ray.t_max, package_types_NONE, 0.0, 0.0, package_types__1NO_INSTANCE);
    package_scene_primitive__1runner_up = package_types_Hit(package_lib_camera__1T_FAR, package_types_NONE, 0.0, 0.0, package_types__1NO_INSTANCE);
    if (package_bindings__1HAS_PLANES) {
        hit = package_scene_exhaustive__1hit_planes(ray, hit);
    }
    return package_scene_packet_lanes_TwoHits(hit, package_scene_primitive__1runner_up);
}

fn package_scene_packet_walk__1world_ray(ray: package_types_Ray) -> package_scene_primitive_TraversalRay {
    return package_scene_primitive__1traversal_ray(ray, package_lib_intersect__1triangle_watertight__1shear_of(ray.direction), package_types__1NO_INSTANCE);
}

fn package_scene_packet_walk_walk(ray0: package_types_Ray, ray1: package_types_Ray, ray2: package_types_Ray, ray3: package_types_Ray, any: bool) -> package_scene_packet_lanes_FourHits {
    var hits = package_scene_packet_lanes_FourHits(package_scene_packet_walk__1first_hit(ray0), package_scene_packet_walk__1first_hit(ray1), package_scene_packet_walk__1first_hit(ray2), package_scene_packet_walk__1first_hit(ray3));
    if (!(package_bindings__1HAS_TRIANGLES || package_bindings__1HAS_SHAPES)) {
        return hits;
    }
    var rays = package_scene_packet_lanes_FourRays(package_scene_packet_walk__1world_ray(ray0), package_scene_packet_walk__1world_ray(ray1), package_scene_packet_walk__1world_ray(ray2), package_scene_packet_walk__1world_ray(ray3));
    var stack = package_scene_packet_stack_Stack(package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY, package_scene_traverse_EMPTY);
    var current = 0u;
    if (package_bindings__1HAS_INSTANCES) {
        current = package_bindings_frame.root;
    }
    loop {
        loop {
            if (package_bindings__1HAS_INSTANCES) {
                if (current == package_scene_traverse_RETURN) {
                    rays = package_scene_packet_lanes_FourRays(package_scene_packet_walk__1world_ray(ray0), package_scene_packet_walk__1world_ray(ray1), package_scene_packet_walk__1world_ray(ray2), package_scene_packet_walk__1world_ray(ray3));
                    current = package_scene_packet_stack__1top_of(stack);
                    stack = package_scene_packet_stack_popped(stack);
                }
                if ((current >= package_types_INSTANCE) & (current != package_scene_traverse_EMPTY)) {
                    let index = current & package_types__2LEAF_FIRST_MASK;
                    let instance = package_scene_fetch__1load_instance(index);
                    let space = package_scene_instance__1space_of(instance);
                    let o0 = package_scene_instance__1object_ray(ray0, space);
                    let o1 = package_scene_instance__1object_ray(ray1, space);
                    let o2 = package_scene_instance__1object_ray(ray2, space);
                    let o3 = package_scene_instance__1object_ray(ray3, space);
                    rays = package_scene_packet_lanes_FourRays(package_scene_primitive__1traversal_ray(o0, package_lib_intersect__1triangle_watertight__1shear_of(o0.direction), index), package_scene_primitive__1traversal_ray(o1, package_lib_intersect__1triangle_watertight__1shear_of(o1.direction), index), package_scene_primitive__1traversal_ray(o2, package_lib_intersect__1triangle_watertight__1shear_of(o2.direction), index), package_scene_primitive__1traversal_ray(o3, package_lib_intersect__1triangle_watertight__1shear_of(o3.direction), index));
                    stack = package_scene_packet_stack_pushed(stack, package_scene_traverse_RETURN, 1u);
                    current = instance.root;
                }
            }
            if ((current & package_types_LEAF) == 0u) {
                let limits = vec4i(package_scene_packet_walk__1limit_of(ray0, hits.h0.hit, any), package_scene_packet_walk__1limit_of(ray1, hits.h1.hit, any), package_scene_packet_walk__1limit_of(ray2, hits.h2.hit, any), package_scene_packet_walk__1limit_of(ray3, hits.h3.hit, any));
                loop {
                    let node = package_scene_packet_node__2load_shared_node(current);
                    let children = package_scene_packet_node__1order_children(node, rays, limits);
                    current = select(package_scene_packet_stack__1top_of(stack), subgroupShuffle(children.reference, 0u), children.count > 0u);
                    stack = package_scene_packet_stack_pushed(stack, subgroupShuffle(children.reference, (package_scene_packet_lanes__1packet_lane + 1u) & 3u), children.count - 1u);
                    if (package_bindings__1COUNT_STEPS) {
                        package_scene_loops__1nodes_visited += 1u;
                    }
                    continuing {
                    
                        break if (current & package_types_LEAF) != 0u;
                    }
                }
            }
            loop {
                let is_here = package_scene_packet_leaf__1is_common(current);
                let next = package_scene_packet_leaf_after(current, package_scene_packet_stack__1top_of(stack));
                if (is_here) {
                    hits = package_scene_packet_leaf__1meet_common(rays, hits, current);
                    stack = package_scene_packet_stack_pushed(stack, package_scene_traverse_EMPTY, select(0u, package_scene_packet_stack_POP, next.is_last));
                    current = next.reference;
                    if (any) {
                        current = select(package_scene_traverse_EMPTY, current, package_scene_packet_walk__1is_open(hits, ray0, ray1, ray2, ray3));
                    }
                }
                continuing {
                
                    break if !package_scene_packet_leaf__1is_common(current);
                }
            }
            continuing {
            
                break if (current == package_scene_traverse_EMPTY) | package_scene_packet_leaf__1is_rare(current);
            }
        }
        if (package_bindings__1HAS_SHAPES && package_bindings__1HAS_TRIANGLES) {
            let next = package_scene_packet_leaf_after(current, package_scene_packet_stack__1top_of(stack));
            if (package_scene_packet_leaf__1is_rare(current)) {
                hits = package_scene_packet_leaf__1meet_rare(rays, hits, current);
                stack = package_scene_packet_stack_pushed(stack, package_scene_traverse_EMPTY, select(0u, package_scene_packet_stack_POP, next.is_last));
                current = next.reference;
                if (any) {
                    current = select(package_scene_traverse_EMPTY, current, package_scene_packet_walk__1is_open(hits, ray0, ray1, ray2, ray3));
                }
            }
        }
        continuing {
        
            break if current == package_scene_traverse_EMPTY;
        }
    }
    package_scene_loops__1cut_off |= package_scene_packet_stack__1is_full | (current != package_scene_traverse_EMPTY);
    return hits;
}

fn package_scene_packet_walk__1is_open(hits: package_scene_packet_lanes_FourHits, ray0: package_types_Ray, ray1: package_types_Ray, ray2: package_types_Ray, ray3: package_types_Ray) -> bool {
    return package_scene_packet_lanes__3any_lane_of_packet(package_scene_packet_walk__1is_unoccluded(ray0, hits.h0.hit) | package_scene_packet_walk__1is_unoccluded(ray1, hits.h1.hit) | package_scene_packet_walk__1is_unoccluded(ray2, hits.h2.hit) | package_scene_packet_walk__1is_unoccluded(ray3, hits.h3.hit));
}

fn package_scene_packet_walk__1is_unoccluded(ray: package_types_Ray, hit: package_types_Hit) -> bool {
    return (hit.primitive == package_types_NONE) & (ray.t_max >= 0.0);
}

fn package_scene_packet_walk__1limit_of(ray: package_types_Ray, hit: package_types_Hit, any: bool) -> i32 {
    let limit = bitcast<i32>(package_scene_traverse__1search_limit(ray, hit)) + package_lib_intersect_node_WIDENING;
    return select(limit, -1, any & (hit.primitive != package_types_NONE));
}

var<private> package_scene_primitive__1runner_up: package_types_Hit;

struct package_scene_primitive_TraversalRay {
    ray: package_types_Ray,
    inv: vec3f,
    shear: package_lib_intersect__1triangle_watertight_Shear,
    instance: u32
}

fn package_scene_primitive__1traversal_ray(ray: package_types_Ray, shear: package_lib_intersect__1triangle_watertight_Shear, instance: u32) -> package_scene_primitive_TraversalRay {
    return package_scene_primitive_TraversalRay(ray, package_lib_numeric__1safe_reciprocal(ray.direction), shear, instance);
}

fn package_scene_primitive__1closer_of(at: package_scene_primitive_TraversalRay, hit: package_types_Hit, candidate: package_types_Candidate, primitive: u32) -> package_types_Hit {
    var is_lower = primitive < hit.primitive;
    var is_left = primitive == at.ray.leaving;
    if (package_bindings__1HAS_INSTANCES) {
        is_lower = (at.instance < hit.instance) | ((at.instance == hit.instance) & is_lower);
        is_left = is_left & (at.instance == at.ray.leaving_instance);
    }
    let ties = (candidate.t == hit.t) & is_lower & (hit.primitive != package_types_NONE);
    let counts = candidate.hit & !is_left;
    let wins = counts & ((candidate.t < hit.t) | ties);
    if (package_bindings__1HAS_CONTACT) {
        let found = package_types_Hit(candidate.t, primitive, candidate.b1, candidate.b2, at.instance);
        package_scene_primitive__2keep_runner_up(hit, found, counts, wins);
    }
    return package_types_Hit(select(hit.t, candidate.t, wins), select(hit.primitive, primitive, wins), select(hit.b1, candidate.b1, wins), select(hit.b2, candidate.b2, wins), select(hit.instance, at.instance, wins));
}

fn package_scene_primitive__2keep_runner_up(hit: package_types_Hit, found: package_types_Hit, counts: bool, wins: bool) {
    let is_same = (found.primitive == hit.primitive) & (found.instance == hit.instance);
    if (wins) {
        package_scene_primitive__1runner_up = hit;
    }
    else if (counts & !is_same & (found.t < package_scene_primitive__1runner_up.t)) {
        package_scene_primitive__1runner_up = found;
    }
}

fn package_scene_primitive__1test_triangle(ray: package_types_Ray, corners: package_types_PackedTriangle, shear: package_lib_intersect__1triangle_watertight_Shear) -> package_types_Candidate {
    if (package_bindings__1TRIANGLE_TEST == package_types__2TRIANGLE_TEST_PLANE) {
        return package_lib_intersect__1triangle_plane__2intersect_triangle_plane(ray, corners.v0, corners.v1, corners.v2);
    }
    if (package_bindings__1TRIANGLE_TEST == package_types__3TRIANGLE_TEST_MOLLER_TRUMBORE) {
        return package_lib_intersect__2triangle_moller_trumbore__3intersect_triangle_moller_trumbore(ray, corners.v0, corners.v1, corners.v2);
    }
    return package_lib_intersect__1triangle_watertight__2intersect_triangle_watertight(ray.origin, shear, corners.v0, corners.v1, corners.v2);
}

fn package_scene_exhaustive__1hit_planes(ray: package_types_Ray, start: package_types_Hit) -> package_types_Hit {
    var hit = start;
    let end = package_bindings_frame.shape_count + package_bindings_frame.plane_count;
    var index = package_bindings_frame.shape_count;
    loop {
        let shape = package_scene_fetch__1load_shape(index);
        let candidate = package_lib_intersect_plane__1intersect_plane(ray, shape.position, shape.row_y);
        let primitive = package_types_SHAPE | index;
        let counts = candidate.hit & (primitive != ray.leaving);
        let wins = counts & (candidate.t < hit.t);
        let found = package_types_Hit(candidate.t, primitive, 0.0, 0.0, package_types__1NO_INSTANCE);
        if (package_bindings__1HAS_CONTACT) {
            package_scene_primitive__2keep_runner_up(hit, found, counts, wins);
        }
        if (wins) {
            hit = found;
        }
        continuing {
            index += 1u;
            break if index >= end;
        }
    }
    package_scene_loops__1cut_off |= index < end;
    return hit;
}

fn package_lib_intersect_plane__1intersect_plane(ray: package_types_Ray, point: vec3f, n: vec3f) -> package_types_Candidate {
    let slope = dot(n, ray.direction);
    let steep = abs(slope) > 1e-12;
    let t = dot(n, point - ray.origin) / select(1.0, slope, steep);
    return package_types_Candidate(steep & (t > 0.0), t, 0.0, 0.0);
}

struct package_lib_intersect__1triangle_watertight_Shear {
    x: vec3f,
    y: vec3f,
    z: vec3f
}

fn package_lib_intersect__1triangle_watertight__1shear_of(direction: vec3f) -> package_lib_intersect__1triangle_watertight_Shear {
    let size = abs(direction);
    let is_x = (size.x >= size.y) & (size.x >= size.z);
    let is_y = !is_x & (size.y >= size.z);
    let axis_z = select(select(vec3f(0.0, 0.0, 1.0), vec3f(0.0, 1.0, 0.0), is_y), vec3f(1.0, 0.0, 0.0), is_x);
    let axis_x = axis_z.zxy;
    let axis_y = axis_z.yzx;
    let scale = 1.0 / dot(direction, axis_z);
    return package_lib_intersect__1triangle_watertight_Shear(axis_x - dot(direction, axis_x) * scale * axis_z, axis_y - dot(direction, axis_y) * scale * axis_z, scale * axis_z);
}

fn package_lib_intersect__1triangle_watertight__2intersect_triangle_watertight(origin: vec3f, shear: package_lib_intersect__1triangle_watertight_Shear, v0: vec3f, v1: vec3f, v2: vec3f) -> package_types_Candidate {
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
    return package_types_Candidate(usable & (t > 0.0), t, edges.y * inv_det, edges.z * inv_det);
}

const package_lib_numeric_ROUNDING: f32 = 5.9604645e-8;

fn package_lib_numeric__1normalize_or(v: vec3f, fallback: vec3f) -> vec3f {
    let largest = max(abs(v.x), max(abs(v.y), abs(v.z)));
    let usable = largest > 1e-30;
    let scaled = select(vec3f(1.0, 0.0, 0.0), v / select(1.0, largest, usable), usable);
    return select(fallback, scaled * inverseSqrt(dot(scaled, scaled)), usable);
}

fn package_lib_numeric__1safe_reciprocal(d: vec3f) -> vec3f {
    let tiny = abs(d) < vec3f(1e-18);
    return 1.0 / select(d, select(vec3f(1e-18), vec3f(-1e-18), d < vec3f(0.0)), tiny);
}

fn package_lib_numeric__1is_finite(v: vec3f) -> bool {
    let exponents = bitcast<vec3u>(v) & vec3u(2139095040u);
    return all(exponents != vec3u(2139095040u));
}

fn package_lib_numeric__1max_component(v: vec3f) -> f32 {
    return max(v.x, max(v.y, v.z));
}

const package_scene_packet_stack_POP: u32 = 4294967295u;

var<private> package_scene_packet_stack__1is_full: bool = false;

struct package_scene_packet_stack_Stack {
    s0: u32,
    s1: u32,
    s2: u32,
    s3: u32,
    s4: u32,
    s5: u32
}

fn package_scene_packet_stack__1top_of(stack: package_scene_packet_stack_Stack) -> u32 {
    return subgroupShuffle(stack.s0, 0u);
}

fn package_scene_packet_stack_pushed(stack: package_scene_packet_stack_Stack, reference: u32, count: u32) -> package_scene_packet_stack_Stack {
    let source = (package_scene_packet_lanes__1packet_lane - count) & 7u;
    let is_pop = count == package_scene_packet_stack_POP;
    let is_new = !is_pop & (package_scene_packet_lanes__1packet_lane < count);
    let is_last = is_pop & (package_scene_packet_lanes__1packet_lane == 7u);
    package_scene_packet_stack__1is_full |= !is_pop & (package_scene_packet_lanes__1packet_lane + count >= 8u) & (stack.s5 != package_scene_traverse_EMPTY);
    let m0 = subgroupShuffle(stack.s0, source);
    let m1 = subgroupShuffle(stack.s1, source);
    let m2 = subgroupShuffle(stack.s2, source);
    let m3 = subgroupShuffle(stack.s3, source);
    let m4 = subgroupShuffle(stack.s4, source);
    let m5 = subgroupShuffle(stack.s5, source);
    return package_scene_packet_stack_Stack(select(select(m0, reference, is_new), m1, is_last), select(select(m1, m0, is_new), m2, is_last), select(select(m2, m1, is_new), m3, is_last), select(select(m3, m2, is_new), m4, is_last), select(select(m4, m3, is_new), m5, is_last), select(select(m5, m4, is_new), package_scene_traverse_EMPTY, is_last));
}

fn package_scene_packet_stack_popped(stack: package_scene_packet_stack_Stack) -> package_scene_packet_stack_Stack {
    return package_scene_packet_stack_pushed(stack, package_scene_traverse_EMPTY, package_scene_packet_stack_POP);
}

const package_scene_traverse_EMPTY: u32 = 4294967295u;

const package_scene_traverse_RETURN: u32 = 4294967294u;

const package_scene_traverse__1CONTACT_RANGE: f32 = 0.0001;

fn package_scene_traverse__1search_limit(ray: package_types_Ray, hit: package_types_Hit) -> f32 {
    if (package_bindings__1HAS_CONTACT) {
        return hit.t + package_scene_traverse__1CONTACT_RANGE * (hit.t + package_lib_numeric__1max_component(abs(ray.origin)));
    }
    return hit.t;
}

fn package_scene_instance__1space_of(instance: package_types_PackedInstance) -> package_lib_motion_Space {
    if (package_bindings__1HAS_MOTION) {
        if (instance.key_count > 1u) {
            let moment = package_lib_motion__1moment_of(package_scene_shutter__1shutter_time, instance.key_count);
            let key = instance.first_key + moment.key;
            return package_lib_motion__1space_between(package_scene_fetch__1load_key(key), package_scene_fetch__1load_key(key + 1u), moment.fraction);
        }
    }
    return package_lib_motion_Space(instance.translation, transpose(mat3x3f(instance.linear_x, instance.linear_y, instance.linear_z)), transpose(mat3x3f(instance.inverse_x, instance.inverse_y, instance.inverse_z)));
}

fn package_scene_instance__1object_ray(ray: package_types_Ray, space: package_lib_motion_Space) -> package_types_Ray {
    return package_types_Ray(space.inverse * (ray.origin - space.translation), ray.t_max, space.inverse * ray.direction, ray.leaving, ray.leaving_instance);
}

fn package_scene_instance__1placed_normal(space: package_lib_motion_Space, n: vec3f) -> vec3f {
    return n * space.inverse;
}

fn package_scene_instance__1placement_error(space: package_lib_motion_Space, p: vec3f, q: vec3f) -> vec3f {
    let from_p = package_scene_instance__1abs_times(space.inverse, abs(p) + abs(space.translation));
    return 16.0 * package_lib_numeric_ROUNDING * (abs(p) + abs(space.translation) + package_scene_instance__1abs_times(space.linear, abs(q) + from_p));
}

fn package_scene_instance__1abs_times(m: mat3x3f, v: vec3f) -> vec3f {
    return abs(m[0]) * v.x + abs(m[1]) * v.y + abs(m[2]) * v.z;
}

fn package_scene_instance__1pattern_place(instance: package_types_PackedInstance, q: vec3f) -> vec3f {
    let at = vec4f(q, 1.0);
    return vec3f(dot(instance.pattern_x, at), dot(instance.pattern_y, at), dot(instance.pattern_z, at));
}

const package_lib_intersect_node_WIDENING: i32 = 8;

const package_scene_packet_node_MISS: u32 = 2147483644u;

struct package_scene_packet_node_SharedNode {
    lo: vec3f,
    scale: vec3f,
    plane: vec3f,
    reference: u32
}

fn package_scene_packet_node__2load_shared_node(index: u32) -> package_scene_packet_node_SharedNode {
    let child = package_scene_packet_lanes__1packet_lane & 3u;
    let is_max = package_scene_packet_lanes__1packet_lane >= 4u;
    let row = package_scene_fetch__1node_row(4u * index + child);
    let words = vec3u(select(subgroupShuffle(row.z, 1u), subgroupShuffle(row.w, 1u), is_max), select(subgroupShuffle(row.x, 2u), subgroupShuffle(row.y, 2u), is_max), select(subgroupShuffle(row.z, 2u), subgroupShuffle(row.w, 2u), is_max));
    let is_even = (child & 1u) == 0u;
    let c01 = select(subgroupShuffle(row.y, 3u), subgroupShuffle(row.x, 3u), is_even);
    let c23 = select(subgroupShuffle(row.w, 3u), subgroupShuffle(row.z, 3u), is_even);
    return package_scene_packet_node_SharedNode(bitcast<vec3f>(vec3u(subgroupShuffle(row.x, 0u), subgroupShuffle(row.y, 0u), subgroupShuffle(row.z, 0u))), bitcast<vec3f>(vec3u(subgroupShuffle(row.w, 0u), subgroupShuffle(row.x, 1u), subgroupShuffle(row.y, 1u))), vec3f((words >> vec3u(8u * child)) & vec3u(255u)), select(c23, c01, child < 2u));
}

struct package_scene_packet_node_Children {
    reference: u32,
    count: u32
}

fn package_scene_packet_node__1order_children(node: package_scene_packet_node_SharedNode, rays: package_scene_packet_lanes_FourRays, limits: vec4i) -> package_scene_packet_node_Children {
    let lane = package_scene_packet_lanes__1packet_lane;
    let is_even = (lane & 1u) == 0u;
    let is_low = (lane & 2u) == 0u;
    let v0 = package_scene_packet_node__1closest_entry(node, rays, limits, 0u);
    let v1 = package_scene_packet_node__1closest_entry(node, rays, limits, 1u);
    let v2 = package_scene_packet_node__1closest_entry(node, rays, limits, 2u);
    let v3 = package_scene_packet_node__1closest_entry(node, rays, limits, 3u);
    let a = min(select(v1, v0, is_even), subgroupShuffle(select(v0, v1, is_even), lane ^ 1u));
    let b = min(select(v3, v2, is_even), subgroupShuffle(select(v2, v3, is_even), lane ^ 1u));
    let c = min(select(b, a, is_low), subgroupShuffle(select(a, b, is_low), lane ^ 2u));
    let closest = min(c, subgroupShuffle(c, lane ^ 4u));
    var key = (select(closest, package_scene_packet_node_MISS, node.reference == 0u) & 4294967292u) | (lane & 3u);
    var other = subgroupShuffle(key, lane ^ 1u);
    key = select(max(key, other), min(key, other), is_even == is_low);
    other = subgroupShuffle(key, lane ^ 2u);
    key = select(max(key, other), min(key, other), is_low);
    other = subgroupShuffle(key, lane ^ 1u);
    key = select(max(key, other), min(key, other), is_even);
    var count = select(0u, 1u, key < package_scene_packet_node_MISS);
    count += subgroupShuffle(count, lane ^ 1u);
    count += subgroupShuffle(count, lane ^ 2u);
    return package_scene_packet_node_Children(subgroupShuffle(node.reference, key & 3u), count);
}

fn package_scene_packet_node__1closest_entry(node: package_scene_packet_node_SharedNode, rays: package_scene_packet_lanes_FourRays, limits: vec4i, child: u32) -> u32 {
    let low = vec3f(subgroupShuffle(node.plane.x, child), subgroupShuffle(node.plane.y, child), subgroupShuffle(node.plane.z, child));
    let high = vec3f(subgroupShuffle(node.plane.x, child + 4u), subgroupShuffle(node.plane.y, child + 4u), subgroupShuffle(node.plane.z, child + 4u));
    return min(min(package_scene_packet_node_entry(node, low, high, rays.r0, limits.x), package_scene_packet_node_entry(node, low, high, rays.r1, limits.y)), min(package_scene_packet_node_entry(node, low, high, rays.r2, limits.z), package_scene_packet_node_entry(node, low, high, rays.r3, limits.w)));
}

fn package_scene_packet_node_entry(node: package_scene_packet_node_SharedNode, low: vec3f, high: vec3f, at: package_scene_primitive_TraversalRay, limit: i32) -> u32 {
    let base = (node.lo - at.ray.origin) * at.inv;
    let step = node.scale * at.inv;
    let t0 = bitcast<vec3i>(low * step + base);
    let t1 = bitcast<vec3i>(high * step + base);
    let first = min(t0, t1);
    let last = max(t0, t1);
    let near = max(max(first.x, first.y), max(first.z, 0));
    let far = min(min(last.x, last.y), last.z);
    return select(package_scene_packet_node_MISS, bitcast<u32>(near), near <= min(far + package_lib_intersect_node_WIDENING, limit));
}

fn package_scene_packet_leaf__1is_common(reference: u32) -> bool {
    return (reference & package_types_LEAF) != 0u && reference < package_types_INSTANCE && package_scene_packet_leaf__1has_shapes(reference) == package_bindings__1MOSTLY_SHAPES;
}

fn package_scene_packet_leaf__1is_rare(reference: u32) -> bool {
    return (reference & package_types_LEAF) != 0u && reference < package_types_INSTANCE && package_scene_packet_leaf__1has_shapes(reference) != package_bindings__1MOSTLY_SHAPES;
}

fn package_scene_packet_leaf__1has_shapes(reference: u32) -> bool {
    return (reference & package_types_SHAPE) != 0u;
}

struct package_scene_packet_leaf_Next {
    reference: u32,
    is_last: bool
}

fn package_scene_packet_leaf_after(reference: u32, top: u32) -> package_scene_packet_leaf_Next {
    let left = (reference & package_types__2LEAF_COUNT_MASK) / package_types__2LEAF_COUNT_ONE;
    let tested = select(package_scene_packet_leaf__1tested_triangles(reference), 1u, package_scene_packet_leaf__1has_shapes(reference));
    let is_last = left < tested;
    return package_scene_packet_leaf_Next(select(reference - tested * (package_types__2LEAF_COUNT_ONE - 1u), top, is_last), is_last);
}

fn package_scene_packet_leaf__1tested_triangles(reference: u32) -> u32 {
    return min((reference & package_types__2LEAF_COUNT_MASK) / package_types__2LEAF_COUNT_ONE + 1u, 2u);
}

fn package_scene_packet_leaf__1meet_common(rays: package_scene_packet_lanes_FourRays, hits: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    if (package_bindings__1MOSTLY_SHAPES) {
        return package_scene_packet_leaf__1meet_shape(rays, hits, reference);
    }
    return package_scene_packet_leaf__1meet_triangles(rays, hits, reference);
}

fn package_scene_packet_leaf__1meet_rare(rays: package_scene_packet_lanes_FourRays, hits: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    if (package_bindings__1MOSTLY_SHAPES) {
        return package_scene_packet_leaf__1meet_triangles(rays, hits, reference);
    }
    return package_scene_packet_leaf__1meet_shape(rays, hits, reference);
}

fn package_scene_packet_leaf__1meet_triangles(rays: package_scene_packet_lanes_FourRays, before: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    let count = package_scene_packet_leaf__1tested_triangles(reference);
    let first = select(reference & package_types__2LEAF_FIRST_MASK, 0u, package_scene_packet_leaf__1has_shapes(reference));
    let row = package_scene_fetch__1triangle_row(3u * first + package_scene_packet_lanes__1packet_lane);
    if (package_bindings__1COUNT_STEPS) {
        package_scene_loops__1primitives_tested += count;
    }
    let hits = package_scene_packet_leaf__1meet_triangle(rays, before, package_scene_packet_leaf__1triangle_of(row, 0u), first, true);
    return package_scene_packet_leaf__1meet_triangle(rays, hits, package_scene_packet_leaf__1triangle_of(row, 3u), first + 1u, count > 1u);
}

fn package_scene_packet_leaf__1triangle_of(row: vec4u, lane: u32) -> package_types_PackedTriangle {
    return package_types_PackedTriangle(package_scene_packet_leaf__1corner_of(row, lane), 0u, package_scene_packet_leaf__1corner_of(row, lane + 1u), 0u, package_scene_packet_leaf__1corner_of(row, lane + 2u), 0u);
}

fn package_scene_packet_leaf__1row_of(row: vec4u, lane: u32) -> vec4u {
    return vec4u(subgroupShuffle(row.x, lane), subgroupShuffle(row.y, lane), subgroupShuffle(row.z, lane), subgroupShuffle(row.w, lane));
}

fn package_scene_packet_leaf__1corner_of(row: vec4u, lane: u32) -> vec3f {
    return bitcast<vec3f>(vec3u(subgroupShuffle(row.x, lane), subgroupShuffle(row.y, lane), subgroupShuffle(row.z, lane)));
}

fn package_scene_packet_leaf__1meet_triangle(rays: package_scene_packet_lanes_FourRays, before: package_scene_packet_lanes_FourHits, triangle: package_types_PackedTriangle, primitive: u32, is_there: bool) -> package_scene_packet_lanes_FourHits {
    return package_scene_packet_lanes_FourHits(package_scene_packet_lanes__1closer_two(rays.r0, before.h0, package_scene_packet_leaf__1candidate_of(rays.r0, triangle, is_there), primitive), package_scene_packet_lanes__1closer_two(rays.r1, before.h1, package_scene_packet_leaf__1candidate_of(rays.r1, triangle, is_there), primitive), package_scene_packet_lanes__1closer_two(rays.r2, before.h2, package_scene_packet_leaf__1candidate_of(rays.r2, triangle, is_there), primitive), package_scene_packet_lanes__1closer_two(rays.r3, before.h3, package_scene_packet_leaf__1candidate_of(rays.r3, triangle, is_there), primitive));
}

fn package_scene_packet_leaf__1candidate_of(at: package_scene_primitive_TraversalRay, triangle: package_types_PackedTriangle, is_there: bool) -> package_types_Candidate {
    let candidate = package_scene_primitive__1test_triangle(at.ray, triangle, at.shear);
    return package_types_Candidate(candidate.hit & is_there, candidate.t, candidate.b1, candidate.b2);
}

fn package_scene_packet_leaf__1meet_shape(rays: package_scene_packet_lanes_FourRays, before: package_scene_packet_lanes_FourHits, reference: u32) -> package_scene_packet_lanes_FourHits {
    let index = select(0u, reference & package_types__2LEAF_FIRST_MASK, package_scene_packet_leaf__1has_shapes(reference));
    let primitive = package_types_SHAPE | index;
    let row = package_scene_fetch__1triangle_row(package_scene_fetch__1shape_row + package_types__1SHAPE_ROWS * index + package_scene_packet_lanes__1packet_lane);
    if (package_bindings__1COUNT_STEPS) {
        package_scene_loops__1primitives_tested += 1u;
    }
    let shape = package_scene_fetch__1shape_of(package_scene_packet_leaf__1row_of(row, 0u), package_scene_packet_leaf__1row_of(row, 1u), package_scene_packet_leaf__1row_of(row, 2u), package_scene_packet_leaf__1row_of(row, 3u), package_scene_packet_leaf__1row_of(row, 4u));
    return package_scene_packet_lanes_FourHits(package_scene_packet_lanes__1closer_two(rays.r0, before.h0, package_scene_shape__1test_shape(rays.r0.ray, shape), primitive), package_scene_packet_lanes__1closer_two(rays.r1, before.h1, package_scene_shape__1test_shape(rays.r1.ray, shape), primitive), package_scene_packet_lanes__1closer_two(rays.r2, before.h2, package_scene_shape__1test_shape(rays.r2.ray, shape), primitive), package_scene_packet_lanes__1closer_two(rays.r3, before.h3, package_scene_shape__1test_shape(rays.r3.ray, shape), primitive));
}

const package_scene_shape_SPHERES: u32 = 1u << package_types__1SHAPE_SPHERE;

const package_scene_shape_DISCS: u32 = 1u << package_types__1SHAPE_DISC;

const package_scene_shape_RECTANGLES: u32 = 1u << package_types__1SHAPE_RECTANGLE;

const package_scene_shape_BOXES: u32 = 1u << package_types__1SHAPE_BOX;

const package_scene_shape_CONES: u32 = 1u << package_types__1SHAPE_CONE;

const package_scene_shape_TORI: u32 = 1u << package_types__1SHAPE_TORUS;

const package_scene_shape_ELLIPSOIDS: u32 = 1u << package_types__1SHAPE_ELLIPSOID;

const package_scene_shape_GLOBES: u32 = 1u << package_types__1SHAPE_GLOBE;

fn package_scene_shape__1test_shape(ray: package_types_Ray, shape: package_types_PackedShape) -> package_types_Candidate {
    if (package_bindings__1SHAPE_KINDS == package_scene_shape_SPHERES) {
        return package_lib_intersect_sphere__1intersect_sphere(ray, shape.position, shape.size0);
    }
    var candidate = package_types_Candidate(false, 0.0, 0.0, 0.0);
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_SPHERES) != 0u && shape.kind == package_types__1SHAPE_SPHERE) {
        candidate = package_lib_intersect_sphere__1intersect_sphere(ray, shape.position, shape.size0);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_GLOBES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_GLOBES || shape.kind == package_types__1SHAPE_GLOBE)) {
        candidate = package_lib_intersect_globe__1intersect_globe(ray, shape.position, shape.row_y, shape.size0);
    }
    let local = package_lib_canonical__1canonical_ray(ray, shape);
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_DISCS) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_DISCS || shape.kind == package_types__1SHAPE_DISC)) {
        candidate = package_lib_intersect_disc__1intersect_disc(local, shape.size0);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_RECTANGLES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_RECTANGLES || shape.kind == package_types__1SHAPE_RECTANGLE)) {
        candidate = package_lib_intersect_rectangle__1intersect_rectangle(local);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_BOXES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_BOXES || shape.kind == package_types__1SHAPE_BOX)) {
        candidate = package_lib_intersect_box__1intersect_box(local);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_CONES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_CONES || shape.kind == package_types__1SHAPE_CONE)) {
        candidate = package_lib_intersect_cone__1intersect_cone(local, shape.size0, shape.size1, (shape.flags & package_types__1SHAPE_CAPPED) != 0u);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_TORI) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_TORI || shape.kind == package_types__1SHAPE_TORUS)) {
        candidate = package_lib_intersect_torus__1intersect_torus(local, shape.size0);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_ELLIPSOIDS) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_ELLIPSOIDS || shape.kind == package_types__1SHAPE_ELLIPSOID)) {
        candidate = package_lib_intersect_ellipsoid__1intersect_ellipsoid(local);
    }
    return candidate;
}

fn package_scene_shape__1canonical_point(shape: package_types_PackedShape, reached: vec3f, part: f32) -> package_lib_canonical_CanonicalPoint {
    let p = package_lib_canonical__1canonical_vector(shape, reached - shape.position);
    var point: package_lib_canonical_CanonicalPoint;
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_DISCS) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_DISCS || shape.kind == package_types__1SHAPE_DISC)) {
        point = package_lib_intersect_disc__1disc_point(p);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_RECTANGLES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_RECTANGLES || shape.kind == package_types__1SHAPE_RECTANGLE)) {
        point = package_lib_intersect_rectangle__1rectangle_point(p);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_BOXES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_BOXES || shape.kind == package_types__1SHAPE_BOX)) {
        point = package_lib_intersect_box__1box_point(p, part);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_CONES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_CONES || shape.kind == package_types__1SHAPE_CONE)) {
        point = package_lib_intersect_cone__1cone_point(p, shape.size0, shape.size1, part);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_TORI) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_TORI || shape.kind == package_types__1SHAPE_TORUS)) {
        point = package_lib_intersect_torus__1torus_point(p, shape.size0);
    }
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_ELLIPSOIDS) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_ELLIPSOIDS || shape.kind == package_types__1SHAPE_ELLIPSOID)) {
        point = package_lib_intersect_ellipsoid__1ellipsoid_point(p);
    }
    return point;
}

fn package_scene_shape__1is_round(kind: u32) -> bool {
    if ((package_bindings__1SHAPE_KINDS & (package_scene_shape_SPHERES | package_scene_shape_GLOBES)) == 0u) {
        return false;
    }
    return (package_bindings__1SHAPE_KINDS & ~(package_scene_shape_SPHERES | package_scene_shape_GLOBES)) == 0u || kind == package_types__1SHAPE_SPHERE || kind == package_types__1SHAPE_GLOBE;
}

fn package_scene_shape__1is_flat(kind: u32) -> bool {
    return (package_bindings__1SHAPE_KINDS & (package_scene_shape_DISCS | package_scene_shape_RECTANGLES)) != 0u && (kind == package_types__1SHAPE_DISC || kind == package_types__1SHAPE_RECTANGLE);
}

fn package_lib_intersect_sphere__1intersect_sphere(ray: package_types_Ray, center: vec3f, radius: f32) -> package_types_Candidate {
    let f = ray.origin - center;
    let a = dot(ray.direction, ray.direction);
    let b = -dot(f, ray.direction);
    let nearest = f + (b / a) * ray.direction;
    let discriminant = radius * radius - dot(nearest, nearest);
    if (discriminant < 0.0) {
        return package_types_Candidate(false, 0.0, 0.0, 0.0);
    }
    let c = dot(f, f) - radius * radius;
    let q = b + select(-1.0, 1.0, b >= 0.0) * sqrt(a * discriminant);
    let t0 = select(0.0, c / select(1.0, q, abs(q) > 1e-30), abs(q) > 1e-30);
    let t1 = q / a;
    let near = min(t0, t1);
    let t = select(max(t0, t1), near, near > 0.0);
    return package_types_Candidate(t > 0.0, t, 0.0, 0.0);
}

fn package_lib_intersect_globe__1intersect_globe(ray: package_types_Ray, anchor: vec3f, n: vec3f, curvature: f32) -> package_types_Candidate {
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
        return package_types_Candidate(false, 0.0, 0.0, 0.0);
    }
    let q = b + select(-1.0, 1.0, b >= 0.0) * sqrt(discriminant);
    let t0 = select(0.0, c / select(1.0, q, abs(q) > 1e-30), abs(q) > 1e-30);
    let t1 = q / a;
    let near = min(t0, t1);
    let t = select(max(t0, t1), near, near > 0.0);
    return package_types_Candidate(t > 0.0, t, 0.0, 0.0);
}

fn package_lib_intersect_globe__1globe_point(shape: package_types_PackedShape, reached: vec3f) -> package_lib_canonical_PlacedPoint {
    let w = reached - shape.position;
    let f = shape.row_y + shape.size0 * w;
    let height = (shape.size0 * dot(w, w) + 2.0 * dot(shape.row_y, w)) / (1.0 + length(f));
    let ng = package_lib_numeric__1normalize_or(f, shape.row_y);
    let p = reached - height * ng;
    return package_lib_canonical_PlacedPoint(p, ng, 16.0 * package_lib_numeric_ROUNDING * (abs(p) + abs(shape.position) + 2.0 * length(w)));
}

const package_lib_canonical__1TWO_PI: f32 = 6.2831855;

struct package_lib_canonical_CanonicalPoint {
    p: vec3f,
    n: vec3f,
    uv: vec2f
}

struct package_lib_canonical_PlacedPoint {
    p: vec3f,
    ng: vec3f,
    error: vec3f
}

struct package_lib_canonical_Approach {
    origin: vec3f,
    start: f32,
    direction: vec3f,
    t_per_length: f32,
    near: bool
}

fn package_lib_canonical__1canonical_vector(shape: package_types_PackedShape, v: vec3f) -> vec3f {
    return vec3f(dot(shape.row_x, v), dot(shape.row_y, v), dot(shape.row_z, v));
}

fn package_lib_canonical__1canonical_ray(ray: package_types_Ray, shape: package_types_PackedShape) -> package_types_Ray {
    return package_types_Ray(package_lib_canonical__1canonical_vector(shape, ray.origin - shape.position), ray.t_max, package_lib_canonical__1canonical_vector(shape, ray.direction), ray.leaving, ray.leaving_instance);
}

fn package_lib_canonical_approach(ray: package_types_Ray, center: vec3f, reach: f32) -> package_lib_canonical_Approach {
    let size = abs(ray.direction);
    let largest = max(max(size.x, max(size.y, size.z)), 1e-30);
    let scaled = ray.direction / largest;
    let inv_length = inverseSqrt(max(dot(scaled, scaled), 1e-30));
    let direction = scaled * inv_length;
    let start = max(dot(center - ray.origin, direction) - reach, 0.0);
    let origin = ray.origin + start * direction;
    let off = abs(origin - center);
    let near = max(off.x, max(off.y, off.z)) <= 2.0 * reach;
    return package_lib_canonical_Approach(select(center + reach, origin, near), start, direction, inv_length / largest, near);
}

fn package_lib_canonical__1approached_t(near: package_lib_canonical_Approach, s: f32) -> f32 {
    return (near.start + s) * near.t_per_length;
}

fn package_lib_canonical__1placed_point(shape: package_types_PackedShape, reached: vec3f, point: package_lib_canonical_CanonicalPoint) -> package_lib_canonical_PlacedPoint {
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
    let way = point.p - package_lib_canonical__1canonical_vector(shape, q);
    let p = reached + (way.x * column_x + way.y * column_y + way.z * column_z);
    let size = vec3f(dot(abs(shape.row_x), abs(q)), dot(abs(shape.row_y), abs(q)), dot(abs(shape.row_z), abs(q))) + 1.0;
    let reach = size.x * abs(column_x) + size.y * abs(column_y) + size.z * abs(column_z);
    let normal = point.n.x * shape.row_x + point.n.y * shape.row_y + point.n.z * shape.row_z;
    return package_lib_canonical_PlacedPoint(p, package_lib_numeric__1normalize_or(normal, y), package_lib_offset__1placed_error(p, shape.position, reach));
}

fn package_lib_canonical_longitude(x: f32, z: f32) -> f32 {
    let on_axis = (x == 0.0) & (z == 0.0);
    return saturate(0.5 + atan2(x, select(z, 1.0, on_axis)) / package_lib_canonical__1TWO_PI);
}

fn package_lib_canonical__1sphere_uv(n: vec3f) -> vec2f {
    let off_axis = length(n.xz);
    let at_center = (off_axis == 0.0) & (n.y == 0.0);
    let latitude = atan2(n.y, select(off_axis, 1.0, at_center));
    return vec2f(package_lib_canonical_longitude(n.x, n.z), saturate(0.5 + 2.0 * latitude / package_lib_canonical__1TWO_PI));
}

fn package_lib_canonical_outwards(v: vec2f) -> vec2f {
    let size = length(v);
    let usable = size > 1e-18;
    return select(vec2f(1.0, 0.0), v / select(1.0, size, usable), usable);
}

fn package_lib_intersect_disc__1intersect_disc(ray: package_types_Ray, hole: f32) -> package_types_Candidate {
    let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
    let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
    let p = clamp(ray.origin.xz + t * ray.direction.xz, vec2f(-2.0), vec2f(2.0));
    let distance = dot(p, p);
    return package_types_Candidate(steep & (t > 0.0) & (distance <= 1.0) & (distance >= hole * hole), t, 0.0, 0.0);
}

fn package_lib_intersect_disc__1disc_point(p: vec3f) -> package_lib_canonical_CanonicalPoint {
    return package_lib_canonical_CanonicalPoint(vec3f(p.x, 0.0, p.z), vec3f(0.0, 1.0, 0.0), saturate(0.5 + 0.5 * vec2f(p.x, -p.z)));
}

fn package_lib_intersect_rectangle__1intersect_rectangle(ray: package_types_Ray) -> package_types_Candidate {
    let steep = abs(ray.direction.y) > 1e-25 * abs(ray.origin.y);
    let t = -ray.origin.y / select(1.0, ray.direction.y, steep);
    let way = t * ray.direction.xz;
    let slack = 4.0 * package_lib_numeric_ROUNDING * (abs(ray.origin.xz) + abs(way));
    let inside = all(abs(ray.origin.xz + way) <= 1.0 + slack);
    return package_types_Candidate(steep & (t > 0.0) & inside, t, 0.0, 0.0);
}

fn package_lib_intersect_rectangle__1rectangle_point(p: vec3f) -> package_lib_canonical_CanonicalPoint {
    return package_lib_canonical_CanonicalPoint(vec3f(p.x, 0.0, p.z), vec3f(0.0, 1.0, 0.0), saturate(0.5 + 0.5 * vec2f(p.x, -p.z)));
}

fn package_lib_intersect_box__1intersect_box(ray: package_types_Ray) -> package_types_Candidate {
    let size = abs(ray.direction);
    let largest = max(max(size.x, max(size.y, size.z)), 1e-30);
    let inv = package_lib_numeric__1safe_reciprocal(ray.direction / largest);
    let origin = clamp(ray.origin, vec3f(-1e18), vec3f(1e18));
    let t0 = (-1.0 - origin) * inv;
    let t1 = (1.0 - origin) * inv;
    let enters = min(t0, t1);
    let leaves = max(t0, t1);
    let enter = max(enters.x, max(enters.y, enters.z));
    let leave = min(leaves.x, min(leaves.y, leaves.z));
    let from_outside = enter > 0.0;
    let s = select(leave, enter, from_outside);
    let planes = select(leaves, enters, from_outside);
    let axis = select(select(2u, 1u, planes.y == s), 0u, planes.x == s);
    let positive = (inv[axis] < 0.0) == from_outside;
    let side = f32(axis) + select(0.0, 3.0, positive);
    let hit = (enter <= leave) & (s > 0.0);
    return package_types_Candidate(hit, select(0.0, s, hit) / largest, side, 0.0);
}

fn package_lib_intersect_box__1box_point(p: vec3f, side: f32) -> package_lib_canonical_CanonicalPoint {
    let code = u32(side + 0.5);
    let positive = code >= 3u;
    let axis = code - select(0u, 3u, positive);
    let sign = select(-1.0, 1.0, positive);
    let n = select(vec3f(0.0), vec3f(sign), vec3<bool>(axis == 0u, axis == 1u, axis == 2u));
    let place = select(p, n, n != vec3f(0.0));
    let right = select(select(sign * p.x, p.x, axis == 1u), -sign * p.z, axis == 0u);
    let up = select(p.y, -sign * p.z, axis == 1u);
    return package_lib_canonical_CanonicalPoint(place, n, saturate(0.5 + 0.5 * vec2f(right, up)));
}

const package_lib_intersect_cone_FAR: f32 = 1e30;

const package_lib_intersect_cone_SIDE: f32 = 0.0;

const package_lib_intersect_cone_BOTTOM: f32 = 1.0;

const package_lib_intersect_cone_TOP: f32 = 2.0;

fn package_lib_intersect_cone__1intersect_cone(ray: package_types_Ray, bottom: f32, top: f32, capped: bool) -> package_types_Candidate {
    let near = package_lib_canonical_approach(ray, vec3f(0.0, 0.5, 0.0), 1.5);
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
    let root = sqrt(max(discriminant, 0.0));
    let q = -(b + select(-root, root, b >= 0.0));
    let usable = abs(q) > 1e-20;
    let r1 = q / a;
    let r2 = select(0.0, c / select(1.0, q, usable), usable);
    let low = min(r1, r2);
    let high = max(r1, r2);
    let steep = a < 0.0;
    let widens = slope * d.y > 0.0;
    let side_in = select(low, select(-package_lib_intersect_cone_FAR, high, widens), steep);
    let side_out = select(high, select(low, package_lib_intersect_cone_FAR, widens), steep);
    let level = abs(d.y) < 1e-18;
    let inv_y = 1.0 / select(d.y, select(1e-18, -1e-18, d.y < 0.0), level);
    let y0 = -o.y * inv_y;
    let y1 = (1.0 - o.y) * inv_y;
    let slab_in = min(y0, y1);
    let slab_out = max(y0, y1);
    let enter = max(slab_in, side_in);
    let leave = min(slab_out, side_out);
    let enters_side = side_in >= slab_in;
    let leaves_side = side_out <= slab_out;
    let takes_enter = (near.start + enter > 0.0) & (enters_side | capped);
    let takes_leave = (near.start + leave > 0.0) & (leaves_side | capped);
    let met = (steep | (discriminant >= 0.0)) & (enter <= leave);
    let hit = near.near & met & (takes_enter | takes_leave);
    let rough = select(0.0, select(leave, enter, takes_enter), hit);
    let is_side = select(leaves_side, enters_side, takes_enter);
    let end = select(package_lib_intersect_cone_BOTTOM, package_lib_intersect_cone_TOP, (d.y > 0.0) != takes_enter);
    let s = select(rough, package_lib_intersect_cone_polish(o, d, bottom, slope, rough), is_side);
    let t = package_lib_canonical__1approached_t(near, s);
    return package_types_Candidate(hit & (t > 0.0), t, select(end, package_lib_intersect_cone_SIDE, is_side), 0.0);
}

fn package_lib_intersect_cone_polish(o: vec3f, d: vec3f, bottom: f32, slope: f32, s: f32) -> f32 {
    let p = o + s * d;
    let off_axis = length(p.xz);
    let rate = dot(p.xz, d.xz) / max(off_axis, 1e-18) - slope * d.y;
    let usable = abs(rate) > 0.001;
    let step = (off_axis - (bottom + slope * p.y)) / select(1.0, rate, usable);
    return s - clamp(select(0.0, step, usable), -0.001, 0.001);
}

fn package_lib_intersect_cone__1cone_point(p: vec3f, bottom: f32, top: f32, part: f32) -> package_lib_canonical_CanonicalPoint {
    let slope = top - bottom;
    let out = package_lib_canonical_outwards(p.xz);
    if (part < 0.5) {
        let y = saturate(p.y);
        let radius = bottom + slope * y;
        let n = vec3f(out.x, -slope, out.y) * inverseSqrt(1.0 + slope * slope);
        return package_lib_canonical_CanonicalPoint(vec3f(radius * out.x, y, radius * out.y), n, vec2f(package_lib_canonical_longitude(p.x, p.z), y));
    }
    let is_top = part > 1.5;
    let radius = select(bottom, top, is_top);
    let flat = out * min(length(p.xz), radius);
    let sign = select(-1.0, 1.0, is_top);
    let uv = vec2f(flat.x, -sign * flat.y) / max(radius, 1e-18);
    return package_lib_canonical_CanonicalPoint(vec3f(flat.x, select(0.0, 1.0, is_top), flat.y), vec3f(0.0, sign, 0.0), saturate(0.5 + 0.5 * uv));
}

const package_lib_intersect_torus__1MOST_ROUNDS: u32 = 40u;

const package_lib_intersect_torus_NARROW: f32 = 1.2e-7;

fn package_lib_intersect_torus__1torus_distance(p: vec3f, minor: f32) -> f32 {
    return length(vec2f(length(p.xz) - 1.0, p.y)) - minor;
}

fn package_lib_intersect_torus_polish(s: f32, p: f32, q: f32) -> f32 {
    let slope = 3.0 * s * s + p;
    let steep = abs(slope) > 0.001;
    return s - clamp(select(0.0, ((s * s + p) * s + q) / select(1.0, slope, steep), steep), -0.02, 0.02);
}

fn package_lib_intersect_torus__1cubic_zeros(p: f32, q: f32) -> vec3f {
    let third = p / 3.0;
    let half = 0.5 * q;
    let discriminant = half * half + third * third * third;
    let cube = abs(half) + sqrt(max(discriminant, 0.0));
    let large = -select(-1.0, 1.0, half >= 0.0) * select(0.0, exp2(log2(max(cube, 1e-30)) / 3.0), cube > 1e-30);
    let small = select(0.0, -third / select(1.0, large, large != 0.0), large != 0.0);
    let one = package_lib_intersect_torus_polish(large + small, p, q);
    let size = sqrt(max(-third, 0.0));
    let usable = size > 1e-10;
    let cosine = clamp(select(0.0, -half / select(1.0, size * size * size, usable), usable), -1.0, 1.0);
    let angle = acos(cosine) / 3.0;
    let a = package_lib_intersect_torus_polish(2.0 * size * cos(angle + package_lib_canonical__1TWO_PI / 3.0), p, q);
    let b = package_lib_intersect_torus_polish(2.0 * size * cos(angle - package_lib_canonical__1TWO_PI / 3.0), p, q);
    let c = package_lib_intersect_torus_polish(2.0 * size * cos(angle), p, q);
    let three = vec3f(min(a, min(b, c)), max(min(a, b), min(max(a, b), c)), max(a, max(b, c)));
    return select(three, vec3f(one), discriminant > 0.0);
}

fn package_lib_intersect_torus__1intersect_torus(ray: package_types_Ray, minor: f32) -> package_types_Candidate {
    let outer = 1.0 + minor;
    let near = package_lib_canonical_approach(ray, vec3f(0.0), 1.5 * outer);
    let o = near.origin;
    let d = near.direction;
    let middle = -dot(o, d);
    let nearest = o + middle * d;
    let apart = dot(nearest, nearest);
    let ball = 1.0001 * outer;
    let half_chord = sqrt(max(ball * ball - apart, 0.0));
    let start = max(middle - half_chord, 0.0);
    let end = middle + half_chord;
    let zeros = middle + package_lib_intersect_torus__1cubic_zeros(apart - 1.0 - minor * minor + 2.0 * d.y * d.y, 2.0 * nearest.y * d.y);
    let cuts = vec4f(clamp(zeros, vec3f(start), vec3f(max(end, start))), end);
    let outside = package_lib_intersect_torus__1torus_distance(o + start * d, minor) >= 0.0;
    let changes = vec4<bool>((package_lib_intersect_torus__1torus_distance(o + cuts.x * d, minor) >= 0.0) != outside, (package_lib_intersect_torus__1torus_distance(o + cuts.y * d, minor) >= 0.0) != outside, (package_lib_intersect_torus__1torus_distance(o + cuts.z * d, minor) >= 0.0) != outside, (package_lib_intersect_torus__1torus_distance(o + cuts.w * d, minor) >= 0.0) != outside);
    let found = near.near & (apart <= ball * ball) & (end > start) & any(changes);
    let last = select(select(select(cuts.w, cuts.z, changes.z), cuts.y, changes.y), cuts.x, changes.x);
    let first = select(select(select(cuts.z, cuts.y, changes.z), cuts.x, changes.y), start, changes.x);
    let s = package_lib_intersect_torus__1root_between(o, d, minor, select(last, first, found), last, outside);
    let t = package_lib_canonical__1approached_t(near, s);
    return package_types_Candidate(found & (t > 0.0), t, 0.0, 0.0);
}

fn package_lib_intersect_torus__1root_between(o: vec3f, d: vec3f, minor: f32, first: f32, last: f32, outside: bool) -> f32 {
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
        let ring_slope = dot(p.xz, d.xz) / max(ring, 1e-20);
        let slope = dot(from_ring, vec2f(ring_slope, d.y)) / max(to_middle, 1e-20);
        let usable = abs(slope) > 1e-6;
        let newton = s - distance / select(1.0, slope, usable);
        let takes_newton = usable & (newton > low) & (newton < high) & (abs(newton - s) < 0.5 * moved);
        let next = select(0.5 * (low + high), newton, takes_newton);
        moved = abs(next - s);
        s = next;
        rounds += 1u;
        continuing {
        
            break if (moved <= package_lib_intersect_torus_NARROW * (1.0 + abs(s))) | (rounds >= package_lib_intersect_torus__1MOST_ROUNDS);
        }
    }
    return s;
}

fn package_lib_intersect_torus__1torus_point(p: vec3f, minor: f32) -> package_lib_canonical_CanonicalPoint {
    let out = package_lib_canonical_outwards(p.xz);
    let tube = package_lib_canonical_outwards(vec2f(length(p.xz) - 1.0, p.y));
    let n = vec3f(tube.x * out.x, tube.y, tube.x * out.y);
    let ring = 1.0 + minor * tube.x;
    let place = vec3f(ring * out.x, minor * tube.y, ring * out.y);
    return package_lib_canonical_CanonicalPoint(place, n, vec2f(package_lib_canonical_longitude(p.x, p.z), saturate(0.5 + atan2(tube.y, tube.x) / package_lib_canonical__1TWO_PI)));
}

fn package_lib_intersect_ellipsoid__1intersect_ellipsoid(ray: package_types_Ray) -> package_types_Candidate {
    let near = package_lib_canonical_approach(ray, vec3f(0.0), 1.5);
    let found = package_lib_intersect_sphere__1intersect_sphere(package_types_Ray(near.origin, ray.t_max, near.direction, package_types_NONE, ray.leaving_instance), vec3f(0.0), 1.0);
    return package_types_Candidate(near.near & found.hit, package_lib_canonical__1approached_t(near, found.t), 0.0, 0.0);
}

fn package_lib_intersect_ellipsoid__1ellipsoid_point(p: vec3f) -> package_lib_canonical_CanonicalPoint {
    let n = package_lib_numeric__1normalize_or(p, vec3f(0.0, 1.0, 0.0));
    return package_lib_canonical_CanonicalPoint(n, n, package_lib_canonical__1sphere_uv(n));
}

fn package_lib_intersect__1triangle_plane__2intersect_triangle_plane(ray: package_types_Ray, v0: vec3f, v1: vec3f, v2: vec3f) -> package_types_Candidate {
    let e1 = v1 - v0;
    let e2 = v2 - v0;
    let n = cross(e1, e2);
    let slope = dot(n, ray.direction);
    let area = dot(n, n);
    let usable = (abs(slope) > 4.0 * package_lib_numeric_ROUNDING * length(e1) * length(e2)) & (area > 1e-36);
    let t = dot(n, v0 - ray.origin) / select(1.0, slope, usable);
    let w = ray.origin + t * ray.direction - v0;
    let b1 = dot(cross(w, e2), n) / select(1.0, area, usable);
    let b2 = dot(cross(e1, w), n) / select(1.0, area, usable);
    let inside = (b1 >= 0.0) & (b2 >= 0.0) & (b1 + b2 <= 1.0);
    return package_types_Candidate(usable & inside & (t > 0.0), t, b1, b2);
}

fn package_lib_intersect__2triangle_moller_trumbore__3intersect_triangle_moller_trumbore(ray: package_types_Ray, v0: vec3f, v1: vec3f, v2: vec3f) -> package_types_Candidate {
    let e1 = v1 - v0;
    let e2 = v2 - v0;
    let p = cross(ray.direction, e2);
    let det = dot(e1, p);
    let usable = abs(det) > 4.0 * package_lib_numeric_ROUNDING * length(e1) * length(e2);
    let inv_det = 1.0 / select(1.0, det, usable);
    let s = ray.origin - v0;
    let b1 = inv_det * dot(s, p);
    let q = cross(s, e1);
    let b2 = inv_det * dot(ray.direction, q);
    let t = inv_det * dot(e2, q);
    let inside = (b1 >= 0.0) & (b2 >= 0.0) & (b1 + b2 <= 1.0);
    return package_types_Candidate(usable & inside & (t > 0.0), t, b1, b2);
}

struct package_scene_direct_Receiver {
    surface: package_types_Surface,
    v: vec3f,
    key: package_types_SampleKey
}

struct package_scene_direct_Receivers {
    p: package_scene_wide_Vectors,
    error: package_scene_wide_Vectors,
    ng: package_scene_wide_Vectors,
    n: package_scene_wide_Vectors,
    v: package_scene_wide_Vectors,
    diffuse: package_scene_wide_Vectors,
    specular: package_scene_wide_Vectors,
    shininess: package_scene_wide_Floats,
    leaving: package_scene_wide_Words,
    instance: package_scene_wide_Words,
    hash: package_scene_wide_Words,
    weight: package_scene_wide_Floats,
    is_lit: package_scene_wide_Words
}

fn package_scene_direct__1no_receivers() -> package_scene_direct_Receivers {
    let none = package_scene_wide__1no_vectors();
    return package_scene_direct_Receivers(none, none, none, none, none, none, none, package_scene_wide_Floats(0.0), package_scene_wide_Words(0u), package_scene_wide_Words(0u), package_scene_wide_Words(0u), package_scene_wide_Floats(0.0), package_scene_wide_Words(0u));
}

fn package_scene_direct__1receiver_set(all: package_scene_direct_Receivers, k: u32, surface: package_types_Surface, v: vec3f, key: package_types_SampleKey) -> package_scene_direct_Receivers {
    return package_scene_direct_Receivers(package_scene_wide__1vector_set(all.p, k, surface.p), package_scene_wide__1vector_set(all.error, k, surface.error), package_scene_wide__1vector_set(all.ng, k, surface.ng), package_scene_wide__1vector_set(all.n, k, surface.n), package_scene_wide__1vector_set(all.v, k, v), package_scene_wide__1vector_set(all.diffuse, k, surface.phong.diffuse), package_scene_wide__1vector_set(all.specular, k, surface.phong.specular), package_scene_wide__1float_set(all.shininess, k, surface.phong.shininess), package_scene_wide__1word_set(all.leaving, k, surface.leaving), package_scene_wide__1word_set(all.instance, k, surface.instance), package_scene_wide__1word_set(all.hash, k, key.hash), package_scene_wide__1float_set(all.weight, k, key.weight), package_scene_wide__1word_set(all.is_lit, k, 1u));
}

fn package_scene_direct__1receiver_at(all: package_scene_direct_Receivers, k: u32) -> package_scene_direct_Receiver {
    var surface: package_types_Surface;
    surface.p = package_scene_wide__1vector_at(all.p, k);
    surface.error = package_scene_wide__1vector_at(all.error, k);
    surface.ng = package_scene_wide__1vector_at(all.ng, k);
    surface.n = package_scene_wide__1vector_at(all.n, k);
    surface.leaving = package_scene_wide__1word_at(all.leaving, k);
    surface.instance = package_scene_wide__1word_at(all.instance, k);
    surface.phong.diffuse = package_scene_wide__1vector_at(all.diffuse, k);
    surface.phong.specular = package_scene_wide__1vector_at(all.specular, k);
    surface.phong.shininess = package_scene_wide__1float_at(all.shininess, k);
    return package_scene_direct_Receiver(surface, package_scene_wide__1vector_at(all.v, k), package_types_SampleKey(package_scene_wide__1word_at(all.hash, k), 0u, package_scene_wide__1float_at(all.weight, k)));
}

fn package_scene_direct__1direct_light(batch: package_scene_dispatch_Batch, receivers: package_scene_direct_Receivers, media: package_scene__1ray_stack_Media, sample: u32) -> package_scene_wide_Vectors {
    var color = package_scene_wide__1no_vectors();
    if (!package_bindings__1HAS_LIGHTS) {
        return color;
    }
    var index = 0u;
    loop {
        let light = package_scene_shutter__1shutter_light(index, batch.light_count);
        color = package_scene_direct__1with_light(batch, color, receivers, media, sample, light, index);
        continuing {
            index += 1u;
            break if index >= batch.light_count;
        }
    }
    package_scene_loops__1cut_off |= index < batch.light_count;
    return color;
}

fn package_scene_direct__1with_light(batch: package_scene_dispatch_Batch, before: package_scene_wide_Vectors, receivers: package_scene_direct_Receivers, media: package_scene__1ray_stack_Media, sample: u32, light: package_types_PackedLight, index: u32) -> package_scene_wide_Vectors {
    var sum = package_scene_wide__1no_vectors();
    var counts = package_scene_wide_Floats(1.0);
    let has_extent = package_bindings__2HAS_AREA_LIGHTS && light.kind >= package_types__1LIGHT_RECTANGLE;
    var drawn = 0u;
    var is_unfinished = false;
    loop {
        var rays = package_scene_rays__1dead_rays();
        var unshadowed = package_scene_wide__1no_vectors();
        is_unfinished = false;
        var k = 0u;
        loop {
            if (package_scene_wide__1word_at(receivers.is_lit, k) != 0u) {
                let receiver = package_scene_direct__1receiver_at(receivers, k);
                var count = 1u;
                if (has_extent) {
                    let wanted = max(round(f32(light.sample_count) * batch.light_samples * receiver.key.weight), 1.0);
                    count = u32(wanted);
                    counts = package_scene_wide__1float_set(counts, k, f32(count));
                }
                if (drawn < count) {
                    var arriving = package_lib_light_incident(light, receiver.surface.p);
                    if (has_extent) {
                        let hash = package_lib_rng__1hash_combine(receiver.key.hash, index);
                        arriving = package_lib__1area_light__1area_incident(light, receiver.surface.p, package_lib_sampling__1stratified_2d(sample * count + drawn, hash));
                    }
                    let reflected = arriving.radiance * package_lib_phong_phong(receiver.surface.phong, receiver.surface.n, arriving.direction, receiver.v);
                    if (any(reflected > vec3f(0.0))) {
                        rays = package_scene_rays__1ray_set(rays, k, package_scene_direct__1shadow_ray(receiver.surface, arriving));
                        unshadowed = package_scene_wide__1vector_set(unshadowed, k, reflected);
                    }
                    is_unfinished |= drawn + 1u < count;
                }
            }
            continuing {
                k += 1u;
                break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
            }
        }
        package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
        let through = package_scene_shadow__1light_through(rays, media);
        sum.x += through.x * unshadowed.x;
        sum.y += through.y * unshadowed.y;
        sum.z += through.z * unshadowed.z;
        drawn += 1u;
        continuing {
        
            break if !package_scene_rays__1any_lane(is_unfinished);
        }
    }
    package_scene_loops__1cut_off |= is_unfinished;
    return package_scene_wide_Vectors(before.x + sum.x / counts, before.y + sum.y / counts, before.z + sum.z / counts);
}

fn package_scene_direct__1shadow_ray(surface: package_types_Surface, arriving: package_types_Incident) -> package_types_Ray {
    var ray = package_scene_surface__1leaving_ray(surface, arriving.direction, arriving.distance);
    ray.t_max = max(arriving.distance - dot(ray.origin - surface.p, arriving.direction), 0.0);
    return ray;
}

struct package_scene_optics_ScatterEvent {
    arriving: vec3f,
    diffuse: vec3f,
    highlight: vec3f,
    reflected: package_scene__1ray_stack_RayState,
    refracted: package_scene__1ray_stack_RayState
}

struct package_scene_optics_Weights {
    diffuse: vec3f,
    highlight: vec3f
}

fn package_scene_optics_scatter(batch: package_scene_dispatch_Batch, state: package_scene__1ray_stack_RayState, distance: f32, contact: package_scene_contact_Contact, factors: mat3x3f) -> package_scene_optics_ScatterEvent {
    let surface = contact.surface;
    let direction = state.ray.direction;
    let optics = package_scene_fetch__1load_optics(surface.material);
    let transparent = package_bindings__1HAS_REFRACTION && any(optics.transmit > vec3f(0.0));
    var media = state.media;
    var ior = 1.0;
    var ior_behind = optics.ior;
    var arriving = state.throughput;
    var is_boundary = true;
    if (package_bindings__1HAS_REFRACTION) {
        var here = package_scene_medium_dominant(state.media);
        if (transparent) {
            here = package_scene_medium__1medium_before(state.media, surface.material, surface.outside);
            media = package_scene_contact__1media_behind(state.media, contact);
            let behind = package_scene_medium_dominant(media);
            ior_behind = package_scene_medium__1medium_of(behind).ior;
            is_boundary = !package_bindings__1HAS_CONTACT || here != behind;
        }
        let medium = package_scene_medium__1medium_of(here);
        ior = medium.ior;
        arriving *= package_scene_medium_transmittance(medium, distance);
    }
    let ng = select(surface.ng, -surface.ng, dot(surface.ng, direction) > 0.0);
    var n = select(surface.n, -surface.n, dot(surface.n, direction) > 0.0);
    n = select(ng, n, dot(package_lib_fresnel_mirrored(direction, n), ng) > 0.0);
    let boundary = package_scene_optics__1boundary_at(optics.flags, clamp(-dot(direction, n), 0.0, 1.0), ior / ior_behind);
    var reflect = factors[0] * surface.phong.reflect;
    var transmit = factors[1] * optics.transmit;
    if ((optics.flags & package_types__1MATERIAL_FRESNEL) != 0u) {
        reflect *= boundary.reflectance;
        transmit *= 1.0 - boundary.reflectance;
    }
    else if (boundary.total && transparent) {
        reflect += select(transmit, vec3f(0.0), (optics.flags & package_types__1MATERIAL_SUM) != 0u);
        transmit = vec3f(0.0);
    }
    var straight = direction;
    if (is_boundary) {
        straight = package_lib_fresnel_refracted(direction, n, ior / ior_behind, boundary.cos_t);
    }
    else {
        reflect = vec3f(0.0);
        transmit = vec3f(1.0);
    }
    var reflected_ray = package_scene__1ray_stack__1no_ray();
    var refracted_ray = package_scene__1ray_stack__1no_ray();
    let deeper = state.depth < batch.max_depth;
    if (package_bindings__1HAS_REFLECTION && deeper && package_scene_optics__2is_worth_tracing(batch, arriving * reflect)) {
        let way = package_lib_fresnel_mirrored(direction, n);
        let ray = package_scene_surface__1mirrored_ray(surface, way, package_lib_camera__1T_FAR, state.ray, distance);
        reflected_ray = package_scene__1ray_stack_RayState(ray, arriving * reflect, state.media, state.depth + 1u, package_scene__1ray_stack__1KIND_REFLECTED, 2u * state.node);
    }
    if (package_bindings__1HAS_REFRACTION && transparent && (deeper || !is_boundary) && package_scene_optics__2is_worth_tracing(batch, arriving * transmit)) {
        let ray = package_scene_surface__1leaving_ray(surface, straight, package_lib_camera__1T_FAR);
        refracted_ray = package_scene__1ray_stack_RayState(ray, arriving * transmit, media, select(state.depth, state.depth + 1u, is_boundary), package_scene__1ray_stack__1KIND_REFRACTED, 2u * state.node + 1u);
    }
    let sends = any(reflected_ray.throughput > vec3f(0.0));
    let kept = package_scene_optics__1local_weights(optics, reflect, sends);
    let visible = select(0.0, 1.0, is_boundary);
    return package_scene_optics_ScatterEvent(arriving, visible * kept.diffuse, visible * kept.highlight, reflected_ray, refracted_ray);
}

fn package_scene_optics__1boundary_at(flags: u32, cos_i: f32, eta: f32) -> package_lib_fresnel_Boundary {
    if ((flags & package_types__1MATERIAL_SCHLICK) != 0u) {
        return package_lib_fresnel_schlick(cos_i, eta);
    }
    return package_lib_fresnel_fresnel(cos_i, eta);
}

fn package_scene_optics__2is_worth_tracing(batch: package_scene_dispatch_Batch, throughput: vec3f) -> bool {
    let mean = dot(throughput, vec3f(1.0 / 3.0));
    return (mean > 0.0) & (mean >= batch.min_throughput);
}

fn package_scene_optics__1local_weights(optics: package_types_Optics, reflect: vec3f, sends: bool) -> package_scene_optics_Weights {
    let left = max(1.0 - reflect, vec3f(0.0));
    if ((optics.flags & package_types__1MATERIAL_SUM) != 0u) {
        return package_scene_optics_Weights(vec3f(1.0), vec3f(1.0));
    }
    if ((optics.flags & package_types__1MATERIAL_BLEND) != 0u) {
        let weight = select(vec3f(1.0), left, sends);
        return package_scene_optics_Weights(weight, weight);
    }
    return package_scene_optics_Weights(optics.opacity * left, vec3f(1.0));
}

const package_scene_medium_VACUUM: package_types_Medium = package_types_Medium(vec3f(0.0), 1.0, 0);

fn package_scene_medium_dominant(media: vec4u) -> u32 {
    if (!package_bindings__1HAS_CONTACT) {
        return media.x;
    }
    var best = media.x;
    best = package_scene_medium_higher(best, media.y);
    best = package_scene_medium_higher(best, media.z);
    return package_scene_medium_higher(best, media.w);
}

fn package_scene_medium_higher(best: u32, next: u32) -> u32 {
    if (next == package_types_NONE) {
        return best;
    }
    return select(best, next, package_scene_fetch__1load_medium(next).priority >= package_scene_fetch__1load_medium(best).priority);
}

fn package_scene_medium__1medium_of(material: u32) -> package_types_Medium {
    if (material == package_types_NONE) {
        return package_scene_medium_VACUUM;
    }
    return package_scene_fetch__1load_medium(material);
}

fn package_scene_medium_transmittance(medium: package_types_Medium, distance: f32) -> vec3f {
    return exp(-min(medium.absorption * min(distance, 1000000000000.0), vec3f(80.0)));
}

fn package_scene_medium__1cross_surface(media: vec4u, material: u32, entering: bool) -> vec4u {
    return select(package_lib_media_left(media, material), package_lib_media_entered(media, material), vec4<bool>(entering));
}

fn package_scene_medium__1medium_before(media: vec4u, material: u32, entering: bool) -> u32 {
    let started_inside = !entering & !package_lib_media_contains(media, material);
    return select(package_scene_medium_dominant(media), material, started_inside);
}

fn package_scene_background_background(batch: package_scene_dispatch_Batch, direction: vec3f) -> vec3f {
    if (package_bindings_BACKGROUND == package_types__1BACKGROUND_GRADIENT) {
        return mix(batch.background, batch.background_top, 0.5 + 0.5 * direction.y);
    }
    if (package_bindings_BACKGROUND == package_types__1BACKGROUND_PICTURE) {
        let size = batch.background_size;
        let uv = package_lib_picture_equirectangular(direction, batch.background_rotation);
        let color = package_scene_picture__1blend_texels(batch.background_first_texel, size.x, size.y, package_lib_picture_repeated(uv.x, size.x, false), package_lib_picture_ended(uv.y, size.y));
        return batch.background * color;
    }
    return batch.background;
}

const package_lib_picture_PI: f32 = 3.14159265;

struct package_lib_picture_Neighbours {
    first: u32,
    second: u32,
    weight: f32
}

fn package_lib_picture_repeated(at: f32, count: u32, nearest: bool) -> package_lib_picture_Neighbours {
    let place = f32(count) * fract(at) + select(-0.5, 0.0, nearest);
    let below = floor(place);
    let index = i32(below);
    let last = i32(count) - 1;
    let first = select(select(index, last, index < 0), 0, index > last);
    return package_lib_picture_Neighbours(u32(first), u32(select(first + 1, 0, first >= last)), select(place - below, 0.0, nearest));
}

fn package_lib_picture_ended(at: f32, count: u32) -> package_lib_picture_Neighbours {
    let place = clamp(f32(count) * at - 0.5, 0.0, f32(count - 1u));
    let below = floor(place);
    return package_lib_picture_Neighbours(u32(below), min(u32(below) + 1u, count - 1u), place - below);
}

fn package_lib_picture_equirectangular(direction: vec3f, rotation: f32) -> vec2f {
    let level = length(direction.xz);
    let around = atan2(direction.x, select(-direction.z, 1.0, level < 1e-12));
    return vec2f(0.5 + (around + rotation) / (2.0 * package_lib_picture_PI), 0.5 + atan2(direction.y, level) / package_lib_picture_PI);
}

fn package_scene_picture__1blend_texels(first_texel: u32, width: u32, height: u32, columns: package_lib_picture_Neighbours, rows: package_lib_picture_Neighbours) -> vec3f {
    let lower = first_texel + (height - 1u - rows.first) * width;
    let upper = first_texel + (height - 1u - rows.second) * width;
    return mix(mix(package_scene_fetch__1load_texel(lower + columns.first), package_scene_fetch__1load_texel(lower + columns.second), columns.weight), mix(package_scene_fetch__1load_texel(upper + columns.first), package_scene_fetch__1load_texel(upper + columns.second), columns.weight), rows.weight);
}

const package_scene_contact_NEAR: f32 = 1e-5;

const package_scene_contact_EDGE: f32 = 1e-6;

const package_scene_contact__1VAGUE_EDGE: f32 = 0.0001;

struct package_scene_contact_Contact {
    surface: package_types_Surface,
    touching: u32,
    enters_touching: bool
}

fn package_scene_contact__1contact_at(ray: package_types_Ray, hit: package_types_Hit) -> package_scene_contact_Contact {
    package_scene_primitive__1runner_up = package_scene_packet_walk__1second_hit(package_scene__1ray_stack__1current_tree);
    var contact: package_scene_contact_Contact;
    contact.touching = package_types_NONE;
    var current = hit;
    var first = true;
    var second_wanted = false;
    loop {
        let surface = package_scene_surface__1surface_at(ray, current);
        if (first) {
            contact.surface = surface;
            second_wanted = package_bindings__1HAS_REFRACTION && package_bindings__1HAS_CONTACT && package_scene_contact__1is_near(ray, hit, surface);
        }
        else {
            contact = package_scene_contact_merge(contact, surface, package_scene_contact__2is_same_volume(hit, package_scene_primitive__1runner_up));
            second_wanted = false;
        }
        first = false;
        current = package_scene_primitive__1runner_up;
        continuing {
        
            break if !second_wanted;
        }
    }
    package_scene_loops__1cut_off |= second_wanted;
    return contact;
}

fn package_scene_contact__1media_behind(media: vec4u, contact: package_scene_contact_Contact) -> vec4u {
    var behind = media;
    if (contact.surface.outside && !package_lib_media__1has_room(behind)) {
        package_scene__1ray_stack__1cut_tree();
    }
    behind = package_scene_medium__1cross_surface(behind, contact.surface.material, contact.surface.outside);
    if (package_bindings__1HAS_CONTACT && contact.touching != package_types_NONE) {
        if (contact.enters_touching && !package_lib_media__1has_room(behind)) {
            package_scene__1ray_stack__1cut_tree();
        }
        behind = package_scene_medium__1cross_surface(behind, contact.touching, contact.enters_touching);
    }
    return behind;
}

fn package_scene_contact__1is_near(ray: package_types_Ray, hit: package_types_Hit, surface: package_types_Surface) -> bool {
    let gap = (package_scene_primitive__1runner_up.t - hit.t) * abs(dot(surface.ng, ray.direction));
    let reach = package_lib_numeric__1max_component(abs(surface.p)) + hit.t;
    return package_scene_primitive__1runner_up.primitive != package_types_NONE && gap <= package_scene_contact_NEAR * reach && package_scene_contact__1is_transparent(surface);
}

fn package_scene_contact__1is_transparent(surface: package_types_Surface) -> bool {
    return any(package_scene_fetch__1load_optics(surface.material).transmit > vec3f(0.0));
}

fn package_scene_contact_merge(contact: package_scene_contact_Contact, second: package_types_Surface, is_same_volume: bool) -> package_scene_contact_Contact {
    let is_alike = (second.material == contact.surface.material) & (second.outside == contact.surface.outside);
    let is_other = !(is_alike & is_same_volume);
    let together = is_other & (abs(dot(contact.surface.ng, second.ng)) > 0.99);
    var both = contact;
    if (together && package_scene_contact__1is_transparent(second)) {
        both.touching = second.material;
        both.enters_touching = second.outside;
    }
    else if (together) {
        both.surface = second;
    }
    return both;
}

fn package_scene_contact__2is_same_volume(first: package_types_Hit, second: package_types_Hit) -> bool {
    let are_triangles = package_bindings__1HAS_TRIANGLES && ((first.primitive | second.primitive) & package_types_SHAPE) == 0u;
    if (!are_triangles || first.instance != second.instance) {
        return false;
    }
    return (package_scene_contact__2is_at_edge(first) && package_scene_contact__2is_at_edge(second)) || package_scene_contact__1is_twin(first.primitive, second.primitive);
}

fn package_scene_contact__2is_at_edge(hit: package_types_Hit) -> bool {
    let nearest = min(min(hit.b1, hit.b2), 1.0 - hit.b1 - hit.b2);
    return nearest <= select(package_scene_contact__1VAGUE_EDGE, package_scene_contact_EDGE, package_bindings__1TRIANGLE_TEST == package_types__2TRIANGLE_TEST_WATERTIGHT);
}

fn package_scene_contact__1is_twin(first: u32, second: u32) -> bool {
    let a = package_scene_fetch__1load_triangle(first);
    let b = package_scene_fetch__1load_triangle(second);
    return package_scene_contact__1has_vertex(b, a.i0) && package_scene_contact__1has_vertex(b, a.i1) && package_scene_contact__1has_vertex(b, a.i2);
}

fn package_scene_contact__1has_vertex(triangle: package_types_PackedTriangle, index: u32) -> bool {
    return (triangle.i0 == index) | (triangle.i1 == index) | (triangle.i2 == index);
}

fn package_scene_surface__1surface_at(ray: package_types_Ray, hit: package_types_Hit) -> package_types_Surface {
    var instance: package_types_PackedInstance;
    var space: package_lib_motion_Space;
    var local = ray;
    let is_placed = package_bindings__1HAS_INSTANCES && hit.instance != package_types__1NO_INSTANCE;
    if (is_placed) {
        instance = package_scene_fetch__1load_instance(hit.instance);
        space = package_scene_instance__1space_of(instance);
        local = package_scene_instance__1object_ray(ray, space);
    }
    var surface: package_types_Surface;
    if (package_bindings__1HAS_TRIANGLES && (!(package_bindings__1HAS_SHAPES || package_bindings__1HAS_PLANES) || (hit.primitive & package_types_SHAPE) == 0u)) {
        surface = package_scene_surface__1triangle_surface(ray, hit, space, is_placed);
    }
    if ((package_bindings__1HAS_SHAPES || package_bindings__1HAS_PLANES) && (!package_bindings__1HAS_TRIANGLES || (hit.primitive & package_types_SHAPE) != 0u)) {
        surface = package_scene_surface__1shape_surface(local, hit);
        if (is_placed) {
            surface = package_scene_surface__1placed_surface(ray, surface, space);
        }
    }
    if (is_placed) {
        let q = surface.place;
        surface.error += package_scene_instance__1placement_error(space, surface.p, q);
        surface.id += 2654435761u * instance.id;
        surface.place = package_scene_instance__1pattern_place(instance, q);
        surface.instance = hit.instance;
    }
    return surface;
}

fn package_scene_surface__1placed_surface(ray: package_types_Ray, own: package_types_Surface, space: package_lib_motion_Space) -> package_types_Surface {
    var surface = own;
    surface.p = space.linear * own.p + space.translation;
    surface.ng = package_lib_numeric__1normalize_or(package_scene_instance__1placed_normal(space, own.ng), -ray.direction);
    surface.n = package_lib_numeric__1normalize_or(package_scene_instance__1placed_normal(space, own.n), surface.ng);
    surface.error = package_scene_instance__1abs_times(space.linear, own.error);
    return surface;
}

fn package_scene_surface__1triangle_surface(ray: package_types_Ray, hit: package_types_Hit, space: package_lib_motion_Space, is_placed: bool) -> package_types_Surface {
    let own = package_scene_fetch__1load_triangle(hit.primitive);
    let v0 = package_scene_fetch__1load_vertex(own.i0);
    let v1 = package_scene_fetch__1load_vertex(own.i1);
    let v2 = package_scene_fetch__1load_vertex(own.i2);
    let b1 = hit.b1;
    let b2 = hit.b2;
    let b0 = 1.0 - b1 - b2;
    var corners = mat3x3f(own.v0, own.v1, own.v2);
    var normals = mat3x3f(v0.normal, v1.normal, v2.normal);
    let place = corners * vec3f(b0, b1, b2);
    if (package_bindings__1HAS_INSTANCES && is_placed) {
        corners = space.linear * corners + mat3x3f(space.translation, space.translation, space.translation);
        normals = mat3x3f(package_lib_numeric__1normalize_or(package_scene_instance__1placed_normal(space, v0.normal), -ray.direction), package_lib_numeric__1normalize_or(package_scene_instance__1placed_normal(space, v1.normal), -ray.direction), package_lib_numeric__1normalize_or(package_scene_instance__1placed_normal(space, v2.normal), -ray.direction));
    }
    let material = package_scene_fetch__1load_material(v0.material);
    var phong = material.phong;
    if (package_bindings__1MIXED_MATERIALS) {
        phong = package_scene_surface__1mix_phong(phong, package_scene_fetch__1load_material(v1.material).phong, package_scene_fetch__1load_material(v2.material).phong, b0, b1, b2);
    }
    var uv = vec2f(b1, b2);
    if (package_bindings__1HAS_TEXTURES) {
        uv = vec2f(0.0);
    }
    if (package_bindings__1HAS_TEXTURES && package_bindings__1HAS_UVS) {
        uv = b0 * package_scene_fetch__1load_uv(own.i0) + b1 * package_scene_fetch__1load_uv(own.i1) + b2 * package_scene_fetch__1load_uv(own.i2);
    }
    let ng = package_lib_numeric__1normalize_or(cross(corners[1] - corners[0], corners[2] - corners[0]), -ray.direction);
    let n = package_lib_numeric__1normalize_or(normals * vec3f(b0, b1, b2), ng);
    return package_types_Surface(corners * vec3f(b0, b1, b2), select(n, -n, package_scene_surface__1must_flip(material.flags, dot(n, ng), dot(ng, ray.direction))), ng, package_lib_offset__1triangle_error(corners[0], corners[1], corners[2], b1, b2), hit.primitive, (dot(n, ng) < 0.0) == (dot(ng, ray.direction) > 0.0), uv, v0.material, phong, own.i0 ^ (own.i1 << 10u) ^ (own.i2 << 20u), place, package_types__1NO_INSTANCE);
}

fn package_scene_surface__1shape_surface(ray: package_types_Ray, hit: package_types_Hit) -> package_types_Surface {
    let shape = package_scene_fetch__1load_shape(hit.primitive & ~package_types_SHAPE);
    let reached = ray.origin + hit.t * ray.direction;
    let material = package_scene_fetch__1load_material(shape.material);
    if (package_bindings__1HAS_PLANES && (!package_bindings__1HAS_SHAPES || shape.kind == package_types__1SHAPE_PLANE)) {
        let ng = shape.row_y;
        let p = reached - dot(reached - shape.position, ng) * ng;
        let outside = dot(ng, ray.direction) <= 0.0;
        var plane_uv = vec2f(0.0);
        if (package_bindings__1HAS_TEXTURES) {
            plane_uv = vec2f(dot(shape.row_x, p) + shape.size0, dot(shape.row_z, p) + shape.size1);
        }
        return package_types_Surface(p, select(ng, -ng, package_scene_surface__1must_flip(material.flags, 1.0, dot(ng, ray.direction))), ng, package_lib_offset__1plane_error(p, shape.position), hit.primitive, outside, plane_uv, shape.material, material.phong, shape.id, p, package_types__1NO_INSTANCE);
    }
    if (!package_scene_shape__1is_round(shape.kind)) {
        let point = package_scene_shape__1canonical_point(shape, reached, hit.b1);
        let placed = package_lib_canonical__1placed_point(shape, reached, point);
        let ng = placed.ng;
        return package_types_Surface(placed.p, select(ng, -ng, package_scene_surface__1must_flip(material.flags, 1.0, dot(ng, ray.direction))), ng, placed.error, select(package_types_NONE, hit.primitive, package_scene_shape__1is_flat(shape.kind)), dot(ng, ray.direction) <= 0.0, point.uv, shape.material, material.phong, shape.id, placed.p, package_types__1NO_INSTANCE);
    }
    let placed = package_scene_surface__1sphere_point(shape, reached, ray.direction);
    let ng = placed.ng;
    let outside = dot(ng, ray.direction) <= 0.0;
    var uv = vec2f(0.0);
    if (package_bindings__1HAS_TEXTURES) {
        uv = package_lib_canonical__1sphere_uv(ng);
    }
    return package_types_Surface(placed.p, select(ng, -ng, package_scene_surface__1must_flip(material.flags, 1.0, dot(ng, ray.direction))), ng, placed.error, package_types_NONE, outside, uv, shape.material, material.phong, shape.id, placed.p, package_types__1NO_INSTANCE);
}

fn package_scene_surface__1sphere_point(shape: package_types_PackedShape, reached: vec3f, direction: vec3f) -> package_lib_canonical_PlacedPoint {
    if ((package_bindings__1SHAPE_KINDS & package_scene_shape_GLOBES) != 0u && (package_bindings__1SHAPE_KINDS == package_scene_shape_GLOBES || shape.kind == package_types__1SHAPE_GLOBE)) {
        return package_lib_intersect_globe__1globe_point(shape, reached);
    }
    let ng = package_lib_numeric__1normalize_or(reached - shape.position, -direction);
    return package_lib_canonical_PlacedPoint(shape.position + shape.size0 * ng, ng, package_lib_offset__1sphere_error(shape.position, shape.size0));
}

fn package_scene_surface__1must_flip(flags: u32, n_dot_ng: f32, ng_dot_direction: f32) -> bool {
    let faces_away = (n_dot_ng > 0.0) == (ng_dot_direction > 0.0);
    return (flags & package_types__2MATERIAL_TWO_SIDED) != 0u && faces_away;
}

fn package_scene_surface__1mix_phong(p0: package_types_Phong, p1: package_types_Phong, p2: package_types_Phong, b0: f32, b1: f32, b2: f32) -> package_types_Phong {
    return package_types_Phong(b0 * p0.diffuse + b1 * p1.diffuse + b2 * p2.diffuse, b0 * p0.specular + b1 * p1.specular + b2 * p2.specular, b0 * p0.shininess + b1 * p1.shininess + b2 * p2.shininess, b0 * p0.ambient + b1 * p1.ambient + b2 * p2.ambient, b0 * p0.reflect + b1 * p1.reflect + b2 * p2.reflect);
}

fn package_scene_surface__1leaving_ray(surface: package_types_Surface, direction: vec3f, t_max: f32) -> package_types_Ray {
    if (package_bindings__1FIXED_OFFSET > 0.0) {
        let origin = package_lib_offset__1fixed_origin(surface.p, surface.ng, direction, package_bindings__1FIXED_OFFSET);
        return package_types_Ray(origin, t_max, direction, package_types_NONE, surface.instance);
    }
    let origin = package_lib_offset__1offset_origin(surface.p, surface.error, surface.ng, direction);
    return package_types_Ray(origin, t_max, direction, surface.leaving, surface.instance);
}

fn package_scene_surface__1mirrored_ray(surface: package_types_Surface, direction: vec3f, t_max: f32, arriving: package_types_Ray, distance: f32) -> package_types_Ray {
    if (package_bindings__1FIXED_OFFSET > 0.0) {
        return package_scene_surface__1leaving_ray(surface, direction, t_max);
    }
    let is_flat = surface.leaving != package_types_NONE;
    let origin = package_lib_offset__1mirrored_origin(surface.p, surface.error, surface.ng, arriving, distance, is_flat);
    return package_types_Ray(origin, t_max, direction, surface.leaving, surface.instance);
}

fn package_lib_offset__1triangle_error(v0: vec3f, v1: vec3f, v2: vec3f, b1: f32, b2: f32) -> vec3f {
    let b0 = abs(1.0 - b1 - b2);
    return 16.0 * package_lib_numeric_ROUNDING * (b0 * abs(v0) + abs(b1 * v1) + abs(b2 * v2));
}

fn package_lib_offset__1sphere_error(center: vec3f, radius: f32) -> vec3f {
    return 16.0 * package_lib_numeric_ROUNDING * (abs(center) + vec3f(radius));
}

fn package_lib_offset__1plane_error(p: vec3f, point: vec3f) -> vec3f {
    return 16.0 * package_lib_numeric_ROUNDING * (abs(p) + abs(point));
}

fn package_lib_offset__1placed_error(p: vec3f, position: vec3f, reach: vec3f) -> vec3f {
    return 16.0 * package_lib_numeric_ROUNDING * (abs(p) + abs(position) + reach);
}

fn package_lib_offset_clearance(p: vec3f, error: vec3f, ng: vec3f) -> f32 {
    return dot(abs(ng), error + 2.0 * package_lib_numeric_ROUNDING * abs(p));
}

fn package_lib_offset__1offset_origin(p: vec3f, error: vec3f, ng: vec3f, direction: vec3f) -> vec3f {
    return package_lib_offset__1fixed_origin(p, ng, direction, package_lib_offset_clearance(p, error, ng));
}

fn package_lib_offset__1fixed_origin(p: vec3f, ng: vec3f, direction: vec3f, distance: f32) -> vec3f {
    return p + select(-distance, distance, dot(ng, direction) > 0.0) * ng;
}

fn package_lib_offset__1mirrored_origin(p: vec3f, error: vec3f, ng: vec3f, arriving: package_types_Ray, distance: f32, is_flat: bool) -> vec3f {
    let height = package_lib_offset_clearance(p, error, ng);
    let slope = dot(ng, arriving.direction);
    let back = height / max(abs(slope), 1e-6);
    let along_normal = p - select(-height, height, slope > 0.0) * ng;
    let at_most = select(along_normal, arriving.origin, is_flat);
    return select(p - back * arriving.direction, at_most, back > 0.5 * distance);
}

fn package_scene_texture__1textured_phong(phong: package_types_Phong, material: u32, p: vec3f, uv: vec2f) -> package_types_Phong {
    let indices = package_scene_fetch__2load_texture_indices(material);
    let factors = package_scene_texture__1texture_factors(vec3u(indices.x & 65535u, indices.x >> 16u, indices.z & 65535u), p, uv);
    return package_types_Phong(factors[0] * phong.diffuse, factors[1] * phong.specular, phong.shininess, factors[2] * phong.ambient, phong.reflect);
}

fn package_scene_texture__1texture_optics(surface: package_types_Surface) -> mat3x3f {
    if (!package_bindings__1HAS_TEXTURES) {
        return mat3x3f(vec3f(1.0), vec3f(1.0), vec3f(1.0));
    }
    let indices = package_scene_fetch__2load_texture_indices(surface.material);
    return package_scene_texture__1texture_factors(vec3u(indices.y & 65535u, indices.y >> 16u, indices.z >> 16u), surface.place, surface.uv);
}

fn package_scene_texture__1texture_factors(wanted: vec3u, p: vec3f, uv: vec2f) -> mat3x3f {
    var factors = mat3x3f(vec3f(1.0), vec3f(1.0), vec3f(1.0));
    var open = wanted != vec3u(package_types__1NO_TEXTURE);
    loop {
        let index = select(select(select(0u, wanted.z, open.z), wanted.y, open.y), wanted.x, open.x);
        let color = package_scene_texture__1texture_color(package_scene_fetch__1load_texture(index), p, uv);
        let found = open & (wanted == vec3u(index));
        factors[0] = select(factors[0], color, found.x);
        factors[1] = select(factors[1], color, found.y);
        factors[2] = select(factors[2], color, found.z);
        open = open & !found;
        continuing {
        
            break if !any(open);
        }
    }
    package_scene_loops__1cut_off |= any(open);
    return factors;
}

fn package_scene_texture__1texture_color(texture: package_types_PackedTexture, p: vec3f, uv: vec2f) -> vec3f {
    let at = select(vec4f(p, 1.0), vec4f(uv, 0.0, 1.0), (texture.flags & package_types__1TEXTURE_UV) != 0u);
    let q = clamp(vec3f(dot(texture.row_x, at), dot(texture.row_y, at), dot(texture.row_z, at)), vec3f(-100000000.0), vec3f(100000000.0));
    if (texture.kind == package_types__1PATTERN_PICTURE) {
        let nearest = (texture.flags & package_types__1TEXTURE_NEAREST) != 0u;
        return package_scene_picture__1blend_texels(texture.first_texel, texture.width, texture.height, package_lib_picture_repeated(q.x, texture.width, nearest), package_lib_picture_repeated(q.y, texture.height, nearest));
    }
    var weight = package_lib_pattern_checker(q);
    if (texture.kind == package_types__1PATTERN_NOISE) {
        let octaves = package_lib_noise__1noise_octaves(q, texture.octaves);
        package_scene_loops__1cut_off |= octaves.count < texture.octaves;
        weight = package_lib_pattern_clouds(octaves.sum);
    }
    weight = select(weight, package_lib_pattern_stripes(q), texture.kind == package_types__1PATTERN_STRIPES);
    weight = select(weight, package_lib_pattern_gradient(q), texture.kind == package_types__1PATTERN_GRADIENT);
    return mix(texture.color_a, texture.color_b, weight);
}

const package_lib_pattern__1CELL_SHIFT: f32 = 0.00073;

fn package_lib_pattern_checker(p: vec3f) -> f32 {
    let cell = vec3i(floor(p + package_lib_pattern__1CELL_SHIFT));
    return f32((cell.x + cell.y + cell.z) & 1);
}

fn package_lib_pattern_stripes(p: vec3f) -> f32 {
    return f32(i32(floor(2.0 * (p.x + package_lib_pattern__1CELL_SHIFT))) & 1);
}

fn package_lib_pattern_gradient(p: vec3f) -> f32 {
    return clamp(p.x, 0.0, 1.0);
}

fn package_lib_pattern_clouds(sum: f32) -> f32 {
    return clamp(0.5 + 0.5 * sum, 0.0, 1.0);
}

const package_lib_noise__1NOISE_PERIOD: u32 = 256u;

const package_lib_noise__1OCTAVE_SHIFT = vec3f(0.37, 0.59, 0.83);

struct package_lib_noise_Octaves {
    sum: f32,
    count: u32
}

fn package_lib_noise__1noise_octaves(p: vec3f, count: u32) -> package_lib_noise_Octaves {
    let period = f32(package_lib_noise__1NOISE_PERIOD);
    let home = p - period * floor(p / period);
    var octaves = package_lib_noise_Octaves(0.0, 0u);
    var scale = 1.0;
    loop {
        let q = scale * home + f32(octaves.count) * package_lib_noise__1OCTAVE_SHIFT;
        octaves.sum += package_lib_noise__1gradient_noise(q, package_lib_noise__1NOISE_PERIOD << octaves.count) / scale;
        scale *= 2.0;
        octaves.count += 1u;
        continuing {
        
            break if octaves.count >= count;
        }
    }
    return octaves;
}

fn package_lib_noise__1gradient_noise(p: vec3f, period: u32) -> f32 {
    let cell = floor(p);
    let f = p - cell;
    let low = vec3u(vec3i(cell)) & vec3u(period - 1u);
    let high = (low + 1u) & vec3u(period - 1u);
    let z0 = package_lib_rng_hash(low.z);
    let z1 = package_lib_rng_hash(high.z);
    let y00 = package_lib_rng_hash(low.y + z0);
    let y10 = package_lib_rng_hash(high.y + z0);
    let y01 = package_lib_rng_hash(low.y + z1);
    let y11 = package_lib_rng_hash(high.y + z1);
    let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let x = vec4f(mix(package_lib_noise_corner(low.x + y00, f), package_lib_noise_corner(high.x + y00, f - vec3f(1.0, 0.0, 0.0)), t.x), mix(package_lib_noise_corner(low.x + y10, f - vec3f(0.0, 1.0, 0.0)), package_lib_noise_corner(high.x + y10, f - vec3f(1.0, 1.0, 0.0)), t.x), mix(package_lib_noise_corner(low.x + y01, f - vec3f(0.0, 0.0, 1.0)), package_lib_noise_corner(high.x + y01, f - vec3f(1.0, 0.0, 1.0)), t.x), mix(package_lib_noise_corner(low.x + y11, f - vec3f(0.0, 1.0, 1.0)), package_lib_noise_corner(high.x + y11, f - vec3f(1.0, 1.0, 1.0)), t.x));
    let y = mix(x.xz, x.yw, t.y);
    return mix(y.x, y.y, t.z);
}

fn package_lib_noise_corner(key: u32, d: vec3f) -> f32 {
    let h = package_lib_rng_hash(key) & 15u;
    let u = select(d.y, d.x, h < 8u);
    let v = select(select(d.z, d.x, (h == 12u) | (h == 14u)), d.y, h < 4u);
    return select(u, -u, (h & 1u) != 0u) + select(v, -v, (h & 2u) != 0u);
}

fn package_lib_media__1has_room(media: vec4u) -> bool {
    return media.w == package_types_NONE;
}

fn package_lib_media_contains(media: vec4u, material: u32) -> bool {
    return any(media == vec4u(material));
}

fn package_lib_media_entered(media: vec4u, material: u32) -> vec4u {
    let is_free = media == vec4u(package_types_NONE);
    let is_first_free = is_free & !vec4<bool>(false, is_free.xyz);
    return select(media, vec4u(material), is_first_free);
}

fn package_lib_media_left(media: vec4u, material: u32) -> vec4u {
    let is_it = media == vec4u(material);
    let later = vec4<bool>(is_it.y | is_it.z | is_it.w, is_it.z | is_it.w, is_it.w, false);
    let is_last = is_it & !later;
    let x = is_last.x;
    let y = x | is_last.y;
    let z = y | is_last.z;
    let w = z | is_last.w;
    return select(media, vec4u(media.yzw, package_types_NONE), vec4<bool>(x, y, z, w));
}

struct package_lib_fresnel_Boundary {
    reflectance: f32,
    cos_t: f32,
    total: bool
}

fn package_lib_fresnel_ratio(a: f32, b: f32) -> f32 {
    return a / max(b, 1e-12);
}

fn package_lib_fresnel_fresnel(cos_i: f32, eta: f32) -> package_lib_fresnel_Boundary {
    let sin2_t = eta * eta * max(1.0 - cos_i * cos_i, 0.0);
    let total = (sin2_t >= 1.0) & (eta > 1.0);
    let cos_t = sqrt(max(1.0 - sin2_t, 0.0));
    let r_s = package_lib_fresnel_ratio(eta * cos_i - cos_t, eta * cos_i + cos_t);
    let r_p = package_lib_fresnel_ratio(cos_i - eta * cos_t, cos_i + eta * cos_t);
    return package_lib_fresnel_Boundary(select(0.5 * (r_s * r_s + r_p * r_p), 1.0, total), cos_t, total);
}

fn package_lib_fresnel_schlick(cos_i: f32, eta: f32) -> package_lib_fresnel_Boundary {
    let exact = package_lib_fresnel_fresnel(cos_i, eta);
    let r0 = package_lib_fresnel_ratio((eta - 1.0) * (eta - 1.0), (eta + 1.0) * (eta + 1.0));
    let x = 1.0 - select(cos_i, exact.cos_t, eta > 1.0);
    let x2 = x * x;
    return package_lib_fresnel_Boundary(select(r0 + (1.0 - r0) * x2 * x2 * x, 1.0, exact.total), exact.cos_t, exact.total);
}

fn package_lib_fresnel_mirrored(direction: vec3f, n: vec3f) -> vec3f {
    return normalize(direction - 2.0 * dot(direction, n) * n);
}

fn package_lib_fresnel_refracted(direction: vec3f, n: vec3f, eta: f32, cos_t: f32) -> vec3f {
    let cos_i = -dot(direction, n);
    return normalize(eta * direction + (eta * cos_i - cos_t) * n);
}

fn package_lib_light__1spot_falloff(cos_angle: f32, cos_inner: f32, cos_outer: f32) -> f32 {
    let x = clamp((cos_angle - cos_outer) / max(cos_inner - cos_outer, 1e-6), 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

fn package_lib_light_incident(light: package_types_PackedLight, p: vec3f) -> package_types_Incident {
    let to_light = light.position - p;
    let distance = length(to_light);
    let is_directional = light.kind == package_types__1LIGHT_DIRECTIONAL;
    let direction = select(package_lib_numeric__1normalize_or(to_light, -light.direction), -light.direction, is_directional);
    var strength = select(0.0, 1.0, is_directional || distance > 1e-30);
    if (light.attenuation == package_types__2ATTENUATION_INVERSE_SQUARE) {
        strength /= max(distance * distance, 1e-30);
    }
    if (light.kind == package_types__1LIGHT_SPOT) {
        strength *= package_lib_light__1spot_falloff(-dot(direction, light.direction), light.cos_inner, light.cos_outer);
    }
    return package_types_Incident(direction, select(distance, package_lib_camera__1T_FAR, is_directional), strength * light.color);
}

fn package_lib__1area_light__1area_incident(light: package_types_PackedLight, p: vec3f, u: vec2f) -> package_types_Incident {
    if (light.kind == package_types__1LIGHT_SPHERE) {
        return package_lib__1area_light__1sphere_incident(light, p, u);
    }
    return package_lib__1area_light__1flat_incident(light, p, u);
}

fn package_lib__1area_light__1flat_incident(light: package_types_PackedLight, p: vec3f, u: vec2f) -> package_types_Incident {
    let within = select(package_lib_warp__2disc_from_square(u), 2.0 * u - 1.0, light.kind == package_types__1LIGHT_RECTANGLE);
    let center = light.position - p;
    let to_light = center + within.x * light.edge_u + within.y * light.edge_v;
    let distance = length(to_light);
    let direction = package_lib_numeric__1normalize_or(to_light, -light.direction);
    let cos_light = -dot(direction, light.direction);
    let fading = max(cos_light, 0.0) / max(distance * distance, 1e-30);
    let strength = select(1.0, fading, light.attenuation == package_types__2ATTENUATION_INVERSE_SQUARE);
    let reach = package_lib__1area_light__1max_abs(light.position) + package_lib__1area_light__1max_abs(p) + package_lib__1area_light__1max_abs(light.edge_u) + package_lib__1area_light__1max_abs(light.edge_v);
    let usable = distance > 1e-30;
    return package_types_Incident(direction, package_lib__1area_light__1short_of(distance, reach, abs(cos_light)), select(0.0, strength, usable) * light.color);
}

fn package_lib__1area_light__1sphere_incident(light: package_types_PackedLight, p: vec3f, u: vec2f) -> package_types_Incident {
    let to_center = light.position - p;
    let d2 = dot(to_center, to_center);
    let radius2 = light.radius * light.radius;
    let is_inside = d2 <= radius2;
    let d = sqrt(d2);
    let sin2 = radius2 / max(max(d2, radius2), 1e-30);
    let depth = select(sin2 / (1.0 + sqrt(max(1.0 - sin2, 0.0))), 2.0, is_inside);
    let about = package_lib_warp__2cone_from_square(u, depth);
    let axis = package_lib_numeric__1normalize_or(to_center, vec3f(0.0, 0.0, 1.0));
    let direction = package_lib_numeric__1normalize_or(package_lib_warp__1turn_to(axis, about), axis);
    let chord = sqrt(max(radius2 - d2 * dot(about.xy, about.xy), 0.0));
    let distance = d * about.z + select(-chord, chord, is_inside);
    let outside = 2.0 / ((1.0 + sqrt(max(1.0 - sin2, 0.0))) * max(d2, 1e-30));
    let fading = select(outside, 4.0 / max(radius2, 1e-30), is_inside);
    let strength = select(1.0, fading, light.attenuation == package_types__2ATTENUATION_INVERSE_SQUARE);
    let reach = package_lib__1area_light__1max_abs(light.position) + package_lib__1area_light__1max_abs(p) + light.radius;
    return package_types_Incident(direction, package_lib__1area_light__1short_of(distance, reach, chord / max(light.radius, 1e-30)), strength * light.color);
}

fn package_lib__1area_light__1short_of(distance: f32, reach: f32, cosine: f32) -> f32 {
    let slack = 32.0 * package_lib_numeric_ROUNDING * reach / max(cosine, 0.001);
    return max(distance - min(slack, 0.01 * distance), 0.0);
}

fn package_lib__1area_light__1max_abs(v: vec3f) -> f32 {
    return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

fn package_lib_phong__1shininess_power(x: f32, shininess: f32) -> f32 {
    let power = exp2(shininess * log2(max(x, 1e-30)));
    return select(select(0.0, 1.0, shininess <= 0.0), power, x > 0.0);
}

fn package_lib_phong_phong(coefficients: package_types_Phong, n: vec3f, l: vec3f, v: vec3f) -> vec3f {
    let cos_l = dot(l, n);
    let r = 2.0 * cos_l * n - l;
    let highlight = package_lib_phong__1shininess_power(max(dot(r, v), 0.0), coefficients.shininess);
    let lit = coefficients.diffuse * max(cos_l, 0.0) + coefficients.specular * highlight;
    return select(vec3f(0.0), lit, cos_l > 0.0);
}

const package_scene_shadow__1MAX_CROSSINGS: u32 = 64u;

fn package_scene_shadow__1light_through(rays: package_scene_rays_Rays, media: package_scene__1ray_stack_Media) -> package_scene_wide_Vectors {
    var through: package_scene_wide_Vectors;
    if (package_bindings__1HAS_REFRACTION && package_bindings__1FILTERED_SHADOWS) {
        through = package_scene_shadow_filtered(rays, media);
    }
    else {
        let hits = package_scene_rays__1any_hits(rays);
        let passed = select(package_scene_wide_Floats(0.0), package_scene_wide_Floats(1.0), hits.primitive == package_scene_wide_Words(package_types_NONE));
        through = package_scene_wide_Vectors(passed, passed, passed);
    }
    if (package_bindings__1COUNT_RAYS) {
        package_scene_shadow__1count_shadows(rays, through);
    }
    return through;
}

fn package_scene_shadow__1count_shadows(rays: package_scene_rays_Rays, through: package_scene_wide_Vectors) {
    var k = 0u;
    loop {
        let is_cast = package_scene_wide__1float_at(rays.t_max, k) >= 0.0;
        let is_blocked = is_cast & all(package_scene_wide__1vector_at(through, k) == vec3f(0.0));
        package_scene_dispatch_counts.shadow += select(0u, 1u, is_cast);
        package_scene_dispatch_counts.shadow_blocked += select(0u, 1u, is_blocked);
        continuing {
            k += 1u;
            break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
        }
    }
    package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
}

fn package_scene_shadow_filtered(shadow_rays: package_scene_rays_Rays, start: package_scene__1ray_stack_Media) -> package_scene_wide_Vectors {
    var rays = shadow_rays;
    var media = start;
    var transmitted = package_scene_wide_Vectors(package_scene_wide_Floats(1.0), package_scene_wide_Floats(1.0), package_scene_wide_Floats(1.0));
    var crossings = 0u;
    var is_unfinished = true;
    loop {
        let hits = package_scene_rays__1closest_hits(rays);
        is_unfinished = false;
        var k = 0u;
        loop {
            let ray = package_scene_rays__1ray_at(rays, k);
            if (ray.t_max >= 0.0) {
                let hit = package_scene_rays__1hit_at(hits, k);
                var passed = package_scene_wide__1vector_at(transmitted, k);
                var next = package_scene_rays_DEAD;
                if (hit.primitive == package_types_NONE) {
                    passed *= package_scene_medium_transmittance(package_scene_medium__1medium_of(package_scene_medium_dominant(package_scene__1ray_stack__1media_at(media, k))), hit.t);
                }
                else {
                    package_scene__1ray_stack__1current_tree = k;
                    let contact = package_scene_contact__1contact_at(ray, hit);
                    let surface = contact.surface;
                    let optics = package_scene_fetch__1load_optics(surface.material);
                    let around = package_scene__1ray_stack__1media_at(media, k);
                    let here = package_scene_medium__1medium_before(around, surface.material, surface.outside);
                    let beyond = package_scene_contact__1media_behind(around, contact);
                    media = package_scene__1ray_stack__1media_set(media, k, beyond);
                    let behind = package_scene_medium_dominant(beyond);
                    var through = package_scene_texture__1texture_optics(surface)[1] * optics.transmit * package_scene_medium_transmittance(package_scene_medium__1medium_of(here), hit.t);
                    if ((optics.flags & package_types__1MATERIAL_FRESNEL) != 0u) {
                        let cos_i = min(abs(dot(surface.n, ray.direction)), 1.0);
                        let eta = package_scene_medium__1medium_of(here).ior / package_scene_medium__1medium_of(behind).ior;
                        through *= 1.0 - package_lib_fresnel_fresnel(cos_i, min(eta, 1.0 / eta)).reflectance;
                    }
                    passed *= through;
                    let rest = ray.t_max - hit.t;
                    if (any(passed > vec3f(0.0)) & (rest > 0.0)) {
                        next = package_scene_surface__1leaving_ray(surface, ray.direction, rest);
                        is_unfinished = true;
                        passed = select(passed, vec3f(0.0), crossings + 1u >= package_scene_shadow__1MAX_CROSSINGS);
                    }
                }
                transmitted = package_scene_wide__1vector_set(transmitted, k, passed);
                rays = package_scene_rays__1ray_set(rays, k, next);
            }
            continuing {
                k += 1u;
                break if package_scene_wide__1ONE_RAY | (k >= package_scene_wide__2RAYS_PER_LANE);
            }
        }
        package_scene_loops__1cut_off |= k < package_scene_wide__2RAYS_PER_LANE;
        crossings += 1u;
        continuing {
        
            break if !package_scene_rays__1any_lane(is_unfinished) | (crossings >= package_scene_shadow__1MAX_CROSSINGS);
        }
    }
    package_scene_loops__1cut_off |= is_unfinished & (crossings < package_scene_shadow__1MAX_CROSSINGS);
    return transmitted;
}

struct package_scene_film_Sample {
    radiance: vec3f
}

struct package_scene_film_Sum {
    radiance: vec4f,
    squares: f32
}

fn package_scene_film__1load_sum(work: package_scene_dispatch_Work) -> package_scene_film_Sum {
    let row = package_bindings__1FILM_ROWS * work.film_index;
    var sum = package_scene_film_Sum(package_bindings_film[row], 0.0);
    if (package_bindings_ADAPTIVE) {
        sum.squares = package_bindings_film[row + package_bindings__1SQUARES_ROW].x;
    }
    return sum;
}

fn package_scene_film__1store_sum(work: package_scene_dispatch_Work, sum: package_scene_film_Sum) {
    let row = package_bindings__1FILM_ROWS * work.film_index;
    package_bindings_film[row] = sum.radiance;
    if (package_bindings_ADAPTIVE) {
        package_bindings_film[row + package_bindings__1SQUARES_ROW].x = sum.squares;
    }
}

fn package_scene_film__1add_sample(sum: package_scene_film_Sum, sample: package_scene_film_Sample, weight: f32) -> package_scene_film_Sum {
    let luminance = dot(sample.radiance, package_lib_tone__1LUMINANCE_REC709);
    var next = sum;
    next.radiance += weight * vec4f(sample.radiance, 1.0);
    next.squares += luminance * luminance;
    if (!package_lib_numeric__1is_finite(next.radiance.xyz) || (package_bindings_ADAPTIVE && !package_lib_numeric__1is_finite(vec3f(next.squares)))) {
        atomicAdd(&package_bindings_dispatch.counters.nonfinite_samples, 1u);
        return sum;
    }
    return next;
}

const package_lib_tone__1LUMINANCE_REC709: vec3f = vec3f(0.2126, 0.7152, 0.0722);
