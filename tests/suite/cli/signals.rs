//! Ctrl-C and SIGTERM.

use crate::support::program::Workspace;
use serde_json::Value;
use std::fs;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// Starts a very long render, sends `signal` once it makes progress, and returns the exit code.
#[cfg(unix)]
fn interrupted(workspace: &Workspace, signal: &str) -> Option<i32> {
    let line = "render a.scene --size 2048x2048 --samples 65536 --progress json -o a.png";
    let mut command = workspace.command(line);
    let mut child = command
        .stderr(Stdio::piped())
        .spawn()
        .expect("glimray runs");
    let mut lines = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let under_way = lines.any(|line| line.is_ok_and(|line| line.contains("\"progress\"")));
    assert!(under_way, "the render ended early");
    let kill = Command::new("kill")
        .args([signal, &child.id().to_string()])
        .status();
    assert!(kill.expect("kill runs").success());
    let rest: Vec<_> = lines.map_while(Result::ok).collect();
    let last = rest
        .last()
        .and_then(|line| serde_json::from_str::<Value>(line).ok());
    let last = last.expect("JSON");
    assert_eq!(last["error"], "interrupted: no picture was written.");
    child.wait().expect("it ends").code()
}

#[cfg(unix)]
#[test]
fn ctrl_c_exits_130_and_leaves_nothing() {
    let workspace = Workspace::new();
    assert_eq!(interrupted(&workspace, "-INT"), Some(130));
    assert!(workspace.made().is_empty(), "{:?}", workspace.made());
}

#[cfg(unix)]
#[test]
fn sigterm_exits_143_and_leaves_the_old_picture() {
    let workspace = Workspace::new();
    fs::write(workspace.path("a.png"), "old").expect("a file");
    assert_eq!(interrupted(&workspace, "-TERM"), Some(143));
    assert_eq!(fs::read(workspace.path("a.png")).expect("a file"), b"old");
    assert_eq!(workspace.made(), ["a.png"]);
}

/// A model whose hundred pictures take long to decode.
#[cfg(unix)]
fn long_to_load() -> Vec<u8> {
    use crate::import::gltf::model::{FLOAT, Model, floats};
    use serde_json::json;
    let mut picture = std::io::Cursor::new(Vec::new());
    image::GrayImage::new(4096, 4096)
        .write_to(&mut picture, image::ImageFormat::Png)
        .expect("a PNG");
    let mut model = Model::new();
    let position = model.vectors(&[[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let uvs = model.accessor(&floats(&[0.0; 6]), FLOAT, "VEC2", 3);
    let view = model.view(picture.get_ref());
    let view = model.json["bufferViews"][view].clone();
    for i in 0..100 {
        model.primitive(
            position,
            json!({ "attributes": { "TEXCOORD_0": uvs }, "material": i }),
        );
        let views = model.json["bufferViews"].as_array_mut().expect("a list");
        views.push(view.clone());
        let last = views.len() - 1;
        model.push("images", json!({ "bufferView": last }));
        model.push("textures", json!({ "source": i }));
        let map = json!({ "baseColorTexture": { "index": i } });
        model.push("materials", json!({ "pbrMetallicRoughness": map }));
    }
    model.glb()
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_a_long_load() {
    let workspace = Workspace::new();
    fs::write(workspace.path("a.glb"), long_to_load()).expect("a model");
    let line = "render a.glb --texture-limit 16 --quiet -o a.png";
    let mut child = workspace.command(line).spawn().expect("glimray runs");
    std::thread::sleep(std::time::Duration::from_millis(800));
    assert!(
        child.try_wait().expect("a process").is_none(),
        "it is done already"
    );
    let signalled = std::time::Instant::now();
    let kill = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    assert!(kill.expect("kill runs").success());
    assert_eq!(child.wait().expect("it ends").code(), Some(130));
    let seconds = signalled.elapsed().as_secs_f64();
    assert!(seconds < 2.0, "it took {seconds} s to stop");
    assert!(!workspace.path("a.png").exists());
}
