//! Files of the ray tracer glimray: scenes and models are read ([`import`]) and written ([`export`]), pictures and
//! videos are written ([`output`]).

#![cfg_attr(docsrs, feature(doc_cfg))]

pub mod export;
pub mod import;
#[cfg(not(target_arch = "wasm32"))]
pub mod output;
