//! Broad phase: axis-aligned bounding boxes, and the pairs of bodies of which they overlap.

use std::ops::ControlFlow;

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, Shapes};

/// Axis-aligned bounding box, m.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct Aabb {
    pub min: DVec3,
    pub max: DVec3,
}

impl Default for Aabb {
    /// Empty box: it overlaps and contains nothing.
    fn default() -> Self {
        Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY }
    }
}

impl Aabb {
    /// Bounds of body `i`, grown by `margin` (m).
    pub fn new(shapes: &Shapes, bodies: &Bodies, i: usize, margin: f64) -> Self {
        let (_, axes) = bodies.affine(i as u32);
        let half = shapes.half[i];
        let half =
            axes.x_axis.abs() * half.x + axes.y_axis.abs() * half.y + axes.z_axis.abs() * half.z + DVec3::splat(margin);
        Self { min: bodies.position[i] - half, max: bodies.position[i] + half }
    }

    /// Grows the box by `margin` (m) on every side.
    pub fn grown(&self, margin: f64) -> Self {
        Self { min: self.min - DVec3::splat(margin), max: self.max + DVec3::splat(margin) }
    }

    /// Returns true if the boxes share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Returns true if `other` lies within this box.
    pub fn contains(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// Smallest box around both.
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// Pairs of boxes that overlap, lower index first, by sweep and prune. The sweep runs along the
/// axis of the largest extent: for a column as for a field, few boxes then share an interval.
pub fn overlapping_pairs(bounds: &[Aabb]) -> Vec<(u32, u32)> {
    let mut pairs = Vec::new();
    let _ = sweep(bounds, |pair| {
        pairs.push(pair);
        ControlFlow::Continue(())
    });
    pairs
}

/// Returns true if more than `limit` pairs of boxes overlap.
pub fn exceeds_pairs(bounds: &[Aabb], limit: usize) -> bool {
    let mut left = limit;
    let swept = sweep(bounds, |_| match left.checked_sub(1) {
        Some(fewer) => {
            left = fewer;
            ControlFlow::Continue(())
        }
        None => ControlFlow::Break(()),
    });
    swept.is_break()
}

/// Calls `visit` with each pair of boxes that overlap, lower index first.
fn sweep(bounds: &[Aabb], mut visit: impl FnMut((u32, u32)) -> ControlFlow<()>) -> ControlFlow<()> {
    let all = bounds.iter().fold(Aabb::default(), |all, bound| all.union(bound));
    let extent = all.max - all.min;
    let axis = if extent.z >= extent.x.max(extent.y) { 2 } else { usize::from(extent.y > extent.x) };
    let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        bounds[a as usize].min[axis].total_cmp(&bounds[b as usize].min[axis]).then(a.cmp(&b))
    });
    for (index, &i) in order.iter().enumerate() {
        let bound = &bounds[i as usize];
        for &j in &order[index + 1..] {
            let other = &bounds[j as usize];
            if other.min[axis] > bound.max[axis] {
                break;
            }
            if bound.overlaps(other) {
                visit((i.min(j), i.max(j)))?;
            }
        }
    }
    ControlFlow::Continue(())
}

/// Neighbours of each body, as one list with an offset for each body.
#[derive(Debug, Clone, Default)]
pub struct Neighbours {
    /// Offsets of the bodies in the list.
    starts: Vec<u32>,
    list: Vec<u32>,
}

impl Neighbours {
    /// Neighbours of `n` bodies by a list of pairs.
    pub fn new(n: usize, pairs: &[(u32, u32)]) -> Self {
        let mut both: Vec<(u32, u32)> = pairs.iter().flat_map(|&(a, b)| [(a, b), (b, a)]).collect();
        both.sort_unstable();
        let starts = (0..=n as u32).map(|i| both.partition_point(|&(a, _)| a < i) as u32).collect();
        Self { starts, list: both.into_iter().map(|(_, b)| b).collect() }
    }

    /// Neighbours of body `i`, in ascending order.
    pub fn of(&self, i: usize) -> &[u32] {
        &self.list[self.starts[i] as usize..self.starts[i + 1] as usize]
    }
}
