//! The rays of a pixel in the window: shown, folded, drawn in space and saved.

mod paths;

use crate::edit::perform;
use crate::harness::Window;
use crate::support::effort;
use eframe::egui;
use egui_kittest::kittest::{NodeT, Queryable, by};
use glam::{DMat4, DVec2, DVec3, Vec3, dvec2};
use glimray::render::{RayKind, RayTree, SampleTree, Tone, TracedRay};
use glimray::scene::{Camera, ObjectRef};
use glimray_viewer::actions::inspector;
use glimray_viewer::actions::inspector::export;
use glimray_viewer::actions::inspector::export::Format;
use glimray_viewer::actions::inspector::{hidden, outside};
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::file_dialog::{FileDialogs, Reply};
use glimray_viewer::model::objects::Id;
use glimray_viewer::state::inspector::ray_labels;
use glimray_viewer::state::inspector::rows;
use glimray_viewer::state::inspector::rows::{Filter, Row};
use glimray_viewer::state::inspector::{Inspected, PARTS};
use std::collections::BTreeSet;

const GLASS: &str = "assets/scenes/glass_and_mirrors.toml";

/// Takes the tool and clicks on a pixel of the picture.
fn inspect(window: &mut Window, pixel: [u32; 2]) {
    window.settle();
    window.harness.key_press(egui::Key::I);
    window.settle();
    click(window, pixel);
}

fn click(window: &mut Window, pixel: [u32; 2]) {
    let viewport = window.session().viewport.expect("a picture");
    let [x, y] = pixel.map(f64::from);
    let point = viewport.point(dvec2(x + 0.5, y + 0.5));
    window.harness.hover_at(point);
    window.harness.step();
    window.harness.drag_at(point);
    window.harness.step();
    window.harness.drop_at(point);
    window.settle();
}

fn open_glass(pixel: [u32; 2]) -> Window {
    let mut window = Window::open(&[GLASS, "--size", "64x36", "--samples", "4"]);
    inspect(&mut window, pixel);
    window
}

/// The mean of what all rays add, by the weights of their samples.
fn weighted(tree: &RayTree) -> DVec3 {
    let (mut sum, mut weights) = (DVec3::ZERO, 0.0);
    for sample in &tree.samples {
        let rays = sample.rays.iter();
        let own: DVec3 = rays.map(|r| Vec3::from(r.contribution).as_dvec3()).sum();
        sum += f64::from(sample.weight) * own;
        weights += f64::from(sample.weight);
    }
    sum / weights
}

#[test]
fn a_click_with_the_tool_shows_rays_that_add_up_to_the_pixel() {
    let mut window = open_glass([31, 18]);
    for pixel in [[31, 18], [12, 20], [47, 22], [5, 3]] {
        click(&mut window, pixel);
        let image = window.image(Tone::LINEAR);
        let [red, green, blue, _] = image.pixels[(pixel[1] * image.width + pixel[0]) as usize];
        let expected = Vec3::new(red, green, blue).as_dvec3();
        let session = window.session();
        let inspected = session.inspector.inspected.as_ref().expect("a tree");
        assert_eq!(inspected.tree.pixel, pixel);
        assert_eq!(inspected.tree.samples.len(), 4);
        assert!(!inspector::is_stale(&session));
        let bounces: DVec3 = rows::by_bounce(inspected, None).iter().sum();
        for sum in [weighted(&inspected.tree), bounces] {
            let gap = (sum - expected).abs().max_element();
            assert!(gap <= 1e-4, "{pixel:?}: {sum} is not {expected}");
        }
        drop(session);
        window.harness.get_by_label_contains("Ray 0: primary");
        window.harness.get_by_label_contains("Sum of 4 samples");
        let [x, y] = pixel;
        window.harness.get_by_label(&format!("Pixel {x},{y}"));
    }
}

