//! Ready-made materials: chosen in the window, and held against facts about what they stand for.

use crate::edit::{perform, scene};
use crate::harness::Window;
use crate::making::{choose, click, click_row};
use crate::support::verdict::Verdict;
use eframe::egui::Role;
use egui_kittest::kittest::Queryable;
use glimray::render::Tone;
use glimray::scene::ObjectRef;
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::objects::Id;
use tempfile::TempDir;

/// Side of the picture in pixels, and the distance of a pixel near the rim of the ball from the middle.
const SIDE: usize = 33;
const RIM: usize = 14;

/// A ball of radius 1 before a wall that glows red; all else around it is of one colour.
fn open(around: f64) -> (TempDir, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("ball.toml");
    let text = format!(
        r#"
background = [{around}, {around}, {around}]

[camera]
look_from = [0, 0, 9]
look_at = [0, 0, 0]
orthographic = 2.2

[materials.tested]
phong = {{ diffuse = [0.5, 0.5, 0.5] }}

[materials.wall]
phong = {{ diffuse = [0, 0, 0] }}
emission = [{around}, 0, 0]

[[objects]]
sphere = {{ center = [0, 0, 0], radius = 1 }}
material = "tested"

[[objects]]
rectangle = {{ center = [0, 0, -4], normal = [0, 0, 1], size = [5, 5] }}
material = "wall"
"#
    );
    std::fs::write(&path, text).expect("a scene");
    let path = path.to_str().expect("UTF-8");
    let size = format!("{SIDE}x{SIDE}");
    let (integrator, samples) = (["--integrator", "path"], ["--samples", "64"]);
    let arguments = [&[path][..], &["--size", &size], &integrator, &samples].concat();
    let mut window = Window::open(&arguments);
    window.settle();
    (folder, window)
}

/// Chooses a preset for the ball as a hand does. Returns the colours in the middle of the ball and near its rim.
fn colors(window: &mut Window, preset: &str) -> [[f32; 3]; 2] {
    window
        .session()
        .select(vec![Id::Object(ObjectRef::Shape(0))]);
    window.settle();
    let row = (window.harness).get_by_role_and_label(Role::ComboBox, "Preset");
    row.click_accesskit();
    window.harness.run_steps(4);
    click_row(window, preset);
    window.settle();
    let image = window.image(Tone::LINEAR);
    [0, RIM].map(|right| {
        let [red, green, blue, _] = image.pixels[SIDE / 2 * SIDE + SIDE / 2 + right];
        [red, green, blue]
    })
}

fn is_near(found: [f32; 3], expected: [f32; 3], margin: f32) -> bool {
    (0..3).all(|channel| (found[channel] - expected[channel]).abs() <= margin)
}

/// Reflectance along the normal of a boundary between air and a medium.
fn reflectance(ior: f32) -> f32 {
    ((ior - 1.0) / (ior + 1.0)).powi(2)
}

#[test]
fn presets_look_as_what_they_stand_for() {
    let (_folder, mut window) = open(1.0);
    let mut verdict = Verdict::on("ready-made materials");
    let mut check = |preset: &str, is_so: fn([f32; 3], [f32; 3]) -> bool| {
        let [middle, rim] = colors(&mut window, preset);
        verdict.that(preset, is_so(middle, rim), || {
            format!("middle {middle:?}, rim {rim:?}")
        });
        perform(&mut window, Action::Undo);
    };
    // The middle reflects what is white, in the colour of gold's reflectance.
    check("Gold", |middle, _| {
        is_near(middle, [1.0, 0.766, 0.336], 0.03)
    });
    // The red wall is seen through both sides, which reflect 4 % of what is white each.
    check("Glass", |middle, _| {
        let lost = 2.0 * reflectance(1.5);
        is_near(middle, [1.0, lost, lost], 0.03)
    });
    // A matte surface shows the share of the light that it reflects.
    check("Clay", |middle, _| {
        is_near(middle, [0.296, 0.205, 0.178], 0.06)
    });
    // The coat reflects 4 % of all colours along the normal, and much more near the rim.
    check("Car paint", |middle, rim| {
        let coat = reflectance(1.5);
        let is_coated = middle[2] > coat && middle[2] < 2.0 * coat;
        is_coated && middle[0] > 0.4 && rim[2] > 1.5 * middle[2]
    });
    // Fibres stand out from the cloth, so that light from the side meets most of them.
    check("Velvet", |middle, rim| rim[0] > 1.5 * middle[0]);
    // A film of 400 nm and index 1.33 has a light path of 1064 nm: twice 532 nm, which is extinguished.
    check("Soap film", |middle, _| {
        middle[0] > 0.9 && middle[2] > 3.0 * middle[1] && middle[2] > reflectance(1.33)
    });
    verdict.close();
}

#[test]
fn the_emissive_preset_glows_without_light() {
    let (_folder, mut window) = open(0.0);
    let before = scene(&window);
    let dark = window.image(Tone::LINEAR);
    assert!(dark.pixels.iter().all(|[r, g, b, _]| r + g + b == 0.0));
    let [middle, rim] = colors(&mut window, "Emissive");
    // Hot bodies are redder than they are green, and greener than they are blue.
    assert!(
        middle[0] > middle[1] && middle[1] > middle[2] && middle[2] > 0.0,
        "{middle:?}"
    );
    assert!(is_near(middle, rim, 0.05), "{middle:?} {rim:?}");
    // One step, named after what it did.
    let named = window.session().document.as_ref().and_then(|it| {
        assert_eq!(it.undo_count(), 1);
        it.undo_name().map(str::to_owned)
    });
    assert_eq!(named.as_deref(), Some("change preset of tested"));
    assert_eq!(scene(&window).materials[0].name, "tested");
    perform(&mut window, Action::Undo);
    assert!(scene(&window) == before);
}

#[test]
fn a_material_is_added_to_the_selected_objects_or_alone() {
    let (_folder, mut window) = open(1.0);
    let choose = |window: &mut Window, material: &str| {
        choose(window, "Add", "Material");
        window.harness.run_steps(6);
        click(window, material);
        window.settle();
    };
    choose(&mut window, "Gold");
    assert_eq!(window.session().selection, Some(Id::Material(2)));
    let found = scene(&window);
    assert_eq!(found.materials[2].name, "Gold");
    assert_eq!(found.shapes[0].material, 0);
    let ball = Id::Object(ObjectRef::Shape(0));
    window.session().select(vec![ball]);
    window.settle();
    choose(&mut window, "Gold");
    let found = scene(&window);
    assert_eq!(
        (found.shapes[0].material, found.materials[3].name.as_str()),
        (3, "Gold 2")
    );
    assert_eq!(window.session().selection, Some(ball));
    perform(&mut window, Action::Undo);
    assert_eq!(scene(&window).shapes[0].material, 0);
}
