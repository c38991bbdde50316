//! The grid, and the edges of meshes and shapes.

use super::edit::{on_screen, perform};
use crate::harness::Window;
use eframe::egui::{Key, Modifiers, Pos2};
use egui_kittest::kittest::Queryable;
use glam::{DVec2, DVec3, Vec3, dvec3};
use glimray::scene::{Camera, Mesh, Scene, Section};
use glimray_viewer::model::bindings::Action;
use glimray_viewer::model::camera::project;
use glimray_viewer::model::edges::MeshEdges;
use glimray_viewer::model::grid::Grid;
use glimray_viewer::model::handles::Eye;
use glimray_viewer::model::sight::Limits;
use glimray_viewer::model::snapping::grid_step;
use tempfile::TempDir;

/// A cube with sides of 2, seen from a corner, before a black background.
const CUBE: &str = r#"
ambient = [1, 1, 1]

[camera]
look_from = [5, 4, 6]
look_at = [0, 0, 0]
fov_y_deg = 40

[materials]
grey = { phong = { ambient = [0.2, 0.2, 0.2] } }

[[objects]]
box = { min = [-1, -1, -1], max = [1, 1, 1] }
material = "grey"
"#;

fn open() -> (TempDir, Window) {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("cube.toml");
    std::fs::write(&path, CUBE).expect("a file");
    let path = path.to_str().expect("a path in UTF-8");
    let mut window = Window::open(&[path, "--size", "400x300", "--samples", "1"]);
    window.settle();
    (folder, window)
}

/// By how much the window differs from before at the points of the screen, in levels of 255: the most of a few neighbours.
fn differences(window: &mut Window, action: Action, points: &[Pos2]) -> Vec<u8> {
    let before = window.harness.render().expect("a picture of the window");
    perform(window, action);
    let after = window.harness.render().expect("a picture of the window");
    let at = |point: &Pos2| {
        let near = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy)));
        let off = near.map(|(dx, dy)| {
            let (x, y) = (point.x as i32 + dx, point.y as i32 + dy);
            let [a, b] = [&before, &after].map(|it| it.get_pixel(x as u32, y as u32).0);
            let channels = (0..3).map(|channel: usize| a[channel].abs_diff(b[channel]));
            channels.max().unwrap_or(0)
        });
        off.max().unwrap_or(0)
    };
    points.iter().map(at).collect()
}

#[test]
fn the_axes_of_the_grid_are_seen_beside_an_object_and_not_before_it() {
    let (_folder, mut window) = open();
    // On the x axis: beside the cube, and within it.
    let points = [dvec3(1.8, 0.0, 0.0), dvec3(0.3, 0.0, 0.0)];
    let points = points.map(|point| on_screen(&window, point));
    let found = differences(&mut window, Action::ToggleGrid, &points);
    assert!(found[0] > 80, "no axis: {found:?}");
    assert!(found[1] < 25, "the axis is not hidden: {found:?}");
    assert!(window.harness.query_by_label_contains("grid 1").is_some());
    // The command of the keyboard takes it away.
    (window.harness).key_press_modifiers(Modifiers::ALT, Key::G);
    window.settle();
    assert!(!window.session().preferences.overlays.grid);
    assert!(window.harness.query_by_label_contains("grid 1").is_none());
}

#[test]
fn the_grid_has_steps_of_powers_of_ten_and_lies_on_the_ground() {
    for (length, expected) in [(0.01, 1.0), (0.07, 1.0), (0.08, 10.0), (7e-6, 1e-4)] {
        let found = grid_step(length);
        assert!((found / expected - 1.0).abs() < 1e-12, "{length}: {found}");
    }
    let camera = Camera {
        look_from: dvec3(3.0, 50.0, 4.0),
        look_at: dvec3(3.0, 0.0, 4.0),
        up: DVec3::Z,
        ..Camera::default()
    };
    let eye = Eye {
        camera: &camera,
        size: DVec2::new(400.0, 300.0),
    };
    let pivot = dvec3(123.4, 5.0, -7.0);
    for (up, axis) in [(DVec3::Y, 1), (DVec3::Z, 2)] {
        let grid = Grid::new(eye, up, pivot, 0.05).expect("a grid");
        assert_eq!(grid.step, 1.0);
        assert!(
            grid.lines
                .iter()
                .flat_map(|line| line.ends)
                .all(|end| end[axis] == 0.0)
        );
        // Lines are where whole numbers are, however far away the pivot is.
        for line in &grid.lines {
            let [a, b] = line.ends;
            let fixed = (0..3).find(|other| *other != axis && a[*other] == b[*other]);
            let at = a[fixed.expect("a line along an axis")];
            assert!((at - at.round()).abs() < 1e-9, "{at}");
        }
    }
    // 120 is more than 40 lines away from the z axis, and the x axis is near.
    let grid = Grid::new(eye, DVec3::Y, pivot, 0.05).expect("a grid");
    let axes: Vec<_> = grid.lines.iter().filter_map(|line| line.axis).collect();
    assert_eq!(axes, [0]);
}

