//! The surfaces of lights that rays can see.

use crate::scene::{Form, Geometry, LightKind, Material, Scene};
use glam::{DAffine3, DMat3, DVec3, Vec3};

/// What rays see of a light.
pub struct LightSurface {
    pub geometry: Geometry,
    /// Answers no light, and shines on the side that the light shines on.
    pub material: Material,
}

/// Those of all visible lights, in scene order.
pub fn light_surfaces(scene: &Scene) -> impl Iterator<Item = LightSurface> + '_ {
    let visible = scene.lights.iter().filter(|light| light.visible);
    visible.filter_map(|light| {
        let radiance = light.kind.radiance()?;
        Some(LightSurface {
            geometry: geometry(&light.kind)?,
            material: Material {
                diffuse: Vec3::ZERO,
                ambient: Vec3::ZERO,
                emission: (light.color.as_dvec3() * radiance).as_vec3(),
                two_sided: false,
                ..Material::default()
            },
        })
    })
}

fn geometry(kind: &LightKind) -> Option<Geometry> {
    let placed = |form, x_axis: DVec3, y_axis: DVec3, z_axis: DVec3, center| Geometry::Placed {
        form,
        world_from_form: DAffine3::from_mat3_translation(
            DMat3::from_cols(x_axis, y_axis, z_axis),
            center,
        ),
    };
    match *kind {
        LightKind::Point { .. } | LightKind::Directional { .. } | LightKind::Spot { .. } => None,
        LightKind::Rectangle {
            center,
            edge_u,
            edge_v,
        } => {
            let normal = edge_u.cross(edge_v).try_normalize()?;
            Some(placed(Form::Rectangle, edge_v, normal, edge_u, center))
        }
        LightKind::Disc {
            center,
            normal,
            radius,
        } => {
            let (x, z) = normal.any_orthonormal_pair();
            let form = Form::Disc { hole: 0.0 };
            Some(placed(form, x * radius, normal, z * radius, center))
        }
        LightKind::Sphere { center, radius } => Some(Geometry::Sphere { center, radius }),
    }
}
