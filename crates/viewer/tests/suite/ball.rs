//! The preview of a material on a ball.

use crate::edit::{BLUE, RED, file, open, perform};
use crate::harness::Window;
use crate::pixels;
use glimray::scene::Phong;
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::objects::Id;

/// The colour in the middle of the preview, and that of its corner.
fn colors(window: &Window) -> Option<[[u8; 3]; 2]> {
    let screen = window.harness.state().render_thread().ball()?;
    let bytes = pixels::on(&screen, &window.gpu);
    let (width, height) = bytes.size;
    let middle = (height / 2 * width + width / 2) as usize;
    Some([bytes.rgb[middle], bytes.rgb[0]])
}

#[test]
fn the_preview_shows_the_material_of_what_is_selected() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    assert_eq!(colors(&window), None, "nothing is selected");
    let picture = pixels::on(&window.shown().screen.expect("a picture"), &window.gpu);
    window.session().select(vec![RED]);
    window.settle();
    let [[red, green, blue], ground] = colors(&window).expect("a preview");
    assert!(red > 2 * green && red > 2 * blue, "{red} {green} {blue}");
    // The background is grey.
    assert!(ground[0].abs_diff(ground[2]) <= 2, "{ground:?}");
    window.session().select(vec![BLUE]);
    window.settle();
    let [[red, green, blue], _] = colors(&window).expect("a preview");
    assert!(blue > 2 * green && blue > 2 * red, "{red} {green} {blue}");
    // An edit of the material shows in it.
    window.session().change("make it green", |scene| {
        scene.materials[0].bsdf = Phong {
            diffuse: glam::vec3(0.0, 0.8, 0.0),
            ..Phong::default()
        }
        .into();
        scene.materials[1].bsdf = scene.materials[0].bsdf.clone();
        Ok(())
    });
    window.settle();
    let [[red, green, blue], _] = colors(&window).expect("a preview");
    assert!(green > 2 * blue && green > 2 * red, "{red} {green} {blue}");
    perform(&mut window, Action::Undo);
    let again = pixels::on(&window.shown().screen.expect("a picture"), &window.gpu);
    again.assert_same(&picture, "the picture of the scene");
    window.session().select(Vec::new());
    window.settle();
    assert_eq!(colors(&window), None);
}

#[test]
fn the_preview_of_a_material_is_not_made_again_for_edits_of_other_things() {
    let (_folder, path) = file();
    let mut window = open(&path, "64x48");
    window.session().select(vec![RED]);
    window.settle();
    let ball = |window: &Window| {
        let requests = window.session().requests();
        let ball = requests.ball.expect("a preview");
        std::sync::Arc::as_ptr(&ball.scene)
    };
    let before = ball(&window);
    window.session().change("move the lamp", |scene| {
        scene.lights.clear();
        scene.materials[1].priority = 3;
        Ok(())
    });
    window.settle();
    assert_eq!(ball(&window), before);
    window.session().change("change the material", |scene| {
        scene.materials[0].priority = 3;
        Ok(())
    });
    window.settle();
    assert_ne!(ball(&window), before);
    assert!(matches!(window.session().selection, Some(Id::Object(_))));
}
