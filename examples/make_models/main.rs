//! Writes a glTF model: `cargo run --example make_models -- flower assets/scenes/flower.glb`, or `helmet`.

mod flower;
mod glb;
mod helmet;
mod pictures;
mod surface;

use std::error::Error;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<_> = std::env::args().skip(1).collect();
    match arguments.iter().map(String::as_str).collect::<Vec<_>>()[..] {
        ["flower", path] => flower::write(path),
        ["helmet", path] => helmet::write(path),
        _ => Err("name the model, flower or helmet, and the .glb file to write".into()),
    }
}
