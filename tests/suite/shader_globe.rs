//! `lib/intersect/globe.wesl` and its packing: huge spheres seen from nearby, against the exact sphere of the
//! scene.

use crate::reference::{
    compare::{render, sized},
    scenes::{self, Build},
};
use crate::support::{
    harness::gpu,
    random::Random,
    types::{Candidate, ray},
    verdict::{Tolerance, Verdict},
};
use glam::{DVec3, Vec3, dvec3};
use glimray::{
    layout::{PackedShape, SHAPE_GLOBE, SHAPE_SPHERE},
    pack,
    scene::{Attenuation, Light, LightKind, Scene},
};
use glimray_shader_test::Plain;

/// Half a step of f32 at 1.
const ROUNDING: f64 = f32::EPSILON as f64 / 2.0;
const RADII: [f64; 7] = [1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9];
/// Heights of the camera above or below the ground: exact in f64 next to each of the radii.
const HEIGHTS: [f64; 6] = [0.0078125, 0.125, 2.0, 50.0, -0.125, -2.0];

/// A scene with one sphere of this radius, whose surface is `height` below the camera.
fn ground(radius: f64, height: f64, up: DVec3) -> Scene {
    let mut scene = scenes::empty();
    scene.ambient = Vec3::ZERO;
    let camera = &mut scene.cameras[0];
    camera.look_from = dvec3(3.0, -5.0, 4.0);
    camera.look_at = camera.look_from + up.any_orthonormal_vector();
    camera.up = up;
    let center = camera.look_from - (radius + height) * up;
    scene.add_sphere(center, radius, 0);
    scene
}

fn packed(scene: &Scene) -> Plain<PackedShape> {
    let packed = pack::scene(scene).expect("a scene that can be packed");
    Plain(packed.shapes[0])
}

/// The distance to the sphere from `height` above its top; `cosine` is that of the angle between the ray and
/// the downward direction. Nothing cancels in it.
fn distance_to_ground(radius: f64, height: f64, cosine: f64) -> Option<f64> {
    let b = (radius + height) * cosine;
    let c = height * (2.0 * radius + height);
    let discriminant = b * b - c;
    if discriminant < 0.0 || (b <= 0.0 && c >= 0.0) {
        return None;
    }
    let root = discriminant.sqrt();
    Some(if c >= 0.0 {
        c / (b + root)
    } else if b >= 0.0 {
        b + root
    } else {
        // From inside and upwards.
        -c / (root - b)
    })
}

#[test]
fn spheres_with_a_surface_near_the_camera_are_packed_as_globes() {
    let mut verdict = Verdict::on("kinds of spheres");
    for (radius, height, kind) in [
        (1.0, 1.0, SHAPE_SPHERE),
        (10.0, 1.0, SHAPE_SPHERE),
        (20.0, 1.0, SHAPE_GLOBE),
        (20.0, -1.0, SHAPE_GLOBE),
        (1e9, 2.0, SHAPE_GLOBE),
        (1e6, 1e6, SHAPE_SPHERE),
        (1e6, -1e6, SHAPE_SPHERE),
    ] {
        let shape = packed(&ground(radius, height, DVec3::Y));
        verdict.that(
            format!("radius {radius}, height {height}"),
            shape.kind == kind,
            || shape.kind,
        );
    }
    verdict.close();
}

