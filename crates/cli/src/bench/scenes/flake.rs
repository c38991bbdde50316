//! A sphereflake: spheres of very different sizes that touch each other.

use super::{Detail, empty};
use glam::{DMat3, DVec3, Vec3, dvec3};
use glimray_scene::{Geometry, Material, Phong, Scene, Shape};

/// A sphere with nine smaller spheres on it, and so on, after `balls` of Haines' Standard Procedural Databases
/// (1987): 7,381 spheres.
pub fn sphereflake(detail: Detail) -> Scene {
    let mut scene = empty([dvec3(1.5, 0.9, 1.2), DVec3::ZERO], dvec3(4.0, 3.0, 2.0));
    scene.cameras[0].up = DVec3::Z;
    scene.materials = vec![Material::from(Phong {
        diffuse: Vec3::new(0.5, 0.45, 0.35),
        specular: Vec3::splat(0.3),
        shininess: 30.0,
        reflect: Vec3::splat(0.3),
        ..Phong::default()
    })];
    let root = Sphere {
        center: DVec3::ZERO,
        radius: 0.5,
        direction: DVec3::Z,
    };
    root.add_to(&mut scene, &directions(), detail.of(4, 2));
    scene
}

struct Sphere {
    center: DVec3,
    radius: f64,
    /// From the parent sphere.
    direction: DVec3,
}

impl Sphere {
    fn add_to(&self, scene: &mut Scene, directions: &[DVec3; 9], levels: u32) {
        scene.shapes.push(Shape {
            geometry: Geometry::Sphere {
                center: self.center,
                radius: self.radius,
            },
            material: 0,
            node: None,
            name: String::new(),
        });
        if levels == 0 {
            return;
        }
        let turned = from_z_to(self.direction);
        for direction in directions {
            let direction = turned * *direction;
            let child = Sphere {
                center: self.center + 4.0 / 3.0 * self.radius * direction,
                radius: self.radius / 3.0,
                direction,
            };
            child.add_to(scene, directions, levels - 1);
        }
    }
}

/// The directions of the children of a sphere that lies in direction +z from its parent: six around its
/// equator, and three above, 30° from the pole.
fn directions() -> [DVec3; 9] {
    let side = 0.75_f64.sqrt();
    let six = [
        (1.0, 0.0),
        (0.5, side),
        (-0.5, side),
        (-1.0, 0.0),
        (-0.5, -side),
        (0.5, -side),
    ];
    let three = [(side, 0.5), (-side, 0.5), (0.0, -1.0)];
    let mut all = [DVec3::ZERO; 9];
    for (place, (x, y)) in all.iter_mut().zip(six) {
        *place = dvec3(x, y, 0.0);
    }
    for (place, (x, y)) in all[6..].iter_mut().zip(three) {
        *place = dvec3(0.5 * x, 0.5 * y, side);
    }
    all
}

/// The shortest rotation from +z to a unit vector (Rodrigues' formula).
fn from_z_to(direction: DVec3) -> DMat3 {
    let (axis, cosine) = (DVec3::Z.cross(direction), direction.z);
    if cosine < -0.999_999 {
        return DMat3::from_diagonal(dvec3(1.0, -1.0, -1.0));
    }
    let cross = DMat3::from_cols(
        dvec3(0.0, axis.z, -axis.y),
        dvec3(-axis.z, 0.0, axis.x),
        dvec3(axis.y, -axis.x, 0.0),
    );
    DMat3::IDENTITY + cross + cross * cross * (1.0 / (1.0 + cosine))
}
