//! The ray tree of a pixel: its contributions add up to the pixel, and an independent tracer finds the same
//! tree.

use crate::reference::compare::{
    Wanted, assert_none, check_same_bits, sized, sliced, start_packed,
};
use crate::reference::rays::{Node, trees};
use crate::reference::scenes::{self, Build, Random};
use glam::{DVec3, Vec3, dvec3, vec3};
use glimray::import;
use glimray::pack;
use glimray::render::{
    Antialias, Filter, RayKind, RayTree, RenderSettings, Renderer, SampleTree, ShadowRay, Slicing,
    Tone, TracedRay,
};
use glimray::scene::{
    Attenuation, Geometry, Light, LightKind, LightTransport, Minify, ObjectRef, Pattern, Scene,
    Shadows,
};
use std::path::PathBuf;
use std::sync::Arc;

/// Tolerance of sums and pixels, relative for values above 1.
const TOLERANCE: f32 = 1e-4;

/// Pixels per scene.
const PIXELS: usize = 1000;

/// Endings of all of them but glTF models.
const NOT_GLTF: [&str; 4] = ["toml", "scene", "nff", "obj"];

/// The scenes in `assets/scenes` whose files end so, with their names.
pub(crate) fn project_scenes(endings: &[&str]) -> Vec<(String, Scene)> {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    let entries = std::fs::read_dir(&folder).expect("assets/scenes");
    let mut names: Vec<_> = entries
        .map(|entry| {
            entry
                .expect("an entry")
                .file_name()
                .into_string()
                .expect("a name")
        })
        .filter(|name| {
            let ending = name.rsplit('.').next();
            ending.is_some_and(|ending| endings.contains(&ending))
        })
        .collect();
    names.sort();
    assert!(names.len() >= 20, "{names:?}");
    let load = |name: String| {
        let scene = import::load(&folder.join(&name)).unwrap_or_else(|error| panic!("{error}"));
        (name, scene)
    };
    names.into_iter().map(load).collect()
}

/// A renderer of the scene's first frame, with the scene's shutter.
pub(crate) fn renderer(scene: &Scene, settings: &impl Wanted) -> Renderer {
    let packed = Arc::new(pack::scene(scene).expect("packed"));
    let (shutter, fps) = (scene.output.shutter, scene.output.fps);
    let frames = scene.motion_samples(shutter.open / fps, shutter.close / fps);
    let view = packed.view(&frames).expect("a view");
    start_packed(packed, &view, settings)
}

pub(crate) fn finish(renderer: &mut Renderer) {
    while !renderer.is_done() {
        renderer.step().expect("a step");
    }
}

pub(crate) fn random_pixels((width, height): (u32, u32), count: usize, seed: u64) -> Vec<[u32; 2]> {
    let mut random = Random(seed);
    let mut below = |count: u32| random.below(count.into()) as u32;
    (0..count).map(|_| [below(width), below(height)]).collect()
}

/// Whether two colours are equal within the tolerance.
fn near(a: Vec3, b: Vec3) -> bool {
    // NaN compares as different.
    (a - b)
        .abs()
        .cmple(TOLERANCE * b.abs().max(Vec3::ONE))
        .all()
}

fn sum_of(sample: &SampleTree) -> Vec3 {
    sample
        .rays
        .iter()
        .map(|ray| Vec3::from(ray.contribution))
        .sum()
}

/// Checks that a tree adds up to `value`, its pixel in the picture.
pub(crate) fn check_sums(tree: &RayTree, value: Vec3) -> Result<(), String> {
    let (mut sum, mut weights) = (Vec3::ZERO, 0.0);
    for sample in &tree.samples {
        let (own, color) = (sum_of(sample), Vec3::from(sample.color));
        if sample.rays.len() != sample.ray_count {
            return Err(format!(
                "{} of {} rays",
                sample.rays.len(),
                sample.ray_count
            ));
        }
        if !near(own, color) {
            return Err(format!(
                "rays of {} add up to {own}, colour {color}",
                sample.sample
            ));
        }
        sum += sample.weight * own;
        weights += sample.weight;
    }
    let mean = if weights.abs() > 0.5 {
        (sum / weights).max(Vec3::ZERO)
    } else {
        Vec3::ZERO
    };
    if !near(mean, value) || !near(tree.value.into(), value) {
        return Err(format!(
            "rays add up to {mean}, the tree says {:?}, the picture {value}",
            tree.value
        ));
    }
    Ok(())
}

