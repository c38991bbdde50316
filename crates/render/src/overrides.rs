//! The overrides of `bindings.wesl`: properties of the scene, the frame and the settings that are compiled into
//! a kernel.

use super::{
    Integrator, effort, layers,
    policy::Stack,
    settings::{BsdfModel, RayOffset, RenderSettings, TriangleTest},
    task::Task,
};
use crate::{
    gpu::Overrides,
    layout::{
        BACKDROP_BACKGROUND, BACKDROP_COLOR, BACKDROP_TRANSPARENT, FILTER_BLACKMAN_HARRIS,
        FILTER_BOX, FILTER_GAUSSIAN, FILTER_MITCHELL, FILTER_TENT, MIXED_LIGHTS, PackedLight,
        PackedTone, SHORT_STACK_SIZE, TRIANGLE_TEST_MOLLER_TRUMBORE, TRIANGLE_TEST_PLANE,
        TRIANGLE_TEST_WATERTIGHT,
    },
    pack::{Apart, PackedScene, PackedView},
};
use glimray_scene::{Antialias, Backdrop, Filter};

/// Whether there are more shapes than triangles in BVHs.
pub fn has_mostly_shapes(scene: &PackedScene) -> bool {
    match scene.features.apart {
        Apart::Triangles => true,
        Apart::Shapes => false,
        Apart::Nothing => scene.bounded_shape_count() as usize > scene.triangles.len(),
    }
}

