//! The program in a window: driven on a real screen, and without one beside its commands.

#[cfg(target_os = "linux")]
mod desktop;
#[allow(dead_code, reason = "the tests of the window use more of it")]
#[path = "../../crates/viewer/tests/suite/harness.rs"]
mod harness;
#[path = "../../crates/viewer/tests/suite/pixels.rs"]
mod pixels;
mod program;
