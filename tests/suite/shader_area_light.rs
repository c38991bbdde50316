//! `lib/area_light.wesl`: the light from one point of a rectangle, a disc or a sphere.

use crate::support::{
    harness::gpu,
    random::Random,
    statistics::square_points,
    types::Incident,
    verdict::{Tolerance, Verdict},
};
use glam::DVec3;
use glimray::layout::{
    ATTENUATION_INVERSE_SQUARE, ATTENUATION_NONE, LIGHT_DISC, LIGHT_RECTANGLE, LIGHT_SPHERE,
    PackedLight,
};
use glimray_shader_test::Plain;

const COLOR: [f32; 3] = [8.0, 4.0, 1.0];

/// Size 1 at the origin, emitting downwards.
fn light(kind: u32) -> Plain<PackedLight> {
    Plain(PackedLight {
        kind,
        direction: [0.0, -1.0, 0.0],
        edge_u: [1.0, 0.0, 0.0],
        edge_v: [0.0, 0.0, 1.0],
        radius: 1.0,
        attenuation: ATTENUATION_INVERSE_SQUARE,
        color: COLOR,
        sample_count: 1,
        ..Default::default()
    })
}

fn arriving(rows: &[(Plain<PackedLight>, [f32; 3], [f32; 2])]) -> Vec<Incident> {
    gpu().map("lib::area_light::area_incident", rows)
}

fn wide(v: [f32; 3]) -> DVec3 {
    DVec3::from(v.map(f64::from))
}

#[test]
fn the_middle_of_a_light_shines_like_a_point_light_there() {
    let mut verdict = Verdict::on("area_incident");
    // u = 1/2 is the middle of a flat light and the nearest point of a sphere.
    for (kind, distance) in [
        (LIGHT_RECTANGLE, 4.0),
        (LIGHT_DISC, 4.0),
        (LIGHT_SPHERE, 3.0),
    ] {
        let p = [0f32, -4.0, 0.0];
        let got = &arriving(&[(light(kind), p, [0.5, 0.5])])[0];
        let strength = if kind == LIGHT_SPHERE {
            // All directions in the cone of a sphere have the same weight: its solid angle over π, R = 1.
            2.0 * (1.0 - (1.0 - 1.0 / 16.0f64).sqrt())
        } else {
            1.0 / 16.0
        };
        let name = format!("light {kind}");
        verdict.near(
            &name,
            &got.direction,
            &[0.0, 1.0, 0.0],
            Tolerance::Absolute(1e-7),
        );
        verdict.near(&name, &got.distance, &distance, Tolerance::Relative(5e-6));
        verdict.near(
            &name,
            &got.radiance,
            &COLOR.map(|c| strength * f64::from(c)),
            Tolerance::Relative(1e-6),
        );
    }
    verdict.close();
}

#[test]
fn segments_end_just_short_of_the_lights_surface() {
    let mut random = Random::new(1);
    let mut rows = Vec::new();
    for u in square_points(3000, 2) {
        for kind in [LIGHT_RECTANGLE, LIGHT_DISC, LIGHT_SPHERE] {
            let p = random.in_cube() * 10f64.powf(random.between(-0.5, 2.0));
            rows.push((light(kind), p.as_vec3().to_array(), u));
        }
    }
    let mut verdict = Verdict::on("area_incident");
    for ((light, p, u), got) in rows.iter().zip(arriving(&rows)) {
        let (p, t) = (wide(*p), f64::from(got.distance));
        let direction = wide(got.direction).normalize();
        // The distance to the light's own surface, at its front or from inside.
        let surface = if light.kind == LIGHT_SPHERE {
            let (b, c) = (p.dot(direction), p.length_squared() - 1.0);
            let root = (b * b - c).max(0.0).sqrt();
            if c > 0.0 { -b - root } else { -b + root }
        } else {
            -p.y / direction.y
        };
        let name = format!("light {} from {p} at {u:?}", light.kind);
        let end = p + surface * direction;
        let within = match light.kind {
            LIGHT_RECTANGLE => end.abs().max_element() < 1.0 + 1e-4,
            _ => end.length() < 1.0 + 1e-4,
        };
        verdict.that(format!("{name}: aims at the light"), within, || {
            format!("{end}")
        });
        // At a grazing angle a rounding error moves the hit far along the ray.
        let steep = if light.kind == LIGHT_SPHERE {
            -end.dot(direction) * if p.length() > 1.0 { 1.0 } else { -1.0 }
        } else {
            direction.y.abs()
        };
        if steep > 0.05 && surface > 1e-3 {
            verdict.that(format!("{name}: ends before it"), t < surface, || {
                format!("{t} of {surface}")
            });
            let gap = surface - t;
            let most = 1e-5 * (p.length() + 3.0) / steep;
            verdict.that(format!("{name}: and not long before"), gap <= most, || {
                format!("{gap}, at most {most}")
            });
        }
    }
    verdict.close();
}

