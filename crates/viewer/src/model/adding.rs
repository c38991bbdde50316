//! Things that can be added to a scene: their list, and how each is made.

use crate::model::objects::{Id, unused_name};
use glam::{DAffine3, DMat3, DVec3, Vec3};
use glimray_scene::{
    Attenuation, Camera, CanonicalShape, Geometry, Instance, Light, LightKind, Material, Mesh,
    ObjectRef, Phong, Scene, Shape,
};
use std::sync::Arc;

/// Height of the view at the pivot over the radius of what is added.
const VIEW: f64 = 5.0;

/// Radius of the tube of a torus, as a fraction of its own.
const TUBE: f64 = 0.3;

/// Angles of the cone of a spot light from its axis, in radians: of full and of no intensity.
const CONE: [f64; 2] = [
    20.0 * std::f64::consts::PI / 180.0,
    30.0 * std::f64::consts::PI / 180.0,
];

/// Shadow rays of an area light.
const LIGHT_SAMPLES: u32 = 16;

/// The colours and the exponent of the material of what is added.
const DIFFUSE: Vec3 = Vec3::splat(0.7);
const SPECULAR: Vec3 = Vec3::splat(0.25);
const SHININESS: f32 = 50.0;

/// A thing that can be added.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Addition {
    /// A ball.
    Sphere,
    /// A box.
    Box,
    /// A cylinder with caps.
    Cylinder,
    /// A cone with a cap.
    Cone,
    /// A torus.
    Torus,
    /// An ellipsoid.
    Ellipsoid,
    /// An infinite plane, on which things at the pivot stand.
    Plane,
    /// A rectangle.
    Rectangle,
    /// A disc.
    Disc,
    /// A triangle.
    Triangle,
    /// A light that shines evenly in all directions.
    PointLight,
    /// A light from infinitely far away.
    DirectionalLight,
    /// A light that shines into a cone.
    SpotLight,
    /// A light that shines from one side of a rectangle.
    RectangleLight,
    /// A light that shines from one side of a disc.
    DiscLight,
    /// A ball that shines.
    SphereLight,
    /// A camera with the current view.
    Camera,
}

impl Addition {
    /// The surfaces.
    pub const SURFACES: [Self; 10] = [
        Self::Sphere,
        Self::Box,
        Self::Cylinder,
        Self::Cone,
        Self::Torus,
        Self::Ellipsoid,
        Self::Plane,
        Self::Rectangle,
        Self::Disc,
        Self::Triangle,
    ];
    /// The lights.
    pub const LIGHTS: [Self; 6] = [
        Self::PointLight,
        Self::DirectionalLight,
        Self::SpotLight,
        Self::RectangleLight,
        Self::DiscLight,
        Self::SphereLight,
    ];

    /// The label in menus, and the name in the scene.
    pub fn title(self) -> &'static str {
        match self {
            Self::Sphere => "Sphere",
            Self::Box => "Box",
            Self::Cylinder => "Cylinder",
            Self::Cone => "Cone",
            Self::Torus => "Torus",
            Self::Ellipsoid => "Ellipsoid",
            Self::Plane => "Plane",
            Self::Rectangle => "Rectangle",
            Self::Disc => "Disc",
            Self::Triangle => "Triangle",
            Self::PointLight => "Point light",
            Self::DirectionalLight => "Directional light",
            Self::SpotLight => "Spot light",
            Self::RectangleLight => "Rectangle light",
            Self::DiscLight => "Disc light",
            Self::SphereLight => "Sphere light",
            Self::Camera => "Camera",
        }
    }
}

/// Where things are added, and how large they are.
#[derive(Clone, Debug, PartialEq)]
pub struct Spot {
    /// The point around which things are placed, in world space.
    pub pivot: DVec3,
    /// Half the size of things: 1, 2 or 5 times a power of ten.
    pub size: f64,
    /// The unit vector that points up.
    pub up: DVec3,
    /// The camera of the view, in world space.
    pub camera: Camera,
}

impl Spot {
    /// A spot at `pivot` where things have a good size in the view of `camera`.
    pub fn new(pivot: DVec3, up: DVec3, camera: Camera) -> Self {
        let distance = camera.look_from.distance(pivot);
        let height = camera
            .orthographic_height
            .unwrap_or(2.0 * (camera.fov_y / 2.0).tan() * distance);
        Self {
            pivot,
            size: rounded(height / VIEW),
            up,
            camera,
        }
    }

    /// The place of lights: above the pivot, on the right, on the side of the camera.
    fn lamp(&self) -> DVec3 {
        let towards = self.camera.look_from - self.pivot;
        let back = towards.reject_from_normalized(self.up);
        let back = back.normalize_or(self.up.any_orthonormal_vector());
        let right = self.up.cross(back);
        self.pivot + (right * 2.0 + self.up * 4.0 + back * 3.0) * self.size
    }
}

/// The largest of 1, 2 and 5 times a power of ten that is at most `size`; 1 for what is not a size.
pub fn rounded(size: f64) -> f64 {
    let power = 10_f64.powf(size.log10().floor());
    let factor = [5.0, 2.0, 1.0]
        .into_iter()
        .find(|factor| factor * power <= size * (1.0 + 1e-9));
    let rounded = factor.unwrap_or(1.0) * power;
    match rounded.is_finite() && rounded > 0.0 {
        true => rounded,
        false => 1.0,
    }
}

