//! The lobes in f64, written from the formulas of the papers.

use glam::DVec3;
use std::f64::consts::PI;

/// Trowbridge and Reitz: equation 33 of Walter et al. 2007 for slopes scaled along two axes.
pub fn ggx_distribution(h: DVec3, [x, y]: [f64; 2]) -> f64 {
    if h.z <= 0.0 {
        return 0.0;
    }
    let cos2 = h.z * h.z;
    let tan2 = (h.x * h.x / (x * x) + h.y * h.y / (y * y)) / cos2;
    1.0 / (PI * x * y * cos2 * cos2 * (1.0 + tan2).powi(2))
}

/// Λ of Heitz 2014, equation 72, with the width along the direction of equation 80.
pub fn ggx_lambda(w: DVec3, [x, y]: [f64; 2]) -> f64 {
    let sin2 = w.x * w.x + w.y * w.y;
    if sin2 == 0.0 {
        return 0.0;
    }
    let width2 = (w.x * w.x * x * x + w.y * w.y * y * y) / sin2;
    let a2 = w.z * w.z / (width2 * sin2);
    0.5 * (-1.0 + (1.0 + 1.0 / a2).sqrt())
}

/// Reflection: D G / (4 cos cos) times the cosine of wi, and the density of wi. The third parameter is 1 for separable
/// shadowing.
pub fn ggx(wo: DVec3, wi: DVec3, [x, y, separable, _]: [f64; 4]) -> [f64; 2] {
    if wi.z <= 0.0 {
        return [0.0; 2];
    }
    let alpha = [x, y];
    let h = (wo + wi).normalize();
    let d = ggx_distribution(h, alpha);
    let (o, i) = (ggx_lambda(wo, alpha), ggx_lambda(wi, alpha));
    let g = match separable == 1.0 {
        true => 1.0 / (1.0 + o) / (1.0 + i),
        false => 1.0 / (1.0 + o + i),
    };
    // The density of visible normals, and 1 / (4 wo·h) from normals to directions.
    let visible = d * wo.dot(h).max(0.0) / (wo.z * (1.0 + o));
    [d * g / (4.0 * wo.z), visible / (4.0 * wo.dot(h))]
}

/// Refraction: equations 16, 17 and 21 of Walter et al. 2007, without Fresnel's factor and divided by the square of the
/// relative index. The third parameter is the index on wo's side over that on the other.
pub fn transmission(wo: DVec3, wi: DVec3, [x, y, eta, _]: [f64; 4]) -> [f64; 2] {
    let alpha = [x, y];
    let h = -(eta * wo + wi).normalize();
    let h = if h.z < 0.0 { -h } else { h };
    let (o, i) = (wo.dot(h), wi.dot(h));
    if wi.z >= 0.0 || o <= 0.0 || i >= 0.0 {
        return [0.0; 2];
    }
    let d = ggx_distribution(h, alpha);
    let masked = 1.0 / (1.0 + ggx_lambda(wo, alpha));
    let shadowed = 1.0 / (1.0 + ggx_lambda(wi, alpha));
    // The other medium has index 1, so wo's has eta.
    let scaled = eta * eta * o.abs() * i.abs() / (wo.z.abs() * wi.z.abs()) * masked * shadowed * d
        / (i + eta * o).powi(2);
    let value = scaled / (eta * eta) * wi.z.abs();
    let visible = d * o * masked / wo.z;
    [value, visible * i.abs() / (i + eta * o).powi(2)]
}

