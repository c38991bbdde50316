//! The section plane of the scene.

use crate::model::objects;
use crate::state::session::Session;
use crate::ui::panels::properties::fields::{Fields, Limits};
use glam::DVec3;
use glimray_scene::{Scene, Section};

/// Whether there is a plane, where it lies, and which side it cuts away.
pub fn show(fields: &mut Fields, session: &Session) {
    fields.heading("Section plane");
    let section = fields.scene.section;
    let toward_camera = toward_camera(session);
    let tip = "Cut away what lies before a plane through the middle of the scene. Closed solids get a face there.";
    fields.toggle(("Cut open", tip), section.is_some(), move |scene, to| {
        scene.section = to.then(|| through(middle(scene), nearest_axis(toward_camera)));
    });
    let Some(Section { normal, offset }) = section else {
        return;
    };
    let tip = "Distance of the plane from the origin, along its direction.";
    fields.number(("Offset", tip), offset, Limits::LENGTH, |scene, to| {
        change(scene, |section| section.offset = to);
    });
    let tip = "Direction towards what is cut away.";
    fields.vector(
        ("Direction", tip),
        normal,
        Limits::LENGTH,
        move |scene, to| {
            if let Some(normal) = to.try_normalize() {
                let middle = middle(scene);
                change(scene, |section| {
                    let height = section.offset - section.normal.dot(middle);
                    *section = through(middle + height * section.normal, normal);
                });
            }
        },
    );
    let tip = "Cut away what is nearer to the camera than the plane, which turns about the middle of the scene.";
    let button = fields.draw(|ui, _| ui.button("Face the camera").on_hover_text(tip));
    if button.is_some_and(|button| button.clicked()) {
        fields.change("section plane", move |scene| {
            scene.section = Some(through(middle(scene), toward_camera));
            Ok(())
        });
    }
}

fn change(scene: &mut Scene, change: impl FnOnce(&mut Section)) {
    if let Some(section) = &mut scene.section {
        change(section);
    }
}

/// The middle of what can be seen.
fn middle(scene: &Scene) -> DVec3 {
    let (min, max) = objects::subject(scene).unwrap_or_default();
    min.midpoint(max)
}

fn through(point: DVec3, normal: DVec3) -> Section {
    Section {
        normal,
        offset: normal.dot(point),
    }
}

/// The unit direction to the camera from what it looks at.
fn toward_camera(session: &Session) -> DVec3 {
    let camera = session.camera();
    let away = camera.map(|camera| camera.look_from - camera.look_at);
    away.and_then(DVec3::try_normalize).unwrap_or(DVec3::Z)
}

/// The axis, up or down, that is nearest to a direction.
fn nearest_axis(direction: DVec3) -> DVec3 {
    let largest = direction.abs().max_element();
    let mut axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter();
    let nearest = axes.find(|axis| direction.dot(*axis).abs() == largest);
    nearest.map_or(DVec3::Z, |axis| axis * direction.dot(axis).signum())
}
