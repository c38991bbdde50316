//! A student builds the scene of an exercise from nothing: a ground, two balls, a triangle and a lamp, with materials by
//! Phong. Each key, click and number counts as a gesture.

use crate::harness::Window;
use crate::making::{click, press, save_as};
use crate::reference::compare::{render, sized};
use eframe::egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;
use glam::{DVec3, dvec3};
use glimray::import;
use glimray::render::{Integrator, RenderSettings};
use glimray::scene::{Geometry, LightKind};
use glimray_viewer::model::camera::project;

/// Gestures in two minutes, at two seconds each.
const MOST: usize = 60;

struct Student {
    window: Window,
    gestures: usize,
}

impl Student {
    fn key(&mut self, modifiers: Modifiers, key: Key) {
        self.gestures += 1;
        press(&mut self.window, modifiers, key);
    }

    fn click(&mut self, label: &str) {
        self.gestures += 1;
        click(&mut self.window, label);
    }

    /// Adds something and moves it along an axis, or leaves it.
    fn add(&mut self, title: &str, way: Option<(Key, &[Key])>) {
        self.click("Add");
        self.click(title);
        if let Some((axis, digits)) = way {
            self.key(Modifiers::NONE, axis);
            // A number is typed in one go.
            self.gestures += 1;
            for digit in digits {
                press(&mut self.window, Modifiers::NONE, *digit);
            }
        }
        self.key(Modifiers::NONE, Key::Enter);
        self.window.settle();
    }

    /// Types a number into a field of the properties: a click and a number.
    fn set(&mut self, field: &str, value: f64) {
        self.gestures += 2;
        let node = self.window.harness.get_by_label(field);
        node.set_value_accesskit(value);
        self.window.settle();
    }

    /// Gives what is selected a colour. Grey is what it has.
    fn paint(&mut self, color: [f64; 3]) {
        for (channel, value) in ["red", "green", "blue"].into_iter().zip(color) {
            if value != 0.7 {
                self.set(&format!("Diffuse {channel}"), value);
            }
        }
    }
}

#[test]
fn a_student_builds_the_scene_of_the_exercise_in_two_minutes() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = Window::open(&["--size", "160x120", "--samples", "1"]);
    window.settle();
    let mut student = Student {
        window,
        gestures: 0,
    };
    student.key(Modifiers::COMMAND, Key::N);
    student.window.settle();
    student.add("Plane", None);
    student.paint([0.2, 0.7, 0.2]);
    student.add(
        "Sphere",
        Some((Key::X, &[Key::Minus, Key::Num1, Key::Period, Key::Num2])),
    );
    student.paint([0.7, 0.1, 0.1]);
    student.add(
        "Sphere",
        Some((Key::X, &[Key::Num1, Key::Period, Key::Num2])),
    );
    student.paint([0.1, 0.1, 0.7]);
    student.add(
        "Triangle",
        Some((Key::Y, &[Key::Num1, Key::Period, Key::Num5])),
    );
    student.paint([0.7, 0.7, 0.1]);
    student.add("Point light", None);
    // The picture of the exercise.
    student.key(Modifiers::SHIFT, Key::Num1);
    student.window.settle();
    assert_eq!(
        student.window.request().settings.integrator,
        Integrator::Whitted
    );
    // The name of the file is typed in one go.
    student.gestures += 3;
    let path = folder.path().join("exercise.toml");
    save_as(&mut student.window, &path);
    assert!(student.gestures <= MOST, "{} gestures", student.gestures);

    let scene = import::load(&path).expect("a scene");
    let Geometry::Plane { point: ground, .. } = scene.shapes[0].geometry else {
        panic!("the ground is no plane");
    };
    let centers = [1, 2].map(|index| match scene.shapes[index].geometry {
        Geometry::Sphere {
            center,
            radius: 1.0,
        } => center,
        other => panic!("{other:?} is no ball"),
    });
    assert!(
        centers[0].abs_diff_eq(dvec3(-1.2, 0.0, 0.0), 1e-9),
        "{}",
        centers[0]
    );
    assert!(
        centers[1].abs_diff_eq(dvec3(1.2, 0.0, 0.0), 1e-9),
        "{}",
        centers[1]
    );
    let LightKind::Point { position: lamp } = scene.lights[0].kind else {
        panic!("the light is no point light");
    };
    let settings = RenderSettings {
        integrator: Integrator::Whitted,
        ..sized(160, 120)
    };
    let (image, _) = render(&scene, &settings);
    let camera = scene.frame(0.0).camera;
    let color = |point: DVec3| {
        let at = project(&camera, point, dvec3(160.0, 120.0, 0.0).truncate());
        let at = at.expect("in front of the camera");
        let pixel = image.pixels[at.y as usize * 160 + at.x as usize];
        [pixel[0], pixel[1], pixel[2]]
    };
    let towards = |point: DVec3| point + (camera.look_from - point).normalize();
    let [red, blue] = centers.map(|center| color(towards(center)));
    assert!(red[0] > 3.0 * red[1].max(red[2]), "{red:?} is not red");
    assert!(blue[2] > 3.0 * blue[0].max(blue[1]), "{blue:?} is not blue");
    // The triangle stands above the balls.
    let yellow = color(dvec3(0.0, 1.3, 0.0));
    assert!(
        yellow[0] > 3.0 * yellow[2] && yellow[1] > 3.0 * yellow[2],
        "{yellow:?} is not yellow"
    );
    // Where the lamp sees the red ball in front of the ground, there is its shadow: beside the ball, for the camera.
    let way = centers[0] + dvec3(0.0, 0.8, 0.0) - lamp;
    let shadow = lamp + way * ((ground.y - lamp.y) / way.y);
    let lit = dvec3(0.0, ground.y, 2.0);
    let (dark, bright) = (color(shadow), color(lit));
    assert!(
        bright[1] > 0.1 && bright[1] > 2.0 * bright[0],
        "{bright:?} is not green"
    );
    assert!(dark[1] < 0.01, "{dark:?} is no shadow");
}
