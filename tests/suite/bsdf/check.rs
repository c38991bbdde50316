//! Checks of a lobe: samples against the density, energy, reciprocity and limits.

use crate::support::{
    harness::gpu,
    random::Random,
    statistics::{check_counts, square_points},
    verdict::Verdict,
};
use glam::DVec3;
use std::f64::consts::{PI, TAU};

/// A lobe in WESL, and its formulas in f64. Parameters are four numbers `p`.
pub struct Lobe {
    pub name: &'static str,
    /// Import statements of the expressions.
    pub imports: &'static str,
    /// The value and the density for `wo`, `wi` and `p`.
    pub eval: &'static str,
    /// A direction wi for `wo`, `p` and `u`.
    pub sample: &'static str,
    /// The value and the density.
    pub reference: fn(DVec3, DVec3, [f64; 4]) -> [f64; 2],
    /// Whether wi is below the surface.
    pub transmits: bool,
}

/// Samples of each direction and parameter.
const SAMPLES: usize = 60_000;
/// Bins of √(1 - |cos θ|) over the hemisphere, and of angles.
const BINS: [usize; 2] = [16, 32];

/// How often a cell of an integral is divided.
const DEPTH: u32 = 7;

pub type Wide = [f64; 4];

/// A direction of the hemisphere, as the f32 that shaders get.
pub fn direction(cos: f64, phi: f64) -> DVec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    DVec3::new(sin * phi.cos(), sin * phi.sin(), cos)
}

fn narrow(w: DVec3) -> [f32; 3] {
    w.as_vec3().to_array()
}

fn wide(w: [f32; 3]) -> DVec3 {
    DVec3::from(w.map(f64::from))
}

/// Directions of light at which lobes are checked.
pub fn views() -> Vec<DVec3> {
    [(1.0, 0.0), (0.8, 0.7), (0.3, -2.0), (0.08, 1.2)]
        .map(|(cos, phi)| direction(cos, phi))
        .to_vec()
}

impl Lobe {
    pub fn evaluate(&self, rows: &[(DVec3, DVec3, Wide)]) -> Vec<[f32; 2]> {
        let source = format!(
            "{} fn probe(wo: vec3f, wi: vec3f, p: vec4f) -> vec2f {{ return {}; }}",
            self.imports, self.eval
        );
        let rows: Vec<_> = rows
            .iter()
            .map(|(wo, wi, p)| (narrow(*wo), narrow(*wi), p.map(|x| x as f32)))
            .collect();
        gpu().map_source(&source, &rows)
    }

    /// `SAMPLES` directions.
    fn sample(&self, wo: DVec3, p: Wide) -> Vec<DVec3> {
        let source = format!(
            "{} fn probe(wo: vec3f, p: vec4f, u: vec2f) -> vec3f {{ return {}; }}",
            self.imports, self.sample
        );
        let rows: Vec<_> = square_points(SAMPLES, 7)
            .into_iter()
            .map(|u| (narrow(wo), p.map(|x| x as f32), u))
            .collect();
        let found: Vec<[f32; 3]> = gpu().map_source(&source, &rows);
        found.into_iter().map(wide).collect()
    }

    /// The integral of the value or the density (`part`) over a cell of √(1 - |cos θ|), which is finer around the
    /// normal, and angles.
    fn integral(&self, part: usize, wo: DVec3, p: Wide, roots: [f64; 2], angles: [f64; 2]) -> f64 {
        let side = if self.transmits { -1.0 } else { 1.0 };
        let f = |root: f64, phi| {
            let wi = direction(side * (1.0 - root * root), phi);
            2.0 * root * (self.reference)(wo, wi, p)[part]
        };
        refined(&f, roots, angles, DEPTH)
    }

    /// The fraction of light from `wo` that the lobe scatters, by the formulas.
    pub fn albedo(&self, wo: DVec3, p: Wide) -> f64 {
        let mut sum = 0.0;
        for i in 0..8 {
            for j in 0..16 {
                let roots = [i, i + 1].map(|i| f64::from(i) / 8.0);
                let angles = [j, j + 1].map(|j| TAU * f64::from(j) / 16.0);
                sum += self.integral(0, wo, p, roots, angles);
            }
        }
        sum
    }

    /// [`Self::check_samples_towards`] all views.
    pub fn check_samples(&self, verdict: &mut Verdict, parameters: &[Wide]) {
        for &p in parameters {
            for wo in views() {
                self.check_samples_towards(verdict, wo, p);
            }
        }
    }

