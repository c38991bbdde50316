//! Links every kernel to plain WGSL, once for each of its variants. `build.rs` does so with the feature `link`;
//! a test compares the result with the files in `shaders/linked`.

use std::error::Error;

/// Variants of kernels, and the features of `shaders` that they have.
const VARIANTS: [(&str, &[&str]); 3] = [
    ("image", &["image_fetch"]),
    ("buffer", &[]),
    ("packet", &["image_fetch", "packet"]),
];

/// Names of kernels, the modules in `shaders/kernels` they are made of, the features that all their variants
/// have, and their variants.
const KERNELS: [(&str, &str, &[&str], &[&str]); 9] = [
    ("whitted", "whitted", &[], &["image", "buffer", "packet"]),
    ("path_trace", "path_trace", &[], &["image", "buffer"]),
    ("debug_view", "debug_view", &[], &["image", "buffer"]),
    ("develop", "develop", &[], &["buffer"]),
    ("show", "show", &[], &["buffer"]),
    ("denoise", "denoise", &[], &["buffer"]),
    ("explain", "whitted", &["record"], &["image", "buffer"]),
    (
        "explain_path",
        "path_trace",
        &["record"],
        &["image", "buffer"],
    ),
    (
        "trace_rays",
        "trace_rays",
        &[],
        &["image", "buffer", "packet"],
    ),
];

/// Every feature of `shaders`.
const FEATURES: [&str; 3] = ["image_fetch", "packet", "record"];

/// Names items of modules as `module__item`, where wesl would repeat the whole path: the program embeds the text.
/// Modules that share a name have no item of the same name; naga would reject the second.
struct ShortNames;

impl wesl::Mangler for ShortNames {
    fn mangle(&self, path: &wesl::ModulePath, item: &str) -> String {
        format!("{}__{item}", path.last().unwrap_or_default())
    }
}

/// The text with a tab for each level of four spaces, which is shorter.
fn indented_by_tabs(text: &str) -> String {
    let line = |line: &str| {
        let rest = line.trim_start_matches(' ');
        "\t".repeat((line.len() - rest.len()) / 4) + rest + "\n"
    };
    text.lines().map(line).collect()
}

/// Names of files for `shaders/linked`, and their text. A broken import is an error.
pub fn kernels() -> Result<Vec<(String, String)>, Box<dyn Error>> {
    let mut files = Vec::new();
    for (kernel, module, own, variants) in KERNELS {
        for (variant, features) in VARIANTS {
            if !variants.contains(&variant) {
                continue;
            }
            let mut compiler = wesl::Wesl::new("shaders");
            compiler.set_custom_mangler(ShortNames);
            for feature in FEATURES {
                let is_on = own.contains(&feature) || features.contains(&feature);
                compiler.set_feature(feature, is_on);
            }
            let linked = compiler.compile(&format!("package::kernels::{module}").parse()?)?;
            let text = indented_by_tabs(&linked.to_string());
            files.push((format!("{kernel}_{variant}.wgsl"), text));
        }
    }
    Ok(files)
}
