//! Level 3: `lib/light.wesl`, the light from point, directional and spot lights.

use crate::support::{
    harness::gpu,
    types::{Incident, T_FAR},
    verdict::{Tolerance, Verdict},
};
use glimray::layout::{
    ATTENUATION_INVERSE_SQUARE, ATTENUATION_NONE, LIGHT_DIRECTIONAL, LIGHT_POINT, LIGHT_SPOT,
    PackedLight,
};
use glimray_shader_test::Plain;

const TOLERANCE: Tolerance = Tolerance::Relative(4e-7);

fn light(kind: u32, position: [f32; 3], attenuation: u32) -> Plain<PackedLight> {
    let direction = [0.0, -1.0, 0.0];
    Plain(PackedLight {
        kind,
        position,
        direction,
        attenuation,
        color: [8.0, 4.0, 1.0],
        ..Default::default()
    })
}

#[test]
fn lights_arrive_with_direction_distance_and_strength() {
    let at = |position| light(LIGHT_POINT, position, ATTENUATION_NONE);
    let fading = |position| light(LIGHT_POINT, position, ATTENUATION_INVERSE_SQUARE);
    let sun = light(LIGHT_DIRECTIONAL, [5.0, 5.0, 5.0], ATTENUATION_NONE);
    // Full only on its axis, zero where the cosine is below 0.6.
    let spot = |position| {
        Plain(PackedLight {
            cos_inner: 1.0,
            cos_outer: 0.6,
            ..*light(LIGHT_SPOT, position, ATTENUATION_NONE)
        })
    };
    let fading_spot = |position| {
        Plain(PackedLight {
            attenuation: ATTENUATION_INVERSE_SQUARE,
            ..*spot(position)
        })
    };
    let (up, far) = ([0.0, 1.0, 0.0], f64::from(T_FAR));
    let rgb = |strength: f64| [8.0, 4.0, 1.0].map(|c: f64| c * strength);
    let o = [0f32; 3];
    #[rustfmt::skip]
    let rows = [
        ("a point light above", at([0.0, 2.0, 0.0]), o, up, 2.0, rgb(1.0)),
        ("its strength without attenuation does not depend on distance", at([0.0, 1e6, 0.0]), o, up, 1e6, rgb(1.0)),
        ("3-4-5", at([3.0, 4.0, 0.0]), o, [0.6, 0.8, 0.0], 5.0, rgb(1.0)),
        ("2-3-6 and 7, seen from elsewhere", at([3.0, 4.0, 7.0]), [1.0, 1.0, 1.0], [2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0], 7.0, rgb(1.0)),
        ("a quarter at distance 2", fading([0.0, 2.0, 0.0]), o, up, 2.0, rgb(0.25)),
        ("four times at distance 1/2", fading([0.0, 0.5, 0.0]), o, up, 0.5, rgb(4.0)),
        ("1/25 at 3-4-5", fading([3.0, 4.0, 0.0]), o, [0.6, 0.8, 0.0], 5.0, rgb(0.04)),
        ("the sun comes from above wherever one stands", sun, o, up, far, rgb(1.0)),
        ("the sun has no position", sun, [5.0, 5.0, 5.0], up, far, rgb(1.0)),
        ("a spot's axis", spot([0.0, 2.0, 0.0]), o, up, 2.0, rgb(1.0)),
        ("halfway between the cones' cosines: a half", spot([3.0, 4.0, 0.0]), o, [0.6, 0.8, 0.0], 5.0, rgb(0.5)),
        ("outside a spot's cone", spot([2.0, 1.0, 0.0]), o, [0.8f64.sqrt(), 0.2f64.sqrt(), 0.0], 5f64.sqrt(), rgb(0.0)),
        ("behind a spot", spot([0.0, -2.0, 0.0]), o, [0.0, -1.0, 0.0], 2.0, rgb(0.0)),
        ("a spot that fades", fading_spot([0.0, 2.0, 0.0]), o, up, 2.0, rgb(0.25)),
    ];
    let inputs: Vec<_> = rows.iter().map(|&(_, light, p, ..)| (light, p)).collect();
    let arriving: Vec<Incident> = gpu().map("lib::light::incident", &inputs);
    let mut verdict = Verdict::on("incident");
    for ((name, .., direction, distance, radiance), got) in rows.iter().zip(&arriving) {
        verdict.near(
            format!("{name}: direction"),
            &got.direction,
            direction,
            TOLERANCE,
        );
        verdict.near(
            format!("{name}: distance"),
            &got.distance,
            distance,
            TOLERANCE,
        );
        verdict.near(
            format!("{name}: radiance"),
            &got.radiance,
            radiance,
            Tolerance::Absolute(1e-5),
        );
    }
    verdict.close();
}

#[test]
fn a_light_at_the_point_itself_gives_none_and_nothing_undefined() {
    let mut verdict = Verdict::on("incident");
    for p in [[0f32; 3], [1e-40, 0.0, 0.0], [1e6, -1e6, 3.0]] {
        for kind in [LIGHT_POINT, LIGHT_SPOT] {
            for attenuation in [ATTENUATION_NONE, ATTENUATION_INVERSE_SQUARE] {
                let light = light(kind, p, attenuation);
                let got = &gpu().map::<_, Incident>("lib::light::incident", &[(light, p)])[0];
                let name = format!("light {kind} with attenuation {attenuation} at {p:?}");
                let unit = [0.0, 1.0, 0.0];
                verdict.near(
                    format!("{name}: radiance"),
                    &got.radiance,
                    &[0.0; 3],
                    Tolerance::Exact,
                );
                verdict.near(
                    format!("{name}: direction"),
                    &got.direction,
                    &unit,
                    Tolerance::Exact,
                );
                verdict.near(
                    format!("{name}: distance"),
                    &got.distance,
                    &0.0,
                    Tolerance::Exact,
                );
            }
        }
    }
    verdict.close();
}

#[test]
fn spots_fade_between_their_cones() {
    #[rustfmt::skip]
    gpu().check("lib::light::spot_falloff", Tolerance::Absolute(1e-6), &[
        ("on the axis", (1f32, 0.8f32, 0.4f32), 1.0),
        ("on the inner cone", (0.8, 0.8, 0.4), 1.0),
        ("halfway in the cosine", (0.6, 0.8, 0.4), 0.5),
        ("a quarter of the way", (0.5, 0.8, 0.4), 5.0 / 32.0),
        ("three quarters of the way", (0.7, 0.8, 0.4), 27.0 / 32.0),
        ("on the outer cone", (0.4, 0.8, 0.4), 0.0),
        ("outside", (0.3, 0.8, 0.4), 0.0),
        ("behind", (-1.0, 0.8, 0.4), 0.0),
        ("equal cones: just inside", (0.501, 0.5, 0.5), 1.0),
        ("equal cones: just outside", (0.499, 0.5, 0.5), 0.0),
        ("equal cones: on the edge it is dark", (0.5, 0.5, 0.5), 0.0),
        ("a cone of no angle lights only its axis", (1.0, 1.0, 1.0), 0.0),
        ("a cone of 180° lights everything", (-0.999, -1.0, -1.0), 1.0),
    ]);
}
