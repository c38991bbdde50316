//! Traces ray sets (../README.md) with the CPU traversal of obvhs, through a BVH2 and a CWBVH of its medium build.
//!
//! `obvhs-peer FOLDER [--threads 1,2] [--rounds 5] [--json FILE]`

use glam::Vec3A;
use obvhs::BvhBuildParams;
use obvhs::bvh2::{Bvh2, builder::build_bvh2_from_tris};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh_from_tris};
use obvhs::ray::{Ray, RayHit};
use obvhs::rt_triangle::RtTriangle;
use obvhs::triangle::Triangle;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use std::{env, error, fs, thread};

/// A thread takes this many rays at a time.
const BLOCK: usize = 4096;

/// The rays of one file: origin, direction, t_max.
struct RaySet {
    name: String,
    is_any_hit: bool,
    rays: Vec<[f32; 7]>,
}

/// A tree with its triangles in the order of its leaves.
enum Tree {
    Bvh2(Bvh2, Vec<RtTriangle>),
    CwBvh(CwBvh, Vec<RtTriangle>),
}

impl Tree {
    /// The distance of the nearest hit, or of none. A ray that only asks for any hit gets 0.
    fn trace(&self, ray: Ray, is_any_hit: bool) -> Option<f32> {
        // Both trees have the same methods but no trait in common.
        macro_rules! trace {
            ($tree:expr, $triangles:expr) => {{
                let test = |ray: &Ray, i: usize| $triangles[i].intersect(ray);
                if is_any_hit {
                    return (!$tree.ray_traverse_miss(ray, test)).then_some(0.0);
                }
                let mut hit = RayHit::none();
                $tree.ray_traverse(ray, &mut hit, test).then_some(hit.t)
            }};
        }
        match self {
            Self::Bvh2(tree, triangles) => trace!(tree, triangles),
            Self::CwBvh(tree, triangles) => trace!(tree, triangles),
        }
    }
}

/// Number of hits and sum of their distances.
fn trace_all(tree: &Tree, set: &RaySet, threads: usize, distances: &mut [f32]) -> (usize, f64) {
    let next = AtomicUsize::new(0);
    let blocks: Vec<_> = (set.rays.chunks(BLOCK).zip(distances.chunks_mut(BLOCK)))
        .map(Mutex::new)
        .collect();
    let work = || {
        let (mut hits, mut sum) = (0, 0.0);
        while let Some(block) = blocks.get(next.fetch_add(1, Ordering::Relaxed)) {
            let mut block = block.lock().expect("no thread has panicked");
            let (rays, distances) = &mut *block;
            for (&[ox, oy, oz, dx, dy, dz, t_max], distance) in
                rays.iter().zip(distances.iter_mut())
            {
                let (origin, direction) = (Vec3A::new(ox, oy, oz), Vec3A::new(dx, dy, dz));
                let t = tree.trace(Ray::new(origin, direction, 0.0, t_max), set.is_any_hit);
                *distance = t.unwrap_or(f32::INFINITY);
                hits += usize::from(t.is_some());
                sum += f64::from(t.unwrap_or(0.0));
            }
        }
        (hits, sum)
    };
    thread::scope(|scope| {
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        let parts = workers
            .into_iter()
            .map(|worker| worker.join().expect("no panic"));
        parts.fold((0, 0.0), |(hits, sum), part| (hits + part.0, sum + part.1))
    })
}

fn read(path: &Path) -> Result<Vec<f32>, Box<dyn error::Error>> {
    let bytes = fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    if bytes.len() % 4 != 0 {
        return Err(format!("{}: not a list of f32", path.display()).into());
    }
    Ok(bytes
        .chunks_exact(4)
        .map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]]))
        .collect())
}

fn ray_sets(folder: &Path) -> Result<Vec<RaySet>, Box<dyn error::Error>> {
    let mut sets = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path
            .file_name()
            .and_then(|name| name.to_str())
            .unwrap_or_default();
        let [name, query @ ("closest" | "any"), "f32"] = name.split('.').collect::<Vec<_>>()[..]
        else {
            continue;
        };
        let rays = read(&path)?.as_chunks::<7>().0.to_vec();
        sets.push(RaySet {
            name: name.to_owned(),
            is_any_hit: query == "any",
            rays,
        });
    }
    sets.sort_by(|a, b| (a.is_any_hit, &a.name).cmp(&(b.is_any_hit, &b.name)));
    Ok(sets)
}

