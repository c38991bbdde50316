//! Files of this package: linked kernels, and the overrides that they declare.

#[cfg(embedded)]
include!(concat!(env!("OUT_DIR"), "/embedded.rs"));

/// The text of a file, by its path in this package. Release builds have it embedded; others read it, so that an edited
/// shader needs no build.
///
/// # Errors
/// The file is not there, or is not text.
#[cfg(embedded)]
pub fn read(path: &str) -> Result<String, String> {
    let (_, compressed) = (EMBEDDED.iter().find(|(name, _)| *name == path))
        .ok_or_else(|| format!("{path} is not embedded"))?;
    let bytes = miniz_oxide::inflate::decompress_to_vec(compressed);
    let bytes = bytes.map_err(|error| format!("{path}: {error}"))?;
    String::from_utf8(bytes).map_err(|error| format!("{path}: {error}"))
}

#[cfg(not(embedded))]
pub fn read(path: &str) -> Result<String, String> {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(path);
    std::fs::read_to_string(&path).map_err(|error| {
        format!(
            "{}: {error}. Link the kernels with `make shaders`. Only release builds embed them.",
            path.display()
        )
    })
}
