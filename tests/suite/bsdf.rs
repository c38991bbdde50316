//! The lobes of the path tracer in `shaders/lib`: samples follow their density, values are those of the papers'
//! formulas, light goes both ways alike, and no energy is gained.

mod boundary;
mod check;
mod mixture;
pub mod reference;
mod walk;

use crate::support::verdict::Verdict;
use check::{Lobe, Wide};
use glam::DVec3;
use std::f64::consts::PI;

const DIFFUSE: Lobe = Lobe {
    name: "diffuse",
    imports: "import package::lib::bsdf_diffuse::{diffuse_eval, diffuse_sample};",
    eval: "vec2f(diffuse_eval(wi))",
    sample: "diffuse_sample(u)",
    reference: |_, wi, _| [wi.z.max(0.0) / PI; 2],
    transmits: false,
};

const GGX: Lobe = Lobe {
    name: "GGX",
    imports: "import package::lib::bsdf_ggx::{ggx_eval, ggx_normal};
        fn mirror(wo: vec3f, h: vec3f) -> vec3f { return normalize(2.0 * dot(wo, h) * h - wo); }",
    eval: "ggx_eval(wo, wi, p.xy, p.z > 0.5)",
    sample: "mirror(wo, ggx_normal(wo, p.xy, u))",
    reference: reference::ggx,
    transmits: false,
};

const TRANSMISSION: Lobe = Lobe {
    name: "transmission",
    imports: "import package::lib::bsdf_ggx::ggx_normal;
        import package::lib::bsdf_ggx_transmission::ggx_transmission;
        import package::lib::fresnel::{fresnel, refracted};
        fn bend(wo: vec3f, h: vec3f, eta: f32) -> vec3f {
            let boundary = fresnel(clamp(dot(wo, h), 0.0, 1.0), eta);
            let through = refracted(-wo, h, eta, boundary.cos_t);
            return select(through, vec3f(0.0, 0.0, 1.0), boundary.total);
        }",
    eval: "ggx_transmission(wo, wi, p.xy, p.z)",
    sample: "bend(wo, ggx_normal(wo, p.xy, u), p.z)",
    reference: reference::transmission,
    transmits: true,
};

const SHEEN: Lobe = Lobe {
    name: "sheen",
    imports: "import package::lib::bsdf_sheen::{sheen_eval, sheen_sample};",
    eval: "sheen_eval(wo, wi, p.x)",
    sample: "sheen_sample(u)",
    reference: reference::sheen,
    transmits: false,
};

const ROUGH: [Wide; 5] = [
    [0.1, 0.1, 0.0, 0.0],
    [0.5, 0.5, 1.0, 0.0],
    [1.0, 1.0, 0.0, 0.0],
    [0.6, 0.15, 0.0, 0.0],
    [0.2, 0.9, 1.0, 0.0],
];

const GLASS: [Wide; 5] = [
    [0.1, 0.1, 1.0 / 1.5, 0.0],
    [0.1, 0.1, 1.5, 0.0],
    [0.5, 0.5, 1.0 / 1.33, 0.0],
    [1.0, 0.4, 1.5, 0.0],
    [0.3, 0.8, 1.0 / 2.4, 0.0],
];

const CLOTH: [Wide; 4] = [
    [0.04, 0.0, 0.0, 0.0],
    [0.1, 0.0, 0.0, 0.0],
    [0.4, 0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0, 0.0],
];

fn same(p: Wide) -> (Wide, f64) {
    (p, 1.0)
}

/// From the other side of the boundary, where the unscaled BSDF is multiplied with the square of the relative index.
fn other_side([x, y, eta, w]: Wide) -> (Wide, f64) {
    ([x, y, 1.0 / eta, w], eta * eta)
}

/// A metal without compensation, at the ends of its parameters.
fn sharp(third: f64) -> Vec<Wide> {
    [[1e-4, 1e-4], [1e-4, 1.0], [1.0, 1e-4], [1.0, 1.0]]
        .map(|[x, y]| [x, y, third, 0.0])
        .to_vec()
}