/// Each sample stands for the solid angle that is the reciprocal of its density, so their mean is that of the light.
#[test]
fn densities_of_samples_add_up_to_the_solid_angle_of_the_light() {
    use std::f64::consts::PI;
    let mut verdict = Verdict::on("area_density");
    for height in [0.5f64, 1.5, 6.0] {
        let away = (1.0 + height * height).sqrt();
        for (kind, expected) in [
            // Squares of side 2 and discs of radius 1 around the axis, and a ball of radius 1.
            (LIGHT_RECTANGLE, 4.0 * (1.0 / (away * away)).asin()),
            (LIGHT_DISC, 2.0 * PI * (1.0 - height / away)),
            (
                LIGHT_SPHERE,
                if height < 1.0 {
                    4.0 * PI
                } else {
                    2.0 * PI * (1.0 - (1.0 - 1.0 / (height * height)).sqrt())
                },
            ),
        ] {
            let p = [0.0, -height as f32, 0.0];
            let points = square_points(4096, 3);
            let rows: Vec<_> = points.iter().map(|u| (light(kind), p, *u)).collect();
            let hits: Vec<_> = (arriving(&rows).iter())
                .map(|to| (light(kind), p, to.direction, to.distance))
                .collect();
            let densities: Vec<f32> = gpu().map("lib::area_light::area_density", &hits);
            let sum: f64 = densities
                .iter()
                .map(|density| 1.0 / f64::from(*density))
                .sum();
            let found = sum / densities.len() as f64;
            verdict.near(
                format!("light {kind} at {height}"),
                &(found as f32),
                &expected,
                Tolerance::Relative(0.01),
            );
        }
    }
    verdict.close();
}

#[test]
fn flat_lights_shine_on_the_side_of_their_normal_only() {
    let mut verdict = Verdict::on("area_incident");
    for kind in [LIGHT_RECTANGLE, LIGHT_DISC] {
        let rows: Vec<_> = square_points(200, 3)
            .into_iter()
            .map(|u| (light(kind), [0.3f32, 2.0, -0.4], u))
            .collect();
        for got in arriving(&rows) {
            verdict.near(
                format!("light {kind} from behind"),
                &got.radiance,
                &[0.0; 3],
                Tolerance::Exact,
            );
        }
    }
    verdict.close();
}

#[test]
fn without_attenuation_every_point_shines_alike_on_all_sides() {
    let mut random = Random::new(4);
    let mut verdict = Verdict::on("area_incident");
    for kind in [LIGHT_RECTANGLE, LIGHT_DISC, LIGHT_SPHERE] {
        let classical = Plain(PackedLight {
            attenuation: ATTENUATION_NONE,
            ..*light(kind)
        });
        let rows: Vec<_> = square_points(500, 5)
            .into_iter()
            .map(|u| (classical, (random.in_cube() * 20.0).as_vec3().to_array(), u))
            .collect();
        for got in arriving(&rows) {
            verdict.near(
                format!("light {kind}"),
                &got.radiance,
                &COLOR.map(f64::from),
                Tolerance::Exact,
            );
        }
    }
    verdict.close();
}

