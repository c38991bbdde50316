//! What several subjects need: shader functions run on the GPU, verdicts that name every failure,
//! and random numbers that are the same in every run.

pub mod harness;
pub mod random;
pub mod statistics;
pub mod types;
pub mod verdict;
pub mod words;
