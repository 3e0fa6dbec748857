//! Overlap of blocks, in any orientation.

mod intervals;
mod prism;
mod rounded_box;

use std::ops::ControlFlow;

use glam::DVec3;

use crate::scene::{Block, Scene};
use prism::Prism;
use rounded_box::RoundedBox;

/// Maximum number of overlaps that [`pairs`] returns, so that a scene of blocks at one position
/// does not exhaust the memory.
pub const MAX_PAIRS: usize = 1_000_000;

/// Two blocks inside each other.
///
/// ```
/// use teeter_scene::{named, overlap};
///
/// let mut scene = named("column").expect("the list has it");
/// scene.blocks[9].pos[2] -= 0.001;
/// let found = overlap::pairs(&scene, 1e-6);
/// assert_eq!((found[0].first, found[0].second), (8, 9));
/// assert!((found[0].depth - 0.001).abs() < 1e-12);
/// assert_eq!(found[0].direction, [0.0, 0.0, 1.0]); // the upper block leaves upwards
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Overlap {
    /// Index of the first block in the scene.
    pub first: usize,
    /// Index of the second block in the scene, above that of the first.
    pub second: usize,
    /// Penetration depth, m: the minimum distance that separates them.
    pub depth: f64,
    /// Direction of that distance: the unit vector along which the second block leaves the first.
    pub direction: [f64; 3],
}

/// Block prepared for tests against others.
struct Solid {
    shape: RoundedBox,
    /// Prism of an upright block with sharp edges.
    prism: Option<Prism>,
    /// Minimum of the bounds along x, y and z, m.
    min: [f64; 3],
    /// Maximum of the bounds along x, y and z, m.
    max: [f64; 3],
    fixed: bool,
}

impl Solid {
    fn new(b: &Block, edge_radius: f64) -> Self {
        let shape = RoundedBox::new(b, edge_radius);
        let prism = (b.orientation.is_none() && edge_radius == 0.0).then(|| Prism::new(b));
        let (min, max) = match &prism {
            Some(prism) => (prism.min, prism.max),
            None => {
                let (centre, extent) = (DVec3::from_array(b.pos), shape.extent());
                ((centre - extent).to_array(), (centre + extent).to_array())
            }
        };
        Self { shape, prism, min, max, fixed: b.fixed }
    }

    /// Depth of more than `tolerance` (m), and the direction in which the other block leaves this
    /// one.
    fn depth(&self, other: &Self, tolerance: f64) -> Option<(f64, DVec3)> {
        match (&self.prism, &other.prism) {
            (Some(a), Some(b)) => Some(a.depth(b)).filter(|(depth, _)| *depth > tolerance),
            _ => self.shape.depth(&other.shape, tolerance),
        }
    }
}

/// Returns the penetration depth of two blocks with sharp edges, m: the minimum distance that
/// separates them.
///
/// A negative value means that they are apart; it is then not a distance.
///
/// ```
/// use teeter_scene::{Block, overlap};
///
/// let a = Block::new(0, [0.08, 0.03, 0.02], 0.02, [0.0, 0.0, 0.01]);
/// let b = Block { id: 1, pos: [0.0, 0.0, 0.029], ..a.clone() };
/// assert!((overlap::depth(&a, &b) - 0.001).abs() < 1e-12);
/// ```
pub fn depth(a: &Block, b: &Block) -> f64 {
    rounded_depth(a, b, 0.0)
}

/// Returns the penetration depth of two blocks whose edges have a radius, m.
///
/// A negative value means that they are apart. It is their distance if the radius is above 0 or one
/// of them has an `orientation`.
///
/// ```
/// use teeter_scene::{Block, overlap};
///
/// // Corner to corner, each 10 mm beyond the other: rounding widens the gap between them.
/// let a = Block::new(0, [0.1; 3], 1.0, [0.0, 0.0, 0.05]);
/// let b = Block { id: 1, pos: [0.11, 0.11, 0.16], ..a.clone() };
/// let gap = (0.03f64 * 0.03 * 3.0).sqrt() - 0.02;
/// assert!((overlap::rounded_depth(&a, &b, 0.01) + gap).abs() < 1e-15);
/// ```
pub fn rounded_depth(a: &Block, b: &Block, edge_radius: f64) -> f64 {
    let (a, b) = (Solid::new(a, edge_radius), Solid::new(b, edge_radius));
    a.depth(&b, f64::NEG_INFINITY).map_or(f64::NEG_INFINITY, |(depth, _)| depth)
}

