//! Trees that instances place.
