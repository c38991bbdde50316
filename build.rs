//! Links every kernel under `shaders/` to plain WGSL, once for each way of fetching geometry, so that the
//! binary contains its shaders and a broken import fails the build. `explain` is the kernel `whitted` with the
//! feature `record`.

use std::{error::Error, path::Path, process::ExitCode};

fn main() -> ExitCode {
    println!("cargo::rerun-if-changed=shaders");
    match link_kernels() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::FAILURE
        }
    }
}

fn link_kernels() -> Result<(), Box<dyn Error>> {
    let out = std::env::var("OUT_DIR")?;
    for (kernel, module) in [
        ("whitted", "whitted"),
        ("debug_view", "debug_view"),
        ("develop", "develop"),
        ("show", "show"),
        ("explain", "whitted"),
    ] {
        for (variant, image_fetch) in [("image", true), ("buffer", false)] {
            let mut compiler = wesl::Wesl::new("shaders");
            compiler.set_feature("image_fetch", image_fetch);
            compiler.set_feature("record", kernel != module);
            let linked = compiler.compile(&format!("package::kernels::{module}").parse()?)?;
            let path = Path::new(&out).join(format!("{kernel}_{variant}.wgsl"));
            std::fs::write(path, linked.to_string())?;
        }
    }
    Ok(())
}
