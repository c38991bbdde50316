//! Links every kernel to plain WGSL, once for each way of fetching geometry. `build.rs` does so with the
//! feature `link`; a test compares the result with the files in `shaders/linked`.

use std::error::Error;

/// Names of kernels, and of the modules in `shaders/kernels` they are made of. `explain` is `whitted` that
/// keeps records.
const KERNELS: [(&str, &str); 6] = [
    ("whitted", "whitted"),
    ("debug_view", "debug_view"),
    ("develop", "develop"),
    ("show", "show"),
    ("explain", "whitted"),
    ("trace_rays", "trace_rays"),
];

/// Names of files for `shaders/linked`, and their text. A broken import is an error.
pub fn kernels() -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let mut files = Vec::new();
    for (kernel, module) in KERNELS {
        for (variant, image_fetch) in [("image", true), ("buffer", false)] {
            let mut compiler = wesl::Wesl::new("shaders");
            compiler.set_feature("image_fetch", image_fetch);
            compiler.set_feature("record", kernel != module);
            let linked = compiler.compile(&format!("package::kernels::{module}").parse()?)?;
            files.push((format!("{kernel}_{variant}.wgsl"), linked.to_string()));
        }
    }
    Ok(files)
}
