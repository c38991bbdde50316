//! Outlines of regions of pixels.

use glam::{DVec2, IVec2, UVec2};

/// The weights of a point and of its neighbours before and after it.
const WEIGHTS: [f64; 5] = [1.0, 2.0, 3.0, 2.0, 1.0];
/// How far a point may be from the line that replaces it, in pixels.
const TOLERANCE: f64 = 0.12;
/// Lines of so few points stay as they are.
const SHORT: usize = 16;
/// The ways along the sides of a pixel: right, down, left, up. An outline has its inside to the right.
const WAYS: [IVec2; 4] = [IVec2::X, IVec2::Y, IVec2::NEG_X, IVec2::NEG_Y];

/// Smooth lines along the boundary of each region: the pixels with the same number, of which 0 is none, row by row from the top
/// left. Closed lines end where they begin. Sides on the border of the picture are left out.
pub fn contours(regions: &[u32], size: UVec2) -> Vec<Vec<DVec2>> {
    let mut sides = Sides::of(regions, size);
    let mut lines = Vec::new();
    for start in 0..sides.ways.len() {
        while sides.ways[start] != 0 {
            let corners = sides.follow(start);
            lines.extend(open_at_border(&corners, size).map(|line| simple(&smooth(&line))));
        }
    }
    lines.retain(|line| line.len() > 1);
    lines
}

/// The sides of pixels between a region and others, by the corner at which they begin. A way out of a corner belongs to the
/// pixel to its right, so that a line never leaves its region.
struct Sides {
    /// Number of corners in a row.
    width: i32,
    /// A bit for each of [`WAYS`].
    ways: Vec<u8>,
}

impl Sides {
    fn of(regions: &[u32], size: UVec2) -> Self {
        let (columns, rows) = (size.x as usize, size.y as usize);
        let width = columns + 1;
        let mut ways = vec![0; width * (rows + 1)];
        for row in 0..rows {
            for column in 0..columns {
                let at = row * columns + column;
                let own = regions[at];
                if own == 0 {
                    continue;
                }
                let corner = row * width + column;
                if row == 0 || regions[at - columns] != own {
                    ways[corner] |= 1;
                }
                if column + 1 == columns || regions[at + 1] != own {
                    ways[corner + 1] |= 2;
                }
                if row + 1 == rows || regions[at + columns] != own {
                    ways[corner + width + 1] |= 4;
                }
                if column == 0 || regions[at - 1] != own {
                    ways[corner + width] |= 8;
                }
            }
        }
        Self {
            width: width as i32,
            ways,
        }
    }

    /// Takes out the closed line that begins at a corner, and returns its corners; the first one is not repeated.
    fn follow(&mut self, start: usize) -> Vec<IVec2> {
        let mut corners = Vec::new();
        let mut at = start;
        let mut before = None;
        loop {
            let here = self.ways[at];
            // Where two pixels touch at a corner, the line stays with its own pixel: it turns right.
            let next = match before {
                Some(way) => [1, 0, 3, 2]
                    .map(|turn| (way + turn) % 4)
                    .into_iter()
                    .find(|way| here & (1_u8 << way) != 0),
                None => (0..4).find(|way| here & (1_u8 << way) != 0),
            };
            let Some(way) = next else {
                return corners;
            };
            self.ways[at] &= !(1 << way);
            let width = self.width as usize;
            corners.push(IVec2::new((at % width) as i32, (at / width) as i32));
            let step = WAYS[way];
            at = (at as i32 + step.x + step.y * self.width) as usize;
            before = Some(way);
            if at == start {
                return corners;
            }
        }
    }
}

/// A closed line of corners as lines through the middles of its sides, without those on the border of the picture.
fn open_at_border(corners: &[IVec2], size: UVec2) -> impl Iterator<Item = Vec<DVec2>> {
    let end = size.as_ivec2();
    let count = corners.len();
    let side = |index: usize| (corners[index % count], corners[(index + 1) % count]);
    let is_border = |index: usize| {
        let (a, b) = side(index);
        (0..2).any(|axis| a[axis] == b[axis] && (a[axis] == 0 || a[axis] == end[axis]))
    };
    let middle = |index: usize| {
        let (a, b) = side(index);
        (a + b).as_dvec2() / 2.0
    };
    let mut lines = Vec::new();
    match (0..count).find(|index| is_border(*index)) {
        None => lines.push((0..=count).map(middle).collect()),
        Some(first) => {
            let mut line = Vec::new();
            for index in first..first + count {
                match is_border(index) {
                    true => lines.extend(Some(std::mem::take(&mut line))),
                    false => line.push(middle(index)),
                }
            }
            lines.push(line);
        }
    }
    lines.into_iter().filter(|line| line.len() > 1)
}

/// Replaces each point by the weighted mean of its neighbours. Ends of open lines stay.
fn smooth(line: &[DVec2]) -> Vec<DVec2> {
    let count = line.len();
    let reach = WEIGHTS.len() / 2;
    let is_closed = line.first() == line.last();
    if count <= WEIGHTS.len() {
        return line.to_vec();
    }
    let total: f64 = WEIGHTS.iter().sum();
    let mean = |index: usize| {
        let neighbours = (0..WEIGHTS.len()).map(|offset| {
            let at = index + offset;
            let at = match is_closed {
                // The last point repeats the first.
                true => (at + (count - 1) - reach) % (count - 1),
                false => at.saturating_sub(reach).min(count - 1),
            };
            line[at] * WEIGHTS[offset]
        });
        neighbours.sum::<DVec2>() / total
    };
    let mut smoothed: Vec<DVec2> = (0..count).map(mean).collect();
    if !is_closed {
        (smoothed[0], smoothed[count - 1]) = (line[0], line[count - 1]);
    }
    smoothed
}

/// Leaves out points that lie nearly on the line of others (Ramer, Douglas and Peucker).
fn simple(line: &[DVec2]) -> Vec<DVec2> {
    if line.len() <= SHORT {
        return line.to_vec();
    }
    let last = line.len() - 1;
    let mut stays = vec![false; line.len()];
    (stays[0], stays[last]) = (true, true);
    // A closed line has no way from its first to its last point.
    let half = last / 2;
    stays[half] = true;
    let mut open = vec![(0, half), (half, last)];
    while let Some((from, to)) = open.pop() {
        let (a, b) = (line[from], line[to]);
        let distance = |index: usize| off_segment(line[index], a, b);
        let inner = (from + 1..to).map(|index| (distance(index), index));
        let farthest = inner.max_by(|a, b| a.0.total_cmp(&b.0));
        if let Some((_, index)) = farthest.filter(|(distance, _)| *distance > TOLERANCE) {
            stays[index] = true;
            open.extend([(from, index), (index, to)]);
        }
    }
    let kept = line.iter().zip(stays).filter(|(_, stays)| *stays);
    kept.map(|(point, _)| *point).collect()
}

fn off_segment(point: DVec2, a: DVec2, b: DVec2) -> f64 {
    let along = b - a;
    let share = (point - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE);
    (a + along * share.clamp(0.0, 1.0)).distance(point)
}