#[test]
fn branches_fold_and_unfold_by_name() {
    let mut window = open_glass([31, 18]);
    let shows = |window: &Window, name: &str| {
        let found = window.harness.query_by_label_contains(name);
        found.is_some()
    };
    assert!(shows(&window, "Ray 1: "));
    window.harness.get_by_label("Collapse ray 0").click();
    window.settle();
    assert!(!shows(&window, "Ray 1: "));
    assert!(shows(&window, "Ray 0: "));
    window.harness.get_by_label("Expand ray 0").click();
    window.settle();
    assert!(shows(&window, "Ray 1: "));
    window.harness.get_by_label("Collapse all").click();
    window.settle();
    assert!(!shows(&window, "Ray 1: "));
    window.harness.get_by_label("Expand all").click();
    window.settle();
    assert!(shows(&window, "Ray 1: "));
    // A ray tells about itself once it is chosen.
    assert!(!shows(&window, "origin"));
    window.harness.get_by_label_contains("Ray 0: ").click();
    window.settle();
    assert!(shows(&window, "origin"));
}

#[test]
fn every_control_of_the_inspector_has_a_name() {
    use egui::Role;
    let window = open_glass([31, 18]);
    let controls = [
        Role::Button,
        Role::CheckBox,
        Role::Slider,
        Role::SpinButton,
        Role::Image,
    ];
    let is_control =
        |node: &egui_kittest::kittest::AccessKitNode<'_>| controls.contains(&node.role());
    let mut count = 0;
    for node in window.harness.query_all(by().predicate(is_control)) {
        let node = node.accesskit_node();
        let name = node.label().unwrap_or_default();
        assert!(
            !name.trim().is_empty(),
            "a {:?} without a name",
            node.role()
        );
        count += 1;
    }
    assert!(count > 30, "{count} controls");
    for name in [
        "Inspect rays",
        "Column",
        "Row",
        "Inspect",
        "Follow the cursor",
        "Path in picture",
        "Previous sample",
        "Next sample",
        "All samples",
        "Up to bounce",
        "Shadow rays",
        "Bounce 0",
        "Save JSON…",
        "Save OBJ…",
        "Copy as command",
        "Rays in space",
        "Frame rays",
        "From the camera",
        "Normals",
        "Plain",
    ] {
        let found = window.harness.query_all_by_label(name).count();
        assert!(found > 0, "no {name}");
    }
}

#[test]
fn shadow_rays_and_bounces_are_left_out_where_that_is_asked_for() {
    let window = open_glass([31, 18]);
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    let listed = |filter: Filter| {
        let rows = rows::rows(inspected, &filter, &BTreeSet::new(), None);
        let ids = rows.into_iter().filter_map(|row| match row {
            Row::Ray { id, .. } => Some(id),
            _ => None,
        });
        ids.collect::<Vec<_>>()
    };
    let all = Filter {
        sample: None,
        ..Filter::default()
    };
    let every: usize = inspected.tree.samples.iter().map(|s| s.rays.len()).sum();
    assert_eq!(listed(all).len(), every);
    let kind = |id| inspected.ray(id).expect("a ray").kind;
    let without = listed(Filter {
        shadows: false,
        ..all
    });
    assert!(without.iter().all(|id| kind(*id) != RayKind::Shadow));
    assert!((1..every).contains(&without.len()));
    // Rays of no bounce are the primary rays and their shadow rays.
    for id in listed(Filter { bounces: 0, ..all }) {
        let ray = inspected.ray(id).expect("a ray");
        let from_first = ray.kind == RayKind::Shadow && ray.parent == Some(0);
        assert!(ray.kind == RayKind::Primary || from_first, "{ray:?}");
    }
}

#[test]
fn the_last_pixel_that_is_asked_for_is_the_one_that_is_shown() {
    let mut window = Window::open(&["--size", "64x48", "--samples", "2"]);
    window.settle();
    for x in 10..30 {
        inspector::inspect(&mut window.session(), [x, 20]);
    }
    window.settle();
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    assert_eq!(inspected.tree.pixel, [29, 20]);
}

#[test]
fn the_tree_stays_and_says_so_when_the_picture_changes() {
    const STALE: &str = "The picture has changed. Inspect again.";
    let mut window = open_glass([31, 18]);
    assert!(window.harness.query_by_label(STALE).is_none());
    window
        .session()
        .controller
        .as_mut()
        .expect("a rig")
        .orbit_by(0.3, 0.0);
    window.settle();
    window.harness.get_by_label(STALE);
    window.harness.get_by_label_contains("Ray 0: primary");
    window.harness.get_by_label("Inspect").click();
    window.settle();
    assert!(window.harness.query_by_label(STALE).is_none());
}

