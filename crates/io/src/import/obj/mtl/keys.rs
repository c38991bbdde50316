//! The keys of material libraries: those of MTL, version 4.2, of its physically based extension, and others that
//! exporters write. They may have any case.

/// The meaning of a key of a material.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Key {
    /// Begins a material.
    Name,
    Color(Color),
    Number(Number),
    /// The model of illumination.
    Illum,
    Map(Slot),
    /// The renderer has no such thing: it is reported.
    Skipped,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Color {
    Diffuse,
    Specular,
    Ambient,
    Emission,
    Filter,
}

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Number {
    Shininess,
    Index,
    Dissolve,
    Transparency,
    Roughness,
    Metallic,
    Sheen,
    Coat,
    CoatRoughness,
    Anisotropy,
    Rotation,
}

/// The coefficient that a picture multiplies.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Slot {
    Diffuse,
    Specular,
    Ambient,
    Emission,
    Normal,
    Bump,
    Alpha,
    Roughness,
    Metallic,
    Sheen,
    Coat,
    CoatRoughness,
}

const TABLE: [(&str, Key); 53] = [
    ("newmtl", Key::Name),
    ("Kd", Key::Color(Color::Diffuse)),
    ("Ks", Key::Color(Color::Specular)),
    ("Ka", Key::Color(Color::Ambient)),
    ("Ke", Key::Color(Color::Emission)),
    ("Tf", Key::Color(Color::Filter)),
    ("Ns", Key::Number(Number::Shininess)),
    ("Ni", Key::Number(Number::Index)),
    ("d", Key::Number(Number::Dissolve)),
    ("Tr", Key::Number(Number::Transparency)),
    ("illum", Key::Illum),
    ("Pr", Key::Number(Number::Roughness)),
    ("Pm", Key::Number(Number::Metallic)),
    ("Ps", Key::Number(Number::Sheen)),
    ("Pc", Key::Number(Number::Coat)),
    ("Pcr", Key::Number(Number::CoatRoughness)),
    ("aniso", Key::Number(Number::Anisotropy)),
    ("anisor", Key::Number(Number::Rotation)),
    ("map_Kd", Key::Map(Slot::Diffuse)),
    ("map_Ks", Key::Map(Slot::Specular)),
    ("map_Ka", Key::Map(Slot::Ambient)),
    ("map_Ke", Key::Map(Slot::Emission)),
    ("map_emissive", Key::Map(Slot::Emission)),
    ("norm", Key::Map(Slot::Normal)),
    ("map_Kn", Key::Map(Slot::Normal)),
    ("map_norm", Key::Map(Slot::Normal)),
    ("bump", Key::Map(Slot::Bump)),
    ("map_Bump", Key::Map(Slot::Bump)),
    ("map_d", Key::Map(Slot::Alpha)),
    ("map_opacity", Key::Map(Slot::Alpha)),
    ("map_Pr", Key::Map(Slot::Roughness)),
    ("map_Pm", Key::Map(Slot::Metallic)),
    ("map_Ps", Key::Map(Slot::Sheen)),
    ("map_Pc", Key::Map(Slot::Coat)),
    ("map_Pcr", Key::Map(Slot::CoatRoughness)),
    ("sharpness", Key::Skipped),
    ("map_Tr", Key::Skipped),
    ("map_Tf", Key::Skipped),
    ("map_Ns", Key::Skipped),
    ("map_Ni", Key::Skipped),
    ("map_aniso", Key::Skipped),
    ("map_anisor", Key::Skipped),
    ("map_refl", Key::Skipped),
    ("refl", Key::Skipped),
    ("map_disp", Key::Skipped),
    ("disp", Key::Skipped),
    ("decal", Key::Skipped),
    ("map_decal", Key::Skipped),
    ("map_aat", Key::Skipped),
    ("map_ORM", Key::Skipped),
    ("map_RMA", Key::Skipped),
    ("Km", Key::Skipped),
    ("Pl", Key::Skipped),
];

/// The key `word` in any case, as it is usually written.
pub(super) fn find(word: &[u8]) -> Option<(&'static str, Key)> {
    let is_named = |(name, _): &&(&str, Key)| word.eq_ignore_ascii_case(name.as_bytes());
    TABLE.iter().find(is_named).copied()
}

/// All keys.
pub(in crate::import) const KEYS: [&str; TABLE.len()] = {
    let mut names = [""; TABLE.len()];
    let mut i = 0;
    while i < TABLE.len() {
        names[i] = TABLE[i].0;
        i += 1;
    }
    names
};