/// The mean of strength times the cosine with `n` over a lattice of sample points.
fn irradiance(light: Plain<PackedLight>, p: [f32; 3], n: DVec3) -> f64 {
    const SIDE: u32 = 128;
    let middle = |i: u32| (i as f32 + 0.5) / SIDE as f32;
    let rows: Vec<_> = (0..SIDE * SIDE)
        .map(|i| (light, p, [middle(i % SIDE), middle(i / SIDE)]))
        .collect();
    let term = |got: Incident| f64::from(got.radiance[2]) * wide(got.direction).dot(n).max(0.0);
    arriving(&rows).into_iter().map(term).sum::<f64>() / f64::from(SIDE * SIDE)
}

#[test]
fn far_away_every_light_is_a_point_light() {
    let mut verdict = Verdict::on("area_incident");
    for kind in [LIGHT_RECTANGLE, LIGHT_DISC, LIGHT_SPHERE] {
        for direction in [
            DVec3::NEG_Y,
            DVec3::new(0.6, -0.8, 0.0),
            DVec3::new(0.0, -0.28, 0.96),
        ] {
            for distance in [1e2, 1e4, 1e7] {
                let p = direction * distance;
                let facing = if kind == LIGHT_SPHERE {
                    1.0
                } else {
                    -direction.y
                };
                let got = irradiance(light(kind), p.as_vec3().to_array(), -direction)
                    * distance
                    * distance;
                let name = format!("light {kind} at {distance} along {direction}");
                verdict.that(name, (got / facing - 1.0).abs() < 4e-4, || {
                    format!("{got}, expected {facing}")
                });
            }
        }
    }
    verdict.close();
}

#[test]
fn points_on_a_light_and_lights_without_size_give_defined_values() {
    let mut rows = Vec::new();
    for kind in [LIGHT_RECTANGLE, LIGHT_DISC, LIGHT_SPHERE] {
        for attenuation in [ATTENUATION_NONE, ATTENUATION_INVERSE_SQUARE] {
            for size in [1f32, 1e-20, 0.0] {
                for p in [
                    [0f32; 3],
                    [1.0, 0.0, 0.0],
                    [0.0, -1.0, 0.0],
                    [0.5, 0.0, 0.0],
                    [1e-25, 0.0, 0.0],
                ] {
                    for u in [
                        [0f32, 0.0],
                        [0.5, 0.5],
                        [0.75, 0.5],
                        [0.99999994, 0.99999994],
                    ] {
                        let light = Plain(PackedLight {
                            attenuation,
                            edge_u: [size, 0.0, 0.0],
                            edge_v: [0.0, 0.0, size],
                            radius: size,
                            ..*light(kind)
                        });
                        rows.push((light, p, u));
                    }
                }
            }
        }
    }
    let mut verdict = Verdict::on("area_incident");
    for ((light, p, u), got) in rows.iter().zip(arriving(&rows)) {
        let name = format!(
            "light {} of size {} seen from {p:?} at {u:?}",
            light.kind, light.radius
        );
        let finite = got
            .direction
            .iter()
            .chain(&got.radiance)
            .all(|c| c.is_finite());
        verdict.that(
            &name,
            finite && got.distance.is_finite() && got.distance >= 0.0,
            || format!("{got:?}"),
        );
        let length = wide(got.direction).length();
        verdict.that(&name, (length - 1.0).abs() < 1e-6, || format!("{got:?}"));
        verdict.that(&name, got.radiance.iter().all(|c| *c >= 0.0), || {
            format!("{got:?}")
        });
    }
    verdict.close();
}