/// Checks that the terms of Phong's model multiply out to what a shadow ray adds.
fn check_terms(ray: &TracedRay, shadow: &ShadowRay) -> Result<(), String> {
    let Some(terms) = &shadow.phong else {
        return Ok(());
    };
    let [l, k_d, k_s] = [terms.light, terms.k_d, terms.k_s].map(Vec3::from);
    let (cosine, mirrored) = (terms.l_dot_n.max(0.0), terms.r_dot_v.max(0.0));
    let power = match cosine > 0.0 {
        true => f64::from(mirrored).powf(terms.alpha.into()) as f32,
        false => 0.0,
    };
    let [diffuse, highlight] = [terms.diffuse, terms.highlight].map(Vec3::from);
    let passed = Vec3::from(ray.throughput) * Vec3::from(shadow.transmittance);
    let multiplied = near(diffuse, l * k_d * cosine)
        // Rounding of the base of a power counts as often as its exponent says.
        && (highlight - l * k_s * power).abs().max_element()
            <= (TOLERANCE + 1e-6 * terms.alpha) * (l * k_s).max_element().max(1.0)
        && near(shadow.unshadowed.into(), diffuse + highlight)
        && near(ray.contribution.into(), passed * (diffuse + highlight))
        && shadow.is_traced() == (shadow.unshadowed != [0.0; 3]);
    match multiplied {
        true => Ok(()),
        false => Err(format!("terms do not multiply out: {ray:?}")),
    }
}

/// Checks the parent links and kinds of a sample's rays.
pub(crate) fn check_shape(sample: &SampleTree) -> Result<(), String> {
    for (index, ray) in sample.rays.iter().enumerate() {
        let kind = ray.kind;
        let parent = ray.parent.map(|parent| &sample.rays[parent]);
        let is_known = match parent {
            None => index == 0 && kind == RayKind::Primary && ray.throughput == [1.0; 3],
            Some(parent) => {
                let end = DVec3::from(parent.end.unwrap_or([f64::NAN; 3]));
                let gap = end.distance(ray.origin.into());
                ray.parent < Some(index)
                    && kind != RayKind::Primary
                    && parent.kind != RayKind::Shadow
                    && parent.children.contains(&index)
                    && gap <= 1e-3 * (1.0 + end.length())
            }
        };
        let is_shadow = ray.shadow.is_some() == (kind == RayKind::Shadow);
        if let Some(shadow) = &ray.shadow {
            check_terms(ray, shadow)?;
        }
        let names_something = ray.hit.as_ref().is_none_or(|hit| hit.object.is_some());
        if !(is_known && is_shadow && names_something) {
            return Err(format!(
                "ray {index} is not connected to its parent: {ray:?}"
            ));
        }
    }
    Ok(())
}

/// Explains random pixels of a finished picture and compares them with it.
fn check_scene(
    name: &str,
    scene: &Scene,
    settings: &RenderSettings,
    pixels: usize,
) -> Result<(), String> {
    let mut renderer = renderer(scene, settings);
    finish(&mut renderer);
    let image = renderer.develop(&Tone::LINEAR).expect("a picture");
    let places = random_pixels(settings.size, pixels, 7);
    let wanted: Vec<_> = (places.iter())
        .map(|&place| (place, 0..renderer.samples_at(place)))
        .collect();
    let trees = renderer.explain_pixels(&wanted).expect("trees");
    assert_eq!(trees.len(), places.len());
    for (tree, &[x, y]) in trees.iter().zip(&places) {
        let [r, g, b, _] = image.pixel(x, y).expect("a pixel");
        let shapes = tree.samples.iter().map(check_shape);
        let checks = shapes.chain([check_sums(tree, vec3(r, g, b))]);
        let problem = checks.filter_map(Result::err).next();
        problem.map_or(Ok(()), |problem| {
            Err(format!("{name} at {x},{y}: {problem}"))
        })?;
    }
    Ok(())
}

fn settings_of(scene: &Scene) -> RenderSettings {
    RenderSettings {
        size: (96, 72),
        samples: 2,
        antialias: Antialias::Stratified,
        ..RenderSettings::from(&scene.output)
    }
}