#[test]
fn rays_that_cannot_be_saved_are_trouble_that_is_told() {
    let mut window = open_glass([31, 18]);
    for (reply, words) in [
        (Reply::Unavailable, "no file dialog"),
        (
            Reply::Chosen("/no/such/folder/rays.json".into()),
            "/no/such/folder",
        ),
    ] {
        window.session().files.dialogs = FileDialogs::answering(move |_| reply.clone());
        let ctx = window.harness.ctx.clone();
        export::save(&mut window.session(), Format::Json, &ctx);
        window.settle();
        let session = window.session();
        let details = session.messages.all().last().expect("a notice");
        assert!(
            details.text.contains(words) && details.is_trouble,
            "{}",
            details.text
        );
    }
}

/// Where a point is in a picture, by the matrices of a textbook.
fn by_matrices(camera: &Camera, point: DVec3, size: DVec2) -> DVec2 {
    let back = (camera.look_from - camera.look_at).normalize();
    let right = camera.up.cross(back).normalize();
    let world_from_view = DMat4::from_cols(
        right.extend(0.0),
        back.cross(right).extend(0.0),
        back.extend(0.0),
        camera.look_from.extend(1.0),
    );
    let cotangent = 1.0 / (camera.fov_y / 2.0).tan();
    let (near, far) = (1e-3, 1e6);
    let clip_from_view = DMat4::from_cols_array_2d(&[
        [cotangent * size.y / size.x, 0.0, 0.0, 0.0],
        [0.0, cotangent, 0.0, 0.0],
        [0.0, 0.0, far / (near - far), -1.0],
        [0.0, 0.0, near * far / (near - far), 0.0],
    ]);
    let place = clip_from_view * world_from_view.inverse() * point.extend(1.0);
    (dvec2(place.x, -place.y) / place.w + 1.0) / 2.0 * size
}

#[test]
fn lines_in_space_end_where_their_rays_do() {
    let pixel = [31, 18];
    let window = open_glass(pixel);
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    let all = Filter {
        sample: None,
        ..Filter::default()
    };
    // From outside.
    let camera = session
        .inspector
        .outside
        .controller
        .as_ref()
        .expect("a rig");
    let camera = camera.camera();
    let size = dvec2(400.0, 300.0);
    let lines = outside::lines(inspected, &all, &camera, size, 5.0, None);
    let mut checked = 0;
    for line in lines
        .iter()
        .filter(|line| line.end == outside::End::Surface)
    {
        let ray = inspected.ray(line.id).expect("a ray");
        let end = DVec3::from(ray.end.expect("an end"));
        let expected = by_matrices(&camera, end, size);
        assert!(line.to.distance(expected) < 1e-3, "{line:?} {expected}");
        assert_eq!(
            outside::nearest(std::slice::from_ref(line), expected, 1.0),
            Some(line.id)
        );
        checked += 1;
    }
    assert!(checked >= 8, "{checked} lines end on surfaces");
    // From the camera of the picture every primary ray ends in its own pixel, as far as the filter
    // reaches.
    let camera = session.camera().expect("a camera");
    let size = dvec2(64.0, 36.0);
    let lines = outside::lines(inspected, &all, &camera, size, 5.0, None);
    let primary = lines.iter().filter(|line| line.kind == RayKind::Primary);
    let reach = f64::from(inspected.request.settings.filter_radius) + 0.01;
    let middle = DVec2::from(pixel.map(f64::from)) + 0.5;
    let mut seen = 0;
    for line in primary {
        let off = (line.to - middle).abs().max_element();
        assert!(off <= reach.max(0.51), "{line:?}");
        seen += 1;
    }
    assert_eq!(seen, 4);
}

