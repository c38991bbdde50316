//! The neighbour with which each box has the smallest joint box.
//!
//! Boxes are taken in blocks, transposed, and compared with the neighbours at one distance after the other, so that
//! compilers make vector instructions of the loops. The joint box of a pair is computed once for both.

use crate::bvh::linked::Box4;

/// How far along the curve neighbours are searched, in either direction.
pub const RADIUS: usize = 14;

/// Boxes of a block; the block and its areas fit the fastest cache.
const BLOCK: usize = 128;

/// For each distance d, whether i / d is even.
const EVEN: [[u32; BLOCK + 2 * RADIUS]; RADIUS + 1] = {
    let mut even = [[0; BLOCK + 2 * RADIUS]; RADIUS + 1];
    let mut distance = 1;
    while distance <= RADIUS {
        let mut i = 0;
        while i < BLOCK + 2 * RADIUS {
            even[distance][i] = (i / distance % 2 == 0) as u32;
            i += 1;
        }
        distance += 1;
    }
    even
};

/// For each box from `first` on, the distance to the neighbour with which its joint box is smallest. Among
/// equal ones the nearest wins, and among two at the same distance d the one in the same pair when every d
/// boxes are paired with the next d. All preferences then lead to a pair that prefer each other.
pub fn search(boxes: &[Box4], first: usize, near: &mut [i8]) {
    let mut block = Block::default();
    for (start, near) in (first..).step_by(BLOCK).zip(near.chunks_mut(BLOCK)) {
        block.load(boxes, start, near.len());
        block.search(boxes.len(), start, near);
    }
}

/// The lower and the upper sides of boxes along an axis.
type Sides<'a> = (&'a [f32], &'a [f32]);

/// Boxes from [`RADIUS`] before the block to [`RADIUS`] after it. Where there are none, anything.
struct Block {
    min: [[f32; BLOCK + 2 * RADIUS]; 3],
    max: [[f32; BLOCK + 2 * RADIUS]; 3],
}

impl Default for Block {
    fn default() -> Self {
        Self {
            min: [[0.0; BLOCK + 2 * RADIUS]; 3],
            max: [[0.0; BLOCK + 2 * RADIUS]; 3],
        }
    }
}

impl Block {
    fn load(&mut self, boxes: &[Box4], start: usize, len: usize) {
        let from = start.saturating_sub(RADIUS);
        let to = boxes.len().min(start + len + RADIUS);
        for (slot, aabb) in (from + RADIUS - start..).zip(&boxes[from..to]) {
            for axis in 0..3 {
                self.min[axis][slot] = aabb.min[axis];
                self.max[axis][slot] = aabb.max[axis];
            }
        }
    }

    /// Searches for the boxes from `start` on, of `count`.
    fn search(&self, count: usize, start: usize, near: &mut [i8]) {
        let len = near.len();
        let (mut least, mut best) = ([f32::INFINITY; BLOCK], [0i32; BLOCK]);
        let mut areas = [f32::INFINITY; BLOCK + RADIUS];
        for distance in 1..=RADIUS {
            self.joint_areas(distance, &mut areas[..RADIUS + len]);
            // Pairs of which one does not exist.
            areas[..RADIUS.saturating_sub(start)].fill(f32::INFINITY);
            let end = (count + RADIUS).saturating_sub(start + distance);
            areas[end.min(RADIUS + len)..RADIUS + len].fill(f32::INFINITY);

            let before = &areas[RADIUS - distance..][..len];
            let after = &areas[RADIUS..][..len];
            let even = &EVEN[distance][start % (2 * distance)..][..len];
            let (least, best) = (&mut least[..len], &mut best[..len]);
            let distance = distance as i32;
            for i in 0..len {
                let is_less = before[i] < least[i];
                let found = if is_less { -distance } else { best[i] };
                let area = if is_less { before[i] } else { least[i] };
                let is_tie = (after[i] == area) & (found == -distance) & (even[i] != 0);
                let is_after = (after[i] < area) | is_tie;
                best[i] = if is_after { distance } else { found };
                least[i] = if is_after { after[i] } else { area };
            }
        }
        for (near, best) in near.iter_mut().zip(best) {
            *near = best as i8;
        }
    }

    /// Half of the surface areas of the joint boxes with those at a distance, at most the largest finite number.
    fn joint_areas(&self, distance: usize, areas: &mut [f32]) {
        let len = areas.len();
        let side = |axis: usize| {
            let (min, max) = (&self.min[axis], &self.max[axis]);
            let after = (&min[distance..][..len], &max[distance..][..len]);
            ((&min[..len], &max[..len]), after)
        };
        let [x, y, z] = [0, 1, 2].map(side);
        for (i, area) in areas.iter_mut().enumerate() {
            let extent = |((min, max), (min_after, max_after)): (Sides<'_>, Sides<'_>)| {
                greater(max[i], max_after[i]) - less(min[i], min_after[i])
            };
            let (x, y, z) = (extent(x), extent(y), extent(z));
            *area = less(x * y + y * z + z * x, f32::MAX);
        }
    }
}

/// The lesser number, or `b` where one is none. One instruction, which [`f32::min`] is not.
#[inline(always)]
fn less(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
}

/// The greater number, or `b` where one is none.
#[inline(always)]
fn greater(a: f32, b: f32) -> f32 {
    if a > b { a } else { b }
}
