//! A scene of ten thousand objects stays quick: outline, selection and undo take at most 50 ms each.

use crate::support::effort::within;
use glam::{DAffine3, DVec3, dvec3};
use glimray::scene::{Camera, Geometry, Material, ObjectRef, Scene, Shape};
use glimray_viewer::model::document::Document;
use glimray_viewer::model::listing::Listing;
use glimray_viewer::model::objects::{self, Id};

const COUNT: usize = 10_000;

/// Balls with a material each.
fn scene() -> Scene {
    let ball = |index: usize| Shape {
        geometry: Geometry::Sphere {
            center: dvec3((index % 100) as f64, 0.0, (index / 100) as f64),
            radius: 0.4,
        },
        material: index,
        node: None,
        name: String::new(),
    };
    Scene {
        shapes: (0..COUNT).map(ball).collect(),
        materials: vec![Material::default(); COUNT],
        cameras: vec![Camera::default()],
        ..Scene::default()
    }
}

fn all() -> Vec<Id> {
    (0..COUNT)
        .map(|index| Id::Object(ObjectRef::Shape(index)))
        .collect()
}

#[test]
fn the_outline_of_ten_thousand_objects_is_listed_in_50_ms() {
    let document = Document::new(scene());
    let mut listing = Listing::default();
    within(50.0, || listing.update(document.scene()));
    // Three headings more, and a camera; materials too.
    assert_eq!(listing.count(), 2 * COUNT + 5);
    let label = listing.label(document.scene(), all()[COUNT - 1]);
    assert_eq!(label, Some("sphere 10000 (material 10000)"));
    listing.query = "9999".to_owned();
    within(50.0, || listing.update(document.scene()));
    assert_eq!(listing.count(), 4);
}

#[test]
fn ten_thousand_objects_are_moved_deleted_and_brought_back_in_50_ms_each() {
    let mut document = Document::new(scene());
    let before = document.scene().clone();
    let ids = all();
    document.note_selection(&ids);
    let moved = within(50.0, || objects::movable(document.scene(), &ids));
    assert_eq!(moved.len(), COUNT);
    let (place, _) = within(50.0, || {
        objects::common_place(document.scene(), &moved, 0.0)
    })
    .expect("a middle");
    assert_eq!(place.translation, dvec3(49.5, 0.0, 49.5));
    let change = DAffine3::from_translation(DVec3::Y);
    within(50.0, || {
        document.try_edit("move", |scene| {
            objects::transform(scene, &moved, change, 0.0)
        })
    })
    .expect("moved");
    within(50.0, || {
        document.try_edit("hide", |scene| objects::set_all_visible(scene, &ids, false))
    })
    .expect("hidden");
    within(50.0, || {
        document.try_edit("show", |scene| {
            objects::show_all(scene);
            Ok::<_, ()>(())
        })
    })
    .expect("shown");
    let shown = document.scene().clone();
    let half = &ids[..COUNT / 2];
    within(50.0, || {
        document.try_edit("delete", |scene| objects::remove(scene, half))
    })
    .expect("deleted");
    assert_eq!(document.scene().shapes.len(), COUNT / 2);
    let now = document.scene().clone();
    for _ in 0..4 {
        within(50.0, || document.undo());
    }
    assert!(*document.scene() == before, "it is not undone");
    let kept = within(50.0, || objects::same(&shown, &now, &ids));
    assert_eq!(kept.len(), COUNT / 2);
}