#[test]
fn a_globe_is_hit_where_the_exact_sphere_is() {
    const HIT: &str = "
        import package::types::PackedShape;
        import package::types::tracing::{Candidate, Ray};
        import package::lib::intersect::globe::intersect_globe;
        fn probe(shape: PackedShape, ray: Ray) -> Candidate {
            return intersect_globe(ray, shape.position, shape.row_y, shape.size0);
        }
    ";
    let mut random = Random::new(31);
    let mut rows = Vec::new();
    for radius in RADII {
        for height in HEIGHTS {
            for up in [DVec3::X, DVec3::Y, DVec3::NEG_Z] {
                let shape = packed(&ground(radius, height, up));
                for _ in 0..100 {
                    let aside = up.cross(random.direction()).normalize();
                    let cosine = 10f64.powf(random.between(-3.0, 0.0));
                    let sign = if random.below(4) == 0 { 1.0 } else { -1.0 };
                    let way = aside * (1.0 - cosine * cosine).sqrt() + sign * cosine * up;
                    let direction = way.as_vec3();
                    rows.push((radius, height, up, (shape, ray([0.0; 3], direction.into()))));
                }
            }
        }
    }
    let inputs: Vec<_> = rows.iter().map(|row| row.3).collect();
    let found: Vec<Candidate> = gpu().map_source(HIT, &inputs);
    let mut verdict = Verdict::on("globes");
    for ((radius, height, up, (_, ray)), got) in rows.iter().zip(&found) {
        let direction = DVec3::from(ray.direction.map(f64::from));
        let cosine = -direction.dot(*up) / direction.length();
        let name = format!("radius {radius}, height {height}, cosine {cosine}");
        let Some(t) = distance_to_ground(*radius, *height, cosine) else {
            // The f32 height may be off by its rounding: rays that pass the horizon by less are ignored.
            let missed = distance_to_ground(*radius, height * (1.0 - 1e-5), cosine).is_none();
            verdict.that(name, !got.hit || !missed, || format!("{got:?}, none"));
            continue;
        };
        // The cosine at which the ray hits the ground there.
        let slope = ((radius + height) * cosine - t).abs() / radius;
        let error = (f64::from(got.t) * direction.length() - t).abs();
        // Rounding of the anchor, of the normal, of the products; and of the radius in f64.
        let most = 16.0 * ROUNDING * (t + height.abs()) + 1e-15 * radius;
        let is_horizon = slope * slope * radius < 1e-4 * height.abs();
        verdict.that(
            name,
            is_horizon || (got.hit && error * slope <= most),
            || format!("{got:?}, expected {t}, off by {} of {most}", error * slope),
        );
    }
    verdict.close();
}

#[test]
fn a_ray_from_far_away_hits_a_globe_where_the_exact_sphere_is() {
    const HIT: &str = "
        import package::types::PackedShape;
        import package::types::tracing::{Candidate, Ray};
        import package::lib::intersect::globe::intersect_globe;
        fn probe(shape: PackedShape, ray: Ray) -> Candidate {
            return intersect_globe(ray, shape.position, shape.row_y, shape.size0);
        }
    ";
    let mut random = Random::new(32);
    let mut rows = Vec::new();
    for radius in [1e3, 1e6, 1e9] {
        let shape = packed(&ground(radius, 2.0, DVec3::Y));
        let center = DVec3::NEG_Y * (radius + 2.0);
        for i in 0..600 {
            let distance = radius * 10f64.powf(random.between(0.1, 3.0));
            let origin = (center + distance * random.direction()).as_vec3();
            let target = center + 0.95 * radius * random.direction() * random.between(0.0, 1.0);
            let direction = (target - origin.as_dvec3()).normalize().as_vec3();
            rows.push((
                i,
                radius,
                center,
                (shape, ray(origin.into(), direction.into())),
            ));
        }
    }
    let inputs: Vec<_> = rows.iter().map(|row| row.3).collect();
    let found: Vec<Candidate> = gpu().map_source(HIT, &inputs);
    let mut verdict = Verdict::on("globes from afar");
    for ((i, radius, center, (_, ray)), got) in rows.iter().zip(&found) {
        let f = DVec3::from(ray.origin.map(f64::from)) - *center;
        let d = DVec3::from(ray.direction.map(f64::from)).normalize();
        let nearest = f - f.dot(d) * d;
        let half_chord = (radius * radius - nearest.length_squared()).max(0.0).sqrt();
        let t = -f.dot(d) - half_chord;
        let error = (f64::from(got.t) - t).abs() * half_chord / radius;
        let most = 16.0 * ROUNDING * (f.length() + radius);
        verdict.that(
            format!("ray {i}, radius {radius}"),
            got.hit && error <= most,
            || format!("{got:?}, expected {t}, off by {error} of {most}"),
        );
    }
    verdict.close();
}

