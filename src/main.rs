//! The `glimray` program: passes its arguments, and its window if it has one, to [`glimray_cli`].

#![forbid(unsafe_code)]

use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let started = Instant::now();
    glimray_cli::exit::install_panic_hook();
    #[cfg(feature = "viewer")]
    let window = Some(&glimray_viewer::WINDOW);
    #[cfg(not(feature = "viewer"))]
    let window = None;
    glimray_cli::run(std::env::args_os(), started, window)
}
