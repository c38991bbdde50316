//! Scenes and renders that the tests of all packages share.

#![allow(dead_code, reason = "the tests of the root use more of them")]

#[path = "../../../../tests/suite/reference/compare.rs"]
pub mod compare;
#[path = "../../../../tests/suite/reference/scenes.rs"]
pub mod scenes;
