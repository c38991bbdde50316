//! Text from files does not act on the terminal.

use crate::support::program::Workspace;
use crate::support::verdict::Verdict;
use serde_json::Value;

/// A name with an escape sequence, controls of C0 and C1, marks, embeddings, overrides and isolates of right-to-left text,
/// separators, zero-width characters and a tag.
const NAME: &str = "qz\u{1b}[2J\u{7f}\u{85}\u{9b}\u{61c}\u{180e}\u{200b}\u{200c}\u{200d}\u{200e}\u{200f}\u{2028}\u{2029}\u{202a}\u{202b}\u{202c}\u{202d}\u{202e}\u{2060}\u{2066}\u{2067}\u{2068}\u{2069}\u{206f}\u{feff}\u{fff9}\u{e0001}\u{e007f}qz";

/// [`NAME`] with escapes that JSON and TOML share.
fn escaped() -> String {
    NAME.chars()
        .map(|c| match u32::from(c) {
            code @ (..0x20 | 0x7f) => format!("\\u{code:04x}"),
            _ => c.to_string(),
        })
        .collect()
}

/// Files whose names of things, keys and words are [`NAME`]. Each ends with something wrong.
fn files() -> Vec<(&'static str, String)> {
    let (name, escaped) = (NAME, escaped());
    let gltf = format!(
        r#"{{"asset": {{"version": "2.0", "generator": "{escaped}"}}, "{escaped}": 1, "extensionsUsed": ["{escaped}"],
        "materials": [{{"name": "{escaped}", "extensions": {{"{escaped}": {{}}}}, "alphaMode": "{escaped}"}}],
        "cameras": [{{"type": "perspective", "name": "{escaped}", "perspective": {{"yfov": 1, "znear": 1}}}}],
        "images": [{{"uri": "{escaped}.png", "name": "{escaped}"}}],
        "animations": [{{"name": "{escaped}", "channels": [], "samplers": []}}],
        "meshes": [{{"name": "{escaped}", "primitives": [{{"attributes": {{"{escaped}": 7}}}}]}}],
        "nodes": [{{"mesh": 0, "name": "{escaped}"}}, {{"camera": 0, "name": "{escaped}"}}],
        "scenes": [{{"nodes": [0, 1]}}]}}"#
    );
    let native = format!(
        "[[cameras]]\nname = \"{escaped}\"\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\nfov_y_deg = 40\n[materials.\"{escaped}\"]\nphong = {{ diffuse = [1, 0, 0] }}\n[[objects]]\nname = \
         \"{escaped}\"\nsphere = {{ center = [0, 0, -3], radius = 1 }}\nmaterial = \"{escaped}\"\n[[lights]]\npoint = {{ position = [0, 0, 0] }}\n"
    );
    let triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    let ply = format!(
        "ply\nformat ascii 1.0\ncomment {name}\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
         property float {name}\nelement {name} 1\nproperty float {name}\nelement face 1\nproperty list uchar int \
         vertex_indices\nend_header\n0 0 0 1\n1 0 0 1\n0 1 0 1\n1\n3 0 1 2\n"
    );
    vec![
        ("good.toml", native.clone()),
        ("key.toml", format!("{native}\"{escaped}\" = 1\n")),
        ("material.toml", native.replacen(&escaped, "other", 2)),
        ("raw.toml", format!("{native}# {name}\n")),
        (
            "word.scene",
            format!("1\namb: 0 0 0\nsphere\npos: 0 0 {name}\n"),
        ),
        ("object.scene", format!("1\namb: 0 0 0\n{name}\n")),
        ("entity.nff", format!("{name}\n")),
        (
            "file.obj",
            format!(
                "mtllib {name}.mtl\nusemtl {name}\no {name}\ng {name}\n{name} 1\n{triangle}f 1 2 3\n"
            ),
        ),
        ("face.obj", format!("{triangle}f 1 2 {name}\n")),
        (
            "map.obj",
            format!("mtllib map.mtl\n{triangle}usemtl {name}\nf 1 2 3\n"),
        ),
        (
            "map.mtl",
            format!("newmtl {name}\nKd 1 0 {name}\nmap_Kd {name}.png\n{name} 1\n"),
        ),
        ("file.ply", ply.clone()),
        ("header.ply", ply.replace("element face", name)),
        (
            "file.stl",
            format!(
                "solid {name}\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 {name}\n"
            ),
        ),
        ("file.gltf", gltf.clone()),
        (
            "required.gltf",
            gltf.replace("extensionsUsed", "extensionsRequired"),
        ),
        (
            "version.gltf",
            gltf.replace("\"2.0\"", &format!("\"{escaped}\"")),
        ),
    ]
}

/// Whether a terminal may act on `c`. Unicode's table of format characters (`Cf`), separators of lines and controls.
fn acts(c: char) -> bool {
    NAME.contains(c) && !"qz[2J".contains(c) || c.is_control() && c != '\n'
}

#[test]
fn what_files_say_does_not_act_on_the_terminal() {
    let workspace = Workspace::new();
    let mut verdict = Verdict::on("characters that act on a terminal");
    let mut silent = Vec::new();
    for (file, text) in files() {
        workspace.write(file, &text);
        if file.ends_with(".mtl") {
            continue;
        }
        let mut is_named = false;
        for line in [
            format!("inspect {file}"),
            format!("inspect {file} --json"),
            format!("render {file} --strict --size 4x4 --samples 1 -o a.png"),
            format!(
                "render {file} --strict --size 4x4 --samples 1 -o a.png --progress json --report -"
            ),
            format!("render {file} --camera nobody --clip nobody -o a.png"),
        ] {
            let run = workspace.run(&line);
            let shown = String::from_utf8_lossy(&run.stdout).into_owned() + &run.stderr;
            is_named |= shown.contains("qz");
            verdict.that(&line, !shown.contains(acts), || format!("{shown:?}"));
            verdict.that(&line, run.code != Some(1), || shown.clone());
        }
        if !is_named {
            silent.push(file);
        }
    }
    // The message on `raw.toml` says the line and column.
    assert_eq!(silent, ["raw.toml"]);
    verdict.close();
}

#[test]
fn json_keeps_names_in_its_own_escapes() {
    let workspace = Workspace::new();
    workspace.write("good.toml", &files()[0].1);
    let run = workspace.run("inspect good.toml --json").expect(0);
    let text = String::from_utf8(run.stdout).expect("UTF-8");
    assert!(!text.contains(acts), "{text:?}");
    assert!(
        text.contains("\\u202e") && text.contains("\\udb40\\udc01"),
        "{text}"
    );
    let report: Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(report["cameras"][0]["name"], NAME, "{report:#}");
}

#[test]
fn names_of_files_do_not_act_on_the_terminal() {
    let workspace = Workspace::new();
    let name = NAME.replace('\u{2028}', "");
    let path = workspace.path(&format!("{name}.scene"));
    std::fs::write(&path, "1\nwrong\n").expect("a file");
    let zip = workspace.path(&format!("{name}.zip"));
    std::fs::write(&zip, "no archive").expect("a file");
    for path in [path, zip, workspace.path(&format!("{name}.{name}"))] {
        let mut command = workspace.command("render");
        command.arg(&path).args(["-o", "a.png"]);
        let output = command.output().expect("glimray runs");
        let said = String::from_utf8(output.stderr).expect("UTF-8");
        assert_eq!(output.status.code(), Some(3), "{said}");
        assert!(said.contains("qz") && !said.contains(acts), "{said:?}");
    }
}