/// Estevez and Kulla 2017, with uniform samples. The first parameter is α.
pub fn sheen(wo: DVec3, wi: DVec3, [alpha, ..]: [f64; 4]) -> [f64; 2] {
    if wi.z <= 0.0 {
        return [0.0; 2];
    }
    // Table 1 of the paper: the parameters of L for α = 0 and for α = 1.
    let table = [
        (25.3245, 21.5473),
        (3.32435, 3.82987),
        (0.16801, 0.19823),
        (-1.27393, -1.97760),
        (-4.85967, -4.32054),
    ];
    let [a, b, c, d, e] = table.map(|(zero, one)| {
        let share = (1.0 - alpha) * (1.0 - alpha);
        share * zero + (1.0 - share) * one
    });
    let l = |x: f64| a / (1.0 + b * x.powf(c)) + d * x + e;
    let lambda = |cos: f64| {
        if cos < 0.5 {
            l(cos).exp()
        } else {
            (2.0 * l(0.5) - l(1.0 - cos)).exp()
        }
    };
    let h = (wo + wi).normalize();
    let sin = (1.0 - h.z * h.z).max(0.0).sqrt();
    let distribution = (2.0 + 1.0 / alpha) * sin.powf(1.0 / alpha) / (2.0 * PI);
    let g = 1.0 / (1.0 + lambda(wo.z) + lambda(wi.z));
    [distribution * g / (4.0 * wo.z), 0.5 / PI]
}

/// Fresnel's equations for the cosine on the side of the index `eta`, relative to the other.
pub fn fresnel(cos_i: f64, eta: f64) -> f64 {
    let sin2 = eta * eta * (1.0 - cos_i * cos_i);
    if sin2 >= 1.0 {
        return 1.0;
    }
    let cos_t = (1.0 - sin2).sqrt();
    let s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
    let p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
    0.5 * (s * s + p * p)
}

/// Parts that tinted glass leaves of reflected and of transmitted light.
pub const REFLECT: [f64; 3] = [0.9, 0.6, 0.3];
pub const TRANSMIT: [f64; 3] = [0.2, 0.5, 0.8];

/// The reflected part of the luminance that such glass leaves, for the part that clear glass reflects.
pub fn reflected_share(fresnel: f64) -> f64 {
    let luminance = |[r, g, b]: [f64; 3]| 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let (reflected, transmitted) = (
        fresnel * luminance(REFLECT),
        (1.0 - fresnel) * luminance(TRANSMIT),
    );
    reflected / (reflected + transmitted)
}

/// The red of tinted glass. The parameters are the width, the index on wo's side over that on the other, 1 where
/// transmitted light bends, and the gain, or 0 for separable shadowing. With a gain the density is the value. A wall
/// scatters what it transmits as if it were reflected on the other side.
pub fn boundary(wo: DVec3, wi: DVec3, [alpha, eta, bends, gain]: [f64; 4]) -> [f64; 2] {
    let separable = if gain == 0.0 { 1.0 } else { 0.0 };
    let upper = DVec3::new(wi.x, wi.y, wi.z.abs());
    let (fresnel, [value, pdf]) = match wi.z > 0.0 || bends == 0.0 {
        true => {
            let cos = wo.dot((wo + upper).normalize());
            (
                fresnel(cos, eta),
                ggx(wo, upper, [alpha, alpha, separable, 0.0]),
            )
        }
        false => {
            let h = -(eta * wo + wi).normalize();
            let h = if h.z < 0.0 { -h } else { h };
            let scattered = transmission(wo, wi, [alpha, alpha, eta, 0.0]);
            (fresnel(wo.dot(h), eta), scattered)
        }
    };
    // The chance of reflection is that of clear glass where directions are drawn again.
    let reflected = if gain == 0.0 {
        reflected_share(fresnel)
    } else {
        fresnel
    };
    let (part, chance) = match wi.z > 0.0 {
        true => (REFLECT[0] * fresnel, reflected),
        false => (TRANSMIT[0] * (1.0 - fresnel), 1.0 - reflected),
    };
    match gain == 0.0 {
        true => [part * value, chance * pdf],
        false => [part * value * gain, chance * value * gain],
    }
}

/// Microfacets with Schlick's reflectance of glass of index 1.5. The parameters are the width, and 1 for what the body
/// of the glTF specification says: separable shadowing, and the reflectance from wo's direction.
pub fn coat(wo: DVec3, wi: DVec3, [alpha, separable, ..]: [f64; 4]) -> [f64; 2] {
    let cos = match separable == 1.0 {
        true => wo.z,
        false => wo.dot((wo + wi).normalize()),
    };
    let [value, pdf] = ggx(wo, wi, [alpha, alpha, separable, 0.0]);
    [(0.04 + 0.96 * (1.0 - cos).powi(5)) * value, pdf]
}
