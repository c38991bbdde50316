//! Computes the tables of directional albedos that `lib/albedo.wesl` reads.

use std::{f64::consts::PI, thread};

/// Entries along each side of a table; `ALBEDO_SIDE` in `lib/albedo.wesl`.
pub const SIDE: usize = 32;

/// Points of an integral over visible normals, and the step between their angles: Fibonacci numbers, whose lattice is
/// even. Many are for round microfacets, and for glass seen from inside, where total reflection begins at an edge.
const FEW: [usize; 2] = [987, 610];
const MANY: [usize; 2] = [2584, 1597];

/// Angles and heights at which the integral of sheen is evaluated.
const ANGLES: usize = 24;
const HEIGHTS: usize = 96;

/// The cosine of the direction at which an integrand of the first column is evaluated, in widths: at 0 itself nothing
/// is seen.
const GRAZING: f64 = 1e-4;

/// The smallest width α of microfacets, and that of sheen, whose integral misses narrower distributions.
const NARROWEST: f64 = 1e-5;
const NARROWEST_SHEEN: f64 = 1e-3;

/// Rows of a table of rough glass, and the number of such tables: `GLASS_ROWS` and `GLASS_SLICES` in `lib/albedo.wesl`.
const GLASS: [usize; 2] = [24, 36];

/// The table of the relative index 1.
const CLEAR: usize = 12;

/// Columns and rows of a table of stretched microfacets, and the number of ratios of their widths, and of azimuths:
/// `STRETCHED_SIZE` and `STRETCHED_SLICES` in `lib/albedo.wesl`.
const STRETCHED: [usize; 4] = [24, 20, 14, 5];

/// All tables: microfacets, then sheen, then rough glass, then stretched microfacets, with rows and columns as
/// `lib/albedo.wesl` looks them up.
pub fn words() -> Vec<u32> {
    let mut words = table(SIDE * SIDE, microfacets_at);
    words.extend(table(SIDE * SIDE, sheen_at));
    words.extend(table(GLASS[1] * GLASS[0] * SIDE, glass_at));
    words.extend(table(STRETCHED.iter().product(), stretched_at));
    words
}

/// The words of a table, computed by all threads.
fn table(len: usize, word_at: impl Fn(usize) -> u32 + Sync) -> Vec<u32> {
    let mut words = vec![0; len];
    let threads = thread::available_parallelism().map_or(1, usize::from);
    let part = len.div_ceil(threads);
    let word_at = &word_at;
    thread::scope(|scope| {
        for (index, words) in words.chunks_mut(part).enumerate() {
            scope.spawn(move || {
                for (place, word) in words.iter_mut().enumerate() {
                    *word = word_at(index * part + place);
                }
            });
        }
    });
    words
}

/// Index `i` of `count` as a number from 0 to 1.
fn fraction(i: usize, count: usize) -> f64 {
    i as f64 / (count - 1) as f64
}

fn microfacets_at(index: usize) -> u32 {
    let alpha = fraction(index / SIDE, SIDE).powi(2).max(NARROWEST);
    let cos_o = cosine(fraction(index % SIDE, SIDE), alpha);
    facet_word(ggx(cos_o, alpha), cos_o)
}

fn sheen_at(index: usize) -> u32 {
    let [cos_o, alpha] = [index % SIDE, index / SIDE].map(|i| fraction(i, SIDE).powi(4));
    let [albedo, most] = sheen(cos_o.max(1e-6), alpha.max(NARROWEST_SHEEN));
    word(albedo, most)
}

fn glass_at(index: usize) -> u32 {
    let [rows, slices] = GLASS;
    let slice = index / (rows * SIDE);
    let steps = match slice < CLEAR {
        true => CLEAR,
        false => slices - 1 - CLEAR,
    };
    let root = (slice as f64 - CLEAR as f64) / steps as f64;
    let amplitude = 0.5 * root * root.abs();
    let eta = (1.0 + amplitude) / (1.0 - amplitude);
    let alpha = fraction(index / SIDE % rows, rows).powi(2).max(NARROWEST);
    let cos_o = glass_cosine(fraction(index % SIDE, SIDE), alpha, eta);
    let [whole, reflected] = glass(cos_o, alpha, eta);
    let share = reflected / whole;
    word(whole, shifted(share - softened(cos_o, alpha, eta)))
}

