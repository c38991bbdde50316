//! Modules of the command line and the window: errors with exit codes, what a user may override, names of
//! settings, messages. Neither imports the other; `main` hands the window to the command line.

pub mod advice;
pub mod clock;
pub mod console;
pub mod error;
pub mod false_color;
pub mod flag_values;
pub mod flip;
pub mod folders;
pub mod host;
pub mod inputs;
pub mod layer_picture;
pub mod layers;
pub mod legend;
pub mod lock;
pub mod new_scene;
pub mod overrides;
pub mod picture_file;
pub mod ray_lines;
pub mod ray_text;
pub mod scene_file;
pub mod sequence;
pub mod settings;
pub mod showcase;
pub mod storage;
pub mod value_forms;
pub mod value_names;
pub mod window;
