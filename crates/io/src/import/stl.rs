//! STL: the triangles of CAD programs and 3D printers, as text or binary.
//!
//! The format repeats the corners of every facet, so equal corners become one vertex, exactly. The normals in
//! the file are not used: they are derived from the corners, smooth where facets meet at less than 45°. The
//! format does not name an up axis; its programs take +Z. Sources: the StereoLithography Interface
//! Specification (3D Systems, 1989), and of binary files the colours of VisCAM and SolidView and those of
//! Materialise Magics, as their vendors' users describe them.

mod binary;
mod text;

use super::budget::{self, Budget};
use super::crease::Facets;
use super::error::{ImportError, fault};
use super::model::Model;
use super::notes::{self, Notes};
use super::source::Source;
use super::tint::{self, Rgb};
use super::weld::Welder;
use super::{Axis, Options};
use glam::{DVec3, Vec3};
use glimray_scene::{Material, Mesh, Repairs, Scene};
use std::path::Path;

/// All keywords of the text form, and the parts of the binary one.
pub(super) const KEYS: [&str; 7] = [
    "solid",
    "facet",
    "normal",
    "vertex",
    "COLOR=",
    "MATERIAL=",
    "attribute",
];

/// Facets that meet at less than this angle, in radians, are smooth across their edge.
const CREASE: f64 = std::f64::consts::FRAC_PI_4;

/// The cosine of the angle by which the normal of a facet in the file may differ from that of its corners: 60°.
const MOST_TILT: f64 = 0.5;

/// The facets of a file while it is read.
struct Solid {
    welder: Welder,
    triangles: Vec<[u32; 3]>,
    /// One for each triangle, or empty.
    colors: Vec<Option<Rgb>>,
    /// The colour of facets that have none.
    color: Option<Rgb>,
    /// Number of facets whose normal in the file points elsewhere than that of their corners.
    odd_normals: usize,
    /// Number of facets with coordinates that are not finite.
    nonfinite: usize,
    notes: Notes,
}

impl Solid {
    fn new() -> Self {
        Self {
            welder: Welder::new(),
            triangles: Vec::new(),
            colors: Vec::new(),
            color: None,
            odd_normals: 0,
            nonfinite: 0,
            notes: Notes::default(),
        }
    }

    /// Adds a facet with the `normal` that the file has for it; returns whether its coordinates are finite.
    fn add(&mut self, normal: Vec3, corners: [Vec3; 3]) -> bool {
        let is_finite = corners.iter().all(|corner| corner.is_finite());
        if is_finite {
            let [a, b, c] = corners.map(|corner| corner.as_dvec3());
            let own = (b - a).cross(c - a).normalize_or_zero();
            let given = normal.as_dvec3();
            // Files have 0 or NaN for a normal that is to be computed.
            let differs = own.dot(given) < MOST_TILT * given.length();
            self.odd_normals += usize::from(differs && own != DVec3::ZERO);
            let triangle = corners.map(|corner| self.welder.index(corner));
            self.triangles.push(triangle);
        } else {
            self.nonfinite += 1;
        }
        is_finite
    }

    fn into_model(mut self, path: &Path) -> Model {
        let mut materials = vec![Material::default()];
        let mut ids = vec![0; self.triangles.len()];
        if self.color.is_some() || self.colors.iter().any(Option::is_some) {
            self.colors.resize(self.triangles.len(), None);
            for color in &mut self.colors {
                *color = color.or(self.color);
            }
            let white = [tint::white()];
            // Colours of 5 bits a channel never exceed the limit.
            (materials, _) = tint::tint(&white, &mut ids, &self.colors);
        }
        let mut facets = Facets {
            positions: self.welder.positions,
            triangles: self.triangles,
            materials: ids,
        };
        let dropped_triangles = facets.drop_degenerate();
        let mut mesh = facets.into_mesh(CREASE);
        let places: Vec<DVec3> = mesh.positions.iter().map(|p| p.as_dvec3()).collect();
        let offset;
        (mesh.positions, offset) = Mesh::from_world_positions(&places);
        mesh.name = (path.file_stem().unwrap_or_default())
            .to_string_lossy()
            .into_owned();
        // Positions are rounded again only if that makes them more precise.
        let repairs = mesh.repair();
        let mut notes = self.notes;
        if self.nonfinite > 0 {
            notes.add("facets", || {
                format!(
                    "facets with coordinates that are not finite skipped: {}",
                    self.nonfinite
                )
            });
        }
        if self.odd_normals > 0 {
            notes.add("facets", || {
                let count = self.odd_normals;
                format!("normals that contradict the corners of their facets skipped: {count}")
            });
        }
        notes::of_repairs(
            &mut notes,
            Repairs {
                dropped_triangles: dropped_triangles + repairs.dropped_triangles,
                ..repairs
            },
        );
        Model {
            mesh,
            offset,
            materials,
            notes,
            ..Model::default()
        }
    }
}

/// The scene in `bytes`, the contents of the file at `path`.
///
/// # Errors
/// The file is neither a text nor a binary STL file, or is truncated.
pub(super) fn read_scene(
    path: &Path,
    bytes: Vec<u8>,
    options: &Options,
) -> Result<Scene, ImportError> {
    let model = read_model(path, bytes)?;
    Ok(model.into_scene(Vec::new(), Axis::Z, options))
}

/// Whether `bytes` are those of an STL file, whatever its name.
#[cfg(not(target_arch = "wasm32"))]
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    binary::header(bytes).is_some() || text::is_text(bytes)
}

/// The model in `bytes`, in the file's own axes.
pub(super) fn read_model(path: &Path, bytes: Vec<u8>) -> Result<Model, ImportError> {
    let budget = Budget::of(bytes.len());
    let length = bytes.len();
    let solid = match binary::header(&bytes) {
        Some(count) => binary::read(&bytes, count),
        None if text::is_text(&bytes) => {
            text::read(&Source::of_any_encoding("bad model", path, bytes)?)?
        }
        None => match binary::room(&bytes) {
            Some(count) => binary::read(&bytes, count),
            None => return Err(binary::refuse(path, &bytes)),
        },
    };
    let taken = length as u64
        + budget::size::<[u8; Facets::BYTES]>(solid.triangles.len())
        + budget::size::<([u8; Welder::BYTES], DVec3)>(solid.welder.positions.len())
        + budget::size::<Option<Rgb>>(solid.colors.len())
        + if solid.colors.is_empty() {
            0
        } else {
            tint::bytes()
        };
    budget.check(taken, |why, todo| {
        ImportError::TooBig(fault("bad model", path, &why, todo))
    })?;
    Ok(solid.into_model(path))
}