/// Finds the first two blocks, in order of creation, that penetrate by more than `tolerance` (m)
/// and are not both fixed.
pub fn first_pair(scene: &Scene, tolerance: f64) -> Option<Overlap> {
    let mut found: Option<Overlap> = None;
    let first = |found: &Option<Overlap>| found.map(|f| (f.first, f.second));
    // The sweep is along space: a pair that was created earlier may come later.
    let _ = sweep(scene, tolerance, |solids, i, j| {
        if first(&found).is_none_or(|pair| (i, j) < pair) {
            found = overlap(solids, (i, j), tolerance).or(found);
        }
        ControlFlow::Continue(())
    });
    found
}

/// Returns all overlaps of more than `tolerance` (m) between blocks that are not both fixed, in the
/// order of creation of the first and then of the second block; the first [`MAX_PAIRS`] that are
/// found. A negative tolerance finds blocks that are nearer than it, with their gap as a negative
/// depth: see [`rounded_depth`].
pub fn pairs(scene: &Scene, tolerance: f64) -> Vec<Overlap> {
    let mut found = Vec::new();
    let _ = sweep(scene, tolerance, |solids, i, j| {
        found.extend(overlap(solids, (i, j), tolerance));
        if found.len() < MAX_PAIRS { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    found.sort_unstable_by_key(|pair| (pair.first, pair.second));
    found
}

fn overlap(solids: &[Solid], (first, second): (usize, usize), tolerance: f64) -> Option<Overlap> {
    let (depth, direction) = solids[first].depth(&solids[second], tolerance)?;
    Some(Overlap { first, second, depth, direction: direction.to_array() })
}

/// Calls `visit` with each two blocks, the lower index first, whose bounds overlap by more than
/// `tolerance` (m) and that are not both fixed.
fn sweep(
    scene: &Scene,
    tolerance: f64,
    mut visit: impl FnMut(&[Solid], usize, usize) -> ControlFlow<()>,
) -> ControlFlow<()> {
    let solids: Vec<Solid> = scene.blocks.iter().map(|b| Solid::new(b, scene.edge_radius)).collect();
    let intervals = intervals::sparsest(&scene.blocks);
    let mut order: Vec<usize> = (0..solids.len()).collect();
    order.sort_by(|&a, &b| intervals[a].min.total_cmp(&intervals[b].min).then(a.cmp(&b)));
    for (rank, &i) in order.iter().enumerate() {
        for &j in &order[rank + 1..] {
            let (a, b) = (&solids[i], &solids[j]);
            if intervals[j].min > intervals[i].max - tolerance {
                break;
            }
            let is_near = (0..3).all(|k| a.max[k].min(b.max[k]) - a.min[k].max(b.min[k]) > tolerance);
            if is_near && !(a.fixed && b.fixed) {
                visit(&solids, i.min(j), i.max(j))?;
            }
        }
    }
    ControlFlow::Continue(())
}

/// Returns the height of a block's lowest point, m, if its edges have this radius.
///
/// ```
/// use teeter_scene::{Block, overlap};
///
/// // A cube on its edge.
/// let q = Some([0.0, 0.3826834323650898, 0.0, 0.9238795325112867]);
/// let cube = Block { orientation: q, ..Block::new(0, [0.1; 3], 1.0, [0.0, 0.0, 0.1]) };
/// assert!((overlap::lowest_point(&cube, 0.0) - (0.1 - 0.05 * 2f64.sqrt())).abs() < 1e-15);
/// ```
pub fn lowest_point(block: &Block, edge_radius: f64) -> f64 {
    match block.orientation {
        None => block.pos[2] - block.size[2] / 2.0,
        Some(_) => block.pos[2] - RoundedBox::new(block, edge_radius).extent().z,
    }
}