#[test]
fn a_line_that_starts_behind_the_second_camera_is_cut_before_it() {
    let window = open_glass([31, 18]);
    let session = window.session();
    let picture = session.camera().expect("a camera");
    let forward = (picture.look_at - picture.look_from).normalize();
    // In the middle of the primary rays, looking the same way.
    let camera = Camera {
        look_from: picture.look_from + forward * 2.0 + picture.up * 0.2,
        look_at: picture.look_at,
        ..picture.clone()
    };
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    let lines = outside::lines(
        inspected,
        &Filter::default(),
        &camera,
        dvec2(64.0, 36.0),
        5.0,
        None,
    );
    let primary = lines.iter().find(|line| line.kind == RayKind::Primary);
    let primary = primary.expect("the primary ray, cut");
    let ray = inspected.ray(primary.id).expect("a ray");
    let start = DVec3::from(ray.origin);
    assert!((start - camera.look_from).dot(forward) < 0.0);
    let end = by_matrices(
        &camera,
        DVec3::from(ray.end.expect("an end")),
        dvec2(64.0, 36.0),
    );
    assert!(primary.to.distance(end) < 1e-3);
    assert!(primary.from.is_finite() && primary.from.distance(primary.to) > 1.0);
}

#[test]
fn a_tree_of_very_many_rays_is_listed_at_once() {
    let window = open_glass([31, 18]);
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    // A mirrored ray of a mirrored ray of …
    let first = inspected.tree.samples[0].rays[0].clone();
    const COUNT: usize = 1 << 16;
    let ray = |index: usize| TracedRay {
        kind: if index == 0 {
            RayKind::Primary
        } else {
            RayKind::Reflection
        },
        parent: index.checked_sub(1),
        children: (index + 1 < COUNT)
            .then_some(index + 1)
            .into_iter()
            .collect(),
        ..first.clone()
    };
    let tree = RayTree {
        samples: vec![SampleTree {
            rays: (0..COUNT).map(ray).collect(),
            ray_count: COUNT,
            ..inspected.tree.samples[0].clone()
        }],
        ..inspected.tree.clone()
    };
    let long = Inspected::new(tree, inspected.request.clone(), true);
    let rows = || rows::rows(&long, &Filter::default(), &BTreeSet::new(), None);
    let rows = effort::within(2000.0, rows);
    assert_eq!(rows.len(), COUNT);
    assert_eq!(long.max_bounces() as usize, COUNT - 1);
    let camera = session.camera().expect("a camera");
    let lines = outside::lines(
        &long,
        &Filter::default(),
        &camera,
        dvec2(64.0, 36.0),
        1.0,
        None,
    );
    assert!(lines.len() <= outside::MOST_LINES);
}

#[test]
fn what_a_sphere_hides_of_a_ray_is_known() {
    const SPHERE: &str = "assets/scenes/sphere.scene";
    let mut window = Window::open(&[SPHERE, "--size", "64x48", "--samples", "1"]);
    inspect(&mut window, [32, 24]);
    // From the other side, a little from above.
    let outside = |session: &mut glimray_viewer::state::session::Session| {
        let rig = session
            .inspector
            .outside
            .controller
            .as_mut()
            .expect("a rig");
        rig.orbit_by(2.0, -0.1);
    };
    outside(&mut window.session());
    window.settle();
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    let scene = session.scene().expect("a scene");
    let (min, max) = scene.bounds().expect("bounds");
    let (center, radius) = ((min + max) / 2.0, (max.x - min.x) / 2.0);
    let camera = session
        .inspector
        .outside
        .controller
        .as_ref()
        .expect("a rig")
        .camera();
    let parts = hidden::known(&session).expect("an answer");
    let (mut hidden_count, mut seen_count) = (0, 0);
    for (id, of_line) in parts {
        let ray = inspected.ray(*id).expect("a ray");
        let (from, to) = outside::ends(ray, session.inspector.outside.reach());
        for (part, is_hidden) in of_line.iter().enumerate() {
            let point = from.lerp(to, (part as f64 + 0.5) / PARTS as f64);
            let way = point - camera.look_from;
            let nearest = way * ((center - camera.look_from).dot(way) / way.length_squared());
            let gap = (camera.look_from + nearest).distance(center) / radius;
            let is_beyond = way.length() > (center - camera.look_from).length();
            // Near the edge a pixel shows both.
            if (gap - 1.0).abs() < 0.1 || !is_beyond {
                continue;
            }
            assert_eq!(*is_hidden, gap < 1.0, "{id:?} {part}: {gap}");
            if *is_hidden {
                hidden_count += 1;
            } else {
                seen_count += 1;
            }
        }
    }
    assert!(
        hidden_count > 3 && seen_count > 3,
        "{hidden_count} {seen_count}"
    );
}