fn stretched_at(index: usize) -> u32 {
    let [columns, rows, ratios, azimuths] = STRETCHED;
    let wide = fraction(index / columns % rows, rows).powf(1.5);
    let ratio = fraction(index / (columns * rows) % ratios, ratios).powi(2);
    let alpha = [wide, wide * ratio].map(|width| width.max(NARROWEST));
    let cos = 1.0 - fraction(index / (columns * rows * ratios), azimuths);
    let along = azimuth(cos, alpha[1] / alpha[0]);
    let cos_o = stretched_cosine(fraction(index % columns, columns), along, alpha);
    facet_word(stretched(cos_o, along, alpha), cos_o)
}

/// The cosine of a column of microfacets, which is at `place` from 0 to 1: c (1 + 4α)/(c + 4α) is its square.
fn cosine(place: f64, alpha: f64) -> f64 {
    let (square, wide) = (place * place, 4.0 * alpha);
    (square * wide / (1.0 + wide - square)).clamp(GRAZING * alpha, 1.0)
}

/// The azimuth of a table of stretched microfacets: the angle with this cosine has the tangent of the azimuth times
/// `ratio` to the power of 3/4.
fn azimuth(cos: f64, ratio: f64) -> [f64; 2] {
    let (x, y) = (cos * ratio.powf(0.75), (1.0 - cos * cos).sqrt());
    let length = x.hypot(y);
    [x / length, y / length]
}

/// The cosine of a column of stretched microfacets, for a direction with the azimuth `along`. Where slopes are divided by
/// the widths it looks as steep as another direction does at round microfacets of the larger width; with the angle θ of
/// that one, the column is that of microfacets for c = tan(π/4 - θ/2).
fn stretched_cosine(place: f64, along: [f64; 2], alpha: [f64; 2]) -> f64 {
    let seen = (alpha[0] * along[0]).hypot(alpha[1] * along[1]);
    let half = cosine(place, alpha[0]);
    let slope = 0.5 * (1.0 - half * half) / half * alpha[0] / seen;
    (1.0 / 1.0_f64.hypot(slope)).clamp(GRAZING * seen, 1.0)
}

/// The cosine of a column of rough glass, which is at `place` from 0 to 1, by bisection.
fn glass_cosine(place: f64, alpha: f64, eta: f64) -> f64 {
    let critical = (1.0 - 1.0 / (eta * eta)).max(0.0).sqrt();
    let edge = |cos: f64| (1.5 * (cos - critical) / alpha).asinh();
    let place_of = |cos: f64| {
        let grazing = (cos * (1.0 + 4.0 * alpha) / (cos + 4.0 * alpha)).sqrt();
        0.5 * grazing + 0.5 * (edge(cos) - edge(0.0)) / (edge(1.0) - edge(0.0))
    };
    let [mut least, mut most] = [0.0, 1.0];
    for _ in 0..60 {
        let middle = 0.5 * (least + most);
        match place_of(middle) < place {
            true => least = middle,
            false => most = middle,
        }
    }
    (0.5 * (least + most)).max(GRAZING * alpha)
}

/// Fresnel's reflectance with an edge of total reflection that is as soft as rough microfacets make it: that of an angle
/// at which some light is always transmitted.
fn softened(cos_i: f64, alpha: f64, eta: f64) -> f64 {
    let cos2_t = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    let soft = alpha * (eta * eta - 1.0).max(0.0).sqrt();
    let cos2_t = (0.5 * (cos2_t + cos2_t.hypot(soft))).min(1.0);
    fresnel((1.0 - (1.0 - cos2_t) / (eta * eta)).max(0.0).sqrt(), eta)
}

/// A difference from -1 to 1 as a number from 0 to 1.
fn shifted(difference: f64) -> f64 {
    0.5 + 0.5 * difference
}

/// Two half floats.
fn word(low: f64, high: f64) -> u32 {
    u32::from(half(low)) | u32::from(half(high)) << 16
}

/// The word of microfacets that reflect `whole`, of which `grazing` has the weight (1 - cos)⁵.
fn facet_word([whole, grazing]: [f64; 2], cos_o: f64) -> u32 {
    word(whole, shifted(grazing - whole * (1.0 - cos_o).powi(5)))
}

