//! Roots of the cubic of Eq. 4.10 between 0 and 1.
//!
//! The interval is cut where the slope of the cubic changes its sign, so that each piece is crossed at most once, and a root lies in a
//! piece exactly when the values at its ends differ in sign. A closed form would lose small roots to cancellation.

/// a t³ + b t² + c t + d.
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

/// A root, and on which side of it the cubic is positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Root {
    /// Where, 0 to 1.
    pub t: f64,
    /// Whether the cubic falls there, from positive to negative.
    pub falls: bool,
}

/// Roots in ascending order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Roots {
    roots: [Root; 3],
    len: usize,
}

impl Roots {
    /// The roots, the smallest first.
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

    /// Whether it may be zero between 0 and 1: false only where all of its Bernstein coefficients have one sign, whose least and greatest
    /// bound its values.
    #[inline]
    pub fn may_vanish(&self) -> bool {
        let Cubic { a, b, c, d } = *self;
        // The two in the middle times three.
        let (p0, p1, p2, p3) = (d, 3.0 * d + c, 3.0 * d + 2.0 * c + b, d + c + b + a);
        !((p0 > 0.0 && p1 > 0.0 && p2 > 0.0 && p3 > 0.0) || (p0 < 0.0 && p1 < 0.0 && p2 < 0.0 && p3 < 0.0))
    }

    /// The places from 0 to 1, both included, where its sign changes. A zero at an end counts if the cubic is not zero beside it; where it
    /// only touches zero there is none.
    pub fn crossings(&self) -> Roots {
        let mut found = Roots { roots: [Root { t: 0.0, falls: false }; 3], len: 0 };
        let cuts = self.turns();
        let mut low = (0.0, self.at(0.0));
        for t in cuts.into_iter().chain([1.0]) {
            let high = (t, self.at(t));
            let falls = (low.1 > 0.0 && high.1 <= 0.0) || (low.1 == 0.0 && low.0 == 0.0 && high.1 < 0.0);
            let rises = (low.1 < 0.0 && high.1 >= 0.0) || (low.1 == 0.0 && low.0 == 0.0 && high.1 > 0.0);
            if (falls || rises) && found.len < 3 {
                found.roots[found.len] = Root { t: self.between(low, high), falls };
                found.len += 1;
            }
            low = high;
        }
        found
    }

    /// The places between 0 and 1 where the slope is zero, in ascending order; 1 in place of those that are not there.
    fn turns(&self) -> [f64; 2] {
        // 3 a t² + 2 b t + c = 0, in the form that subtracts no nearly equal numbers.
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

    /// The root of a piece without turns, by Newton's method, by halves where that would leave the piece.
    fn between(&self, low: (f64, f64), high: (f64, f64)) -> f64 {
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
