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
    pack::{OutsideTree, PackedScene, PackedView},
};
use glimray_scene::{Antialias, Backdrop, Filter};

/// Declares overrides, a row for each: its name, its WGSL type and its value. Functions return those that are set together;
/// one that is set alone has a function of its name. A test writes the declarations to `bindings.wesl`, where all are off:
/// `false` or 0.
macro_rules! overrides {
    (
        $(
            $(#[$note:meta])*
            fn $function:ident($($parameter:ident: $parameter_type:ty),*) { $($prelude:tt)* }
            gives { $($name:ident: $type:ident = $value:expr;)* }
        )*
        alone { $($other:ident: $other_type:ident;)* }
    ) => {
        /// The overrides that the renderer sets, and their WGSL types.
        #[doc(hidden)]
        pub const KERNEL_OVERRIDES: &[(&str, &str)] = &[
            $($((stringify!($name), stringify!($type)),)*)*
            $((stringify!($other), stringify!($other_type)),)*
        ];
        $(
            $(#[$note])*
            pub fn $function($($parameter: $parameter_type),*) -> Overrides {
                $($prelude)*
                vec![$((stringify!($name), <f64 as From<$type>>::from($value))),*]
            }
        )*
        $(pub const $other: fn($other_type) -> Overrides =
            |value| vec![(stringify!($other), f64::from(value))];)*
    };
}

overrides! {
    /// Features of the scene, the frame and the settings, for all kernels that trace pictures.
    fn tracing(task: Task) {
        let Task { scene, view, settings, policy, .. } = task;
        let integrator = settings.integrator.entry();
        let features = scene.features;
        let is_path = settings.integrator == Integrator::Path;
        let bounces = settings.max_depth > 0;
        let layers = layers::of_sampling(settings);
        let mut cameras = view.cameras.iter().chain([&view.frame.camera]);
    } gives {
        // Whether the corners of some triangle differ in material, so that coefficients must be interpolated.
        MIXED_MATERIALS: bool = features.mixed_materials;
        BRUTE_FORCE: bool = settings.brute_force;
        // How far rays start off the surface that they leave, in the scene's units; 0 for the error bound.
        FIXED_OFFSET: f32 = match settings.offset {
            RayOffset::Bound => 0.0,
            RayOffset::Fixed(distance) => distance,
        };
        STRATIFIED: bool = settings.antialias != Antialias::None;
        COUNT_RAYS: bool = policy.count_rays;
        HAS_REFLECTION: bool = features.reflection && bounces;
        HAS_REFRACTION: bool = features.refraction && bounces;
        // Whether transparent materials differ in priority.
        HAS_PRIORITIES: bool = features.priorities;
        // Whether transparent surfaces filter shadow rays instead of blocking them.
        FILTERED_SHADOWS: bool = match is_path {
            true => features.thin_walls || settings.transparent_shadows,
            false => features.filtered_shadows,
        };
        // Whether only smooth thin walls filter shadow rays: the path tracer finds light behind other glass by its paths.
        SOLID_GLASS: bool = is_path && !settings.transparent_shadows;
        HAS_LENS: bool = cameras.any(|camera| camera.lens_radius > 0.0);
        HAS_CLIP: bool = view.frame.clip != [0.0; 2];
        FILTER: u32 = match settings.filter {
            Filter::Box => FILTER_BOX,
            Filter::Tent => FILTER_TENT,
            Filter::Gaussian => FILTER_GAUSSIAN,
            Filter::BlackmanHarris => FILTER_BLACKMAN_HARRIS,
            Filter::Mitchell => FILTER_MITCHELL,
        };
        // The radius of the filter in pixels.
        FILTER_RADIUS: f32 = settings.filter_radius;
        HAS_TEXTURES: bool = features.textures || integrator.needs_uvs;
        // Whether some texture is noise or a picture, and whether some is of reflection, transmission or emission.
        HAS_NOISE: bool = features.noise;
        HAS_PICTURES: bool = features.pictures;
        HAS_OPTICS_TEXTURES: bool = features.optics_textures;
        // Whether some picture is filtered over the footprint of a ray, so that rays have a width.
        HAS_FOOTPRINTS: bool = features.footprints;
        // Whether some surface has holes.
        HAS_COVERAGE: bool = features.coverage;
        // Whether surfaces send rays on.
        HAS_TREES: bool = effort::has_trees(scene, settings);
        HAS_NORMAL_MAPS: bool = features.normal_maps;
        // Whether some clear coat differs in its normal from what lies below it.
        HAS_COAT_NORMALS: bool = is_path && features.coat_normals;
        HAS_OCCLUSION: bool = features.occlusion_maps;
        // Whether some picture has texels of 8 bits per channel, and whether some has half floats.
        HAS_BYTE_TEXELS: bool = features.byte_texels;
        HAS_HALF_TEXELS: bool = features.half_texels;
        HAS_EMISSION: bool = features.emission;
        // Whether materials are seen by their layers, as in the path tracer, instead of by Phong's coefficients.
        HAS_LAYERS: bool = is_path;
        // The most that a path may gain from indirect light at once, per channel; 0 for no limit.
        CLAMP_INDIRECT: f32 = settings.clamp_indirect.unwrap_or_default();
        // Whether some material has highlights, and whether some is described by metal and roughness.
        HAS_GLOSS: bool = features.gloss;
        HAS_METALLIC_ROUGHNESS: bool = is_path && features.metallic_roughness;
        // Whether some material has a clear coat, sheen, a thin film or diffuse transmission.
        HAS_COATINGS: bool = is_path && features.coatings;
        // Whether some emissive material has a clear coat.
        HAS_COATED_EMISSION: bool = is_path && features.coated_emission;
        // Whether some transparent material is rough, and whether some disperses light.
        HAS_ROUGH_GLASS: bool = is_path && features.rough_glass;
        HAS_DISPERSION: bool = is_path && features.dispersion;
        // Whether layers scatter by the glTF specification to the letter: separable shadowing, no energy compensation.
        BSDF_SPEC: bool = is_path && settings.bsdf == BsdfModel::Spec;
        // Whether paths choose lamps and emitters from a tree.
        HAS_LIGHT_TREE: bool = is_path && view.has_light_tree();
        // Whether paths sample emissive triangles.
        HAS_EMITTERS: bool = is_path && !view.emitters.is_empty();
        // Whether some emitters are shapes.
        HAS_EMISSIVE_SHAPES: bool = is_path && view.has_emissive_shapes();
        // Whether a texture is brighter on some emitters than on others.
        HAS_EMITTER_GLOWS: bool = is_path && !view.emitter_glows.is_empty();
        // Whether paths sample a picture in the background.
        HAS_ENVIRONMENT: bool = is_path && view.frame.environment_share > 0.0;
        // Whether the film tile is a list of pixels. Row SQUARES_ROW then holds the sum of squared luminance in x, the
        // pixel position in yz, and 1 in w.
        ADAPTIVE: bool = settings.is_adaptive();
        // Whether the camera or lights move while the shutter is open.
        CAMERA_MOTION: bool = !view.cameras.is_empty();
        LIGHT_MOTION: bool = view.frame.light_key_count > 1;
        ORTHOGRAPHIC: bool = view.orthographic;
        // Whether vertices have texture coordinates, and a second set of them; colours; tangents.
        HAS_UVS: bool = !scene.uvs.is_empty();
        HAS_SECOND_UVS: bool = features.second_uvs;
        HAS_COLORS: bool = !scene.colors.is_empty();
        HAS_TANGENTS: bool = !scene.tangents.is_empty();
        // Whether some material reflects more along its tangents than across them, in the path tracer.
        HAS_ANISOTROPY: bool = is_path && features.anisotropy;
        // Whether the film has features besides radiance, in seven rows from FEATURES_ROW on, and the sum of squared luminance.
        HAS_FEATURES: bool = settings.has_features();
        // The first row of opacity of a pixel.
        OPACITY_ROW: u32 = layers::row_of(layers, &layers::OPACITY).unwrap_or_default() as u32;
        // Whether some material catches shadows, and the film has opacity.
        HAS_CATCHERS: bool = settings.has_opacity() && features.shadow_catchers;
        // The backdrop of camera paths that hit nothing.
        BACKDROP: u32 = match settings.backdrop {
            Backdrop::Background => BACKDROP_BACKGROUND,
            Backdrop::Color(_) => BACKDROP_COLOR,
            Backdrop::Transparent => BACKDROP_TRANSPARENT,
        };
    }

    /// The rows of a pixel.
    fn film_rows(settings: &RenderSettings) {
        let layers = layers::of_sampling(settings);
        let row_of = |layer| layers::row_of(layers, layer).unwrap_or_default() as u32;
    } gives {
        FILM_ROWS: u32 = layers::rows(layers) as u32;
        SQUARES_ROW: u32 = row_of(&layers::SQUARES);
        FEATURES_ROW: u32 = row_of(&layers::ALBEDO);
    }

    /// The contents of the trees, and walks through them.
    fn walk(scene: &PackedScene, view: &PackedView, stack: Stack, test: u32, contact: bool, counts_steps: bool) {
        let features = scene.features;
    } gives {
        TRIANGLE_TEST: u32 = test;
        HAS_TRIANGLES: bool = !scene.triangles.is_empty();
        // The number of triangles if they are in no BVH, otherwise 0: rays are tested against them before they walk. A constant,
        // so that drivers unroll the loop.
        TRIANGLES_OUTSIDE_TREE: u32 = match features.outside_tree {
            OutsideTree::Triangles => scene.triangles.len() as u32,
            _ => 0,
        };
        // Whether the bounded shapes are in no BVH.
        SHAPES_OUTSIDE_TREE: bool = features.outside_tree == OutsideTree::Shapes;
        HAS_SHAPES: bool = scene.bounded_shape_count() > 0;
        HAS_PLANES: bool = scene.plane_count > 0;
        // Whether there are more shapes than triangles in BVHs.
        MOSTLY_SHAPES: bool = has_mostly_shapes(scene);
        // Bit k is set if the BVH contains a shape of kind k.
        SHAPE_KINDS: u32 = features.shape_kinds;
        HAS_INSTANCES: bool = features.instances;
        // The number of registers of the stack of the walk through a tree, 0 to 6; 0 for an array.
        STACK_REGISTERS: u32 = stack_registers(scene, view, stack);
        // Whether SHORT_STACK_SIZE entries are enough for the stack of the walk through a tree.
        SHORT_STACK: bool = has_short_stack(scene, view);
        // Whether instances move while the shutter is open, and whether a mesh deforms.
        HAS_MOTION: bool = view.has_moving_instances();
        HAS_DEFORMATION: bool = view.deforms();
        // Whether dielectric volumes may touch or overlap.
        HAS_CONTACT: bool = contact;
        // Whether a plane cuts away a part of the scene.
        HAS_SECTION: bool = view.has_section();
        // Whether traversal steps are counted.
        COUNT_STEPS: bool = counts_steps;
    }

    /// The lights and the background of integrators that shade.
    fn lights(view: &PackedView) {} gives {
        HAS_LIGHTS: bool = view.has_lights;
        HAS_AREA_LIGHTS: bool = view.has_area_lights;
        // The kind and the attenuation of all lights, if they have one in common; else MIXED_LIGHTS.
        LIGHT_KIND: u32 = common(view, |light| light.kind);
        LIGHT_ATTENUATION: u32 = common(view, |light| light.attenuation);
        BACKGROUND: u32 = view.background;
    }

    /// How a film is developed.
    fn curves(tone: &PackedTone) {} gives {
        TONE_CURVE: u32 = tone.curve;
        TONE_TRANSFER: u32 = tone.transfer;
    }

    alone {
        // The quantity that a debug view shows: VIEW_….
        VIEW: u32;
        // Whether a denoised picture has opacity, or the film has it in two rows from OPACITY_ROW on, and two more if it is
        // ADAPTIVE.
        HAS_OPACITY: bool;
        // Whether a ray query ends at any hit instead of the closest.
        ANY_HIT: bool;
        // Whether a lane whose ray tree ends starts the next without waiting for others.
        REFILLS_LANES: bool;
        // The number of lanes of a packet: 8 or 16, the size of subgroups.
        PACKET_LANES: u32;
        // Whether the stack is in workgroup memory, where scenes are in buffers.
        WORKGROUP_STACK: bool;
        // Whether the picture for display is a denoised one, instead of the mean of the film.
        SHOWS_DENOISED: bool;
        // Whether a pass of the denoiser's filter is the first, and whether it multiplies its result by the albedo.
        FIRST_PASS: bool;
        MODULATES: bool;
    }
}

/// Whether there are more shapes than triangles in BVHs.
pub fn has_mostly_shapes(scene: &PackedScene) -> bool {
    match scene.features.outside_tree {
        OutsideTree::Triangles => true,
        OutsideTree::Shapes => false,
        OutsideTree::Nothing => scene.bounded_shape_count() as usize > scene.triangles.len(),
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
    let test = match settings.triangle_test {
        TriangleTest::Plane => TRIANGLE_TEST_PLANE,
        TriangleTest::MollerTrumbore => TRIANGLE_TEST_MOLLER_TRUMBORE,
        TriangleTest::Watertight => TRIANGLE_TEST_WATERTIGHT,
    };
    let contact = scene.features.contact && settings.max_depth > 0;
    let subject = match integrator.is_lit {
        true => lights(view),
        false => VIEW(integrator.view),
    };
    let counts_steps = integrator.counts_steps;
    [
        tracing(task),
        HAS_OPACITY(settings.has_opacity()),
        film_rows(settings),
        walk(scene, view, policy.stack, test, contact, counts_steps),
        subject,
    ]
    .concat()
}

/// The overrides of a ray query.
pub fn of_query(
    scene: &PackedScene,
    view: &PackedView,
    is_any: bool,
    counts_steps: bool,
    stack: Stack,
) -> Overrides {
    let test = TRIANGLE_TEST_WATERTIGHT;
    let walk = walk(scene, view, stack, test, false, counts_steps);
    [ANY_HIT(is_any), walk].concat()
}

/// The overrides of the kernels that develop a film of one row for each pixel.
pub fn of_tone(tone: &PackedTone) -> Overrides {
    let rows = vec![("FILM_ROWS", 1.0)];
    [curves(tone), VIEW(tone.view), rows].concat()
}

/// The registers, of four entries each, that hold the stack of the portable walk on software adapters; 0 for an array, if that
/// many are not enough. Trees over instances differ between frames, and one kernel is for all of them.
fn stack_registers(scene: &PackedScene, view: &PackedView, stack: Stack) -> u32 {
    const MOST: usize = 6;
    const USUAL_OVER_INSTANCES: usize = 5;
    let all = scene.stack_need(view).nodes.div_ceil(4).max(1);
    let count = match (stack, scene.features.instances) {
        (Stack::Usual, true) => USUAL_OVER_INSTANCES,
        (Stack::Usual, false) => all.min(MOST),
        (Stack::Deepest, _) if all > MOST => 0,
        (Stack::Deepest, true) => MOST,
        (Stack::Deepest, false) => all,
    };
    count as u32
}

/// Whether the smaller array of `scene/buffer/stack.wesl` is enough. Trees over instances differ between frames, as above.
fn has_short_stack(scene: &PackedScene, view: &PackedView) -> bool {
    !scene.features.instances && scene.stack_need(view).references <= SHORT_STACK_SIZE as usize
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
