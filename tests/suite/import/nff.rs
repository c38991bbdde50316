//! Haines' Neutral File Format.

mod spd;

use super::writing::triangles;