#[test]
fn contributions_add_up_to_the_pixels_of_every_other_scene() {
    // Each has kernels of its own, which take seconds to compile; few are of paths.
    let is_path = |(_, scene): &(String, Scene)| scene.output.integrator == LightTransport::Path;
    let (paths, others): (Vec<_>, Vec<_>) =
        project_scenes(&NOT_GLTF).into_iter().partition(is_path);
    assert!(!paths.is_empty());
    let scenes = paths.into_iter().chain(others.into_iter().step_by(2));
    assert_none(
        scenes.map(|(name, scene)| check_scene(&name, &scene, &settings_of(&scene), PIXELS)),
    );
}

#[test]
fn contributions_add_up_with_negative_filter_weights_and_adaptive_sampling() {
    let mut scene = scenes::mirrors_and_glass();
    scene.output.max_depth = 4;
    let settings = RenderSettings {
        samples: 16,
        noise: 0.05,
        max_depth: 4,
        ..sized(64, 48)
    };
    let mitchell = RenderSettings {
        antialias: Antialias::Stratified,
        filter: Filter::Mitchell,
        filter_radius: 2.0,
        ..settings.clone()
    };
    let adaptive = RenderSettings {
        antialias: Antialias::Adaptive,
        ..settings.clone()
    };
    let centre = RenderSettings {
        antialias: Antialias::None,
        ..settings
    };
    assert_none([
        check_scene("negative weights", &scene, &mitchell, 300),
        check_scene("adaptive", &scene, &adaptive, 300),
        check_scene("one place", &scene, &centre, 300),
    ]);
    let mut renderer = renderer(&scene, &mitchell);
    let tree = renderer.explain([20, 20], 0..16).expect("a tree");
    let negative = tree.samples.iter().filter(|sample| sample.weight == -1.0);
    assert!(
        (1..8).contains(&negative.count()),
        "Mitchell's filter is negative at its edges"
    );
}

#[test]
fn a_pixel_has_the_samples_that_adaptive_sampling_gave_it() {
    let scene = scenes::mirrors_and_glass();
    let settings = RenderSettings {
        samples: 64,
        antialias: Antialias::Adaptive,
        noise: 0.02,
        ..sized(64, 48)
    };
    let mut renderer = renderer(&scene, &settings);
    finish(&mut renderer);
    let counts: Vec<u32> = (0..48)
        .flat_map(|y| (0..64).map(move |x| [x, y]))
        .map(|place| renderer.samples_at(place))
        .collect();
    let (least, most) = (counts.iter().min(), counts.iter().max());
    assert_eq!((least, most), (Some(&4), Some(&64)));
    assert_eq!(
        counts.iter().map(|&count| u64::from(count)).sum::<u64>(),
        renderer.stats().samples
    );
    assert_eq!(renderer.samples_at([64, 0]), 0, "outside of the picture");
}

#[test]
fn explaining_between_steps_does_not_change_the_picture() {
    let mut scene = scenes::mirrors_and_glass();
    scene.output.max_depth = 4;
    for antialias in [Antialias::Stratified, Antialias::Adaptive] {
        let settings = RenderSettings {
            samples: 8,
            antialias,
            max_depth: 4,
            ..sized(64, 48)
        };
        // Many steps.
        let slicing = Slicing {
            max_groups: 8,
            ..Slicing::default()
        };
        let settings = sliced(&settings, slicing);
        let mut undisturbed = renderer(&scene, &settings);
        finish(&mut undisturbed);
        let expected = undisturbed.develop(&Tone::LINEAR).expect("a picture");
        let mut disturbed = renderer(&scene, &settings);
        let first = disturbed.explain([30, 20], 0..4).expect("a tree");
        while !disturbed.is_done() {
            disturbed.step().expect("a step");
            let again = disturbed.explain([30, 20], 0..4).expect("a tree");
            assert_eq!(
                again, first,
                "the tree must not depend on when it is requested"
            );
        }
        let actual = disturbed.develop(&Tone::LINEAR).expect("a picture");
        assert_none([check_same_bits("explained", &expected, &actual)]);
    }
}