#[test]
fn the_edges_of_a_cube_are_drawn_as_far_as_they_can_be_seen() {
    let (_folder, mut window) = open();
    let seen = on_screen(&window, dvec3(1.0, 0.2, 1.0));
    let hidden = on_screen(&window, dvec3(-1.0, 0.4, -1.0));
    let found = differences(&mut window, Action::ToggleFeatureEdges, &[seen, hidden]);
    assert!(found[0] > 60, "the edge in front is missing: {found:?}");
    assert!(found[1] < 8, "the edge behind is drawn: {found:?}");
    let session = window.session();
    let camera = session.camera().expect("a camera");
    let size = DVec2::new(400.0, 300.0);
    let long = |a: DVec3, b: DVec3| {
        let [a, b] = [a, b].map(|end| project(&camera, end, size).expect("in front"));
        a.distance(b)
    };
    // All but the three edges that meet in the farthest corner.
    let corners = [-1.0, 1.0];
    let mut expected = 0.0;
    for axis in 0..3 {
        for (u, v) in corners.into_iter().flat_map(|u| corners.map(|v| (u, v))) {
            if (u, v) != (-1.0, -1.0) {
                let mut ends = [DVec3::NEG_ONE, DVec3::ONE];
                for end in &mut ends {
                    (end[(axis + 1) % 3], end[(axis + 2) % 3]) = (u, v);
                }
                expected += long(ends[0], ends[1]);
            }
        }
    }
    let latest = session.sight.latest.as_ref().expect("an answer");
    assert!(!latest.edges.is_cut);
    let total: f64 = latest.edges.lines.iter().map(|[a, b]| a.distance(*b)).sum();
    let off = total / expected - 1.0;
    assert!(off.abs() < 0.02, "{total} pixels of edges, not {expected}");
}

/// The total length of the lines between pairs of points in the world, as a picture of 400 × 300 pixels shows them.
fn length_of(lines: &[[DVec3; 2]], camera: &Camera) -> f64 {
    let at = |end| project(camera, end, DVec2::new(400.0, 300.0)).expect("in front");
    lines.iter().map(|[a, b]| at(*a).distance(at(*b))).sum()
}

/// The total length of the edges that a window has found, in pixels.
fn found_length(window: &Window) -> f64 {
    let session = window.session();
    let latest = session.sight.latest.as_ref().expect("an answer");
    latest.edges.lines.iter().map(|[a, b]| a.distance(*b)).sum()
}

#[test]
fn edges_end_at_the_section_plane() {
    let (_folder, mut window) = open();
    window.session().preferences.overlays.features = true;
    let left = Section {
        normal: DVec3::X,
        offset: 0.0,
    };
    window
        .session()
        .edit("cut", |scene| scene.section = Some(left));
    window.settle();
    let camera = window.session().camera().expect("a camera");
    // Half a cube hides its corner (−1, −1, −1) and the three edges there. The cut itself has no edges.
    let (min, max, middle) = (-1.0, 1.0, 0.0);
    let ends = [(max, max), (max, min), (min, max)];
    let mut lines: Vec<_> = (ends.into_iter())
        .map(|(y, z)| [dvec3(min, y, z), dvec3(middle, y, z)])
        .collect();
    lines.push([dvec3(min, min, max), DVec3::new(min, max, max)]);
    lines.push([dvec3(min, max, min), DVec3::new(min, max, max)]);
    let (found, expected) = (found_length(&window), length_of(&lines, &camera));
    let off = found / expected - 1.0;
    assert!(off.abs() < 0.05, "{found} pixels of edges, not {expected}");
}

