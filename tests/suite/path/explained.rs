//! The recorded paths of pixels: what they add is the film's value, and the listed densities, weights and values are
//! those of formulas in f64.

use super::{glowing_square, lit_floor, looking, matte, paths};
use crate::bsdf::reference::ggx;
use crate::explain::{check_shape, check_sums, finish, random_pixels, renderer};
use crate::reference::compare::assert_none;
use crate::reference::scenes::{self, Build};
use crate::support::verdict::Verdict;
use glam::{DAffine3, DVec3, Vec3, dvec3, vec3};
use glimray::import;
use glimray::render::{
    LightSource, Lobe, PathStep, RayKind, RayTree, RenderSettings, SampleTree, Sharing,
    StepOutcome, Tone, TracedRay,
};
use glimray::scene::{
    Attenuation, Backdrop, Background, Coverage, Filter, Light, LightKind, Material, Phong, Scene,
    sky,
};
use std::f64::consts::PI;
use std::path::PathBuf;
use std::sync::Arc;

fn asset(name: &str) -> Scene {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    import::load(&folder.join(name)).unwrap_or_else(|error| panic!("{error}"))
}

/// A glossy ball and a glass ball on a floor, under a sky with a sun.
fn under_the_sky() -> Scene {
    let mut scene = scenes::mirrors_and_glass();
    scene.lights.clear();
    scene.pictures.push(Arc::new(sky::picture(0.6, 0.4)));
    scene.background = Background::Picture {
        picture: scene.pictures.len() - 1,
        strength: 1.0,
        rotation: 0.0,
    };
    scene
}

/// A floor under a glowing square, with balls of metal and glass.
fn under_a_mesh() -> Scene {
    let mut scene = scenes::mirrors_and_glass();
    scene.lights.clear();
    scene.background = Background::Color(Vec3::ZERO);
    let placed = DAffine3::from_scale_rotation_translation(
        dvec3(1.5, 1.0, 1.0),
        glam::DQuat::from_rotation_z(0.2),
        dvec3(0.0, 4.0, 0.0),
    );
    glowing_square(&mut scene, placed, 6.0);
    scene
}

/// Walls of which half is there, in front of a lit floor.
fn behind_holes() -> Scene {
    let mut scene = lit_floor(matte(0.7), lamp(true));
    scene.cameras = vec![looking(dvec3(0.1, 2.0, 2.0), DVec3::ZERO, 0.8)];
    let sheer = scene.add_material(Material {
        alpha: 0.4,
        coverage: Coverage::Blend,
        ..matte(0.5)
    });
    for height in [0.5, 0.9] {
        let mesh = scenes::quad(3.0, sheer as u32);
        scene.add_mesh(mesh, DAffine3::from_translation(dvec3(0.0, height, 0.0)));
    }
    scene
}

/// A ball of glass and a mirror on a floor that only shows shadows, under a lamp and an even sky.
fn on_a_catcher() -> Scene {
    let mut scene = lit_floor(matte(0.7), lamp(true));
    scene.background = Background::Color(Vec3::splat(0.2));
    scene.materials[0].shadow_catcher = true;
    scene.cameras = vec![looking(dvec3(0.1, 2.0, 2.0), DVec3::ZERO, 0.8)];
    for (x, reflect, transmit) in [(-0.4, 0.9, 0.0), (0.4, 0.0, 1.0)] {
        let material = scene.add_material(Material {
            bsdf: Phong {
                reflect: Vec3::splat(reflect),
                transmit: Vec3::splat(transmit),
                opacity: 1.0 - transmit,
                ior: 1.5,
                ..matte(0.3).classical().into_owned()
            }
            .into(),
            ..matte(0.3)
        });
        scene.add_sphere(dvec3(x, 0.3, 0.0), 0.3, material);
    }
    scene
}

/// A rectangle of 0.8 by 0.6 above the floor.
fn lamp(visible: bool) -> Light {
    Light {
        kind: LightKind::Rectangle {
            center: dvec3(0.4, 1.2, -0.5),
            edge_u: 0.4 * DVec3::X,
            edge_v: 0.3 * DVec3::Z,
        },
        color: Vec3::ONE,
        attenuation: Attenuation::InverseSquare,
        samples: 1,
        visible,
        node: None,
        name: String::new(),
    }
}

