//! Data derived from a mesh, independent of its instances; cached as long as the mesh is the same object.

use super::{
    PackError,
    shell::{self, Shell},
    topology::Topology,
};
use glimray_scene::{Mesh, Scene};
use std::{
    collections::HashMap,
    sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError},
};

/// Meshes of fewer triangles have no drafts: the tree of so many takes about 0.2 s on two cores.
pub const DRAFT_FROM: usize = 1 << 18;

/// A mesh with lazily derived data.
#[derive(Debug)]
pub struct CachedMesh {
    pub mesh: Arc<Mesh>,
    /// Whether the corners of some triangle differ in material.
    pub mixes_materials: bool,
    topology: Mutex<Option<Arc<Topology>>>,
    uvs: OnceLock<Arc<[[f32; 4]]>>,
    colors: OnceLock<Arc<[[f32; 4]]>>,
    shell: OnceLock<Option<Arc<Shell>>>,
    part_count: OnceLock<usize>,
    is_closed: OnceLock<bool>,
}

impl CachedMesh {
    fn new(mesh: &Arc<Mesh>) -> Self {
        let material = |i: u32| mesh.materials[i as usize];
        let mixes =
            |t: &[u32; 3]| material(t[0]) != material(t[1]) || material(t[0]) != material(t[2]);
        Self {
            mesh: mesh.clone(),
            mixes_materials: mesh.triangles.iter().any(mixes),
            topology: Mutex::default(),
            uvs: OnceLock::new(),
            colors: OnceLock::new(),
            shell: OnceLock::new(),
            part_count: OnceLock::new(),
            is_closed: OnceLock::new(),
        }
    }

    /// The topology of its BLAS; increments `built` if it has to be built.
    pub fn topology(&self, built: &mut usize) -> Arc<Topology> {
        let build = || {
            *built += 1;
            Arc::new(Topology::build(&self.mesh.positions, &self.mesh.triangles))
        };
        self.known_topology().get_or_insert_with(build).clone()
    }

    /// Gives a large mesh without a topology a draft of it; increments `built` then.
    pub fn draft(&self, built: &mut usize) {
        if self.mesh.triangles.len() < DRAFT_FROM {
            return;
        }
        let mut known = self.known_topology();
        if known.is_none() {
            *known = Topology::draft(&self.mesh.positions, &self.mesh.triangles).map(Arc::new);
            *built += usize::from(known.is_some());
        }
    }

    /// Whether its topology is a draft.
    pub fn is_draft(&self) -> bool {
        self.known_topology().as_ref().is_some_and(|it| it.is_draft)
    }

    /// Replaces a draft. Meanwhile others can use it.
    pub fn refine(&self) {
        if self.is_draft() {
            let better = Topology::build(&self.mesh.positions, &self.mesh.triangles);
            *self.known_topology() = Some(Arc::new(better));
        }
    }

    fn known_topology(&self) -> MutexGuard<'_, Option<Arc<Topology>>> {
        self.topology.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// u and v of each vertex in both sets, zeros where it has no texture coordinates. Without a second set the first
    /// is in its place.
    pub fn uvs(&self) -> Arc<[[f32; 4]]> {
        let uvs = || {
            let second = match &self.mesh.second_uvs[..] {
                [] => &self.mesh.uvs,
                _ => &self.mesh.second_uvs,
            };
            let mut uvs: Vec<_> = (self.mesh.uvs.iter().zip(second))
                .map(|(first, second)| [first.x, first.y, second.x, second.y])
                .collect();
            uvs.resize(self.mesh.positions.len(), [0.0; 4]);
            uvs.into()
        };
        self.uvs.get_or_init(uvs).clone()
    }

    /// The colour of each vertex, white where it has none.
    pub fn colors(&self) -> Arc<[[f32; 4]]> {
        let colors = || {
            let mut colors: Vec<_> = self.mesh.colors.iter().map(|it| it.to_array()).collect();
            colors.resize(self.mesh.positions.len(), [1.0; 4]);
            colors.into()
        };
        self.colors.get_or_init(colors).clone()
    }

    /// The mesh's surface for inside tests; `None` without triangles.
    pub fn shell(&self) -> Option<Arc<Shell>> {
        let shell = || Shell::of(&self.mesh).map(Arc::new);
        self.shell.get_or_init(shell).clone()
    }

    /// The number of connected components.
    pub fn part_count(&self) -> usize {
        *(self.part_count).get_or_init(|| shell::part_count(&self.mesh))
    }

    /// Whether its triangles enclose a volume.
    pub fn is_closed(&self) -> bool {
        *(self.is_closed).get_or_init(|| shell::is_closed(&self.mesh))
    }
}

/// One for each mesh of a scene; those in `before` are reused.
///
/// # Errors
/// The arrays of a new one, or what deforms one, do not fit each other.
pub fn cached(
    before: &[Arc<CachedMesh>],
    scene: &Scene,
) -> Result<Vec<Arc<CachedMesh>>, PackError> {
    let known: HashMap<_, _> = (before.iter())
        .map(|cached| (Arc::as_ptr(&cached.mesh), cached))
        .collect();
    let cached = |(index, mesh): (usize, &Arc<Mesh>)| match known.get(&Arc::as_ptr(mesh)) {
        Some(&cached) => Ok(cached.clone()),
        None => match mesh.inconsistency(scene.materials.len()) {
            Some(what) => Err(PackError::Inconsistent { index, what }),
            None => Ok(Arc::new(CachedMesh::new(mesh))),
        },
    };
    let mut next = 0;
    for deformation in &scene.deformations {
        let index = deformation.mesh;
        let what = match scene.meshes.get(index) {
            _ if index < next => Some("deformations are not in the order of their meshes".into()),
            Some(mesh) => deformation.inconsistency(mesh.positions.len(), scene.nodes.len()),
            None => Some("it deforms, but does not exist".into()),
        };
        if let Some(what) = what {
            return Err(PackError::Inconsistent { index, what });
        }
        next = index + 1;
    }
    scene.meshes.iter().enumerate().map(cached).collect()
}
