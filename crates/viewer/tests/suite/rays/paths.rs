//! The ray inspector in a path-traced picture.

use super::{GLASS, click, inspect, weighted};
use crate::harness::Window;
use eframe::egui;
use egui_kittest::kittest::Queryable;
use glam::{DVec2, DVec3, Vec3};
use glimray::render::{Integrator, RayKind, Tone};
use glimray_viewer::actions::inspector;
use glimray_viewer::actions::inspector::outside;
use glimray_viewer::state::inspector::rows;
use glimray_viewer::state::inspector::rows::{Filter, Row};
use std::collections::BTreeSet;

const FLAGS: [&str; 7] = [
    GLASS,
    "--size",
    "64x36",
    "--samples",
    "4",
    "--integrator",
    "path",
];

/// A pixel of the clear ball.
const PIXEL: [u32; 2] = [33, 20];

fn open_paths() -> Window {
    let mut window = Window::open(&FLAGS);
    // Room for all properties of a ray.
    window.harness.set_size(egui::vec2(1280.0, 1200.0));
    inspect(&mut window, PIXEL);
    window
}

#[test]
fn a_click_shows_the_paths_of_the_pixel() {
    let mut window = open_paths();
    for pixel in [PIXEL, [12, 20], [47, 30]] {
        click(&mut window, pixel);
        let image = window.image(Tone::LINEAR);
        let [red, green, blue, _] = image.pixels[(pixel[1] * image.width + pixel[0]) as usize];
        let expected = Vec3::new(red, green, blue).as_dvec3();
        let session = window.session();
        let inspected = session.inspector.inspected.as_ref().expect("paths");
        assert_eq!(inspected.tree.integrator, Integrator::Path);
        assert!(!inspector::is_stale(&session));
        let bounces: DVec3 = rows::by_bounce(inspected, None).iter().sum();
        for sum in [weighted(&inspected.tree), bounces] {
            let gap = (sum - expected).abs().max_element();
            assert!(gap <= 1e-4, "{pixel:?}: {sum} is not {expected}");
        }
    }
    // The other integrator has other rays.
    window.session().view.settings.integrator = Integrator::Whitted;
    window.settle();
    assert!(inspector::is_stale(&window.session()));
}

#[test]
fn rays_of_a_path_follow_each_other_and_light_samples_are_below_them() {
    let mut window = open_paths();
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("paths");
    let listed = |folded: &BTreeSet<_>| {
        let rows = rows::rows(inspected, &Filter::default(), folded, None).into_iter();
        let ray = |row| match row {
            Row::Ray { id, level, .. } => Some((inspected.ray(id).expect("a ray").kind, level)),
            _ => None,
        };
        rows.filter_map(ray).collect::<Vec<_>>()
    };
    let all = listed(&BTreeSet::new());
    assert_eq!(all.len(), inspected.tree.samples[0].rays.len());
    let levels = all
        .iter()
        .map(|(kind, level)| (*level == 1) == (*kind == RayKind::Shadow));
    assert!(
        all.len() > 4 && levels.into_iter().all(|is_right| is_right),
        "{all:?}"
    );
    // Folded rays hide their light samples, and not the rest of the path.
    let folded = (0..all.len()).map(|ray| (0, ray)).collect();
    let segments: Vec<_> = all
        .iter()
        .filter(|(_, level)| *level == 0)
        .copied()
        .collect();
    assert_eq!(listed(&folded), segments);
    drop(session);
    // A ray tells how both ways to find a light share it.
    window
        .harness
        .get_by_label_contains("Ray 0: primary")
        .click();
    window.settle();
    let shows = |name: &str| window.harness.query_by_label_contains(name).is_some();
    for (property, value) in [("path", "goes on"), ("lobe", "boundary")] {
        assert!(shows(property) && shows(value), "no {property}: {value}");
    }
}

#[test]
fn lines_of_paths_end_where_they_meet_surfaces_and_skip_what_was_not_traced() {
    let window = open_paths();
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("paths");
    let camera = session.camera().expect("a camera");
    let filter = Filter {
        sample: None,
        ..Filter::default()
    };
    let size = DVec2::new(640.0, 360.0);
    let lines = outside::lines(inspected, &filter, &camera, size, 5.0, None);
    let rays = || {
        inspected
            .tree
            .samples
            .iter()
            .flat_map(|sample| &sample.rays)
    };
    let untraced = rays().filter(|ray| !ray.is_traced()).count();
    assert!(untraced > 0, "light samples behind a surface");
    for line in &lines {
        let ray = inspected.ray(line.id).expect("a ray");
        assert!(ray.is_traced(), "{ray:?}");
    }
    let kinds = |kind| lines.iter().filter(|line| line.kind == kind).count();
    assert!(kinds(RayKind::Refraction) >= 4 && kinds(RayKind::Shadow) > 0);
}
