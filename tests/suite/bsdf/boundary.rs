//! The lobes of boundaries and coats, in `shaders/lib/bsdf_boundary.wesl` and `bsdf_coat.wesl`.

use super::check::{Lobe, Wide, views};
use super::reference::{self, REFLECT, TRANSMIT};
use super::same;
use crate::support::{
    harness::gpu,
    verdict::{Tolerance, Verdict},
};
use glam::{DVec3, dvec3};

/// Tinted glass, of which each lobe below is what goes to one side. Its parameters are the width, the relative index,
/// whether transmitted light bends, and the gain, or 0 for separable shadowing.
const GLASS: &str = "import package::types::MATERIAL_FRESNEL;
    import package::lib::bsdf_boundary::{BoundaryLobe, boundary_eval, boundary_sample};
    import package::lib::rng::{hash_combine, unit_float};
    fn glass(p: vec4f) -> BoundaryLobe {
        let gain = select(p.w, 1.0, p.w == 0.0);
        return BoundaryLobe(vec3f(0.9, 0.6, 0.3), vec3f(0.2, 0.5, 0.8), vec2f(p.x), gain, p.y, p.z > 0.5, MATERIAL_FRESNEL);
    }
    fn seen(wo: vec3f, wi: vec3f, p: vec4f, side: f32) -> vec2f {
        let found = boundary_eval(glass(p), wo, wi, p.w == 0.0);
        return select(vec2f(0.0), vec2f(found.value.x, found.pdf), side * wi.z > 0.0);
    }
    fn drawn(wo: vec3f, p: vec4f, u: vec2f, side: f32) -> vec3f {
        let choice = unit_float(hash_combine(bitcast<u32>(u.x), bitcast<u32>(u.y)));
        let found = boundary_sample(glass(p), wo, choice, u, p.w == 0.0);
        let is_kept = (found.wi.z > 0.0) == found.reflects;
        return select(vec3f(0.0, 0.0, -side), found.wi, is_kept);
    }";

const REFLECTED: Lobe = Lobe {
    name: "reflected by glass",
    imports: GLASS,
    eval: "seen(wo, wi, p, 1.0)",
    sample: "drawn(wo, p, u, 1.0)",
    reference: reference::boundary,
    transmits: false,
};

const TRANSMITTED: Lobe = Lobe {
    name: "transmitted by glass",
    imports: GLASS,
    eval: "seen(wo, wi, p, -1.0)",
    sample: "drawn(wo, p, u, -1.0)",
    reference: reference::boundary,
    transmits: true,
};

const SIDES: [Lobe; 2] = [REFLECTED, TRANSMITTED];

/// From outside, from inside, and a wall.
const SURFACES: [[f64; 3]; 5] = [
    [0.1, 1.0 / 1.5, 1.0],
    [0.4, 1.5, 1.0],
    [0.9, 1.0 / 1.33, 1.0],
    [0.1, 1.0 / 2.4, 0.0],
    [0.6, 1.0 / 1.5, 0.0],
];

fn with_gain([alpha, eta, bends]: [f64; 3], gain: f64) -> Wide {
    [alpha, eta, bends, gain]
}

/// From the other side, where the unscaled BSDF is multiplied with the square of the relative index.
fn other_side([alpha, eta, bends, gain]: Wide) -> (Wide, f64) {
    match bends > 0.0 {
        true => ([alpha, 1.0 / eta, bends, gain], eta * eta),
        false => ([alpha, eta, bends, gain], 1.0),
    }
}

const COAT: Lobe = Lobe {
    name: "coat",
    imports: "import package::lib::bsdf_coat::{coat_eval, coat_sample};",
    eval: "coat_eval(wo, wi, p.x, p.y > 0.5)",
    sample: "coat_sample(wo, p.x, u)",
    reference: reference::coat,
    transmits: false,
};

