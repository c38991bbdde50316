//! Scene files: what importers make of them, their errors, and the round trip through the native format.

mod export;
mod import;
mod support;

/// Paths in tests start at the root of the repository.
#[ctor::ctor]
fn start_at_the_root() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    std::env::set_current_dir(root).expect("the root of the repository");
}