/// The visible normals of microfacets of width `alpha` from a direction in the plane y = 0, as (x, z): Dupuy and
/// Benyoub 2023. Each comes with its weight; the other half circle is their mirror image.
fn visible_normals(
    [sin_o, cos_o]: [f64; 2],
    alpha: f64,
    [count, step]: [usize; 2],
    mut add: impl FnMut([f64; 2], f64),
) {
    let length = (alpha * alpha * sin_o * sin_o + cos_o * cos_o).sqrt();
    let (x, z) = (alpha * sin_o / length, cos_o / length);
    let share = 1.0 / count as f64;
    for i in 0..count {
        let (sin, cos) = (PI * share * ((i * step % count) as f64 + 0.5)).sin_cos();
        // Finer at the lower end, where normals are tilted most.
        let part = share * (i as f64 + 0.5);
        let root = part.sqrt();
        let height = part * root * (1.0 + z) - z;
        let radius = (1.0 - height * height).max(0.0).sqrt();
        let (h_x, h_y, h_z) = (alpha * (radius * cos + x), alpha * radius * sin, height + z);
        let size = (h_x * h_x + h_y * h_y + h_z * h_z).sqrt();
        add([h_x / size, h_z / size], 1.5 * root * share);
    }
}

/// Fresnel's equations for the cosine on the side of the index `eta`, relative to the other.
fn fresnel(cos_i: f64, eta: f64) -> f64 {
    let cos2_t = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
    if cos2_t <= 0.0 {
        return 1.0;
    }
    let cos_t = cos2_t.sqrt();
    let s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (s * s + p * p)
}

/// Smith's Λ for a direction with this cosine.
fn smith(cos: f64, alpha: f64) -> f64 {
    let slope2 = alpha * alpha * (1.0 - cos * cos).max(0.0) / (cos * cos);
    0.5 * ((1.0 + slope2).sqrt() - 1.0)
}

/// The fractions that rough glass reflects and transmits together, and reflects, of light from a direction with cosine
/// `cos_o`; `eta` is the index of refraction on that side divided by that of the other. Reflected light is shadowed at
/// the same height, transmitted light independently, as in `lib/bsdf_ggx_transmission.wesl`.
fn glass(cos_o: f64, alpha: f64, eta: f64) -> [f64; 2] {
    let sin_o = (1.0 - cos_o * cos_o).sqrt();
    let seen = 1.0 + smith(cos_o, alpha);
    let [mut reflected, mut transmitted] = [0.0; 2];
    let points = if eta > 1.0 && alpha > 0.02 { MANY } else { FEW };
    visible_normals([sin_o, cos_o], alpha, points, |[x, z], weight| {
        let cos_h = (sin_o * x + cos_o * z).clamp(0.0, 1.0);
        let part = fresnel(cos_h, eta);
        let up = 2.0 * cos_h * z - cos_o;
        if up > 0.0 {
            reflected += weight * part * seen / (seen + smith(up, alpha));
        }
        let cos_t = (1.0 - eta * eta * (1.0 - cos_h * cos_h)).max(0.0).sqrt();
        let down = eta * cos_o - (eta * cos_h - cos_t) * z;
        if down > 0.0 {
            transmitted += weight * (1.0 - part) / (1.0 + smith(down, alpha));
        }
    });
    [reflected + transmitted, reflected]
}

/// The sum of visible microfacets that reflect light from a direction with cosine `cos_o` out of the surface, weighted
/// with the part that is not shadowed, and the same with the weight (1 - cos)⁵. The distribution is that of Trowbridge
/// and Reitz with Smith's height-correlated shadowing (Heitz 2014).
fn ggx(cos_o: f64, alpha: f64) -> [f64; 2] {
    let sin_o = (1.0 - cos_o * cos_o).sqrt();
    let seen = 1.0 + smith(cos_o, alpha);
    let mut sums = [0.0; 2];
    visible_normals([sin_o, cos_o], alpha, MANY, |[x, z], weight| {
        let cos_h = sin_o * x + cos_o * z;
        let cos_i = 2.0 * cos_h * z - cos_o;
        if cos_i > 0.0 {
            let lit = weight * seen / (seen + smith(cos_i, alpha));
            sums[0] += lit;
            sums[1] += lit * (1.0 - cos_h.clamp(0.0, 1.0)).powi(5);
        }
    });
    sums
}

