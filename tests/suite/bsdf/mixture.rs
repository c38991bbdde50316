//! `scene/bsdf.wesl`, which chooses among the lobes of a surface: its directions follow the density that it states.

use super::check::{bin_of, direction, pooled};
use crate::support::{
    harness::{gpu, probe},
    random::Random,
    statistics::check_counts,
    verdict::Verdict,
};
use glam::DVec3;
use glimray_shader_test::Shader;
use std::f64::consts::TAU;

const SAMPLES: usize = 60_000;
/// Bins of √(1 − |cos θ|) over each side, and of angles; and the points along each side of a bin where densities are taken.
const BINS: [usize; 2] = [12, 24];
const POINTS: usize = 8;

/// A surface with the normal z, as the chances of its lobes and what they need.
struct Surface {
    name: &'static str,
    /// Statements that complete `bsdf`.
    lobes: &'static str,
    /// Whether the density is in proportion to what is stated, whose factor is a table's.
    is_scaled: bool,
}

const SURFACES: [Surface; 5] = [
    Surface {
        name: "diffuse under gloss",
        lobes: "bsdf.chances = vec3f(0.4, 0.6, 0.0);",
        is_scaled: false,
    },
    Surface {
        name: "coat and sheen over both, with light that passes",
        lobes: "bsdf.chances = vec3f(0.35, 0.25, 0.0);
            bsdf.coating_chances = vec2f(0.25, 0.15);
            bsdf.through = vec3f(0.2, 0.3, 0.1);
            bsdf.coating.coat = 1.0;
            bsdf.coating.coat_alpha = 0.3;
            bsdf.coating.sheen = vec3f(0.4);
            bsdf.coating.sheen_alpha = 0.5;",
        is_scaled: false,
    },
    Surface {
        name: "rough glass, seen from outside",
        lobes: "bsdf.chances = vec3f(0.0, 0.0, 1.0);
            bsdf.boundary.eta = 1.0 / 1.5;
            bsdf.boundary.bends = true;",
        is_scaled: true,
    },
    Surface {
        name: "rough glass, seen from inside",
        lobes: "bsdf.chances = vec3f(0.0, 0.0, 1.0);
            bsdf.boundary.eta = 1.5;
            bsdf.boundary.bends = true;",
        is_scaled: true,
    },
    Surface {
        name: "a rough wall",
        lobes: "bsdf.chances = vec3f(0.0, 0.0, 1.0);
            bsdf.boundary.eta = 1.0 / 1.5;",
        is_scaled: true,
    },
];

impl Surface {
    /// A function `probe` of these parameters, with all lobes switched on.
    fn probe(&self, parameters: &str, result: &str, body: &str) -> Shader {
        let source = format!(
            "import package::scene::bsdf::{{bsdf_eval, bsdf_sample}};
            import package::scene::lobes::Bsdf;
            import package::types::MATERIAL_FRESNEL;
            fn surface(wo: vec3f) -> Bsdf {{
                var bsdf: Bsdf;
                bsdf.normal = vec3f(0.0, 0.0, 1.0);
                bsdf.ng = bsdf.normal;
                bsdf.x = vec3f(1.0, 0.0, 0.0);
                bsdf.y = vec3f(0.0, 1.0, 0.0);
                bsdf.wo = wo;
                bsdf.diffuse = vec3f(0.5);
                bsdf.f0 = vec3f(0.2);
                bsdf.f90 = vec3f(1.0);
                bsdf.gain = vec3f(1.0);
                bsdf.alpha = vec2f(0.6, 0.3);
                bsdf.boundary.reflect = vec3f(1.0);
                bsdf.boundary.transmit = vec3f(1.0);
                bsdf.boundary.alpha = vec2f(0.4);
                bsdf.boundary.gain = 1.0;
                bsdf.boundary.flags = MATERIAL_FRESNEL;
                {}
                return bsdf;
            }}
            fn probe({parameters}) -> {result} {{ {body} }}",
            self.lobes
        );
        let flags = [
            "HAS_COATINGS",
            "HAS_GLOSS",
            "HAS_REFRACTION",
            "HAS_ROUGH_GLASS",
        ];
        let set = |shader: Shader, flag: &&str| shader.set(flag, 1.0);
        flags.iter().fold(probe(&source), set)
    }

