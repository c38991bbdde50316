//! The tables of directional albedos that the path tracer reads: `lib/albedo.wesl`.

use std::sync::{Arc, OnceLock};

/// The tables, one after the other: 32 × 32 words of microfacets, as many of sheen, 36 × 24 × 32 of rough glass, and
/// 5 × 14 × 20 × 24 of stretched microfacets. A word has two half floats, the first in its lower half.
///
/// Microfacets reflect f0 · A + f90 · B with Schlick's Fresnel factor. A word has E = A + B, and by how much B is above
/// E · (1 - cos θ)⁵, which smooth ones reflect; a difference d is stored as (1 + d)/2. Rows are of √α from 0 to 1,
/// columns of √(c (1 + 4α)/(c + 4α)) for c = cos θ, both from 0 to 1: what narrow microfacets shadow at grazing angles
/// depends on c/α alone. A word of sheen has its albedo, at most 1, and the factor that keeps narrow sheen at grazing
/// angles from reflecting more; rows are of ∜α, columns of ∜cos θ. A word of glass has what it reflects and transmits
/// together, and by how much the reflected share of it is above that of smooth glass whose edge of total reflection is soft;
/// columns are of the mean of microfacets' and asinh(1.5 (c - c')/α), brought to 0 to 1, where total reflection begins at c';
/// there is a table for each relative index of refraction. A word of stretched microfacets is one of microfacets. Rows
/// are of the larger width w to the power of 2/3. With θ' for the angle whose tangent is v/w · tan θ, where v is the width
/// along the azimuth φ of the direction, columns have w for α and tan(π/4 - θ'/2) for c. There is a table for each
/// 1 - cos φ', where tan φ' = r^¾ tan φ for the ratio r of the widths, and within these for each √r.
///
/// A test computes them (`tests/suite/shader_albedo/table.rs`).
pub fn words() -> Arc<[u32]> {
    static WORDS: OnceLock<Arc<[u32]>> = OnceLock::new();
    let read = || {
        let bytes = include_bytes!("albedo/words.bin").as_chunks().0;
        bytes.iter().copied().map(u32::from_le_bytes).collect()
    };
    WORDS.get_or_init(read).clone()
}