#[test]
fn rays_name_things_as_the_outline_does() {
    let window = open_glass([31, 18]);
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    let mut count = 0;
    for ray in &inspected.tree.samples[0].rays {
        let headline = ray_labels::headline(inspected, ray);
        let object = ray.hit.as_ref().and_then(|hit| hit.object);
        let light = ray.shadow.as_ref();
        let light = light.and_then(|shadow| shadow.light.map(ObjectRef::Light));
        if let Some(met) = light.or(object) {
            let label = session.label(Id::Object(met));
            assert!(headline.contains(&label), "{headline}: no {label}");
            count += 1;
        }
    }
    assert!(count > 3, "{count} rays");
}

#[test]
fn the_mark_of_the_pixel_is_there_while_the_inspector_is_in_hand() {
    let mut window = Window::open(&[GLASS, "--size", "64x36", "--samples", "4"]);
    window.settle();
    let part = |window: &mut Window| {
        window.harness.hover_at(egui::pos2(4.0, 690.0));
        window.settle();
        let viewport = window.session().viewport.expect("a picture");
        let rect = viewport.part([31, 18, 1, 1]).expand(12.0);
        let picture = window.harness.render().expect("a picture of the window");
        let (x, y) = (rect.min.x as u32, rect.min.y as u32);
        let (width, height) = (rect.width() as u32, rect.height() as u32);
        image::imageops::crop_imm(&picture, x, y, width, height).to_image()
    };
    let before = part(&mut window);
    inspect(&mut window, [31, 18]);
    assert!(part(&mut window) != before, "the pixel is not marked");
    window.harness.key_press(egui::Key::Escape);
    window.settle();
    assert!(part(&mut window) == before, "the mark stays");
    // The rays stay too, and the tool brings the mark back.
    assert!(window.session().inspector.inspected.is_some());
}

#[test]
fn no_control_of_the_rays_is_cut_off_at_the_edge_of_the_panel() {
    let window = open_glass([31, 18]);
    let right = window.harness.ctx.content_rect().max.x;
    for label in ["All samples", "Shadow rays", "Follow the cursor"] {
        let rect = window.harness.get_by_label(label).rect();
        assert!(rect.max.x <= right, "{label}: {rect:?} beyond {right}");
    }
}

#[test]
fn the_tree_is_wide_enough_to_read_and_its_columns_have_headers() {
    let mut window = open_glass([32, 18]);
    window.harness.set_size(egui::vec2(1280.0, 800.0));
    window.settle();
    let right = |label: &str| window.harness.get_by_label(label).rect().max.x;
    let left = window.harness.get_by_label("Ray").rect().min.x;
    // A panel of 420 points has margins of 8 on both sides, and a scroll bar of 8.
    let width = right("Light") - left;
    assert!(width >= 395.0, "{width} points");
    assert!(right("Length") < right("Light"));
}

/// A scene and a window that are large enough for lines of many pixels.
fn open_large() -> Window {
    let mut window = Window::open(&[GLASS, "--size", "320x180", "--samples", "1"]);
    window.harness.set_size(egui::vec2(1280.0, 800.0));
    inspect(&mut window, [155, 90]);
    window
}