/// The scene reduced to what the independent tracer supports: a pinhole camera, opaque shadows, point lights
/// instead of area lights, pictures without mipmaps, and nothing that touches a plane, because it has no rule for coincident surfaces.
fn plain(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    scene.shadows = Shadows::Opaque;
    for camera in &mut scene.cameras {
        camera.lens = None;
    }
    for shape in &mut scene.shapes {
        if let Geometry::Plane { point, normal } = &mut shape.geometry {
            *point -= 0.003 * *normal;
        }
    }
    for texture in &mut scene.textures {
        if let Pattern::Picture { minify, .. } = &mut texture.pattern {
            *minify = Minify::Linear;
        }
    }
    for light in &mut scene.lights {
        light.visible = false;
        if let LightKind::Rectangle { center, .. }
        | LightKind::Disc { center, .. }
        | LightKind::Sphere { center, .. } = light.kind
        {
            light.kind = LightKind::Point { position: center };
        }
    }
    scene
}

/// Relative error allowed for a ray in f32. Every surface on its path amplifies errors.
fn slack(sample: &SampleTree, at: usize) -> f64 {
    let above = std::iter::successors(Some(at), |&at| sample.rays[at].parent);
    1e-4 * 4_f64.powi(above.count().min(5) as i32 - 1)
}

/// Whether a ray hit the same object as the tracer's ray, at the same distance. The tolerance grows towards
/// grazing incidence.
fn same_hit(ray: &TracedRay, hit: Option<(f64, ObjectRef)>, slack: f64) -> bool {
    match (&ray.hit, hit) {
        (None, None) => true,
        (Some(got), Some((t, object))) => {
            let normal = DVec3::from(got.geometric_normal);
            let cos = match ray.kind {
                RayKind::Shadow => 0.1,
                _ => normal.dot(ray.direction.into()).abs().max(0.01),
            };
            let is_near = (got.distance - t).abs() <= slack / cos * t.max(1.0);
            got.object == Some(object) && is_near
        }
        _ => false,
    }
}

/// Compares a ray and all its descendants with the tracer's.
fn compare(sample: &SampleTree, at: usize, nodes: &[Node], node: usize) -> Result<(), String> {
    let (ray, expected) = (&sample.rays[at], &nodes[node]);
    let slack = slack(sample, at);
    let mut throughputs = (ray.throughput.into_iter()).zip(expected.throughput.to_array());
    let is_same = ray.kind == expected.kind
        && same_hit(ray, expected.hit, slack)
        && throughputs.all(|(got, want)| (f64::from(got) - want).abs() <= slack * want.max(0.01));
    if !is_same {
        let met = ray.hit.as_ref().map(|hit| (hit.distance, hit.object));
        return Err(format!(
            "{:?} of {:?} meets {met:?}, not {:?} of {} meets {:?}",
            ray.kind, ray.throughput, expected.kind, expected.throughput, expected.hit
        ));
    }
    let children = |kind: RayKind| {
        let of = move |&&child: &&usize| sample.rays[child].kind == kind;
        ray.children.iter().filter(of).copied().collect::<Vec<_>>()
    };
    let sent = |kind: RayKind| {
        let of = move |&&child: &&usize| nodes[child].kind == kind;
        expected
            .children
            .iter()
            .filter(of)
            .copied()
            .collect::<Vec<_>>()
    };
    for kind in [RayKind::Reflection, RayKind::Refraction] {
        let (own, other) = (children(kind), sent(kind));
        if own.len() != other.len() {
            return Err(format!(
                "{} rays of {kind:?} and not {}",
                own.len(),
                other.len()
            ));
        }
        for (child, other) in own.into_iter().zip(other) {
            compare(sample, child, nodes, other)?;
        }
    }
    // The tracer sends a ray to every light in front of a surface, the kernel only if it can contribute.
    let others = sent(RayKind::Shadow);
    let traced = |&child: &usize| sample.rays[child].is_traced();
    for child in children(RayKind::Shadow).into_iter().filter(traced) {
        let shadow = sample.rays[child].shadow.as_ref().expect("a shadow ray");
        let other = others
            .iter()
            .find(|&&other| nodes[other].light == shadow.light);
        let hit = other.map(|&other| nodes[other].hit);
        let is_same = hit.is_some_and(|hit| {
            shadow.blocked == hit.is_some() && same_hit(&sample.rays[child], hit, 4.0 * slack)
        });
        if !is_same {
            return Err(format!(
                "shadow ray {:?} and not {hit:?}",
                sample.rays[child]
            ));
        }
    }
    Ok(())
}

