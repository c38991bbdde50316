//! The `glimray` program: passes its arguments to [`glimray::app`].

#![forbid(unsafe_code)]

use std::process::ExitCode;
use std::time::Instant;

fn main() -> ExitCode {
    let started = Instant::now();
    glimray::app::mesa::silence_device_select();
    glimray::app::exit::install_panic_hook();
    glimray::app::run(std::env::args_os(), started)
}
