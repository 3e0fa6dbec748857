//! Lanes as an array: what runs where there is nothing better, and the reference for the others.

use super::{LANES, Lanes, Real, operators};

/// Eight numbers.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub struct Wide<R>([R; LANES]);

operators!(Wide<R>, |a, b| a + b, a - b, a * b, a / b, |c| -c);

impl<R: Real> Lanes for Wide<R> {
    type Number = R;
    type Mask = [bool; LANES];
    #[inline(always)]
    fn splat(x: R) -> Self {
        Self([x; LANES])
    }
    #[inline(always)]
    fn load(from: &[R; LANES]) -> Self {
        Self(*from)
    }
    #[inline(always)]
    fn store(self, to: &mut [R; LANES]) {
        *to = self.0;
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.map(R::sqrt))
    }
    #[inline(always)]
    fn less(self, other: Self) -> [bool; LANES] {
        std::array::from_fn(|i| self.0[i] < other.0[i])
    }
    #[inline(always)]
    fn select(mask: [bool; LANES], yes: Self, no: Self) -> Self {
        Self(std::array::from_fn(|i| if mask[i] { yes.0[i] } else { no.0[i] }))
    }
    #[inline(always)]
    fn any(mask: [bool; LANES]) -> bool {
        mask.iter().any(|&m| m)
    }
    #[inline(always)]
    fn both(a: [bool; LANES], b: [bool; LANES]) -> [bool; LANES] {
        std::array::from_fn(|i| a[i] && b[i])
    }
    #[inline(always)]
    fn transpose(rows: [Self; 8]) -> [Self; 8] {
        std::array::from_fn(|j| Self(std::array::from_fn(|i| rows[i].0[j])))
    }
}
