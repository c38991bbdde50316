//! `glimray schema`: the JSON Schema of the native scene format.

use crate::app::console;
use crate::app::error::AppError;
use crate::import;

pub fn run() -> Result<(), AppError> {
    console::print_json(&import::native_schema())
}