pub fn explained(
    scene: &Scene,
    settings: &RenderSettings,
    count: usize,
) -> (Vec<RayTree>, Vec<Vec3>) {
    let mut renderer = renderer(scene, settings);
    finish(&mut renderer);
    let image = renderer.develop(&Tone::LINEAR).expect("a picture");
    let places = random_pixels(settings.size, count, 11);
    let wanted: Vec<_> = (places.iter())
        .map(|&place| (place, 0..renderer.samples_at(place)))
        .collect();
    let values = places.iter().map(|&[x, y]| {
        let [r, g, b, opacity] = image.pixel(x, y).expect("a pixel");
        opacity * vec3(r, g, b)
    });
    let values = values.collect();
    (renderer.explain_pixels(&wanted).expect("paths"), values)
}

fn close(found: f64, expected: f64, tolerance: f64) -> bool {
    (found - expected).abs() <= tolerance * expected.abs().max(1e-3)
}

fn alike(found: [f32; 3], expected: DVec3, tolerance: f64) -> bool {
    (0..3).all(|k| close(found[k].into(), expected[k], tolerance))
}

fn wide(v: [f32; 3]) -> DVec3 {
    Vec3::from(v).as_dvec3()
}

/// Whether the weights are those of the power heuristic, and 1 and 0 where only one way finds the light.
fn is_fair(sharing: &Sharing) -> bool {
    let expected = match (sharing.light_pdf, sharing.bsdf_pdf) {
        (Some(light), Some(path)) => {
            let [light, path] = [light, path].map(|pdf| f64::from(pdf).powi(2));
            light / (light + path)
        }
        (Some(_), None) => 0.0,
        (None, _) => sharing.light_weight.round().into(),
    };
    (f64::from(sharing.light_weight) - expected).abs() < 1e-5
        && (sharing.light_weight + sharing.bsdf_weight - 1.0).abs() < 1e-6
}

/// A ray's stated contribution, from its own numbers.
fn stated(ray: &TracedRay) -> DVec3 {
    let Some(sharing) = &ray.sharing else {
        return DVec3::ZERO;
    };
    let at_end = wide(ray.arriving);
    match (&ray.shadow, &ray.hit) {
        (Some(shadow), _) => {
            let sample = shadow.sample.as_ref().expect("a light sample");
            let lit = wide(sample.bsdf) * wide(sample.radiance) * wide(shadow.transmittance);
            wide(ray.throughput) * f64::from(sharing.light_weight) * lit
        }
        (None, Some(hit)) => at_end * f64::from(sharing.bsdf_weight) * wide(hit.emission),
        (None, None) => {
            let background = ray.background.expect("the background");
            at_end * f64::from(sharing.bsdf_weight) * wide(background)
        }
    }
}

/// Checks a step against the ray that it follows and the number of surfaces that scattered before.
fn check_step(ray: &TracedRay, step: &PathStep, bounces: u32) -> Result<(), String> {
    let weight = wide(step.weight);
    if let (Some(bsdf), Some(pdf)) = (step.bsdf, step.pdf)
        && !alike(step.weight, wide(bsdf) / f64::from(pdf), 1e-4)
    {
        return Err(format!("the factor is not bsdf / pdf: {step:?}"));
    }
    let after = wide(ray.arriving) * weight;
    let chance = match bounces >= 3 && step.lobe.is_some() {
        true => after.max_element().min(1.0),
        false => 1.0,
    };
    let has_roulette = !matches!(step.outcome, StepOutcome::Limit | StepOutcome::Absorbed);
    if has_roulette && !close(step.survival.into(), chance, 1e-4) {
        return Err(format!("survives with {}, not {chance}", step.survival));
    }
    if step.outcome.goes_on() && !alike(step.throughput, after / chance, 1e-4) {
        return Err(format!(
            "goes on with {:?}, not {}",
            step.throughput,
            after / chance
        ));
    }
    Ok(())
}

