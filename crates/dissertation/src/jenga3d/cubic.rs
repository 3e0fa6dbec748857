//! Roots of the cubic of Eq. 4.10 from 0 to 1.
//!
//! The interval is split at the extrema of the cubic, so that each piece has at most one root, and
//! has it exactly if the values at its ends differ in sign. A closed form would lose small roots to
//! cancellation.

/// Cubic a t³ + b t² + c t + d.
///
/// ```
/// use teeter_dissertation::jenga3d::cubic::Cubic;
///
/// let line = Cubic { a: 0.0, b: 0.0, c: -2.0, d: 1.0 };
/// assert!(line.may_have_root());
/// assert_eq!(line.at(0.5), 0.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cubic {
    /// Coefficient of t³.
    pub a: f64,
    /// Coefficient of t².
    pub b: f64,
    /// Coefficient of t.
    pub c: f64,
    /// Constant.
    pub d: f64,
}

/// Root of a cubic with the sign of its change.
///
/// ```
/// use teeter_dissertation::jenga3d::cubic::{Cubic, Root};
///
/// let line = Cubic { a: 0.0, b: 0.0, c: -2.0, d: 1.0 };
/// assert_eq!(line.crossings().as_slice(), [Root { t: 0.5, descending: true }]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// Argument, 0 to 1.
    pub t: f64,
    /// True where the cubic changes from positive to negative.
    pub descending: bool,
}

/// Roots of a cubic in ascending order.
///
/// ```
/// use teeter_dissertation::jenga3d::cubic::Cubic;
///
/// let cubic = Cubic { a: 32.0, b: -48.0, c: 22.0, d: -3.0 }; // roots 1/4, 1/2, 3/4
/// assert_eq!(cubic.crossings().as_slice().len(), 3);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roots {
    roots: [Root; 3],
    len: usize,
}

impl Roots {
    /// Roots as a slice, the smallest first.
    pub fn as_slice(&self) -> &[Root] {
        &self.roots[..self.len]
    }
}

impl Cubic {
    /// Value at `t`.
    #[inline]
    pub fn at(&self, t: f64) -> f64 {
        ((self.a * t + self.b) * t + self.c) * t + self.d
    }

    fn slope(&self, t: f64) -> f64 {
        (3.0 * self.a * t + 2.0 * self.b) * t + self.c
    }

    /// Returns false if the cubic certainly has no root from 0 to 1: where its Bernstein
    /// coefficients, which bound its values, all have one sign.
    #[inline]
    pub fn may_have_root(&self) -> bool {
        let Cubic { a, b, c, d } = *self;
        // The middle two are scaled by three.
        let (p0, p1, p2, p3) = (d, 3.0 * d + c, 3.0 * d + 2.0 * c + b, d + c + b + a);
        // One branch for the caller: the signs of most are not predictable.
        let positive = (p0 > 0.0) & (p1 > 0.0) & (p2 > 0.0) & (p3 > 0.0);
        let negative = (p0 < 0.0) & (p1 < 0.0) & (p2 < 0.0) & (p3 < 0.0);
        !(positive | negative)
    }

    /// Returns the arguments from 0 to 1, inclusive, where the sign changes.
    ///
    /// A zero at an end counts if the cubic is not zero next to it; a double root does not count.
    pub fn crossings(&self) -> Roots {
        let mut found = Roots { roots: [Root { t: 0.0, descending: false }; 3], len: 0 };
        let cuts = self.extrema();
        let mut low = (0.0, self.at(0.0));
        for t in cuts.into_iter().chain([1.0]) {
            let high = (t, self.at(t));
            let descending = (low.1 > 0.0 && high.1 <= 0.0) || (low.1 == 0.0 && low.0 == 0.0 && high.1 < 0.0);
            let ascending = (low.1 < 0.0 && high.1 >= 0.0) || (low.1 == 0.0 && low.0 == 0.0 && high.1 > 0.0);
            if (descending || ascending) && found.len < 3 {
                found.roots[found.len] = Root { t: self.root_between(low, high), descending };
                found.len += 1;
            }
            low = high;
        }
        found
    }

    /// Returns the arguments between 0 and 1 where the slope is zero, in ascending order, padded
    /// with 1.
    fn extrema(&self) -> [f64; 2] {
        // 3 a t² + 2 b t + c = 0, in the form without cancellation.
        let (a, b, c) = (3.0 * self.a, self.b, self.c);
        let square = b * b - a * c;
        if square.is_nan() || square <= 0.0 {
            return [1.0; 2];
        }
        let q = -(b + square.sqrt().copysign(b));
        let inside = |t: f64| if t > 0.0 && t < 1.0 { t } else { 1.0 };
        let (s, t) = (inside(q / a), inside(c / q));
        [s.min(t), s.max(t)]
    }

    /// Returns the root of a monotonic piece by Newton's method, and by bisection where that would
    /// leave the piece.
    fn root_between(&self, low: (f64, f64), high: (f64, f64)) -> f64 {
        if low.1 == 0.0 {
            return low.0;
        }
        if high.1 == 0.0 {
            return high.0;
        }
        let (mut a, mut b) = (low.0, high.0);
        let low_positive = low.1 > 0.0;
        let mut t = a + (b - a) * (low.1 / (low.1 - high.1));
        for _ in 0..100 {
            let value = self.at(t);
            if value == 0.0 {
                return t;
            }
            if (value > 0.0) == low_positive {
                a = t;
            } else {
                b = t;
            }
            let newton = t - value / self.slope(t);
            let new = if newton > a && newton < b { newton } else { 0.5 * (a + b) };
            if (new - t).abs() <= 1e-15 {
                return new;
            }
            t = new;
        }
        t
    }
}
