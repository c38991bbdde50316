//! From the height of a surface to its normal map (Blinn, Simulation of Wrinkled Surfaces, 1978).

use glam::{Vec3, Vec4};
use glimray_scene::{SrgbCurve, Texels};

/// The normal map of a surface of these heights, from central differences; `amount` is the height of white, in texels.
/// The picture is repeated. `None` if texels have colours.
pub(super) fn normals(texels: &Texels, [width, height]: [u32; 2], amount: f32) -> Option<Texels> {
    let curve = SrgbCurve::default();
    let count = texels.len();
    let is_gray = |v: Vec4| v.x == v.y && v.y == v.z;
    if !(0..count).all(|index| is_gray(texels.linear(&curve, index))) {
        return None;
    }
    let (width, height) = (width as usize, height as usize);
    let at = |column: usize, row: usize| {
        let index = row % height * width + column % width;
        texels.linear(&curve, index).x.min(1.0)
    };
    let normal = |index: usize| {
        let (x, y) = (index % width, index / width);
        // v points upwards, and rows go downwards.
        let along_u = at(x + 1, y) - at(x + width - 1, y);
        let along_v = at(x, y + height - 1) - at(x, y + 1);
        let n = Vec3::new(-0.5 * amount * along_u, -0.5 * amount * along_v, 1.0).normalize();
        (0.5 * n + 0.5).extend(1.0)
    };
    Some(Texels::Float((0..count).map(normal).collect()))
}