/// Checks the numbers of a path against each other. A shadow catcher that the camera sees, in no mirror, adds nothing to the
/// colour, and neither does what the path finds from there on.
fn check_path(sample: &SampleTree, scene: &Scene) -> Result<(), String> {
    let is_catcher = |ray: &TracedRay| {
        let material = ray.hit.as_ref().and_then(|hit| hit.material);
        material.is_some_and(|material| scene.materials[material].shadow_catcher)
    };
    let mut last: Option<&PathStep> = None;
    let mut bounces = 0;
    let mut is_caught = false;
    for ray in &sample.rays {
        let expected = match is_caught {
            true => DVec3::ZERO,
            false => stated(ray),
        };
        is_caught |= bounces == 0 && is_catcher(ray);
        if !alike(ray.contribution, expected, 1e-4) {
            return Err(format!("adds {:?}, not {expected}", ray.contribution));
        }
        if let Some(sharing) = ray.sharing.as_ref().filter(|sharing| !is_fair(sharing)) {
            return Err(format!("unfair {sharing:?}"));
        }
        if ray.kind == RayKind::Shadow {
            continue;
        }
        let goes_on = last.is_none_or(|step| step.outcome.goes_on());
        let throughput = last.map_or([1.0; 3], |step| step.throughput);
        if !goes_on || !alike(ray.throughput, wide(throughput), 1e-5) {
            return Err(format!("{ray:?} does not follow {last:?}"));
        }
        last = ray.step.as_ref();
        if last.is_some() != ray.hit.is_some() {
            return Err(format!("no step at {:?}", ray.hit));
        }
        if let Some(step) = last {
            check_step(ray, step, bounces)?;
            let is_transmitted = step.pdf.is_none()
                && sample.rays.iter().any(|next| {
                    let follows = next
                        .parent
                        .is_some_and(|at| std::ptr::eq(&sample.rays[at], ray));
                    follows && matches!(next.kind, RayKind::Refraction | RayKind::Passage)
                });
            bounces += u32::from(!is_transmitted);
        }
    }
    match last.is_some_and(|step| step.outcome.goes_on()) {
        true => Err("the last ray goes on".to_owned()),
        false => Ok(()),
    }
}

/// Kinds of rays, lobes, outcomes and light sources that the paths of a scene have.
fn seen(trees: &[RayTree]) -> Vec<String> {
    let rays = trees
        .iter()
        .flat_map(|tree| &tree.samples)
        .flat_map(|sample| &sample.rays);
    let mut seen: Vec<_> = rays
        .flat_map(|ray| {
            let step = ray.step.as_ref().map(|step| format!("{:?}", step.outcome));
            let lobe = ray.lobe.map(|lobe| format!("{lobe:?}"));
            let sample = ray
                .shadow
                .as_ref()
                .and_then(|shadow| shadow.sample.as_ref());
            let source = sample.map(|sample| format!("{:?} sample", sample.source));
            [Some(format!("{:?}", ray.kind)), step, lobe, source]
                .into_iter()
                .flatten()
        })
        .collect();
    seen.sort();
    seen.dedup();
    seen
}

#[test]
fn contributions_of_paths_add_up_to_the_pixels() {
    let few = |samples| RenderSettings {
        filter: Filter::Mitchell,
        filter_radius: 2.0,
        ..paths(samples, (48, 36), 16)
    };
    let adaptive = RenderSettings {
        antialias: glimray::scene::Antialias::Adaptive,
        noise: 0.1,
        ..paths(16, (48, 36), 6)
    };
    let clamped = RenderSettings {
        clamp_indirect: Some(0.05),
        ..paths(8, (48, 36), 8)
    };
    let scenes = [
        (
            "box",
            asset("cornell_box.toml"),
            paths(8, (48, 36), 16),
            "Diffuse Boundary Roulette",
        ),
        (
            "glass",
            scenes::mirrors_and_glass(),
            few(8),
            "Boundary Refraction Light sample",
        ),
        ("sky", under_the_sky(), few(8), "Environment sample"),
        (
            "mesh",
            under_a_mesh(),
            paths(8, (48, 36), 2),
            "Emitter sample Limit",
        ),
        (
            "holes",
            behind_holes(),
            paths(8, (48, 36), 16),
            "Passage Passed",
        ),
        ("adaptive", asset("cornell_box.toml"), adaptive, "Diffuse"),
        (
            "catcher",
            on_a_catcher(),
            RenderSettings {
                backdrop: Backdrop::Transparent,
                ..paths(8, (48, 36), 8)
            },
            "Light sample Refraction Reflection",
        ),
        (
            "flower",
            asset("flower.glb"),
            paths(2, (30, 40), 8),
            "Glossy Passage",
        ),
        ("clamped", asset("cornell_box.toml"), clamped, ""),
    ];
    assert_none(scenes.into_iter().map(|(name, scene, settings, expected)| {
        let (trees, values) = explained(&scene, &settings, 200);
        for (tree, value) in trees.iter().zip(&values) {
            let shapes = tree.samples.iter().map(check_shape);
            let of_path = |sample| match settings.clamp_indirect {
                None => check_path(sample, &scene),
                Some(_) => Ok(()),
            };
            let numbers = tree.samples.iter().map(of_path);
            let mut checks = shapes.chain([check_sums(tree, *value)]).chain(numbers);
            if let Some(Err(problem)) = checks.find(Result::is_err) {
                return Err(format!("{name} at {:?}: {problem}", tree.pixel));
            }
        }
        let seen = seen(&trees).join(", ");
        println!("{name}: {seen}");
        match expected.split(' ').all(|word| seen.contains(word)) {
            true => Ok(()),
            false => Err(format!("{name} has {seen}, expected {expected}")),
        }
    }));
}