    /// Directions that are drawn for `wo`; `None` for those that scatter nothing.
    fn draw(&self, wo: DVec3) -> Vec<Option<DVec3>> {
        let body = "let found = bsdf_sample(surface(wo), u.x, u.yz);
            return vec4f(found.direction, select(0.0, 1.0, any(found.weight > vec3f(0.0))));";
        let source = self.probe("wo: vec3f, u: vec3f", "vec4f", body);
        let mut random = Random::new(5);
        let mut number = || random.between(0.0, 1.0).min(0.999_999_9) as f32;
        let rows: Vec<_> = (0..SAMPLES)
            .map(|_| (wo.as_vec3().to_array(), [number(), number(), number()]))
            .collect();
        let found: Vec<[f32; 4]> = gpu().map_shader(&source, &rows);
        let direction = |[x, y, z, is_kept]: [f32; 4]| {
            (is_kept > 0.0).then(|| DVec3::from([x, y, z].map(f64::from)))
        };
        found.into_iter().map(direction).collect()
    }

    /// The integral of the stated density for `wo` over each bin: of the upper side, then of the lower.
    fn integrals(&self, wo: DVec3) -> Vec<f64> {
        let source = self.probe(
            "wo: vec3f, wi: vec3f",
            "f32",
            "return bsdf_eval(surface(wo), wi).pdf;",
        );
        let (mut rows, mut areas) = (Vec::new(), Vec::new());
        let step = |count: usize| 1.0 / (count * POINTS) as f64;
        for (side, row, column) in bins() {
            for (i, j) in (0..POINTS).flat_map(|i| (0..POINTS).map(move |j| (i, j))) {
                let root = ((row * POINTS + i) as f64 + 0.5) * step(BINS[0]);
                let angle = TAU * ((column * POINTS + j) as f64 + 0.5) * step(BINS[1]);
                let wi = direction(side * (1.0 - root * root), angle);
                rows.push((wo.as_vec3().to_array(), wi.as_vec3().to_array()));
                areas.push(2.0 * root * step(BINS[0]) * TAU * step(BINS[1]));
            }
        }
        let found: Vec<f32> = gpu().map_shader(&source, &rows);
        let weighted: Vec<_> = (found.iter().zip(areas))
            .map(|(density, area)| f64::from(*density) * area)
            .collect();
        weighted
            .chunks(POINTS * POINTS)
            .map(|points| points.iter().sum())
            .collect()
    }
}

/// Side, row and column of every bin.
fn bins() -> impl Iterator<Item = (f64, usize, usize)> {
    let places = (0..BINS[0]).flat_map(|row| (0..BINS[1]).map(move |column| (row, column)));
    [1.0, -1.0]
        .into_iter()
        .flat_map(move |side| places.clone().map(move |(row, column)| (side, row, column)))
}

#[test]
fn directions_of_several_lobes_follow_the_density_of_all() {
    let mut verdict = Verdict::on("bsdf_sample");
    for surface in &SURFACES {
        for (cos, phi) in [(0.95, 0.4), (0.6, 2.0), (0.25, -1.0)] {
            let wo = direction(cos, phi);
            let name = format!("{} towards {wo:.2}", surface.name);
            let mut expected = surface.integrals(wo);
            let total: f64 = expected.iter().sum();
            if surface.is_scaled {
                expected.iter_mut().for_each(|part| *part /= total);
            } else {
                verdict.that(
                    format!("{name}: the density adds up"),
                    total < 1.003,
                    || total,
                );
            }
            let inside: f64 = expected.iter().sum();
            expected.push((1.0 - inside).max(0.0));
            expected.iter_mut().for_each(|part| *part *= SAMPLES as f64);

            let mut counts = vec![0_u32; expected.len()];
            for found in surface.draw(wo) {
                let bin = found.map_or(counts.len() - 1, |wi| {
                    let side = if wi.z < 0.0 { BINS[0] * BINS[1] } else { 0 };
                    side + bin_of(wi, BINS)
                });
                counts[bin] += 1;
            }
            let (counts, expected) = pooled(&counts, &expected);
            verdict.that(format!("{name}: bins"), counts.len() > 50, || counts.len());
            check_counts(&mut verdict, format!("{name}: counts"), &counts, &expected);
        }
    }
    verdict.close();
}