/// The sums of `ggx` for microfacets of the widths `alpha` along x and y, from a direction with the azimuth `along`.
fn stretched(cos_o: f64, along: [f64; 2], alpha: [f64; 2]) -> [f64; 2] {
    let sin_o = (1.0 - cos_o * cos_o).sqrt();
    let wo = [sin_o * along[0], sin_o * along[1], cos_o];
    let smith = |w: [f64; 3]| {
        let slope2 = ((alpha[0] * w[0]).powi(2) + (alpha[1] * w[1]).powi(2)) / (w[2] * w[2]);
        0.5 * ((1.0 + slope2).sqrt() - 1.0)
    };
    let unit = |v: [f64; 3]| {
        let size = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
        v.map(|part| part / size)
    };
    let pole = unit([alpha[0] * wo[0], alpha[1] * wo[1], wo[2]]);
    let seen = 1.0 + smith(wo);
    let [count, step] = FEW;
    let mut sums = [0.0; 2];
    for i in 0..count {
        // As in `visible_normals`, on the whole circle.
        let turn = ((i * step % count) as f64 + 0.5) / count as f64;
        let (sin, cos) = (2.0 * PI * turn).sin_cos();
        let part = (i as f64 + 0.5) / count as f64;
        let root = part.sqrt();
        let height = part * root * (1.0 + pole[2]) - pole[2];
        let radius = (1.0 - height * height).max(0.0).sqrt();
        let h = unit([
            alpha[0] * (radius * cos + pole[0]),
            alpha[1] * (radius * sin + pole[1]),
            height + pole[2],
        ]);
        let cos_h = wo[0] * h[0] + wo[1] * h[1] + wo[2] * h[2];
        let wi = [0, 1, 2].map(|axis| 2.0 * cos_h * h[axis] - wo[axis]);
        if wi[2] > 0.0 {
            let lit = 1.5 * root / count as f64 * seen / (seen + smith(wi));
            sums[0] += lit;
            sums[1] += lit * (1.0 - cos_h.clamp(0.0, 1.0)).powi(5);
        }
    }
    sums
}

/// The albedo of the sheen of Estevez and Kulla 2017, which `half` limits to 1, and by what to multiply the sheen to
/// reflect no more than everything: narrow sheen would, at grazing angles.
fn sheen(cos_o: f64, alpha: f64) -> [f64; 2] {
    let sin_o = (1.0 - cos_o * cos_o).sqrt();
    let between = (1.0 - alpha).powi(2);
    let mix = |rough: f64, smooth: f64| rough + (smooth - rough) * between;
    let shape = |x: f64| {
        mix(21.5473, 25.3245) / (1.0 + mix(3.82987, 3.32435) * x.powf(mix(0.19823, 0.16801)))
            + mix(-1.97760, -1.27393) * x
            + mix(-4.32054, -4.85967)
    };
    let lambda = |cos: f64| match cos {
        cos if cos < 0.5 => shape(cos).exp(),
        cos => (2.0 * shape(0.5) - shape(1.0 - cos)).exp(),
    };
    let seen = 1.0 + lambda(cos_o);
    let mut sum = 0.0;
    for j in 0..HEIGHTS {
        // Cosines that are evenly spaced in their square root.
        let root = (j as f64 + 0.5) / HEIGHTS as f64;
        let cos_i = root * root;
        let sin_i = (1.0 - cos_i * cos_i).sqrt();
        let shadowed = seen + lambda(cos_i);
        for i in 0..ANGLES {
            let (sin, cos) = (PI * (i as f64 + 0.5) / ANGLES as f64).sin_cos();
            let half = [sin_o + sin_i * cos, sin_i * sin, cos_o + cos_i];
            let sin2 = half[0] * half[0] + half[1] * half[1];
            let sin2 = sin2 / (sin2 + half[2] * half[2]);
            let density = (2.0 + 1.0 / alpha) * sin2.powf(0.5 / alpha) / (2.0 * PI);
            sum += 2.0 * root * density / (4.0 * cos_o * shadowed);
        }
    }
    let albedo = 2.0 * PI * sum / (ANGLES * HEIGHTS) as f64;
    [albedo, albedo.max(1.0).recip()]
}

/// The nearest half float of a number from 0 to 1.
fn half(value: f64) -> u16 {
    let value = value.clamp(0.0, 1.0);
    let exponent = value.log2().floor().clamp(-14.0, 0.0);
    let steps = (value / exponent.exp2() * 1024.0).round() as u16;
    // The implicit bit of a normal number is the lowest bit of its exponent.
    steps + ((exponent as i16 + 14) as u16) * 1024
}
