//! Haines' Neutral File Format.

mod spd;