fn trees(triangles: &[Triangle]) -> [(&'static str, Tree); 2] {
    let in_order = |order: &[u32]| {
        order
            .iter()
            .map(|&i| (&triangles[i as usize]).into())
            .collect()
    };
    let mut unused = Duration::ZERO;
    let bvh2 = build_bvh2_from_tris(triangles, BvhBuildParams::medium_build(), &mut unused);
    let cwbvh = build_cwbvh_from_tris(triangles, BvhBuildParams::medium_build(), &mut unused);
    let (first, second) = (
        in_order(&bvh2.primitive_indices),
        in_order(&cwbvh.primitive_indices),
    );
    [
        ("obvhs BVH2", Tree::Bvh2(bvh2, first)),
        ("obvhs CWBVH", Tree::CwBvh(cwbvh, second)),
    ]
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    (values[(values.len() - 1) / 2] + values[middle]) / 2.0
}

/// The command line.
struct Arguments {
    folder: PathBuf,
    threads: Vec<usize>,
    rounds: usize,
    json: Option<PathBuf>,
}

fn arguments() -> Result<Arguments, Box<dyn error::Error>> {
    let mut arguments = Arguments {
        folder: PathBuf::new(),
        threads: vec![1, 2],
        rounds: 5,
        json: None,
    };
    let mut words = env::args().skip(1);
    while let Some(word) = words.next() {
        let mut value = || words.next().ok_or(format!("{word} needs a value"));
        match &*word {
            "--threads" => {
                arguments.threads = value()?
                    .split(',')
                    .map(str::parse)
                    .collect::<Result<_, _>>()?;
            }
            "--rounds" => arguments.rounds = value()?.parse()?,
            "--json" => arguments.json = Some(value()?.into()),
            folder => arguments.folder = folder.into(),
        }
    }
    if arguments.folder.as_os_str().is_empty() || arguments.rounds == 0 {
        return Err("usage: obvhs-peer FOLDER [--threads 1,2] [--rounds 5] [--json FILE]".into());
    }
    Ok(arguments)
}

fn triangles(folder: &Path) -> Result<Vec<Triangle>, Box<dyn error::Error>> {
    let corner = |v: &[f32]| Vec3A::from_slice(v);
    let triangle = |v: &[f32]| Triangle {
        v0: corner(v),
        v1: corner(&v[3..]),
        v2: corner(&v[6..]),
    };
    let corners = read(&folder.join("triangles.f32"))?;
    Ok(corners.chunks_exact(9).map(triangle).collect())
}

/// Measures every ray set of a scene with both trees. The results are JSON lines.
fn measure(folder: &Path, arguments: &Arguments) -> Result<String, Box<dyn error::Error>> {
    let scene = folder.file_name().unwrap_or_default().to_string_lossy();
    let (sets, trees) = (ray_sets(folder)?, trees(&triangles(folder)?));
    let pairs: Vec<_> = (sets.iter())
        .flat_map(|set| trees.iter().map(move |(peer, tree)| (set, peer, tree)))
        .collect();
    let most = sets.iter().map(|set| set.rays.len()).max();
    let mut distances = vec![0.0; most.unwrap_or(0)];
    let mut json = String::new();
    for &threads in &arguments.threads {
        // All in turn, so that a busy machine affects all.
        let mut seconds = vec![Vec::new(); pairs.len()];
        let mut results = vec![(0, 0.0); pairs.len()];
        for _ in 0..arguments.rounds {
            for (i, (set, _, tree)) in pairs.iter().enumerate() {
                let start = Instant::now();
                results[i] = trace_all(tree, set, threads, &mut distances[..set.rays.len()]);
                seconds[i].push(start.elapsed().as_secs_f64());
            }
        }
        for ((set, peer, _), (seconds, (hits, sum))) in
            pairs.iter().zip(seconds.into_iter().zip(results))
        {
            let rate = set.rays.len() as f64 / median(seconds) / 1e6;
            let name = &set.name;
            println!(
                "{peer:12} {scene:12} {name:18} {threads} threads {rate:8.2} Mrays/s \
                 {hits:9} hits, sum of t {sum:.2}"
            );
            write!(
                json,
                r#"{{"peer": "{peer}", "scene": "{scene}", "set": "{name}", "#
            )?;
            write!(json, r#""threads": {threads}, "mrays_per_s": {rate}, "#)?;
            writeln!(json, r#""hits": {hits}, "sum_t": {sum}}}"#)?;
        }
    }
    Ok(json)
}

fn main() -> Result<(), Box<dyn error::Error>> {
    let arguments = arguments()?;
    let entries = fs::read_dir(&arguments.folder)?;
    let folders = entries.map(|entry| entry.map(|entry| entry.path()));
    let mut folders = folders.collect::<Result<Vec<_>, _>>()?;
    folders.retain(|folder| folder.join("triangles.f32").exists());
    folders.sort();
    let json = folders
        .iter()
        .map(|folder| measure(folder, &arguments))
        .collect::<Result<String, _>>()?;
    if let Some(path) = arguments.json {
        fs::write(path, json)?;
    }
    Ok(())
}