/// All rays at the first surface of paths, with the normal and the direction to the camera there.
fn first_surfaces(trees: &[RayTree]) -> impl Iterator<Item = (&TracedRay, &TracedRay)> {
    trees
        .iter()
        .flat_map(|tree| &tree.samples)
        .flat_map(|sample| {
            let first = &sample.rays[0];
            (first.children.iter()).map(move |&child| (first, &sample.rays[child]))
        })
}

/// The density per steradian of a point that is uniform over a plane of this area, seen from a distance.
fn density(area: f64, normal: DVec3, direction: DVec3, distance: f64) -> f64 {
    distance * distance / (area * normal.dot(direction).abs())
}

/// The density of a direction to the light of 0.8 by 0.6 at height 1.2: rectangles are sampled evenly over their solid
/// angle, triangles over their area.
fn expected(source: LightSource, origin: &[f64; 3], direction: DVec3, distance: f64) -> f64 {
    match source {
        LightSource::Light => 1.0 / solid_angle(origin),
        _ => density(0.8 * 0.6, DVec3::Y, direction, distance),
    }
}

/// The solid angle of that light, by the closed form for a rectangle above a corner.
fn solid_angle([x, y, z]: &[f64; 3]) -> f64 {
    let height = 1.2 - y;
    let corner =
        |u: f64, v: f64| (u * v / (height * (u * u + v * v + height * height).sqrt())).atan();
    let along = |u: f64| corner(u, -0.2 - z) - corner(u, -0.8 - z);
    along(0.8 - x) - along(-x)
}

#[test]
fn densities_on_a_matte_floor_are_those_of_closed_forms() {
    let mut verdict = Verdict::on("a matte floor");
    let albedo = 0.6;
    let mut mesh = lit_floor(matte(albedo), lamp(false));
    mesh.lights.clear();
    let placed = DAffine3::from_scale_rotation_translation(
        dvec3(0.4, 1.0, 0.3),
        glam::DQuat::IDENTITY,
        dvec3(0.4, 1.2, -0.5),
    );
    glowing_square(&mut mesh, placed, 3.0);
    let lit = lit_floor(matte(albedo), lamp(true));
    for (name, scene, source) in [
        ("lamp", lit, LightSource::Light),
        ("mesh", mesh, LightSource::Emitter),
    ] {
        let (trees, _) = explained(&scene, &paths(64, (12, 8), 4), 20);
        let (mut samples, mut found) = (0, 0);
        for (_, ray) in first_surfaces(&trees) {
            let direction = DVec3::from(ray.direction);
            let cos = f64::from(albedo) * direction.y / PI;
            if let Some(sample) = ray
                .shadow
                .as_ref()
                .and_then(|shadow| shadow.sample.as_ref())
            {
                let sharing = ray.sharing.expect("two densities");
                let distance = (1.2 - ray.origin[1]) / direction.y;
                let expected = expected(source, &ray.origin, direction, distance);
                verdict.that(format!("{name}: source"), sample.source == source, || {
                    format!("{sample:?}")
                });
                let light = f64::from(sharing.light_pdf.expect("a lamp of some size"));
                verdict.that(
                    format!("{name}: light"),
                    close(light, expected, 1e-3),
                    || format!("{light}, expected {expected}"),
                );
                let path = f64::from(sharing.bsdf_pdf.expect("a matte surface"));
                verdict.that(
                    format!("{name}: path"),
                    close(path, direction.y / PI, 1e-4),
                    || path,
                );
                let bsdf = sample.bsdf;
                verdict.that(
                    format!("{name}: BSDF"),
                    alike(bsdf, DVec3::splat(cos), 1e-4),
                    || format!("{bsdf:?}"),
                );
                samples += 1;
            } else if ray.hit.as_ref().is_some_and(|hit| hit.emission != [0.0; 3]) {
                let sharing = ray.sharing.expect("two densities");
                let distance = ray.hit.as_ref().expect("a hit").distance;
                let expected = expected(source, &ray.origin, direction, distance);
                let light = f64::from(sharing.light_pdf.expect("a lamp of some size"));
                verdict.that(format!("{name}: hit"), close(light, expected, 1e-3), || {
                    format!("{light}, expected {expected}")
                });
                found += 1;
            }
        }
        verdict.that(
            format!("{name}: count"),
            samples > 1000 && found > 50,
            || format!("{samples} samples, {found} hits"),
        );
    }
    verdict.close();
}