/// Percentage of pixels whose trees may differ: in f32, rays along edges may hit either side.
const EDGES: usize = 2;

#[test]
fn the_tree_is_that_of_an_independent_tracer() {
    let own = [
        ("everything", scenes::everything()),
        ("glass", scenes::mirrors_and_glass()),
        ("solids", scenes::solids()),
    ];
    let own = own.map(|(name, scene)| (name.to_string(), scene));
    assert_none(
        own.into_iter()
            // The scenes above have every feature; each kernel takes seconds to compile.
            .chain(project_scenes(&NOT_GLTF).into_iter().step_by(3))
            .map(|(name, scene)| {
                let scene = plain(&scene);
                let settings = RenderSettings {
                    max_depth: scene.output.max_depth,
                    ..sized(160, 120)
                };
                let packed = Arc::new(pack::scene(&scene).expect("packed"));
                let view = packed.frame(&scene.frame(0.0)).expect("a view");
                let mut renderer = start_packed(packed, &view, &settings);
                let pixels = random_pixels(settings.size, 200, 3);
                let started = std::time::Instant::now();
                let expected = trees(&scene, 0.0, settings.size, &pixels);
                let spent = started.elapsed().as_secs_f64();
                let wanted: Vec<_> = pixels.iter().map(|&pixel| (pixel, 0..1)).collect();
                let got = renderer.explain_pixels(&wanted).expect("trees");
                assert_eq!((got.len(), expected.len()), (pixels.len(), pixels.len()));
                let mut rays = 0;
                let mut problems = Vec::new();
                for (tree, (color, nodes)) in got.iter().zip(&expected) {
                    let sample = &tree.samples[0];
                    rays += sample.rays.len();
                    let is_near = (0..3).all(|i| {
                        (f64::from(sample.color[i]) - color[i]).abs() <= 1e-3 * color[i].max(1.0)
                    });
                    let same = compare(sample, 0, nodes, 0).and_then(|()| match is_near {
                        true => Ok(()),
                        false => Err(format!("colour {:?} and not {color}", sample.color)),
                    });
                    problems.extend(
                        same.err()
                            .map(|problem| format!("{:?}: {problem}", tree.pixel)),
                    );
                }
                println!(
                    "{name}: {rays} rays, {} differ, {spent:.1} s",
                    problems.len()
                );
                match problems.len() * 100 <= EDGES * pixels.len() {
                    true => Ok(()),
                    false => Err(format!(
                        "{name}: {} trees differ, such as {}",
                        problems.len(),
                        problems[0]
                    )),
                }
            }),
    );
}

/// A glass ball of index 1.5 in front of the camera, hit at normal incidence.
fn glass_ball() -> Scene {
    let mut scene = Scene {
        cameras: vec![glimray::scene::Camera {
            look_from: dvec3(0.0, 0.0, 5.0),
            ..Default::default()
        }],
        background: glimray::scene::Background::Color(vec3(0.5, 0.25, 1.0)),
        ambient: Vec3::splat(0.1),
        ..Scene::default()
    };
    let glass = scene.add_material(glimray::scene::Material {
        name: "glass".into(),
        bsdf: glimray::scene::Phong {
            diffuse: Vec3::ZERO,
            ambient: Vec3::ZERO,
            reflect: Vec3::ONE,
            transmit: Vec3::ONE,
            opacity: 0.0,
            ior: 1.5,
            absorption: vec3(0.1, 0.2, 0.0),
            fresnel: glimray::scene::Fresnel::Exact,
            ..glimray::scene::Phong::default()
        }
        .into(),
        ..glimray::scene::Material::default()
    });
    scene.add_sphere(DVec3::ZERO, 1.0, glass);
    scene.output.max_depth = 2;
    scene
}

