//! Helpers that the tests of all packages share.

#![allow(dead_code, reason = "the tests of the root use more of them")]

#[path = "../../../../tests/suite/support/devices.rs"]
pub mod devices;
#[path = "../../../../tests/suite/support/effort.rs"]
pub mod effort;
#[path = "../../../../tests/suite/support/random.rs"]
pub mod random;
#[path = "../../../../tests/suite/support/settings.rs"]
pub mod settings;
#[path = "../../../../tests/suite/support/skip.rs"]
pub mod skip;
#[path = "../../../../tests/suite/support/verdict.rs"]
pub mod verdict;

/// The root of the repository.
pub const ROOT: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");

/// Time limit for waiting. It is not used for measuring: it turns a hang into a failure, even on a loaded
/// machine.
pub const PATIENCE: std::time::Duration = std::time::Duration::from_secs(300);
