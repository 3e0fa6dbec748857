//! Axis-aligned boxes around what moves (section 4.4.3): each holds the current and the next states and with them all between.

use glam::DVec3;

/// An axis-aligned box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bounds {
    /// Least corner, m.
    pub min: DVec3,
    /// Greatest corner, m.
    pub max: DVec3,
}

impl Bounds {
    /// Around a straight way.
    pub fn of_way(from: DVec3, to: DVec3) -> Self {
        Self { min: from.min(to), max: from.max(to) }
    }

    /// Around two boxes.
    pub fn with(self, other: Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Whether two boxes have a point in common.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        // No short cut between the axes: six comparisons are cheaper than a jump that is taken at random.
        (self.min.x <= other.max.x)
            & (other.min.x <= self.max.x)
            & (self.min.y <= other.max.y)
            & (other.min.y <= self.max.y)
            & (self.min.z <= other.max.z)
            & (other.min.z <= self.max.z)
    }
}

/// Boxes of `N` parts of a block, at most sixteen, coordinate by coordinate, so that one comparison takes several parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BoundsOf<const N: usize> {
    min: [[f64; N]; 3],
    max: [[f64; N]; 3],
}

impl<const N: usize> BoundsOf<N> {
    /// The boxes that `of` gives for each part.
    pub fn new(of: impl Fn(usize) -> Bounds) -> Self {
        let mut all = Self { min: [[0.0; N]; 3], max: [[0.0; N]; 3] };
        for n in 0..N {
            all.set(n, of(n));
        }
        all
    }

    /// The box of a part.
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

    /// Which parts meet a box, as bits.
    #[inline]
    pub fn meeting(&self, bounds: &Bounds) -> u16 {
        let mut meets = [true; N];
        for axis in 0..3 {
            let (low, high) = (bounds.min[axis], bounds.max[axis]);
            for (meets, (min, max)) in meets.iter_mut().zip(self.min[axis].iter().zip(&self.max[axis])) {
                *meets &= (*min <= high) & (*max >= low);
            }
        }
        meets.iter().enumerate().fold(0, |bits, (n, meets)| bits | u16::from(*meets) << n)
    }
}
