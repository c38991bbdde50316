//! Shared helpers: shader functions run on the GPU, runs of the program, verdicts that report every failure,
//! reproducible random numbers, and measuring work.

pub mod devices;
pub mod effort;
pub mod harness;
pub mod program;
pub mod random;
pub mod schema;
pub mod settings;
pub mod skip;
pub mod statistics;
pub mod types;
pub mod verdict;

/// Time limit for waiting. It is not used for measuring: it turns a hang into a failure, even on a loaded
/// machine.
pub const PATIENCE: std::time::Duration = std::time::Duration::from_secs(300);
