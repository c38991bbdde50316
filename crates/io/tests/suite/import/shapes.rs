//! The analytic surfaces of native scenes: their placement, and error messages.

use super::{messages, scene};
use glam::{DAffine3, DVec3};
use glimray::scene::{CanonicalShape, Geometry, Scene};
use insta::assert_snapshot;

/// The only shape of a scene with one object.
fn placed(object: &str) -> (CanonicalShape, DAffine3) {
    let scene = scene("a.toml", format!("[[objects]]\n{object}"));
    match scene.shapes[..] {
        [
            glimray::scene::Shape {
                geometry:
                    Geometry::Placed {
                        canonical,
                        world_from_canonical,
                    },
                ..
            },
        ] => (canonical, world_from_canonical),
        _ => panic!("{:?}", scene.shapes),
    }
}

/// Asserts the world positions of points on the canonical shape.
#[track_caller]
fn assert_places(object: &str, canonical: CanonicalShape, points: &[([f64; 3], [f64; 3])]) {
    let (found, world_from_canonical) = placed(object);
    assert_eq!(found, canonical);
    for (local, world) in points {
        let got = world_from_canonical.transform_point3(DVec3::from(*local));
        assert!(
            got.distance(DVec3::from(*world)) < 1e-9,
            "{local:?} is at {got}, not at {world:?}"
        );
    }
}

const OPEN: CanonicalShape = CanonicalShape::Cone {
    bottom: 1.0,
    top: 1.0,
    capped: false,
};

#[test]
fn discs_and_rectangles_face_their_normal() {
    assert_places(
        "disc = { center = [1, 2, 3], radius = 2 }",
        CanonicalShape::Disc { hole: 0.0 },
        &[
            ([1., 0., 0.], [3., 2., 3.]),
            ([0., 1., 0.], [1., 4., 3.]),
            ([0., 0., 1.], [1., 2., 5.]),
        ],
    );
    assert_places(
        "disc = { center = [0, 0, 0], normal = [0, 0, 9], radius = 2, inner_radius = 0.5 }",
        CanonicalShape::Disc { hole: 0.25 },
        &[
            ([1., 0., 0.], [2., 0., 0.]),
            ([0., 1., 0.], [0., 0., 2.]),
            ([0., 0., -1.], [0., 2., 0.]),
        ],
    );
    assert_places(
        "rectangle = { center = [1, 1, 1], edge_u = [4, 0, 0], edge_v = [0, 2, 0] }",
        CanonicalShape::Rectangle,
        &[
            ([1., 0., -1.], [3., 2., 1.]),
            ([-1., 0., 1.], [-1., 0., 1.]),
            ([0., 1., 0.], [1., 1., 3.]),
        ],
    );
    assert_places(
        "rectangle = { center = [0, 0, 0], size = [4, 2] }",
        CanonicalShape::Rectangle,
        &[
            ([1., 0., 0.], [2., 0., 0.]),
            ([0., 0., -1.], [0., 0., -1.]),
            ([0., 1., 0.], [0., 2., 0.]),
        ],
    );
    assert_places(
        "rectangle = { center = [0, 0, 0], size = [4, 2], normal = [1, 0, 0] }",
        CanonicalShape::Rectangle,
        &[
            ([1., 0., 0.], [0., 0., -2.]),
            ([0., 0., -1.], [0., 1., 0.]),
            ([0., 1., 0.], [2., 0., 0.]),
        ],
    );
}

#[test]
fn solids_are_at_their_positions() {
    assert_places(
        "box = { min = [0, 1, 2], max = [2, 2, 8] }",
        CanonicalShape::Box,
        &[
            ([-1., -1., -1.], [0., 1., 2.]),
            ([1., 1., 1.], [2., 2., 8.]),
        ],
    );
    assert_places(
        "cylinder = { from = [1, 0, 0], to = [1, 0, 4], radius = 0.5, open = true }",
        OPEN,
        &[
            ([0., 0., 0.], [1., 0., 0.]),
            ([0., 1., 0.], [1., 0., 4.]),
            ([1., 0.5, 0.], [1.5, 0., 2.]),
        ],
    );
    assert_places(
        "cone = { from = [0, 0, 0], to = [0, 3, 0], from_radius = 2 }",
        CanonicalShape::Cone {
            bottom: 1.0,
            top: 0.0,
            capped: true,
        },
        &[([0., 1., 0.], [0., 3., 0.]), ([1., 0., 0.], [2., 0., 0.])],
    );
    assert_places(
        "cone = { from = [0, 3, 0], to = [0, 0, 0], from_radius = 0.5, to_radius = 2 }",
        CanonicalShape::Cone {
            bottom: 0.25,
            top: 1.0,
            capped: true,
        },
        &[([0., 0., 0.], [0., 3., 0.]), ([0., 1., 0.], [0., 0., 0.])],
    );
    assert_places(
        "torus = { center = [0, 1, 0], axis = [0, 0, 2], major_radius = 2, minor_radius = 0.5 }",
        CanonicalShape::Torus { minor: 0.25 },
        &[([0., 1., 0.], [0., 1., 2.]), ([1., 0., 0.], [2., 1., 0.])],
    );
}

