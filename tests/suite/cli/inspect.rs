//! `inspect`, and the warning about missing lights.

use crate::support::program::Workspace;
use std::fs;

#[test]
fn inspect_lists_the_contents_of_a_scene() {
    let workspace = Workspace::new();
    let scene = workspace.run("inspect a.scene --json").expect(0).json();
    assert_eq!(scene["spheres"], 1);
    assert_eq!(scene["lights"], 1);
    assert_eq!(scene["triangles"], 0);
    assert_eq!(
        scene["bounds"]["min"],
        serde_json::json!([-1.0, -1.0, -4.0])
    );
    assert_eq!(
        scene["cameras"][0]["look_at"],
        serde_json::json!([0.0, 0.0, -1.0])
    );
    let text = workspace.run("inspect a.scene").expect(0);
    for line in [
        "spheres    1",
        "lights     1",
        "bounds     (-1, -1, -4) to (1, 1, -2)",
    ] {
        assert!(text.text().contains(line), "{}", text.text());
    }
}

#[test]
fn inspect_places_cameras_and_lights_in_the_world() {
    let workspace = Workspace::new();
    let text = "[camera]\nlook_from = [0, 0, 0]\nlook_at = [0, 0, -1]\ncarried_by = \"boom\"\n\
        [[nodes]]\nname = \"boom\"\ntransform = { translate = [1, 2, 3] }\n\
        [[lights]]\npoint = { position = [0, 1, 0] }\ncarried_by = \"boom\"";
    fs::write(workspace.path("boom.toml"), text).expect("a scene");
    let scene = workspace.run("inspect boom.toml --json").expect(0).json();
    let place = |x: f64, y: f64, z: f64| serde_json::json!([x, y, z]);
    assert_eq!(scene["cameras"][0]["look_from"], place(1.0, 2.0, 3.0));
    assert_eq!(scene["light_list"][0]["position"], place(1.0, 3.0, 3.0));
}

#[test]
fn inspect_lists_lenses_and_area_lights() {
    let workspace = Workspace::new();
    let text = "[camera]\nlook_from = [0, 0, 5]\nlook_at = [0, 0, 0]\nlens = { radius = 0.5, blades = 7 }\n\
        [[lights]]\ndisc = { center = [0, 4, 0], normal = [0, -1, 0], radius = 2, samples = 9, visible = false }";
    fs::write(workspace.path("lens.toml"), text).expect("a scene");
    let scene = workspace.run("inspect lens.toml --json").expect(0).json();
    let lens = &scene["cameras"][0]["lens"];
    assert_eq!(
        (&lens["radius"], &lens["focus_distance"], &lens["blades"]),
        (&0.5.into(), &5.0.into(), &7.into())
    );
    assert_eq!(scene["light_list"][0]["samples"], 9, "{scene}");
    let text = workspace.run("inspect lens.toml").expect(0);
    for part in [
        "lens radius 0.5, focus distance 5",
        "radius 2, attenuation inverse-square, 9 sample(s), invisible",
    ] {
        assert!(text.text().contains(part), "{}", text.text());
    }
}

/// A highlight of an exponent of 9 returns 2/(9 + 1) of k_s.
#[test]
fn materials_that_make_light_cause_a_warning_of_paths() {
    let workspace = Workspace::new();
    for (name, phong, warns) in [
        ("bright", "diffuse = [3, 0, 0]", true),
        ("shiny", "specular = [0, 5.1, 0], shininess = 9", true),
        (
            "dull",
            "diffuse = [1, 1, 1], specular = [4.9, 0, 0], shininess = 9",
            false,
        ),
    ] {
        let scene = format!(
            "[materials]\npaint = {{ phong = {{ {phong} }} }}\n[[lights]]\npoint = {{ position = [3, 3, 3] }}\n\
             [[objects]]\nsphere = {{ center = [0, 0, 0], radius = 1 }}\nmaterial = \"paint\"\n"
        );
        fs::write(workspace.path("scene.toml"), scene).expect("a scene");
        for (integrator, is_expected) in [("path", warns), ("whitted", false)] {
            let render = workspace.run(&format!(
                "render scene.toml --size 8x8 --samples 1 --integrator {integrator} -o a.png"
            ));
            let said = render.expect(0).stderr;
            let is_warned = said.contains("may reflect more light than arrives (`paint`)");
            assert_eq!(is_warned, is_expected, "{name}, {integrator}: {said}");
        }
    }
}

