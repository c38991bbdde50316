//! Pictures of the classical colours of materials with several maps, for those integrators that show them.

use crate::support::program::Workspace;

/// Texels of a side of the map, and its bytes in a picture of 8 bits a channel.
const SIDE: u32 = 64;
const BYTES: f64 = 4.0 * (SIDE * SIDE) as f64;

/// A sphere with a material whose map has `uses`.
fn workspace(uses: &str) -> Workspace {
    let workspace = Workspace::new();
    let texel = |i: u32| [0.0, 0.2 + 0.6 * (i % 7) as f32 / 7.0, (i % 2) as f32];
    let texels: Vec<_> = (0..SIDE * SIDE).map(texel).collect();
    workspace.picture("map.png", SIDE, &texels);
    let text = format!(
        "[camera]\nlook_from = [0, 0, 4]\nlook_at = [0, 0, 0]\n[[lights]]\npoint = {{ position = [3, 4, 5] }}\n\
         [textures]\nmap = {{ picture = 'map.png' }}\n[materials]\nm = {{ pbr = {{ {uses} }} }}\n\
         [[objects]]\nsphere = {{ center = [0, 0, 0], radius = 1 }}\nmaterial = 'm'\n"
    );
    workspace.write("a.toml", text);
    workspace
}

const SEVERAL: &str = "metallic = { texture = 'map' }, roughness = { texture = 'map' }";

#[test]
fn debug_views_and_paths_take_no_memory_for_classical_colours() {
    // The classical colours of a dielectric follow its only map.
    let (several, one) = (
        workspace(SEVERAL),
        workspace("base_color = { texture = 'map' }"),
    );
    let views = "normals depth ids uv heat path whitted samples";
    for view in views.split_whitespace() {
        let line = format!("render a.toml --size 8x8 --integrator {view} -o a.png --report -");
        let bytes = |workspace: &Workspace| {
            let report = workspace.run(&line).expect(0).report;
            report["memory"]["gpu_bytes"].as_f64().expect("bytes")
        };
        let pictures = (bytes(&several) - bytes(&one)) / BYTES;
        // Diffuse, specular and reflected light differ from texel to texel.
        match ["whitted", "samples"].contains(&view) {
            true => assert!(pictures > 2.0, "{view} lacks its pictures: {pictures}"),
            false => assert!(pictures < 0.5, "{view} has {pictures} pictures more"),
        }
    }
}

#[test]
fn a_scene_looks_the_same_with_its_own_integrator_by_name() {
    let workspace = workspace(SEVERAL);
    let render = |flags: &str| {
        let line = format!("render a.toml --size 24x24 {flags} -o a.png");
        workspace.run(&line).expect(0);
        workspace.read("a.png")
    };
    assert!(render("") == render("--integrator whitted"));
}
