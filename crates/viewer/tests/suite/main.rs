//! The window, driven through the names that screen readers read, drawn and rendered by lavapipe; and the models behind it.

mod ball;
mod bindings;
mod box_select;
mod canvas;
mod command_line;
mod compare;
mod contrast;
mod document;
mod dropping;
mod edit;
mod error_maps;
mod files;
mod film;
mod first_picture;
mod fitting;
mod focus;
mod ground;
mod handles;
mod hands;
mod harness;
mod histogram;
mod jobs;
mod kept;
mod layers;
mod lens;
mod lighting;
mod loading;
mod look;
mod looks;
mod making;
mod material;
mod material_presets;
mod modal;
mod names;
mod navigation;
mod objects;
mod outline;
mod panels;
mod parts;
mod picture;
mod picture_menu;
mod pivot;
mod pixels;
mod preferences;
mod progress;
mod rays;
mod reference;
mod replay;
mod section;
mod several_rows;
mod sheets;
mod silhouette;
mod snapping;
mod support;
mod tasks;
mod textures;
mod time;
mod toolbar;
mod tools;
mod walking;

/// Paths in tests start at the root of the repository.
#[ctor::ctor]
fn start_at_the_root() {
    std::env::set_current_dir(support::ROOT).expect("the root of the repository");
}
