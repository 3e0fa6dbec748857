//! Which bodies are near each other: bounds along the axes, and the pairs of them that overlap.

use glam::DVec3;
use serde::{Deserialize, Serialize};

use crate::body::{Bodies, Shapes};

/// Axis-aligned bounds, m.
#[derive(Debug, Clone, Copy, Serialize, Deserialize)]
pub struct Bound {
    pub min: DVec3,
    pub max: DVec3,
}

impl Default for Bound {
    /// Bounds of nothing: they overlap none and contain none.
    fn default() -> Self {
        Self { min: DVec3::INFINITY, max: DVec3::NEG_INFINITY }
    }
}

impl Bound {
    /// Those of a body, grown by `reach` (m).
    pub fn new(shapes: &Shapes, bodies: &Bodies, i: usize, reach: f64) -> Self {
        let (_, axes) = bodies.affine(i as u32);
        let half = shapes.half[i];
        let half =
            axes.x_axis.abs() * half.x + axes.y_axis.abs() * half.y + axes.z_axis.abs() * half.z + DVec3::splat(reach);
        Self { min: bodies.position[i] - half, max: bodies.position[i] + half }
    }

    /// Grown by so much on every side, m.
    pub fn grown(&self, by: f64) -> Self {
        Self { min: self.min - DVec3::splat(by), max: self.max + DVec3::splat(by) }
    }

    /// Whether they share a point.
    pub fn overlaps(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// Whether the other is within.
    pub fn contains(&self, other: &Self) -> bool {
        self.min.cmple(other.min).all() && other.max.cmple(self.max).all()
    }

    /// The least bounds around both.
    pub fn union(&self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }
}

/// The pairs, lower index first, of which the bounds overlap. They are swept along the axis on which they are spread furthest: few
/// then share an interval, be they a column or a field.
pub fn overlapping(bounds: &[Bound]) -> Vec<(u32, u32)> {
    let hull = bounds.iter().fold(Bound::default(), |hull, bound| hull.union(bound));
    let spread = hull.max - hull.min;
    let axis = if spread.z >= spread.x.max(spread.y) { 2 } else { usize::from(spread.y > spread.x) };
    let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
    order.sort_unstable_by(|&a, &b| {
        bounds[a as usize].min[axis].total_cmp(&bounds[b as usize].min[axis]).then(a.cmp(&b))
    });
    let mut pairs = Vec::new();
    for (place, &i) in order.iter().enumerate() {
        let bound = &bounds[i as usize];
        for &j in &order[place + 1..] {
            let other = &bounds[j as usize];
            if other.min[axis] > bound.max[axis] {
                break;
            }
            if bound.overlaps(other) {
                pairs.push((i.min(j), i.max(j)));
            }
        }
    }
    pairs
}

/// The neighbours of each body.
#[derive(Debug, Clone, Default)]
pub struct Near {
    /// Where those of each body begin in the list.
    starts: Vec<u32>,
    list: Vec<u32>,
}

impl Near {
    /// Those of `n` bodies that the pairs name.
    pub fn new(n: usize, pairs: &[(u32, u32)]) -> Self {
        let mut both: Vec<(u32, u32)> = pairs.iter().flat_map(|&(a, b)| [(a, b), (b, a)]).collect();
        both.sort_unstable();
        let starts = (0..=n as u32).map(|i| both.partition_point(|&(a, _)| a < i) as u32).collect();
        Self { starts, list: both.into_iter().map(|(_, b)| b).collect() }
    }

    /// Those of body `i`, in order.
    pub fn of(&self, i: usize) -> &[u32] {
        &self.list[self.starts[i] as usize..self.starts[i + 1] as usize]
    }
}
