//! Plain numbers, one at a time: what runs where there is nothing better, and the reference for the others.

use super::{Lanes, ROW, Real, Row, Turn};

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
    fn only(mask: bool, x: Self) -> Self {
        if mask { x } else { Self::zero() }
    }
    #[inline(always)]
    fn any(mask: bool) -> bool {
        mask
    }
}

/// The six numbers of a row that are not always zero.
#[derive(Debug, Clone, Copy)]
pub struct Six<R>([R; 6]);

/// Where they are in the row.
const PLACES: [usize; 6] = [0, 1, 2, 4, 5, 6];

impl<R: Real> std::ops::Add for Six<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + o.0[i]))
    }
}

impl<R: Real> std::ops::Sub for Six<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, o: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] - o.0[i]))
    }
}

impl<R: Real> Row<R> for Six<R> {
    #[inline(always)]
    fn read(from: &[R; ROW]) -> Self {
        Self(std::array::from_fn(|i| from[PLACES[i]]))
    }
    #[inline(always)]
    fn write(self, to: &mut [R; ROW]) {
        for (x, place) in self.0.into_iter().zip(PLACES) {
            to[place] = x;
        }
    }
}

impl<R: Real> Turn for Plain<R> {
    type Number = R;
    type Row = Six<R>;
    type Rows = [Self::Row; 1];
    #[inline(always)]
    fn columns(mut row: impl FnMut(usize) -> Self::Row) -> [Self; ROW] {
        let Six([a, b, c, e, f, g]) = row(0);
        [Self(a), Self(b), Self(c), Self::zero(), Self(e), Self(f), Self(g), Self::zero()]
    }
    #[inline(always)]
    fn rows([a, b, c, _, e, f, g, _]: [Self; ROW]) -> Self::Rows {
        [Six([a.0, b.0, c.0, e.0, f.0, g.0])]
    }
}
