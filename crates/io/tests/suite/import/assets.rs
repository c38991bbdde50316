//! The project's scenes: all of them load, and keep the guarantees of [`Scene`].

use glam::{DVec3, Vec3};
use glimray::import::{self, Options};
use glimray::scene::{
    Background, CanonicalShape, Geometry, Interpolation, LightKind, LightTransport, Scene, Target,
    Track, Values,
};
use std::path::{Path, PathBuf};

/// The file `name` in the folder of scenes.
pub fn path(name: &str) -> PathBuf {
    Path::new("assets/scenes").join(name)
}

fn is_color(color: Vec3) -> bool {
    color.is_finite() && color.min_element() >= 0.0
}

/// Asserts the guarantees in the docs of [`Scene`].
fn assert_promises(scene: &Scene) {
    assert!(scene.camera_index < scene.cameras.len() && !scene.materials.is_empty());
    assert!(is_color(scene.ambient));
    match scene.background {
        Background::Color(color) => assert!(is_color(color)),
        Background::Gradient { bottom, top } => assert!(is_color(bottom) && is_color(top)),
        Background::Picture { picture, .. } => assert!(picture < scene.pictures.len()),
    }
    for material in &scene.materials {
        assert!(
            is_color(material.classical().diffuse)
                && is_color(material.classical().specular)
                && is_color(material.classical().ambient)
        );
        assert!(
            material.classical().shininess >= 0.0 && material.classical().shininess.is_finite()
        );
    }
    for mesh in &scene.meshes {
        assert!(mesh.positions.iter().all(|p| p.is_finite()));
        assert!(mesh.normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
        assert_eq!(mesh.normals.len(), mesh.positions.len());
        assert_eq!(mesh.materials.len(), mesh.positions.len());
        assert!(
            mesh.materials
                .iter()
                .all(|&m| (m as usize) < scene.materials.len())
        );
        assert!(
            mesh.triangles
                .iter()
                .flatten()
                .all(|&i| (i as usize) < mesh.positions.len())
        );
    }
    for instance in &scene.instances {
        assert!(instance.mesh < scene.meshes.len());
        assert!(instance.placement.is_finite());
        assert_ne!(instance.placement.matrix3.determinant(), 0.0);
    }
    for shape in &scene.shapes {
        assert!(shape.material < scene.materials.len());
        match shape.geometry {
            Geometry::Sphere { center, radius } => assert!(center.is_finite() && radius > 0.0),
            Geometry::Plane { point, normal } => {
                assert!(point.is_finite() && normal.is_normalized())
            }
            Geometry::Placed {
                canonical,
                world_from_canonical,
            } => {
                match canonical {
                    CanonicalShape::Disc { hole } => assert!((0.0..1.0).contains(&hole)),
                    CanonicalShape::Cone { bottom, top, .. } => {
                        assert!(bottom >= 0.0 && top >= 0.0 && bottom + top > 0.0);
                    }
                    CanonicalShape::Torus { minor } => assert!(minor > 0.0 && minor <= 1.0),
                    CanonicalShape::Rectangle | CanonicalShape::Box | CanonicalShape::Ellipsoid => {
                    }
                }
                assert!(world_from_canonical.is_finite());
                assert_ne!(world_from_canonical.matrix3.determinant(), 0.0);
            }
        }
    }
    for light in &scene.lights {
        assert!(is_color(light.color) && light.samples >= 1);
        match light.kind {
            LightKind::Point { position } => assert!(position.is_finite()),
            LightKind::Directional { direction } => assert!(direction.is_normalized()),
            LightKind::Spot {
                direction,
                inner,
                outer,
                ..
            } => {
                assert!(direction.is_normalized() && 0.0 <= inner && inner <= outer);
            }
            LightKind::Rectangle { edge_u, edge_v, .. } => {
                assert!(edge_u.cross(edge_v).length() > 0.0);
            }
            LightKind::Disc { normal, radius, .. } => {
                assert!(normal.is_normalized() && radius > 0.0);
            }
            LightKind::Sphere { radius, .. } => assert!(radius > 0.0),
        }
    }
    for camera in &scene.cameras {
        let forward: DVec3 = camera.look_at - camera.look_from;
        assert!(forward.cross(camera.up).length() > 0.0);
        if let Some(lens) = camera.lens {
            assert!(lens.radius > 0.0 && lens.focus_distance > 0.0);
            assert!(lens.blade_count == 0 || lens.blade_count >= 3);
        }
    }
}

/// Asserts the documented guarantees of nodes, tracks and objects attached to nodes.
fn assert_guarantees_of_animation(scene: &Scene) {
    for (index, node) in scene.nodes.iter().enumerate() {
        assert!(node.parent.is_none_or(|parent| parent < index));
        assert!(node.rotation.is_normalized() && node.scale.abs().min_element() > 0.0);
        assert_ne!(node.placement.matrix3.determinant(), 0.0);
    }
    let instances = scene.instances.iter().map(|instance| instance.node);
    let shapes = scene.shapes.iter().map(|shape| shape.node);
    let lights = scene.lights.iter().map(|light| light.node);
    let cameras = (scene.cameras.iter()).flat_map(|camera| [camera.node, camera.target]);
    let carriers = instances.chain(shapes).chain(lights).chain(cameras);
    assert!(carriers.flatten().all(|node| node < scene.nodes.len()));
    let mut driven = Vec::new();
    for Track { targets, curve } in &scene.tracks {
        let values = match &curve.values {
            Values::Scalar(values) => values.len(),
            Values::Vector(values) => values.len(),
            Values::Rotation(values) => values.len(),
        };
        let per_key = match curve.interpolation {
            Interpolation::Hermite => 3,
            _ => 1,
        };
        assert!(!targets.is_empty() && !curve.times.is_empty());
        assert_eq!(values, per_key * curve.times.len());
        assert!(curve.times.is_sorted_by(|a, b| a < b));
        for &target in targets {
            assert!(!driven.contains(&target), "{target:?} has one track");
            driven.push(target);
            assert!(match target {
                Target::Node(index, _) => index < scene.nodes.len(),
                Target::Camera(index, _) => index < scene.cameras.len(),
                Target::Light(index, _) => index < scene.lights.len(),
                Target::Material(index, _) | Target::Layer(index, _) =>
                    index < scene.materials.len(),
                Target::Weight(index, _) => index < scene.deformations.len(),
                Target::Texture(index, _) => index < scene.textures.len(),
            });
        }
    }
}

/// Everything in the folder of scenes and in that of the book's failures.
fn files() -> Vec<PathBuf> {
    let folders = ["", "failures"].map(|name| path(name).read_dir().expect("a folder of scenes"));
    let entries = folders.into_iter().flatten();
    entries
        .map(|entry| entry.expect("an entry").path())
        .collect()
}

#[test]
fn every_scene_of_the_project_loads_whole() {
    let mut count = 0;
    for path in files() {
        let ending = path.extension().and_then(|ending| ending.to_str());
        if !matches!(ending, Some("scene" | "toml" | "nff" | "obj")) {
            continue;
        }
        let scene = import::load(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_promises(&scene);
        assert_guarantees_of_animation(&scene);
        assert_eq!(scene.skipped, [""; 0], "{}", path.display());
        let is_path = scene.output.integrator == LightTransport::Path;
        let is_lit = !scene.lights.is_empty()
            || is_path && scene.background_shines()
            || is_path && scene.materials.iter().any(|it| it.emission != Vec3::ZERO);
        assert!(is_lit && scene.bounds().is_some(), "{}", path.display());
        count += 1;
    }
    assert!(count >= 11, "{count} scenes");
}

#[test]
fn native_scenes_begin_with_what_they_show() {
    for path in files() {
        if path.extension().is_some_and(|ending| ending == "toml") {
            let text = std::fs::read_to_string(&path).expect("text");
            assert!(text.starts_with("# "), "{}", path.display());
        }
    }
}

#[test]
fn the_showcase_needs_no_files() {
    let text = std::fs::read_to_string(path("../../crates/app/src/showcase.toml")).expect("text");
    let scene = import::parse("showcase.toml", &text, &Options::default()).expect("a scene");
    assert!(scene.shapes.len() > 50);
    // Soft shadows, depth of field, mirrors and glass.
    assert!(
        scene
            .lights
            .iter()
            .any(|light| light.kind.radiance().is_some())
    );
    assert!(scene.cameras[0].lens.is_some());
    let features = glimray::pack::scene(&scene).expect("packed").features;
    assert!(features.reflection && features.refraction);
}

#[test]
fn the_lighthouse_reads_as_tobj_reads_it() {
    let options = tobj::LoadOptions {
        triangulate: true,
        single_index: true,
        ..Default::default()
    };
    let (models, _) = tobj::load_obj(path("lighthouse.obj"), &options).expect("a model");
    let triangles: usize = models
        .iter()
        .map(|model| model.mesh.indices.len() / 3)
        .sum();
    let highest = models
        .iter()
        .flat_map(|model| model.mesh.positions.chunks(3))
        .map(|p| p[1])
        .fold(0.0, f64::max);
    let scene = import::load(&path("lighthouse.obj")).expect("a scene");
    assert_eq!(scene.triangle_count(), triangles);
    let (_, max) = scene.bounds().expect("bounds");
    assert!((max.y - highest).abs() < 1e-6);
    // Materials of the file, and the ground's.
    assert_eq!(scene.materials.len(), 7 + 1);
}