/// The reflected fraction of even light, by the midpoint rule.
fn albedo(wo: DVec3, alpha: f64) -> f64 {
    let (rows, columns) = (200, 100);
    let cell = |k: usize| {
        let (row, column) = (k / columns, k % columns);
        let cos = (row as f64 + 0.5) / rows as f64;
        let phi = (column as f64 + 0.5) / columns as f64 * 2.0 * PI;
        let sin = (1.0 - cos * cos).sqrt();
        ggx(
            wo,
            dvec3(sin * phi.cos(), sin * phi.sin(), cos),
            [alpha, alpha, 0.0, 0.0],
        )[0]
    };
    2.0 * PI / (rows * columns) as f64 * (0..rows * columns).map(cell).sum::<f64>()
}

/// Phong's material as the page on path tracing says: microfacets over a diffuse body, with the light that
/// they scatter several times.
#[test]
fn values_on_a_glossy_floor_are_those_of_formulas() {
    let mut verdict = Verdict::on("a glossy floor");
    let (body, specular, shininess) = (0.5, 3.0, 20.0);
    let material = Material {
        bsdf: Phong {
            specular: Vec3::splat(specular as f32),
            shininess: shininess as f32,
            ..matte(body as f32).classical().into_owned()
        }
        .into(),
        ..matte(body as f32)
    };
    let (trees, _) = explained(&lit_floor(material, lamp(true)), &paths(4, (12, 8), 2), 20);
    let alpha = 1.0 / (2.0 * shininess + 1.0_f64).sqrt();
    let reflectance = 2.0 * specular / (shininess + 1.0);
    let mut lobes = Vec::new();
    for (first, ray) in first_surfaces(&trees) {
        // The floor's normal is y; the lobes are isotropic, so any frame does.
        let frame = |v: DVec3| dvec3(v.x, v.z, v.y);
        let (wo, wi) = (
            frame(-DVec3::from(first.direction)),
            frame(DVec3::from(ray.direction)),
        );
        let even = albedo(wo, alpha);
        let leaves = even.sqrt();
        let again = reflectance * leaves / (1.0 - reflectance * (1.0 - leaves));
        let boost = 1.0 + again * (1.0 - even) / even;
        let glossy = boost * even * reflectance;
        let diffuse = (1.0 - glossy) * body;
        let [value, visible] = ggx(wo, wi, [alpha, alpha, 0.0, 0.0]);
        let expected = diffuse * wi.z / PI + value * boost * reflectance;
        let chance = diffuse / (diffuse + glossy);
        let expected_pdf = chance * wi.z / PI + (1.0 - chance) * visible;
        let (bsdf, pdf) = match (&ray.shadow, &first.step) {
            (Some(shadow), _) => {
                let sample = shadow.sample.as_ref().expect("a light sample");
                (
                    sample.bsdf,
                    ray.sharing.and_then(|sharing| sharing.bsdf_pdf),
                )
            }
            (None, Some(step)) => {
                lobes.extend(step.lobe);
                (step.bsdf.expect("a choice"), step.pdf)
            }
            (None, None) => continue,
        };
        let what = if ray.shadow.is_some() {
            "light sample"
        } else {
            "step"
        };
        let found = (f64::from(bsdf[1]), f64::from(pdf.expect("a density")));
        // The tables of albedos are interpolated.
        let is_near = close(found.0, expected, 0.01) && close(found.1, expected_pdf, 0.01);
        verdict.that(what, is_near, || {
            format!("{found:?}, expected {expected}, {expected_pdf}")
        });
    }
    let count = |lobe: Lobe| lobes.iter().filter(|&&one| one == lobe).count();
    let counts = (count(Lobe::Diffuse), count(Lobe::Glossy));
    verdict.that("both lobes", counts.0 > 10 && counts.1 > 10, || {
        format!("{counts:?}")
    });
    verdict.close();
}
