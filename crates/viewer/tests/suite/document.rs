//! The scene that is being edited: what is done to it, taken back, and done again.

use glam::{DAffine3, DQuat, DVec3, Vec3};
use glimray::scene::{Camera, Geometry, Instance, Material, Mesh, Scene, Shape};
use glimray_viewer::model::document::Document;
use std::sync::Arc;

fn scene() -> Scene {
    Scene {
        materials: vec![Material::default()],
        cameras: vec![Camera::default()],
        ambient: Vec3::ZERO,
        ..Scene::default()
    }
}

fn brighten(document: &mut Document, to: f32) {
    document.edit(&format!("light up to {to}"), |scene| {
        scene.ambient = Vec3::splat(to)
    });
}

fn brightness(document: &Document) -> f32 {
    document.scene().ambient.x
}

#[test]
fn steps_are_taken_back_and_done_again_in_order_and_by_name() {
    let mut document = Document::new(scene());
    assert_eq!((document.undo(), document.redo()), (None, None));
    for to in [1.0, 2.0, 3.0] {
        brighten(&mut document, to);
    }
    assert_eq!(document.undo_name(), Some("light up to 3"));
    assert_eq!(document.undo().as_deref(), Some("light up to 3"));
    assert_eq!(document.undo().as_deref(), Some("light up to 2"));
    assert_eq!(
        (brightness(&document), document.redo_name()),
        (1.0, Some("light up to 2"))
    );
    assert_eq!(document.redo().as_deref(), Some("light up to 2"));
    assert_eq!(brightness(&document), 2.0);
    // Something new leaves nothing to do again.
    brighten(&mut document, 9.0);
    assert_eq!((document.redo(), document.undo_count()), (None, 3));
    document.undo();
    document.undo();
    document.undo();
    assert_eq!((brightness(&document), document.undo()), (0.0, None));
}

#[test]
fn all_of_one_drag_is_one_step_that_starts_where_it_began() {
    let mut document = Document::new(scene());
    brighten(&mut document, 1.0);
    let add = |document: &mut Document, by: f32| {
        document.drag("drag", |scene| {
            scene.ambient += by;
            Ok::<(), ()>(())
        })
    };
    for by in [1.0, 2.0, 5.0] {
        add(&mut document, by).expect("dragged");
    }
    // Each goes by the scene as it was at first.
    assert_eq!((brightness(&document), document.undo_count()), (6.0, 2));
    document.release();
    add(&mut document, 1.0).expect("dragged");
    assert_eq!((brightness(&document), document.undo_count()), (7.0, 3));
    document.cancel();
    assert_eq!((brightness(&document), document.undo_count()), (6.0, 2));
    document.undo();
    assert_eq!(brightness(&document), 1.0);
    assert_eq!(document.redo().as_deref(), Some("drag"));
    assert_eq!(brightness(&document), 6.0);
}

#[test]
fn what_fails_changes_nothing_and_is_no_step() {
    let mut document = Document::new(scene());
    let before = document.scene().clone();
    let fails = |scene: &mut Scene| {
        scene.ambient = Vec3::ONE;
        Err::<(), _>("no")
    };
    assert_eq!(document.try_edit("x", fails), Err("no"));
    assert_eq!(document.drag("x", fails), Err("no"));
    assert!(Arc::ptr_eq(&before, document.scene()) && document.undo_count() == 0);
    assert!(!document.is_changed());
}

#[test]
fn a_scene_counts_as_changed_until_it_is_saved_or_back_as_it_was() {
    let mut document = Document::new(scene());
    assert!(!document.is_changed());
    brighten(&mut document, 1.0);
    assert!(document.is_changed());
    document.undo();
    assert!(!document.is_changed());
    document.redo();
    document.mark_saved();
    assert!(!document.is_changed());
    document.undo();
    assert!(document.is_changed());
    document.revert();
    assert_eq!((brightness(&document), document.is_changed()), (1.0, false));
    assert_eq!(document.undo().as_deref(), Some("revert"));
    assert_eq!(brightness(&document), 0.0);
    let other = Scene {
        ambient: Vec3::splat(5.0),
        ..scene()
    };
    document.reload(other);
    assert_eq!((brightness(&document), document.is_changed()), (5.0, false));
    document.undo();
    assert_eq!((brightness(&document), document.is_changed()), (0.0, true));
}

#[test]
fn old_steps_are_forgotten_where_they_take_too_much_memory_but_never_the_last() {
    let mut large = scene();
    large.shapes = vec![
        Shape {
            geometry: Geometry::Sphere {
                center: DVec3::ZERO,
                radius: 1.0,
            },
            material: 0,
            node: None,
            name: String::new(),
        };
        1000
    ];
    let each = size_of_val(large.shapes.as_slice());
    let mut document = Document::new(large).with_memory(10 * each);
    for to in 1..=100_u8 {
        brighten(&mut document, to.into());
    }
    assert!(
        (5..=10).contains(&document.undo_count()),
        "{}",
        document.undo_count()
    );
    let mut tiny = Document::new(scene()).with_memory(1);
    brighten(&mut tiny, 1.0);
    brighten(&mut tiny, 2.0);
    assert_eq!(
        (tiny.undo_count(), tiny.undo().as_deref()),
        (1, Some("light up to 2"))
    );
}

#[test]
fn steps_share_meshes() {
    let mut with_mesh = scene();
    with_mesh.meshes.push(Arc::new(Mesh {
        positions: vec![Vec3::ZERO; 1 << 20],
        ..Mesh::default()
    }));
    with_mesh.instances.push(Instance {
        mesh: 0,
        placement: DAffine3::from_quat(DQuat::IDENTITY),
        node: None,
        name: String::new(),
    });
    let mut document = Document::new(with_mesh).with_memory(1 << 20);
    for to in 1..=50_u8 {
        brighten(&mut document, to.into());
    }
    assert_eq!(document.undo_count(), 50);
    let mesh = document.scene().meshes[0].clone();
    while document.undo().is_some() {}
    assert!(Arc::ptr_eq(&mesh, &document.scene().meshes[0]));
}
