//! Scalars as registers of one lane: the fallback, and the reference of the other widths.

use super::lanes::{Lanes, ROW_LEN, Real, RowRegister, Transpose};

/// Register of one scalar.
#[derive(Debug, Clone, Copy)]
pub struct Plain<R>(R);

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl<R: Real> std::ops::$trait for Plain<R> {
            type Output = Self;
            #[inline(always)]
            fn $name(self, o: Self) -> Self {
                Self(self.0.$name(o.0))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl<R: Real> std::ops::Neg for Plain<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl<R: Real> std::ops::AddAssign for Plain<R> {
    #[inline(always)]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl<R: Real> std::ops::SubAssign for Plain<R> {
    #[inline(always)]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl<R: Real> Lanes for Plain<R> {
    type Mask = bool;
    const WIDTH: usize = 1;
    #[inline(always)]
    fn splat(x: R) -> Self {
        Self(x)
    }
    #[inline(always)]
    fn load<const N: usize>(from: &[R; N], part: usize) -> Self {
        Self(from[part])
    }
    #[inline(always)]
    fn store<const N: usize>(self, to: &mut [R; N], part: usize) {
        to[part] = self.0;
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        if self.0 < other.0 { self } else { other }
    }
    #[inline(always)]
    fn less_than(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn mask(mask: bool, x: Self) -> Self {
        if mask { x } else { Self::zero() }
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
}

/// Row without the two scalars that are always zero.
#[derive(Debug, Clone, Copy)]
pub struct CompactRow<R>([R; 6]);

/// Offsets in the row of the scalars that are not always zero.
const OFFSETS: [usize; 6] = [0, 1, 2, 4, 5, 6];

impl<R: Real> std::ops::Add for CompactRow<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + o.0[i]))
    }
}

impl<R: Real> std::ops::Sub for CompactRow<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - o.0[i]))
    }
}

impl<R: Real> RowRegister<R> for CompactRow<R> {
    #[inline(always)]
    fn read(from: &[R; ROW_LEN]) -> Self {
        Self(std::array::from_fn(|i| from[OFFSETS[i]]))
    }
    #[inline(always)]
    fn write(self, to: &mut [R; ROW_LEN]) {
        for (x, offset) in self.0.into_iter().zip(OFFSETS) {
            to[offset] = x;
        }
    }
}

impl<R: Real> Transpose for Plain<R> {
    type Scalar = R;
    type Row = CompactRow<R>;
    type Rows = [Self::Row; 1];
    #[inline(always)]
    fn columns(mut row: impl FnMut(usize) -> Self::Row) -> [Self; ROW_LEN] {
        let CompactRow([a, b, c, e, f, g]) = row(0);
        [Self(a), Self(b), Self(c), Self::zero(), Self(e), Self(f), Self(g), Self::zero()]
    }
    #[inline(always)]
    fn rows([a, b, c, _, e, f, g, _]: [Self; ROW_LEN]) -> Self::Rows {
        [CompactRow([a.0, b.0, c.0, e.0, f.0, g.0])]
    }
}