#[test]
fn a_ray_that_leaves_a_globe_starts_close_to_it_and_does_not_hit_it_again() {
    // The distance from `reached` to the new origin, or -1 where the globe is hit again.
    const LEAVE: &str = "
        import package::types::{NONE, NO_INSTANCE, PackedShape};
        import package::types::tracing::Ray;
        import package::lib::intersect::globe::{globe_point, intersect_globe};
        import package::lib::offset::offset_origin;
        fn probe(shape: PackedShape, reached: vec3f, aside: vec3f, cosine: f32) -> f32 {
            let at = globe_point(shape, reached);
            let tangent = normalize(aside - dot(aside, at.ng) * at.ng);
            let direction = normalize(tangent * sqrt(1.0 - cosine * cosine) + cosine * at.ng);
            let origin = offset_origin(at.p, at.error, at.ng, direction);
            let ray = Ray(origin, 3e38, direction, NONE, NO_INSTANCE);
            let again = intersect_globe(ray, shape.position, shape.row_y, shape.size0);
            return select(length(origin - reached), -1.0, again.hit & (dot(at.ng, direction) > 0.0));
        }
    ";
    let mut random = Random::new(33);
    let mut rows = Vec::new();
    for radius in RADII {
        for height in [0.0078125, 2.0, 50.0] {
            let up = random.direction();
            let shape = packed(&ground(radius, height, up));
            for i in 0..2000 {
                // From under the camera to the far side.
                let fraction = 10f64.powf(random.between(-9.0, 0.0));
                let turned = (up + 2.0 * fraction * random.direction()).normalize();
                let center = -(radius + height) * up;
                let reached = (center + radius * turned).as_vec3();
                let cosine = match i % 10 {
                    0 => 1e-6,
                    _ => 10f64.powf(random.between(-6.0, 0.0)),
                };
                let aside = random.direction().as_vec3();
                rows.push((shape, reached.to_array(), aside.to_array(), cosine as f32));
            }
        }
    }
    let moved: Vec<f32> = gpu().map_source(LEAVE, &rows);
    let mut verdict = Verdict::on("rays that leave a globe");
    for ((shape, reached, _, cosine), moved) in rows.iter().zip(&moved) {
        let from_camera = Vec3::from(*reached).length() + Vec3::from(shape.position).length();
        // The point itself is rounded, and so is the surface.
        let most = 256.0 * ROUNDING * f64::from(from_camera);
        verdict.that(
            format!("radius {}, {reached:?}, cosine {cosine}", 1.0 / shape.size0),
            (0.0..=most).contains(&f64::from(*moved)),
            || format!("moved by {moved}, {most} allowed (-1: hit again)"),
        );
    }
    verdict.close();
}

/// The picture of a lamp above the ground, pixel by pixel: diffuse · intensity · cos θ / d².
#[test]
fn the_ground_of_a_huge_sphere_is_lit_as_its_closed_form_says() {
    let (width, height_px) = (64u32, 48u32);
    let (intensity, above_ground) = (9.0, 3.0);
    let mut verdict = Verdict::on("pictures of a lamp above a huge sphere");
    for radius in [1e3, 1e6, 1e9] {
        for height in [0.0078125, 2.0] {
            let mut scene = ground(radius, height, DVec3::Y);
            let camera = &mut scene.cameras[0];
            camera.look_at = camera.look_from + dvec3(0.0, -0.01, -4.0);
            camera.fov_y = 0.7;
            let camera = camera.clone();
            let lamp = camera.look_from + dvec3(0.0, above_ground - height, -4.0);
            scene.lights.push(Light {
                kind: LightKind::Point { position: lamp },
                color: Vec3::splat(intensity as f32),
                attenuation: Attenuation::InverseSquare,
                ..Light::default()
            });
            let (picture, _) = render(&scene, &sized(width, height_px));
            let forward = (camera.look_at - camera.look_from).normalize();
            let right = forward.cross(DVec3::Y).normalize();
            let up = right.cross(forward);
            let reach = (camera.fov_y / 2.0).tan();
            let aspect = f64::from(width) / f64::from(height_px);
            for y in 0..height_px {
                for x in 0..width {
                    let across = (f64::from(x) + 0.5) / f64::from(width) * 2.0 - 1.0;
                    let upwards = 1.0 - (f64::from(y) + 0.5) / f64::from(height_px) * 2.0;
                    let way = forward + reach * (across * aspect * right + upwards * up);
                    let way = way.normalize();
                    let expected = match distance_to_ground(radius, height, -way.y) {
                        None => 0.2,
                        Some(t) => {
                            let p = t * way;
                            let normal = DVec3::Y + (p + height * DVec3::Y) / radius;
                            let to_lamp = lamp - camera.look_from - p;
                            let cosine = normal.normalize().dot(to_lamp.normalize()).max(0.0);
                            0.8 * intensity * cosine / to_lamp.length_squared()
                        }
                    };
                    let got = picture.pixels[(y * width + x) as usize][0];
                    verdict.near(
                        format!("radius {radius}, height {height}, pixel {x},{y}"),
                        &got,
                        &expected,
                        Tolerance::Absolute(1.0 / 255.0),
                    );
                }
            }
        }
    }
    verdict.close();
}