/// Adds something with a name and a material of its own, and returns it.
pub fn add(scene: &mut Scene, what: Addition, spot: &Spot) -> Id {
    let name = unused_name(scene, what.title());
    if what == Addition::Camera {
        scene.cameras.push(Camera {
            name,
            node: None,
            target: None,
            ..spot.camera.clone()
        });
        return Id::Camera(scene.cameras.len() - 1);
    }
    if let Some(light) = light(what, spot) {
        scene.lights.push(Light { name, ..light });
        return Id::Object(ObjectRef::Light(scene.lights.len() - 1));
    }
    let material = scene.materials.len();
    scene.materials.push(Material {
        name: name.clone(),
        bsdf: Phong {
            diffuse: DIFFUSE,
            specular: SPECULAR,
            shininess: SHININESS,
            ambient: DIFFUSE,
            ..Phong::default()
        }
        .into(),
        ..Material::default()
    });
    let Some(geometry) = geometry(what, spot) else {
        scene
            .meshes
            .push(Arc::new(triangle(&name, material as u32)));
        scene.instances.push(Instance {
            mesh: scene.meshes.len() - 1,
            placement: upright(spot, DVec3::splat(spot.size), DVec3::ZERO),
            node: None,
            name,
        });
        return Id::Object(ObjectRef::Instance(scene.instances.len() - 1));
    };
    scene.shapes.push(Shape {
        geometry,
        material,
        node: None,
        name,
    });
    Id::Object(ObjectRef::Shape(scene.shapes.len() - 1))
}

/// A canonical frame whose y axis points up, scaled, its origin at `offset` times the size from the pivot.
fn upright(spot: &Spot, scale: DVec3, offset: DVec3) -> DAffine3 {
    // Exact for +Y.
    let turn = match spot.up == DVec3::Y {
        true => DMat3::IDENTITY,
        false => {
            let z = spot.up.any_orthonormal_vector();
            DMat3::from_cols(spot.up.cross(z), spot.up, z)
        }
    };
    let at = spot.pivot + turn * offset * spot.size;
    DAffine3::from_mat3_translation(turn * DMat3::from_diagonal(scale), at)
}

/// The surface of something; `None` for a triangle.
fn geometry(what: Addition, spot: &Spot) -> Option<Geometry> {
    let size = spot.size;
    let placed = |canonical, scale: DVec3, offset| {
        Some(Geometry::Placed {
            canonical,
            world_from_canonical: upright(spot, scale * size, offset),
        })
    };
    let cone = |top| {
        let canonical = CanonicalShape::Cone {
            bottom: 1.0,
            top,
            capped: true,
        };
        placed(canonical, DVec3::new(1.0, 2.0, 1.0), DVec3::NEG_Y)
    };
    match what {
        Addition::Sphere => Some(Geometry::Sphere {
            center: spot.pivot,
            radius: size,
        }),
        Addition::Plane => Some(Geometry::Plane {
            point: spot.pivot - spot.up * size,
            normal: spot.up,
        }),
        Addition::Box => placed(CanonicalShape::Box, DVec3::ONE, DVec3::ZERO),
        Addition::Cylinder => cone(1.0),
        Addition::Cone => cone(0.0),
        Addition::Torus => placed(
            CanonicalShape::Torus { minor: TUBE },
            DVec3::ONE,
            DVec3::ZERO,
        ),
        Addition::Ellipsoid => placed(
            CanonicalShape::Ellipsoid,
            DVec3::new(1.0, 0.5, 0.5),
            DVec3::ZERO,
        ),
        Addition::Rectangle => placed(CanonicalShape::Rectangle, DVec3::ONE, DVec3::ZERO),
        Addition::Disc => placed(CanonicalShape::Disc { hole: 0.0 }, DVec3::ONE, DVec3::ZERO),
        _ => None,
    }
}

/// A triangle that faces +z, with its corners at distance about 1.
fn triangle(name: &str, material: u32) -> Mesh {
    Mesh {
        name: name.to_owned(),
        positions: vec![
            Vec3::new(-1.0, -1.0, 0.0),
            Vec3::new(1.0, -1.0, 0.0),
            Vec3::new(0.0, 1.0, 0.0),
        ],
        normals: vec![Vec3::Z; 3],
        materials: vec![material; 3],
        triangles: vec![[0, 1, 2]],
        ..Mesh::default()
    }
}

/// A light that gives a white surface at the pivot a radiance of 1. `None` for what is not a light.
fn light(what: Addition, spot: &Spot) -> Option<Light> {
    let position = spot.lamp();
    let way = spot.pivot - position;
    let direction = way.normalize_or(-spot.up);
    let (u, v) = direction.any_orthonormal_pair();
    let radius = spot.size / 2.0;
    let kind = match what {
        Addition::PointLight => LightKind::Point { position },
        Addition::DirectionalLight => LightKind::Directional { direction },
        Addition::SpotLight => LightKind::Spot {
            position,
            direction,
            inner: CONE[0],
            outer: CONE[1],
        },
        Addition::RectangleLight => LightKind::Rectangle {
            center: position,
            edge_u: u * spot.size,
            edge_v: v * spot.size,
        },
        Addition::DiscLight => LightKind::Disc {
            center: position,
            normal: direction,
            radius: spot.size,
        },
        Addition::SphereLight => LightKind::Sphere {
            center: position,
            radius,
        },
        _ => return None,
    };
    let is_large = kind.radiance().is_some();
    let (attenuation, intensity) = match what {
        Addition::DirectionalLight => (Attenuation::None, 1.0),
        _ => (Attenuation::InverseSquare, way.length_squared() as f32),
    };
    Some(Light {
        kind,
        color: Vec3::splat(intensity),
        attenuation,
        samples: if is_large { LIGHT_SAMPLES } else { 1 },
        visible: is_large,
        ..Light::default()
    })
}