#[test]
fn the_path_over_the_picture_follows_the_camera() {
    let mut window = open_large();
    let size = dvec2(320.0, 180.0);
    for turn in [0.0, 0.4, 2.5] {
        (window.session().controller.as_mut().expect("a rig")).orbit_by(turn, 0.1 * turn);
        window.settle();
        let session = window.session();
        let inspected = session.inspector.inspected.as_ref().expect("a tree");
        let camera = session.camera().expect("a camera");
        let lines = outside::path(&session, size);
        let mut checked = 0;
        for line in lines.iter().filter(|it| it.end == outside::End::Surface) {
            let ray = inspected.ray(line.id).expect("a ray");
            let end = DVec3::from(ray.end.expect("an end"));
            let expected = by_matrices(&camera, end, size);
            assert!(line.to.distance(expected) < 1e-3, "{line:?} {expected}");
            checked += 1;
        }
        assert!(checked >= 3, "{checked} lines end on surfaces");
        let primary = lines.iter().find(|line| line.kind == RayKind::Primary);
        let primary = primary.expect("the primary ray");
        let length = primary.from.distance(primary.to);
        if turn == 0.0 {
            // From its own eye a ray is a point, in the pixel.
            let reach = f64::from(inspected.request.settings.filter_radius).max(0.5) + 0.01;
            let off = (primary.to - dvec2(155.5, 90.5)).abs().max_element();
            assert!(off <= reach && length < 1e-6, "{primary:?}");
        } else {
            assert!(length > 10.0, "{primary:?}");
        }
    }
}

#[test]
fn a_primary_ray_from_a_lens_is_a_point_in_its_own_picture() {
    let mut window = Window::open(&["--size", "320x240", "--samples", "1"]);
    inspect(&mut window, [160, 120]);
    let session = window.session();
    let inspected = session.inspector.inspected.as_ref().expect("a tree");
    let eye = session.camera().expect("a camera").look_from;
    let start = DVec3::from(inspected.tree.samples[0].rays[0].origin);
    assert!(start.distance(eye) > 1e-3, "the demo has a lens");
    let lines = outside::path(&session, dvec2(320.0, 240.0));
    let primary = lines.iter().find(|line| line.kind == RayKind::Primary);
    let primary = primary.expect("the primary ray");
    assert_eq!((primary.from, primary.pieces.len()), (primary.to, 0));
    // The hit object is out of focus by a few pixels.
    assert!(primary.to.distance(dvec2(160.5, 120.5)) < 8.0);
    assert!(lines.iter().any(|line| !line.pieces.is_empty()));
}

#[test]
fn the_path_is_drawn_along_its_lines_and_can_be_hidden() {
    let mut window = open_large();
    (window.session().controller.as_mut().expect("a rig")).orbit_by(0.4, 0.1);
    window.settle();
    window.harness.hover_at(egui::pos2(4.0, 790.0));
    window.settle();
    let with = window.harness.render().expect("a picture of the window");
    perform(&mut window, Action::ToggleInspectedRays);
    window.harness.hover_at(egui::pos2(4.0, 790.0));
    window.settle();
    let without = window.harness.render().expect("a picture of the window");
    window.harness.get_by_label("Path in picture").click();
    window.settle();
    assert!(window.session().preferences.overlays.rays);
    let session = window.session();
    let viewport = session.viewport.expect("a picture");
    let lines = outside::path(&session, viewport.extent());
    let distance = |x: u32, y: u32| {
        let at = egui::pos2(x as f32 + 0.5, y as f32 + 0.5);
        let gap = |line: &outside::Line| {
            let [from, to] = [line.from, line.to].map(|end| viewport.point(end));
            let way = to - from;
            let share = (at - from).dot(way) / way.length_sq().max(1e-6);
            (from + share.clamp(0.0, 1.0) * way).distance(at)
        };
        lines.iter().map(gap).fold(f32::INFINITY, f32::min)
    };
    let (mut drawn, mut on_lines) = (0, 0);
    let rect = viewport.rect.shrink(1.0);
    for y in rect.min.y as u32..rect.max.y as u32 {
        for x in rect.min.x as u32..rect.max.x as u32 {
            let differs = with.get_pixel(x, y) != without.get_pixel(x, y);
            let gap = distance(x, y);
            // Arrow heads and end points are wider than lines.
            assert!(!differs || gap < 8.0, "{x},{y} is {gap} from every line");
            if gap < 0.5 {
                on_lines += 1;
                drawn += u32::from(differs);
            }
        }
    }
    assert!(on_lines > 100, "{on_lines}");
    // Some lines are dashed, and others fade.
    assert!(2 * drawn > on_lines, "{drawn} of {on_lines}");
}