#[test]
fn a_picture_shows_what_lies_between_the_planes_of_the_camera_and_is_not_cut_away() {
    let camera = Camera {
        look_from: dvec3(0.0, 0.0, 8.0),
        look_at: DVec3::ZERO,
        clip: (2.0, 11.0),
        ..Camera::default()
    };
    let section = Section {
        normal: DVec3::Y,
        offset: 0.5,
    };
    let scene = Scene {
        section: Some(section),
        ..Scene::default()
    };
    let limits = Limits::of(&scene, &camera);
    // From z = 6, at a distance of 2, to z = −3, at a distance of 11.
    let clip = |a: [f64; 3], b: [f64; 3]| limits.clip((a.into(), b.into()));
    let is_near = |found: Option<(DVec3, DVec3)>, [a, b]: [[f64; 3]; 2]| {
        let (from, to) = found.expect("a part of the line");
        from.distance(a.into()) < 1e-3 && to.distance(b.into()) < 1e-3
    };
    let whole = clip([1.0, 0.0, 7.0], [1.0, 0.0, -9.0]);
    assert!(is_near(whole, [[1.0, 0.0, 6.0], [1.0, 0.0, -3.0]]));
    let upright = clip([0.0, 2.5, 0.0], [0.0, -1.5, 0.0]);
    assert!(is_near(upright, [[0.0, 0.5, 0.0], [0.0, -1.5, 0.0]]));
    assert_eq!(clip([0.0, 0.6, 0.0], [0.0, 9.0, 0.0]), None);
    assert_eq!(clip([0.0, 0.0, 6.1], [3.0, 0.0, 7.0]), None);
    for (point, is_inside) in [
        ([0.0, 0.0, 0.0], true),
        ([4.0, 0.5, 0.0], true),
        ([4.0, 0.501, 0.0], false),
        ([0.0, 0.0, 6.0], true),
        ([0.0, 0.0, 6.01], false),
        ([0.0, 0.0, -3.01], false),
    ] {
        assert_eq!(limits.contain(point.into()), is_inside, "{point:?}");
    }
}

/// A cube whose faces have vertices of their own, as files store them.
fn cube() -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            let normal = Vec3::AXES[axis] * side;
            let (u, v) = (Vec3::AXES[(axis + 1) % 3], Vec3::AXES[(axis + 2) % 3]);
            let first = mesh.positions.len() as u32;
            mesh.positions
                .extend([-u - v, u - v, u + v, v - u].map(|at| at + normal));
            mesh.normals.extend([normal; 4]);
            mesh.materials.extend([0; 4]);
            mesh.triangles
                .extend([[0, 1, 2], [0, 2, 3]].map(|it| it.map(|i: u32| i + first)));
        }
    }
    mesh
}

#[test]
fn features_are_creases_borders_and_edges_between_materials() {
    let count = |mesh: &Mesh| {
        let edges = MeshEdges::of(mesh);
        [true, false].map(|all| edges.chosen(all).len())
    };
    // Twelve edges, and a diagonal in each of six faces.
    assert_eq!(count(&cube()), [18, 12]);
    let mut painted = cube();
    // The second triangle of the first face gets a corner of its own material.
    let corner = painted.triangles[1][0] as usize;
    painted.positions.push(painted.positions[corner]);
    painted.normals.push(painted.normals[corner]);
    painted.materials.push(1);
    painted.triangles[1][0] = painted.positions.len() as u32 - 1;
    assert_eq!(count(&painted), [18, 13]);
    let mut opened = cube();
    opened.triangles.truncate(11);
    // The diagonal is a border now.
    assert_eq!(count(&opened), [18, 13]);
    // A roof of 20° is smooth, one of 40° is not.
    for (degrees, features) in [(20_f32, 4), (40.0, 5)] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let roof = Mesh {
            positions: vec![Vec3::ZERO, Vec3::Z, Vec3::NEG_X, Vec3::new(cos, sin, 0.0)],
            normals: vec![Vec3::Y; 4],
            materials: vec![0; 4],
            triangles: vec![[0, 2, 1], [0, 1, 3]],
            ..Mesh::default()
        };
        assert_eq!(count(&roof), [5, features], "{degrees}°");
    }
}
