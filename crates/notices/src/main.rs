//! Writes the notices of the program for a platform into a folder: `glimray-notices TARGET FOLDER`.

use glimray_notices::{LICENSES, SBOM, licenses, packages, sbom};
use std::{env, error::Error, fs, path::Path};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = env::args().skip(1).collect();
    let [target, folder] = &arguments[..] else {
        return Err("usage: glimray-notices TARGET FOLDER".into());
    };
    let folder = Path::new(folder);
    let packages = packages(target)?;
    fs::write(folder.join(LICENSES), licenses(&packages)?)?;
    fs::write(folder.join(SBOM), sbom(&packages)?)?;
    Ok(())
}