#[test]
fn transforms_apply_to_every_shape() {
    let transform =
        "transform = { scale = [1, -2, 3], rotate_deg = [0, 0, 90], translate = [5, 0, 0] }";
    let objects = [
        "disc = { center = [0, 0, 0], radius = 1 }",
        "rectangle = { center = [0, 0, 0], size = [2, 2] }",
        "box = { min = [-1, -1, -1], max = [1, 1, 1] }",
        "sphere = { center = [0, 0, 0], radius = 1 }",
        "torus = { center = [0, 0, 0], major_radius = 1, minor_radius = 0.5 }",
        "cylinder = { from = [0, 0, 0], to = [0, 1, 0], radius = 1 }",
    ];
    for object in objects {
        let (canonical, _) = placed(object_or_ellipsoid(object));
        // x goes to y; y is mirrored, doubled and goes to -x, z grows.
        assert_places(
            &format!("{object}\n{transform}"),
            canonical,
            &[
                ([1., 0., 0.], [5., 1., 0.]),
                ([0., 0., 1.], [5., 0., 3.]),
                ([0., 1., 0.], [7., 0., 0.]),
            ],
        );
    }
}

/// A sphere is an ellipsoid only when it is scaled unevenly.
fn object_or_ellipsoid(object: &str) -> &str {
    if object.starts_with("sphere") {
        "sphere = { center = [0, 0, 0], radius = 1 }\ntransform = { scale = [1, 2, 1] }"
    } else {
        object
    }
}

#[test]
fn spheres_stay_spheres_while_they_are_round() {
    let scene = |transform: &str| -> Scene {
        let object = "sphere = { center = [1, 0, 0], radius = 2 }";
        scene(
            "a.toml",
            format!("[[objects]]\n{object}\ntransform = {{ {transform} }}"),
        )
    };
    let round = scene("scale = [-3, 3, 3], rotate_deg = [10, 20, 30]").shapes[0].geometry;
    assert!(matches!(round, Geometry::Sphere { radius, .. } if (radius - 6.0).abs() < 1e-12));
    let Geometry::Placed {
        canonical: CanonicalShape::Ellipsoid,
        world_from_canonical,
    } = scene("scale = [1, 2, 1]").shapes[0].geometry
    else {
        panic!("not an ellipsoid");
    };
    let top = world_from_canonical.transform_point3(DVec3::Y);
    assert!(top.distance(DVec3::new(1.0, 4.0, 0.0)) < 1e-12, "{top}");
}