#[test]
fn a_glass_ball_at_normal_incidence_follows_fresnel_and_beer() {
    let scene = glass_ball();
    let settings = RenderSettings {
        max_depth: 2,
        ..sized(1, 1)
    };
    let tree = renderer(&scene, &settings)
        .explain([0, 0], 0..1)
        .expect("a tree");
    let sample = &tree.samples[0];
    // Reflectance ((1.5 - 1) / (1.5 + 1))², and transmittance of two units of glass.
    let mirrored = 0.04;
    let left = dvec3((-0.2_f64).exp(), (-0.4_f64).exp(), 1.0);
    let inside = (1.0 - mirrored) * left;
    let background = dvec3(0.5, 0.25, 1.0);
    let one = DVec3::ONE;
    // Kind, z of start and end, throughput, contribution.
    let mut expected = vec![
        (RayKind::Primary, 5.0, Some(1.0), one, DVec3::ZERO),
        (
            RayKind::Reflection,
            1.0,
            None,
            one * mirrored,
            background * mirrored,
        ),
        (
            RayKind::Refraction,
            1.0,
            Some(-1.0),
            one * (1.0 - mirrored),
            DVec3::ZERO,
        ),
        (
            RayKind::Refraction,
            -1.0,
            None,
            inside * (1.0 - mirrored),
            background * inside * (1.0 - mirrored),
        ),
        (
            RayKind::Reflection,
            -1.0,
            Some(1.0),
            inside * mirrored,
            DVec3::ZERO,
        ),
    ];
    for ray in &sample.rays {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-4;
        let [x, y, z] = ray.origin;
        assert!(x.abs() < 1e-4 && y.abs() < 1e-4, "{ray:?}");
        let found = expected
            .iter()
            .position(|(kind, start, end, throughput, added)| {
                let same_end = match (ray.end, end) {
                    (Some([_, _, z]), Some(end)) => near(z, *end),
                    (None, None) => true,
                    _ => false,
                };
                let throughput_error = Vec3::from(ray.throughput).as_dvec3() - *throughput;
                let added_error = Vec3::from(ray.contribution).as_dvec3() - *added;
                ray.kind == *kind
                    && near(z, *start)
                    && same_end
                    && throughput_error.length() < 1e-4
                    && added_error.length() < 1e-4
            });
        expected.remove(found.unwrap_or_else(|| panic!("not expected: {ray:?}")));
    }
    assert!(expected.is_empty(), "missing: {expected:?}");
    let hits = || sample.rays.iter().filter_map(|ray| ray.hit.as_ref());
    for hit in hits() {
        let split = hit.split.as_ref().expect("glass");
        let reflectance = f64::from(split.reflectance.expect("Fresnel's"));
        assert!((reflectance - mirrored).abs() < 1e-5 && !split.total && split.transparent);
        let iors = if hit.outside { [1.0, 1.5] } else { [1.5, 1.0] };
        let media = if hit.outside {
            [None, Some(0)]
        } else {
            [Some(0), None]
        };
        assert_eq!(
            (split.iors, [split.medium, split.medium_behind]),
            (iors, media)
        );
        assert_eq!(
            (hit.object, hit.material_name.as_deref()),
            (Some(ObjectRef::Shape(0)), Some("glass"))
        );
    }
    assert_eq!(hits().filter(|hit| hit.outside).count(), 1);
    assert!(
        sample
            .rays
            .iter()
            .filter(|ray| !ray.media.is_empty())
            .all(|ray| ray.media == [0])
    );
}

#[test]
fn a_shadow_ray_names_its_occluder() {
    // A wall seen from the front, a light above the camera, and a ball between them.
    let mut scene = Scene {
        cameras: vec![glimray::scene::Camera {
            look_from: dvec3(0.0, 0.0, 4.0),
            ..Default::default()
        }],
        materials: vec![glimray::scene::Material::default()],
        ..Scene::default()
    };
    scene.add_plane(DVec3::ZERO, DVec3::Z, 0);
    scene.add_sphere(dvec3(0.0, 2.0, 2.0), 0.5, 0);
    scene.add_point_light(dvec3(0.0, 4.0, 4.0), 1.0);
    scene.lights.push(Light {
        kind: LightKind::Directional {
            direction: DVec3::NEG_Z,
        },
        color: Vec3::splat(0.5),
        attenuation: Attenuation::None,
        ..Light::default()
    });
    let tree = renderer(&scene, &sized(1, 1))
        .explain([0, 0], 0..1)
        .expect("a tree");
    let rays = &tree.samples[0].rays;
    let [blocked, free] = [0, 1].map(|light| {
        let of = |ray: &&TracedRay| {
            ray.shadow
                .as_ref()
                .is_some_and(|shadow| shadow.light == Some(light))
        };
        rays.iter().find(of).expect("a ray to each light")
    });
    let shadow = blocked.shadow.as_ref().expect("it is one");
    let hit = blocked.hit.as_ref().expect("the ball");
    let root = 8.0_f64.sqrt();
    assert!(shadow.blocked && blocked.contribution == [0.0; 3]);
    assert!((shadow.distance.expect("near") - 2.0 * root.powi(2) / root).abs() < 1e-4);
    assert_eq!(hit.object, Some(ObjectRef::Shape(1)));
    assert!((hit.distance - (root - 0.5)).abs() < 1e-4, "{hit:?}");
    // 0.5 · 0.8 · cos 0.
    let shadow = free.shadow.as_ref().expect("it is one");
    assert!(!shadow.blocked && shadow.distance.is_none() && free.hit.is_none());
    assert!((free.contribution[0] - 0.4).abs() < 1e-5, "{free:?}");
}

