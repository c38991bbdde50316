//! What several subjects need: shader functions run on the GPU, runs of the program, verdicts that name every
//! failure, random numbers that are the same in every run, and how much work something is.

pub mod devices;
pub mod effort;
pub mod harness;
pub mod program;
pub mod random;
pub mod skip;
pub mod statistics;
pub mod types;
pub mod verdict;
pub mod words;

/// How long tests wait for what must come. No test measures by it: it turns a hang into a failure,
/// on machines that have other things to do.
pub const PATIENCE: std::time::Duration = std::time::Duration::from_secs(300);
