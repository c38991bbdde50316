//! The tables of directional albedos that the path tracer reads: `lib/albedo.wesl`.

/// The tables, one after the other: 32 × 32 words of microfacets, as many of sheen, and 24 × 24 × 32 of rough glass. A
/// word has two half floats.
///
/// Microfacets reflect f0 · A + f90 · B with Schlick's Fresnel factor, where A is in the lower half of a word. A word
/// of sheen has its albedo, at most 1, and the factor that keeps narrow sheen at grazing angles from reflecting more. Rows are of ∜α from 0
/// to 1, columns of ∜cos θ from 0 to 1. A word of glass has what it reflects and transmits together, and what it
/// reflects; rows are of √α, and there is a table for each relative index of refraction.
pub fn words() -> &'static [u32] {
    static WORDS: [u32; 20480] = include!(concat!(env!("OUT_DIR"), "/albedo.txt"));
    &WORDS
}
