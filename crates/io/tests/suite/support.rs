//! Helpers that the tests of all packages share.

#[path = "../../../../tests/suite/support/effort.rs"]
pub mod effort;
#[path = "../../../../tests/suite/support/random.rs"]
pub mod random;
#[path = "../../../../tests/suite/support/skip.rs"]
pub mod skip;
#[path = "../../../../tests/suite/support/verdict.rs"]
pub mod verdict;
