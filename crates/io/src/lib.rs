//! Files of the ray tracer glimray: scenes and models are read ([`import`]) and written ([`export`]), pictures and
//! videos are written ([`output`]).

pub mod export;
pub mod import;
#[cfg(not(target_arch = "wasm32"))]
pub mod output;