#[test]
fn a_scene_without_light_causes_one_warning() {
    let workspace = Workspace::new();
    let ball = "[[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\n";
    fs::write(workspace.path("dark.toml"), ball).expect("a scene");
    let lit = format!("[[lights]]\npoint = {{ position = [3, 3, 3] }}\n{ball}");
    fs::write(workspace.path("lit.toml"), lit).expect("a scene");
    for (name, count) in [("dark", 1), ("lit", 0)] {
        let render = workspace.run(&format!("render {name}.toml --size 8x8 -o {name}.png"));
        let said = render.expect(0).stderr;
        assert_eq!(said.matches("has no light").count(), count, "{said}");
        let inspect = workspace.run(&format!("inspect {name}.toml")).expect(0);
        let text = inspect.text();
        assert_eq!(text.matches("has no light").count(), count, "{text}");
        let json = workspace.run(&format!("inspect {name}.toml --json"));
        assert_eq!(json.expect(0).json()["unlit"], count == 1);
    }
}

#[test]
fn inspect_tells_the_parameters_of_physical_materials() {
    let workspace = Workspace::new();
    let text = "[materials]\n\
        gold = { pbr = { base_color = [1, 0.75, 0.25], metallic = 1, roughness = 0.25, clearcoat = 0.5 } }\n\
        water = { pbr = { roughness = 0, transmission = 1, ior = 1.25, thickness = 2, attenuation_distance = 4 } }\n\
        chalk = { phong = { diffuse = [0.5, 0.5, 0.5], specular = [0, 0, 0], shininess = 2 } }\n\
        [[objects]]\nsphere = { center = [0, 0, 0], radius = 1 }\nmaterial = \"gold\"\n\
        [[objects]]\nsphere = { center = [3, 0, 0], radius = 1 }\nmaterial = \"water\"\n\
        [[objects]]\nsphere = { center = [6, 0, 0], radius = 1 }\nmaterial = \"chalk\"\n";
    fs::write(workspace.path("three.toml"), text).expect("a scene");
    let run = workspace.run("inspect three.toml").expect(0);
    for line in [
        "`gold` base colour (1, 0.75, 0.25), metallic 1, roughness 0.25, clear coat 0.5\n",
        "metallic 0, roughness 0, ior 1.25, transmission 1, thickness 2, attenuation distance 4\n",
        "`chalk` diffuse (0.5, 0.5, 0.5), specular (0, 0, 0), shininess 2\n",
    ] {
        assert!(run.text().contains(line), "{line}: {}", run.text());
    }
    let scene = workspace.run("inspect three.toml --json").expect(0).json();
    let materials = scene["material_list"].as_array().expect("a list");
    let of = |name: &str| {
        let mut found = materials.iter().filter(|material| material["name"] == name);
        found.next().expect(name)["physical"].clone()
    };
    let (gold, water, chalk) = (of("gold"), of("water"), of("chalk"));
    assert_eq!(gold["base_color"], serde_json::json!([1.0, 0.75, 0.25]));
    assert_eq!(
        (&gold["metallic"], &gold["clearcoat"]),
        (&1.0.into(), &0.5.into())
    );
    assert_eq!(gold["attenuation_distance"], serde_json::Value::Null);
    assert_eq!(
        (&water["ior"], &water["attenuation_distance"]),
        (&1.25.into(), &4.0.into())
    );
    assert_eq!(chalk, serde_json::Value::Null);
}