#[test]
fn rough_boundaries_scatter_as_walter_and_fresnel_say() {
    let mut verdict = Verdict::on("bsdf_boundary");
    let parameters: Vec<_> = (SURFACES.iter())
        .flat_map(|surface| [0.0, 1.0, 1.2].map(|gain| with_gain(*surface, gain)))
        .collect();
    for lobe in SIDES {
        lobe.check_values(&mut verdict, &parameters);
        let ends = [1e-4, 1.0].into_iter().flat_map(|alpha| {
            [1.0 / 2.4, 0.999, 1.5].into_iter().flat_map(move |eta| {
                [[1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[bends, gain]| [alpha, eta, bends, gain])
            })
        });
        lobe.check_limits(&mut verdict, &ends.collect::<Vec<_>>());
    }
    REFLECTED.check_reciprocity(&mut verdict, &parameters, same);
    TRANSMITTED.check_reciprocity(&mut verdict, &parameters, other_side);
    verdict.close();
}

/// With the gain that makes up for all that microfacets shadow, the density is that of the light, all of which is scattered.
#[test]
fn directions_of_a_boundary_follow_their_density() {
    let mut verdict = Verdict::on("boundary_sample");
    for surface in SURFACES {
        for wo in views() {
            // Shares that clear glass would scatter.
            let [reflected, transmitted] =
                SIDES.map(|lobe| lobe.albedo(wo, with_gain(surface, 1.0)));
            let gain = 1.0 / (reflected / REFLECT[0] + transmitted / TRANSMIT[0]);
            for lobe in SIDES {
                lobe.check_samples_towards(&mut verdict, wo, with_gain(surface, 0.0));
                lobe.check_samples_towards(&mut verdict, wo, with_gain(surface, gain));
            }
        }
    }
    verdict.close();
}

#[test]
fn smooth_boundaries_scatter_in_two_directions_as_snell_and_fresnel_say() {
    let mut verdict = Verdict::on("smooth_boundary_sample");
    let mut rows = Vec::new();
    for [_, eta, bends] in SURFACES {
        for wo in views() {
            let reflected = reference::reflected_share(reference::fresnel(wo.z, eta));
            // Just below and above the chance of reflection.
            for choice in [0.0, reflected - 2e-3, reflected + 2e-3, 0.9999] {
                if (0.0..1.0).contains(&choice) {
                    let wo = wo.as_vec3().to_array();
                    rows.push((wo, choice as f32, [eta as f32, bends as f32]));
                }
            }
        }
    }
    let probe = |call: &str| {
        format!(
            "import package::types::MATERIAL_FRESNEL;
            import package::lib::bsdf_boundary::{{BoundaryLobe, boundary_sample, smooth_boundary_sample}};
            fn glass(p: vec2f, alpha: f32) -> BoundaryLobe {{
                let reflect = vec3f(0.9, 0.6, 0.3);
                let transmit = vec3f(0.2, 0.5, 0.8);
                return BoundaryLobe(reflect, transmit, vec2f(alpha), 1.0, p.x, p.y > 0.5, MATERIAL_FRESNEL);
            }}
            fn probe(wo: vec3f, choice: f32, p: vec2f) -> array<f32, 5> {{
                let found = {call};
                return array(found.wi.x, found.wi.y, found.wi.z, found.fraction.y, select(0.0, 1.0, found.reflects));
            }}"
        )
    };
    let known: Vec<[f32; 5]> = gpu().map_source(
        &probe("smooth_boundary_sample(glass(p, 0.0), wo, choice)"),
        &rows,
    );
    let smooth = probe("boundary_sample(glass(p, 0.0), wo, choice, vec2f(0.3, 0.6), false)");
    let found: Vec<[f32; 5]> = gpu().map_source(&smooth, &rows);
    let narrow = probe("boundary_sample(glass(p, 1e-4), wo, choice, vec2f(0.3, 0.6), true)");
    let nearly: Vec<[f32; 5]> = gpu().map_source(&narrow, &rows);
    for (((row, known), found), nearly) in rows.iter().zip(known).zip(found).zip(nearly) {
        let (wo, choice, [eta, bends]) = *row;
        let wo = DVec3::from(wo.map(f64::from));
        let name = format!("{row:?}");
        let fresnel = reference::fresnel(wo.z, f64::from(eta));
        let share = reference::reflected_share(fresnel);
        let reflects = f64::from(choice) < share;
        let expected = match (reflects, bends > 0.5) {
            (true, _) => dvec3(-wo.x, -wo.y, wo.z),
            (false, false) => -wo,
            (false, true) => {
                let sine = f64::from(eta) * dvec3(-wo.x, -wo.y, 0.0);
                sine - DVec3::Z * (1.0 - sine.length_squared()).max(0.0).sqrt()
            }
        };
        let direction = |[x, y, z, ..]: [f32; 5]| dvec3(x.into(), y.into(), z.into());
        let off = (direction(known) - expected).length();
        verdict.that(format!("{name}: direction"), off < 1e-5, || off);
        verdict.that(
            format!("{name}: side"),
            (known[4] == 1.0) == reflects,
            || known[4],
        );
        let fraction = match reflects {
            true => REFLECT[1] * fresnel / share,
            false => TRANSMIT[1] * (1.0 - fresnel) / (1.0 - share),
        };
        let room = Tolerance::Absolute(2e-3);
        verdict.near(format!("{name}: fraction"), &known[3], &fraction, room);
        verdict.that(format!("{name}: the same"), found == known, || {
            format!("{found:?} and {known:?}")
        });
        let apart = (direction(nearly) - expected).length();
        verdict.that(
            format!("{name}: the limit of narrow microfacets"),
            apart < 0.01 && nearly[4] == known[4],
            || apart,
        );
    }
    verdict.close();
}

/// Materials whose fractions do not depend on the angle turn what is totally reflected into reflection, but for `sum` mixing.
#[test]
fn fractions_of_a_boundary_are_those_of_its_material() {
    const ALL: [f64; 2] = [0.3, 0.5];
    let clear = reference::fresnel(0.9, 1.5);
    let fresnel = [0.3 * clear, 0.5 * (1.0 - clear)];
    // Schlick's approximation takes the larger angle, that of the refracted light.
    let cos_t = (1.0 - 1.5 * 1.5 * (1.0 - 0.9 * 0.9_f64)).sqrt();
    let schlick = 0.04 + 0.96 * (1.0 - cos_t).powi(5);
    let approximate = [0.3 * schlick, 0.5 * (1.0 - schlick)];
    let rows: [(&str, f32, u32, u32, [f64; 2]); 7] = [
        ("at any angle", 0.9, 0, 1, ALL),
        ("total reflection", 0.3, 0, 1, [0.8, 0.0]),
        ("by sum mixing", 0.3, 1, 1, [0.3, 0.0]),
        ("through a wall", 0.3, 0, 0, ALL),
        ("by Fresnel's equations", 0.9, 2, 1, fresnel),
        ("totally, by Fresnel's equations", 0.3, 2, 1, [0.3, 0.0]),
        ("by Schlick's approximation", 0.9, 3, 1, approximate),
    ];
    let source = "import package::types::{MATERIAL_FRESNEL, MATERIAL_SCHLICK, MATERIAL_SUM};
        import package::lib::bsdf_boundary::{BoundaryLobe, boundary_split};
        fn probe(cosine: f32, kind: u32, bends: u32) -> vec2f {
            let kinds = array(0u, MATERIAL_SUM, MATERIAL_FRESNEL, MATERIAL_FRESNEL | MATERIAL_SCHLICK);
            let flags = kinds[kind];
            let lobe = BoundaryLobe(vec3f(0.3), vec3f(0.5), vec2f(0.0), 1.0, 1.5, bends == 1u, flags);
            let split = boundary_split(lobe, cosine);
            return vec2f(split.reflect.x, split.transmit.x);
        }";
    let inputs = rows.map(|(_, cosine, kind, bends, _)| (cosine, kind, bends));
    let found: Vec<[f32; 2]> = gpu().map_source(source, &inputs);
    let mut verdict = Verdict::on("boundary_split");
    for ((name, .., expected), found) in rows.iter().zip(found) {
        verdict.near(name, &found, expected, Tolerance::Absolute(1e-6));
    }
    verdict.close();
}

#[test]
fn coats_reflect_as_heitz_and_schlick_say() {
    let mut verdict = Verdict::on("bsdf_coat");
    let parameters = |separable: f64| [0.02, 0.1, 0.5, 1.0].map(|a| [a, separable, 0.0, 0.0]);
    for separable in [0.0, 1.0] {
        COAT.check_values(&mut verdict, &parameters(separable));
        COAT.check_samples(&mut verdict, &parameters(separable)[1..]);
        let ends = [1e-4, 1.0].map(|alpha| [alpha, separable, 0.0, 0.0]);
        COAT.check_limits(&mut verdict, &ends);
    }
    // The specification takes the reflectance from one of the two directions.
    COAT.check_reciprocity(&mut verdict, &parameters(0.0), same);
    let cosines = [1.0, 0.5, 0.0_f64];
    let found: Vec<f32> = gpu().map("lib::bsdf_coat::coat_fresnel", &cosines.map(|c| c as f32));
    for (cosine, found) in cosines.iter().zip(found) {
        let expected = 0.04 + 0.96 * (1.0 - cosine).powi(5);
        let room = Tolerance::Absolute(1e-6);
        verdict.near(format!("at {cosine}"), &found, &expected, room);
    }
    verdict.close();
}