    /// Samples follow the density: Pearson's χ² test over bins of directions. Their weights have the albedo as
    /// their mean, which is at most 1.
    pub fn check_samples_towards(&self, verdict: &mut Verdict, wo: DVec3, p: Wide) {
        let wo = wide(narrow(wo));
        let name = format!("{} {p:?} towards {wo:.3}", self.name);
        let found = self.sample(wo, p);
        let unit = found.iter().map(|w| (w.length() - 1.0).abs());
        let off = unit.fold(0.0, f64::max);
        verdict.that(format!("{name}: unit length"), off < 1e-6, || off);
        self.check_bins(verdict, &name, wo, p, &found);
        let rows: Vec<_> = found.iter().map(|&wi| (wo, wi, p)).collect();
        let weights: Vec<f64> = self
            .evaluate(&rows)
            .iter()
            .map(|[value, pdf]| f64::from(value / pdf.max(1e-30)))
            .collect();
        let count = weights.len() as f64;
        let mean = weights.iter().sum::<f64>() / count;
        let spread = weights.iter().map(|w| (w - mean).powi(2)).sum::<f64>() / count;
        let room = 4.0 * (spread / count).sqrt() + 1e-3;
        let albedo = self.albedo(wo, p);
        verdict.that(
            format!("{name}: albedo"),
            (mean - albedo).abs() < room && albedo < 1.002,
            || format!("{mean} of samples, {albedo} of the formulas, room {room}"),
        );
    }

    fn check_bins(&self, verdict: &mut Verdict, name: &str, wo: DVec3, p: Wide, found: &[DVec3]) {
        let mut counts = vec![0_u32; BINS[0] * BINS[1] + 1];
        let outside = counts.len() - 1;
        for w in found {
            let is_lost = (w.z < 0.0) != self.transmits;
            counts[if is_lost { outside } else { bin_of(*w, BINS) }] += 1;
        }
        let mut expected: Vec<f64> = (0..outside)
            .map(|bin| {
                let (row, column) = (bin / BINS[1], bin % BINS[1]);
                let roots = [row, row + 1].map(|row| row as f64 / BINS[0] as f64);
                let angles =
                    [column, column + 1].map(|column| TAU * column as f64 / BINS[1] as f64);
                SAMPLES as f64 * self.integral(1, wo, p, roots, angles)
            })
            .collect();
        let inside: f64 = expected.iter().sum();
        verdict.that(
            format!("{name}: the density adds up to at most 1"),
            inside < 1.003 * SAMPLES as f64,
            || inside / SAMPLES as f64,
        );
        expected.push((SAMPLES as f64 - inside).max(0.0));
        let (counts, expected) = pooled(&counts, &expected);
        if counts.len() > 1 {
            check_counts(verdict, format!("{name}: bins"), &counts, &expected);
        }
    }

    /// Value and density are those of the formulas.
    pub fn check_values(&self, verdict: &mut Verdict, parameters: &[Wide]) {
        let rows = self.rows(parameters, 4000);
        for ((wo, wi, p), got) in rows.iter().zip(self.evaluate(&rows)) {
            let (wo, wi) = (wide(narrow(*wo)), wide(narrow(*wi)));
            let expected = (self.reference)(wo, wi, p.map(|x| f64::from(x as f32)));
            let is_near = |part: usize| {
                let off = (f64::from(got[part]) - expected[part]).abs();
                off < 2e-3 * expected[part] + 1e-5
            };
            verdict.that(
                format!("{} {p:?} from {wi:.3} to {wo:.3}", self.name),
                is_near(0) && is_near(1),
                || format!("{got:?}, not {expected:?}"),
            );
        }
    }

    /// Light is scattered as much from `wi` to `wo` as back; `reversed` are the parameters for the way back, and what
    /// the value there is divided by.
    pub fn check_reciprocity(
        &self,
        verdict: &mut Verdict,
        parameters: &[Wide],
        reversed: fn(Wide) -> (Wide, f64),
    ) {
        let rows = self.rows(parameters, 2000);
        let back: Vec<_> = rows
            .iter()
            .map(|&(wo, wi, p)| {
                // The frame of the other side: turned about x.
                let flip = if self.transmits {
                    DVec3::new(1.0, -1.0, -1.0)
                } else {
                    DVec3::ONE
                };
                (wi * flip, wo * flip, reversed(p).0)
            })
            .collect();
        let there = self.evaluate(&rows);
        for (((wo, wi, p), there), back) in rows.iter().zip(there).zip(self.evaluate(&back)) {
            let [f, g] = [
                f64::from(there[0]) / wi.z.abs(),
                f64::from(back[0]) / wo.z.abs() / reversed(*p).1,
            ];
            verdict.that(
                format!("{} {p:?} between {wi:.3} and {wo:.3}", self.name),
                (f - g).abs() < 2e-3 * f.max(g) + 1e-5,
                || format!("{f} and {g}"),
            );
        }
    }

