//! Plain numbers, one at a time: what runs where there is nothing better, and the reference for the others.

use super::{Lanes, Parts, ROW, Real, Turn};

/// One number.
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
    fn less(self, other: Self) -> bool {
        self.0 < other.0
    }
    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
    #[inline(always)]
    fn both(a: bool, b: bool) -> bool {
        a && b
    }
}

impl<R: Real> Turn for Plain<R> {
    type Number = R;
    type Row = Parts<Self, ROW>;
    #[inline(always)]
    fn columns(mut row: impl FnMut(usize) -> Self::Row) -> [Self; ROW] {
        row(0).0
    }
    #[inline(always)]
    fn rows(columns: [Self; ROW], mut put: impl FnMut(usize, Self::Row)) {
        put(0, Parts(columns));
    }
}
