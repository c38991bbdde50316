//! `glimray schema`: prints the JSON Schema of the native scene format, or of a farm's manifest.

use crate::app::console;
use crate::app::error::AppError;
use crate::cli::args::SchemaArgs;
use crate::import;

pub fn run(arguments: &SchemaArgs) -> Result<(), AppError> {
    #[cfg(feature = "archive")]
    if arguments.manifest {
        return console::print_json(&crate::cli::farm::schema());
    }
    let SchemaArgs { .. } = arguments;
    console::print_json(&import::native_schema())
}
