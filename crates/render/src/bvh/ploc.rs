//! Parallel locally-ordered clustering (Meister and Bittner 2018): boxes are sorted along a Morton curve, and
//! neighbours whose joint box is smallest for both are merged, pass by pass.
//!
//! Equal, nested and evenly spaced boxes have few such pairs: each box prefers its predecessor, which prefers
//! its own, and a pass merges only the first two. Ties are therefore broken in favour of disjoint pairs, and
//! long chains of preferences are cut into pairs, so that the number of passes stays logarithmic.

mod search;

use super::{
    Aabb,
    linked::{Box4, LEAF, Node},
    morton::Cells,
    threads,
};
use bytemuck::allocation::zeroed_vec;
use search::search;

/// A preference is part of a long chain if this many steps along it do not lead to a pair.
const CHAIN: usize = 6;

/// The nodes over at least one box, without parents, and the number of pairs of boxes that were compared.
pub fn build(boxes: &[Aabb]) -> (Vec<Node>, u64) {
    let mut nodes: Vec<Node> = zeroed_vec(2 * boxes.len() - 1);
    let mut clusters = along_curve(boxes);
    let mut next = Clusters {
        boxes: zeroed_vec(boxes.len()),
        links: zeroed_vec(boxes.len()),
    };
    let mut near = vec![0i8; boxes.len()];
    let mut end = nodes.len();
    let mut work = 0;
    while clusters.boxes.len() > 1 {
        let count = clusters.boxes.len();
        let near = &mut near[..count];
        threads::for_chunks(near, |first, near| search(&clusters.boxes, first, near));
        work += (count * search::RADIUS) as u64;
        // A pass over a mesh usually merges more than half of the boxes.
        let mut counts = counts(near);
        if total(&counts) < count / 6 {
            cut_chains(near);
            counts = self::counts(near);
        }
        let pairs = total(&counts);
        next.truncate(count - pairs);
        let first = end - 2 * pairs;
        merge(
            &clusters,
            near,
            &counts,
            &mut next,
            &mut nodes[first..end],
            first,
        );
        end = first;
        std::mem::swap(&mut clusters, &mut next);
    }
    nodes[0] = Node::new(&clusters.boxes[0], clusters.links[0]);
    (nodes, work)
}

/// Roots of the subtrees that are not yet merged.
struct Clusters {
    boxes: Vec<Box4>,
    links: Vec<u32>,
}

impl Clusters {
    fn truncate(&mut self, count: usize) {
        self.boxes.truncate(count);
        self.links.truncate(count);
    }
}

/// All boxes, sorted by the Morton codes of their centres.
fn along_curve(boxes: &[Aabb]) -> Clusters {
    let cells = Cells::round(boxes);
    let mut order = zeroed_vec(boxes.len());
    threads::fill(&mut order, |index| {
        (cells.code(&boxes[index]), index as u32)
    });
    threads::sort(&mut order);
    let mut clusters = Clusters {
        boxes: zeroed_vec(boxes.len()),
        links: zeroed_vec(boxes.len()),
    };
    threads::fill(&mut clusters.boxes, |place| {
        let Aabb { min, max } = boxes[order[place].1 as usize];
        Box4 {
            min: min.into(),
            max: max.into(),
        }
    });
    threads::fill(&mut clusters.links, |place| LEAF | order[place].1);
    clusters
}

/// The place that a box prefers.
#[inline(always)]
fn preferred(near: &[i8], place: usize) -> usize {
    place.wrapping_add_signed(near[place] as isize)
}

#[inline(always)]
fn is_paired(near: &[i8], place: usize) -> bool {
    preferred(near, preferred(near, place)) == place
}

/// For each chunk of places, how many are the first and how many the second of a pair that prefer each other.
fn counts(near: &[i8]) -> Vec<[usize; 2]> {
    let len = threads::chunk_len(near.len());
    let chunks = (0..near.len()).step_by(len);
    let jobs = chunks.map(|start| start..near.len().min(start + len));
    threads::map(jobs.collect(), |places| {
        let (mut firsts, mut seconds) = (0, 0);
        for place in places {
            let is_paired = is_paired(near, place);
            firsts += usize::from(is_paired & (near[place] > 0));
            seconds += usize::from(is_paired & (near[place] < 0));
        }
        [firsts, seconds]
    })
}

/// The number of pairs.
fn total(counts: &[[usize; 2]]) -> usize {
    counts.iter().map(|[firsts, _]| firsts).sum()
}

/// Pairs boxes on long chains of preferences with the one they prefer.
fn cut_chains(near: &mut [i8]) {
    let is_deep = |near: &[i8], mut place: usize| {
        (0..CHAIN).all(|_| {
            let next = preferred(near, place);
            let is_open = preferred(near, next) != place;
            place = next;
            is_open
        })
    };
    let mut is_free: Vec<bool> = (0..near.len()).map(|place| is_deep(near, place)).collect();
    for place in 0..near.len() {
        let other = preferred(near, place);
        if is_free[place] && is_free[other] {
            (is_free[place], is_free[other]) = (false, false);
            near[other] = -near[place];
        }
    }
}

/// Merges the pairs of `clusters` into `next`. The merged ones become nodes, the first at index `first`; `counts` are
/// [`counts`] of `near`.
fn merge(
    clusters: &Clusters,
    near: &[i8],
    counts: &[[usize; 2]],
    next: &mut Clusters,
    nodes: &mut [Node],
    first: usize,
) {
    let len = threads::chunk_len(near.len());
    let (mut boxes, mut links, mut nodes, mut first) =
        (&mut next.boxes[..], &mut next.links[..], nodes, first);
    let mut jobs = Vec::new();
    for (start, &[pairs, seconds]) in (0..near.len()).step_by(len).zip(counts) {
        // A pair belongs to the chunk of its first box.
        let places = start..near.len().min(start + len);
        let (own_boxes, rest) = boxes.split_at_mut(places.len() - seconds);
        boxes = rest;
        let (own_links, rest) = links.split_at_mut(places.len() - seconds);
        links = rest;
        let (own_nodes, rest) = nodes.split_at_mut(2 * pairs);
        nodes = rest;
        jobs.push((places, own_boxes, own_links, own_nodes, first));
        first += 2 * pairs;
    }
    threads::for_each(jobs, |(places, boxes, links, nodes, mut first)| {
        let mut slots = boxes.iter_mut().zip(links);
        let mut nodes = nodes.chunks_exact_mut(2);
        for place in places {
            let other = preferred(near, place);
            let is_paired = preferred(near, other) == place;
            if is_paired && other < place {
                continue;
            }
            let Some((aabb, link)) = slots.next() else {
                break;
            };
            (*aabb, *link) = (clusters.boxes[place], clusters.links[place]);
            if is_paired && let Some(children) = nodes.next() {
                children[0] = Node::new(aabb, *link);
                children[1] = Node::new(&clusters.boxes[other], clusters.links[other]);
                *aabb = aabb.union(&clusters.boxes[other]);
                *link = first as u32;
                first += 2;
            }
        }
    });
}
