//! The extensions of glTF 2.0 that are read, and what happens with the others.

use super::blame::Blame;
use super::document::Document;
use crate::import::error::ImportError;
use crate::import::notes::Notes;
use crate::import::source::quote_up_to;

/// Support for an extension of glTF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Support {
    /// The extension is shown.
    Full,
    /// The path tracer shows the extension, the classical integrator does not.
    Paths,
    /// The extension's parameters are kept in the scene, but no integrator shows them.
    Kept,
    /// The extension says nothing about the picture: it is for programs that edit or describe models.
    Irrelevant,
}

/// The extensions of glTF that are known. A model that requires another one is refused; of a model that
/// uses another one, it is reported.
pub const GLTF_EXTENSIONS: &[(&str, Support)] = &[
    ("EXT_mesh_gpu_instancing", Support::Full),
    ("EXT_meshopt_compression", Support::Full),
    ("EXT_texture_webp", Support::Full),
    ("KHR_animation_pointer", Support::Full),
    #[cfg(feature = "draco")]
    ("KHR_draco_mesh_compression", Support::Full),
    ("KHR_lights_punctual", Support::Full),
    ("KHR_materials_emissive_strength", Support::Full),
    ("KHR_materials_ior", Support::Full),
    ("KHR_materials_pbrSpecularGlossiness", Support::Full),
    ("KHR_materials_specular", Support::Full),
    ("KHR_materials_transmission", Support::Full),
    ("KHR_materials_unlit", Support::Full),
    ("KHR_materials_variants", Support::Full),
    ("KHR_materials_volume", Support::Full),
    ("KHR_mesh_quantization", Support::Full),
    ("KHR_meshopt_compression", Support::Full),
    ("KHR_node_visibility", Support::Full),
    #[cfg(feature = "basis")]
    ("KHR_texture_basisu", Support::Full),
    ("KHR_texture_transform", Support::Full),
    ("KHR_materials_anisotropy", Support::Paths),
    ("KHR_materials_clearcoat", Support::Paths),
    ("KHR_materials_diffuse_transmission", Support::Paths),
    ("KHR_materials_dispersion", Support::Paths),
    ("KHR_materials_iridescence", Support::Paths),
    ("KHR_materials_sheen", Support::Paths),
    ("EXT_mesh_manifold", Support::Irrelevant),
    ("KHR_xmp", Support::Irrelevant),
    ("KHR_xmp_json_ld", Support::Irrelevant),
];

/// The longest name of an extension that messages show whole.
pub(super) const LONGEST_NAME: usize = 64;

/// Checks the extensions that `document` requires, and notes those that have no effect.
///
/// # Errors
/// `document` requires extensions that are not read; all are named.
pub(super) fn check(
    document: &Document,
    traces_paths: bool,
    notes: &mut Notes,
    blame: Blame,
) -> Result<(), ImportError> {
    let mut lacking: Vec<String> = Vec::new();
    for name in &document.extensions_required {
        let quoted = quote_up_to(LONGEST_NAME, name.as_bytes());
        if support(name).is_none() && !lacking.contains(&quoted) {
            lacking.push(quoted);
        }
        if lacking.len() > 8 {
            break;
        }
    }
    if !lacking.is_empty() {
        let why = format!(
            "it requires extensions that are not supported: {}",
            lacking.join(", ")
        );
        return Err(blame.file(&why, remedy(&lacking)));
    }
    for name in &document.extensions_used {
        let quoted = || quote_up_to(LONGEST_NAME, name.as_bytes());
        match support(name) {
            Some(Support::Full | Support::Irrelevant) => {}
            Some(Support::Paths) if traces_paths => {}
            Some(Support::Paths) => notes.add("extensions without effect", || {
                format!("the extension {} is shown by path tracing only", quoted())
            }),
            Some(Support::Kept) => notes.add("extensions without effect", || {
                format!("the extension {} is kept, but not shown", quoted())
            }),
            None => notes.add("extensions without effect", || {
                format!(
                    "the extension {} is not supported and was ignored",
                    quoted()
                )
            }),
        }
    }
    Ok(())
}

/// The remedy for missing extensions.
fn remedy(lacking: &[String]) -> &'static str {
    let has = |part: &str| lacking.iter().any(|name| name.contains(part));
    if has("compression") {
        "Export the model without compression"
    } else if has("basisu") {
        "Export the model with PNG or JPEG pictures"
    } else {
        "Export the model without them"
    }
}

/// How the extension `name` is treated, if it is known.
pub(super) fn support(name: &str) -> Option<Support> {
    let mut known = GLTF_EXTENSIONS.iter();
    known.find(|(known, _)| *known == name).map(|(_, it)| *it)
}