#[test]
fn white_diffuse_surfaces_reflect_everything_evenly() {
    let mut verdict = Verdict::on("bsdf_diffuse");
    let none = [[0.0; 4]];
    DIFFUSE.check_samples(&mut verdict, &none);
    DIFFUSE.check_values(&mut verdict, &none);
    DIFFUSE.check_reciprocity(&mut verdict, &none, same);
    DIFFUSE.check_limits(&mut verdict, &none);
    let albedo = DIFFUSE.albedo(DVec3::Z, none[0]);
    verdict.that("albedo", (albedo - 1.0).abs() < 1e-3, || albedo);
    verdict.close();
}

#[test]
fn microfacets_reflect_as_heitz_says() {
    let mut verdict = Verdict::on("bsdf_ggx");
    let mut narrow = ROUGH.to_vec();
    narrow.extend([[0.02, 0.02, 0.0, 0.0], [0.02, 0.5, 1.0, 0.0]]);
    GGX.check_values(&mut verdict, &narrow);
    GGX.check_reciprocity(&mut verdict, &narrow, same);
    let mut ends = sharp(0.0);
    ends.extend(sharp(1.0));
    GGX.check_limits(&mut verdict, &ends);
    verdict.close();
}

#[test]
fn reflected_directions_follow_their_density() {
    let mut verdict = Verdict::on("ggx_normal");
    GGX.check_samples(&mut verdict, &ROUGH);
    verdict.close();
}

#[test]
fn microfacets_refract_as_walter_says() {
    let mut verdict = Verdict::on("bsdf_ggx_transmission");
    TRANSMISSION.check_values(&mut verdict, &GLASS);
    TRANSMISSION.check_reciprocity(&mut verdict, &GLASS, other_side);
    for eta in [1.0 / 2.4, 0.999, 1.5] {
        TRANSMISSION.check_limits(&mut verdict, &sharp(eta));
    }
    verdict.close();
}

#[test]
fn refracted_directions_follow_their_density() {
    let mut verdict = Verdict::on("ggx_transmission");
    TRANSMISSION.check_samples(&mut verdict, &GLASS);
    verdict.close();
}

#[test]
fn the_normal_between_two_sides_refracts_one_to_the_other() {
    use crate::support::{harness::gpu, random::Random};
    let mut random = Random::new(11);
    let mut verdict = Verdict::on("transmission_half");
    let mut rows = Vec::new();
    for _ in 0..20_000 {
        let [wo, wi] = [0; 2].map(|_| random.direction());
        let (wo, wi) = (wo * wo.z.signum(), wi * -wi.z.signum());
        let eta = random.between(0.4, 2.5);
        let [o, i] = [wo, wi].map(|w| w.as_vec3().to_array());
        rows.push((o, i, eta as f32));
    }
    let found: Vec<[f32; 3]> = gpu().map("lib::bsdf_ggx_transmission::transmission_half", &rows);
    for ((wo, wi, eta), h) in rows.iter().zip(found) {
        let [wo, wi, h] = [*wo, *wi, h].map(|w| DVec3::from(w.map(f64::from)));
        let eta = f64::from(*eta);
        // Snell's law: tangential parts are opposite and in proportion to the indices. It has a solution with wo on the
        // side of the normal and wi behind it, or the directions are too far apart. The normal may be below the surface.
        let sum = eta * wo + wi;
        let sine = sum.cross(h).length();
        let bent = wo.dot(-wi) < eta.min(1.0 / eta) || sum.z * (eta - 1.0) < 0.0;
        let is_valid = h.z > 0.0 && wo.dot(h) > 0.0 && wi.dot(h) < 0.0 && sine < 1e-5;
        let is_near = (wo.dot(-wi) - eta.min(1.0 / eta)).abs().min(sum.z.abs()) < 1e-5;
        verdict.that(
            format!("{wo} and {wi}, eta {eta}"),
            is_near || if bent { h == DVec3::ZERO } else { is_valid },
            || format!("{h}"),
        );
    }
    verdict.close();
}

#[test]
fn sheen_is_that_of_estevez_and_kulla() {
    let mut verdict = Verdict::on("bsdf_sheen");
    SHEEN.check_values(&mut verdict, &CLOTH);
    SHEEN.check_reciprocity(&mut verdict, &CLOTH, same);
    SHEEN.check_samples(&mut verdict, &CLOTH);
    SHEEN.check_limits(&mut verdict, &[[1e-4, 0.0, 0.0, 0.0], [1.0, 0.0, 0.0, 0.0]]);
    verdict.close();
}
