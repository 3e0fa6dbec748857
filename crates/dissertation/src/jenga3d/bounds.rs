//! Axis-aligned boxes of moving parts (section 4.4.3): each encloses the current state, the next
//! state and all between.

use glam::DVec3;

/// Axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Minimum corner, m.
    pub min: DVec3,
    /// Maximum corner, m.
    pub max: DVec3,
}

impl Bounds {
    /// Returns the box of a straight path.
    pub fn of_path(from: DVec3, to: DVec3) -> Self {
        Self { min: from.min(to), max: from.max(to) }
    }

    /// Returns the box of two boxes.
    pub fn union(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Returns true if two boxes share a point.
    #[inline]
    pub fn overlaps(&self, other: &Self) -> bool {
        // No short circuit between the axes: six comparisons cost less than an unpredictable
        // branch.
        (self.min.x <= other.max.x)
            & (other.min.x <= self.max.x)
            & (self.min.y <= other.max.y)
            & (other.min.y <= self.max.y)
            & (self.min.z <= other.max.z)
            & (other.min.z <= self.max.z)
    }
}

/// Boxes of `N` parts of a block, at most sixteen, as structure of arrays, so that one comparison
/// covers several parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundsArray<const N: usize> {
    min: [[f64; N]; 3],
    max: [[f64; N]; 3],
}

impl<const N: usize> BoundsArray<N> {
    /// Creates the boxes that `of` returns for each part.
    pub fn new(of: impl Fn(usize) -> Bounds) -> Self {
        let mut all = Self { min: [[0.0; N]; 3], max: [[0.0; N]; 3] };
        for n in 0..N {
            all.set(n, of(n));
        }
        all
    }

    /// Returns the box of a part.
    #[inline]
    pub fn get(&self, n: usize) -> Bounds {
        let corner = |c: &[[f64; N]; 3]| DVec3::new(c[0][n], c[1][n], c[2][n]);
        Bounds { min: corner(&self.min), max: corner(&self.max) }
    }

    /// Replaces the box of a part.
    #[inline]
    pub fn set(&mut self, n: usize, bounds: Bounds) {
        for axis in 0..3 {
            self.min[axis][n] = bounds.min[axis];
            self.max[axis][n] = bounds.max[axis];
        }
    }

    /// Returns a mask of the parts that overlap a box.
    #[inline]
    pub fn overlapping(&self, bounds: &Bounds) -> u16 {
        let mut overlaps = [true; N];
        for axis in 0..3 {
            let (low, high) = (bounds.min[axis], bounds.max[axis]);
            for (overlaps, (min, max)) in overlaps.iter_mut().zip(self.min[axis].iter().zip(&self.max[axis])) {
                *overlaps &= (*min <= high) & (*max >= low);
            }
        }
        overlaps.iter().enumerate().fold(0, |mask, (n, overlaps)| mask | u16::from(*overlaps) << n)
    }
}
