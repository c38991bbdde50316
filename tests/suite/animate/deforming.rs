//! A model with a skin and morph targets on the command line.

use crate::import::gltf::bar::bending;
use crate::support::program::Workspace;
use std::collections::BTreeSet;

#[test]
fn a_bending_model_moves_in_every_frame() {
    let workspace = Workspace::new();
    workspace.write("bar.glb", bending().glb());
    let flags = "--fps 2 --size 64x48 --samples 1 --quiet";
    workspace
        .run(&format!("animate bar.glb {flags} -o f_%d.png"))
        .expect(0);
    let frame = |number: u32| workspace.read(&format!("f_{number}.png"));
    let different: BTreeSet<_> = (0..5).map(frame).collect();
    // The clip of two seconds ends with its last key.
    assert_eq!(different.len(), 5);
    for (number, moment) in [(2, "--frame 2"), (3, "--time 1.5")] {
        workspace
            .run(&format!("render bar.glb {flags} {moment} -o one.png"))
            .expect(0);
        assert!(workspace.read("one.png") == frame(number), "{moment}");
    }
    let blurred = "--frame 2 --shutter 180deg";
    workspace
        .run(&format!("render bar.glb {flags} {blurred} -o one.png"))
        .expect(0);
    assert!(workspace.read("one.png") != frame(2), "{blurred}");
    workspace
        .run(&format!(
            "turntable bar.glb {flags} --seconds 2 -o t_%d.png"
        ))
        .expect(0);
}

#[test]
fn a_bending_model_is_listed_and_converted_at_rest() {
    let workspace = Workspace::new();
    workspace.write("bar.glb", bending().glb());
    let listed = workspace.run("inspect bar.glb").expect(0);
    for line in [
        "clips      1\n  0  (unnamed), 2 s\n",
        "deforming  1\n  0  (unnamed) of 16 triangles, skin with 2 joint(s), 2 morph target(s)\n",
    ] {
        assert!(listed.text().contains(line), "{}", listed.text());
    }
    let listed = workspace.run("inspect bar.glb --json").expect(0).json();
    assert_eq!(listed["clips"][0]["seconds"], 2.0);
    assert_eq!(listed["deforming"][0]["joints"], 2);
    workspace
        .run("convert bar.glb -o bar.toml")
        .expect(0)
        .says("written in their pose at time 0");
    let flags = "--size 64x48 --samples 1 --quiet";
    for name in ["bar.glb", "bar.toml"] {
        workspace
            .run(&format!("render {name} {flags} -o {name}.png"))
            .expect(0);
    }
    workspace
        .run("compare bar.glb.png bar.toml.png --tolerance 0.002")
        .expect(0);
}