/// A wall at z = 0 is seen along its normal from z = 4: `n` and `v` are both z.
#[test]
fn the_terms_of_each_light_are_those_of_a_calculation_by_hand() {
    let mut scene = Scene {
        cameras: vec![glimray::scene::Camera {
            look_from: dvec3(0.0, 0.0, 4.0),
            ..Default::default()
        }],
        materials: vec![glimray::scene::Material::from(glimray::scene::Phong {
            diffuse: vec3(0.6, 0.5, 0.1),
            specular: vec3(0.2, 0.4, 0.8),
            shininess: 3.0,
            ..glimray::scene::Phong::default()
        })],
        ..Scene::default()
    };
    scene.add_plane(DVec3::ZERO, DVec3::Z, 0);
    // A triangle of sides 3, 4 and 5: l·n = 4/5. The mirrored direction is as far from the eye, so r·v = 4/5 too.
    scene.add_point_light(dvec3(3.0, 0.0, 4.0), 2.0);
    scene.lights[0].attenuation = Attenuation::None;
    // Along the normal, from 2 units away: 12/2² = 3.
    scene.add_point_light(dvec3(0.0, 0.0, 2.0), 12.0);
    scene.lights[1].attenuation = Attenuation::InverseSquare;
    // From below the wall: l·n = r·v = −3/5.
    scene.add_point_light(dvec3(0.0, 4.0, -3.0), 1.0);
    scene.lights[2].attenuation = Attenuation::None;
    // As the first, on the other side, behind a ball.
    scene.add_point_light(dvec3(-3.0, 0.0, 4.0), 2.0);
    scene.lights[3].attenuation = Attenuation::None;
    scene.add_sphere(dvec3(-1.5, 0.0, 2.0), 0.25, 0);
    let tree = renderer(&scene, &sized(1, 1))
        .explain([0, 0], 0..1)
        .expect("a tree");
    let rays = &tree.samples[0].rays;
    assert_eq!(
        rays.len(),
        5,
        "a ray from the camera, and one for each light"
    );
    let (k_d, k_s) = (dvec3(0.6, 0.5, 0.1), dvec3(0.2, 0.4, 0.8));
    let cubed = 0.8f64.powi(3);
    // L, l·n and r·v, diffuse, highlight, the fraction that arrives, whether a ray was sent.
    let expected = [
        (2.0, 0.8, 1.6 * k_d, 2.0 * cubed * k_s, 1.0, true),
        (3.0, 1.0, 3.0 * k_d, 3.0 * k_s, 1.0, true),
        (1.0, -0.6, DVec3::ZERO, DVec3::ZERO, 0.0, false),
        (2.0, 0.8, 1.6 * k_d, 2.0 * cubed * k_s, 0.0, true),
    ];
    for (light, (l, cosine, diffuse, highlight, arriving, traced)) in
        expected.into_iter().enumerate()
    {
        let ray = &rays[1 + light];
        let shadow = ray.shadow.as_ref().expect("a shadow ray");
        let terms = shadow.phong.as_ref().expect("terms");
        let is = |got: [f32; 3], want: DVec3| (Vec3::from(got) - want.as_vec3()).length() < 1e-5;
        let scalar = |got: f32, want: f64| (f64::from(got) - want).abs() < 1e-6;
        assert_eq!((shadow.light, terms.traced), (Some(light), traced));
        assert!(
            is(terms.light, DVec3::splat(l))
                && scalar(terms.l_dot_n, cosine)
                && scalar(terms.r_dot_v, cosine)
                && is(terms.k_d, k_d)
                && is(terms.k_s, k_s)
                && scalar(terms.alpha, 3.0)
                && is(terms.diffuse, diffuse)
                && is(terms.highlight, highlight)
                && is(ray.contribution, arriving * (diffuse + highlight)),
            "light {light}: {ray:?}"
        );
    }
}

