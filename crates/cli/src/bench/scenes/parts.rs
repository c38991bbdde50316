//! Parts of meshes.

use glam::{DVec3, dvec3};
use glimray_scene::Mesh;

/// A mesh under construction.
#[derive(Default)]
pub struct Builder(Mesh);

impl Builder {
    /// A grid of `columns` × `rows` quads, each of two triangles; `at(i, j)` is the position of a vertex, with
    /// `i` up to `columns` and `j` up to `rows`.
    pub fn grid(&mut self, columns: u32, rows: u32, at: impl Fn(u32, u32) -> DVec3) {
        let first = self.0.positions.len() as u32;
        let side = columns + 1;
        let vertices = (0..side * (rows + 1)).map(|index| at(index % side, index / side));
        (self.0.positions).extend(vertices.map(|position| position.as_vec3()));
        let corners =
            (0..columns * rows).map(|quad| first + quad / columns * side + quad % columns);
        (self.0.triangles)
            .extend(corners.flat_map(|i| [[i, i + side, i + 1], [i + 1, i + side, i + side + 1]]));
    }

    /// A triangle with vertices of its own.
    pub fn triangle(&mut self, corners: [DVec3; 3]) {
        let first = self.0.positions.len() as u32;
        self.0
            .positions
            .extend(corners.map(|corner| corner.as_vec3()));
        self.0.triangles.push([first, first + 1, first + 2]);
    }

    /// A prism without ends round the axis from `start` to `end`: 2 × `sides` long triangles.
    pub fn tube(&mut self, [start, end]: [DVec3; 2], radius: f64, sides: u32) {
        let (u, v) = perpendicular(end - start);
        self.grid(sides, 1, |i, j| {
            let (x, y) = circle(i, sides);
            let center = if j == 0 { start } else { end };
            center + radius * (x * u + y * v)
        });
    }

    /// A ball of 8 × `rows`² small triangles: an octahedron whose vertices are moved to the sphere.
    pub fn ball(&mut self, center: DVec3, radius: f64, rows: u32) {
        for octant in 0..8_u32 {
            let sign = |axis: u32| if (octant >> axis) & 1 == 0 { 1.0 } else { -1.0 };
            let at = |i: u32, j: u32| {
                let [x, y, z] = [i, j, rows - i - j].map(f64::from);
                center + radius * dvec3(sign(0) * x, sign(1) * y, sign(2) * z).normalize()
            };
            for i in 0..rows {
                for j in 0..rows - i {
                    self.triangle([at(i, j), at(i + 1, j), at(i, j + 1)]);
                    if i + j + 1 < rows {
                        self.triangle([at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
                    }
                }
            }
        }
    }

    /// Number of triangles so far.
    pub fn triangle_count(&self) -> usize {
        self.0.triangles.len()
    }

    /// The mesh, with normals and with one material.
    pub fn mesh(self) -> Mesh {
        let mut mesh = self.0;
        mesh.materials = vec![0; mesh.positions.len()];
        mesh.repair();
        mesh
    }
}

/// Corner `index` of a polygon of `count` corners on the unit circle: points on a square, moved to the circle.
/// They are not evenly spaced, but need no trigonometric functions.
pub fn circle(index: u32, count: u32) -> (f64, f64) {
    let along = 4.0 * f64::from(index % count) / f64::from(count);
    let within = along - along.floor();
    let (x, y) = match along as u32 {
        0 => (1.0 - within, within),
        1 => (-within, 1.0 - within),
        2 => (within - 1.0, -within),
        _ => (within, within - 1.0),
    };
    let length = (x * x + y * y).sqrt();
    (x / length, y / length)
}

/// Two unit vectors perpendicular to `axis` and to each other.
pub fn perpendicular(axis: DVec3) -> (DVec3, DVec3) {
    let axis = axis.normalize();
    let aside = if axis.x.abs() < 0.6 {
        DVec3::X
    } else {
        DVec3::Y
    };
    let u = axis.cross(aside).normalize();
    (u, axis.cross(u))
}