    /// Nothing is negative or not finite at the ends of the parameters and at grazing angles.
    pub fn check_limits(&self, verdict: &mut Verdict, parameters: &[Wide]) {
        let cosines = [1.0, 0.5, 1e-2, 1e-4, 1e-7, 0.0];
        let mut rows = Vec::new();
        for &p in parameters {
            for wo in cosines {
                for wi in cosines.iter().chain(&[-1e-7, -0.5, -1.0]) {
                    for phi in [0.0, 1.0, PI] {
                        let side = if self.transmits { -1.0 } else { 1.0 };
                        rows.push((direction(wo, 0.0), direction(side * wi, phi), p));
                    }
                }
            }
            // The direction back, and the mirrored one.
            rows.push((direction(1.0, 0.0), direction(-1.0, 0.0), p));
            rows.push((direction(0.5, 0.0), -direction(0.5, 0.0), p));
            for cos in [1.0, 0.5, 1e-2, 1e-4] {
                let found = self.sample(direction(cos, 0.3), p);
                rows.extend(
                    found
                        .iter()
                        .take(500)
                        .map(|&wi| (direction(cos, 0.3), wi, p)),
                );
                let is_finite = found.iter().all(|w| (w.length() - 1.0).abs() < 1e-5);
                verdict.that(
                    format!("{} {p:?}: samples at {cos}", self.name),
                    is_finite,
                    || "not unit",
                );
            }
        }
        for ((wo, wi, p), got) in rows.iter().zip(self.evaluate(&rows)) {
            let is_good = got.iter().all(|x| x.is_finite() && *x >= 0.0);
            let is_other_side = (wi.z < 0.0) != self.transmits && wi.z != 0.0;
            verdict.that(
                format!("{} {p:?} from {wi} to {wo}", self.name),
                is_good && (!is_other_side || got[0] == 0.0),
                || format!("{got:?}"),
            );
        }
    }

    /// Random directions, not quite grazing.
    fn rows(&self, parameters: &[Wide], count: usize) -> Vec<(DVec3, DVec3, Wide)> {
        let mut random = Random::new(3);
        let side = if self.transmits { -1.0 } else { 1.0 };
        let mut rows = Vec::new();
        for &p in parameters {
            rows.extend((0..count).map(|_| {
                let mut next = || direction(random.between(0.02, 1.0), random.between(0.0, TAU));
                let (wo, wi) = (next(), next());
                (wo, DVec3::new(wi.x, wi.y, side * wi.z), p)
            }));
        }
        rows
    }
}

/// The integral over a cell: the midpoint and the trapezoidal rule on 8 × 8 parts, on quarters of the cell where they
/// differ. The latter sees an edge of the integrand close to that of the cell.
fn refined(f: &impl Fn(f64, f64) -> f64, x: [f64; 2], y: [f64; 2], depth: u32) -> f64 {
    const PARTS: usize = 8;
    let step = [x, y].map(|[from, to]| (to - from) / PARTS as f64);
    let at = |i: f64, j: f64| f(x[0] + i * step[0], y[0] + j * step[1]);
    let (mut middles, mut corners) = (0.0, 0.0);
    for i in 0..=PARTS {
        for j in 0..=PARTS {
            let weight = |i| if i == 0 || i == PARTS { 0.5 } else { 1.0 };
            let (u, v) = (i as f64, j as f64);
            corners += weight(i) * weight(j) * at(u, v);
            if i < PARTS && j < PARTS {
                middles += at(u + 0.5, v + 0.5);
            }
        }
    }
    let [middles, corners] = [middles, corners].map(|sum| sum * step[0] * step[1]);
    if depth == 0 || (middles - corners).abs() < 2e-3 * middles + 2e-8 {
        return (2.0 * middles + corners) / 3.0;
    }
    let middle = [0.5 * (x[0] + x[1]), 0.5 * (y[0] + y[1])];
    let mut sum = 0.0;
    for x in [[x[0], middle[0]], [middle[0], x[1]]] {
        for y in [[y[0], middle[1]], [middle[1], y[1]]] {
            sum += refined(f, x, y, depth - 1);
        }
    }
    sum
}

/// The bin of a direction among `rows` of √(1 − |cos θ|) and `columns` of angles, whichever side it is on.
pub fn bin_of(w: DVec3, [rows, columns]: [usize; 2]) -> usize {
    let row = (1.0 - w.z.abs()).max(0.0).sqrt() * rows as f64;
    let column = w.y.atan2(w.x).rem_euclid(TAU) / TAU * columns as f64;
    (row as usize).min(rows - 1) * columns + (column as usize).min(columns - 1)
}

/// Bins in which fewer than 10 samples are expected are joined.
pub fn pooled(counts: &[u32], expected: &[f64]) -> (Vec<u32>, Vec<f64>) {
    let (mut rare, mut rare_expected) = (0, 0.0);
    let (mut many, mut many_expected) = (Vec::new(), Vec::new());
    for (&count, &expected) in counts.iter().zip(expected) {
        if expected < 10.0 {
            rare += count;
            rare_expected += expected;
        } else {
            many.push(count);
            many_expected.push(expected);
        }
    }
    if rare_expected >= 5.0 {
        many.push(rare);
        many_expected.push(rare_expected);
    }
    (many, many_expected)
}