/// Features that the scene, the frame and the settings need; all others are compiled out.
pub fn of(task: Task) -> Overrides {
    let Task {
        scene,
        view,
        settings,
        policy,
        ..
    } = task;
    let integrator = settings.integrator.entry();
    let triangle_test = match settings.triangle_test {
        TriangleTest::Plane => TRIANGLE_TEST_PLANE,
        TriangleTest::MollerTrumbore => TRIANGLE_TEST_MOLLER_TRUMBORE,
        TriangleTest::Watertight => TRIANGLE_TEST_WATERTIGHT,
    };
    let fixed_offset = match settings.offset {
        RayOffset::Bound => 0.0,
        RayOffset::Fixed(distance) => distance,
    };
    let filter = match settings.filter {
        Filter::Box => FILTER_BOX,
        Filter::Tent => FILTER_TENT,
        Filter::Gaussian => FILTER_GAUSSIAN,
        Filter::BlackmanHarris => FILTER_BLACKMAN_HARRIS,
        Filter::Mitchell => FILTER_MITCHELL,
    };
    let features = scene.features;
    let is_path = settings.integrator == Integrator::Path;
    let filters_shadows = match is_path {
        true => features.thin_walls || settings.transparent_shadows,
        false => features.filtered_shadows,
    };
    let layers = layers::of_sampling(settings);
    let opacity_row = layers::row_of(layers, &layers::OPACITY).unwrap_or_default();
    let mut cameras = view.cameras.iter().chain([&view.frame.camera]);
    let mut overrides = vec![
        ("TRIANGLE_TEST", f64::from(triangle_test)),
        ("MIXED_MATERIALS", flag(scene.features.mixed_materials)),
        ("BRUTE_FORCE", flag(settings.brute_force)),
        ("FIXED_OFFSET", f64::from(fixed_offset)),
        ("STRATIFIED", flag(settings.antialias != Antialias::None)),
        ("COUNT_RAYS", flag(policy.count_rays)),
        ("COUNT_STEPS", flag(integrator.counts_steps)),
        (
            "HAS_REFLECTION",
            flag(features.reflection && settings.max_depth > 0),
        ),
        (
            "HAS_REFRACTION",
            flag(features.refraction && settings.max_depth > 0),
        ),
        (
            "HAS_CONTACT",
            flag(features.contact && settings.max_depth > 0),
        ),
        ("HAS_PRIORITIES", flag(features.priorities)),
        ("FILTERED_SHADOWS", flag(filters_shadows)),
        (
            "SOLID_GLASS",
            flag(is_path && !settings.transparent_shadows),
        ),
        (
            "HAS_LENS",
            flag(cameras.any(|camera| camera.lens_radius > 0.0)),
        ),
        ("HAS_CLIP", flag(view.frame.clip != [0.0; 2])),
        ("FILTER", f64::from(filter)),
        ("FILTER_RADIUS", f64::from(settings.filter_radius)),
        (
            "HAS_TEXTURES",
            flag(features.textures || integrator.needs_uvs),
        ),
        ("HAS_NOISE", flag(features.noise)),
        ("HAS_PICTURES", flag(features.pictures)),
        ("HAS_FOOTPRINTS", flag(features.footprints)),
        ("HAS_COVERAGE", flag(features.coverage)),
        ("HAS_TREES", flag(effort::has_trees(scene, settings))),
        ("HAS_NORMAL_MAPS", flag(features.normal_maps)),
        ("HAS_COAT_NORMALS", flag(is_path && features.coat_normals)),
        ("HAS_OCCLUSION", flag(features.occlusion_maps)),
        ("HAS_BYTE_TEXELS", flag(features.byte_texels)),
        ("HAS_HALF_TEXELS", flag(features.half_texels)),
        ("HAS_OPTICS_TEXTURES", flag(features.optics_textures)),
        ("HAS_EMISSION", flag(features.emission)),
        ("HAS_LAYERS", flag(is_path)),
        (
            "CLAMP_INDIRECT",
            f64::from(settings.clamp_indirect.unwrap_or_default()),
        ),
        ("HAS_GLOSS", flag(features.gloss)),
        (
            "HAS_METALLIC_ROUGHNESS",
            flag(is_path && features.metallic_roughness),
        ),
        ("HAS_COATINGS", flag(is_path && features.coatings)),
        (
            "HAS_COATED_EMISSION",
            flag(is_path && features.coated_emission),
        ),
        ("HAS_ROUGH_GLASS", flag(is_path && features.rough_glass)),
        ("HAS_DISPERSION", flag(is_path && features.dispersion)),
        (
            "BSDF_SPEC",
            flag(is_path && settings.bsdf == BsdfModel::Spec),
        ),
        ("HAS_LIGHT_TREE", flag(is_path && view.has_light_tree())),
        ("HAS_EMITTERS", flag(is_path && !view.emitters.is_empty())),
        (
            "HAS_EMISSIVE_SHAPES",
            flag(is_path && view.has_emissive_shapes()),
        ),
        (
            "HAS_EMITTER_GLOWS",
            flag(is_path && !view.emitter_glows.is_empty()),
        ),
        (
            "HAS_ENVIRONMENT",
            flag(is_path && view.frame.environment_share > 0.0),
        ),
        ("ADAPTIVE", flag(settings.is_adaptive())),
        ("CAMERA_MOTION", flag(!view.cameras.is_empty())),
        ("LIGHT_MOTION", flag(view.frame.light_key_count > 1)),
        ("ORTHOGRAPHIC", flag(view.orthographic)),
        ("HAS_SECOND_UVS", flag(features.second_uvs)),
        ("HAS_COLORS", flag(!scene.colors.is_empty())),
        ("HAS_TANGENTS", flag(!scene.tangents.is_empty())),
        ("HAS_ANISOTROPY", flag(is_path && features.anisotropy)),
        ("HAS_UVS", flag(!scene.uvs.is_empty())),
        ("HAS_FEATURES", flag(settings.has_features())),
        ("HAS_OPACITY", flag(settings.has_opacity())),
        ("OPACITY_ROW", opacity_row as f64),
        (
            "HAS_CATCHERS",
            flag(settings.has_opacity() && features.shadow_catchers),
        ),
        (
            "BACKDROP",
            f64::from(match settings.backdrop {
                Backdrop::Background => BACKDROP_BACKGROUND,
                Backdrop::Color(_) => BACKDROP_COLOR,
                Backdrop::Transparent => BACKDROP_TRANSPARENT,
            }),
        ),
    ];
    overrides.extend(rows_of_film(settings));
    overrides.extend(geometry(scene, view, policy.stack));
    match integrator.is_lit {
        true => overrides.extend([
            ("HAS_LIGHTS", flag(view.has_lights)),
            ("HAS_AREA_LIGHTS", flag(view.has_area_lights)),
            ("LIGHT_KIND", f64::from(common(view, |light| light.kind))),
            (
                "LIGHT_ATTENUATION",
                f64::from(common(view, |light| light.attenuation)),
            ),
            ("BACKGROUND", f64::from(view.background)),
        ]),
        false => overrides.push(("VIEW", f64::from(integrator.view))),
    }
    overrides
}

/// The overrides of a ray query.
pub fn of_query(
    scene: &PackedScene,
    view: &PackedView,
    is_any: bool,
    counts_steps: bool,
    stack: Stack,
) -> Overrides {
    let mut overrides = vec![
        ("TRIANGLE_TEST", f64::from(TRIANGLE_TEST_WATERTIGHT)),
        ("HAS_CONTACT", flag(false)),
        ("ANY_HIT", flag(is_any)),
        ("COUNT_STEPS", flag(counts_steps)),
    ];
    overrides.extend(geometry(scene, view, stack));
    overrides
}

/// The overrides of the kernels that develop a film.
pub fn of_tone(tone: &PackedTone) -> Overrides {
    vec![
        ("TONE_CURVE", f64::from(tone.curve)),
        ("TONE_TRANSFER", f64::from(tone.transfer)),
        ("VIEW", f64::from(tone.view)),
    ]
}

