//! The scenes of the ray sets: procedural, and the same on every machine to the last bit.

mod flake;
mod forest;
mod glass;
mod hairball;
mod hall;
pub(super) mod parts;
mod terrain;

pub use flake::sphereflake;
pub use forest::forest;
pub use glass::glass;
pub use hairball::hairball;
pub use hall::hall;
pub use terrain::{height_field, hills, terrain};

use glam::{DAffine3, DVec3, Vec3};
use glimray_scene::{Background, Camera, Instance, Light, LightKind, Material, Mesh, Scene};

/// How large a scene is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Detail {
    /// As the benchmark measures it.
    Full,
    /// About a hundredth of the primitives in the same shapes, for tests.
    Small,
}

impl Detail {
    /// The first number at full detail, the second for tests.
    fn of<T>(self, full: T, small: T) -> T {
        match self {
            Self::Full => full,
            Self::Small => small,
        }
    }
}

/// A scene by its name.
#[derive(Clone, Copy, Debug)]
pub struct Procedural {
    /// The scene's name.
    pub name: &'static str,
    /// Generates the scene.
    pub scene: fn(Detail) -> Scene,
    /// Whether `--quick` omits it because its trees take long to build.
    pub is_large: bool,
}

/// Every scene with ray sets, in the order of measurement.
pub const ALL: &[Procedural] = &[
    Procedural::new("heightfield", height_field),
    Procedural::new("sphereflake", sphereflake),
    Procedural::new("hall", hall),
    Procedural::new("hairball", hairball),
    Procedural::new("forest", forest),
    Procedural {
        is_large: true,
        ..Procedural::new("terrain", terrain)
    },
];

impl Procedural {
    const fn new(name: &'static str, scene: fn(Detail) -> Scene) -> Self {
        Self {
            name,
            scene,
            is_large: false,
        }
    }
}

/// A scene of one mesh, which is seen from `look_from` and lit by a light at `light`.
fn of_mesh(mesh: Mesh, [look_from, look_at]: [DVec3; 2], light: DVec3) -> Scene {
    Scene {
        meshes: vec![mesh.into()],
        instances: vec![placed(0, DAffine3::IDENTITY)],
        ..empty([look_from, look_at], light)
    }
}

/// A scene without objects.
fn empty([look_from, look_at]: [DVec3; 2], light: DVec3) -> Scene {
    Scene {
        materials: vec![Material::default()],
        lights: vec![Light {
            kind: LightKind::Point { position: light },
            color: Vec3::splat(0.8),
            ..Light::default()
        }],
        cameras: vec![Camera {
            look_from,
            look_at,
            ..Camera::default()
        }],
        background: Background::Color(Vec3::new(0.5, 0.7, 1.0)),
        ambient: Vec3::splat(0.2),
        ..Scene::default()
    }
}

fn placed(mesh: usize, placement: DAffine3) -> Instance {
    Instance {
        mesh,
        placement,
        node: None,
        name: String::new(),
    }
}
