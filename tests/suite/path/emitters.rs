//! Emissive shapes as lights of paths.

use super::{lights, lit_floor, matte, mean, near, paths};
use crate::reference::scenes::Build;
use crate::support::verdict::Verdict;
use glam::{DAffine3, DMat3, DVec3, Vec3, dvec3};
use glimray::scene::{
    Antialias, Attenuation, CanonicalShape, Geometry, Light, LightKind, Material, Node, Scene,
    Shape,
};

/// The surface of an area light.
fn surface(kind: &LightKind) -> Geometry {
    match *kind {
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => Geometry::Placed {
            canonical: CanonicalShape::Rectangle,
            world_from_canonical: DAffine3 {
                matrix3: DMat3::from_cols(edge_u, -DVec3::Y, -edge_v),
                translation: center,
            },
        },
        LightKind::Disc { center, radius, .. } => Geometry::Placed {
            canonical: CanonicalShape::Disc { hole: 0.0 },
            world_from_canonical: DAffine3 {
                matrix3: DMat3::from_cols(radius * DVec3::X, -DVec3::Y, -radius * DVec3::Z),
                translation: center,
            },
        },
        LightKind::Sphere { center, radius } => Geometry::Sphere { center, radius },
        _ => unreachable!("not an area light"),
    }
}

/// A floor below an emissive shape instead of the lamp.
fn under(kind: &LightKind, floor: &Material, radiance: f64, node: Option<Node>) -> Scene {
    let mut scene = lit_floor(floor.clone(), Light::default());
    scene.lights.clear();
    let material = scene.add_material(Material {
        emission: Vec3::splat(radiance as f32),
        two_sided: false,
        ..matte(0.0)
    });
    let node = node.map(|node| {
        scene.nodes.push(node);
        scene.nodes.len() - 1
    });
    scene.shapes.push(Shape {
        geometry: surface(kind),
        material,
        node,
    });
    scene
}

/// Emissive spheres, rectangles and discs light a floor as lamps of the same shape and radiance do, near and far, and
/// wherever a node puts them.
#[test]
fn emissive_shapes_shine_like_lamps_of_the_same_radiance() {
    let mut verdict = Verdict::on("floors under emissive shapes");
    let glossy = Material {
        specular: Vec3::splat(2.0),
        shininess: 20.0,
        ..matte(0.5)
    };
    for (name, kind) in lights()
        .into_iter()
        .filter(|(_, kind)| kind.radiance().is_some())
    {
        let strength = kind.radiance().expect("an area light");
        let lamp = Light {
            kind,
            color: Vec3::ONE,
            attenuation: Attenuation::InverseSquare,
            samples: 1,
            visible: false,
            node: None,
        };
        let expected = mean(&lit_floor(glossy.clone(), lamp), &paths(1024, (24, 16), 0));
        let moved = Node {
            translation: dvec3(0.25, 0.0, 0.0),
            placement: DAffine3::from_translation(dvec3(-0.25, 0.0, 0.0)),
            ..Node::default()
        };
        for (place, node) in [("still", None), ("carried", Some(moved))] {
            let scene = under(&kind, &glossy, strength, node);
            let found = mean(&scene, &paths(512, (24, 16), 0));
            near(
                &mut verdict,
                format!("{name}, {place}"),
                found,
                expected,
                0.006 * expected,
            );
        }
    }
    verdict.close();
}

/// A small lamp is found by light samples: without them a picture of few samples would hardly show it.
#[test]
fn small_emissive_shapes_are_found_by_few_samples() {
    let mut verdict = Verdict::on("the spread of pixels under small lamps");
    let position = dvec3(0.3, 1.0, -0.2);
    for (name, kind) in [
        (
            "sphere",
            LightKind::Sphere {
                center: position,
                radius: 0.02,
            },
        ),
        (
            "disc",
            LightKind::Disc {
                center: position,
                normal: -DVec3::Y,
                radius: 0.02,
            },
        ),
        (
            "rectangle",
            LightKind::Rectangle {
                center: position,
                edge_u: 0.02 * DVec3::X,
                edge_v: 0.02 * DVec3::Z,
            },
        ),
    ] {
        let mut scene = under(&kind, &matte(0.5), 1000.0, None);
        scene.output.antialias = Some(Antialias::Stratified);
        let few = mean(&scene, &paths(4, (16, 16), 0));
        let many = mean(&scene, &paths(1024, (16, 16), 0));
        near(&mut verdict, name, few, many, 0.02 * many);
    }
    verdict.close();
}