#[test]
fn a_truncated_tree_says_so_and_keeps_the_pixels_value() {
    let mut scene = scenes::empty();
    scene.add_plane(DVec3::ZERO, DVec3::Y, 0);
    scene.lights.push(Light {
        kind: LightKind::Sphere {
            center: dvec3(0.0, 3.0, 0.0),
            radius: 0.5,
        },
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        samples: 8000,
        ..Light::default()
    });
    let settings = RenderSettings {
        samples: 40,
        antialias: Antialias::Stratified,
        ..sized(4, 4)
    };
    let mut renderer = renderer(&scene, &settings);
    let tree = renderer.explain([1, 3], 0..40).expect("a tree");
    let counts: Vec<_> = tree
        .samples
        .iter()
        .map(|sample| (sample.rays.len(), sample.ray_count))
        .collect();
    assert_eq!(counts[0], (8001, 8001));
    assert_eq!(counts[39], (0, 8001));
    assert_eq!(counts.iter().map(|(kept, _)| kept).sum::<usize>(), 1 << 18);
    finish(&mut renderer);
    let [r, g, b, _] = renderer
        .develop(&Tone::LINEAR)
        .expect("a picture")
        .pixel(1, 3)
        .expect("a pixel");
    assert!(near(tree.value.into(), vec3(r, g, b)), "{:?}", tree.value);
}

#[test]
fn hits_name_the_same_objects_for_baked_and_instanced_copies() {
    let mut scene = scenes::meshes();
    let ball = scene.instances[2].mesh;
    std::sync::Arc::make_mut(&mut scene.meshes[ball]).name = "ball".into();
    scene.nodes.push(glimray::scene::Node {
        name: "left".into(),
        translation: dvec3(-0.4, 0.6, 1.5),
        ..Default::default()
    });
    scene.instances.push(glimray::scene::Instance {
        mesh: ball,
        placement: glam::DAffine3::from_scale(DVec3::splat(0.4)),
        node: Some(0),
        name: String::new(),
    });
    scene.add_sphere(dvec3(0.0, 2.0, 0.0), 0.4, 0);
    scene.lights.push(Light {
        kind: LightKind::Sphere {
            center: dvec3(1.0, 2.4, 0.0),
            radius: 0.3,
        },
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        visible: true,
        ..Light::default()
    });
    let pixels: Vec<_> = (0..48)
        .flat_map(|y| (0..64).map(move |x| ([x, y], 0..1)))
        .collect();
    let objects = |most_baked| {
        let packed = Arc::new(pack::scene_with(&scene, most_baked).expect("packed"));
        let view = packed.frame(&scene.frame(0.0)).expect("a view");
        let mut renderer = start_packed(packed.clone(), &view, &sized(64, 48));
        let trees = renderer.explain_pixels(&pixels).expect("trees");
        let hit = |tree: &RayTree| {
            let hit = tree.samples[0].rays[0].hit.clone();
            hit.map(|hit| (hit.object.expect("an object"), hit.name))
        };
        (
            packed.instance_count(),
            trees.iter().map(hit).collect::<Vec<_>>(),
        )
    };
    let ((none, baked), (some, instanced)) = (objects(usize::MAX), objects(0));
    assert!(none == 0 && some > 0, "{none} and {some} instances");
    let differing = baked.iter().zip(&instanced).filter(|(a, b)| a != b).count();
    assert!(differing <= pixels.len() / 500, "{differing} differ");
    for (object, name) in [
        (ObjectRef::Instance(0), None),
        (ObjectRef::Instance(1), None),
        (ObjectRef::Instance(2), Some("ball")),
        (ObjectRef::Instance(3), Some("left")),
        (ObjectRef::Shape(0), None),
        (ObjectRef::Light(2), None),
    ] {
        let is_it = |hit: &&Option<(ObjectRef, Option<String>)>| {
            hit.as_ref()
                .is_some_and(|(found, as_named)| *found == object && as_named.as_deref() == name)
        };
        assert!(
            instanced.iter().filter(is_it).count() > 3,
            "{object:?} {name:?} is in the picture"
        );
    }
}