#[test]
fn every_invalid_shape_has_a_message() {
    let objects = [
        "disc = { center = [0, 0, 0], radius = 0 }",
        "disc = { center = [0, 0, 0], normal = [0, 0, 0], radius = 1 }",
        "disc = { center = [0, 0, 0], radius = 1, inner_radius = 1 }",
        "disc = { center = [0, 0, 0], radius = 1, inner_radius = -0.1 }",
        "disc = { center = [0, 0, 0], radius = 1, outer_radius = 2 }",
        "rectangle = { center = [0, 0, 0] }",
        "rectangle = { center = [0, 0, 0], edge_u = [1, 0, 0] }",
        "rectangle = { center = [0, 0, 0], size = [1, 1], edge_u = [1, 0, 0] }",
        "rectangle = { center = [0, 0, 0], normal = [0, 1, 0] }",
        "rectangle = { center = [0, 0, 0], edge_u = [1, 0, 0], edge_v = [0, 0, 0] }",
        "rectangle = { center = [0, 0, 0], edge_u = [1, 2, 0], edge_v = [-2, -4, 0] }",
        "rectangle = { center = [0, 0, 0], size = [1, 0] }",
        "rectangle = { center = [0, 0, 0], size = [1, 1, 1] }",
        "box = { min = [0, 0, 0], max = [1, 0, 1] }",
        "box = { min = [0, 0, 0], max = [1, 1, -1] }",
        "box = { min = [0, 0, 0], size = [1, 1, 1] }",
        "cylinder = { from = [1, 2, 3], to = [1, 2, 3], radius = 1 }",
        "cylinder = { from = [0, 0, 0], to = [0, 1, 0], radius = -1 }",
        "cylinder = { from = [0, 0, 0], to = [0, 1, 0] }",
        "cylinder = { from = [0, 0, 0], to = [0, 1, 0], radius = 1, open = 1 }",
        "cone = { from = [0, 0, 0], to = [0, 0, 0], from_radius = 1 }",
        "cone = { from = [0, 0, 0], to = [0, 1, 0], from_radius = 0 }",
        "cone = { from = [0, 0, 0], to = [0, 1, 0], from_radius = -1 }",
        "cone = { from = [0, 0, 0], to = [0, 1, 0], to_radius = 1 }",
        "torus = { center = [0, 0, 0], major_radius = 1, minor_radius = 1.5 }",
        "torus = { center = [0, 0, 0], major_radius = 1, minor_radius = 0 }",
        "torus = { center = [0, 0, 0], axis = [0, 0, 0], major_radius = 1, minor_radius = 0.1 }",
        "torus = { center = [0, 0, 0], major_radius = 1, minor_radius = 0.1 }\ntransform = { scale = 3e38 }\nbox = { min = [0, 0, 0], max = [1, 1, 1] }",
        "box = { min = [0, 0, 0], max = [9, 9, 9] }\ntransform = { scale = 3e38 }",
    ];
    let texts = objects.map(|object| format!("[[objects]]\n{object}"));
    assert_snapshot!(messages("a.toml", &texts), @r"
bad scene (a.toml:2:39): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:39): a direction cannot be [0, 0, 0]. See `glimray schema` for what is allowed.
bad scene (a.toml:2:57): `inner_radius` is not less than `radius`, which is 1. Make the hole smaller.
bad scene (a.toml:2:57): -0.1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:2:42): unknown key `outer_radius`, did you mean `inner_radius`? Allowed here: `center`, `normal`, `radius`, `inner_radius`.
bad scene (a.toml:2:24): a rectangle needs two edges or a size. Give it either `edge_u` and `edge_v`, or `size` and, unless it faces upwards, `normal`.
bad scene (a.toml:2:44): a rectangle needs two edges or a size. Give it either `edge_u` and `edge_v`, or `size` and, unless it faces upwards, `normal`.
bad scene (a.toml:2:59): a rectangle needs two edges or a size. Give it either `edge_u` and `edge_v`, or `size` and, unless it faces upwards, `normal`.
bad scene (a.toml:2:44): a rectangle needs two edges or a size. Give it either `edge_u` and `edge_v`, or `size` and, unless it faces upwards, `normal`.
bad scene (a.toml:2:64): an edge cannot be [0, 0, 0]. Give the whole edge, as [x, y, z].
bad scene (a.toml:2:64): `edge_v` is parallel to `edge_u`. Turn one of them.
bad scene (a.toml:2:42): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:42): expected two numbers [width, height], found more. See `glimray schema` for what is allowed.
bad scene (a.toml:2:32): y of `max` is not greater than y of `min`. Give a box a width, a height and a depth, or use a rectangle.
bad scene (a.toml:2:32): z of `max` is not greater than z of `min`. Give a box a width, a height and a depth, or use a rectangle.
bad scene (a.toml:2:26): unknown key `size`. Allowed here: `min`, `max`.
bad scene (a.toml:2:37): `to` is the same point as `from`. Move one of them.
bad scene (a.toml:2:57): -1 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:12): the key `radius` is missing. Add `radius = …`.
bad scene (a.toml:2:67): invalid type: integer `1`, expected a boolean. See `glimray schema` for what is allowed.
bad scene (a.toml:2:33): `to` is the same point as `from`. Move one of them.
bad scene (a.toml:2:58): both radii of the cone are 0. Make one of them greater than 0.
bad scene (a.toml:2:58): -1 is not 0 or more. See `glimray schema` for what is allowed.
bad scene (a.toml:2:8): the key `from_radius` is missing. Add `from_radius = …`.
bad scene (a.toml:2:64): `minor_radius` is greater than `major_radius`, which is 1. Make the tube thinner.
bad scene (a.toml:2:64): 0 is not greater than 0. See `glimray schema` for what is allowed.
bad scene (a.toml:2:38): a direction cannot be [0, 0, 0]. See `glimray schema` for what is allowed.
bad scene (a.toml:1:1): an object needs exactly one surface or group. Give it one of `sphere`, `ellipsoid`, `plane`, `disc`, `rectangle`, `box`, `cylinder`, `cone`, `torus`, `triangle`, `mesh` and `group`.
bad scene (a.toml:3:13): the object's coordinates are out of range: at most 3.4e38 is allowed. Make it smaller, or move it nearer to the origin.
");
}
