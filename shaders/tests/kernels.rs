//! The texts of kernels.

use glimray_shaders::{Kernel, Variant};
use std::fs;

/// Release builds embed the files that others read: `make embedded` runs this test on such a build.
#[test]
fn every_variant_has_the_text_of_its_file() {
    for kernel in Kernel::ALL {
        for variant in kernel.variants() {
            let ending = format!("{variant:?}").to_lowercase();
            let path = format!("linked/{}_{ending}.wgsl", kernel.name);
            let text = fs::read_to_string(&path).expect("a linked kernel");
            assert_eq!(kernel.source(variant).as_ref(), Ok(&text), "{path}");
        }
    }
}

#[test]
fn a_variant_that_a_kernel_lacks_is_an_error() {
    let error = Kernel::DEVELOP.source(Variant::Packet);
    assert_eq!(error, Err("develop has no variant Packet".to_owned()));
}