/// The overrides of the kernel that develops a film, or its denoised picture, for display.
pub fn of_screen(tone: &PackedTone, is_denoised: bool) -> Overrides {
    let mut overrides = of_tone(tone);
    overrides.push(("SHOWS_DENOISED", flag(is_denoised)));
    overrides
}

/// The overrides of the kernel that reads features from a film.
pub fn of_features(settings: &RenderSettings) -> Overrides {
    rows_of_film(settings).into()
}

/// The overrides of the first step of the denoiser.
pub fn of_demodulation(has_opacity: bool) -> Overrides {
    vec![("HAS_OPACITY", flag(has_opacity))]
}

/// The overrides of a pass of the denoiser's filter.
pub fn of_filter(is_first: bool, modulates: bool, has_opacity: bool) -> Overrides {
    vec![
        ("HAS_OPACITY", flag(has_opacity)),
        ("FIRST_PASS", flag(is_first)),
        ("MODULATES", flag(modulates)),
    ]
}

/// The overrides for the rows of a pixel.
fn rows_of_film(settings: &RenderSettings) -> [(&'static str, f64); 3] {
    let layers = layers::of_sampling(settings);
    let row_of = |layer| layers::row_of(layers, layer).unwrap_or_default() as f64;
    [
        ("FILM_ROWS", layers::rows(layers) as f64),
        ("SQUARES_ROW", row_of(&layers::SQUARES)),
        ("FEATURES_ROW", row_of(&layers::ALBEDO)),
    ]
}

/// The overrides for the contents of the trees.
fn geometry(scene: &PackedScene, view: &PackedView, stack: Stack) -> [(&'static str, f64); 12] {
    let features = scene.features;
    let triangles_apart = match features.apart {
        Apart::Triangles => scene.triangles.len(),
        _ => 0,
    };
    [
        ("HAS_TRIANGLES", flag(!scene.triangles.is_empty())),
        ("TRIANGLES_APART", triangles_apart as f64),
        ("SHAPES_APART", flag(features.apart == Apart::Shapes)),
        ("HAS_SHAPES", flag(scene.bounded_shape_count() > 0)),
        ("HAS_PLANES", flag(scene.plane_count > 0)),
        ("MOSTLY_SHAPES", flag(has_mostly_shapes(scene))),
        ("SHAPE_KINDS", f64::from(features.shape_kinds)),
        ("HAS_INSTANCES", flag(features.instances)),
        (
            "STACK_REGISTERS",
            f64::from(stack_registers(scene, view, stack)),
        ),
        ("SHORT_STACK", flag(has_short_stack(scene, view))),
        ("HAS_MOTION", flag(view.has_moving_instances())),
        ("HAS_DEFORMATION", flag(view.deforms())),
    ]
}

/// The registers, of four entries each, that hold the stack of the portable walk on software adapters; 0 if so many are
/// slower than an array. Trees over instances differ between frames, and one kernel is for all of them.
fn stack_registers(scene: &PackedScene, view: &PackedView, stack: Stack) -> u32 {
    const MOST: usize = 8;
    /// A bound above which rays seldom need more than half of it, and registers that are enough for most scenes below.
    const DEEP: usize = 40;
    const FEW: usize = 5;
    let bound = scene.stack_entries(view);
    let all = match scene.features.instances {
        true => bound.div_ceil(4).max(MOST),
        false => bound.div_ceil(4).max(1),
    };
    let usual = match scene.features.instances || bound > DEEP {
        true => FEW + 1,
        // Rays miss most boxes, the more of them the deeper the tree: they need two thirds of a bound of 12 at most, and half
        // of one of 30.
        false => (bound.div_ceil(6))
            .min((bound + 8).div_ceil(10))
            .clamp(1, FEW),
    };
    match stack {
        Stack::Usual => usual.min(all) as u32,
        Stack::Deepest if all > MOST => 0,
        Stack::Deepest => all as u32,
    }
}

/// Whether the smaller array of `scene/stack.wesl` is enough. Trees over instances differ between frames, as above.
fn has_short_stack(scene: &PackedScene, view: &PackedView) -> bool {
    !scene.features.instances && scene.stack_entries(view) <= SHORT_STACK_SIZE as usize
}

/// The value that all lights have in common.
fn common(view: &PackedView, of: fn(&PackedLight) -> u32) -> u32 {
    let mut all = view.lights.iter().map(of);
    let first = all.next().unwrap_or(MIXED_LIGHTS);
    match all.all(|other| other == first) {
        true => first,
        false => MIXED_LIGHTS,
    }
}

fn flag(on: bool) -> f64 {
    f64::from(u8::from(on))
}
